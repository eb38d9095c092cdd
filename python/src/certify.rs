//! Certification of a method in Python.

use std::sync::Arc;

use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tunnelproof::narrow::Tolerance;
use tunnelproof_cli::report::page;
use tunnelproof_float_env::with_default;
use tunnelproof_reference::certify::findings::{Findings, Settings};
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::certify::run::Panel;
use tunnelproof_reference::certify::shard::Shard;
use tunnelproof_reference::certify::source::Source;
use tunnelproof_reference::certify::table;
use tunnelproof_reference::generate;
use tunnelproof_reference::report::merge::{Kept, merge as join};
use tunnelproof_reference::report::results::Results;

use crate::method::Method;
use crate::queries::{self, Rows};

/// The result as JSON, as text and as a page.
type Certificate = (String, String, String);

/// What is judged besides families: a name, a kind, points and radii.
type Own<'py> = (
    String,
    String,
    PyReadonlyArray3<'py, f64>,
    PyReadonlyArray2<'py, f64>,
);

/// Judges a callable, see [`Method`].
#[pyfunction]
#[pyo3(signature = (call, name, near, late, families, own, count, seed, shard))]
#[allow(
    clippy::too_many_arguments,
    reason = "called from one place, which names them"
)]
pub(crate) fn certify(
    py: Python<'_>,
    call: Py<PyAny>,
    name: String,
    near: f64,
    late: f64,
    families: Vec<String>,
    own: Vec<Own<'_>>,
    count: u64,
    seed: u64,
    shard: (u64, u64),
) -> PyResult<Certificate> {
    let mut sources = Vec::new();
    for family in &families {
        let family = generate::by_name(family)
            .ok_or_else(|| PyValueError::new_err(format!("there is no family {family:?}")))?;
        sources.push(Source::Family {
            family,
            seed,
            count,
        });
    }
    for (name, kind, points, radii) in own {
        let rows = Rows::new(&points, &radii)?;
        let kind = queries::kind(&kind)?;
        let queries: Arc<[_]> = with_default(|| rows.queries(kind))?.into();
        sources.push(Source::Queries { name, queries });
    }
    let shard: Shard = format!("{}/{}", shard.0, shard.1)
        .parse()
        .map_err(|error| PyValueError::new_err(format!("shard is {shard:?}: {error}")))?;
    for (name, value) in [("near", near), ("late", late)] {
        if !(value >= 0.0 && value.is_finite()) {
            let message = format!("{name} is {value}, not a number from 0");
            return Err(PyValueError::new_err(message));
        }
    }
    let tolerance = Tolerance { near, late };
    let subject = Method {
        name,
        call,
        tolerance,
    };
    let panel = Panel {
        second_judges: Vec::new(),
        subjects: vec![Judged {
            subject: &subject,
            explain: None,
        }],
    };
    let mut blocks = Vec::new();
    for source in &sources {
        let run = || panel.run_shard(source, shard, |_| {});
        let block = py.detach(|| with_default(run));
        blocks.push(block.map_err(|error| PyValueError::new_err(error.to_string()))?);
        py.check_signals()?;
    }
    let settings = Settings {
        command: String::new(),
        seed,
        count,
        shard,
    };
    let certificate = || written(&Findings::new(panel, settings, blocks, Vec::new()));
    Ok(py.detach(|| with_default(certificate)))
}

/// The certificate of the whole, from those of all its shards as JSON.
#[pyfunction]
pub(crate) fn merge(parts: Vec<String>) -> PyResult<Certificate> {
    with_default(|| merged(&parts))
}

fn merged(parts: &[String]) -> PyResult<Certificate> {
    let names: Vec<_> = (1..=parts.len()).map(|i| format!("part {i}")).collect();
    let refuse = |name: &str, error| PyValueError::new_err(format!("{name}: {error}"));
    let mut kept = Vec::new();
    for (name, text) in names.iter().zip(parts) {
        let part = Results::read(text).and_then(|results| Kept::new(&results));
        kept.push((name.as_str(), part.map_err(|error| refuse(name, error))?));
    }
    let merged = join(kept).map_err(|(name, error)| refuse(name, error))?;
    Ok(written(&merged.findings()))
}

fn written(findings: &Findings<'_>) -> Certificate {
    let json = Results::new(findings).text();
    (
        json,
        table::text(findings, table::INSTALLED),
        page::certificate(findings),
    )
}

//! Certification of a method in Python.

use std::sync::Arc;

use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tunnelproof::narrow::Tolerance;
use tunnelproof_cli::report::page;
use tunnelproof_float_env::with_default;
use tunnelproof_reference::certify::caller::{Caller, in_quotes};
use tunnelproof_reference::certify::defaults;
use tunnelproof_reference::certify::findings::{Findings, Settings};
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::certify::run::Panel;
use tunnelproof_reference::certify::shard::Shard;
use tunnelproof_reference::certify::source::{AnyFamily, AnySource, Source};
use tunnelproof_reference::certify::table::{self, Shown};
use tunnelproof_reference::generate::{self, Family};
use tunnelproof_reference::report::merge::{Kept, merge as join};
use tunnelproof_reference::report::results::Results;

use crate::method::{Method, tolerance};
use crate::queries::{self, Rows};

/// The result as JSON, as text, as text with all details, and as a page.
type Certificate = (String, String, String, String);

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
    families: Option<Vec<String>>,
    own: Vec<Own<'_>>,
    count: u64,
    seed: u64,
    shard: (u64, u64),
) -> PyResult<Certificate> {
    let shard: Shard = format!("{}/{}", shard.0, shard.1)
        .parse()
        .map_err(|error| PyValueError::new_err(format!("shard is {shard:?}: {error}")))?;
    let subject = Method::new(name, call, tolerance(near, late)?);
    let command = command(&subject, families.as_deref(), !own.is_empty(), count, seed);
    let families = match families {
        Some(names) => names
            .iter()
            .map(|name| family(name).map(AnyFamily::Linear))
            .collect::<PyResult<Vec<_>>>()?,
        None if own.is_empty() => py.detach(|| with_default(|| defaults::families(&[&subject]))),
        None => Vec::new(),
    };
    let families = families.into_iter();
    let mut sources: Vec<AnySource> = families.map(|family| family.first(seed, count)).collect();
    for (name, kind, points, radii) in own {
        let rows = Rows::new(&points, &radii)?;
        let kind = queries::kind(&kind)?;
        let queries: Arc<[_]> = with_default(|| rows.queries(kind))?.into();
        sources.push(Source::Queries { name, queries }.into());
    }
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
        let block = subject.watched(py, run);
        if let Some(error) = subject.ending(py) {
            return Err(error);
        }
        blocks.push(block.map_err(|error| PyValueError::new_err(error.to_string()))?);
    }
    let settings = Settings {
        command,
        caller: Caller::Python,
        seed,
        count,
        shard,
    };
    let certificate = || written(&Findings::new(panel, settings, blocks, Vec::new()));
    let certificate = py.detach(|| with_default(certificate));
    subject.finish()?;
    Ok(certificate)
}

fn family(name: &str) -> PyResult<&'static Family> {
    let refuse = || PyValueError::new_err(format!("there is no family {name:?}"));
    generate::by_name(name).ok_or_else(refuse)
}

/// The expression that judges again.
fn command(
    method: &Method,
    families: Option<&[String]>,
    has_own: bool,
    count: u64,
    seed: u64,
) -> String {
    let mut words = vec![
        "method".to_owned(),
        format!("name={}", in_quotes(&method.name)),
    ];
    if let Some(names) = families {
        let names: Vec<_> = names.iter().map(|name| in_quotes(name)).collect();
        words.push(format!("families=[{}]", names.join(", ")));
    }
    words.extend(has_own.then(|| "own=own".to_owned()));
    words.push(format!("count={count}"));
    words.push(format!("seed={seed}"));
    let Tolerance { near, late } = method.tolerance;
    let tolerances = [("near", near), ("late", late)].into_iter();
    let tolerances = tolerances.filter(|(_, value)| *value > 0.0);
    words.extend(tolerances.map(|(name, value)| format!("{name}={value:e}")));
    format!("tunnelproof.certify({})", words.join(", "))
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
    (
        Results::new(findings).text(),
        table::text(findings, Shown::SUMMARY),
        table::text(findings, Shown::EVERYTHING),
        page::certificate(findings),
    )
}

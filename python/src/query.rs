//! One query: what is true of it, in text and as a picture, how near its two sides come, and the smallest one on
//! which a method is wrong in the same way.

use std::io::Cursor;

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tunnelproof::narrow::Tolerance;
use tunnelproof::query::Query;
use tunnelproof_cli::report::picture;
use tunnelproof_float_env::with_default;
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::corpus::locate::locate as by_name;
use tunnelproof_reference::corpus::{self, CorpusError, Entry, Format, Problem, ReadOptions};
use tunnelproof_reference::oracle::{decide_query, least_gap_to};
use tunnelproof_reference::registry;
use tunnelproof_reference::report::explanation::Explanation;
use tunnelproof_reference::shrink::Disagreement;
use tunnelproof_reference::subject::Subject;

use crate::interrupt::each;
use crate::method::{Method, tolerance};
use crate::queries::{self, Rows, row};

/// Points of shape `(8, 3)` and radii of shape `(2,)`.
type Numbers<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>);

fn numbers<'py>(py: Python<'py>, query: &Query) -> PyResult<Numbers<'py>> {
    let (points, radii) = row(query);
    let points = PyArray1::from_vec(py, points.as_flattened().to_vec()).reshape([8, 3])?;
    Ok((points, PyArray1::from_slice(py, &radii)))
}

/// The single query of two arrays.
fn single(
    kind: &str,
    points: &PyReadonlyArray3<'_, f64>,
    radii: &PyReadonlyArray2<'_, f64>,
) -> PyResult<Query> {
    let kind = queries::kind(kind)?;
    let rows = Rows::new(points, radii)?;
    match with_default(|| rows.queries(kind))?[..] {
        [query] => Ok(query),
        ref queries => {
            let message = format!("{} queries in place of one", queries.len());
            Err(PyValueError::new_err(message))
        }
    }
}

/// Text on a query, and what every subject and a callable say of it, if there is one.
#[pyfunction]
#[pyo3(signature = (kind, points, radii, method))]
pub(crate) fn explain(
    py: Python<'_>,
    kind: &str,
    points: PyReadonlyArray3<'_, f64>,
    radii: PyReadonlyArray2<'_, f64>,
    method: Option<(String, Py<PyAny>)>,
) -> PyResult<String> {
    let query = single(kind, &points, &radii)?;
    let method = method.map(|(name, call)| Method::new(name, call, Tolerance::NONE));
    let own = method.iter().map(|method| method as &dyn Subject);
    let subjects = registry::subjects().into_iter().chain(own);
    let subjects: Vec<_> = subjects
        .map(|subject| Judged {
            subject,
            explain: None,
        })
        .collect();
    let text = || Explanation::new(&query, &subjects).to_string();
    let text = py.detach(|| with_default(text));
    method.map_or(Ok(()), Method::finish)?;
    Ok(text)
}

/// The picture of a query, an SVG document.
#[pyfunction]
pub(crate) fn draw(
    py: Python<'_>,
    title: &str,
    kind: &str,
    points: PyReadonlyArray3<'_, f64>,
    radii: PyReadonlyArray2<'_, f64>,
) -> PyResult<String> {
    let query = single(kind, &points, &radii)?;
    let drawn = || picture::draw(title, &query, &decide_query(&query));
    Ok(py.detach(|| with_default(drawn)))
}

/// Between which two numbers the gap of each query is, of shape `(n, 2)`.
#[pyfunction]
pub(crate) fn gap<'py>(
    py: Python<'py>,
    kind: &str,
    points: PyReadonlyArray3<'py, f64>,
    radii: PyReadonlyArray2<'py, f64>,
    width: f64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    if !(width >= 0.0 && width.is_finite()) {
        let message = format!("width is {width}, not a number from 0");
        return Err(PyValueError::new_err(message));
    }
    let kind = queries::kind(kind)?;
    let rows = Rows::new(&points, &radii)?;
    let ends = |query: &Query| {
        let gap = least_gap_to(query, width);
        [gap.below, gap.above]
    };
    let gaps = with_default(|| {
        let queries = py.detach(|| rows.queries(kind))?;
        each(py, &queries, ends)
    })?;
    let count = gaps.len();
    PyArray1::from_vec(py, gaps.into_flattened()).reshape([count, 2])
}

/// The query that has this name, such as `lattice:1:4711`, or is this line of JSON: its name, kind and numbers.
#[pyfunction]
pub(crate) fn locate<'py>(
    py: Python<'py>,
    text: &str,
) -> PyResult<(String, &'static str, Numbers<'py>)> {
    let entry = with_default(|| match text.trim_start().starts_with('{') {
        true => line(text),
        false => by_name(text, ReadOptions::default()),
    });
    let entry = entry.map_err(|error| PyValueError::new_err(error.to_string()))?;
    let numbers = numbers(py, &entry.query)?;
    Ok((entry.id, entry.query.kind().name(), numbers))
}

fn line(text: &str) -> Result<Entry, CorpusError> {
    let lines = Cursor::new(text.to_owned());
    let mut entries = corpus::read(lines, "query", Some(Format::Jsonl), ReadOptions::default())?;
    let none = || Err(CorpusError::new("query", Problem::Empty));
    entries.next().unwrap_or_else(none)
}

/// What is wrong, the numbers of the smallest query, how many were tried, and whether the search ended by itself.
type Found<'py> = (&'static str, Numbers<'py>, u64, bool);

/// The smallest query on which a callable is wrong in the same way. Nothing if it is right.
#[pyfunction]
#[allow(
    clippy::too_many_arguments,
    reason = "called from one place, which names them"
)]
pub(crate) fn shrink<'py>(
    py: Python<'py>,
    call: Py<PyAny>,
    near: f64,
    late: f64,
    kind: &str,
    points: PyReadonlyArray3<'py, f64>,
    radii: PyReadonlyArray2<'py, f64>,
    calls: u64,
) -> PyResult<Option<Found<'py>>> {
    let query = single(kind, &points, &radii)?;
    let method = Method::new("method".to_owned(), call, tolerance(near, late)?);
    let shrunk = || {
        let disagreement = Disagreement::with_oracle(&method);
        // The oracle takes every query.
        let fault = disagreement.fault(&query).ok().flatten()?;
        Some((fault, disagreement.shrink(&query, fault, calls)))
    };
    let shrunk = method.watched(py, shrunk);
    method.finish()?;
    let Some((fault, shrunk)) = shrunk else {
        return Ok(None);
    };
    let numbers = numbers(py, &shrunk.query)?;
    Ok(Some((
        fault.name(),
        numbers,
        shrunk.calls,
        shrunk.is_minimal,
    )))
}

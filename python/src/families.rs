//! The families of queries as arrays.

use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tunnelproof_float_env::with_default;
use tunnelproof_reference::generate;

use crate::queries::row;

/// Name, kind and description of every family.
#[pyfunction]
pub(crate) fn families() -> Vec<(&'static str, &'static str, &'static str)> {
    let row = |family: &'static generate::Family| {
        let kind = family.query(0, 0).kind().name();
        (family.name(), kind, family.description())
    };
    with_default(|| generate::all().map(row).collect())
}

/// Points of shape `(count, 8, 3)` and radii of shape `(count, 2)`.
type Arrays<'py> = (Bound<'py, PyArray3<f64>>, Bound<'py, PyArray2<f64>>);

/// Queries of a family.
#[pyfunction]
pub(crate) fn family<'py>(
    py: Python<'py>,
    name: &str,
    seed: u64,
    start: u64,
    count: usize,
) -> PyResult<Arrays<'py>> {
    let family = generate::by_name(name)
        .ok_or_else(|| PyValueError::new_err(format!("there is no family {name:?}")))?;
    let (points, radii): (Vec<_>, Vec<_>) = py.detach(|| {
        let queries = (start..).take(count).map(|index| family.query(seed, index));
        with_default(|| queries.map(|query| row(&query)).unzip())
    });
    let points = PyArray1::from_vec(py, points.into_flattened().into_flattened());
    let radii = PyArray1::from_vec(py, radii.into_flattened());
    Ok((points.reshape([count, 8, 3])?, radii.reshape([count, 2])?))
}

//! The families of queries as arrays.

use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods};
use pyo3::exceptions::{PyMemoryError, PyValueError};
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

/// How many queries are made before signals are looked for.
const BLOCK: usize = 1024;

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
    let end = start.checked_add(count as u64).ok_or_else(|| {
        let message =
            format!("start is {start} and count {count}; queries have numbers below 2**64");
        PyValueError::new_err(message)
    })?;
    let (mut points, mut radii) = (room(count)?, room(count)?);
    for block in (start..end).step_by(BLOCK) {
        let indices = block..end.min(block.saturating_add(BLOCK as u64));
        let made = || {
            indices.for_each(|index| {
                let (corners, radius) = row(&family.query(seed, index));
                points.push(corners);
                radii.push(radius);
            })
        };
        py.detach(|| with_default(made));
        py.check_signals()?;
    }
    let points = PyArray1::from_vec(py, points.into_flattened().into_flattened());
    let radii = PyArray1::from_vec(py, radii.into_flattened());
    Ok((points.reshape([count, 8, 3])?, radii.reshape([count, 2])?))
}

/// Room for so many.
fn room<T>(count: usize) -> PyResult<Vec<T>> {
    let mut room = Vec::new();
    let refuse = |_| PyMemoryError::new_err(format!("there is no memory for {count} queries"));
    room.try_reserve_exact(count).map_err(refuse)?;
    Ok(room)
}

//! The exact oracle on arrays.

use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use tunnelproof::contact::ContactKind;
use tunnelproof_reference::answer::{Enclosure, ExactHit};
use tunnelproof_reference::{field, oracle};

use crate::columns::Columns;
use crate::queries::{self, Refused, Rows};

/// The columns of `ExactContacts`.
#[pyfunction]
pub(crate) fn exact<'py>(
    py: Python<'py>,
    kind: &str,
    points: PyReadonlyArray3<'py, f64>,
    radii: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let kind = queries::kind(kind)?;
    let rows = Rows::new(&points, &radii)?;
    let hits = py.detach(|| {
        let queries = rows.queries(kind)?;
        let exact = |query| oracle::decide::<field::Default>(query).written().hit;
        Ok::<_, Refused>(queries.par_iter().map(exact).collect::<Vec<_>>())
    })?;
    let ends = |x: Enclosure| [x.below, x.above];
    let mut columns = Columns::new(py, &hits);
    columns.numbers("toi", |hit: &ExactHit| ends(hit.toi))?;
    columns.numbers("u", |hit| ends(hit.first.u))?;
    columns.numbers("v", |hit| ends(hit.first.v))?;
    columns.flags("is_crossing", |hit| hit.kind == ContactKind::Crossing)?;
    columns.flags("crosses", |hit| hit.crosses)?;
    columns.sides(|hit| hit.side)?;
    Ok(columns.dict)
}

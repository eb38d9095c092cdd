//! The exact oracle on arrays.

use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::query::{Query, QueryKind};
use tunnelproof_float_env::with_default;
use tunnelproof_reference::answer::{Enclosure, ExactHit};
use tunnelproof_reference::{field, oracle};

use crate::columns::{self, Columns};
use crate::interrupt::each;
use crate::queries::{self, Rows};

/// The columns of `ExactHits`.
#[pyfunction]
pub(crate) fn exact<'py>(
    py: Python<'py>,
    kind: &str,
    points: PyReadonlyArray3<'py, f64>,
    radii: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let kind = queries::kind(kind)?;
    let rows = Rows::new(&points, &radii)?;
    with_default(|| written(py, kind, rows))
}

fn written(py: Python<'_>, kind: QueryKind, rows: Rows) -> PyResult<Bound<'_, PyDict>> {
    let queries = py.detach(|| rows.queries(kind))?;
    let exact = |query: &Query| oracle::decide::<field::Default>(query).written().hit;
    let hits = each(py, &queries, exact)?;
    let ends = |x: Enclosure| [x.below, x.above];
    let mut columns = Columns::new(py, &hits);
    columns.flags("hit", |_| true)?;
    columns.numbers("toi", |hit: &ExactHit| ends(hit.toi))?;
    columns.codes("kind", |hit| columns::kind(hit.kind))?;
    columns.flags("crosses", |hit| hit.crosses)?;
    columns.codes("side", |hit| hit.side)?;
    columns.numbers("weights", |hit| {
        let ([a, b], [c, d]) = (ends(hit.first.u), ends(hit.first.v));
        [a, b, c, d]
    })?;
    Ok(columns.dict)
}

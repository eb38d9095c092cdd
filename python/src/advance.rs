//! The certified step of pairs on arrays.

use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::{Advance, Blocked, Clearance, Query};
use tunnelproof_float_env::with_default;

use crate::columns::Columns;
use crate::interrupt::each;
use crate::queries::{self, Refused, Rows};

/// The columns of `Advances`.
#[pyfunction]
pub(crate) fn advance<'py>(
    py: Python<'py>,
    kind: &str,
    points: PyReadonlyArray3<'py, f64>,
    radii: PyReadonlyArray2<'py, f64>,
    clearance: f64,
    share: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    with_default(|| advanced(py, kind, Rows::new(&points, &radii)?, clearance, share))
}

fn advanced<'py>(
    py: Python<'py>,
    kind: &str,
    rows: Rows,
    clearance: f64,
    share: Option<f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let kind = queries::kind(kind)?;
    let clearance = self::clearance(clearance, share)?;
    let advanced = |query: &Query| match query {
        Query::EdgeEdge(query) => tunnelproof::advance(query, clearance),
        Query::VertexFace(query) => tunnelproof::advance(query, clearance),
    };
    let queries = py.detach(|| rows.queries(kind))?;
    let advances = each(py, &queries, advanced)?.into_iter();
    let advances: Result<Vec<_>, _> = advances.map(|advance| advance.map(Some)).collect();
    let advances = advances.map_err(|error| Refused::new(&error))?;
    let mut columns = Columns::new(py, &advances);
    columns.numbers("step", |advance: &Advance| [advance.step])?;
    columns.numbers("points", |advance| {
        let [a, b, c, d] = advance.points.map(<[f64; 3]>::from);
        std::array::from_fn::<_, 12, _>(|i| [a, b, c, d][i / 3][i % 3])
    })?;
    columns.numbers("kept", |advance| {
        advance.kept.map_or([f64::NAN; 2], |kept| kept.parts())
    })?;
    columns.codes("blocked", |advance| blocked(advance.blocked))?;
    Ok(columns.dict)
}

/// A clearance from the arguments of Python.
pub(crate) fn clearance(distance: f64, share: Option<f64>) -> PyResult<Clearance> {
    match share {
        None if distance == 0.0 => Ok(Clearance::None),
        None => Ok(Clearance::Distance(distance)),
        Some(share) if distance == 0.0 => Ok(Clearance::Share(share)),
        Some(share) => Err(PyValueError::new_err(format!(
            "clearance is {distance} and share is {share}; give one of them"
        ))),
    }
}

/// The value of `Blocked` in Python.
pub(crate) fn blocked(blocked: Option<Blocked>) -> i8 {
    match blocked {
        None => 0,
        Some(Blocked::Ahead) => 1,
        Some(Blocked::Near) => 2,
        Some(Blocked::Touching) => 3,
        // The engine may come to know others.
        Some(_) => -1,
    }
}

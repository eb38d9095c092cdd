//! The certified step of pairs on arrays.

use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::{Advance, Blocked, Clearance, Precision, Query, QueryKind, advance_in};
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
    precision: &str,
) -> PyResult<Bound<'py, PyDict>> {
    with_default(|| {
        let rows = Rows::new(&points, &radii)?;
        let kind = queries::kind(kind)?;
        let clearance = self::clearance(clearance, share)?;
        advanced(py, kind, rows, clearance, self::precision(precision)?)
    })
}

fn advanced<'py>(
    py: Python<'py>,
    kind: QueryKind,
    rows: Rows,
    clearance: Clearance,
    precision: Precision,
) -> PyResult<Bound<'py, PyDict>> {
    let advanced = |query: &Query| match query {
        Query::EdgeEdge(query) => advance_in(query, clearance, precision),
        Query::VertexFace(query) => advance_in(query, clearance, precision),
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

/// A precision from its name in Python.
pub(crate) fn precision(name: &str) -> PyResult<Precision> {
    match name {
        "f64" => Ok(Precision::F64),
        "f32" => Ok(Precision::F32),
        _ => Err(PyValueError::new_err(format!(
            "precision is {name:?}, neither \"f64\" nor \"f32\""
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

//! Certified steps on arrays.

use numpy::{Element, PyArray1, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::{
    Advance, Blocked, Clearance, Coordinate, Precision, Query, QueryKind, Radius, advance_in,
};
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

/// The fields of a step of all points: its size, the positions, the pairs that end it, and those that
/// are near. `pair` writes the columns of pairs.
pub(crate) fn together<'py, P, C: Coordinate + Element>(
    py: Python<'py>,
    step: f64,
    positions: Vec<[C; 3]>,
    limits: impl IntoIterator<Item = (P, Blocked)>,
    near: impl IntoIterator<Item = (P, Radius)>,
    pair: impl Fn(&mut Columns<'_, 'py, P>) -> PyResult<()>,
) -> PyResult<Bound<'py, PyDict>> {
    let (limits, why): (Vec<_>, Vec<_>) = limits
        .into_iter()
        .map(|(pair, why)| (Some(pair), Some(why)))
        .unzip();
    let (near, kept): (Vec<_>, Vec<_>) = near
        .into_iter()
        .map(|(pair, kept)| (Some(pair), Some(kept)))
        .unzip();
    let mut of_limits = Columns::new(py, &limits);
    pair(&mut of_limits)?;
    let mut of_limits = of_limits.of(&why);
    of_limits.codes("blocked", |why| blocked(Some(*why)))?;
    let mut of_near = Columns::new(py, &near);
    pair(&mut of_near)?;
    let mut of_near = of_near.of(&kept);
    of_near.numbers("kept", Radius::parts)?;
    let fields = PyDict::new(py);
    fields.set_item("step", step)?;
    let count = positions.len();
    let positions = PyArray1::from_vec(py, positions.into_flattened());
    fields.set_item("positions", positions.reshape([count, 3])?)?;
    fields.set_item("limits", of_limits.dict)?;
    fields.set_item("near", of_near.dict)?;
    Ok(fields)
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
fn precision(name: &str) -> PyResult<Precision> {
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
        Some(Blocked::Rounding) => 2,
        Some(Blocked::Touching) => 3,
        // The engine may come to know others.
        Some(_) => -1,
    }
}

//! Queries from arrays.

use numpy::ndarray::ArrayView1;
use numpy::{PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tunnelproof::query::{Point, Query, QueryKind, Radius};

/// Points of shape `(n, 8, 3)` and radii of shape `(n, 2)`, copied out of NumPy, so that Python can run while
/// they are worked on.
pub(crate) struct Rows(Vec<([[f64; 3]; 8], [f64; 2])>);

impl Rows {
    /// The rows of two arrays, whose shapes the Python side has made sure of.
    pub(crate) fn new(
        points: &PyReadonlyArray3<'_, f64>,
        radii: &PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Self> {
        let (points, radii) = (points.as_array(), radii.as_array());
        if points.shape()[1..] != [8, 3] || radii.shape() != [points.shape()[0], 2] {
            return Err(PyValueError::new_err(format!(
                "points are {:?} and radii {:?}, not (n, 8, 3) and (n, 2)",
                points.shape(),
                radii.shape()
            )));
        }
        let rows = points.outer_iter().zip(radii.outer_iter());
        let rows = rows.map(|(points, radii)| {
            let corners = std::array::from_fn(|i| std::array::from_fn(|h| points[[i, h]]));
            (corners, pair(&radii))
        });
        Ok(Rows(rows.collect()))
    }

    /// The queries, or the first that is none.
    pub(crate) fn queries(self, kind: QueryKind) -> Result<Vec<Query>, Refused> {
        let query = |(index, (corners, radii)): (usize, ([[f64; 3]; 8], [f64; 2]))| {
            let [a, b, c, d, e, f, g, h] = corners.map(Point::from);
            Query::new(kind, [a, b, c, d], [e, f, g, h], Radius::from(radii))
                .map_err(|error| Refused(format!("query {index}: {error}")))
        };
        self.0.into_iter().enumerate().map(query).collect()
    }
}

/// Positions at both ends of a step, of shape `(n, 3)`, of the same type both.
#[derive(FromPyObject)]
pub(crate) enum Ends<'py> {
    Double(PyReadonlyArray2<'py, f64>, PyReadonlyArray2<'py, f64>),
    Single(PyReadonlyArray2<'py, f32>, PyReadonlyArray2<'py, f32>),
}

/// Asks about positions of either type.
macro_rules! of_either {
    ($ends:expr, ($start:ident, $end:ident) => $asked:expr) => {
        match $ends {
            $crate::queries::Ends::Double($start, $end) => $asked,
            $crate::queries::Ends::Single($start, $end) => $asked,
        }
    };
}

pub(crate) use of_either;

/// The rows of an array of shape `(n, N)`, where they are.
pub(crate) fn rows<'a, T: numpy::Element, const N: usize>(
    name: &str,
    array: &'a PyReadonlyArray2<'_, T>,
) -> PyResult<&'a [[T; N]]> {
    let shape = array.shape();
    let is_wide = shape[1] == N;
    match array.as_slice() {
        Ok(all) if is_wide && array.is_c_contiguous() => Ok(all.as_chunks().0),
        _ => Err(PyValueError::new_err(format!(
            "{name} has the shape {shape:?}, not (n, {N}) without gaps"
        ))),
    }
}

fn pair(row: &ArrayView1<'_, f64>) -> [f64; 2] {
    [row[0], row[1]]
}

/// The points and the radii of a query, as they stand in arrays.
pub(crate) fn row(query: &Query) -> ([[f64; 3]; 8], [f64; 2]) {
    let point = |i: usize| {
        let half = if i < 4 { query.start() } else { query.end() };
        half[i % 4].into()
    };
    (std::array::from_fn(point), query.radius().parts())
}

/// What is wrong with a query.
pub(crate) struct Refused(String);

impl Refused {
    pub(crate) fn new(error: &impl std::fmt::Display) -> Self {
        Refused(error.to_string())
    }
}

impl From<Refused> for PyErr {
    fn from(Refused(text): Refused) -> Self {
        PyValueError::new_err(text)
    }
}

/// `edge-edge` or `vertex-face`.
pub(crate) fn kind(name: &str) -> PyResult<QueryKind> {
    [QueryKind::EdgeEdge, QueryKind::VertexFace]
        .into_iter()
        .find(|kind| kind.name() == name)
        .ok_or_else(|| {
            PyValueError::new_err(format!(
                "kind is {name:?}, neither \"edge-edge\" nor \"vertex-face\""
            ))
        })
}

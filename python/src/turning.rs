//! Bodies that turn, on arrays.

use numpy::ndarray::{ArrayView1, ArrayView2, ArrayView3};
use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::certified::RigidKind;
use tunnelproof::contact::Place;
use tunnelproof::nalgebra::Quaternion;
use tunnelproof::rigid::{EdgeTurningEdge, Pose, RigidError, RigidMotion, VertexTurningFace};
use tunnelproof::{Hit, Point, Radius};
use tunnelproof_float_env::with_default;

use crate::certified::{Row, columns};
use crate::interrupt::each;
use crate::queries::Refused;

/// The columns of `Hits`, of arrays whose shapes the Python side has made sure of.
#[pyfunction]
pub(crate) fn decide_rigid<'py>(
    py: Python<'py>,
    kind: &str,
    points: PyReadonlyArray3<'py, f64>,
    local: PyReadonlyArray3<'py, f64>,
    poses: PyReadonlyArray3<'py, f64>,
    radii: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let arrays = Arrays {
        points: points.as_array(),
        local: local.as_array(),
        poses: poses.as_array(),
        radii: radii.as_array(),
    };
    with_default(|| match kind {
        "edge-turning-edge" => written::<EdgeTurningEdge>(py, &arrays),
        "vertex-turning-face" => written::<VertexTurningFace>(py, &arrays),
        _ => Err(PyValueError::new_err(format!(
            "kind is {kind:?}, neither \"edge-turning-edge\" nor \"vertex-turning-face\""
        ))),
    })
}

/// Points of shape `(n, 2 a, 3)`, with `a` points in space, points of the body of shape `(n, 4 - a, 3)`, poses of shape
/// `(n, 2, 7)` and radii of shape `(n, 2)`.
struct Arrays<'a> {
    points: ArrayView3<'a, f64>,
    local: ArrayView3<'a, f64>,
    poses: ArrayView3<'a, f64>,
    radii: ArrayView2<'a, f64>,
}

/// A kind of query about a body that turns.
trait Turning: RigidKind {
    /// How many of the four points are in space.
    const WORLD: usize;

    fn new(
        points: &[Point],
        local: &[Point],
        motion: RigidMotion,
        radius: Radius,
    ) -> Result<Self, RigidError>;

    fn point(&self, weights: &[f64; 4], t: f64) -> Point;
}

impl Turning for EdgeTurningEdge {
    const WORLD: usize = 2;

    fn new(
        points: &[Point],
        local: &[Point],
        motion: RigidMotion,
        radius: Radius,
    ) -> Result<Self, RigidError> {
        let (start, end) = ([points[0], points[1]], [points[2], points[3]]);
        EdgeTurningEdge::with_radius(start, end, [local[0], local[1]], motion, radius)
    }

    fn point(&self, weights: &[f64; 4], t: f64) -> Point {
        self.point(weights, t)
    }
}

impl Turning for VertexTurningFace {
    const WORLD: usize = 1;

    fn new(
        points: &[Point],
        local: &[Point],
        motion: RigidMotion,
        radius: Radius,
    ) -> Result<Self, RigidError> {
        let corners = [local[0], local[1], local[2]];
        VertexTurningFace::with_radius([points[0]], [points[1]], corners, motion, radius)
    }

    fn point(&self, weights: &[f64; 4], t: f64) -> Point {
        self.point(weights, t)
    }
}

impl Arrays<'_> {
    /// How many queries there are.
    fn count<K: Turning>(&self) -> PyResult<usize> {
        let count = self.points.shape()[0];
        let expected = [
            [count, 2 * K::WORLD, 3],
            [count, 4 - K::WORLD, 3],
            [count, 2, 7],
        ];
        let shapes = [&self.points, &self.local, &self.poses].map(|array| array.shape());
        match shapes == expected && self.radii.shape() == [count, 2] {
            true => Ok(count),
            false => Err(PyValueError::new_err(format!(
                "points, local and poses have the shapes {shapes:?}, not {expected:?}"
            ))),
        }
    }

    fn query<K: Turning>(&self, index: usize) -> Result<K, Refused> {
        let points = |array: &ArrayView3<'_, f64>| -> Vec<Point> {
            let rows = array.index_axis(numpy::ndarray::Axis(0), index);
            rows.outer_iter().map(|row| point(&row)).collect()
        };
        let pose = |at: usize| {
            let number = |i: usize| self.poses[[index, at, i]];
            let centre = Point::new(number(0), number(1), number(2));
            Pose::new(
                centre,
                Quaternion::new(number(3), number(4), number(5), number(6)),
            )
        };
        let radius = Radius::from([self.radii[[index, 0]], self.radii[[index, 1]]]);
        RigidMotion::new(pose(0), pose(1))
            .and_then(|motion| K::new(&points(&self.points), &points(&self.local), motion, radius))
            .map_err(|error| Refused::new(&format!("query {index}: {error}")))
    }
}

fn point(row: &ArrayView1<'_, f64>) -> Point {
    Point::new(row[0], row[1], row[2])
}

fn written<'py, K: Turning>(py: Python<'py>, arrays: &Arrays<'_>) -> PyResult<Bound<'py, PyDict>> {
    let indices = 0..arrays.count::<K>()?;
    // Copied out of NumPy, so that Python can run while they are decided.
    let queries: Result<Vec<K>, Refused> = indices.map(|index| arrays.query(index)).collect();
    let queries = queries?;
    let row = |query: &K| Some(row(query, tunnelproof::decide_rigid(query)?));
    columns(py, &each(py, &queries, row)?)
}

/// A hit with its points in space. There is no normal.
fn row<K: Turning>(query: &K, hit: Hit<K::Place>) -> Row {
    let hit: Hit<Place> = hit.map_place(Into::into);
    let contact = |weights| (weights, query.point(&weights, hit.toi));
    let (first, second) = hit.place.weights();
    Row {
        hit,
        first: contact(first),
        second: second.map(contact),
        normal: None,
    }
}

//! Bodies that turn, on arrays.

use numpy::ndarray::{ArrayView1, ArrayView2, ArrayView3};
use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::contact::Place;
use tunnelproof::nalgebra::Quaternion;
use tunnelproof::rigid::{Lengths, Pose, RigidQuery, RigidQueryKind};
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
    let kind = RigidQueryKind::from_name(kind).ok_or_else(|| {
        let problem = format!("kind is {kind:?}, which is no kind of query of bodies that turn");
        PyValueError::new_err(problem)
    })?;
    with_default(|| written(py, kind, &arrays))
}

/// Of the [`shapes`] of the kind, and radii of shape `(n, 2)`.
struct Arrays<'a> {
    points: ArrayView3<'a, f64>,
    local: ArrayView3<'a, f64>,
    poses: ArrayView3<'a, f64>,
    radii: ArrayView2<'a, f64>,
}

/// The shapes of so many queries: points in space, points of bodies, poses.
fn shapes(kind: RigidQueryKind, count: usize) -> [[usize; 3]; 3] {
    let Lengths {
        points,
        local,
        poses,
    } = kind.lengths();
    [[count, points, 3], [count, local, 3], [count, poses, 7]]
}

impl Arrays<'_> {
    /// How many queries there are.
    fn count(&self, kind: RigidQueryKind) -> PyResult<usize> {
        let count = self.local.shape()[0];
        let expected = shapes(kind, count);
        let shapes = [&self.points, &self.local, &self.poses].map(|array| array.shape());
        match shapes == expected && self.radii.shape() == [count, 2] {
            true => Ok(count),
            false => Err(PyValueError::new_err(format!(
                "points, local and poses have the shapes {shapes:?}, not {expected:?}"
            ))),
        }
    }

    fn query(&self, kind: RigidQueryKind, index: usize) -> Result<RigidQuery, Refused> {
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
        let poses: Vec<Pose> = (0..self.poses.shape()[1]).map(pose).collect();
        let radius = Radius::from([self.radii[[index, 0]], self.radii[[index, 1]]]);
        let (points, local) = (points(&self.points), points(&self.local));
        RigidQuery::from_lists(kind, &points, &local, &poses, radius)
            .map_err(|error| Refused::new(&format!("query {index}: {error}")))
    }
}

fn point(row: &ArrayView1<'_, f64>) -> Point {
    Point::new(row[0], row[1], row[2])
}

fn written<'py>(
    py: Python<'py>,
    kind: RigidQueryKind,
    arrays: &Arrays<'_>,
) -> PyResult<Bound<'py, PyDict>> {
    let indices = 0..arrays.count(kind)?;
    // Copied out of NumPy, so that Python can run while they are decided.
    let queries: Result<Vec<RigidQuery>, Refused> =
        indices.map(|index| arrays.query(kind, index)).collect();
    let queries = queries?;
    let row = |query: &RigidQuery| Some(row(query, tunnelproof::decide_rigid(query)?));
    columns(py, &each(py, &queries, row)?)
}

/// A hit with its points and its normal in space.
fn row(query: &RigidQuery, hit: Hit<Place>) -> Row {
    let contact = |weights| (weights, query.point(&weights, hit.toi));
    let (first, second) = hit.place.weights();
    Row {
        normal: hit.normal(query),
        first: contact(first),
        second: second.map(contact),
        hit,
    }
}

//! Boxes of points, by which a broad phase would leave pairs out.

use nalgebra::Vector3;
use tunnelproof::query::Point;

/// The least and the largest coordinates.
pub(crate) type Bounds = [Vector3<f64>; 2];

/// The box of points with a margin around it.
pub(crate) fn bounds(points: impl IntoIterator<Item = Point>, margin: f64) -> Bounds {
    let empty = [
        Vector3::repeat(f64::INFINITY),
        Vector3::repeat(f64::NEG_INFINITY),
    ];
    let [low, high] = points.into_iter().fold(empty, |[low, high], p| {
        [low.inf(&p.coords), high.sup(&p.coords)]
    });
    [low.add_scalar(-margin), high.add_scalar(margin)]
}

/// Whether two have a point in common.
pub(crate) fn overlap([a, b]: &Bounds, [c, d]: &Bounds) -> bool {
    (0..3).all(|axis| a[axis] <= d[axis] && c[axis] <= b[axis])
}

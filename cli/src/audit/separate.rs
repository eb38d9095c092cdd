//! What is certainly apart, by separating axes, so that the oracle need not be asked.

use nalgebra::Vector3;

type Vector = Vector3<f64>;

/// Whether the box of some points, grown by `stray`, does not meet another box.
pub(super) fn are_boxes_apart(points: &[Vector], stray: f64, low: &Vector, high: &Vector) -> bool {
    (0..3).any(|axis| {
        let below = points.iter().all(|point| point[axis] + stray < low[axis]);
        below || points.iter().all(|point| point[axis] - stray > high[axis])
    })
}

/// Whether a node that goes from one place to another, or at most `stray` beside the line between, is
/// apart from a face.
pub(super) fn is_node_apart(way: &[Vector; 2], face: &[Vector; 3], stray: f64) -> bool {
    let normal = (face[1] - face[0]).cross(&(face[2] - face[0]));
    let sides = [0, 1, 2].map(|k: usize| (face[(k + 1) % 3] - face[k]).cross(&normal));
    let axes = [normal, sides[0], sides[1], sides[2]];
    let low = face[0].inf(&face[1]).inf(&face[2]);
    let high = face[0].sup(&face[1]).sup(&face[2]);
    are_boxes_apart(way, stray, &low, &high) || are_separated(way, face, stray, &axes)
}

/// Whether a segment, of which both nodes go from the first two places to the last two, or at most
/// `stray` beside the lines between, is apart from an edge.
pub(super) fn is_segment_apart(way: &[Vector; 4], edge: &[Vector; 2], stray: f64) -> bool {
    let along = edge[1] - edge[0];
    let [first, last] = [way[1] - way[0], way[3] - way[2]];
    let moved = [way[2] - way[0], way[3] - way[1]];
    let axes = [
        first.cross(&last),
        first.cross(&along),
        last.cross(&along),
        moved[0].cross(&along),
        moved[1].cross(&along),
        first.cross(&moved[0]),
        first.cross(&moved[1]),
    ];
    let (low, high) = (edge[0].inf(&edge[1]), edge[0].sup(&edge[1]));
    are_boxes_apart(way, stray, &low, &high) || are_separated(way, edge, stray, &axes)
}

/// Whether one of some axes separates two convex hulls by more than `stray`, which is more than all
/// roundings here; an axis so short that its products are subnormal does not.
fn are_separated(points: &[Vector], others: &[Vector], stray: f64, axes: &[Vector]) -> bool {
    axes.iter().any(|axis| {
        let margin = stray * axis.norm();
        let gap = gap(axis, points, others).max(gap(axis, others, points));
        margin.is_normal() && gap > margin
    })
}

/// How far some points are beyond others along an axis; below 0 if some are not.
pub(super) fn gap(axis: &Vector, points: &[Vector], others: &[Vector]) -> f64 {
    let along = |points: &[Vector], least: fn(f64, f64) -> f64, from: f64| {
        points.iter().map(|point| axis.dot(point)).fold(from, least)
    };
    along(points, f64::min, f64::INFINITY) - along(others, f64::max, f64::NEG_INFINITY)
}

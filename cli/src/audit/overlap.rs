//! Whether two cores overlap where a step starts, in exact integers.

use num_bigint::Sign;
use tunnelproof::query::Point;
use tunnelproof::rigid::Pose;

use super::core::{Core, ROUNDING, Surface};
use super::inside::{is_inside, seen};
use super::integers::{Exact, Space, volume};
use super::pairs::{are_apart, corners};

/// A body whose core is looked at.
#[derive(Clone, Copy)]
struct Body<'a> {
    surface: &'a Surface,
    pose: &'a Pose,
}

/// Whether two cores overlap: an edge of one goes through a face of the other, strictly inside both, or
/// a vertex of one is inside the other. Surfaces that only touch do not.
pub(super) fn overlap(cores: [&Core; 2], poses: [&Pose; 2]) -> bool {
    if holds(cores, poses, [0, 1]) || holds(cores, poses, [1, 0]) {
        return true;
    }
    let [Core::Surface(a), Core::Surface(b)] = cores else {
        return false;
    };
    let [a, b] = [(a, poses[0]), (b, poses[1])].map(|(surface, pose)| Body { surface, pose });
    goes_through(a, b) || goes_through(b, a)
}

/// Whether the first of two bodies has a vertex of the second one inside.
fn holds(cores: [&Core; 2], poses: [&Pose; 2], [body, other]: [usize; 2]) -> bool {
    let Core::Surface(surface) = cores[other] else {
        return false;
    };
    let mut vertices = corners(&surface.faces).into_iter();
    vertices.any(|vertex| is_inside(cores[body], poses[body], &vertex, poses[other]))
}

/// Whether an edge of the first body goes through a face of the second one. Those that are apart by
/// more than what is rounded are left out before.
fn goes_through(first: Body<'_>, second: Body<'_>) -> bool {
    let extents = [first, second].map(|Body { surface, .. }| surface.extent());
    let apart = first.pose.centre - second.pose.centre;
    let margin = ROUNDING * (apart.amax() + extents[0] + extents[1]);
    let Surface { low, high, .. } = second.surface;
    let edges = first.surface.edges.iter();
    let edges = edges.map(|edge| {
        let ends = edge.each_ref();
        (edge, ends.map(|end| seen(end, first.pose, second.pose)))
    });
    let mut edges = edges.filter(|(_, [p, q])| {
        let meets = |axis: usize| {
            p[axis].min(q[axis]) <= high[axis] + margin
                && p[axis].max(q[axis]) >= low[axis] - margin
        };
        (0..3).all(meets)
    });
    edges.any(|(edge, ends)| {
        let is_near = |face: &&[Point; 3]| {
            let corners = face.map(|corner| corner.coords);
            !are_apart(&ends, &corners, margin)
        };
        let mut faces = second.surface.faces.iter().filter(is_near);
        faces.any(|face| {
            let space = Space::new([first.pose, second.pose], &[edge, face]);
            space.is_some_and(|space| {
                let ends = edge.map(|end| space.place(0, &end));
                pierces(&ends, &face.map(|corner| space.place(1, &corner)))
            })
        })
    })
}

/// Whether a piece of a line goes through a triangle, strictly inside both.
fn pierces([p, q]: &[Exact; 2], [b, c, d]: &[Exact; 3]) -> bool {
    let around = [volume(p, q, b, c), volume(p, q, c, d), volume(p, q, d, b)];
    let is_inside = around == [Sign::Plus; 3] || around == [Sign::Minus; 3];
    is_inside && volume(b, c, d, p) * volume(b, c, d, q) == Sign::Minus
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Quaternion, Vector3};
    use tunnelproof::wire::Shape;

    fn cube() -> Core {
        Core::of(&Shape::Box {
            half: Vector3::repeat(8.0),
        })
    }

    fn pose(x: f64, y: f64) -> Pose {
        // A turn by 90 degrees about z, not of length 1.
        Pose::new(Point::new(x, y, 0.5), Quaternion::new(3.0, 0.0, 0.0, 3.0))
    }

    #[test]
    fn cores_overlap_if_they_do_and_not_where_they_only_touch() {
        // Cores are cubes from -7 to 7.
        let core = cube();
        let at_rest = Pose::new(Point::origin(), Quaternion::new(1.0, 0.0, 0.0, 0.0));
        let both = |x: f64, y: f64| overlap([&core, &core], [&at_rest, &pose(x, y)]);
        assert!(both(13.9, 1.0) && both(0.5, 0.25) && both(-13.9, 13.9));
        assert!(!both(14.0, 1.0) && !both(14.0, 14.0) && !both(14.1, 0.0));
        // By less than what is rounded.
        assert!(both(14f64.next_down(), 1.0) && !both(14f64.next_up(), 1.0));
    }

    #[test]
    fn cores_overlap_with_a_plane_that_they_go_below() {
        let (core, plane) = (cube(), Core::Plane);
        let rest = pose(0.0, 0.0);
        let at = |z: f64| Pose::new(Point::new(3.0, 0.0, z + 0.5), rest.quaternion);
        let below = |z: f64| overlap([&core, &plane], [&at(z), &rest]);
        assert!(below(6.9) && below(7f64.next_down()) && !below(7.0) && !below(7.1));
    }
}

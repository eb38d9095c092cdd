//! Whether points are inside cores: first rounded, with a bound on the rounding; what that leaves in
//! doubt in exact integers. Only differences of places are rounded, so it does not matter how far from
//! the origin they are.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use num_bigint::Sign;
use tunnelproof::query::Point;
use tunnelproof::rigid::Pose;

use super::core::{Core, RAYS, Surface};
use super::integers::{Exact, Space, volume};

type Vector = Vector3<f64>;

/// Far more than all roundings of a place and of the planes of faces, as a part of the numbers that they
/// are made of.
const DOUBT: f64 = 1e-9;

/// Whether a point of space is inside the core of a body. On its surface it is not.
pub(super) fn is_node_inside(core: &Core, pose: &Pose, node: &Point) -> bool {
    let at = Pose::new(*node, Quaternion::identity());
    is_inside(core, pose, &Point::origin(), &at)
}

/// Whether a point of a body at another pose is inside the core of a body. On its surface it is not.
pub(super) fn is_inside(core: &Core, pose: &Pose, point: &Point, at: &Pose) -> bool {
    let place = seen(point, at, pose);
    let size = point.coords.amax() + (at.centre - pose.centre).amax();
    let rounded = match core {
        Core::Plane => (place.z.abs() > DOUBT * size).then_some(place.z < 0.0),
        Core::Surface(surface) => surface.holds(&place, DOUBT * (size + surface.extent())),
    };
    // Numbers that are not finite are nowhere.
    let exact = || match core {
        Core::Plane => is_below(pose, point, at),
        Core::Surface(surface) => is_within(surface, pose, point, at),
    };
    rounded.or_else(exact).unwrap_or(false)
}

/// A point of a body in the frame of another one, rounded.
pub(super) fn seen(point: &Point, at: &Pose, by: &Pose) -> Vector {
    let [turn, back] = [at, by].map(|pose| UnitQuaternion::new_normalize(pose.quaternion));
    back.inverse_transform_vector(&(turn * point.coords + (at.centre - by.centre)))
}

/// Whether a point of a body is below the plane of another one.
fn is_below(plane: &Pose, point: &Point, at: &Pose) -> Option<bool> {
    let on_plane = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let on_plane = on_plane.map(|[x, y]| Point::new(x, y, 0.0));
    let space = Space::new([at, plane], &[&[*point], &on_plane])?;
    let [o, x, y] = on_plane.map(|point| space.place(1, &point));
    Some(volume(&o, &x, &y, &space.place(0, point)) == Sign::Minus)
}

/// Whether a point of a body is inside the surface of another one.
fn is_within(surface: &Surface, pose: &Pose, point: &Point, at: &Pose) -> Option<bool> {
    let origin = Point::origin();
    // Outside of the surface.
    let far = 8.0 * surface.extent();
    let targets = RAYS.map(|ray| Point::from(Vector::from(ray) * far));
    let corners = surface.faces.as_flattened();
    let space = Space::new(
        [at, pose],
        &[&[*point], &[corners, &targets, &[origin]].concat()],
    )?;
    let place = space.place(0, point);
    let faces = surface.faces.iter();
    let mut faces = faces.map(|face| face.map(|corner| space.place(1, &corner)));
    if surface.is_convex() {
        let inner = space.place(1, &origin);
        let is_behind = |[b, c, d]: [Exact; 3]| {
            let side = volume(&b, &c, &d, &place);
            side != Sign::NoSign && side == volume(&b, &c, &d, &inner)
        };
        return Some(faces.all(is_behind));
    }
    let faces: Vec<[Exact; 3]> = faces.collect();
    let targets = targets.map(|target| space.place(1, &target));
    let mut ways = targets.iter().filter_map(|to| winding(&faces, &place, to));
    ways.next().map(|count| count > 0)
}

/// How many times more often the way from one point to another one, which is outside, leaves a closed
/// surface than it enters it; 0 if the first one is on it. `None` if the way meets an edge, or lies in the plane of a face.
fn winding(faces: &[[Exact; 3]], from: &Exact, to: &Exact) -> Option<i32> {
    let mut count = 0;
    for [b, c, d] in faces {
        let around = [(b, c), (c, d), (d, b)].map(|(p, q)| volume(from, to, p, q));
        if around.contains(&Sign::Plus) && around.contains(&Sign::Minus) {
            continue;
        }
        match [from, to].map(|end| volume(b, c, d, end)) {
            [Sign::NoSign, Sign::NoSign] => return None,
            [Sign::NoSign, _] => return Some(0),
            [start, end] if start == end => {}
            _ if around.contains(&Sign::NoSign) => return None,
            [start, _] => count += if start == Sign::Minus { 1 } else { -1 },
        }
    }
    Some(count)
}

#[cfg(test)]
mod tests;

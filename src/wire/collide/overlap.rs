//! Whether two cores overlap, with certainty.

use super::body_motion::{from_body, into_body};
use crate::query::Point;
use crate::rigid::{Pose, RigidError, RigidMotion};
use crate::wire::Vector;
use crate::wire::model::core::{Core, Surface};

/// More than all roundings of a volume, as a part of the numbers that it is made of.
const ROUNDING: f64 = 1e-12;

/// Whether two cores certainly overlap. In doubt they do not, and they are tested.
///
/// Two surfaces overlap where an edge of one goes through a face of the other. Parts that lie along
/// each other leave that in doubt; so it is also asked whether points of one are inside the other:
/// vertices, and the middles of edges and faces.
pub(super) fn is_certain(cores: [&Core; 2], poses: [&Pose; 2]) -> Result<bool, RigidError> {
    let [a, b] = poses.map(|pose| RigidMotion::new(*pose, *pose));
    let motions = [a?, b?];
    Ok(match cores {
        [Core::Surface(a), Core::Surface(b)] => {
            let size = size(motions.each_ref());
            let [a_in_b, b_in_a] = [
                seen(a, &motions[0], &motions[1]),
                seen(b, &motions[1], &motions[0]),
            ];
            enters(a, &a_in_b, b, size) || enters(b, &b_in_a, a, size)
        }
        [Core::Surface(a), Core::Plane] => is_below(a, &motions[0], &motions[1]),
        [Core::Plane, Core::Surface(b)] => is_below(b, &motions[1], &motions[0]),
        [Core::Plane, Core::Plane] => false,
    })
}

/// The way from one centre to the other: all that is rounded are parts of it and of the shapes.
fn size([a, b]: [&RigidMotion; 2]) -> f64 {
    (b.start().centre - a.start().centre).amax()
}

/// The vertices of a surface in the frame of another body.
fn seen(surface: &Surface, motion: &RigidMotion, by: &RigidMotion) -> Vec<Point> {
    let offset = motion.start().centre - by.start().centre;
    let place = |vertex: &Point| {
        let arm = from_body(motion, 0.0, &vertex.coords);
        Point::from(into_body(by, 0.0, &(arm + offset)))
    };
    surface.vertices.iter().map(place).collect()
}

fn is_below(surface: &Surface, motion: &RigidMotion, plane: &RigidMotion) -> bool {
    const NEXT: f64 = 1e-9;
    let size = size([motion, plane]);
    let places = seen(surface, motion, plane);
    let mut places = places.iter();
    places.any(|place| place.z < -NEXT * (size + place.coords.amax()))
}

/// Whether a surface with its vertices at these places certainly has a part inside another one, or
/// an edge through a face of it.
fn enters(surface: &Surface, places: &[Point], other: &Surface, size: f64) -> bool {
    let [low, high] = other.bounds();
    let within = |points: &[Point]| {
        (0..3).all(|axis| {
            points.iter().any(|point| point[axis] >= low[axis])
                && points.iter().any(|point| point[axis] <= high[axis])
        })
    };
    let held = |point: &Point| within(&[*point]) && other.holds(point) == Some(true);
    let edges = surface.edges.iter().map(|edge| edge.map(|k| places[k]));
    let mut faces = surface.faces.iter().map(|face| face.map(|k| places[k]));
    let pierces = |ends: [Point; 2]| {
        let through = |face: &[usize; 3]| {
            let corners = face.map(|k| other.vertices[k]);
            goes_through(&ends, &corners, size)
        };
        within(&ends) && other.faces.iter().any(through)
    };
    places.iter().any(held)
        || faces.any(|[a, b, c]| held(&Point::from((a.coords + b.coords + c.coords) / 3.0)))
        || edges.clone().any(|[a, b]| held(&nalgebra::center(&a, &b)))
        || edges.clone().any(pierces)
}

/// Whether a piece of a line certainly goes through a triangle, strictly inside of both. `size` is
/// that of the numbers, beside the points, from which they come.
fn goes_through([p, q]: &[Point; 2], [b, c, d]: &[Point; 3], size: f64) -> bool {
    let points = [p, q, b, c, d].map(|point| point - b);
    let extent = points
        .iter()
        .fold(0.0, |size: f64, point| size.max(point.amax()));
    let size = points[1..]
        .iter()
        .fold(size, |size: f64, point| size.max(point.amax()));
    let size = size + b.coords.amax();
    let margin = ROUNDING * size * extent * extent;
    let volume = |x: &Point, y: &Point, z: &Point, w: &Point| {
        let v: Vector = (y - x).cross(&(z - x));
        v.dot(&(w - x))
    };
    let sides = [volume(b, c, d, p), -volume(b, c, d, q)];
    let around = [volume(p, q, b, c), volume(p, q, c, d), volume(p, q, d, b)];
    let agree = |of: &[f64]| of.iter().all(|v| *v > margin) || of.iter().all(|v| *v < -margin);
    agree(&sides) && agree(&around)
}

#[cfg(test)]
mod tests;

//! What is inside cores of bodies at rest, or touches them.
//!
//! Only vectors from the body's centre are rounded, so it does not matter how far from the origin a
//! body is. What rounding leaves in doubt queries without rounding decide.

use super::body_motion::{from_body, into_body};
use super::segment::direction;
use crate::certified::decide_rigid;
use crate::query::Point;
use crate::rigid::{Pose, RigidError, RigidMotion, VertexTurningFace};
use crate::wire::Vector;
use crate::wire::model::core::{Core, Surface};

/// Far more than the rounding of a height above a plane, as a part of the way from its centre.
const DOUBT: f64 = 1e-9;

/// Whether a segment touches a core, or is inside it.
pub(super) fn is_in(core: &Core, pose: &Pose, ends: &[Point; 2]) -> Result<bool, RigidError> {
    let motion = RigidMotion::new(*pose, *pose)?;
    let [a, b] = ends;
    match core {
        Core::Plane => Ok(!is_above_plane(&motion, a)? || !is_above_plane(&motion, b)?),
        Core::Surface(surface) => Ok(is_inside(&motion, surface, a)?
            || is_inside(&motion, surface, b)?
            || pierces(&motion, surface, a, b)?),
    }
}

/// Whether a point is inside a closed surface of a body at rest. Next to the surface it is if a straight
/// way leads from it to what is certainly inside and does not meet the surface.
fn is_inside(motion: &RigidMotion, surface: &Surface, point: &Point) -> Result<bool, RigidError> {
    let centre = motion.start().centre;
    let seen = |point: &Point| Point::from(into_body(motion, 0.0, &(point - centre)));
    let place = seen(point);
    if let Some(inside) = surface.holds(&place) {
        return Ok(inside);
    }
    // Well beyond what is in doubt, and beyond the next numbers.
    let depth = 16.0 * (surface.doubt(&place) + f64::EPSILON * point.coords.amax());
    let normals = surface.normals_near(&place, depth);
    let mean: Vector = normals.iter().sum();
    for normal in [mean].iter().chain(&normals).filter_map(direction) {
        let deeper = point - from_body(motion, 0.0, &normal) * depth;
        if surface.holds(&seen(&deeper)) == Some(true) && !pierces(motion, surface, point, &deeper)?
        {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Whether the straight piece from `a` to `b` touches a face of a body at rest.
pub(super) fn pierces(
    motion: &RigidMotion,
    surface: &Surface,
    a: &Point,
    b: &Point,
) -> Result<bool, RigidError> {
    for face in &surface.faces {
        let corners = face.map(|k| surface.vertices[k]);
        // A vertex that goes from one end to the other passes every point of the piece.
        let query = VertexTurningFace::new([*a], [*b], corners, *motion)?;
        if decide_rigid(&query).is_some() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Whether a vertex that goes from one place to another touches the plane of a body.
fn touches_plane(motion: &RigidMotion, from: Point, to: Point) -> Result<bool, RigidError> {
    let Some(corners) = covering(motion, from, to) else {
        return Ok(false);
    };
    let query = VertexTurningFace::new([from], [to], corners, *motion)?;
    Ok(decide_rigid(&query).is_some())
}

/// Whether a point is above the plane of a body at rest, exactly.
fn is_above_plane(motion: &RigidMotion, point: &Point) -> Result<bool, RigidError> {
    let centre = motion.start().centre;
    let way = point - centre;
    let height = into_body(motion, 0.0, &way).z;
    if height.abs() > DOUBT * way.amax() {
        return Ok(height > 0.0);
    }
    // The way to a place that is certainly above meets the plane unless it starts above.
    let size = DOUBT * (point.coords.amax() + centre.coords.amax());
    let up = from_body(motion, 0.0, &Vector::z()) * (4.0 * size);
    Ok(!touches_plane(motion, *point, point + up)?)
}

/// Whether a side of a triangle touches the plane of a body at rest.
pub(super) fn covers_plane(
    motion: &RigidMotion,
    &[a, b, c]: &[Point; 3],
) -> Result<bool, RigidError> {
    Ok(
        touches_plane(motion, a, b)?
            || touches_plane(motion, b, c)?
            || touches_plane(motion, c, a)?,
    )
}

/// A triangle of a body's plane that covers wherever a point comes on a straight way. None if it stays well above the
/// plane, which does not move.
pub(super) fn covering(motion: &RigidMotion, from: Point, to: Point) -> Option<[Point; 3]> {
    let ways = [from - motion.start().centre, to - motion.end().centre];
    let [start, end] = ways.map(|way| way.norm());
    let far = start.max(end);
    if motion.start() == motion.end() {
        let above = |way: &Vector| into_body(motion, 0.0, way).z > DOUBT * way.amax();
        if ways.iter().all(above) {
            return None;
        }
    }
    // Nowhere is it farther from the centre than at one of both ends.
    Some(plane_around(far))
}

/// A triangle of the plane `z = 0` that covers a circle of this radius, and rounding.
pub(super) fn plane_around(radius: f64) -> [Point; 3] {
    // The next power of two; a circle of twice that is inside the triangle.
    let exponent = radius.max(f64::MIN_POSITIVE).to_bits() >> 52;
    let size = f64::from_bits((exponent + 1) << 52);
    let corner = |x: f64, y: f64| Point::new(x * size, y * size, 0.0);
    [corner(0.0, 4.0), corner(-4.0, -2.0), corner(4.0, -2.0)]
}

#[cfg(test)]
mod tests;

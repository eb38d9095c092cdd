//! Changes of resolution beside bodies.
//!
//! A change sweeps a triangle while bodies rest. The triangle touches a core's surface if one of its
//! sides touches a face, or an edge of the core touches the triangle. Both are queries without
//! rounding.

use super::body_motion::BodyWay;
use super::core_boxes;
use super::inside::{covers_plane, is_in, pierces};
use crate::broad::Aabb;
use crate::certified::decide_rigid;
use crate::query::Point;
use crate::rigid::{EdgeTurningEdge, RigidMotion};
use crate::wire::error::CollisionError;
use crate::wire::model::BodyId;
use crate::wire::model::core::{Core, Surface};
use crate::wire::resolution::{Remesh, RemeshKind};
use crate::wire::world::World;

/// Whether the triangle that a change sweeps touches a core. Not if something that it takes out or
/// divides does so already, as at the end of a wire inside its body: then only the place moves where
/// the wire leaves the core.
pub(super) fn meets(
    world: &World,
    change: &Remesh,
    cores: &[Core],
) -> Result<bool, CollisionError> {
    for (body, core) in cores.iter().enumerate() {
        let way = BodyWay::resting(world, BodyId(body))?;
        let motion = &way.pieces[0];
        if touches(motion, core, &change.triangle)? && !was_in(motion, core, change)? {
            return Ok(true);
        }
    }
    Ok(false)
}

fn touches(
    motion: &RigidMotion,
    core: &Core,
    triangle: &[Point; 3],
) -> Result<bool, CollisionError> {
    let surface = match core {
        Core::Plane => return Ok(covers_plane(motion, triangle)?),
        Core::Surface(surface) => surface,
    };
    let around = core_boxes::in_space(motion, &surface.bounds());
    let around = Aabb::new(around.low.into(), around.high.into())?;
    if !Aabb::swept(triangle, triangle, 0.0)?.overlaps(&around) {
        return Ok(false);
    }
    let [a, b, c] = triangle;
    for [from, to] in [[a, b], [b, c], [c, a]] {
        if pierces(motion, surface, from, to)? {
            return Ok(true);
        }
    }
    is_pierced(motion, surface, triangle)
}

/// Whether an edge of a core touches a triangle: the segment from `b` to `c` whose end `b` goes to
/// `a` passes every point of it.
fn is_pierced(
    motion: &RigidMotion,
    surface: &Surface,
    &[a, b, c]: &[Point; 3],
) -> Result<bool, CollisionError> {
    for edge in &surface.edges {
        let ends = edge.map(|k| surface.vertices[k]);
        let query = EdgeTurningEdge::new([b, c], [a, c], ends, *motion)?;
        if decide_rigid(&query).is_some() {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Whether a segment that a change takes out or divides touches the core already, or is inside.
fn was_in(motion: &RigidMotion, core: &Core, change: &Remesh) -> Result<bool, CollisionError> {
    let [a, b, c] = change.triangle;
    let own = match change.kind {
        RemeshKind::Merge => vec![[a, b], [b, c]],
        RemeshKind::Split => vec![[a, c]],
    };
    for ends in &own {
        if is_in(core, motion.start(), ends)? {
            return Ok(true);
        }
    }
    Ok(false)
}

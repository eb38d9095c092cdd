//! The ends of wires at the bodies to which they are fixed.
//!
//! A wire may start on a body, or at a point inside of it. What comes from inside is one with the body. On the body the
//! wire bends as over any other one: it gets a contact node where it comes to lie deeper than its end. So it winds up on a
//! drum that turns.

use std::collections::BTreeMap;

use super::collision_shape::CollisionShape;
use crate::query::Point;
use crate::wire::model::wire::LEAST;
use crate::wire::model::{BodyId, NodeKind};
use crate::wire::site::SegmentId;
use crate::wire::world::World;

/// By how much deeper than on the surface the midline may be where a wire does not come from inside, as a part of the
/// wire's radius.
const ROUNDING: f64 = 1e-6;

/// The nodes that are fixed to bodies, by wire and node.
pub(super) struct Ends(BTreeMap<[usize; 2], End>);

/// A node that is fixed to a body.
pub(super) struct End {
    body: BodyId,
    node: usize,
    /// How deep the wire's surface is in the body there, in m; 0 outside.
    pub(super) depth: f64,
    is_inside: bool,
}

impl Ends {
    /// Those where a step starts, with the shape of each body.
    pub(super) fn new(world: &World, forms: &[CollisionShape]) -> Self {
        let mut ends = BTreeMap::new();
        for (w, wire) in world.wires.iter().enumerate() {
            let radius = wire.material.radius;
            for (node, at) in wire.nodes.iter().enumerate() {
                let NodeKind::Eye { body, .. } = at.kind else {
                    continue;
                };
                let placed = &world.bodies[body.0];
                let form = forms[body.0].at(&placed.position, &placed.orientation);
                let depth = radius - form.distance(&at.position);
                let end = End {
                    body,
                    node,
                    depth: depth.max(0.0),
                    is_inside: depth > radius * (1.0 + ROUNDING),
                };
                ends.insert([w, node], end);
            }
        }
        Ends(ends)
    }

    /// The end of a segment at a body.
    pub(super) fn of(&self, id: SegmentId, body: BodyId) -> Option<&End> {
        let ends = [0, 1].map(|k| self.0.get(&[id.wire.0, id.segment + k]));
        ends.into_iter().flatten().find(|end| end.body == body)
    }

    /// Whether a segment comes from inside of a body.
    pub(super) fn is_inside(&self, id: SegmentId, body: BodyId) -> bool {
        self.of(id, body).is_some_and(|end| end.is_inside)
    }

    /// Of a segment that ends on a body, what is beyond a sixteenth of the resolution from that end: at the end itself, on
    /// the surface, the collision library finds no reliable normal. None of any other segment, and of one that is shorter.
    pub(super) fn beyond(&self, world: &World, id: SegmentId, body: BodyId) -> Option<[Point; 2]> {
        let end = self.of(id, body)?;
        let [from, to] = id.ends(world);
        let along = to - from;
        let part = LEAST * id.of(world).resolution.length / along.norm();
        let cut = along * part;
        (part < 1.0).then(|| {
            if end.node == id.segment {
                [from + cut, to]
            } else {
                [from, to - cut]
            }
        })
    }
}

impl End {
    /// How far a place of the segment is away along the wire, in m.
    pub(super) fn apart(&self, world: &World, id: SegmentId, arc: f64) -> f64 {
        (id.of(world).nodes[self.node].arc - arc).abs()
    }
}

#[cfg(test)]
mod tests;

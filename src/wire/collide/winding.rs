//! Wire that comes onto a body beside a node that the body carries, as on a drum that turns.
//!
//! A contact there would push the wire off with the leverage of the whole leg. So the wire gets another contact node
//! where its surface is deepest in the body, put out to where it touches, and then the next one where it is deepest
//! after that. A wire may start on a body, or at a point inside of it: what comes from inside is one with the body, and what was
//! inside before the step stays as it is.

use super::body_contacts::BodyContacts;
use super::contact_node_insertion::{beside, turn, velocity_at};
use super::manifold::CHORD;
use crate::query::Point;
use crate::wire::Vector;
use crate::wire::model::wire::LEAST;
use crate::wire::model::{BodyId, NodeKind, WireId};
use crate::wire::site::SegmentId;
use crate::wire::step::contact_nodes::ContactNodeInsertion;
use crate::wire::world::World;

/// By how much deeper than on the surface the midline may be where a wire does not come from inside, as a part of the
/// wire's radius.
const ROUNDING: f64 = 1e-6;

/// By how much a node is put out of the body at most, as a part of the way to the nearer end of its segment: more would
/// stretch the wire by more than a twentieth.
const LIFT: f64 = 0.35;

/// Where adaptive wires come onto bodies: at most one place for each end of a segment.
pub(super) fn insertions(
    world: &World,
    obstacles: &BodyContacts,
    friction: f64,
) -> Vec<ContactNodeInsertion> {
    let mut insertions = Vec::new();
    for (w, wire) in world.wires.iter().enumerate() {
        if !wire.resolution.adaptive {
            continue;
        }
        for segment in 0..wire.segments.len() {
            let wire = WireId(w);
            let id = SegmentId { wire, segment };
            let places = [0, 1].map(|end| Deepest::of(world, obstacles, id, end));
            let places = places.into_iter().flatten();
            insertions.extend(places.filter_map(|place| place.insertion(world, id, friction)));
        }
    }
    insertions
}

/// The deepest place of a segment in the body that carries one of its nodes.
struct Deepest {
    body: BodyId,
    /// From the start of the segment to its end, 0 to 1.
    parameter: f64,
    place: Point,
    /// How deep the wire's surface is there, in m.
    depth: f64,
    /// Unit normal out of the body.
    normal: Vector,
}

impl Deepest {
    /// In the body that carries the node at this end, 0 or 1. None if there is none, or it carries the other node too, if the
    /// wire comes from inside of it, or is nowhere in it beyond the node: nearer than a sixteenth of the resolution, or
    /// than the wire is thick, the node bends the wire.
    fn of(world: &World, obstacles: &BodyContacts, id: SegmentId, end: usize) -> Option<Self> {
        let nodes = id.nodes(world);
        let (body, _) = nodes[end].kind.carrier()?;
        if nodes[1 - end].kind.is_on(body) {
            return None;
        }
        let placed = obstacles.placed(world, body);
        let radius = id.of(world).material.radius;
        if matches!(nodes[end].kind, NodeKind::Eye { .. })
            && placed.distance(&nodes[end].position) < -ROUNDING * radius
        {
            return None;
        }
        let [start, last] = id.ends(world);
        let span = last - start;
        let length = span.norm();
        let beyond = (2.0 * radius).max(LEAST * id.of(world).resolution.length) / length;
        let [from, to] = if end == 0 {
            [beyond, 1.0]
        } else {
            [0.0, 1.0 - beyond]
        };
        if from >= to {
            return None;
        }
        let piece = [from, to].map(|parameter| start + span * parameter);
        let spots = placed.touched_by(&piece, radius);
        let inside = spots.into_iter().map(|spot| {
            let parameter =
                ((spot.points[0] - start).dot(&span) / (length * length)).clamp(from, to);
            let place = start + span * parameter;
            Deepest {
                body,
                parameter,
                place,
                depth: radius - placed.distance(&place),
                normal: spot.normal,
            }
        });
        let deepest = inside.max_by(|a, b| a.depth.total_cmp(&b.depth))?;
        let is_beyond = deepest.parameter > from && deepest.parameter < to;
        (is_beyond && deepest.depth > 0.0).then_some(deepest)
    }

    /// A node there, outside of the body, if the wire does not go out of it, and the node turns the wire and does not slip
    /// off sideways at once.
    fn insertion(
        &self,
        world: &World,
        id: SegmentId,
        friction: f64,
    ) -> Option<ContactNodeInsertion> {
        let wire = id.of(world);
        let [start, end] = id.ends(world);
        let body = &world.bodies[self.body.0];
        let local = body
            .orientation
            .inverse_transform_vector(&(self.place - body.position));
        let [own, of_body] = [
            velocity_at(wire, id.segment, self.parameter),
            body.velocity_at(&local),
        ];
        let apart = (end - start).norm() * self.parameter.min(1.0 - self.parameter);
        // Wire that is slack or goes off a body lies as deep in it as chords between its nodes. Deeper, a contact would
        // push it with leverage.
        let comes_on =
            wire.segments[id.segment].tension > 0.0 && (own - of_body).dot(&self.normal) <= 0.0;
        let is_deep = self.depth >= CHORD * apart;
        // Where it is deeper than it came in this step, it was in the body before.
        let came = world.settings.step * (own.norm() + of_body.norm());
        let was_inside = self.depth > 2.0 * wire.material.radius + came;
        if !(comes_on || is_deep) || was_inside {
            return None;
        }
        let place = self.place + self.normal * self.depth.min(LIFT * apart);
        let between = beside(wire, id.segment, self.body);
        let ways = between.map(|node| wire.nodes[node].position - place);
        let [out, aside] = turn(&ways, &self.normal, &(end - start), friction)?;
        // Both parts are stretched alike.
        let [first, last] = [place - start, end - place].map(|part| part.norm());
        let arc =
            wire.nodes[id.segment].arc + wire.rest_length(id.segment) * first / (first + last);
        Some(ContactNodeInsertion {
            wire: id.wire,
            arc,
            body: self.body,
            place,
            normal: out,
            friction,
            aside,
        })
    }
}

#[cfg(test)]
mod tests;

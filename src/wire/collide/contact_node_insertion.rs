//! Finds where wires need contact nodes: where bodies bend them.
//!
//! A wire bends at its nodes only. Between two of them it crosses an edge as a straight bar. With a
//! contact node there it turns, and sticks or slides as far as the capstan bound goes. The node
//! leaves where the wire turns away from the body, or ends (`step/contact_nodes.rs`).

use super::body_contacts::KnownContacts;
use crate::wire::contact::ContactSite;
use crate::wire::model::{BodyId, Wire};
use crate::wire::record::ContactRecord;
use crate::wire::step::contact_nodes::{self, ContactNodeInsertion};
use crate::wire::vector::{Vector, unit};
use crate::wire::world::World;

/// The least slope down beside a place at which a wire is bent, and the least turn there, as a
/// difference of two directions.
const TURN: f64 = 0.02;

/// Of what friction can hold sideways, the most that a wire may pull where a node is inserted: so none is inserted
/// that slips off at once.
const ASIDE: f64 = 0.5;

/// Where bodies bend adaptive wires that pull, in the order of the contacts. Those of guard mode, which keep what is
/// inside a body or ends on it out of its core, do not count.
pub(super) fn insertions(
    world: &World,
    records: &[ContactRecord],
    known: &KnownContacts,
) -> Vec<ContactNodeInsertion> {
    let found = known.found();
    let pushing = records
        .iter()
        .filter(|record| found.contains(&record.contact.key) && record.normal_force() > 0.0);
    pushing
        .filter_map(|record| insertion(world, record))
        .collect()
}

fn insertion(world: &World, record: &ContactRecord) -> Option<ContactNodeInsertion> {
    let contact = &record.contact;
    let (ContactSite::Wire { wire: id, arc }, ContactSite::Body { body, local }) =
        (contact.a, contact.b)
    else {
        return None;
    };
    let wire = &world.wires[id.0];
    let (segment, parameter) = wire.at(arc);
    let on_surface = contact.gap > -wire.material.radius;
    if !(wire.resolution.adaptive && on_surface) || wire.segments[segment].tension <= 0.0 {
        return None;
    }
    // Where the node will be, and the nodes between which it turns the wire.
    let (place, [before, after]) = match contact_nodes::node_near(wire, arc) {
        Some(node) => (wire.nodes[node].position, [node.checked_sub(1)?, node + 1]),
        None => {
            let place = wire.nodes[segment].position + wire.span(segment) * parameter;
            (place, beside(wire, segment, body))
        }
    };
    let [before, after] = [wire.nodes.get(before)?, wire.nodes.get(after)?];
    let ways = [before, after].map(|node| node.position - place);
    let along = wire.span(segment);
    let friction = contact.friction;
    let [out, aside] = turn(&ways, &contact.normal, &along, friction)?;
    // Sideways, friction can stop it within this step.
    let mass = wire.material.mass_per_length() * wire.rest_length(segment) / 2.0;
    let velocity = velocity_at(wire, segment, parameter) - world.bodies[body.0].velocity_at(&local);
    let stopped = friction * record.normal_force() * world.settings.step;
    let stays = mass * velocity.dot(&aside).abs() <= stopped;
    stays.then_some(ContactNodeInsertion {
        wire: id,
        arc,
        body,
        place,
        normal: out,
        friction,
        aside,
    })
}

/// How a node on a body turns a wire: unit vectors out of the curve, and along the surface across the wire. The ways go to
/// the places between which it does, the normal is that of the body, and the wire runs along a vector across it. None
/// if the wire is not bent over the body there, or would slip off sideways at once.
pub(super) fn turn(
    ways: &[Vector; 2],
    normal: &Vector,
    along: &Vector,
    friction: f64,
) -> Option<[Vector; 2]> {
    let [before, after] = ways.map(|way| way.normalize());
    // Down on one side, and not as far up on the other: over an edge, not beside one.
    let slopes = [before, after].map(|direction| direction.dot(normal));
    let out = -(before + after);
    let bent = slopes[0].min(slopes[1]) <= -TURN && out.dot(normal) >= TURN;
    // The normal is across the wire to rounding.
    let (aside, _) = unit(&normal.cross(along));
    let pressing = out.dot(normal) * contact_nodes::pressing_by_pull(&[-before, after]);
    let held = out.dot(&aside).abs() <= ASIDE * friction * pressing;
    (bent && held).then(|| [out.normalize(), aside])
}

pub(super) fn velocity_at(wire: &Wire, segment: usize, parameter: f64) -> Vector {
    let [start, end] = [segment, segment + 1].map(|node| wire.nodes[node].velocity);
    start.lerp(&end, parameter)
}

/// The nodes before and after a segment and its neighbours, as far as no other place of the body is
/// between.
pub(super) fn beside(wire: &Wire, segment: usize, body: BodyId) -> [usize; 2] {
    let is_on = |node: usize| wire.nodes[node].kind.is_on(body);
    let last = wire.nodes.len() - 1;
    let before = segment.saturating_sub(usize::from(!is_on(segment)));
    let after = segment + 1 + usize::from(!is_on(segment + 1));
    [before, after.min(last)]
}

#[cfg(test)]
mod tests;

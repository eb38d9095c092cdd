//! Where bodies bend wires, which get contact nodes there.
//!
//! A wire bends at its nodes only: over an edge between two of them it lies as a bar. With a contact node there it turns, and sticks
//! or slides as far as the capstan bound goes. The node leaves where the wire turns away from the body, or ends (`step/ride.rs`).

use super::obstacle::KEYS;
use crate::wire::contact::{Contact, Place};
use crate::wire::model::{BodyId, Wire};
use crate::wire::record::ContactRecord;
use crate::wire::step::ride::{self, Bend};
use crate::wire::world::World;

/// The least slope down beside a place at which a wire is bent, and the least turn there, as a difference of two directions.
const TURN: f64 = 0.02;

/// Where bodies bend adaptive wires that pull, in the order of the contacts.
pub(super) fn bends(world: &World, records: &[ContactRecord]) -> Vec<Bend> {
    let pushing = records.iter().filter(|record| record.normal_force() > 0.0);
    pushing
        .filter_map(|record| bend(world, &record.contact))
        .collect()
}

fn bend(world: &World, contact: &Contact) -> Option<Bend> {
    let (Place::Wire { wire: id, arc }, Place::Body { body, .. }) = (contact.a, contact.b) else {
        return None;
    };
    let wire = &world.wires[id.0];
    let (segment, share) = wire.at(arc);
    let found = contact.key > KEYS && wire.resolution.adaptive;
    let on_surface = contact.gap > -wire.material.radius;
    if !(found && on_surface) || wire.segments[segment].tension <= 0.0 {
        return None;
    }
    // Where the node will be, and the nodes between which it turns the wire.
    let (place, [before, after]) = match ride::node_near(wire, arc) {
        Some(node) => (wire.nodes[node].position, [node.checked_sub(1)?, node + 1]),
        None => {
            let place = wire.nodes[segment].position + wire.span(segment) * share;
            (place, beside(wire, segment, body))
        }
    };
    let way = |node: usize| Some((wire.nodes.get(node)?.position - place).normalize());
    let [before, after] = [way(before)?, way(after)?];
    // Down on one side, and not as far up on the other: over an edge, not beside one.
    let slopes = [before, after].map(|way| way.dot(&contact.normal));
    let out = -(before + after);
    let bent = slopes[0].min(slopes[1]) <= -TURN && out.dot(&contact.normal) >= TURN;
    bent.then(|| Bend {
        wire: id,
        arc,
        body,
        normal: out.normalize(),
        friction: contact.friction,
    })
}

/// The nodes before and after a segment and its neighbours, as far as no other place of the body is between.
fn beside(wire: &Wire, segment: usize, body: BodyId) -> [usize; 2] {
    let rides = |node: usize| wire.nodes[node].kind.rides(body);
    let last = wire.nodes.len() - 1;
    let before = segment.saturating_sub(usize::from(!rides(segment)));
    let after = segment + 1 + usize::from(!rides(segment + 1));
    [before, after.min(last)]
}

#[cfg(test)]
mod tests;

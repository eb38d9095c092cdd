//! Finds where wires need contact nodes: where bodies bend them.
//!
//! A wire bends at its nodes only. Between two of them it crosses an edge as a straight bar. With a
//! contact node there it turns, and sticks or slides as far as the capstan bound goes. The node
//! leaves where the wire turns away from the body, or ends (`step/contact_nodes.rs`).

use super::body_contacts::BodyContacts;
use crate::wire::contact::{ContactConstraint, ContactSite};
use crate::wire::model::{BodyId, Wire};
use crate::wire::record::ContactRecord;
use crate::wire::site::WireSite;
use crate::wire::step::contact_nodes::{self, ContactNodeInsertion};
use crate::wire::vector::{Vector, unit};
use crate::wire::world::World;

/// The least slope down beside a place at which a wire is bent, and the least turn there, as a
/// difference of two directions.
const TURN: f64 = 0.02;

/// Of what friction can hold sideways, the most that a wire may pull where a node is inserted: so none is inserted
/// that slips off at once.
const ASIDE: f64 = 0.5;

/// By how much a node is put out of the body at most where wire comes onto it, as a part of the way to the next node.
const LIFT: f64 = 0.1;

/// Where bodies bend adaptive wires that pull, in the order of the contacts; then where wires come onto bodies beside nodes
/// that these carry. Contacts of guard mode, which keep what is inside a body or ends on it out of its core, do not count.
pub(super) fn insertions(
    world: &World,
    records: &[ContactRecord],
    obstacles: &BodyContacts,
) -> Vec<ContactNodeInsertion> {
    let found = obstacles.known.found();
    let pushing = records
        .iter()
        .filter(|record| found.contains(&record.contact.key) && record.normal_force() > 0.0);
    let pushed = pushing.filter_map(|record| {
        let bend = Bend::of(world, &record.contact, None)?;
        (record.contact.gap > -bend.wire.material.radius && bend.stops(world, record))
            .then(|| bend.insertion())
    });
    let beside = obstacles.beside.iter();
    let beside =
        beside.filter_map(|contact| Some(Bend::of(world, contact, Some(obstacles))?.insertion()));
    pushed.chain(beside).collect()
}

/// A place where a body bends a wire.
struct Bend<'a> {
    contact: &'a ContactConstraint,
    wire: &'a Wire,
    site: WireSite,
    body: BodyId,
    local: Vector,
    /// How far from the straight wire the node will be, in m.
    lift: f64,
    /// Unit vector out of the curve.
    out: Vector,
    /// Unit vector along the surface and across the wire.
    aside: Vector,
}

impl<'a> Bend<'a> {
    /// The place of a contact, if a node there turns the wire, which pulls, and does not slip off sideways at once. Beside a
    /// node that the body carries, a node there would be outside of the body, onto which the wire comes: its shape is among
    /// these obstacles.
    fn of(
        world: &'a World,
        contact: &'a ContactConstraint,
        beside_node: Option<&BodyContacts>,
    ) -> Option<Self> {
        let (ContactSite::Wire { wire: id, arc }, ContactSite::Body { body, local }) =
            (contact.a, contact.b)
        else {
            return None;
        };
        let wire = &world.wires[id.0];
        let (segment, parameter) = wire.at(arc);
        if !wire.resolution.adaptive || wire.segments[segment].tension <= 0.0 {
            return None;
        }
        let ends = [segment, segment + 1].map(|node| &wire.nodes[node].kind);
        if beside_node.is_some() && !ends.iter().any(|kind| kind.is_on(body)) {
            return None;
        }
        let place = wire.nodes[segment].position + wire.span(segment) * parameter;
        let (place, between, lift) = match (contact_nodes::node_near(wire, arc), beside_node) {
            (Some(node), _) => (
                wire.nodes[node].position,
                [node.checked_sub(1)?, node + 1],
                0.0,
            ),
            (None, None) => (place, beside(wire, segment, body), 0.0),
            (None, Some(obstacles)) => {
                let velocity = velocity_at(wire, segment, parameter)
                    - world.bodies[body.0].velocity_at(&local);
                if velocity.dot(&contact.normal) > 0.0 {
                    return None;
                }
                let depth = wire.material.radius - obstacles.distance(world, body, &place);
                // As far as it hardly stretches the wire.
                let apart = wire.span(segment).norm() * parameter.min(1.0 - parameter);
                let lift = depth.clamp(0.0, LIFT * apart);
                (place, beside(wire, segment, body), lift)
            }
        };
        let direction = |node: usize| {
            let way = wire.nodes.get(node)?.position - place;
            Some((way - contact.normal * lift).normalize())
        };
        let [before, after] = [direction(between[0])?, direction(between[1])?];
        // Down on one side, and not as far up on the other: over an edge, not beside one.
        let slopes = [before, after].map(|direction| direction.dot(&contact.normal));
        let out = -(before + after);
        let bent = slopes[0].min(slopes[1]) <= -TURN && out.dot(&contact.normal) >= TURN;
        // The normal is across the segment to rounding.
        let (aside, _) = unit(&contact.normal.cross(&wire.span(segment)));
        let pressing =
            out.dot(&contact.normal) * contact_nodes::pressing_by_pull(&[-before, after]);
        let held = out.dot(&aside).abs() <= ASIDE * contact.friction * pressing;
        (bent && held).then(|| Bend {
            contact,
            wire,
            site: WireSite { wire: id, arc },
            body,
            local,
            lift,
            out: out.normalize(),
            aside,
        })
    }

    /// Whether friction can stop the wire sideways within this step.
    fn stops(&self, world: &World, record: &ContactRecord) -> bool {
        let (segment, parameter) = self.wire.at(self.site.arc);
        let mass = self.wire.material.mass_per_length() * self.wire.rest_length(segment) / 2.0;
        let velocity = velocity_at(self.wire, segment, parameter)
            - world.bodies[self.body.0].velocity_at(&self.local);
        let stopped = self.contact.friction * record.normal_force() * world.settings.step;
        mass * velocity.dot(&self.aside).abs() <= stopped
    }

    fn insertion(&self) -> ContactNodeInsertion {
        ContactNodeInsertion {
            wire: self.site.wire,
            arc: self.site.arc,
            body: self.body,
            normal: self.out,
            friction: self.contact.friction,
            aside: self.aside,
            lift: self.lift,
        }
    }
}

fn velocity_at(wire: &Wire, segment: usize, parameter: f64) -> Vector {
    let [start, end] = [segment, segment + 1].map(|node| wire.nodes[node].velocity);
    start.lerp(&end, parameter)
}

/// The nodes before and after a segment and its neighbours, as far as no other place of the body is
/// between.
fn beside(wire: &Wire, segment: usize, body: BodyId) -> [usize; 2] {
    let is_on = |node: usize| wire.nodes[node].kind.is_on(body);
    let last = wire.nodes.len() - 1;
    let before = segment.saturating_sub(usize::from(!is_on(segment)));
    let after = segment + 1 + usize::from(!is_on(segment + 1));
    [before, after.min(last)]
}

#[cfg(test)]
mod tests;

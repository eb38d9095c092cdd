//! Reduces the contact manifolds of pairs to the contacts that the solver gets.

use std::collections::{BTreeMap, BTreeSet};

use super::collision_shape::ManifoldPoint;
use crate::query::Point;
use crate::wire::Vector;
use crate::wire::contact::{ContactConstraint, ContactSite};
use crate::wire::model::wire::LEAST;
use crate::wire::model::{BodyId, NodeKind, WireId};
use crate::wire::site::SegmentId;
use crate::wire::world::World;

/// What has a box.
#[derive(Clone, Copy)]
pub(super) enum Collider {
    Body(BodyId),
    Segment(SegmentId),
}

/// A contact and the segment that it is on, if it is on one.
pub(super) type Found = (Option<SegmentId>, ContactConstraint);

/// By how much deeper in the body a wire may lie with the distance from a contact node: as chords do of a curve that turns
/// by twice this between its nodes.
pub(super) const CHORD: f64 = 0.125;

/// Adds the contacts of one pair. On a segment, a place between two others counts only if it is
/// deeper. In the half that a contact node on this body ends the node holds the wire, which turns there as a curve does
/// that the body has between: so only its midline is kept out of what is deeper than chords, and next to the node nothing
/// is.
pub(super) fn contacts_of(
    world: &World,
    [a, b]: [Collider; 2],
    spots: Vec<ManifoldPoint>,
    friction: f64,
    found: &mut Vec<Found>,
) {
    const DEEPER: f64 = 1e-9;
    let Collider::Body(other) = b else { return };
    let contacts = spots.iter().map(|spot| ContactConstraint {
        key: 0,
        a: place(world, a, spot),
        b: on_body(world, other, spot.points[1]),
        normal: spot.normal,
        gap: spot.gap,
        friction,
    });
    let mut contacts: Vec<ContactConstraint> = contacts.collect();
    let Collider::Segment(id) = a else {
        found.extend(contacts.into_iter().map(|contact| (None, contact)));
        return;
    };
    contacts.retain_mut(
        |contact| match from_contact_node(world, id, other, arc(contact)) {
            None => true,
            Some(apart) => {
                contact.gap += id.of(world).material.radius + CHORD * apart;
                apart > LEAST * id.of(world).resolution.length
            }
        },
    );
    contacts.sort_by(|a, b| arc(a).total_cmp(&arc(b)));
    let outer = [contacts.first(), contacts.last()];
    let outer = outer.map(|contact| contact.map_or(0.0, |contact| contact.gap));
    let last = contacts.len().saturating_sub(1);
    for (k, contact) in contacts.into_iter().enumerate() {
        let deeper = contact.gap < outer[0].min(outer[1]) - DEEPER;
        if k == 0 || k == last || deeper {
            found.push((Some(id), contact));
        }
    }
}

/// How far a place of a segment is from a node on a body, in m along it, if that is the nearer end.
fn from_contact_node(world: &World, id: SegmentId, body: BodyId, arc: f64) -> Option<f64> {
    let [start, end] = id.nodes(world);
    let nearer = if arc - start.arc < end.arc - arc {
        start
    } else {
        end
    };
    nearer.kind.is_on(body).then(|| (nearer.arc - arc).abs())
}

/// The place of a thing that touches at its surface. On a segment it is the one beside the surface, or the node
/// that it is next to, so that neighbours have one place there. On a segment shorter than it is thick, where the
/// surface may be beyond both ends, it is that of the midline, along the normal.
fn place(world: &World, thing: Collider, spot: &ManifoldPoint) -> ContactSite {
    /// Of the length of a segment.
    const NEXT: f64 = 1e-3;
    let surface = spot.points[0];
    let id = match thing {
        Collider::Body(body) => return on_body(world, body, surface),
        Collider::Segment(id) => id,
    };
    let [start, end] = id.ends(world);
    let span = end - start;
    let radius = id.of(world).material.radius;
    let point = if span.norm() < 2.0 * radius {
        surface + spot.normal * radius
    } else {
        surface
    };
    let parameter = (point - start).dot(&span) / span.norm_squared();
    let parameter = if !parameter.is_finite() || parameter < NEXT {
        0.0
    } else if parameter > 1.0 - NEXT {
        1.0
    } else {
        parameter
    };
    id.site(world, parameter).into()
}

fn on_body(world: &World, id: BodyId, point: Point) -> ContactSite {
    let body = &world.bodies[id.0];
    let local = body
        .orientation
        .inverse_transform_vector(&(point - body.position));
    ContactSite::Body { body: id, local }
}

fn arc(contact: &ContactConstraint) -> f64 {
    match contact.a {
        ContactSite::Wire { arc, .. } => arc,
        _ => 0.0,
    }
}

/// Leaves out the ends of wires: from a node that is fixed to a body, whatever of the wire
/// penetrates this body without a gap is one with it. So a wire may come from a point inside of a
/// body. Where that point is `inside` by more than the wire is thick, the node at which the wire comes out is left out as
/// well: it would be pushed out along the wire, against its tension.
pub(super) fn leave_out_ends(
    world: &World,
    inside: impl Fn(BodyId, &Point, f64) -> bool,
    found: &mut Vec<Found>,
) {
    let mut deep: BTreeSet<(BodyId, SegmentId)> = BTreeSet::new();
    for (segment, contact) in found.iter() {
        if let (Some(segment), ContactSite::Body { body, .. }, true) =
            (segment, contact.b, contact.gap < 0.0)
        {
            deep.insert((body, *segment));
        }
    }
    let mut ends = BTreeSet::new();
    let mut exits = BTreeSet::new();
    for (w, wire) in world.wires.iter().enumerate() {
        for (n, node) in wire.nodes.iter().enumerate() {
            let NodeKind::Eye { body, .. } = node.kind else {
                continue;
            };
            let at = |segment: usize| {
                let wire = WireId(w);
                (body, SegmentId { wire, segment })
            };
            let is_deep = |segment: &usize| deep.contains(&at(*segment));
            let after: Vec<usize> = (n + 1..).take_while(is_deep).collect();
            let before = (0..n.saturating_sub(1)).rev().take_while(is_deep);
            let before: Vec<usize> = before.collect();
            if inside(body, &node.position, wire.material.radius) {
                let last = wire.nodes.len() - 1;
                let out = [n + 1 + after.len(), n.saturating_sub(1 + before.len())];
                for node in out.into_iter().filter(|&node| node > 0 && node < last) {
                    exits.insert((body, w, wire.nodes[node].arc.to_bits()));
                }
            }
            ends.extend(after.into_iter().chain(before).map(at));
        }
    }
    found.retain(|(segment, contact)| match (segment, contact.a, contact.b) {
        (Some(segment), ContactSite::Wire { wire, arc }, ContactSite::Body { body, .. }) => {
            let is_exit = exits.contains(&(body, wire.0, arc.to_bits()));
            !is_exit && !ends.contains(&(body, *segment))
        }
        _ => true,
    });
}

/// At a node both segments name one place: the deeper one stays.
pub(super) fn join(found: Vec<Found>) -> Vec<ContactConstraint> {
    const SAME_DIRECTION: f64 = 0.99;
    let mut joined: Vec<ContactConstraint> = Vec::with_capacity(found.len());
    let mut at: BTreeMap<([usize; 3], u64), usize> = BTreeMap::new();
    for (_, contact) in found {
        let ContactSite::Wire { arc, .. } = contact.a else {
            joined.push(contact);
            continue;
        };
        match at.get(&(things(&contact), arc.to_bits())) {
            Some(&k) if joined[k].normal.dot(&contact.normal) > SAME_DIRECTION => {
                if contact.gap < joined[k].gap {
                    joined[k] = contact;
                }
            }
            _ => {
                at.insert((things(&contact), arc.to_bits()), joined.len());
                joined.push(contact);
            }
        }
    }
    joined
}

/// What a contact is between: whether A is a wire, its number, the number of the body B.
pub(super) fn things(contact: &ContactConstraint) -> [usize; 3] {
    let number = |place: &ContactSite| match *place {
        ContactSite::World => [0, 0],
        ContactSite::Body { body, .. } => [0, body.0],
        ContactSite::Wire { wire, .. } => [1, wire.0],
    };
    let ([kind, a], [_, b]) = (number(&contact.a), number(&contact.b));
    [kind, a, b]
}

/// How far two places of one thing are apart, in m.
pub(super) fn along(a: &ContactSite, b: &ContactSite) -> f64 {
    match (a, b) {
        (ContactSite::Wire { arc: a, .. }, ContactSite::Wire { arc: b, .. }) => (a - b).abs(),
        (ContactSite::Body { local: a, .. }, ContactSite::Body { local: b, .. }) => {
            Vector::metric_distance(a, b)
        }
        _ => f64::INFINITY,
    }
}

//! Wires against bodies, and bodies against each other: discretely, where a step starts (thesis,
//! 3.2.4).
//!
//! A place is a contact if the surfaces may meet within the step: nearer than both move and fall in
//! it. A contact that is apart lets its places come as far as they touch, so what comes fast is
//! stopped at the surface.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::UnitQuaternion;

use super::boxes::Boxes;
use super::collision_shape::{CollisionShape, PlacedShape};
use super::manifold::{Collider, along, contacts_of, join, leave_out_ends, things};
use crate::broad::Method;
use crate::parallel::mapped;
use crate::query::Point;
use crate::wire::contact::{ContactConstraint, ContactSite};
use crate::wire::error::CollisionError;
use crate::wire::model::{BodyId, WireId};
use crate::wire::record::ContactRecord;
use crate::wire::site::{SegmentId, WireSite};
use crate::wire::world::World;

/// Where the keys of contacts with bodies start.
pub(in crate::wire) const KEYS: u64 = 3 << 62;

/// As a part of a wire's radius: by how much deeper a wire may come into a body as a node is taken out, and by how much it
/// is pushed off a core at a time.
pub(super) const HAIR: f64 = 1.0 / 16.0;

/// How many pairs a thread tests at a time.
const SHARE: usize = 64;

/// The contacts with bodies of one world, from step to step.
pub(super) struct BodyContacts {
    boxes: Boxes,
    /// Of each body.
    forms: Vec<CollisionShape>,
    pub(super) known: KnownContacts,
}

/// What is known of contacts with bodies from the step before.
#[derive(Clone, Debug, Default)]
pub(in crate::wire) struct KnownContacts {
    /// The contacts of the last step.
    pub(in crate::wire) last: Vec<ContactConstraint>,
    /// Keys given so far.
    pub(in crate::wire) given: u64,
    /// Places of wires at which a body pushed in the last step.
    pub(in crate::wire) pushed: Vec<WireSite>,
}

/// A thing where the step starts, and how far it may come in it.
struct Moving<'f> {
    thing: Collider,
    placed: PlacedShape<'f>,
    travel: f64,
}

impl BodyContacts {
    pub(super) fn new(method: Method) -> Self {
        BodyContacts {
            boxes: Boxes::new(method),
            forms: Vec::new(),
            known: KnownContacts::default(),
        }
    }

    /// Wall-clock time in s of its broad phase so far.
    pub(super) fn broad_seconds(&self) -> f64 {
        self.boxes.seconds
    }

    /// The contacts of the step that starts now, and how many pairs were tested for them.
    pub(super) fn contacts(
        &mut self,
        world: &World,
        friction: f64,
    ) -> Result<(Vec<ContactConstraint>, usize), CollisionError> {
        self.learn(world)?;
        if world.bodies.is_empty() {
            return Ok((Vec::new(), 0));
        }
        let segments = segments(world);
        let moving = moving(world, &self.forms, &segments);
        let boxes = moving.iter().map(|m| m.placed.aabb(m.travel));
        self.boxes.place(boxes)?;
        let keep = |[a, b]: [usize; 2]| is_pair(world, [moving[a].thing, moving[b].thing]);
        let mut found = Vec::new();
        let pairs = self.boxes.pairs(keep);
        // Bodies come first: A is a segment or the later body.
        let of =
            |at: usize| [pairs[at].second(), pairs[at].first()].map(|item| &moving[item.index()]);
        let spots = mapped(pairs.len(), SHARE, |at| {
            let [a, b] = of(at);
            a.placed.touches(&b.placed, a.travel + b.travel)
        });
        for (at, spots) in spots.into_iter().enumerate() {
            let things = of(at).map(|moving| moving.thing);
            contacts_of(world, things, spots, friction, &mut found);
        }
        let tested = pairs.len();
        let inside = |body: BodyId, point: &Point, depth: f64| {
            self.placed(world, body).distance(point) < -depth
        };
        leave_out_ends(world, inside, &mut found);
        let mut contacts = join(found);
        self.known.name(&mut contacts);
        Ok((contacts, tested))
    }

    /// The shape of a body where it is.
    pub(super) fn placed(&self, world: &World, body: BodyId) -> PlacedShape<'_> {
        let placed = &world.bodies[body.0];
        self.forms[body.0].at(&placed.position, &placed.orientation)
    }

    /// Bodies that were added since the last step.
    fn learn(&mut self, world: &World) -> Result<(), CollisionError> {
        for body in self.forms.len()..world.bodies.len() {
            let form = CollisionShape::of_body(&world.bodies[body].shape);
            let body = BodyId(body);
            self.forms
                .push(form.map_err(|_| CollisionError::Mesh { body })?);
        }
        Ok(())
    }

    /// Whether the triangle that taking out a node sweeps meets a body that the wire does not meet.
    pub(super) fn is_swept(&self, world: &World, triangle: &[Point; 3]) -> bool {
        self.near(world, triangle)
            .any(|body| body.is_swept(triangle))
    }

    /// Whether taking out a node of a wire of this radius draws the wire deeper into a body, by more than a hair.
    pub(super) fn is_deepened(&self, world: &World, triangle: &[Point; 3], radius: f64) -> bool {
        self.near(world, triangle)
            .any(|body| body.deepens(triangle, radius) > HAIR * radius)
    }

    /// The bodies that the triangle which taking out a node sweeps may meet.
    fn near<'a>(
        &'a self,
        world: &'a World,
        [a, b, c]: &'a [Point; 3],
    ) -> impl Iterator<Item = PlacedShape<'a>> {
        let reach = (a - b).norm().max((c - b).norm());
        let bodies = world.bodies.iter().zip(&self.forms);
        let near =
            bodies.filter(move |(body, form)| (body.position - b).norm() <= form.extent + reach);
        near.map(|(body, form)| form.at(&body.position, &body.orientation))
    }
}

impl KnownContacts {
    /// Gives each contact the key of the nearest one of the last step between the same things.
    fn name(&mut self, contacts: &mut [ContactConstraint]) {
        let mut known = FreeKeys::default();
        for contact in self.last.drain(..) {
            known.add(contact);
        }
        for contact in contacts.iter_mut() {
            contact.key = known.take_nearest(contact).unwrap_or_else(|| {
                self.given += 1;
                KEYS + self.given
            });
        }
        self.last = contacts.to_vec();
    }

    /// The keys of contacts that were found where the last step started.
    pub(super) fn found(&self) -> BTreeSet<u64> {
        self.last.iter().map(|contact| contact.key).collect()
    }

    /// A key that no other contact has.
    pub(super) fn next_key(&mut self) -> u64 {
        self.given += 1;
        KEYS + self.given
    }

    /// Notes where bodies push on wires.
    pub(super) fn note(&mut self, records: &[ContactRecord]) {
        self.pushed.clear();
        for record in records {
            let ContactConstraint { key, a, .. } = record.contact;
            if let (ContactSite::Wire { wire, arc }, true) =
                (a, key > KEYS && record.normal_force() > 0.0)
            {
                self.pushed.push(WireSite { wire, arc });
            }
        }
    }

    /// Whether a body pushes on a wire strictly between two arc lengths.
    pub(super) fn pushes_between(&self, wire: WireId, from: f64, to: f64) -> bool {
        let inside = |site: &WireSite| site.wire == wire && site.arc > from && site.arc < to;
        self.pushed.iter().any(inside)
    }
}

/// Contacts whose keys may be taken, by what they are between.
#[derive(Default)]
struct FreeKeys {
    /// Those on wires: arc length as bits, which ascend as it does, then a number, and the key.
    on_wires: BTreeMap<[usize; 3], BTreeMap<(u64, usize), u64>>,
    between_bodies: BTreeMap<[usize; 3], Vec<ContactConstraint>>,
}

impl FreeKeys {
    fn add(&mut self, contact: ContactConstraint) {
        let things = things(&contact);
        if let ContactSite::Wire { arc, .. } = contact.a {
            let keys = self.on_wires.entry(things).or_default();
            keys.insert((arc.to_bits(), keys.len()), contact.key);
        } else {
            let contacts = self.between_bodies.entry(things).or_default();
            contacts.push(contact);
        }
    }

    /// Takes the key of the contact that is nearest to this one.
    fn take_nearest(&mut self, contact: &ContactConstraint) -> Option<u64> {
        let ContactSite::Wire { arc, .. } = contact.a else {
            let contacts = self.between_bodies.get_mut(&things(contact))?;
            let distance = |at: &usize| along(&contacts[*at].a, &contact.a);
            let all = 0..contacts.len();
            let nearest = all.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
            return Some(contacts.swap_remove(nearest).key);
        };
        let keys = self.on_wires.get_mut(&things(contact))?;
        let here = (arc.to_bits(), 0);
        let around = [keys.range(..here).next_back(), keys.range(here..).next()];
        let places = around.into_iter().flatten().map(|(place, _)| *place);
        let distance = |(bits, _): &(u64, usize)| (f64::from_bits(*bits) - arc).abs();
        let nearest = places.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        keys.remove(&nearest)
    }
}

/// All segments, each as a shape around its middle.
fn segments(world: &World) -> Vec<(SegmentId, CollisionShape)> {
    let all = world.wires.iter().enumerate().flat_map(|(w, wire)| {
        let wire_id = WireId(w);
        (0..wire.segments.len()).map(move |segment| {
            let wire = wire_id;
            SegmentId { wire, segment }
        })
    });
    let form =
        |id: SegmentId| CollisionShape::of_segment(&id.ends(world), id.of(world).material.radius);
    all.map(|id| (id, form(id))).collect()
}

/// Bodies, then segments, with the largest displacement of each in the step: at its speed and
/// falling.
fn moving<'f>(
    world: &World,
    forms: &'f [CollisionShape],
    segments: &'f [(SegmentId, CollisionShape)],
) -> Vec<Moving<'f>> {
    let step = world.settings.step;
    let fall = world.settings.gravity.norm() * step;
    let bodies = world.bodies.iter().zip(forms).enumerate();
    let bodies = bodies.map(|(b, (body, form))| {
        let (velocity, spin) = if body.dynamic {
            (body.velocity, body.angular_velocity)
        } else {
            body.prescribed(world.time(), step)
        };
        let extent = if form.extent.is_finite() {
            form.extent
        } else {
            0.0
        };
        let falling = if body.dynamic { fall } else { 0.0 };
        Moving {
            thing: Collider::Body(BodyId(b)),
            placed: form.at(&body.position, &body.orientation),
            travel: step * (velocity.norm() + spin.norm() * extent + falling),
        }
    });
    let segments = segments.iter().map(|(id, form)| {
        let [start, end] = id.ends(world);
        let speed = id.nodes(world).map(|node| node.velocity.norm());
        Moving {
            thing: Collider::Segment(*id),
            placed: form.at(&nalgebra::center(&start, &end), &UnitQuaternion::identity()),
            travel: step * (speed[0].max(speed[1]) + fall),
        }
    });
    bodies.chain(segments).collect()
}

/// Whether two things are a pair to test: a segment and a body of which it is no end and that does
/// not carry both of its nodes, or two bodies of which forces move one.
fn is_pair(world: &World, pair: [Collider; 2]) -> bool {
    match pair {
        [Collider::Body(a), Collider::Body(b)] => {
            [a, b].iter().any(|body| world.bodies[body.0].dynamic)
        }
        [Collider::Body(body), Collider::Segment(id)]
        | [Collider::Segment(id), Collider::Body(body)] => {
            let is_on = id.nodes(world).map(|node| node.kind.is_on(body));
            let is_end = id.nodes(world).iter().any(|node| node.kind.is_eye(body));
            !is_end && is_on != [true; 2]
        }
        [Collider::Segment(_), Collider::Segment(_)] => false,
    }
}

#[cfg(test)]
mod tests;

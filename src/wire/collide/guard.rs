//! One step with collisions.

use std::collections::BTreeSet;

use super::detect::{Found, Hit};
use super::hold::Hold;
use super::obstacle::Obstacles;
use super::record::{CollisionRecord, Outcome};
use super::segment::{pair_at, reach};
use super::touch::{Touch, Touches};
use super::{CollisionError, Collisions, Mode, bend, remesh};
use crate::wire::Vector;
use crate::wire::model::{WireId, World};
use crate::wire::record::ContactRecord;
use crate::wire::resolution::{Remesh, RemeshGuard, RemeshKind};
use crate::wire::step::motion::Motion;
use crate::wire::step::ride::Bend;
use crate::wire::step::watch::{Judgement, Watch};
use crate::wire::step::{Contact, Reason};

/// How often a step is solved again.
const ROUNDS: usize = 8;

/// Looks on while a step is made.
pub(super) struct Guard<'a, 'n> {
    collisions: &'a mut Collisions<'n>,
    contacts: Vec<Contact>,
    /// Contacts that were added during this step.
    added: Vec<Touch>,
    /// What was found in the motion that is made.
    found: Found,
    hold: Option<Hold>,
    record: CollisionRecord,
}

impl<'a, 'n> Guard<'a, 'n> {
    pub(super) fn new(
        collisions: &'a mut Collisions<'n>,
        world: &World,
        given: &[Contact],
    ) -> Result<Self, CollisionError> {
        let mut record = CollisionRecord::default();
        collisions.touches.refresh(world);
        let mut contacts = given.to_vec();
        contacts.extend(collisions.touches.contacts(collisions.friction));
        if let Some(obstacles) = &mut collisions.obstacles {
            let (found, tested) = obstacles.contacts(world, collisions.friction)?;
            contacts.extend(found);
            record.tested_bodies = tested;
        }
        Ok(Guard {
            collisions,
            contacts,
            added: Vec::new(),
            found: Found::default(),
            hold: None,
            record,
        })
    }

    /// A contact for each hit that has a normal; whether there is any.
    fn add_contacts(&mut self, world: &World, hits: &[Hit]) -> bool {
        let before = self.added.len();
        for hit in hits {
            if let (Some((normal, apart)), Some(pair)) = (hit.normal(), pair_at(world, &hit.sites))
            {
                let touch = self.collisions.touches.make(hit.sites, normal);
                let gap = apart - reach(world, pair);
                let contact = touch.row(normal, gap, self.collisions.friction);
                self.contacts.push(contact);
                self.added.push(touch);
            }
        }
        self.added.len() > before
    }

    /// Ends the step: what was found becomes contacts of the next.
    pub(super) fn finish(mut self, world: &World, contacts: &[ContactRecord]) -> CollisionRecord {
        let touches = &mut self.collisions.touches;
        touches.add(world, self.added);
        // A passage at a node is found by every segment there.
        let mut passed = BTreeSet::new();
        for hit in &self.found.hits {
            if passed.insert(pair_at(world, &hit.sites)) {
                let outcome = passage(touches, world, hit);
                self.record.crossings.push(hit.crossing(outcome));
            }
        }
        self.record.pairs = self.found.pairs;
        touches.release(world, contacts);
        if let Some(obstacles) = &mut self.collisions.obstacles {
            obstacles.note(contacts);
        }
        // So that what is near is known by a contact that slid there.
        touches.refresh(world);
        let near = self.found.near.into_iter();
        let near: Vec<Touch> = near
            .map(|(sites, normal)| touches.make(sites, normal))
            .collect();
        touches.add(world, near);
        if let Some(hold) = self.hold {
            self.record.held = hold.held(world);
        }
        self.record
    }
}

/// What a hit that was not prevented came to. Wires that came through change sides, in the ledger of their
/// contact. Where a step ends in contact, the contact keeps the side from which they came, and the step after tells.
fn passage(touches: &mut Touches, world: &World, hit: &Hit) -> Outcome {
    let [before, after] = hit.apart();
    let known = |touches: &mut Touches| touches.nearest(world, &hit.sites).map(|t| t.side());
    let before = before.or_else(|| known(touches));
    let came_through = before.zip(after).map(|(a, b)| a.dot(&b) < 0.0);
    let ends_in_contact = before.is_some() && after.is_none();
    if came_through != Some(true) && !ends_in_contact {
        return Outcome::Grazed;
    }
    if let (None, Some((normal, _))) = (touches.nearest(world, &hit.sites), hit.normal()) {
        let new = touches.make(hit.sites, normal);
        touches.add(world, [new]);
    }
    if ends_in_contact {
        return Outcome::Grazed;
    }
    match touches.nearest(world, &hit.sites) {
        Some(touch) => {
            touch.wrong = !touch.wrong;
            if touch.wrong {
                Outcome::Tunnelled
            } else {
                Outcome::Returned
            }
        }
        None => Outcome::Grazed,
    }
}

impl Watch for Guard<'_, '_> {
    fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    fn judge(
        &mut self,
        world: &World,
        motion: &Motion,
        impulses: &[Vector],
    ) -> Result<Judgement, Reason> {
        let Collisions {
            pipeline,
            narrow,
            filter,
            ..
        } = &mut *self.collisions;
        let found = pipeline.detect(world, motion, *narrow, *filter, &mut self.record)?;
        if found.hits.is_empty() || self.collisions.mode == Mode::Thesis {
            self.found = found;
            return Ok(Judgement::Accept);
        }
        let prevented = found
            .hits
            .iter()
            .map(|hit| hit.crossing(Outcome::Prevented));
        self.record.crossings.extend(prevented);
        if self.hold.is_none() && self.record.rounds < ROUNDS {
            self.record.rounds += 1;
            if self.add_contacts(world, &found.hits) {
                return Ok(Judgement::Solve);
            }
        }
        let start = || Hold::new(world, &self.contacts, impulses);
        let hold = self.hold.get_or_insert_with(start);
        if hold.is_still() {
            let sites = found.hits[0].sites;
            return Err(CollisionError::Touching { sites }.into());
        }
        hold.shorten(&found.hits);
        Ok(Judgement::Hold(hold.shares()))
    }

    fn contact_nodes(&self, world: &World, contacts: &[ContactRecord]) -> Vec<Bend> {
        if self.collisions.contact_nodes {
            bend::bends(world, contacts)
        } else {
            Vec::new()
        }
    }
}

impl RemeshGuard for Guard<'_, '_> {
    /// In guard mode: not if it would meet a segment or go through a body, nor if it moves a stretch on which a contact
    /// pushes, other than by a hair beside a contact node.
    fn permits(&mut self, world: &World, change: &Remesh) -> bool {
        let Collisions {
            filter,
            mode,
            touches,
            obstacles,
            ..
        } = &*self.collisions;
        let [from, _, to] = change.arcs;
        let by_body = |o: &Obstacles| {
            let straightens = remesh::straightens_beside_contact_node(world, change);
            o.pushes_between(change.wire, from, to) && !straightens
        };
        let loaded = || {
            touches.pushes_between(change.wire.0, from, to)
                || obstacles.as_ref().is_some_and(by_body)
        };
        let through = || {
            let obstacles = obstacles.as_ref();
            obstacles.is_some_and(|o| o.is_swept(world, &change.triangle))
        };
        let refused = *mode == Mode::Guard
            && (change.kind == RemeshKind::Merge && (loaded() || through())
                // A triangle that cannot be tested is not swept.
                || remesh::meets(world, change, *filter).unwrap_or(true));
        self.record.refused += usize::from(refused);
        !refused
    }

    /// Where wires push on wires.
    fn bends(&self, wire: WireId, from: f64, to: f64) -> bool {
        self.collisions.touches.pushes_between(wire.0, from, to)
    }
}

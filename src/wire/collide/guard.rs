//! One step with collisions.

use std::collections::BTreeSet;

use super::body_detect::CoreHits;
use super::collisions::{Collisions, Mode};
use super::core_pairs::Clearance;
use super::detect::{Detections, MidlineHit};
use super::islands::Islands;
use super::parts::Parts;
use super::segment::pair_at;
use super::thickness::Thickness;
use super::wire_contacts::{WireContact, WireContacts};
use super::{body_remesh, contact_node_insertion, remesh, winding};
use crate::wire::Vector;
use crate::wire::contact::ContactConstraint;
use crate::wire::error::CollisionError;
use crate::wire::error::Reason;
use crate::wire::model::WireId;
use crate::wire::record::ContactRecord;
use crate::wire::record::{BodyCrossingOutcome, CollisionRecord, CrossingOutcome};
use crate::wire::resolution::{Remesh, RemeshGuard, RemeshKind};
use crate::wire::step::callbacks::{MotionReview, StepCallbacks};
use crate::wire::step::contact_nodes::ContactNodeInsertion;
use crate::wire::step::motion::ProposedMotion;
use crate::wire::world::World;

/// How often a step is solved again.
const ROUNDS: usize = 8;

/// Looks on while a step is made.
pub(super) struct Guard<'a, 'n> {
    collisions: &'a mut Collisions<'n>,
    contacts: Vec<ContactConstraint>,
    /// Contacts that were added during this step.
    added: Vec<WireContact>,
    /// What was found in the motion that is made.
    found: Detections,
    islands: Option<Islands>,
    /// In place of islands, where thickness is guarded.
    parts: Option<Parts>,
    record: CollisionRecord,
}

impl<'a, 'n> Guard<'a, 'n> {
    pub(super) fn new(
        collisions: &'a mut Collisions<'n>,
        world: &World,
        given: &[ContactConstraint],
    ) -> Result<Self, CollisionError> {
        let thickness = collisions.thickness();
        let mut record = CollisionRecord {
            guarded_thickness: thickness.0,
            ..CollisionRecord::default()
        };
        collisions.touches.refresh(world, thickness);
        let mut contacts = given.to_vec();
        let friction = collisions.settings.friction;
        contacts.extend(collisions.touches.contacts(friction));
        if collisions.settings.bodies {
            collisions.cores.learn(world);
            let (found, tested) = collisions.obstacles.contacts(world, friction)?;
            contacts.extend(found);
            record.tested_bodies = tested;
        }
        Ok(Guard {
            collisions,
            contacts,
            added: Vec::new(),
            found: Detections::default(),
            islands: None,
            parts: None,
            record,
        })
    }

    /// What touches cores, unless bodies are the caller's.
    fn touched_cores(
        &mut self,
        world: &World,
        motion: &ProposedMotion,
    ) -> Result<CoreHits, CollisionError> {
        if !self.collisions.settings.bodies {
            return Ok(CoreHits::default());
        }
        let cores = &mut self.collisions.cores;
        cores.detect(world, motion, &mut self.record)
    }

    /// Whether one more contact would say of a hit what another one says already: where thick wires
    /// lie on each other, solving again with hundreds of these costs much and changes nothing.
    fn is_kept_apart(
        &self,
        world: &World,
        thickness: Thickness,
        hit: &MidlineHit,
        normal: &Vector,
    ) -> bool {
        let mut added = self.added.iter();
        let touches = &self.collisions.touches;
        added.any(|touch| touch.keeps_apart(world, thickness, &hit.sites, normal))
            || touches.keep_apart(world, thickness, &hit.sites, normal)
    }

    /// A contact for each hit that has a normal; whether there is any that is new.
    fn add_contacts(&mut self, world: &World, hits: &[MidlineHit]) -> bool {
        let thickness = self.collisions.thickness();
        let before = self.added.len();
        for hit in hits {
            if let (Some((normal, apart)), Some(pair)) = (hit.normal(), pair_at(world, &hit.sites))
            {
                if thickness.is_guarded() && self.is_kept_apart(world, thickness, hit, &normal) {
                    continue;
                }
                let touch = self.collisions.touches.make(hit.sites, normal);
                let gap = apart - thickness.touching(world, pair, &hit.sites);
                let contact = touch.row(normal, gap, self.collisions.settings.friction);
                self.contacts.push(contact);
                self.added.push(touch);
            }
        }
        self.added.len() > before
    }

    /// A contact for each touch of a core that has a normal; whether there is any.
    fn add_core_contacts(
        &mut self,
        world: &World,
        motion: &ProposedMotion,
        hits: &CoreHits,
    ) -> bool {
        let before = self.contacts.len();
        let known = &mut self.collisions.obstacles.known;
        let cores = &self.collisions.cores.cores;
        let friction = self.collisions.settings.friction;
        for hit in &hits.bodies {
            let clearance = Clearance::of(hit.bodies().map(|body| &cores[body.0]));
            let row = hit.row(world, motion, clearance, friction, known.next_key());
            self.contacts.extend(row);
        }
        let mut placed = BTreeSet::new();
        for hit in &hits.midlines {
            let inset = cores[hit.body.0].inset();
            let key = known.next_key();
            let row = hit.row(world, motion, inset, friction, key);
            // A node is found by the segments on both sides.
            if placed.insert((hit.body, hit.site.wire, hit.site.arc.to_bits())) {
                self.contacts.extend(row);
            }
        }
        self.contacts.len() > before
    }

    /// Ends the step: what was found becomes contacts of the next.
    pub(super) fn finish(mut self, world: &World, contacts: &[ContactRecord]) -> CollisionRecord {
        let thickness = self.collisions.thickness();
        let touches = &mut self.collisions.touches;
        touches.add(world, thickness, self.added);
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
        if self.collisions.settings.bodies {
            self.collisions.obstacles.known.note(contacts);
        }
        // So that what is near is known by a contact that slid there.
        touches.refresh(world, thickness);
        let near = self.found.near.into_iter();
        let near: Vec<WireContact> = near
            .map(|(sites, normal)| touches.make(sites, normal))
            .collect();
        touches.add(world, thickness, near);
        if self.collisions.settings.mode == Mode::Guard {
            touches.add_along(world, thickness);
        }
        if let Some(islands) = self.islands {
            self.record.scaled_islands = islands.scaled(world);
        }
        if let Some(parts) = self.parts {
            self.record.scaled_islands = parts.scaled(world);
        }
        self.record
    }
}

/// What a hit that was not prevented came to. Wires that came through change sides, in the ledger
/// of their contact. Where a step ends in contact, the contact keeps the side from which they came,
/// and the step after tells.
fn passage(touches: &mut WireContacts, world: &World, hit: &MidlineHit) -> CrossingOutcome {
    let [before, after] = hit.separations();
    let known = |touches: &mut WireContacts| touches.nearest(world, &hit.sites).map(|t| t.side());
    let before = before.or_else(|| known(touches));
    let came_through = before.zip(after).map(|(a, b)| a.dot(&b) < 0.0);
    let ends_in_contact = before.is_some() && after.is_none();
    if came_through != Some(true) && !ends_in_contact {
        return CrossingOutcome::Grazed;
    }
    if let (None, Some((normal, _))) = (touches.nearest(world, &hit.sites), hit.normal()) {
        let new = touches.make(hit.sites, normal);
        touches.add(world, Thickness::default(), [new]);
    }
    if ends_in_contact {
        return CrossingOutcome::Grazed;
    }
    match touches.nearest(world, &hit.sites) {
        Some(touch) => {
            touch.wrong = !touch.wrong;
            if touch.wrong {
                CrossingOutcome::Tunnelled
            } else {
                CrossingOutcome::Returned
            }
        }
        None => CrossingOutcome::Grazed,
    }
}

/// What still meets though nothing moves.
fn touching(wires: &[MidlineHit], cores: &CoreHits) -> CollisionError {
    match (wires, &cores.midlines[..], &cores.bodies[..]) {
        ([], [first, ..], _) => CollisionError::TouchingBody {
            site: first.site,
            body: first.body,
        },
        ([], [], [first, ..]) => CollisionError::TouchingBodies {
            bodies: first.bodies(),
        },
        _ => CollisionError::Touching {
            sites: wires[0].sites,
        },
    }
}

impl StepCallbacks for Guard<'_, '_> {
    fn contacts(&self) -> &[ContactConstraint] {
        &self.contacts
    }

    fn review(
        &mut self,
        world: &World,
        motion: &ProposedMotion,
        impulses: &[Vector],
    ) -> Result<MotionReview, Reason> {
        let thickness = self.collisions.thickness();
        let Collisions {
            pipeline,
            narrow,
            filter,
            ..
        } = &mut *self.collisions;
        let found =
            pipeline.detect(world, motion, *narrow, *filter, thickness, &mut self.record)?;
        let touched = self.touched_cores(world, motion)?;
        let outcome = match self.collisions.settings.mode {
            Mode::Guard => BodyCrossingOutcome::Prevented,
            Mode::Thesis => BodyCrossingOutcome::Passed,
        };
        let midlines = touched.midlines.iter();
        let midlines = midlines.map(|hit| hit.crossing(outcome));
        self.record.body_crossings.extend(midlines);
        let bodies = touched.bodies.iter().map(|hit| hit.crossing(outcome));
        self.record.core_crossings.extend(bodies);
        let is_free = found.hits.is_empty() && touched.is_empty();
        if is_free || self.collisions.settings.mode == Mode::Thesis {
            self.found = found;
            return Ok(MotionReview::Accept);
        }
        let prevented = found
            .hits
            .iter()
            .map(|hit| hit.crossing(CrossingOutcome::Prevented));
        self.record.crossings.extend(prevented);
        let may_solve = self.record.rounds < ROUNDS && self.record.unsolved_rounds == 0;
        if self.islands.is_none() && self.parts.is_none() && may_solve {
            self.record.rounds += 1;
            let between_wires = self.add_contacts(world, &found.hits);
            if self.add_core_contacts(world, motion, &touched) || between_wires {
                return Ok(MotionReview::SolveAgain);
            }
        }
        if thickness.is_guarded() {
            let parts = self.parts.get_or_insert_with(|| Parts::new(world));
            if !parts.shorten(world, &found.hits, &touched) {
                return Err(touching(&found.hits, &touched).into());
            }
            return Ok(MotionReview::Scale(parts.motion_scales()));
        }
        let start = || Islands::new(world, &self.contacts, impulses);
        let islands = self.islands.get_or_insert_with(start);
        if islands.is_still() {
            return Err(touching(&found.hits, &touched).into());
        }
        islands.shorten(world, &found.hits, &touched);
        Ok(MotionReview::Scale(islands.motion_scales(world)))
    }

    fn keep_solution(&mut self) {
        self.record.unsolved_rounds += 1;
    }

    fn contact_nodes(
        &self,
        world: &World,
        contacts: &[ContactRecord],
    ) -> Vec<ContactNodeInsertion> {
        if self.collisions.settings.contact_nodes {
            contact_node_insertion::insertions(world, contacts, &self.collisions.obstacles.known)
        } else {
            Vec::new()
        }
    }

    fn winding(&self, world: &World) -> Vec<ContactNodeInsertion> {
        let settings = &self.collisions.settings;
        if settings.contact_nodes && settings.bodies {
            winding::insertions(world, &self.collisions.obstacles, settings.friction)
        } else {
            Vec::new()
        }
    }
}

impl RemeshGuard for Guard<'_, '_> {
    /// In guard mode: not if it would meet a segment, or come nearer than it may, or go through a body, nor if it moves a
    /// stretch on which a contact pushes, other than by a hair beside a contact node.
    fn permits(&mut self, world: &World, change: &Remesh) -> bool {
        let Collisions {
            filter,
            settings,
            touches,
            obstacles,
            cores,
            ..
        } = &*self.collisions;
        let bodies = settings.bodies;
        let thickness = self.collisions.thickness();
        let [from, _, to] = change.arcs;
        let radius = world.wires[change.wire.0].material.radius;
        let by_body = || {
            let is_held = obstacles.known.pushes_between(change.wire, from, to)
                || obstacles.is_deepened(world, &change.triangle, radius);
            is_held && !remesh::straightens_beside_contact_node(world, change)
        };
        let loaded = || touches.pushes_between(change.wire.0, from, to) || bodies && by_body();
        let through = || bodies && obstacles.is_swept(world, &change.triangle);
        let refused = settings.mode == Mode::Guard
            && (change.kind == RemeshKind::Merge && (loaded() || through())
                // A triangle that cannot be tested is not swept.
                || remesh::meets(world, change, *filter, thickness).unwrap_or(true)
                || bodies
                    && body_remesh::meets(world, change, &cores.cores).unwrap_or(true));
        self.record.refused_remeshes += usize::from(refused);
        !refused
    }

    /// Where wires push on wires.
    fn needs_fine_resolution(&self, wire: WireId, from: f64, to: f64) -> bool {
        self.collisions.touches.pushes_between(wire.0, from, to)
    }
}

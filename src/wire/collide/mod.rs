//! Wires that touch wires, themselves included, and bodies; bodies that touch bodies.
//!
//! [`World::step_colliding`] does a step in which no wire passes through a wire. What it remembers
//! from step to step is in [`Collisions`]: which broad and narrow phase, and the contacts there
//! are.
//!
//! The midlines are tested continuously, from where a step starts to where it would end (`detect`):
//! swept boxes, broad phase, exclusion of slow pairs, narrow phase. Pairs that do not meet on the
//! way but end up closer than their radii get a contact for the next step (thesis 3.2.4). Contacts
//! stay on their place of the material and slide with the closest points (`touch`). What a crossing
//! leads to is the [`Mode`]. Contacts with bodies are found where a step starts (`obstacle`), by a
//! collision library (`form`).
//!
//! ```
//! use tunnelproof::query::Point;
//! use tunnelproof::wire::{Collisions, Material, Settings, Stop, Vector, WirePlan, World};
//!
//! let mut world = World::new(Settings::default())?;
//! let wire = |from: [f64; 3], to: [f64; 3], stop: fn(Point) -> Stop| {
//!     WirePlan::new(Material::steel(0.02), 0.25, [from, to].map(|p| stop(p.into())).to_vec())
//! };
//! world.add_wire(&wire([0.0, -1.0, 0.0], [0.0, 1.0, 0.0], Stop::Pinned))?;
//! let mut falling = wire([-1.0, 0.0, 0.1], [1.0, 0.0, 0.1], Stop::Free);
//! falling.velocity = Vector::new(0.0, 0.0, -10.0);
//! world.add_wire(&falling)?;
//! let mut collisions = Collisions::default();
//! let record = world.step_colliding(&mut collisions, &[])?;
//! // It would have come through at a node, which is an end of four pairs of segments.
//! assert_eq!(record.collisions.crossings.len(), 4);
//! // Their middles are apart by both radii.
//! let [below, above] = [0, 1].map(|wire| record.wires[wire].after[4]);
//! assert!((above.z - below.z - 0.04).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod body_contacts;
mod boxes;
mod collision_shape;
mod contact_node_insertion;
mod detect;
mod guard;
mod islands;
mod manifold;
mod remesh;
mod segment;
mod wire_contacts;

#[cfg(test)]
mod tests;

use crate::broad::Method;
use crate::certified::Certified;
use crate::narrow::NarrowPhase;
use crate::wire::clock::Clock;
use crate::wire::contact::ContactConstraint;
use crate::wire::error::StepError;
use crate::wire::model::ModelError;
use crate::wire::model::check::not_negative;
use crate::wire::record::StepRecord;
use crate::wire::site::SegmentId;
use crate::wire::world::World;
use body_contacts::BodyContacts;
use detect::Pipeline;
use guard::Guard;
use wire_contacts::WireContacts;

/// What becomes of a crossing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// It is prevented: the step is solved again with a contact there, and if that does not help,
    /// what takes part moves only as far as it may. Changes of resolution that would cross are
    /// refused, by the certified path whatever narrow phase tests motions.
    #[default]
    Guard,
    /// It happens, as in the thesis: the contact comes with the next step and pushes the wires back
    /// through each other. Changes of resolution are not tested.
    Thesis,
}

/// Which pairs of segments are tested at all, over and above those that are joined.
pub type PairFilter<'n> = &'n dyn Fn(SegmentId, SegmentId) -> bool;

/// The collisions in one world: how they are found, and the contacts there are.
pub struct Collisions<'n> {
    narrow: &'n dyn NarrowPhase,
    filter: Option<PairFilter<'n>>,
    mode: Mode,
    friction: f64,
    pipeline: Pipeline,
    touches: WireContacts,
    /// None if bodies are the caller's.
    obstacles: Option<BodyContacts>,
    /// Whether wires get contact nodes where bodies bend them.
    contact_nodes: bool,
}

impl Default for Collisions<'_> {
    /// The certified path after sweep-and-prune in guard mode, friction 0.5.
    fn default() -> Self {
        Collisions::new(Mode::default(), Method::default(), &Certified)
    }
}

impl<'n> Collisions<'n> {
    /// Collisions found by a broad and a narrow phase; friction 0.5, no filter. What guard mode
    /// promises of motions it promises as far as the narrow phase misses nothing.
    pub fn new(mode: Mode, method: Method, narrow: &'n dyn NarrowPhase) -> Self {
        Collisions {
            narrow,
            filter: None,
            mode,
            friction: 0.5,
            pipeline: Pipeline::new(method),
            touches: WireContacts::default(),
            obstacles: Some(BodyContacts::new(method)),
            contact_nodes: false,
        }
    }

    /// The same with another coefficient of friction, of all contacts that are found.
    ///
    /// # Errors
    ///
    /// A coefficient that is not a finite number of at least 0.
    pub fn with_friction(mut self, friction: f64) -> Result<Self, ModelError> {
        not_negative("friction", friction)?;
        self.friction = friction;
        Ok(self)
    }

    /// The same for those pairs only that `filter` keeps. The others pass through each other.
    #[must_use]
    pub fn with_filter(mut self, filter: PairFilter<'n>) -> Self {
        self.filter = Some(filter);
        self
    }

    /// The same without contacts with bodies: all of them are given to the step.
    #[must_use]
    pub fn without_bodies(mut self) -> Self {
        self.obstacles = None;
        self
    }

    /// The same with contact nodes for adaptive wires: where a body that was found to touch one
    /// bends it between two nodes, it gets another one there, which is attached to the body, and
    /// over which wire sticks or slides ([`NodeKind::Contact`](crate::wire::NodeKind)). It leaves
    /// where the wire turns away from the body, and with the end of the wire.
    #[must_use]
    pub fn with_contact_nodes(mut self) -> Self {
        self.contact_nodes = true;
        self
    }

    /// What becomes of a crossing.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Wall-clock time in s of all broad phases so far.
    fn broad_seconds(&self) -> f64 {
        let obstacles = self
            .obstacles
            .as_ref()
            .map_or(0.0, BodyContacts::broad_seconds);
        self.pipeline.broad_seconds() + obstacles
    }
}

impl World {
    /// Does one step in which wires collide with wires and bodies, and bodies with bodies. `given`
    /// are more contacts; keys from 2^63 on are not theirs to use.
    ///
    /// In guard mode no wire passes through another or through itself, changes of resolution
    /// included. Segments that share a node, or are fixed to the same point, are not tested against
    /// each other.
    ///
    /// # Errors
    ///
    /// As [`step`](Self::step), and [`CollisionError`] in
    /// [`Reason::Collision`](crate::wire::Reason::Collision): in guard mode, if midlines touch
    /// before the step. The world is as before.
    pub fn step_colliding(
        &mut self,
        collisions: &mut Collisions<'_>,
        given: &[ContactConstraint],
    ) -> Result<StepRecord, StepError> {
        let before = collisions.broad_seconds();
        let mut clock = Clock::start();
        let mut guard = Guard::new(collisions, self, given).map_err(|error| StepError {
            step: self.steps,
            reason: error.into(),
        })?;
        let found = clock.lap();
        let mut record = self.advance(&mut guard)?;
        clock.lap();
        record.collisions = guard.finish(self, &record.contacts);
        record.phases.broad = collisions.broad_seconds() - before;
        record.phases.narrow += found + clock.lap() - record.phases.broad;
        Ok(record)
    }
}

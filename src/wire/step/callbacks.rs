//! Callbacks of a step: its contacts, the review of its motion, changes of resolution.

use super::contact_nodes::ContactNodeInsertion;
use super::motion::{MotionScales, ProposedMotion};
use crate::wire::error::Reason;
use crate::wire::model::WireId;
use crate::wire::record::ContactRecord;
use crate::wire::resolution::{Remesh, RemeshGuard};
use crate::wire::world::World;
use crate::wire::{ContactConstraint, Vector};

/// Gives the contacts of a step, reviews the motion, and permits changes of resolution.
pub(in crate::wire) trait StepCallbacks: RemeshGuard {
    /// The contacts to solve with. Until the step ends they may only become more.
    fn contacts(&self) -> &[ContactConstraint];

    /// What to do with a motion that was solved for, with the impulses of its contacts.
    fn review(
        &mut self,
        world: &World,
        motion: &ProposedMotion,
        impulses: &[Vector],
    ) -> Result<MotionReview, Reason>;

    /// The system could not be solved with all contacts: the motion before stands, and may be scaled
    /// alone.
    fn keep_solution(&mut self) {}

    /// After the motion, with the contacts that it was made with: where wires get contact nodes.
    fn contact_nodes(
        &self,
        _world: &World,
        _contacts: &[ContactRecord],
    ) -> Vec<ContactNodeInsertion> {
        Vec::new()
    }

    /// Where wires that come onto bodies beside nodes that these carry get another one.
    fn winding(&self, _world: &World) -> Vec<ContactNodeInsertion> {
        Vec::new()
    }
}

/// What becomes of a motion.
pub(in crate::wire) enum MotionReview {
    /// It is made.
    Accept,
    /// There are more contacts: it is solved for again.
    SolveAgain,
    /// It is scaled by these factors and reviewed again.
    Scale(MotionScales),
}

/// Contacts and the guard that a user gave; every motion is accepted.
pub(super) struct Given<'a> {
    pub(super) contacts: &'a [ContactConstraint],
    pub(super) guard: &'a mut dyn RemeshGuard,
}

impl StepCallbacks for Given<'_> {
    fn contacts(&self) -> &[ContactConstraint] {
        self.contacts
    }

    fn review(
        &mut self,
        _: &World,
        _: &ProposedMotion,
        _: &[Vector],
    ) -> Result<MotionReview, Reason> {
        Ok(MotionReview::Accept)
    }
}

impl RemeshGuard for Given<'_> {
    fn permits(&mut self, world: &World, change: &Remesh) -> bool {
        self.guard.permits(world, change)
    }

    fn needs_fine_resolution(&self, wire: WireId, from: f64, to: f64) -> bool {
        self.guard.needs_fine_resolution(wire, from, to)
    }
}

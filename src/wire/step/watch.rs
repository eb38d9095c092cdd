//! Who looks on while a step is made.

use super::motion::{Motion, Shares};
use super::ride::Bend;
use crate::wire::error::Reason;
use crate::wire::model::WireId;
use crate::wire::record::ContactRecord;
use crate::wire::resolution::{Remesh, RemeshGuard};
use crate::wire::world::World;
use crate::wire::{Contact, Vector};

/// Gives the contacts of a step, judges where they lead, and permits changes of resolution.
pub(in crate::wire) trait Watch: RemeshGuard {
    /// The contacts to solve with. Until the step ends they may only become more.
    fn contacts(&self) -> &[Contact];

    /// What to do with a motion that was solved for, with the impulses of its contacts.
    fn judge(
        &mut self,
        world: &World,
        motion: &Motion,
        impulses: &[Vector],
    ) -> Result<Judgement, Reason>;

    /// After the motion, with the contacts that it was made with: where wires get contact nodes.
    fn contact_nodes(&self, _world: &World, _contacts: &[ContactRecord]) -> Vec<Bend> {
        Vec::new()
    }
}

/// What becomes of a motion.
pub(in crate::wire) enum Judgement {
    /// It is made.
    Accept,
    /// There are more contacts: it is solved for again.
    Solve,
    /// It is made to these shares, if they are accepted.
    Hold(Shares),
}

/// Contacts and the guard that a user gave; every motion is accepted.
pub(super) struct Given<'a> {
    pub(super) contacts: &'a [Contact],
    pub(super) guard: &'a mut dyn RemeshGuard,
}

impl Watch for Given<'_> {
    fn contacts(&self) -> &[Contact] {
        self.contacts
    }

    fn judge(&mut self, _: &World, _: &Motion, _: &[Vector]) -> Result<Judgement, Reason> {
        Ok(Judgement::Accept)
    }
}

impl RemeshGuard for Given<'_> {
    fn permits(&mut self, world: &World, change: &Remesh) -> bool {
        self.guard.permits(world, change)
    }

    fn bends(&self, wire: WireId, from: f64, to: f64) -> bool {
        self.guard.bends(wire, from, to)
    }
}

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
//! leads to is the [`Mode`]. How far apart thick wires are kept is in `thickness`, and what moves less so that
//! they are, in `islands` and `parts`. Contacts with bodies are found where a step starts (`body_contacts`), by
//! a collision library (`collision_shape`); where these bend a wire, and where it comes onto a body that turns, it gets contact
//! nodes (`contact_node_insertion`, `winding`). Besides, midlines are tested continuously against the
//! cores of bodies (`body_detect`), and cores against each other (`core_pairs`): no motion that is made
//! lets them touch.
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
mod body_detect;
mod body_motion;
mod body_remesh;
mod boxes;
mod collision_shape;
mod collisions;
mod contact_node_insertion;
mod core_boxes;
mod core_pairs;
mod detect;
mod guard;
mod inside;
mod islands;
mod manifold;
mod memory;
mod overlap;
mod parts;
mod remesh;
mod segment;
mod thickness;
mod winding;
mod wire_contacts;

#[cfg(test)]
mod tests;

pub use collisions::{CollisionSettings, Collisions, Mode};
pub use memory::CollisionMemory;
pub use segment::PairFilter;
#[cfg(feature = "recording")]
pub(in crate::wire) use {
    body_contacts::{KEYS as BODY_KEYS, KnownContacts},
    wire_contacts::{KEYS as WIRE_KEYS, Side, WireContact, WireContacts},
};

use crate::wire::clock::Clock;
use crate::wire::contact::ContactConstraint;
use crate::wire::error::StepError;
use crate::wire::record::StepRecord;
use crate::wire::world::World;
use guard::Guard;

impl World {
    /// Does one step in which wires collide with wires and bodies, and bodies with bodies. `given`
    /// are more contacts; keys from 2^63 on are not theirs to use.
    ///
    /// In guard mode no wire passes through another or through itself, and none through a body,
    /// changes of resolution included. No body passes through another one, unless both are scripted. With a [guarded share of the
    /// thickness](Collisions::with_guarded_thickness) no wire comes within it either. Segments that share a node, or are fixed to the same point,
    /// are not tested against each other. A segment that touches the core of a body, or is inside
    /// it, is not tested against this body until it is outside; two bodies whose cores touch or overlap
    /// are not tested until they are apart.
    ///
    /// # Errors
    ///
    /// As [`step`](Self::step), and [`CollisionError`](crate::wire::CollisionError) in
    /// [`Reason::Collision`](crate::wire::Reason::Collision): in guard mode, if midlines touch
    /// before the step. The world and what `collisions` know of it are as before.
    pub fn step_colliding(
        &mut self,
        collisions: &mut Collisions<'_>,
        given: &[ContactConstraint],
    ) -> Result<StepRecord, StepError> {
        let memory = collisions.memory();
        let record = self.step_guarded_against(collisions, given);
        if record.is_err() {
            collisions.remember(memory);
        }
        record
    }

    fn step_guarded_against(
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

//! What is known of collisions from one step for the next.

use super::body_contacts::KnownContacts;
use super::collisions::Collisions;
use super::wire_contacts::WireContacts;
use crate::broad::SlowPairs;

/// What [`Collisions`] know of a world from one step for the next: the contacts there are, on
/// which side of each other wires are, and how far apart slow pairs are. It belongs to the world as
/// it is between these two steps, and to no other.
///
/// Boxes, shapes and cores are made anew; no result depends on them.
///
/// ```
/// use tunnelproof::wire::{Collisions, Settings, World};
///
/// let mut world = World::new(Settings::default())?;
/// let mut collisions = Collisions::default();
/// world.step_colliding(&mut collisions, &[])?;
/// // To go on from here once more:
/// let (mut again, memory) = (world.clone(), collisions.memory());
/// world.step_colliding(&mut collisions, &[])?;
/// again.step_colliding(&mut Collisions::default().with_memory(memory), &[])?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct CollisionMemory {
    pub(in crate::wire) slow: SlowPairs,
    pub(in crate::wire) between_wires: WireContacts,
    /// Nothing, if bodies are the caller's.
    pub(in crate::wire) with_bodies: KnownContacts,
}

impl Collisions<'_> {
    /// What is known at present.
    pub fn memory(&self) -> CollisionMemory {
        // Every field is named, so that a new one is either known or not.
        let Collisions {
            narrow: _,
            filter: _,
            settings: _,
            pipeline,
            touches,
            obstacles,
            cores: _,
        } = self;
        CollisionMemory {
            slow: pipeline.slow.clone(),
            between_wires: touches.clone(),
            with_bodies: obstacles.known.clone(),
        }
    }

    /// The same, with what was known at another time in place of what is known now.
    ///
    /// Precondition: the world is as it was then.
    #[must_use]
    pub fn with_memory(mut self, memory: CollisionMemory) -> Self {
        self.remember(memory);
        self
    }

    pub(super) fn remember(&mut self, memory: CollisionMemory) {
        let CollisionMemory {
            slow,
            between_wires,
            with_bodies,
        } = memory;
        self.pipeline.slow = slow;
        self.touches = between_wires;
        self.obstacles.known = with_bodies;
    }
}

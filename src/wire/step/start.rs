//! Where a solve starts from.

use super::system::System;
use crate::wire::Vector;
use crate::wire::contact::ContactConstraint;
use crate::wire::world::World;

/// What the last solve came to, as a prediction for the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Start {
    /// Of each contact on its place A, along x, y, z, in N s; 0 for a new one.
    pub(super) impulses: Vec<Vector>,
    /// Of each segment, in N s.
    pub(super) tensions: Vec<f64>,
}

impl Start {
    /// That of a step: what the last step came to.
    pub(super) fn of_step(world: &World, contacts: &[ContactConstraint]) -> Self {
        let impulse = |contact: &ContactConstraint| world.cache.warm_start.impulse(contact.key);
        let segments = world.wires.iter().flat_map(|wire| &wire.segments);
        Start {
            impulses: contacts.iter().map(impulse).collect(),
            tensions: segments
                .map(|segment| segment.tension * world.settings.step)
                .collect(),
        }
    }

    /// That of another solve of the same step, with contacts that came behind the others.
    pub(super) fn again(
        world: &World,
        contacts: &[ContactConstraint],
        (system, x): (&System, &[f64]),
        mut impulses: Vec<Vector>,
    ) -> Self {
        impulses.resize(contacts.len(), Vector::zeros());
        let segments = world.wires.iter().map(|wire| wire.segments.len()).sum();
        let stretch = system.rows.iter().take(segments);
        Start {
            impulses,
            tensions: stretch.map(|row| x[row.multiplier]).collect(),
        }
    }
}

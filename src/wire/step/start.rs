//! Where a solve starts from.

use super::islands::Island;
use super::solution::Solution;
use crate::wire::Vector;
use crate::wire::contact::ContactConstraint;
use crate::wire::world::World;

/// What the last solve came to, as a prediction for the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Start {
    /// Of each contact on its place A, along x, y, z, in N s; 0 for a new one.
    pub(super) impulses: Vec<Vector>,
    /// Of each segment, by wire, in N s.
    pub(super) tensions: Vec<Vec<f64>>,
}

impl Start {
    /// That of a step: what the last step came to.
    pub(super) fn of_step(world: &World, contacts: &[ContactConstraint]) -> Self {
        let impulse = |contact: &ContactConstraint| world.cache.warm_start.impulse(contact.key);
        let step = world.settings.step;
        let tensions = world.wires.iter().map(|wire| {
            let segments = wire.segments.iter();
            segments.map(|segment| segment.tension * step).collect()
        });
        Start {
            impulses: contacts.iter().map(impulse).collect(),
            tensions: tensions.collect(),
        }
    }

    /// That of another solution of the same step, with so many contacts, of which the last ones are
    /// new.
    pub(super) fn again(world: &World, solution: &Solution, contacts: usize) -> Self {
        let mut tensions = vec![Vec::new(); world.wires.len()];
        for own in solution.islands() {
            for (wire, solved) in own.tensions() {
                tensions[wire] = solved;
            }
        }
        Start {
            impulses: solution.impulses(contacts),
            tensions,
        }
    }

    /// That of an island.
    pub(super) fn of(&self, island: &Island) -> Self {
        let contacts = island.contacts.iter();
        let wires = island.wires.iter();
        Start {
            impulses: contacts.map(|&at| self.impulses[at]).collect(),
            tensions: wires.map(|&wire| self.tensions[wire].clone()).collect(),
        }
    }
}

//! Where the energy of a run goes, and whether any comes from nothing.

use std::fmt;

use serde::Serialize;
use tunnelproof::wire::{StepRecord, World};

/// The energy of wires and of bodies that forces move, in J: kinetic, potential against the origin, and elastic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct EnergyBalance {
    /// At the start.
    pub start: f64,
    /// At the end.
    pub end: f64,
    /// What scripted bodies and reels did.
    pub work: f64,
    /// The most that came from nothing in one step: by how much energy grew beyond that.
    pub largest_gain: f64,
    /// The time at the end of that step, in s; none if energy never grew.
    pub gained_at: Option<f64>,
}

impl EnergyBalance {
    /// Of a run that starts with this world.
    pub(super) fn of(world: &World) -> Self {
        let start = world.energy_halfway().total();
        EnergyBalance {
            start,
            end: start,
            ..EnergyBalance::default()
        }
    }

    /// Adds a step, and returns what came from nothing in it, below 0 where energy was lost.
    pub(super) fn add(&mut self, record: &StepRecord) -> f64 {
        let energy = record.energy.total();
        let gain = energy - self.end - record.work;
        self.end = energy;
        self.work += record.work;
        if gain > self.largest_gain {
            self.largest_gain = gain;
            self.gained_at = Some(record.time);
        }
        gain
    }
}

impl fmt::Display for EnergyBalance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [start, end, work] = [self.start, self.end, self.work].map(joules);
        write!(
            f,
            "from {start} to {end}, scripted bodies and reels did {work}"
        )
    }
}

/// With four digits or more.
pub(super) fn joules(energy: f64) -> String {
    let digits = match energy.abs() {
        0.0 => 0,
        1e15.. => return format!("{energy:.3e} J"),
        1000.0.. => 0,
        100.0.. => 1,
        10.0.. => 2,
        1.0.. => 3,
        1e-3.. => 6,
        _ => return format!("{energy:.3e} J"),
    };
    format!("{energy:.digits$} J")
}

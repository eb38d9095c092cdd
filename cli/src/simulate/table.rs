//! A run as a table over time.

use tunnelproof::wire::{BodyCrossingOutcome, CrossingOutcome, StepRecord, World};

use super::balance::EnergyBalance;
use super::{deepest, largest_tension};

/// The columns.
const NAMES: [&str; 17] = [
    "step",
    "time (s)",
    "kinetic (J)",
    "potential (J)",
    "elastic (J)",
    "work of scripts (J)",
    "gain (J)",
    "largest tension (N)",
    "contacts",
    "deepest contact (m)",
    "prevented",
    "held islands",
    "resolution changes",
    "cut short",
    "slowed",
    "contact residual (m/s)",
    "slide residual",
];

/// The numbers of a run as comma-separated values: a line of names with their units, then a line for each step.
pub struct StepTable {
    balance: EnergyBalance,
    /// Whether the next step goes on from a state, which does not hold the energy that the record of the step before had: its
    /// gain is left empty.
    is_continued: bool,
}

impl StepTable {
    /// Of a run that starts with this world.
    pub fn of(world: &World) -> Self {
        StepTable {
            balance: EnergyBalance::of(world),
            is_continued: world.steps() > 0,
        }
    }

    /// The line of names.
    pub fn head() -> String {
        NAMES.join(",") + "\n"
    }

    /// The line of a step.
    pub fn line(&mut self, record: &StepRecord) -> String {
        let (energy, solver, found) = (&record.energy, &record.solver, &record.collisions);
        let gain = self.balance.add(record).to_string();
        let is_known = !std::mem::replace(&mut self.is_continued, false);
        let gain = if is_known { gain } else { String::new() };
        let values: [String; NAMES.len()] = [
            record.step.to_string(),
            record.time.to_string(),
            energy.kinetic.to_string(),
            energy.potential.to_string(),
            energy.elastic.to_string(),
            record.work.to_string(),
            gain,
            largest_tension(record).to_string(),
            record.contacts.len().to_string(),
            deepest(record).to_string(),
            prevented(record).to_string(),
            found.scaled_islands.len().to_string(),
            record.remeshes.len().to_string(),
            u8::from(solver.cut_short).to_string(),
            u8::from(solver.slowed).to_string(),
            solver.contact_residual.to_string(),
            solver.slide_residual.to_string(),
        ];
        values.join(",") + "\n"
    }
}

/// How many crossings were prevented, of wires and of bodies.
fn prevented(record: &StepRecord) -> usize {
    let found = &record.collisions;
    let wires = found.crossings.iter();
    let wires = wires.filter(|crossing| crossing.outcome == CrossingOutcome::Prevented);
    let with_bodies = found.body_crossings.iter().map(|crossing| crossing.outcome);
    let cores = found.core_crossings.iter().map(|crossing| crossing.outcome);
    let bodies = with_bodies.chain(cores);
    let bodies = bodies.filter(|outcome| *outcome == BodyCrossingOutcome::Prevented);
    wires.count() + bodies.count()
}

//! The step of a world: solve, commit, change the resolution.

use std::time::Instant;

use super::Contact;
use super::capstan;
use super::contact::{Warm, check};
use super::error::{Reason, StepError};
use super::motion::{Motion, Shares, Sliding};
use super::ride;
use super::settle::Candidate;
use super::system::{Structure, System};
use super::watch::{Given, Judgement, Watch};
use crate::wire::model::World;
use crate::wire::model::strand::MEMORY;
use crate::wire::record::{Phases, StepRecord};
use crate::wire::resolution::{self, Permit, RemeshGuard};

impl World {
    /// Does one step with the contacts given. Every change of resolution is permitted.
    ///
    /// # Errors
    ///
    /// [`StepError`] says which step was not done and why; the world is as before.
    pub fn step(&mut self, contacts: &[Contact]) -> Result<StepRecord, StepError> {
        self.step_guarded(contacts, &mut Permit)
    }

    /// Does one step; `guard` may refuse changes of resolution.
    ///
    /// # Errors
    ///
    /// As [`step`](Self::step).
    pub fn step_guarded(
        &mut self,
        contacts: &[Contact],
        guard: &mut dyn RemeshGuard,
    ) -> Result<StepRecord, StepError> {
        self.advance(&mut Given { contacts, guard })
    }

    /// Does one step with the contacts that `watch` gives, as far as it lets everything move.
    pub(in crate::wire) fn advance(
        &mut self,
        watch: &mut dyn Watch,
    ) -> Result<StepRecord, StepError> {
        let step = self.steps;
        let failed = |reason| StepError { step, reason };
        let mut phases = Phases::default();
        check(self, watch.contacts()).map_err(failed)?;
        let mut structure = self.structure.take();
        let agreed = self.agree(&mut structure, watch, &mut phases);
        let (system, candidate, motion) = agreed.map_err(failed)?;
        let mut clock = Clock::start();
        let mut record = StepRecord::before(self);
        record.contacts = self.contact_records(watch.contacts(), &candidate.swept.impulses);
        record.solver = candidate.solver.clone();
        self.warm = Warm::new(watch.contacts(), &candidate.swept.impulses);
        let slid = self.commit(&system, &candidate, motion);
        self.structure = system.into_structure();
        record.after(self);
        phases.commit = clock.lap();
        record.slides = capstan::slides(self, &slid);
        record.slides.extend(ride::leave(self));
        let bends = watch.contact_nodes(self, &record.contacts);
        record.remeshes = ride::arrive(self, &bends, watch);
        record.remeshes.extend(resolution::adapt(self, watch));
        phases.resolution = clock.lap();
        record.phases = phases;
        Ok(record)
    }

    /// Solves, and again with more contacts, until `watch` accepts the motion.
    fn agree(
        &self,
        structure: &mut Option<Structure>,
        watch: &mut dyn Watch,
        phases: &mut Phases,
    ) -> Result<(System, Candidate, Motion), Reason> {
        let (mut system, mut candidate) = self.settle(structure, watch.contacts(), phases)?;
        let mut shares = Shares::all(self);
        loop {
            let mut motion = self.motion(&system.layout, &candidate.x, &shares);
            if !motion.is_finite() {
                return Err(Reason::NotFinite);
            }
            capstan::shorten(self, &mut motion);
            let mut clock = Clock::start();
            let judgement = watch.judge(self, &motion, &candidate.swept.impulses)?;
            phases.narrow += clock.lap();
            match judgement {
                Judgement::Accept => return Ok((system, candidate, motion)),
                Judgement::Solve => {
                    *structure = system.into_structure();
                    (system, candidate) = self.settle(structure, watch.contacts(), phases)?;
                }
                Judgement::Hold(smaller) => shares = smaller,
            }
        }
    }

    fn commit(&mut self, system: &System, candidate: &Candidate, motion: Motion) -> Vec<Sliding> {
        let slid = motion.apply(self);
        let slot = self.steps as usize % MEMORY;
        let segments = self.wires.iter_mut().flat_map(|wire| &mut wire.segments);
        for (segment, row) in segments.zip(&system.rows) {
            // T = -lambda / h, and the unknown is -lambda.
            segment.tension = candidate.x[row.multiplier] / self.settings.step;
            segment.memory[slot] = segment.tension;
        }
        self.steps += 1;
        slid
    }
}

/// Measures phases.
pub(in crate::wire) struct Clock(Instant);

impl Clock {
    pub(in crate::wire) fn start() -> Self {
        Clock(Instant::now())
    }

    /// Seconds since the start or the last lap.
    pub(in crate::wire) fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let seconds = now.duration_since(self.0).as_secs_f64();
        self.0 = now;
        seconds
    }
}

#[cfg(test)]
mod tests;

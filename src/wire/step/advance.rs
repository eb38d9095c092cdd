//! The step of a world: solve, commit, change the resolution.

use super::budget::Budget;
use super::callbacks::{Given, MotionReview, StepCallbacks};
use super::capstan;
use super::contact_nodes;
use super::motion::{MotionScales, ProposedMotion, SlideRate};
use super::solve_step::{Candidate, SOLVE};
use super::start::Start;
use super::system::System;
use crate::wire::clock::Clock;
use crate::wire::contact::{ContactConstraint, check};
use crate::wire::energy::Energy;
use crate::wire::error::{Reason, StepError};
use crate::wire::model::wire::TENSION_HISTORY;
use crate::wire::record::{AddedInertia, Phases, StepRecord};
use crate::wire::resolution::{self, Permit, RemeshGuard};
use crate::wire::solver_cache::WarmStart;
use crate::wire::sparse::Structure;
use crate::wire::world::World;

/// A step is solved again as long as that may take one part in so many of what the first solve took.
const AGAIN: usize = 4;

impl World {
    /// Does one step with the contacts given. Every change of resolution is permitted.
    ///
    /// # Errors
    ///
    /// [`StepError`] says which step was not done and why; the world is as before.
    pub fn step(&mut self, contacts: &[ContactConstraint]) -> Result<StepRecord, StepError> {
        self.step_guarded(contacts, &mut Permit)
    }

    /// Does one step; `guard` may refuse changes of resolution.
    ///
    /// # Errors
    ///
    /// As [`step`](Self::step).
    pub fn step_guarded(
        &mut self,
        contacts: &[ContactConstraint],
        guard: &mut dyn RemeshGuard,
    ) -> Result<StepRecord, StepError> {
        self.advance(&mut Given { contacts, guard })
    }

    /// Does one step with the contacts that `watch` gives, as far as it lets everything move.
    pub(in crate::wire) fn advance(
        &mut self,
        watch: &mut dyn StepCallbacks,
    ) -> Result<StepRecord, StepError> {
        let step = self.steps;
        let failed = |reason| StepError { step, reason };
        let mut phases = Phases::default();
        check(self, watch.contacts()).map_err(failed)?;
        let mut structure = self.cache.structure.take();
        let solved = self.solve_accepted(&mut structure, watch, &mut phases);
        let (mut system, candidate, motion) = solved.map_err(failed)?;
        let mut clock = Clock::start();
        let mut record = StepRecord::before(self);
        record.contacts = self.contact_records(watch.contacts(), &candidate.swept.impulses);
        record.solver = candidate.solver.clone();
        record.turns(&motion);
        let keys = watch.contacts().iter().map(|contact| contact.key);
        let impulses = candidate.swept.impulses.iter().copied();
        self.cache.warm_start = WarmStart::new(keys.zip(impulses));
        let slid = self.commit(&system, &candidate, motion);
        record.after(self);
        record.energy = self.energy_of_motion(&system, &candidate);
        record.added_inertia = added_inertia(self, &system, &candidate.x);
        self.cache.structure = system.take_structure();
        phases.commit = clock.lap();
        record.slides = capstan::slides(self, &slid);
        record.slides.extend(contact_nodes::release(self));
        let insertions = watch.contact_nodes(self, &record.contacts);
        record.remeshes = contact_nodes::insert(self, &insertions, watch);
        record.remeshes.extend(resolution::adapt(self, watch));
        phases.resolution = clock.lap();
        record.phases = phases;
        Ok(record)
    }

    /// Solves, and again with more contacts, until `watch` accepts the motion. If that finds no
    /// solution, the last one is kept and scaled.
    fn solve_accepted(
        &self,
        structure: &mut Option<Structure>,
        watch: &mut dyn StepCallbacks,
        phases: &mut Phases,
    ) -> Result<(System, Candidate, ProposedMotion), Reason> {
        let contacts = watch.contacts();
        let mut budget = Budget::of_step(self, contacts);
        let whole = budget;
        let start = Start::of_step(self, contacts);
        let (mut system, mut candidate) =
            self.solve_step(structure, contacts, &start, &mut budget, phases)?;
        let of_first = budget.spent_since(whole);
        let mut scales = MotionScales::all(self);
        loop {
            let mut motion = self.motion(&system.layout, &candidate.x, &scales);
            if !motion.is_finite() {
                return Err(Reason::NotFinite);
            }
            capstan::shorten(self, &mut motion);
            let mut clock = Clock::start();
            let judgement = watch.review(self, &motion, &candidate.swept.impulses)?;
            phases.narrow += clock.lap();
            match judgement {
                MotionReview::Accept => return Ok((system, candidate, motion)),
                MotionReview::SolveAgain if budget.times(of_first / AGAIN) < SOLVE => {
                    candidate.solver.cut_short = true;
                    watch.keep_solution();
                }
                MotionReview::SolveAgain => {
                    let contacts = watch.contacts();
                    let impulses = candidate.swept.impulses.clone();
                    let start = Start::again(self, contacts, (&system, &candidate.x), impulses);
                    *structure = system.take_structure();
                    match self.solve_step(structure, contacts, &start, &mut budget, phases) {
                        Ok(solved) => (system, candidate) = solved,
                        Err(_) => watch.keep_solution(),
                    }
                }
                MotionReview::Scale(scales_now) => scales = scales_now,
            }
        }
    }

    /// The energies of the motion that was made; see [`StepRecord::energy`].
    fn energy_of_motion(&self, system: &System, candidate: &Candidate) -> Energy {
        let step = self.settings.step;
        let rows = system.rows.iter();
        Energy {
            potential: self.potential_energy()
                + step / 2.0 * self.settings.gravity.dot(&self.momentum()),
            kinetic: self.kinetic_energy(),
            elastic: rows.map(|row| row.elastic_energy(&candidate.x, step)).sum(),
        }
    }

    fn commit(
        &mut self,
        system: &System,
        candidate: &Candidate,
        motion: ProposedMotion,
    ) -> Vec<SlideRate> {
        let slid = motion.apply(self);
        let slot = self.steps as usize % TENSION_HISTORY;
        let segments = self.wires.iter_mut().flat_map(|wire| &mut wire.segments);
        for (segment, row) in segments.zip(&system.rows) {
            // T = -lambda / h, and the unknown is -lambda.
            segment.tension = candidate.x[row.multiplier] / self.settings.step;
            segment.tension_history[slot] = segment.tension;
        }
        self.steps += 1;
        slid
    }
}

/// What there was beside the masses, at short segments, in the motion that was made.
fn added_inertia(world: &World, system: &System, x: &[f64]) -> AddedInertia {
    let inertias = &system.inertias;
    let short = inertias.short.iter().map(|inertia| inertia.energy(world));
    AddedInertia {
        places: inertias.short.len() + inertias.nodes.len(),
        damped: short.sum::<f64>() + system.energy_of_steep_segments(x),
    }
}

#[cfg(test)]
mod tests;

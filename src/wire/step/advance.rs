//! The step of a world: solve, commit, change the resolution.

use super::budget::Budget;
use super::callbacks::{Given, MotionReview, StepCallbacks};
use super::capstan;
use super::contact_nodes;
use super::motion::{MotionScales, ProposedMotion, SlideRate};
use super::reels;
use super::solution::{SOLVE, Solution, Solved};
use super::start::Start;
use crate::wire::clock::Clock;
use crate::wire::contact::{ContactConstraint, check};
use crate::wire::energy::Energy;
use crate::wire::error::{Reason, StepError};
use crate::wire::model::wire::TENSION_HISTORY;
use crate::wire::record::{Phases, StepRecord};
use crate::wire::resolution::{self, Permit, RemeshGuard};
use crate::wire::solver_cache::{Structures, WarmStart};
use crate::wire::torsion::{self, torsions};
use crate::wire::world::World;

/// A step is solved again as long as that may take one part in so many of what the first solve took.
const AGAIN: usize = 4;

/// How many contact nodes a wire gets at most in a step beside one that a body carries.
const WINDINGS: usize = 8;

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
        let mut structures = std::mem::take(&mut self.cache.structures);
        let solved = self.solve_accepted(&mut structures, watch, &mut phases);
        let (solution, motion) = solved.map_err(failed)?;
        let mut clock = Clock::start();
        let mut record = StepRecord::before(self);
        let impulses = solution.impulses(watch.contacts().len());
        record.contacts = self.contact_records(watch.contacts(), &impulses);
        record.solver = solution.record();
        record.work = solution.work();
        let carried = self.carried_velocities();
        record.turns(&motion);
        let keys = watch.contacts().iter().map(|contact| contact.key);
        self.cache.warm_start = WarmStart::new(keys.zip(impulses));
        let (slid, work_of_reels) = self.commit(&solution, motion);
        record.work += work_of_reels;
        record.after(self);
        for (wire, impulse) in solution.islands().iter().flat_map(Solved::torques) {
            record.wires[wire].torque = impulse / self.settings.step;
        }
        record.energy = self.energy_of_motion(&solution);
        record.work += self.work_of_carrying(&carried);
        record.added_inertia = solution.added_inertia(self);
        record.numerical_damping = solution.numerical_damping();
        self.cache.structures = solution.structures(self);
        phases.commit = clock.lap();
        record.slides = capstan::slides(self, &slid);
        let torsions = torsions(self);
        let left = contact_nodes::release(self, watch, &mut record.remeshes);
        record.slides.extend(left);
        let insertions = watch.contact_nodes(self, &record.contacts);
        let inserted = contact_nodes::insert(self, &insertions, watch);
        record.remeshes.extend(inserted);
        for _ in 0..WINDINGS {
            let insertions = watch.winding(self);
            let inserted = contact_nodes::insert(self, &insertions, watch);
            if inserted.is_empty() {
                break;
            }
            record.remeshes.extend(inserted);
        }
        record.remeshes.extend(resolution::adapt(self, watch));
        torsion::follow_changes(self, &torsions);
        phases.resolution = clock.lap();
        record.phases = phases;
        Ok(record)
    }

    /// Solves, and again with more contacts, until `watch` accepts the motion. If that finds no
    /// solution, the last one is kept and scaled.
    fn solve_accepted(
        &self,
        structures: &mut Structures,
        watch: &mut dyn StepCallbacks,
        phases: &mut Phases,
    ) -> Result<(Solution, ProposedMotion), Reason> {
        let contacts = watch.contacts();
        let mut budget = Budget::of_step(self, contacts);
        let whole = budget;
        let start = Start::of_step(self, contacts);
        let mut solution = Solution::new(self, structures, contacts, &start, &mut budget, phases)?;
        let of_first = budget.spent_since(whole);
        let mut scales = MotionScales::all(self);
        loop {
            let mut motion = self.motion(&solution.velocities(self), &scales);
            if let Some(part) = motion.not_finite() {
                return Err(Reason::NotFinite { part });
            }
            capstan::shorten(self, &mut motion);
            let mut clock = Clock::start();
            let impulses = solution.impulses(watch.contacts().len());
            let judgement = watch.review(self, &motion, &impulses)?;
            phases.narrow += clock.lap();
            match judgement {
                MotionReview::Accept => return Ok((solution, motion)),
                MotionReview::SolveAgain if budget.times(of_first / AGAIN) < SOLVE => {
                    solution.cut_short();
                    watch.keep_solution();
                }
                MotionReview::SolveAgain => {
                    let contacts = watch.contacts();
                    let start = Start::again(self, &solution, contacts.len());
                    let solved = solution.update(self, contacts, &start, &mut budget, phases);
                    if solved.is_err() {
                        watch.keep_solution();
                    }
                }
                MotionReview::Scale(scales_now) => scales = scales_now,
            }
        }
    }

    /// The energies of the motion that was made; see [`StepRecord::energy`].
    fn energy_of_motion(&self, solution: &Solution) -> Energy {
        let step = self.settings.step;
        Energy {
            potential: self.potential_halfway(),
            kinetic: self.kinetic_energy(),
            elastic: solution.elastic_energy(step),
        }
    }

    /// Moves the world. Returns how wires slid, and what reels did beside pulling, in J.
    fn commit(&mut self, solution: &Solution, motion: ProposedMotion) -> (Vec<SlideRate>, f64) {
        let torsions = torsions(self);
        let slid = motion.apply(self);
        torsion::follow_motion(self, &torsions);
        let slot = self.steps as usize % TENSION_HISTORY;
        for own in solution.islands() {
            for (wire, impulses) in own.tensions() {
                let segments = &mut self.wires[wire].segments;
                for (segment, impulse) in segments.iter_mut().zip(impulses) {
                    // T = -lambda / h, and the unknown is -lambda.
                    segment.tension = impulse / self.settings.step;
                    segment.tension_history[slot] = segment.tension;
                }
            }
        }
        let work = reels::let_out(self, &slid);
        self.steps += 1;
        (slid, work)
    }
}

#[cfg(test)]
mod tests;

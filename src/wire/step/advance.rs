//! The step of a world: solve, commit, slide, change the resolution.

use std::time::Instant;

use super::Contact;
use super::contact::{Warm, check};
use super::error::{Reason, StepError};
use super::friction::{Swept, sweep};
use super::motion::{Motion, Shares};
use super::rows::Row;
use super::system::System;
use super::watch::{Given, Judgement, Watch};
use crate::wire::capstan;
use crate::wire::model::World;
use crate::wire::model::strand::MEMORY;
use crate::wire::record::{Phases, SolverRecord, StepRecord};
use crate::wire::resolution::{self, Permit, RemeshGuard};

/// Guesses of the pulling segments that are tried before a step is given up.
const TRIES: usize = 100;

/// A solution of a step that is not committed yet.
struct Candidate {
    x: Vec<f64>,
    swept: Swept,
    solver: SolverRecord,
}

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
        let mut clock = Clock::start();
        check(self, watch.contacts()).map_err(failed)?;
        let structure = self.structure.take();
        let mut system = System::new(self, structure);
        phases.assembly = clock.lap();
        let (candidate, motion) = match self.agree(&mut system, watch, &mut phases) {
            Ok(agreed) => agreed,
            Err(reason) => {
                self.structure = system.into_structure();
                return Err(failed(reason));
            }
        };
        clock.lap();
        let mut record = StepRecord::before(self);
        record.contacts = self.contact_records(watch.contacts(), &candidate.swept.impulses);
        record.solver = candidate.solver.clone();
        self.warm = Warm::new(watch.contacts(), &candidate.swept.impulses);
        self.commit(&system, &candidate, motion);
        self.structure = system.into_structure();
        record.after(self);
        phases.commit = clock.lap();
        record.slides = capstan::slide(self);
        record.remeshes = resolution::adapt(self, watch);
        phases.resolution = clock.lap();
        record.phases = phases;
        Ok(record)
    }

    /// Solves, and again with more contacts, until `watch` accepts the motion.
    fn agree(
        &self,
        system: &mut System,
        watch: &mut dyn Watch,
        phases: &mut Phases,
    ) -> Result<(Candidate, Motion), Reason> {
        let mut candidate = self.settle(system, watch.contacts(), phases)?;
        let mut shares = Shares::all(self);
        loop {
            let motion = self.motion(&system.layout, &candidate.x, &shares);
            if !motion.is_finite() {
                return Err(Reason::NotFinite);
            }
            let mut clock = Clock::start();
            let judgement = watch.judge(self, &motion, &candidate.swept.impulses)?;
            phases.collision += clock.lap();
            match judgement {
                Judgement::Accept => return Ok((candidate, motion)),
                Judgement::Solve => candidate = self.settle(system, watch.contacts(), phases)?,
                Judgement::Hold(smaller) => shares = smaller,
            }
        }
    }

    /// Solves for velocities, multipliers and contact impulses; finds out which segments of chains
    /// pull, starting from those that did in the last step.
    ///
    /// Block principal pivoting: all segments that contradict the guess change at once, and after three
    /// tries without fewer contradictions only the last of them (Judice and Pires, Comput. Oper. Res.
    /// 21, 1994), which ends because the rows' Schur complement is positive definite.
    fn settle(
        &self,
        system: &mut System,
        contacts: &[Contact],
        phases: &mut Phases,
    ) -> Result<Candidate, Reason> {
        let (mut fewest, mut patience) = (usize::MAX, 3);
        for tries in 1..=TRIES {
            let mut clock = Clock::start();
            system.factor()?;
            phases.factor += clock.lap();
            let (mut x, mut residual) = system.solve(&[])?;
            phases.solve += clock.lap();
            let mut swept = Swept::default();
            if !contacts.is_empty() {
                swept = sweep(self, system, contacts, &x);
                (x, residual) = system.solve(&swept.columns)?;
                phases.contacts += clock.lap();
            }
            let wrong = contradictions(&system.rows, &x);
            if wrong.is_empty() {
                let solver = SolverRecord {
                    residual,
                    tries,
                    sweeps: swept.sweeps,
                    contact_residual: swept.residual,
                };
                return Ok(Candidate { x, swept, solver });
            }
            if wrong.len() < fewest {
                (fewest, patience) = (wrong.len(), 3);
            } else {
                patience = usize::saturating_sub(patience, 1);
            }
            let all = if patience > 0 { 0 } else { wrong.len() - 1 };
            for &row in &wrong[all..] {
                system.rows[row].active = !system.rows[row].active;
            }
        }
        Err(Reason::Slack { tries: TRIES })
    }

    fn commit(&mut self, system: &System, candidate: &Candidate, motion: Motion) {
        motion.apply(self);
        let slot = self.steps as usize % MEMORY;
        let segments = self.wires.iter_mut().flat_map(|wire| &mut wire.segments);
        for (segment, row) in segments.zip(&system.rows) {
            // T = -lambda / h, and the unknown is -lambda.
            segment.tension = candidate.x[row.multiplier] / self.settings.step;
            segment.memory[slot] = segment.tension;
        }
        self.steps += 1;
    }
}

/// The rows that pull only and contradict the guess of which do: one that counts and pushes, or one that
/// does not and is longer after the step than it may be. Rounding is no contradiction.
fn contradictions(rows: &[Row], x: &[f64]) -> Vec<usize> {
    const ROUNDING: f64 = 1e-12;
    let chains = || rows.iter().enumerate().filter(|(_, row)| row.pulls_only);
    let largest = chains().fold(0.0, |a: f64, (_, row)| a.max(x[row.multiplier].abs()));
    let contradicts = |row: &Row| {
        let has_direction = row
            .terms
            .iter()
            .any(|(_, along)| along.norm_squared() > 0.0);
        if row.active {
            x[row.multiplier] < -ROUNDING * largest
        } else {
            has_direction && row.velocity(x) - row.target > ROUNDING * (1.0 + row.target.abs())
        }
    };
    let wrong = chains().filter(|(_, row)| contradicts(row));
    wrong.map(|(at, _)| at).collect()
}

/// Measures phases.
struct Clock(Instant);

impl Clock {
    fn start() -> Self {
        Clock(Instant::now())
    }

    /// Seconds since the start or the last lap.
    fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let seconds = now.duration_since(self.0).as_secs_f64();
        self.0 = now;
        seconds
    }
}

#[cfg(test)]
mod tests;

//! The solution of a step: velocities, multipliers, contact impulses, which segments of chains
//! pull, and which wires slide.

use super::active_set::{find_active_set, violates_branches};
use super::capstan::{bound_residual, stop_slip};
use super::contact_blocks::Swept;
use super::friction::{contact_residual, sweep};
use super::multipliers;
use super::order::{self, Block};
use super::system::System;
use crate::wire::Vector;
use crate::wire::clock::Clock;
use crate::wire::contact::ContactConstraint;
use crate::wire::error::Reason;
use crate::wire::record::{Phases, SolverRecord};
use crate::wire::sparse::Structure;
use crate::wire::world::World;

/// How often contacts are swept again because other segments of chains pull.
const ROUNDS: usize = 20;

/// A solution of a step that is not committed yet.
pub(super) struct Candidate {
    pub(super) x: Vec<f64>,
    pub(super) swept: Swept,
    pub(super) solver: SolverRecord,
}

impl World {
    /// Solves for velocities, multipliers and contact impulses; finds out which segments of chains
    /// pull and which wires slide over contact nodes, starting from those that did in the last
    /// step.
    pub(super) fn solve_step(
        &self,
        structure: &mut Option<Structure>,
        contacts: &[ContactConstraint],
        phases: &mut Phases,
    ) -> Result<(System, Candidate), Reason> {
        let (system, mut candidate) = self.solution(structure, contacts, phases)?;
        candidate.solver.slide_residual = bound_residual(&system.rows, &candidate.x);
        stop_slip(&system.rows, &mut candidate.x);
        Ok((system, candidate))
    }

    /// The same, as it comes out of the solver: what sticks may slip by a hair.
    fn solution(
        &self,
        structure: &mut Option<Structure>,
        contacts: &[ContactConstraint],
        phases: &mut Phases,
    ) -> Result<(System, Candidate), Reason> {
        let start: Vec<Vector> = contacts
            .iter()
            .map(|contact| self.cache.warm_start.impulse(contact.key))
            .collect();
        let mut clock = Clock::start();
        let by_least_degree = order::by_least_degree(self, contacts);
        phases.assembly += clock.lap();
        if let Some(order) = by_least_degree {
            let mut system = self.assemble(&order, structure, phases);
            match self.solve_with_implicit_contacts(&mut system, contacts, &start, phases) {
                Some(candidate) => return Ok((system, candidate)),
                // What does not come to an end is swept.
                None => *structure = system.take_structure(),
            }
        }
        let mut system = self.assemble(&order::by_wires(self), structure, phases);
        let candidate = self.solve_with_swept_contacts(&mut system, contacts, &start, phases)?;
        Ok((system, candidate))
    }

    fn assemble(
        &self,
        order: &[Block],
        structure: &mut Option<Structure>,
        phases: &mut Phases,
    ) -> System {
        let mut clock = Clock::start();
        let system = System::new(self, order, structure.take());
        phases.assembly += clock.lap();
        system
    }

    /// Contacts are swept while the same segments pull; then it is found which pull and slide under
    /// these impulses, until that changes nothing. Friction may let it change for ever: after
    /// [`ROUNDS`] the impulses stay as they are, and the record has the residual of the contacts.
    fn solve_with_swept_contacts(
        &self,
        system: &mut System,
        contacts: &[ContactConstraint],
        start: &[Vector],
        phases: &mut Phases,
    ) -> Result<Candidate, Reason> {
        let mut clock = Clock::start();
        system.factor()?;
        phases.factor += clock.lap();
        let mut candidate = self.solve(system, contacts, start, phases)?;
        let mut factorisations = 1;
        for round in 1..=ROUNDS {
            if !violates_branches(&system.rows, &candidate.x) {
                break;
            }
            clock.lap();
            let active_set = find_active_set(system, &candidate.swept.columns, candidate.x)?;
            phases.factor += clock.lap();
            factorisations += active_set.factorisations;
            if round < ROUNDS && !contacts.is_empty() {
                let impulses = candidate.swept.impulses;
                candidate = self.solve(system, contacts, &impulses, phases)?;
                continue;
            }
            (candidate.x, candidate.solver.residual) = (active_set.x, active_set.backward_error);
            if !contacts.is_empty() {
                let (free, _) = system.solve(&[])?;
                let impulses = &candidate.swept.impulses;
                let residual = contact_residual(self, system, contacts, &free, impulses);
                candidate.solver.contact_residual = residual;
            }
            break;
        }
        candidate.solver.factorisations = factorisations;
        Ok(candidate)
    }

    /// Solves with the contacts in the system, from predicted impulses. None if that does not
    /// converge.
    fn solve_with_implicit_contacts(
        &self,
        system: &mut System,
        contacts: &[ContactConstraint],
        predicted: &[Vector],
        phases: &mut Phases,
    ) -> Option<Candidate> {
        let mut clock = Clock::start();
        system.take(self, contacts, predicted);
        let found = multipliers::solve(system, system.start(self), self.settings.contact_tolerance);
        let implicit = std::mem::take(&mut system.implicit);
        phases.contacts += clock.lap();
        let found = found.ok()?;
        let solver = SolverRecord {
            residual: found.backward_error,
            factorisations: found.factorisations,
            sweeps: 0,
            contact_residual: found.contact_residual,
            slide_residual: 0.0,
        };
        let impulses = implicit
            .iter()
            .map(|contact| contact.world_impulse(&found.x));
        let swept = Swept {
            impulses: impulses.collect(),
            ..Swept::default()
        };
        Some(Candidate {
            x: found.x,
            swept,
            solver,
        })
    }

    /// The solution with the rows as they were factored, with contact impulses from a start on.
    fn solve(
        &self,
        system: &System,
        contacts: &[ContactConstraint],
        start: &[Vector],
        phases: &mut Phases,
    ) -> Result<Candidate, Reason> {
        let mut clock = Clock::start();
        let (mut x, mut residual) = system.solve(&[])?;
        phases.solve += clock.lap();
        let mut swept = Swept::default();
        if !contacts.is_empty() {
            swept = sweep(self, system, contacts, &x, start);
            (x, residual) = system.solve(&swept.columns)?;
            phases.contacts += clock.lap();
        }
        let solver = SolverRecord {
            residual,
            factorisations: 1,
            sweeps: swept.sweeps,
            contact_residual: swept.residual,
            slide_residual: 0.0,
        };
        Ok(Candidate { x, swept, solver })
    }
}

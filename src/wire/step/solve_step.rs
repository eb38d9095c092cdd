//! The solution of a step: velocities, multipliers, contact impulses, which segments of chains
//! pull, and which wires slide.

use super::active_set::{find_active_set, violates_branches};
use super::budget::Budget;
use super::capstan::{bound_residual, stop_slip};
use super::contact_blocks::Swept;
use super::friction::{FORMED, contact_residual, sweep};
use super::linearisation::Linearisation;
use super::multipliers;
use super::order::{self, Block};
use super::start::Start;
use super::system::{ContactMethod, System};
use crate::wire::Vector;
use crate::wire::clock::Clock;
use crate::wire::contact::ContactConstraint;
use crate::wire::error::Reason;
use crate::wire::record::{Phases, SolverRecord};
use crate::wire::sparse::Structure;
use crate::wire::world::World;

/// How often contacts are swept again because other segments of chains pull.
const ROUNDS: usize = 20;

/// With the contacts in the system a solve may spend all but one part in so many, so that what did not come to an
/// end can be swept.
const IN_SYSTEM: usize = 2;

/// Factorisations that there have to be enough for, or the contacts are found in another way at once.
const NEWTON_STEPS: usize = 10;

/// How far contacts may be from a solution, in m/s. Those that were swept are else looked for in the system, and where a search was
/// cut short the step is not solved again from there.
pub(super) const FAR: f64 = 1e-2;

/// A solution of a step that is not committed yet.
pub(super) struct Candidate {
    pub(super) x: Vec<f64>,
    pub(super) swept: Swept,
    pub(super) solver: SolverRecord,
}

impl Candidate {
    /// Multiplies all of it: velocities and what gave them.
    pub(super) fn scale(&mut self, factor: f64) {
        for value in &mut self.x {
            *value *= factor;
        }
        for impulse in &mut self.swept.impulses {
            *impulse *= factor;
        }
    }
}

impl World {
    /// Solves for velocities, multipliers and contact impulses; finds out which segments of chains
    /// pull and which wires slide over contact nodes, starting from those that did in the last
    /// step, and from what `start` predicts.
    pub(super) fn solve_step(
        &self,
        linearisation: &Linearisation,
        structure: &mut Option<Structure>,
        contacts: &[ContactConstraint],
        start: &Start,
        budget: &mut Budget,
        phases: &mut Phases,
    ) -> Result<(System, Candidate), Reason> {
        let (system, mut candidate) =
            self.solution(linearisation, structure, contacts, start, budget, phases)?;
        candidate.solver.slide_residual = bound_residual(&system.rows, &candidate.x);
        stop_slip(&system.rows, &mut candidate.x);
        Ok((system, candidate))
    }

    /// The same, as it comes out of the solver: what sticks may slip by a hair.
    fn solution(
        &self,
        linearisation: &Linearisation,
        structure: &mut Option<Structure>,
        contacts: &[ContactConstraint],
        start: &Start,
        budget: &mut Budget,
        phases: &mut Phases,
    ) -> Result<(System, Candidate), Reason> {
        let mut clock = Clock::start();
        let affordable = budget.share(IN_SYSTEM * NEWTON_STEPS);
        let are_many = contacts.len() > *FORMED.end();
        let most = if are_many { affordable } else { usize::MAX };
        let by_least_degree = order::for_contacts(self, contacts, most);
        let hardly_fills = by_least_degree.is_some();
        let by_least_degree = by_least_degree.filter(|(_, cost)| *cost <= affordable);
        phases.assembly += clock.lap();
        let is_tried = by_least_degree.is_some();
        if let Some((order, _)) = by_least_degree {
            let mut system = self.assemble(linearisation, &order, structure, phases);
            let mut part = budget.part(IN_SYSTEM);
            let candidate = self.solve_with_implicit_contacts(
                &mut system,
                contacts,
                start,
                ContactMethod::InMatrix,
                &mut part,
                phases,
            );
            budget.take_back(part);
            match candidate {
                Some(candidate) => return Ok((system, candidate)),
                // What does not come to an end is swept.
                None => *structure = system.take_structure(),
            }
        }
        let mut system = self.assemble(linearisation, &order::by_wires(self), structure, phases);
        if are_many || hardly_fills && !is_tried {
            let candidate = self.solve_with_implicit_contacts(
                &mut system,
                contacts,
                start,
                ContactMethod::ByGradients,
                budget,
                phases,
            );
            if let Some(candidate) = candidate {
                return Ok((system, candidate));
            }
            *structure = system.take_structure();
            system = self.assemble(linearisation, &order::by_wires(self), structure, phases);
        }
        let swept =
            self.solve_with_swept_contacts(&mut system, contacts, &start.impulses, budget, phases)?;
        let least = swept.solver.contact_residual;
        if least <= FAR || is_tried {
            return Ok((system, swept));
        }
        // What pulls may change with what pushes for ever, where one is found after the other.
        clock.lap();
        let order = order::by_least_degree(self, contacts, budget.share(NEWTON_STEPS));
        phases.assembly += clock.lap();
        let Some((order, _)) = order else {
            return Ok((system, swept));
        };
        let mut within = self.assemble(linearisation, &order, &mut None, phases);
        let candidate = self.solve_with_implicit_contacts(
            &mut within,
            contacts,
            start,
            ContactMethod::InMatrix,
            budget,
            phases,
        );
        let is_nearer = |candidate: &Candidate| candidate.solver.contact_residual < least;
        Ok(match candidate.filter(is_nearer) {
            Some(candidate) => (within, candidate),
            None => (system, swept),
        })
    }

    fn assemble(
        &self,
        linearisation: &Linearisation,
        order: &[Block],
        structure: &mut Option<Structure>,
        phases: &mut Phases,
    ) -> System {
        let mut clock = Clock::start();
        let system = System::new(self, linearisation, order, structure.take());
        phases.assembly += clock.lap();
        system
    }

    /// Contacts are swept while the same segments pull; then it is found which pull and slide under
    /// these impulses, until that changes nothing. Friction may let it change for ever: after
    /// [`ROUNDS`], or when the budget is spent, the impulses stay as they are, and the record has the
    /// residual of the contacts. With more than a few contacts, which segments push with all they can would
    /// change with every round: there all but those of chains push with whatever they have to.
    fn solve_with_swept_contacts(
        &self,
        system: &mut System,
        contacts: &[ContactConstraint],
        start: &[Vector],
        budget: &mut Budget,
        phases: &mut Phases,
    ) -> Result<Candidate, Reason> {
        let mut clock = Clock::start();
        if contacts.len() >= *FORMED.start() {
            system.rows.iter_mut().for_each(|row| row.let_push());
        }
        system.factor()?;
        budget.spend(system.multiplications());
        phases.factor += clock.lap();
        let mut candidate = self.solve(system, contacts, start, budget, phases)?;
        let mut factorisations = 1;
        for round in 1..=ROUNDS {
            if !violates_branches(&system.rows, &candidate.x) {
                break;
            }
            clock.lap();
            let impulses = &candidate.swept.columns;
            let mut active_set = find_active_set(system, impulses, candidate.x, budget)?;
            let is_last = round == ROUNDS || contacts.is_empty() || budget.is_spent();
            if is_last {
                active_set.stick_what_slides_too_far(system, impulses, budget)?;
            }
            phases.factor += clock.lap();
            factorisations += active_set.factorisations;
            if !is_last {
                let impulses = candidate.swept.impulses;
                candidate = self.solve(system, contacts, &impulses, budget, phases)?;
                continue;
            }
            (candidate.x, candidate.solver.residual) = (active_set.x, active_set.backward_error);
            candidate.solver.cut_short |= !active_set.is_found || budget.is_spent();
            if !contacts.is_empty() {
                let free = system.solve_free();
                let impulses = &candidate.swept.impulses;
                let residual = contact_residual(self, system, contacts, &free, impulses);
                candidate.solver.contact_residual = residual;
            }
            break;
        }
        candidate.solver.factorisations = factorisations;
        Ok(candidate)
    }

    /// Solves with the contacts in the system, from predicted impulses. None if that
    /// takes too much.
    fn solve_with_implicit_contacts(
        &self,
        system: &mut System,
        contacts: &[ContactConstraint],
        start: &Start,
        method: ContactMethod,
        budget: &mut Budget,
        phases: &mut Phases,
    ) -> Option<Candidate> {
        let mut clock = Clock::start();
        system.take(self, contacts, start, method);
        let tolerance = self.settings.contact_tolerance;
        let found = multipliers::solve(system, system.start(self), tolerance, budget);
        system.release_contacts();
        phases.contacts += clock.lap();
        let found = found.ok()??;
        let solver = SolverRecord {
            residual: found.backward_error,
            factorisations: found.factorisations,
            sweeps: 0,
            cut_short: !found.is_settled,
            slowed: false,
            contact_residual: found.contact_residual,
            slide_residual: 0.0,
        };
        let swept = Swept {
            impulses: found.impulses,
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
        budget: &mut Budget,
        phases: &mut Phases,
    ) -> Result<Candidate, Reason> {
        let mut clock = Clock::start();
        let mut swept = Swept::default();
        if !contacts.is_empty() {
            let free = system.solve_free();
            phases.solve += clock.lap();
            swept = sweep(self, system, contacts, &free, start, budget);
        }
        let (x, residual) = system.solve(&swept.columns)?;
        if contacts.is_empty() {
            phases.solve += clock.lap();
        } else {
            phases.contacts += clock.lap();
        }
        let solver = SolverRecord {
            residual,
            factorisations: 1,
            sweeps: swept.sweeps,
            cut_short: swept.is_cut,
            slowed: false,
            contact_residual: swept.residual,
            slide_residual: 0.0,
        };
        Ok(Candidate { x, swept, solver })
    }
}

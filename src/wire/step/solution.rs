//! The solution of a step: that of every [island](super::islands).

use std::collections::BTreeMap;

use super::budget::Budget;
use super::energy_limit;
use super::islands::{Island, islands};
use super::linearisation::{Directions, Followed, Held, Linearisation, ROUNDS, ROUNDS_TO_THE_END};
use super::motion::Velocities;
use super::solve_step::{Candidate, FAR};
use super::start::Start;
use super::system::System;
use crate::parallel::made;
use crate::wire::Vector;
use crate::wire::contact::ContactConstraint;
use crate::wire::error::Reason;
use crate::wire::record::{AddedInertia, Phases, SolverRecord};
use crate::wire::solver_cache::Structures;
use crate::wire::sparse::Structure;
use crate::wire::world::World;

/// A solution may spend one part in so many of what is left: so there is something left for solving
/// again.
pub(super) const SOLVE: usize = 2;

/// Islands, each with its solution.
pub(super) struct Solution {
    islands: Vec<Solved>,
}

/// An island that is to be solved, with what is known of it from before: the structure of its system, and what its
/// equations were linear about with other contacts.
struct Unsolved {
    island: Island,
    structure: Option<Structure>,
    linearisation: Option<Linearisation>,
}

/// A solution, what it is linear about, and where it leads.
struct Attempt {
    linearisation: Linearisation,
    system: System,
    candidate: Candidate,
    held: Held,
    followed: Followed,
}

impl Attempt {
    /// [Follows](super::linearisation) a solution, given what solves about another linearisation: with mean directions, and with
    /// those at the end where that comes to none.
    fn follow(
        self,
        world: &World,
        budget: &mut Budget,
        mut solve: impl FnMut(Linearisation, &Start, &mut Budget) -> Result<Attempt, Reason>,
    ) -> Attempt {
        let best = match self.linearisation.directions {
            Directions::Mean => self.improved(budget, &mut solve),
            Directions::End => self,
        };
        let is_open = best.followed.is_off && best.followed.is_large;
        if is_open && !best.is_far() {
            best.followed_to_the_end(world, budget, &mut solve)
        } else {
            best
        }
    }

    /// Solves again with the directions at the end, until that changes nothing; the best of all.
    fn followed_to_the_end(
        self,
        world: &World,
        budget: &mut Budget,
        solve: &mut impl FnMut(Linearisation, &Start, &mut Budget) -> Result<Attempt, Reason>,
    ) -> Attempt {
        let (own, x) = (self.linearisation.to_the_end(), &self.candidate.x);
        let mut next = own.follow(world, &self.system, &self.held, x).next;
        let mut start = self.end();
        let mut factorisations = self.candidate.solver.factorisations;
        let mut best = self;
        for _ in 0..ROUNDS_TO_THE_END {
            if budget.is_spent() {
                break;
            }
            let mut share = budget.part(SOLVE);
            let again = solve(next, &start, &mut share);
            budget.take_back(share);
            let Ok(again) = again else { break };
            factorisations += again.candidate.solver.factorisations;
            let is_last = !again.followed.is_off || again.is_far();
            next = again.followed.next.clone();
            start = again.end();
            let is_better = again.followed.suits && again.followed.error < best.followed.error;
            if is_better && !again.is_far() {
                best = again;
            }
            if is_last {
                break;
            }
        }
        best.candidate.solver.factorisations = factorisations;
        best
    }

    /// Solves again while that makes it better.
    fn improved(
        self,
        budget: &mut Budget,
        solve: &mut impl FnMut(Linearisation, &Start, &mut Budget) -> Result<Attempt, Reason>,
    ) -> Attempt {
        let mut best = self;
        let mut part = 1.0;
        for _ in 0..ROUNDS {
            if !best.followed.is_off || best.is_far() || budget.is_spent() {
                break;
            }
            let trial = best.linearisation.towards(&best.followed.next, part);
            let mut share = budget.part(SOLVE);
            let again = solve(trial, &best.end(), &mut share);
            budget.take_back(share);
            // What cannot be solved is as it was before.
            let Ok(mut again) = again else { break };
            let solvers = [&best, &again].map(|attempt| &attempt.candidate.solver);
            let factorisations = solvers[0].factorisations + solvers[1].factorisations;
            let is_better = again.followed.suits
                && !again.is_far()
                && again.followed.error <= best.followed.error;
            // Half of the way to larger tensions alone is the same again, and what takes too long does so again.
            let is_last = again.candidate.solver.cut_short || !best.followed.has_other_directions;
            if is_better {
                std::mem::swap(&mut best, &mut again);
                part = f64::min(2.0 * part, 1.0);
            } else {
                part /= 2.0;
            }
            best.candidate.solver.factorisations = factorisations;
            if is_last && !is_better {
                break;
            }
        }
        best
    }

    /// Whether the search for it ended early, and contacts are [`FAR`] from a solution.
    fn is_far(&self) -> bool {
        let solver = &self.candidate.solver;
        solver.cut_short && solver.contact_residual > FAR
    }

    /// What it came to, as a prediction for the next.
    fn end(&self) -> Start {
        Start {
            impulses: self.candidate.swept.impulses.clone(),
            tensions: self.system.tensions(&self.candidate.x).collect(),
        }
    }
}

/// An island and its solution, which numbers wires and bodies as the island does.
pub(super) struct Solved {
    pub(super) island: Island,
    pub(super) system: System,
    pub(super) candidate: Candidate,
    /// What it is linear about.
    linearisation: Linearisation,
    /// What prescribed velocities do, in J.
    work: f64,
}

impl Solution {
    /// Solves from a start on, and spends at most one part in [`SOLVE`] of the budget on it.
    ///
    /// # Errors
    ///
    /// That of the first island that has one.
    pub(super) fn new(
        world: &World,
        structures: &mut Structures,
        contacts: &[ContactConstraint],
        start: &Start,
        budget: &mut Budget,
        phases: &mut Phases,
    ) -> Result<Self, Reason> {
        let unsolved = |island: Island| {
            let structure = structures.remove(&island.key(world));
            Unsolved {
                island,
                structure,
                linearisation: None,
            }
        };
        let unsolved = islands(world, contacts).into_iter().map(unsolved).collect();
        let islands = solve(world, unsolved, contacts, start, budget, phases)?;
        Ok(Solution { islands })
    }

    /// Solves the islands again that have other contacts than they had.
    ///
    /// # Errors
    ///
    /// That of the first island that has one. The solution is as before.
    pub(super) fn update(
        &mut self,
        world: &World,
        contacts: &[ContactConstraint],
        start: &Start,
        budget: &mut Budget,
        phases: &mut Phases,
    ) -> Result<(), Reason> {
        let known = self
            .islands
            .iter_mut()
            .map(|own| (own.island.key(world), own));
        let mut known: BTreeMap<usize, &mut Solved> = known.collect();
        let mut unsolved = Vec::new();
        for island in islands(world, contacts) {
            let before = known.get_mut(&island.key(world));
            if before
                .as_ref()
                .is_some_and(|before| before.island == island)
            {
                continue;
            }
            let same = before
                .as_ref()
                .filter(|own| own.island.members(world).eq(island.members(world)));
            let linearisation = same.map(|own| {
                own.linearisation
                    .of_bodies(&own.island.bodies, &island.bodies)
            });
            let structure = before.and_then(|before| before.system.take_structure());
            unsolved.push(Unsolved {
                island,
                structure,
                linearisation,
            });
        }
        let solved = solve(world, unsolved, contacts, start, budget, phases)?;
        let mut is_solved = vec![false; world.wires.len() + world.bodies.len()];
        for member in solved.iter().flat_map(|own| own.island.members(world)) {
            is_solved[member] = true;
        }
        self.islands
            .retain(|own| !own.island.members(world).any(|member| is_solved[member]));
        self.islands.extend(solved);
        self.islands.sort_by_key(|own| own.island.key(world));
        Ok(())
    }

    /// By their least members.
    pub(super) fn islands(&self) -> &[Solved] {
        &self.islands
    }

    /// The velocities of everything.
    pub(super) fn velocities(&self, world: &World) -> Velocities {
        let mut velocities = Velocities::prescribed(world);
        for own in &self.islands {
            velocities.take(world, &own.island, &own.system.layout, &own.candidate.x);
        }
        velocities
    }

    /// The impulses of so many contacts, on their places A, in N s along x, y, z.
    pub(super) fn impulses(&self, contacts: usize) -> Vec<Vector> {
        let mut impulses = vec![Vector::zeros(); contacts];
        for own in &self.islands {
            let solved = &own.candidate.swept.impulses;
            for (&at, impulse) in own.island.contacts.iter().zip(solved) {
                impulses[at] = *impulse;
            }
        }
        impulses
    }

    /// How it was solved: of each number the largest of any island.
    pub(super) fn record(&self) -> SolverRecord {
        let records = self.islands.iter().map(|own| &own.candidate.solver);
        records.fold(SolverRecord::default(), |most, own| SolverRecord {
            residual: most.residual.max(own.residual),
            factorisations: most.factorisations.max(own.factorisations),
            sweeps: most.sweeps.max(own.sweeps),
            cut_short: most.cut_short || own.cut_short,
            slowed: most.slowed || own.slowed,
            contact_residual: most.contact_residual.max(own.contact_residual),
            slide_residual: most.slide_residual.max(own.slide_residual),
        })
    }

    /// Notes that it was not looked for any longer.
    pub(super) fn cut_short(&mut self) {
        for own in &mut self.islands {
            own.candidate.solver.cut_short = true;
        }
    }

    /// The elastic energy of the forces that wires have, in J.
    pub(super) fn elastic_energy(&self, step: f64) -> f64 {
        let energies = self.islands.iter().flat_map(|own| {
            let rows = own.system.rows.iter();
            rows.map(|row| row.elastic_energy(&own.candidate.x, step))
        });
        energies.sum()
    }

    /// What prescribed velocities do by wires and contacts, in J.
    pub(super) fn work(&self) -> f64 {
        self.islands.iter().map(|own| own.work).sum()
    }

    /// What there was beside the masses in the motion that was made.
    pub(super) fn added_inertia(&self, world: &World) -> AddedInertia {
        let mut added = AddedInertia::default();
        for own in &self.islands {
            let inertias = &own.system.inertias;
            added.places += inertias.terms.len() + inertias.nodes.len();
            let wire = |at: usize| &world.wires[own.island.wires[at]];
            let body = |at: usize| &world.bodies[own.island.bodies[at]];
            let terms = inertias.terms.iter();
            let damped: f64 = terms.map(|term| term.energy(wire, body)).sum();
            added.damped += damped + own.system.energy_of_steep_segments(&own.candidate.x);
        }
        added
    }

    /// What forces along the directions at the end of the step took from the motion, in J.
    pub(super) fn numerical_damping(&self) -> f64 {
        let islands = self.islands.iter();
        islands
            .map(|own| own.system.damped_by_lead(&own.candidate.x))
            .sum()
    }

    /// The structures of the systems, for the next step.
    pub(super) fn structures(self, world: &World) -> Structures {
        let islands = self.islands.into_iter();
        let structures = islands.filter_map(|mut own| {
            let structure = own.system.take_structure()?;
            Some((own.island.key(world), structure))
        });
        structures.collect()
    }
}

/// Solves islands, at the same time. Each may spend what its segments and contacts are of those that
/// have anything to find.
fn solve(
    world: &World,
    unsolved: Vec<Unsolved>,
    contacts: &[ContactConstraint],
    start: &Start,
    budget: &mut Budget,
    phases: &mut Phases,
) -> Result<Vec<Solved>, Reason> {
    let weight = |unsolved: &Unsolved| {
        let island = &unsolved.island;
        let iterates = island.iterates();
        if iterates { island.things(world) } else { 0 }
    };
    let weights: Vec<usize> = unsolved.iter().map(weight).collect();
    let jobs = unsolved.into_iter().zip(budget.parts(SOLVE, &weights));
    let solved = made(jobs.collect(), |(unsolved, mut budget)| {
        let mut phases = Phases::default();
        let own = Solved::new(world, unsolved, contacts, start, &mut budget, &mut phases);
        (own, budget, phases)
    });
    let mut all = Vec::with_capacity(solved.len());
    for (own, left, took) in solved {
        budget.take_back(left);
        phases.add(&took);
        all.push(own);
    }
    all.into_iter().collect()
}

impl Solved {
    /// The tensions of its segments, by wires of the whole world, as impulses in N s.
    pub(super) fn tensions(&self) -> impl Iterator<Item = (usize, Vec<f64>)> {
        let wires = self.island.wires.iter().copied();
        wires.zip(self.system.tensions(&self.candidate.x))
    }

    /// The torque of each wire that holds twist, by wires of the whole world, as an impulse in N m s.
    pub(super) fn torques(&self) -> impl Iterator<Item = (usize, f64)> {
        let wires = self.island.wires.iter().zip(&self.system.layout.twist);
        wires.filter_map(|(&wire, multiplier)| Some((wire, self.candidate.x[(*multiplier)?])))
    }

    fn new(
        world: &World,
        unsolved: Unsolved,
        contacts: &[ContactConstraint],
        start: &Start,
        budget: &mut Budget,
        phases: &mut Phases,
    ) -> Result<Self, Reason> {
        let Unsolved {
            island,
            mut structure,
            linearisation,
        } = unsolved;
        let own = island.world(world);
        let world = own.as_ref().unwrap_or(world);
        let (contacts, start) = (island.contacts(contacts), start.of(&island));
        let linearisation = linearisation.unwrap_or_else(|| Linearisation::at_start(world));
        let mut solve = |linearisation: Linearisation, start: &Start, budget: &mut Budget| {
            let (mut system, candidate) = world.solve_step(
                &linearisation,
                &mut structure,
                &contacts,
                start,
                budget,
                phases,
            )?;
            structure = system.take_structure();
            let held = Held::new(world, &contacts, &candidate.swept.impulses);
            let followed = linearisation.follow(world, &system, &held, &candidate.x);
            Ok::<_, Reason>(Attempt {
                linearisation,
                system,
                candidate,
                held,
                followed,
            })
        };
        let mut first = solve(linearisation, &start, budget);
        if first.as_ref().is_ok_and(|first| !first.followed.suits) {
            first = solve(Linearisation::at_start(world), &start, budget);
        }
        let first = first.map_err(|reason| island.reason(reason))?;
        let best = first.follow(world, budget, solve);
        let Attempt {
            linearisation,
            mut system,
            mut candidate,
            ..
        } = best;
        system.give_structure(structure);
        let work = |of: &Candidate| {
            let layout = &system.layout;
            let by_contacts = layout.work_of_contacts(world, &contacts, &of.swept.impulses);
            system.work_of_rows(&of.x) + by_contacts
        };
        energy_limit::slow(world, &system.layout, &contacts, &mut candidate, work);
        let work = work(&candidate);
        Ok(Solved {
            island,
            system,
            candidate,
            linearisation,
            work,
        })
    }
}

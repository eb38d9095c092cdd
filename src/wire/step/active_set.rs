//! The active set: which segments of chains pull, and over which contact nodes wires slide.
//!
//! A chain's row `G v >= target` has the multiplier `(G v - target) / Sigma` where it is violated,
//! and none else. So for given impulses of contacts the velocities of a step are where `v . M~ v /
//! 2 - v . (M v + h f) + sum (G v - target)^2 / (2 Sigma)` is least, with the rows of chains
//! counted only where they are above their target. This function is strictly convex and piecewise
//! quadratic: Newton's method with an exact line search finds its minimum in finitely many steps
//! (Sun, Math. Program. 76, 1997). So it is with every
//! [`ConstitutiveLaw`](super::constitutive::ConstitutiveLaw) in place of that square.
//!
//! The friction at a contact node is bounded by the tensions beside it ([`capstan`]). It is found
//! for bounds that stand, then for those that agree with tensions
//! ([`friction_bounds`](super::friction_bounds)), and so on until the bounds stay.

use super::budget::Budget;
use super::capstan;
use super::friction_bounds::BoundSearch;
use super::rows::Row;
use super::system::{RESIDUAL, System};
use crate::wire::bisect::bisect;
use crate::wire::error::Reason;

/// Newton steps that are tried at most; some dozens are usual for the longest
/// chains.
const TRIES: usize = 1000;

/// How often bounds of friction are updated at most; a few times are usual. Then they are accepted,
/// and the record has their residual.
const BOUNDS: usize = 100;

/// After so many factorisations bounds are not updated any more.
const SEARCHED: usize = 300;

/// A solution for given impulses in which every row has the branch of its law that holds there.
pub(super) struct ActiveSet {
    pub(super) x: Vec<f64>,
    /// Its backward error.
    pub(super) backward_error: f64,
    /// Factorisations that it took.
    pub(super) factorisations: usize,
    /// Whether the branches are those that hold.
    pub(super) is_found: bool,
}

/// Whether rows contradict the guess of their branches: one of a chain that counts and
/// pushes, or one that does not and is longer after the step than it may be; friction whose bound
/// is not that of the tensions. What a solution may be off by is no contradiction.
pub(super) fn violates_branches(rows: &[Row], x: &[f64]) -> bool {
    leaves_branch(rows, x) || capstan::bounds_differ(rows, x)
}

/// Whether a solution lies outside the range of the branch of a row.
pub(super) fn leaves_branch(rows: &[Row], x: &[f64]) -> bool {
    leaves(rows.iter().filter(|row| row.may_change()), x)
}

/// The same of the rows alone whose law is not softened.
pub(super) fn leaves_hard_branch(rows: &[Row], x: &[f64]) -> bool {
    let hard = |row: &&Row| row.may_change() && row.softened.is_none();
    leaves(rows.iter().filter(hard), x)
}

fn leaves<'a>(changing: impl Iterator<Item = &'a Row> + Clone, x: &[f64]) -> bool {
    let is_left = |row: &Row, accepted| row.branch.is_left(row.excess(x), accepted);
    // Mostly none is, and then it does not matter by how much one might be.
    if !changing.clone().any(|row| is_left(row, 0.0)) {
        return false;
    }
    let accepted = accepted(changing.clone(), x);
    let mut changing = changing;
    changing.any(|row| is_left(row, accepted))
}

/// What the excess of rows may be off by.
fn accepted<'a>(rows: impl Iterator<Item = &'a Row>, x: &[f64]) -> f64 {
    RESIDUAL * rows.fold(0.0, |a: f64, row| a.max(row.speed(x)))
}

/// Finds the branches of all rows under impulses on velocities, from the velocities of `x` on. If
/// that takes too much, some rows have a branch that does not hold: a segment of a chain may push,
/// or may be longer than it should. Momentum is that of the impulses all the same.
///
/// # Errors
///
/// Those of factoring and solving.
pub(super) fn find_active_set(
    system: &mut System,
    impulses: &[(usize, f64)],
    mut x: Vec<f64>,
    budget: &mut Budget,
) -> Result<ActiveSet, Reason> {
    let (mut tries, mut factorisations, mut updates) = (0, 0, 0);
    let mut search = BoundSearch::new();
    loop {
        tries += 1;
        if update_branches(&mut system.rows, &x, false) {
            system.factor()?;
            budget.spend(system.multiplications());
            factorisations += 1;
        }
        let (newton, backward_error) = system.solve(impulses)?;
        budget.spend(system.multiplications_of_solve());
        let is_last = tries == TRIES || budget.is_spent();
        if leaves_branch(&system.rows, &newton) && !is_last {
            let fraction = line_search(system, &x, &newton, 0.0);
            budget.spend(system.multiplications_of_line_search());
            advance(&mut x, &newton, fraction);
            continue;
        }
        x = newton;
        updates += 1;
        let is_last = is_last || updates > BOUNDS || factorisations > SEARCHED;
        if is_last || !capstan::bounds_differ(&system.rows, &x) {
            let is_found = !leaves_branch(&system.rows, &x);
            return Ok(ActiveSet {
                x,
                backward_error,
                factorisations,
                is_found,
            });
        }
        search.update(system, &x, budget);
    }
}

impl ActiveSet {
    /// If the branches were not found, lets every wire stick that would slide farther over a contact
    /// node than there is wire for: what is stretched so has more energy in the next step than there
    /// was.
    ///
    /// # Errors
    ///
    /// Those of factoring and solving.
    pub(super) fn stick_what_slides_too_far(
        &mut self,
        system: &mut System,
        impulses: &[(usize, f64)],
        budget: &mut Budget,
    ) -> Result<(), Reason> {
        // Ends: a wire that sticks is not let go again.
        while !self.is_found {
            let rows = system.rows.iter().filter(|row| row.may_change());
            let accepted = accepted(rows, &self.x);
            let mut found = false;
            for row in &mut system.rows {
                found |= row.stick_if_too_far(&self.x, accepted);
            }
            if !found {
                break;
            }
            system.factor()?;
            budget.spend(system.multiplications());
            self.factorisations += 1;
            (self.x, self.backward_error) = system.solve(impulses)?;
        }
        Ok(())
    }
}

/// Takes the branches that hold at a solution, or of softened laws those that give what was
/// predicted. Returns whether this changes the system.
pub(super) fn update_branches(rows: &mut [Row], x: &[f64], predicted: bool) -> bool {
    let mut changed = false;
    for row in rows.iter_mut().filter(|row| row.may_change()) {
        changed |= row.take_branch(x, predicted);
    }
    changed
}

/// Moves `x` by a fraction of the step to the Newton point.
pub(super) fn advance(x: &mut [f64], newton: &[f64], fraction: f64) {
    for (x, newton) in x.iter_mut().zip(newton) {
        *x += fraction * (newton - *x);
    }
}

/// The fraction of the step from `x` to the Newton point, at most 1, that minimises the function,
/// to a relative resolution.
pub(super) fn line_search(system: &System, x: &[f64], newton: &[f64], resolution: f64) -> f64 {
    // Quadratic as factored, the slope would rise from `-curvature` to 0 on the way.
    let mut displacement: Vec<f64> = newton.iter().zip(x).map(|(to, from)| to - from).collect();
    let mut changes = Vec::new();
    for row in &system.rows {
        let ends = [row.excess(x), row.excess(newton)];
        let counts = if row.branch.active { 1.0 } else { 0.0 };
        displacement[row.multiplier] = counts * (ends[1] - ends[0]) / row.regularisation();
        if row.may_change() {
            changes.push((ends, row));
        }
    }
    let contacts = system.implicit.iter();
    let contacts: Vec<_> = contacts
        .map(|contact| contact.slope_between(x, newton))
        .collect();
    let curvature = system.curvature(&displacement);
    let slope = |fraction: f64| {
        let terms = changes.iter().map(|([start, end], row)| {
            let rise = end - start;
            let excess = start + fraction * rise;
            let sigma = row.regularisation();
            let law = row.branch_at(excess).load(excess, sigma);
            rise / sigma * (law - row.branch.load(excess, sigma))
        });
        let contacts = contacts.iter().map(|slope| slope(fraction));
        (fraction - 1.0) * curvature + terms.sum::<f64>() + contacts.sum::<f64>()
    };
    if slope(1.0) <= 0.0 {
        return 1.0;
    }
    bisect(1.0, resolution, |fraction| slope(fraction) < 0.0)
}

#[cfg(test)]
mod tests;

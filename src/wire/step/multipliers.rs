//! The solution of a step with the contacts in the system.
//!
//! For predicted impulses and bounds of friction, the velocities of a step minimise a convex
//! function, with contacts as with chains ([`active_set`](super::active_set)). Newton's method with
//! a line search finds them. Its impulses are the next prediction, until prediction and solution
//! agree: the method of multipliers (Hestenes 1969, Powell 1969) for what the contacts hold, and
//! the fixed point of Haslinger (1983) for the friction that their normal impulses allow. Whatever
//! its bound, friction takes energy.

use super::active_set::{advance, leaves_branch, line_search, update_branches};
use super::capstan;
use super::friction_bounds::BoundSearch;
use super::system::System;
use crate::wire::error::Reason;

/// Factorisations after which this is given up; some dozens are usual.
const TRIES: usize = 200;

/// The most predictions; a dozen is usual. Then the solution is accepted, and the record has its
/// residual.
const ROUNDS: usize = 30;

/// The largest linearisation error that is accepted, as a fraction of the residual.
const LINEARISATION: f64 = 0.1;

/// Relative resolution of the line search.
const RESOLUTION: f64 = 1e-3;

/// A residual of at most `NEARLY` times the tolerance that does not fall `STAYS` times in a row is
/// accepted: it is rounding, or no contact can have the impulses that are asked for.
const NEARLY: f64 = 100.0;
const STAYS: usize = 3;

/// A solution for the last prediction.
pub(super) struct Solution {
    /// Velocities and multipliers.
    pub(super) x: Vec<f64>,
    /// Their backward error.
    pub(super) backward_error: f64,
    /// The largest error of velocities because other impulses were predicted, in m/s.
    pub(super) contact_residual: f64,
    /// Factorisations.
    pub(super) factorisations: usize,
}

/// Finds velocities and impulses, from the velocities of `x` on. The tolerance is in m/s.
///
/// # Errors
///
/// Those of factoring and solving; [`Reason::ActiveSet`] after very many factorisations.
pub(super) fn solve(system: &mut System, x: Vec<f64>, tolerance: f64) -> Result<Solution, Reason> {
    let mut solution = Solution {
        x,
        backward_error: 0.0,
        contact_residual: f64::INFINITY,
        factorisations: 0,
    };
    let mut search = BoundSearch::new();
    let (mut least, mut stayed) = (f64::INFINITY, 0);
    for _ in 0..ROUNDS {
        solution = minimise_for_predicted(system, solution, tolerance)?;
        stayed = if solution.contact_residual < 0.9 * least {
            0
        } else {
            stayed + 1
        };
        least = least.min(solution.contact_residual);
        let stays = solution.contact_residual <= NEARLY * tolerance && stayed >= STAYS;
        let converged = solution.contact_residual <= tolerance
            && !capstan::bounds_differ(&system.rows, &solution.x);
        if converged || stays {
            break;
        }
        search.update(system, &solution.x);
        for contact in &mut system.implicit {
            contact.update_prediction(&solution.x);
        }
    }
    (solution.x, solution.backward_error) = system.solve(&[])?;
    Ok(solution)
}

/// Minimises the function for the present prediction, as accurately as the residual asks for.
fn minimise_for_predicted(
    system: &mut System,
    mut solution: Solution,
    tolerance: f64,
) -> Result<Solution, Reason> {
    // The first linearisation is at the predicted impulses: the velocities so far minimise another
    // function.
    let mut predicted = true;
    while solution.factorisations < TRIES {
        update_branches(&mut system.rows, &solution.x);
        for contact in &mut system.implicit {
            contact.linearise(&solution.x, predicted);
        }
        system.factor()?;
        solution.factorisations += 1;
        let newton = system.estimate();
        let [linearisation_error, contact_residual] = residuals(system, &newton);
        if linearisation_error <= LINEARISATION * contact_residual.max(tolerance)
            && !leaves_branch(&system.rows, &newton)
        {
            (solution.x, solution.contact_residual) = (newton, contact_residual);
            return Ok(solution);
        }
        let fraction = if predicted {
            1.0
        } else {
            line_search(system, &solution.x, &newton, RESOLUTION)
        };
        advance(&mut solution.x, &newton, fraction);
        predicted = false;
    }
    Err(Reason::ActiveSet { tries: TRIES })
}

/// The largest errors of velocities in m/s: because laws are not linear, and because other impulses
/// were predicted.
fn residuals(system: &System, x: &[f64]) -> [f64; 2] {
    let contacts = system.implicit.iter();
    contacts.fold([0.0; 2], |most: [f64; 2], contact| {
        let own = contact.residuals(x);
        [most[0].max(own[0]), most[1].max(own[1])]
    })
}

#[cfg(test)]
mod tests;

//! The solution of a step with contacts by Newton's method, in the matrix or by
//! [gradients](super::conjugate_gradients).
//!
//! For predicted impulses and bounds of friction, the velocities of a step minimise a convex
//! function, with contacts as with chains ([`active_set`](super::active_set)). Newton's method with
//! a line search finds them. Its impulses are the next prediction, until prediction and solution
//! agree: the method of multipliers (Hestenes 1969, Powell 1969) for what the contacts hold, and
//! the fixed point of Haslinger (1983) for the friction that their normal impulses allow. Whatever
//! its bound, friction takes energy.

use super::active_set::{advance, leaves_hard_branch, line_search, update_branches};
use super::budget::Budget;
use super::capstan;
use super::conjugate_gradients;
use super::friction_bounds::BoundSearch;
use super::predictions::Predictions;
use super::system::{ContactMethod, System};
use crate::wire::Vector;
use crate::wire::error::Reason;

/// The most Newton steps; some dozens are usual.
const TRIES: usize = 200;

/// The most predictions; a dozen is usual. Then the solution is accepted, and the record has its
/// residual.
const ROUNDS: usize = 30;

/// The largest linearisation error that is accepted, as a fraction of the residual, in the matrix and by
/// gradients.
const LINEARISATION: f64 = 0.1;
const GRADIENTS_LINEARISATION: f64 = 0.5;

/// Relative resolution of the line search.
const RESOLUTION: f64 = 1e-3;

/// A residual of at most `NEARLY` times the tolerance that does not fall `STAYS` times in a row is
/// accepted: it is rounding, or no contact can have the impulses that are asked for. A larger one has
/// `FAR_STAYS` times: where things jam there may be no solution at all. Without hardening residuals fall
/// slowly where wires are stiff; what is not found in one step is looked for from there in the next.
const NEARLY: f64 = 100.0;
const STAYS: usize = 3;
const FAR_STAYS: usize = 6;
const GRADIENTS_NEARLY: f64 = 1000.0;
const GRADIENTS_STAYS: usize = 2;
const GRADIENTS_FAR_STAYS: usize = 4;

/// A solution for some prediction.
pub(super) struct Solution {
    /// Velocities and multipliers.
    pub(super) x: Vec<f64>,
    /// Their backward error.
    pub(super) backward_error: f64,
    /// Impulse of each contact on its place A, along x, y, z, in N s.
    pub(super) impulses: Vec<Vector>,
    /// The largest error of velocities because other impulses were predicted, in m/s.
    pub(super) contact_residual: f64,
    /// Factorisations, those for other predictions included.
    pub(super) factorisations: usize,
    /// Whether it is as close as was asked for, or as it gets; else this would have taken too much. It
    /// is a solution for its prediction all the same: things move as impulses say, within the residual,
    /// and contacts give way to what was not predicted, by the residual.
    pub(super) is_settled: bool,
}

/// Finds velocities and impulses, from the velocities of `x` on: of all predictions the solution with the
/// least residual. The tolerance is in m/s. None if not even the first prediction has a solution within the
/// budget.
///
/// # Errors
///
/// Those of factoring and solving.
pub(super) fn solve(
    system: &mut System,
    mut x: Vec<f64>,
    tolerance: f64,
    budget: &mut Budget,
) -> Result<Option<Solution>, Reason> {
    let mut search = BoundSearch::new();
    let mut best: Option<Solution> = None;
    let mut predictions = Predictions::new(system);
    let (mut stayed, mut steps, mut is_settled) = (0, 0, false);
    for round in 1..=ROUNDS {
        let phase = minimise_for_predicted(system, &mut x, tolerance, &mut steps, budget)?;
        let Some(contact_residual) = phase else {
            if best.is_none() && system.method == ContactMethod::ByGradients {
                let x = conjugate_gradients::end_within_cones(system);
                let [law, predicted] = residuals(system, &x);
                best = Some(Solution::of(system, law.max(predicted))?);
            }
            break;
        };
        let least = best
            .as_ref()
            .map_or(f64::INFINITY, |best| best.contact_residual);
        stayed = if contact_residual < 0.9 * least {
            0
        } else {
            stayed + 1
        };
        if best.is_none() || contact_residual < least {
            best = Some(Solution::of(system, contact_residual)?);
            budget.spend(system.multiplications_of_solve());
        }
        let converged = contact_residual <= tolerance && !capstan::bounds_differ(&system.rows, &x);
        let stays = match system.method {
            ContactMethod::ByGradients if least <= GRADIENTS_NEARLY * tolerance => GRADIENTS_STAYS,
            ContactMethod::ByGradients => GRADIENTS_FAR_STAYS,
            ContactMethod::InMatrix if least <= NEARLY * tolerance => STAYS,
            ContactMethod::InMatrix => FAR_STAYS,
        };
        is_settled = converged || round == ROUNDS || stayed >= stays;
        if is_settled {
            break;
        }
        search.update(system, &x, budget);
        predictions.update(system, &x);
    }
    Ok(best.map(|best| Solution {
        factorisations: system.factorisations,
        is_settled,
        ..best
    }))
}

impl Solution {
    /// That of the system as factored.
    fn of(system: &System, contact_residual: f64) -> Result<Self, Reason> {
        let (x, backward_error) = system.solve(&[])?;
        let contacts = system.implicit.iter();
        Ok(Solution {
            impulses: contacts.map(|contact| contact.world_impulse(&x)).collect(),
            x,
            backward_error,
            contact_residual,
            factorisations: 0,
            is_settled: false,
        })
    }
}

/// Minimises the function for the present prediction, as accurately as the residual asks for, from
/// the velocities of `x` to those that it ends at. Returns the residual, or none if that takes too
/// much.
fn minimise_for_predicted(
    system: &mut System,
    x: &mut Vec<f64>,
    tolerance: f64,
    steps: &mut usize,
    budget: &mut Budget,
) -> Result<Option<f64>, Reason> {
    // The first linearisation is at the predicted impulses: the velocities so far minimise another
    // function.
    let mut predicted = true;
    let accepted = match system.method {
        ContactMethod::InMatrix => LINEARISATION,
        ContactMethod::ByGradients => GRADIENTS_LINEARISATION,
    };
    // By gradients there is a motion after each Newton step, so one is done whatever there is to spend.
    let at_least = usize::from(system.method == ContactMethod::ByGradients);
    while *steps < TRIES && (*steps < at_least || !budget.is_spent()) {
        update_branches(&mut system.rows, x, predicted);
        for contact in &mut system.implicit {
            contact.linearise(x, predicted);
        }
        let before = system.factorisations;
        system.factor()?;
        let factored = system.factorisations - before;
        budget.spend(factored * system.multiplications() + system.multiplications_of_laws());
        *steps += 1;
        let newton = match system.method {
            ContactMethod::InMatrix => system.estimate(),
            ContactMethod::ByGradients => conjugate_gradients::solve(system, tolerance, budget),
        };
        let [linearisation_error, contact_residual] = residuals(system, &newton);
        if linearisation_error <= accepted * contact_residual.max(tolerance)
            && !leaves_hard_branch(&system.rows, &newton)
        {
            *x = newton;
            return Ok(Some(contact_residual));
        }
        let fraction = if predicted {
            1.0
        } else {
            line_search(system, x, &newton, RESOLUTION)
        };
        advance(x, &newton, fraction);
        predicted = false;
    }
    Ok(None)
}

/// The largest errors of velocities in m/s: because laws are not linear, and because other impulses
/// were predicted.
fn residuals(system: &System, x: &[f64]) -> [f64; 2] {
    let contacts = system.implicit.iter().map(|contact| contact.residuals(x));
    let rows = system.rows.iter().map(|row| row.residuals(x));
    contacts.chain(rows).fold([0.0; 2], |most: [f64; 2], own| {
        [most[0].max(own[0]), most[1].max(own[1])]
    })
}

#[cfg(test)]
pub(super) mod tests;

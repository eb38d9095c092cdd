//! The solution of a step with the contacts in the system.
//!
//! For impulses and bounds of friction that are foretold, the velocities of a step are where a convex function is least, with contacts
//! as with chains ([`slack`](super::slack)). Newton's method with a line search finds them. What comes out is foretold next, and so on
//! until nothing else comes out: the method of multipliers (Hestenes 1969, Powell 1969) for what the contacts hold, and the fixed
//! point of Haslinger (1983) for the friction that their normal impulses allow. Whatever its bound, friction takes energy.

use super::capstan;
use super::slack::{go, leaves_piece, line_search, take_pieces};
use super::system::System;
use crate::wire::error::Reason;

/// Factorisations after which this is given up; some dozens are usual.
const TRIES: usize = 200;

/// How often impulses are foretold anew; a dozen is usual. Then what comes out is accepted, and the record says what it lacks.
const ROUNDS: usize = 30;

/// The share of what velocities lack by which they may be off since laws are not linear.
const BENT: f64 = 0.1;

/// To which share of itself the way to go is found.
const RESOLUTION: f64 = 1e-3;

/// What lacks at most so many times the tolerance and does not fall so many times in a row stays: it is rounding, or impulses that no
/// contact can have.
const NEARLY: f64 = 100.0;
const STAYS: usize = 3;

/// What is found.
pub(super) struct Found {
    /// Velocities and multipliers.
    pub(super) x: Vec<f64>,
    /// Their backward error.
    pub(super) residual: f64,
    /// By how much velocities are off at most because other impulses were foretold, in m/s.
    pub(super) lack: f64,
    /// Factorisations.
    pub(super) tries: usize,
}

/// Finds velocities and impulses, from the velocities of `x` on. The tolerance is in m/s.
///
/// # Errors
///
/// Those of factoring and solving; [`Reason::Slack`] after very many tries.
pub(super) fn find(system: &mut System, x: Vec<f64>, tolerance: f64) -> Result<Found, Reason> {
    let mut found = Found {
        x,
        residual: 0.0,
        lack: f64::INFINITY,
        tries: 0,
    };
    let (mut least, mut stayed) = (f64::INFINITY, 0);
    for _ in 0..ROUNDS {
        found = least_for_foretold(system, found, tolerance)?;
        stayed = if found.lack < 0.9 * least {
            0
        } else {
            stayed + 1
        };
        least = least.min(found.lack);
        let stays = found.lack <= NEARLY * tolerance && stayed >= STAYS;
        let settled = found.lack <= tolerance && !capstan::bounds_differ(&system.rows, &found.x);
        if settled || stays {
            break;
        }
        capstan::update_bounds(&mut system.rows, &found.x);
        for contact in &mut system.implicit {
            contact.follow(&found.x);
        }
    }
    (found.x, found.residual) = system.solve(&[])?;
    Ok(found)
}

/// Where the function is least for what is foretold now, as far as it matters for what comes out.
fn least_for_foretold(
    system: &mut System,
    mut found: Found,
    tolerance: f64,
) -> Result<Found, Reason> {
    // The first time contacts are as foretold, not as the velocities have them, which come from another function.
    let mut foretold = true;
    while found.tries < TRIES {
        take_pieces(&mut system.rows, &found.x);
        for contact in &mut system.implicit {
            contact.linearise(&found.x, foretold);
        }
        system.factor()?;
        found.tries += 1;
        let newton = system.estimate();
        let [bend, lack] = residuals(system, &newton);
        if bend <= BENT * lack.max(tolerance) && !leaves_piece(&system.rows, &newton) {
            (found.x, found.lack) = (newton, lack);
            return Ok(found);
        }
        let share = if foretold {
            1.0
        } else {
            line_search(system, &found.x, &newton, RESOLUTION)
        };
        go(&mut found.x, &newton, share);
        foretold = false;
    }
    Err(Reason::Slack { tries: TRIES })
}

/// By how much velocities are off at most because laws are not linear, and because other impulses were foretold, in m/s.
fn residuals(system: &System, x: &[f64]) -> [f64; 2] {
    let contacts = system.implicit.iter();
    contacts.fold([0.0; 2], |most: [f64; 2], contact| {
        let own = contact.residuals(x);
        [most[0].max(own[0]), most[1].max(own[1])]
    })
}

#[cfg(test)]
mod tests;

//! Which segments of chains pull.
//!
//! A chain's row `G v >= target` has the multiplier `(G v - target) / Sigma` where it is violated, and none else.
//! So for given impulses of contacts the velocities of a step are where
//! `v . M~ v / 2 - v . (M v + h f) + sum (G v - target)^2 / (2 Sigma)` is least, with the rows of chains
//! counted only where they are above their target. This function is strictly convex and quadratic in pieces: Newton's
//! method with an exact line search finds its minimum in finitely many steps (Sun, Math. Program. 76, 1997).

use super::error::Reason;
use super::rows::Row;
use super::system::System;
use crate::wire::solve::bisect;

/// Newton steps that are tried before a step is given up; some dozens are usual for the longest chains.
const TRIES: usize = 1000;

/// A solution for given impulses in which exactly those rows of chains count that pull.
pub(super) struct Pulled {
    pub(super) x: Vec<f64>,
    /// Its backward error.
    pub(super) residual: f64,
    /// Factorisations that it took.
    pub(super) tries: usize,
}

/// Whether rows that pull only contradict the guess of which do: one that counts and pushes, or one that does
/// not and is longer after the step than it may be. Rounding of velocities is no contradiction.
pub(super) fn contradict(rows: &[Row], x: &[f64]) -> bool {
    const ROUNDING: f64 = 1e-12;
    let chains = || {
        rows.iter()
            .filter(|row| row.pulls_only && row.has_direction())
    };
    let fastest = chains().fold(0.0, |a: f64, row| a.max(row.speed(x)));
    let accepted = ROUNDING * fastest;
    chains().any(|row| {
        let excess = row.excess(x);
        if row.active {
            excess < -accepted
        } else {
            excess > accepted
        }
    })
}

/// Finds the rows of chains that pull under impulses on velocities, from the velocities of `x` on.
///
/// # Errors
///
/// Those of factoring and solving; [`Reason::Slack`] after very many tries.
pub(super) fn pull(
    system: &mut System,
    impulses: &[(usize, f64)],
    mut x: Vec<f64>,
) -> Result<Pulled, Reason> {
    for tries in 1..=TRIES {
        for row in system.rows.iter_mut().filter(|row| row.pulls_only) {
            row.active = row.has_direction() && row.excess(&x) > 0.0;
        }
        system.factor()?;
        let (newton, residual) = system.solve(impulses)?;
        if !contradict(&system.rows, &newton) {
            let x = newton;
            return Ok(Pulled { x, residual, tries });
        }
        let share = line_search(system, &x, &newton);
        for (x, newton) in x.iter_mut().zip(&newton) {
            *x += share * (newton - *x);
        }
    }
    Err(Reason::Slack { tries: TRIES })
}

/// The share of the way from `x` to the Newton point at which the function is least, at most 1.
fn line_search(system: &System, x: &[f64], newton: &[f64]) -> f64 {
    // Quadratic as factored, the slope would rise from `-curvature` to 0 on the way.
    let mut way: Vec<f64> = newton.iter().zip(x).map(|(to, from)| to - from).collect();
    let mut changes = Vec::new();
    for row in &system.rows {
        let ends = [row.excess(x), row.excess(newton)];
        let counts = if row.active { 1.0 } else { 0.0 };
        way[row.multiplier] = counts * (ends[1] - ends[0]) / row.sigma;
        if row.pulls_only && row.has_direction() {
            changes.push((ends, counts, row.sigma));
        }
    }
    let curvature = system.curvature(&way);
    let slope = |share: f64| {
        let terms = changes.iter().map(|([start, end], counts, sigma)| {
            let rise = end - start;
            let excess = start + share * rise;
            rise / sigma * (excess.max(0.0) - counts * excess)
        });
        (share - 1.0) * curvature + terms.sum::<f64>()
    };
    if slope(1.0) <= 0.0 {
        return 1.0;
    }
    bisect(1.0, |share| slope(share) < 0.0)
}

#[cfg(test)]
mod tests;

//! Bounds of friction at contact nodes, and the tensions that they are a part of.
//!
//! For given bounds `b` the solution of a step has tensions `T(b)`, and the bounds are to be `k (T1 +
//! T2)` with `k = tanh(f D/2)` at each node ([`capstan`](super::capstan)). Where each row stays on its
//! branch, `T` is linear in the bounds of the nodes that slide. So Newton's method asks for the bounds
//! that agree with the tensions which follow from them. These are linear equations, solved by
//! [`gmres`] with one solution with the present factor for each product: about a dozen, however many
//! nodes slide. Alone it may go round in circles between two sets of nodes that slide. Bounds that only
//! follow the last tensions turn in circles, too: where all nodes of a turn `theta` between two loads
//! slide, each update multiplies the error by `f theta / (f theta + i pi)`. Halfway they do not.

use smallvec::SmallVec;

use super::budget::Budget;
use super::capstan;
use super::constitutive::ConstitutiveLaw;
use super::gmres::{PRODUCTS, gmres};
use super::rows::Row;
use super::system::System;

/// A search for the bounds of friction, from those of the first tensions on.
pub(super) struct BoundSearch {
    /// The residual below which Newton's method is tried.
    newton_below: f64,
    /// Before a step of Newton's method: the residual, and the bounds that followed there.
    before: Option<(f64, Vec<f64>)>,
}

impl BoundSearch {
    pub(super) fn new() -> Self {
        BoundSearch {
            newton_below: f64::INFINITY,
            before: None,
        }
    }

    /// Sets the next bounds, after a solution `x` for the present ones. They are those that agree
    /// with tensions if each row keeps its branch. If that does not halve the residual, because
    /// other nodes slide then, it goes on from where it was, with bounds that go half of the way to
    /// what follows from tensions, until the residual is a quarter of what it was.
    pub(super) fn update(&mut self, system: &mut System, x: &[f64], budget: &mut Budget) {
        if !system.rows.iter().any(|row| row.law.bounds(x).is_some()) {
            return;
        }
        let residual = capstan::bound_residual(&system.rows, x);
        if let Some((before, bounds)) = self.before.take()
            && residual > before / 2.0
        {
            self.newton_below = before / 4.0;
            capstan::set_bounds(&mut system.rows, &bounds);
            return;
        }
        let halfway = capstan::halfway_bounds(&system.rows, x);
        let agreeing = (residual < self.newton_below).then(|| agreeing(system, x, budget));
        let bounds = match agreeing.flatten() {
            Some(agreeing) => {
                self.before = Some((residual, halfway));
                capstan::due_bounds(&system.rows, &agreeing)
            }
            None => halfway,
        };
        capstan::set_bounds(&mut system.rows, &bounds);
    }
}

/// A node over which wire slides.
struct Sliding<'r> {
    row: &'r Row,
    /// The sign of its friction.
    side: f64,
    factor: f64,
    /// The tensions that its bound grows with.
    pulling: SmallVec<[usize; 2]>,
}

impl<'r> Sliding<'r> {
    fn new(row: &'r Row, x: &[f64]) -> Option<Self> {
        let ConstitutiveLaw::Friction {
            factor, tensions, ..
        } = row.law
        else {
            return None;
        };
        let pulls = tensions.into_iter().zip(row.law.pulls(x));
        let due = row.law.bounds(x).map_or(0.0, |[_, due]| due);
        let pulling = pulls.filter(|(_, pull)| *pull > 0.0 && due > 0.0);
        row.slides_over().then(|| Sliding {
            row,
            side: if row.branch.range[0] < 0.0 { -1.0 } else { 1.0 },
            factor,
            pulling: pulling.map(|(tension, _)| tension).collect(),
        })
    }
}

/// The solution with the present branches whose tensions and bounds of friction agree.
fn agreeing(system: &System, x: &[f64], budget: &mut Budget) -> Option<Vec<f64>> {
    let rows = system.rows.iter();
    let sliding: Vec<_> = rows.filter_map(|row| Sliding::new(row, x)).collect();
    let products = sliding.len().min(PRODUCTS) + 1;
    budget.spend(products * system.multiplications_of_solve());
    // What changes of the bounds, in N s, change.
    let response = |changes: &[f64]| {
        let mut impulses = vec![0.0; x.len()];
        for (node, change) in sliding.iter().zip(changes) {
            let friction = node.side * change;
            (node.row).each_column(|column, value| impulses[column] -= friction * value);
        }
        system.response(impulses)
    };
    let residuals: Vec<f64> = (sliding.iter())
        .filter_map(|node| node.row.law.bounds(x))
        .map(|[bound, due]| due - bound)
        .collect();
    let product = |changes: &[f64]| {
        let follows = response(changes);
        let nodes = sliding.iter().zip(changes);
        nodes
            .map(|(node, change)| {
                let pulls = node.pulling.iter().map(|&tension| follows[tension]);
                change - node.factor * pulls.sum::<f64>()
            })
            .collect()
    };
    let mut followed = response(&gmres(product, &residuals)?);
    for (value, x) in followed.iter_mut().zip(x) {
        *value += x;
    }
    Some(followed)
}

#[cfg(test)]
mod tests;

//! Bounds of friction at contact nodes, and the tensions that they are a part of.
//!
//! For given bounds `b` the solution of a step has tensions `T(b)`, and the bounds are to be `k (T1 +
//! T2)` with `k = tanh(f D/2)` at each node ([`capstan`](super::capstan)). Where each row stays on its
//! branch, `T` is linear in the bounds of the nodes that slide. So Newton's method asks for the bounds
//! that agree with the tensions which follow from them, by one solution with the present factor for
//! each node that slides. Bounds that only follow the last tensions converge as long as nothing but
//! one end of the wire gives way. Between two loads each update leaves `f theta / |f theta + i pi|`
//! of the error, and from some turns on they go round in circles.

use super::capstan;
use super::constitutive::ConstitutiveLaw;
use super::rows::Row;
use super::system::System;

/// Sets the bounds of friction to those that a solution `x` would have with its branches, half of the
/// way if it is to be damped; where that has no solution, to those of its tensions.
pub(super) fn update(system: &mut System, x: &[f64], damped: bool) {
    let mut followed = agreeing(system, x).unwrap_or_else(|| x.to_vec());
    if damped {
        for (value, x) in followed.iter_mut().zip(x) {
            *value = (*value + x) / 2.0;
        }
    }
    capstan::update_bounds(&mut system.rows, &followed);
}

/// The solution with the present branches whose tensions and bounds of friction agree.
fn agreeing(system: &System, x: &[f64]) -> Option<Vec<f64>> {
    let sliding: Vec<&Row> = system.rows.iter().filter(|row| row.slides_over()).collect();
    // What one N s more of each bound changes.
    let responses: Vec<Vec<f64>> = (sliding.iter())
        .map(|row| {
            let side = if row.branch.range[0] < 0.0 { -1.0 } else { 1.0 };
            let mut impulses = vec![0.0; x.len()];
            row.each_column(|column, value| impulses[column] -= side * value);
            system.response(impulses)
        })
        .collect();
    let mut matrix = Vec::with_capacity(sliding.len());
    let mut right = Vec::with_capacity(sliding.len());
    for (at, row) in sliding.iter().enumerate() {
        let ConstitutiveLaw::Friction {
            factor, tensions, ..
        } = row.law
        else {
            return None;
        };
        let [bound, due] = row.law.bounds(x)?;
        let pulling = tensions.into_iter().filter(|&tension| x[tension] > 0.0);
        let equation = responses.iter().enumerate().map(|(other, response)| {
            let follows = pulling
                .clone()
                .map(|tension| response[tension])
                .sum::<f64>();
            let own = if other == at { 1.0 } else { 0.0 };
            own - factor * follows
        });
        matrix.push(equation.collect::<Vec<f64>>());
        right.push(due - bound);
    }
    let changes = solve(matrix, right)?;
    let mut followed = x.to_vec();
    for (change, response) in changes.iter().zip(&responses) {
        for (value, response) in followed.iter_mut().zip(response) {
            *value += change * response;
        }
    }
    Some(followed)
}

/// Solves a small system by elimination with row pivots. None if it is singular.
fn solve(mut matrix: Vec<Vec<f64>>, mut x: Vec<f64>) -> Option<Vec<f64>> {
    let n = x.len();
    for k in 0..n {
        let larger = |a: usize, b: usize| {
            if matrix[b][k].abs() > matrix[a][k].abs() {
                b
            } else {
                a
            }
        };
        let pivot = (k..n).fold(k, larger);
        matrix.swap(k, pivot);
        x.swap(k, pivot);
        let (above, below) = matrix.split_at_mut(k + 1);
        let eliminated = &above[k];
        if eliminated[k] == 0.0 {
            return None;
        }
        for (i, row) in below.iter_mut().enumerate() {
            let part = row[k] / eliminated[k];
            for (value, eliminated) in row[k..].iter_mut().zip(&eliminated[k..]) {
                *value -= part * eliminated;
            }
            x[k + 1 + i] -= part * x[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| matrix[k][j] * x[j]).sum();
        x[k] = (x[k] - known) / matrix[k][k];
    }
    x.iter().all(|value| value.is_finite()).then_some(x)
}

#[cfg(test)]
mod tests;

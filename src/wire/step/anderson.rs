//! Anderson acceleration of sweeps (Anderson, J. ACM 12, 1965).
//!
//! A sweep maps impulses to impulses; its fixed point is the solution. As long as no contact opens,
//! closes, sticks or slips, its change is nearly linear in the impulses. So the differences of the
//! last sweeps tell which combination of their results would change least, and the next sweep
//! starts there. After a sweep that changes much more than the one before, they are forgotten.

use std::collections::VecDeque;

use super::contact_blocks::{Block, Swept};
use super::coulomb::to_cone;
use super::delassus::Delassus;
use crate::wire::Vector;
use crate::wire::settings::Settings;

/// Differences that are remembered.
const DEPTH: usize = 8;

/// Every so many sweeps the next one starts from the extrapolation.
const PERIOD: usize = 4;

/// A sweep whose change is this many times that of the one before, squared, ends what was learnt.
const WORSE: f64 = 2.0;

/// Sweeps before the last one that start from each other: what is left in the end is no guess.
const PLAIN: usize = 10;

/// Weight of small combinations, which keeps the equations for them regular.
const SMALL: f64 = 1e-8;

/// Sweeps until the contacts have converged, or there are no more sweeps.
pub(super) fn sweep(
    delassus: &mut Delassus,
    blocks: &mut [Block],
    settings: &Settings,
    swept: &mut Swept,
) {
    let mut history = History::default();
    let diagonals = blocks
        .iter()
        .map(|block| block.mobility.matrix().diagonal());
    let units: Vec<f64> = diagonals
        .flat_map(|d| [d.x, d.y, d.z])
        .map(f64::sqrt)
        .collect();
    while !swept.is_done(settings) {
        let before = impulses(blocks);
        swept.repeat(settings, 1, || delassus.relax(blocks));
        if swept.is_done(settings) || swept.sweeps + PLAIN >= settings.sweeps {
            continue;
        }
        let mut sample = sample(&before, blocks, delassus, &units);
        history.learn(&sample);
        if swept.sweeps.is_multiple_of(PERIOD) {
            history.extrapolate(&mut sample);
            start_from(&sample, blocks, delassus);
        }
    }
}

fn impulses(blocks: &[Block]) -> Vec<f64> {
    let each = blocks.iter().map(|block| block.impulse);
    each.flat_map(|impulse| [impulse.x, impulse.y, impulse.z])
        .collect()
}

/// What a sweep changed, in units in which a change moves its own contact alike, and the impulses
/// and velocities that it came to.
fn sample(before: &[f64], blocks: &[Block], delassus: &Delassus, units: &[f64]) -> Sample {
    let mut values = impulses(blocks);
    let changes = values.iter().zip(before).zip(units);
    let changes = changes.map(|((after, before), unit)| unit * (after - before));
    let changes = changes.collect();
    values.extend_from_slice(&delassus.excess);
    Sample { changes, values }
}

/// Takes impulses and velocities from a sample, and impulses back to their cones.
fn start_from(sample: &Sample, blocks: &mut [Block], delassus: &mut Delassus) {
    let (impulses, excess) = sample.values.split_at(3 * blocks.len());
    delassus.excess.copy_from_slice(excess);
    for ((at, block), impulse) in blocks.iter_mut().enumerate().zip(impulses.chunks_exact(3)) {
        let impulse = Vector::from_column_slice(impulse);
        block.impulse = to_cone(&impulse, block.friction);
        delassus.push(at, &(block.impulse - impulse));
    }
}

/// What one application of a map changed, in units that make changes alike, and the values that it came
/// to.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub(super) changes: Vec<f64>,
    pub(super) values: Vec<f64>,
}

impl Sample {
    /// All of its numbers, and those of another one.
    fn pairs<'s>(&'s mut self, other: &'s Sample) -> impl Iterator<Item = (&'s mut f64, &'s f64)> {
        let changes = self.changes.iter_mut().zip(&other.changes);
        changes.chain(self.values.iter_mut().zip(&other.values))
    }
}

/// What the last applications taught.
#[derive(Default)]
pub(super) struct History {
    /// Differences of samples, one after the other.
    differences: VecDeque<Sample>,
    /// The products of their changes, of each with itself and those before it.
    products: VecDeque<VecDeque<f64>>,
    last: Option<Sample>,
    /// The square of the last sweep's change.
    change: f64,
}

impl History {
    pub(super) fn learn(&mut self, sample: &Sample) {
        let change = product(sample, sample);
        if self.last.is_some() && change > WORSE * self.change {
            *self = History::default();
        }
        self.change = change;
        let Some(last) = self.last.replace(sample.clone()) else {
            return;
        };
        let mut difference = sample.clone();
        for (new, old) in difference.pairs(&last) {
            *new -= old;
        }
        self.differences.push_back(difference);
        let new = &self.differences[self.differences.len() - 1];
        let products = self.differences.iter().map(|old| product(new, old));
        self.products.push_back(products.collect());
        if self.differences.len() > DEPTH {
            self.differences.pop_front();
            self.products.pop_front();
            for row in &mut self.products {
                row.pop_front();
            }
        }
    }

    /// Takes from a sample the combination of differences that leaves the least change: least
    /// squares by the normal equations.
    pub(super) fn extrapolate(&self, sample: &mut Sample) {
        let trace: f64 = self.products.iter().filter_map(VecDeque::back).sum();
        let mut matrix = Vec::with_capacity(self.products.len());
        for (k, row) in self.products.iter().enumerate() {
            let mut row: Vec<f64> = row.iter().copied().collect();
            row[k] += SMALL * trace;
            matrix.push(row);
        }
        let right = self.differences.iter();
        let right = right.map(|difference| product(difference, sample));
        let coefficients: Vec<f64> = solve(matrix, right.collect());
        if coefficients
            .iter()
            .any(|coefficient| !coefficient.is_finite())
        {
            return;
        }
        for (difference, coefficient) in self.differences.iter().zip(coefficients) {
            for (value, difference) in sample.pairs(difference) {
                *value -= coefficient * difference;
            }
        }
    }
}

/// The product of the changes of two samples. Four sums, which a processor does at once.
fn product(a: &Sample, b: &Sample) -> f64 {
    let (a, b) = (a.changes.chunks_exact(4), b.changes.chunks_exact(4));
    let rest = a.remainder().iter().zip(b.remainder());
    let rest = rest.fold(0.0, |sum, (a, b)| sum + a * b);
    let mut sums = [0.0; 4];
    for (a, b) in a.zip(b) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Solves a small positive definite system, given by its lower triangle, by `L L^T`; 0 where
/// nothing is left of a pivot.
fn solve(mut matrix: Vec<Vec<f64>>, mut x: Vec<f64>) -> Vec<f64> {
    let n = x.len();
    for k in 0..n {
        for j in 0..=k {
            let known: f64 = (0..j).map(|i| matrix[k][i] * matrix[j][i]).sum();
            let left = matrix[k][j] - known;
            matrix[k][j] = if j < k {
                quotient(left, matrix[j][j])
            } else {
                left.max(0.0).sqrt()
            };
        }
        let known: f64 = (0..k).map(|i| matrix[k][i] * x[i]).sum();
        x[k] = quotient(x[k] - known, matrix[k][k]);
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|i| matrix[i][k] * x[i]).sum();
        x[k] = quotient(x[k] - known, matrix[k][k]);
    }
    x
}

fn quotient(value: f64, pivot: f64) -> f64 {
    if pivot > 0.0 { value / pivot } else { 0.0 }
}

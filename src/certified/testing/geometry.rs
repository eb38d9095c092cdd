//! Moving edges: of every kind that is hard for `f64`, and in exact arithmetic.

use std::ops::{Add, Mul, Sub};

use super::number::Number;
use super::polynomial::Polynomial;
use super::random::Random;
use crate::certified::motion::Positions;

/// The differences `K`, `L`, `M` as exact functions of `t`, and `f = (K x L) . M`.
pub(in super::super) struct Exact {
    pub(in super::super) k: [Polynomial; 3],
    pub(in super::super) l: [Polynomial; 3],
    pub(in super::super) m: [Polynomial; 3],
    pub(in super::super) f: Polynomial,
}

impl Exact {
    pub(in super::super) fn new(positions: &Positions) -> Self {
        Self::of(positions, [(1, 0), (3, 2), (2, 0)])
    }

    /// With `K`, `L` and `M` to and from these points.
    pub(in super::super) fn of(positions: &Positions, ends: [(usize, usize); 3]) -> Self {
        let Positions { start, end } = positions;
        let difference = |(to, from): (usize, usize)| {
            [0, 1, 2].map(|i| {
                let at = |x: &[[f64; 3]; 4]| &Number::from(x[to][i]) - &Number::from(x[from][i]);
                Polynomial::line(&at(start), &at(end))
            })
        };
        let [k, l, m] = ends.map(difference);
        let f = dot(&cross(&k, &l), &m);
        Exact { k, l, m, f }
    }

    /// `K x L`, `M x L` and `M x K` at `t`.
    pub(in super::super) fn normals(&self, t: &Number) -> [[Number; 3]; 3] {
        let at = |x: &[Polynomial; 3]| x.each_ref().map(|p| p.at(t));
        let (k, l, m) = (at(&self.k), at(&self.l), at(&self.m));
        [cross(&k, &l), cross(&m, &l), cross(&m, &k)]
    }

    /// `K . d`, `L . d` and `M . d` at `t`.
    pub(in super::super) fn along(&self, d: &[f64; 3], t: f64) -> [Number; 3] {
        let (d, t) = (d.map(Number::from), Number::from(t));
        let at = |x: &[Polynomial; 3]| dot(&x.each_ref().map(|p| p.at(&t)), &d);
        [at(&self.k), at(&self.l), at(&self.m)]
    }
}

pub(in super::super) fn dot<T>(x: &[T; 3], y: &[T; 3]) -> T
where
    for<'a> &'a T: Add<Output = T> + Mul<Output = T>,
{
    let [p, q, r] = [0, 1, 2].map(|i| &x[i] * &y[i]);
    &(&p + &q) + &r
}

fn cross<T>(x: &[T; 3], y: &[T; 3]) -> [T; 3]
where
    for<'a> &'a T: Sub<Output = T> + Mul<Output = T>,
{
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &(&x[i] * &y[j]) - &(&x[j] * &y[i]))
}

/// Positions from 24 coordinates: x, y, z of A to D at the start, then at the end.
pub(in super::super) fn layout(coordinates: &[f64]) -> Positions {
    let at = |time: usize| {
        let point = |p: usize| [0, 1, 2].map(|i| coordinates[12 * time + 3 * p + i]);
        [point(0), point(1), point(2), point(3)]
    };
    Positions {
        start: at(0),
        end: at(1),
    }
}

/// Coordinates for [`layout`], of one of several kinds, times a power of two in the given range as
/// often as not.
pub(in super::super) fn points(random: &mut Random, (low, high): (i32, i32)) -> [f64; 24] {
    let mut x = match random.below(7) {
        0 => [0.0; 24].map(|_| random.signed()),
        1 => [0.0; 24].map(|_| random.small()),
        2 => {
            let offset = [0.0; 3].map(|_| random.signed() * 2f64.powi(random.whole(0, 60)));
            let mut i = 0;
            [0.0; 24].map(|_| {
                i += 1;
                offset[i % 3] + random.signed()
            })
        }
        3 => nearly_degenerate(random),
        4 => {
            let few = [random.signed(), random.signed(), random.small(), 0.0];
            [0.0; 24].map(|_| {
                let value = few[random.below(4) as usize];
                random.nudged(value)
            })
        }
        // Sparse: few terms, which do not make up for each other's errors.
        5 => [0.0; 24].map(|_| if random.coin() { random.signed() } else { 0.0 }),
        _ => [0.0; 24].map(|_| random.signed() * 2f64.powi(random.whole(-30, 30))),
    };
    if random.coin() {
        let factor = random.whole(low, high);
        // In two steps: the power itself may be out of range.
        let (first, second) = (factor / 2, factor - factor / 2);
        x = x.map(|x| x * 2f64.powi(first) * 2f64.powi(second));
    }
    if x.iter().all(|x| x.is_finite()) {
        x
    } else {
        points(random, (low, high))
    }
}

/// Coordinates for [`layout`], then a direction, along which the points of one side are apart from
/// the others as often as not.
pub(in super::super) fn points_and_direction(random: &mut Random, side: &[usize]) -> [f64; 27] {
    let mut x = [0.0; 27];
    x[..24].copy_from_slice(&points(random, (-1074, 1020)));
    // Large directions for small points and the other way round, so that products are of any size.
    let power = match random.below(3) {
        0 => random.whole(-1000, 1000),
        _ => 0,
    };
    for d in &mut x[24..] {
        *d = random.signed() * 2f64.powi(power);
    }
    if random.coin() {
        // Apart along an axis, by anything from nothing to far.
        let gap = x[0].abs() * 2f64.powi(-random.whole(0, 60));
        let axis = random.below(3) as usize;
        x[24..].fill(0.0);
        x[24 + axis] = 2f64.powi(power);
        for p in 0..8 {
            let coordinate = &mut x[3 * p + axis];
            *coordinate = if side.contains(&(p % 4)) {
                -coordinate.abs()
            } else {
                coordinate.abs() + gap
            };
        }
    }
    x
}

/// The least and the largest coordinate `i` of some of the points of [`layout`], in the whole step.
pub(in super::super) fn range(x: &[f64], i: usize, points: &[usize]) -> (f64, f64) {
    let both = |&p: &usize| [x[3 * p + i], x[3 * p + 12 + i]];
    let mut values: Vec<f64> = points.iter().flat_map(both).collect();
    values.sort_by(f64::total_cmp);
    (values[0], values[values.len() - 1])
}

/// Parallel, coplanar or touching edges, up to a few roundings.
fn nearly_degenerate(random: &mut Random) -> [f64; 24] {
    let mut x = [0.0; 24].map(|_| random.signed());
    let (u, v, kind) = (random.unit(), random.unit(), random.below(3));
    for time in [0, 12] {
        for i in time..time + 3 {
            let [a, b, c] = [x[i], x[i + 3], x[i + 6]];
            x[i + 9] = match kind {
                0 => c + v * (b - a),
                1 => a + u * (b - a) + v * (c - a),
                _ => c + (a + u * (b - a) - c) / v.max(0.1),
            };
        }
    }
    x
}

//! Conservative advancement: planes that keep the two sides more than the radius apart, each for a part of the
//! step, until the step ends or they are no farther apart than rounding can tell.
//!
//! A direction `n` proves that they are apart at a time at which `X . n > R |n|` for all corners `X` of the set of
//! differences. That is linear in `t`, so it holds from one time to another, which are known by a division. Taken
//! from the nearest points at the time reached, the direction is the best there is, and the next time is right
//! up to the square of the step: it is Newton's method from the safe side (after Mirtich, "Impulse-based dynamic
//! simulation of rigid body systems", 1996).

use super::shape::{Gram, Shape, Spot};
use crate::certified::ends::Ends;
use crate::certified::locate::at;
use crate::certified::motion::{Motion, Positions, Vector, add, both, dot, sub};
use crate::certified::separate::{SweptBoxes, U};
use crate::query::Radius;

/// A query in `f64`.
pub(super) struct Moving<E> {
    /// `K`, `L` and `M` of the shape.
    pub(super) motion: Motion<E>,
    pub(super) boxes: SweptBoxes,
    /// Not below the radius, and above it by no more than some `u`.
    pub(super) radius: f64,
}

/// A part of the step, ends included; nothing if it ends before it starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub(super) from: f64,
    pub(super) to: f64,
}

/// How far it is proved that they are more than the radius apart.
#[derive(Clone, Copy, Debug)]
pub(super) enum Advance {
    /// During the whole step.
    Apart,
    /// Up to this time, at which they are about the radius apart.
    Until(f64),
    /// Not even at the start.
    Near,
}

const MOST_STEPS: u32 = 24;

impl Span {
    const NOTHING: Span = Span { from: 1.0, to: 0.0 };

    pub(super) fn is_all(&self) -> bool {
        self.from <= 0.0 && self.to >= 1.0
    }
}

impl<E: Ends> Moving<E> {
    pub(super) fn new<S: Shape>(positions: &Positions, boxes: SweptBoxes, radius: f64) -> Self {
        let points = positions.points::<E>();
        let [k, l, m] = S::WAYS.map(|(from, to)| sub(&points[to], &points[from]));
        Moving {
            motion: Motion { k, l, m },
            boxes,
            radius,
        }
    }

    /// `K`, `L` and `M` at a time, about.
    pub(super) fn at(&self, t: f64) -> [Vector; 3] {
        let Motion { k, l, m } = &self.motion;
        [at(k, t), at(l, t), at(m, t)]
    }

    /// The part of the step in which a plane with this normal certainly keeps them more than the radius apart.
    ///
    /// Error bound: the products with `n` at both ends are within [`SweptBoxes::bound`] of the exact ones, of which
    /// `parts` are taken here, `|n|` within `4 u`. What is computed from them passes three roundings, which `8 u` outweigh. NaN and
    /// infinities prove nothing, nor does what underflows.
    pub(super) fn span<S: Shape>(&self, n: &Vector, bounds: f64) -> Span {
        let square = dot(n, n);
        let least = self.radius * square.sqrt() * (1.0 + 8.0 * U) + bounds * self.boxes.bound(n);
        if !(square > SMALLEST && square < LARGEST && least < LARGEST) {
            return Span::NOTHING;
        }
        let along = both(n);
        let Motion { k, l, m } = &self.motion;
        let (k, l, m) = (dot(k, &along), dot(l, &along), dot(m, &along));
        let mut span = Span {
            from: 0.0,
            to: f64::INFINITY,
        };
        for &(u, v) in S::CORNERS {
            let corner = m + E::both(v) * l - E::both(u) * k;
            let (start, end) = (corner.start() - least, corner.end() - least);
            match (start > 0.0, end > 0.0) {
                (true, true) => {}
                (true, false) => span.to = span.to.min(start / (start - end) * (1.0 - 8.0 * U)),
                (false, true) => span.from = span.from.max(start / (start - end) * (1.0 + 8.0 * U)),
                (false, false) => return Span::NOTHING,
            }
        }
        span
    }

    /// The part of the step in which the direction from the middle of one side's motion to that of the other
    /// separates them.
    pub(super) fn span_of_centres<S: Shape>(&self) -> Span {
        let Motion { k, l, m } = &self.motion;
        let [m, l, k] = [m, l, k].map(|x| x.map(E::sum));
        let share = 1.0 / S::CORNERS.len() as f64;
        let [u, v] = [0, 1].map(|i| {
            let sum: f64 = S::CORNERS.iter().map(|&(u, v)| [u, v][i]).sum();
            sum * share
        });
        self.span::<S>(&way(&[k, l, m], u, v), 1.0)
    }

    /// About the nearest place at a time, and the difference there.
    pub(super) fn nearest<S: Shape>(&self, t: f64) -> (Spot, Vector) {
        let vectors = self.at(t);
        let [k, l, m] = &vectors;
        let spot = S::nearest(&Gram::new(k, l, m));
        (spot, way(&vectors, spot.u, spot.v))
    }

    /// Advances from a time up to which they are apart.
    pub(super) fn advance<S: Shape>(&self, from: f64) -> Advance {
        let mut t = from;
        for _ in 0..MOST_STEPS {
            let (_, n) = self.nearest::<S>(t);
            let span = self.span::<S>(&n, 1.0);
            if !(span.from <= t && span.to > t) {
                break;
            }
            if span.to >= 1.0 {
                return Advance::Apart;
            }
            let step = span.to - t;
            t = span.to;
            if step < t * SHORT {
                break;
            }
        }
        if t > 0.0 {
            Advance::Until(t)
        } else {
            Advance::Near
        }
    }
}

/// Not below the sum of both radii, and above it by no more than `4 u`.
pub(super) fn rounded_up(radius: Radius) -> f64 {
    radius.rounded().next_up()
}

/// `M + v L - u K`.
pub(super) fn way([k, l, m]: &[Vector; 3], u: f64, v: f64) -> Vector {
    sub(&add(m, &l.map(|x| v * x)), &k.map(|x| u * x))
}

/// A step so short that the next one is up to rounding.
const SHORT: f64 = 1.0 / (1u64 << 44) as f64;

/// 2^-900.
const SMALLEST: f64 = f64::from_bits((1023 - 900) << 52);

/// 2^900.
const LARGEST: f64 = f64::from_bits((1023 + 900) << 52);

#[cfg(test)]
mod tests;

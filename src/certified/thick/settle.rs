//! The time of impact to its last bit, in double-double arithmetic.
//!
//! Two proofs hold it between neighbours in `f64`: at the upper one a pair of points is no farther apart than the
//! radius; up to the lower one a plane keeps all corners farther apart than that. Both take the nearest points
//! at a time nearby, which a Newton step in double-double arithmetic corrects: the errors that remain count by
//! their squares.

use wide::f64x2;

use super::advance::Moving;
use super::shape::{Free, Gram, Shape, Spot};
use crate::certified::double::{Double, two_difference, two_sum};
use crate::certified::ends::Ends;
use crate::certified::motion::{Positions, Vector, dot, reach};
use crate::query::Radius;

/// A number at two times.
type Twice = Double<f64x2>;

/// A contact within the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settled {
    /// The largest `f64` below the time of impact, which is below the next one.
    pub(super) below: f64,
    /// The nearest place at a time that is no farther from the time of impact than `2^-52`, about.
    pub(super) spot: Spot,
}

/// How often the time is corrected at most.
const MOST_STEPS: u32 = 4;

/// `2^-106`.
const H: f64 = f64::EPSILON * f64::EPSILON / 4.0;

/// What is computed at two times.
struct Instants<'a, S> {
    moving: &'a Moving<f64x2>,
    /// `K`, `L` and `M`.
    vectors: [[Twice; 3]; 3],
    /// The sum of the larger magnitudes of each component at the ends of the step.
    size: Vector,
    shape: std::marker::PhantomData<S>,
}

/// The time of impact, given that they are apart up to a time shortly before it. `None` if it is not certain.
pub(super) fn settle<S: Shape>(
    positions: &Positions,
    moving: &Moving<f64x2>,
    radius: Radius,
    proved: f64,
) -> Option<Settled> {
    let square = square(radius);
    let mut t = proved;
    for _ in 0..MOST_STEPS {
        let (spot, _) = moving.nearest::<S>(t);
        let here = Instants::<S>::new(positions, moving, [t, t]);
        let place = here.refined(&spot)?;
        let way = here.way(&place);
        let excess = dot_twice(&way, &way).sub(square).lanes()[0].value();
        let slope = here.slope(&way, &spot);
        let delta = -excess / slope;
        let time = two_sum(t, delta);
        if !(slope < 0.0 && time.high > 0.0 && time.high < 1.0) {
            return None;
        }
        if delta.abs() > time.high * NEAR {
            t = time.high;
            continue;
        }
        let below = if time.low < 0.0 {
            time.high.next_down()
        } else {
            time.high
        };
        let there = Instants::<S>::new(positions, moving, [below, below.next_up()]);
        let is_proved =
            there.is_apart_before(&way, square, proved) && there.is_near_after(&place, square);
        return is_proved.then_some(Settled { below, spot });
    }
    None
}

/// A correction after which the next one is far below the last bit.
const NEAR: f64 = 1.0 / (1u64 << 42) as f64;

/// The square of the radius, within `8 h` of it.
fn square(radius: Radius) -> Twice {
    let [first, second] = radius.parts();
    let sum = Twice::both(two_sum(first, second));
    sum.mul(sum)
}

impl<S: Shape> Instants<'_, S> {
    fn new<'a>(
        positions: &Positions,
        moving: &'a Moving<f64x2>,
        times: [f64; 2],
    ) -> Instants<'a, S> {
        let time = f64x2::new(times);
        let points = |at: &[Vector; 4], i: usize, axis: usize| f64x2::both(at[i][axis]);
        let vectors = S::WAYS.map(|(from, to)| {
            [0, 1, 2].map(|axis| {
                let [first, last] = [&positions.start, &positions.end]
                    .map(|at| two_difference(points(at, to, axis), points(at, from, axis)));
                between(first, last, time)
            })
        });
        let motion = &moving.motion;
        let [k, l, m] = [&motion.k, &motion.l, &motion.m].map(reach);
        let size = [0, 1, 2].map(|i| k[i] + l[i] + m[i]);
        let shape = std::marker::PhantomData;
        Instants {
            moving,
            vectors,
            size,
            shape,
        }
    }

    /// The nearest place to twice the precision; `None` where it is not clear which part of the boundary it is
    /// on.
    ///
    /// One Newton step along the directions that are free.
    fn refined(&self, spot: &Spot) -> Option<[Twice; 2]> {
        let rough = [spot.u, spot.v].map(|x| Double {
            high: f64x2::both(x),
            low: f64x2::both(0.0),
        });
        let way = self.way(&rough);
        let [k, l, _] = &self.vectors;
        let product = |x: &[Twice; 3]| dot_twice(x, &way).lanes()[0].value();
        let (u, v) = (-product(k), product(l));
        let rounded = self.vectors.map(|x| x.map(|x| x.lanes()[0].high));
        let gram = Gram::new(&rounded[0], &rounded[1], &rounded[2]);
        let Gram { kk, ll, kl, .. } = gram;
        let (du, dv) = match spot.free {
            Free::Nowhere => (0.0, 0.0),
            Free::Along(x, y) => {
                let step = -(u * x + v * y) / (x * x * kk - 2.0 * x * y * kl + y * y * ll);
                (step * x, step * y)
            }
            Free::Everywhere => {
                let determinant = gram.determinant();
                (
                    -(ll * u + kl * v) / determinant,
                    -(kl * u + kk * v) / determinant,
                )
            }
        };
        let is_clear = S::clearance(spot) > 2.0 * MARGIN && du.abs() < MARGIN && dv.abs() < MARGIN;
        is_clear.then(|| [(spot.u, du), (spot.v, dv)].map(|(x, dx)| Double::both(two_sum(x, dx))))
    }

    /// `M + v L - u K`.
    ///
    /// Error bound: each component of a vector is within `56 h` of its larger magnitude at the ends (see
    /// [`between`]); the products with numbers up to 1 add `16 h`, both sums `32 h` of the sum `s` of the
    /// magnitudes; and a `u + v` that has to be 1 is so up to `h`. Below, `128 h s`.
    fn way(&self, [u, v]: &[Twice; 2]) -> [Twice; 3] {
        let [k, l, m] = &self.vectors;
        [0, 1, 2].map(|i| m[i].add(v.mul(l[i])).sub(u.mul(k[i])))
    }

    /// The derivative of the squared distance, with the nearest points kept: the nearest place does not change
    /// it in the first order.
    fn slope(&self, way: &[Twice; 3], spot: &Spot) -> f64 {
        let change = |x: &[f64x2; 3]| x.map(|x| x.end() - x.start());
        let motion = &self.moving.motion;
        let velocity = super::advance::way(
            &[&motion.k, &motion.l, &motion.m].map(change),
            spot.u,
            spot.v,
        );
        2.0 * dot(&way.map(|x| x.lanes()[0].high), &velocity)
    }

    /// Whether a plane with this normal certainly keeps them more than the radius apart from `proved`, up to
    /// which that is known, to the first time.
    ///
    /// A little before, `f64` proves it, with an error bound doubled for the rounding of the normal, of `2 u`.
    /// At the first time, with the sums `s` of [`way`](Self::way): a product with the normal is within
    /// `(56 + 8 + 24) h` of the sum of the `|n| s`, the corners' sums add `16 h`: below `128 h`. Both sides of
    /// the comparison and their difference are within `80 h`. In between it is linear.
    fn is_apart_before(&self, normal: &[Twice; 3], square: Twice, proved: f64) -> bool {
        let rounded = normal.map(|x| x.lanes()[0].high);
        let span = self.moving.span::<S>(&rounded, 2.0);
        if !(span.from <= proved && span.from <= span.to) {
            return false;
        }
        let [k, l, m] = self.vectors.each_ref().map(|x| dot_twice(x, normal));
        let error = 128.0 * H * dot(&rounded.map(f64::abs), &self.size) * (1.0 + 1e-6);
        let margin = Double::both(two_sum(error, 0.0));
        let least = dot_twice(normal, normal).mul(square);
        S::CORNERS.iter().all(|&(u, v)| {
            let scale = |x: f64, of: Twice| Double {
                high: f64x2::both(x) * of.high,
                low: f64x2::both(x) * of.low,
            };
            let corner = m.add(scale(v, l)).sub(scale(u, k));
            let corner = corner.sub(margin);
            let excess = corner.mul(corner).sub(least).lanes()[0].value();
            let least = least.lanes()[0].high;
            corner.lanes()[0].high > 0.0 && excess > 128.0 * H * least
        })
    }

    /// Whether the points of this place are certainly no farther apart than the radius at the second time.
    ///
    /// With `s` and the error of [`way`](Self::way), a square is off by `2 * 128 h |w| s` and the square of that error,
    /// both sides of the comparison and their difference by `48 h`.
    fn is_near_after(&self, place: &[Twice; 2], square: Twice) -> bool {
        let way = self.way(place);
        let rounded = way.map(|x| x.lanes()[1].high.abs());
        let total = self.size.iter().sum::<f64>();
        let squared = dot_twice(&way, &way);
        let error = 512.0 * H * dot(&rounded, &self.size)
            + (256.0 * H * total) * (256.0 * H * total)
            + 128.0 * H * square.lanes()[1].high;
        squared.sub(square).lanes()[1].value() < -error
    }
}

/// What a place that is free to move keeps from where it is not.
const MARGIN: f64 = 1.0 / (1u64 << 40) as f64;

/// From `first` at the start to `last` at the end, at two times.
///
/// The ends are exact and of magnitude up to `k`; their difference is within `16 h k`, the product with the time
/// within `16 h k` more, the sum within `24 h k` more: `56 h k`.
fn between(first: Twice, last: Twice, time: f64x2) -> Twice {
    let time = Double {
        high: time,
        low: f64x2::both(0.0),
    };
    first.add(last.sub(first).mul(time))
}

fn dot_twice(x: &[Twice; 3], y: &[Twice; 3]) -> Twice {
    x[0].mul(y[0]).add(x[1].mul(y[1])).add(x[2].mul(y[2]))
}

#[cfg(test)]
mod tests;

//! The time of impact to its last bit.
//!
//! Shortly before it the squared distance of the points that are nearest then is computed in
//! double-double arithmetic. With these points kept it is a polynomial of degree 2 in time, above
//! the squared distance of the two sides, and so little above it ([`nearness`](super::nearness))
//! that its root is the time of impact up to far below the last bit.

use std::cmp::Ordering;

use wide::f64x2;

use super::advance::Moving;
use super::instant::Instant;
use super::nearness::Nearness;
use crate::certified::double::{Double, two_difference, two_sum};
use crate::certified::ends::Ends;
use crate::certified::kind::Stages;
use crate::certified::motion::{Positions, Vector, dot};
use crate::certified::nearest::Spot;
use crate::certified::refine::Root;
use crate::certified::separate::U;
use crate::certified::stage::Finding;
use crate::contact::PLACE_ERROR;
use crate::query::Radius;

/// A contact within the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct RefinedToi {
    /// The neighbours of the time of impact in `f64`; both the same if it is one.
    pub(super) toi: [f64; 2],
    /// The nearest place at a time shortly before.
    pub(super) spot: Spot,
    /// `u` and `v` at the time of impact are no farther than this from those of the place.
    pub(super) error: f64,
    /// Whether they are parallel, so that they may be nearest in more than one place.
    pub(super) is_parallel: bool,
}

impl RefinedToi {
    /// A contact, if its place is known so well that what is computed from it is within what is
    /// promised.
    pub(super) fn new(toi: [f64; 2], spot: Spot, nearness: &Nearness) -> Option<Self> {
        let error = nearness.error;
        let is_parallel = nearness.is_parallel;
        (error <= PLACE_ERROR / 4.0).then_some(RefinedToi {
            toi,
            spot,
            error,
            is_parallel,
        })
    }
}

/// How often the time is corrected at most.
const MOST_STEPS: u32 = 4;

/// 2^-36.
const SHORT: f64 = 1.0 / (1u64 << 36) as f64;

/// 2^-28: a slope that the place cannot hide.
const STEEP: f64 = 1.0 / (1u64 << 28) as f64;

/// `2^-106`.
const H: f64 = U * U;

/// The contact, if any, given that they are apart up to a time shortly before it.
///
/// # Proof
///
/// Let `w` be the difference at the place that is nearest at `t`, `w'` its velocity, both with the
/// place kept, `x = w^2 - R^2` at `t` and `p(s) = x + 2 s w . w' + s^2 w'^2`, so that the place is
/// at the radius where `p` is 0. For `0 <= s <= T` the squared distance of the two sides, less
/// `R^2`, is between `p - e` and `p`, with `e` the excess of [`nearness`](Moving::nearness). If
/// `p' <= -2 m < 0` up to `T`, and its root `r` is there, then the time of impact is between
/// `t + r - e / 2 m` and `t + r`, and there is no contact before.
///
/// Where an `f64` may be the time of impact itself, integers compare the distance there with the
/// radius. It is the only `f64` near, and the distance falls at it: half the slope of its square is
/// `-w . w'` at the nearest place, which is within 2^-32 of the kept one, so that `w` is within
/// `2^-32 s` and `w'` within `2^-31 s` of theirs, and half the slope within `2^-30 s . s` of what
/// `m` bounds. (Places that are no single one differ by a vector that `w` is perpendicular to, but
/// for `2^-32 s`; their velocities do not differ along `w`, as the sides stay parallel.)
///
/// # Error bounds
///
/// With `s` the sum of the larger magnitudes of `K`, `L` and `M`: components of `w` and `w'` are
/// within `12 u s` of the exact ones, and at most `s` and `2 s` in magnitude: `w . w'` is within
/// `64 u s . s`, and so is half of `w'^2`. With `q = x / 2 m` and `b = q w'^2 / 2 m`, now
/// `m = -w . w'`, the root is `q (1 + b)` up to `3 b^2 q`, for `b < 1/16`. That is computed with
/// the relative errors of `m` in `q`, once more in `b`, and fewer than 16 roundings; the error of
/// `x` counts by `1 / 2 m`.
pub(super) fn refine_toi<K: Stages>(
    positions: &Positions,
    moving: &Moving<f64x2>,
    radius: Radius,
    proved: f64,
) -> Finding<RefinedToi> {
    let (_, size) = moving.reaches();
    let size2 = dot(&size, &size);
    let slope_error = 64.0 * U * size2;
    let mut t = proved;
    // Ends: after so many corrections.
    for _ in 0..MOST_STEPS {
        let here = Instant::new::<K, _>(moving, t);
        let velocity = here.velocity();
        let (x, x_error) = excess::<K>(positions, radius, t, &here.spot, &size);
        let slope = -dot(&here.difference, &velocity);
        let first = x / (2.0 * slope);
        let bend = first * dot(&velocity, &velocity) / (2.0 * slope);
        let delta = first * (1.0 + bend);
        let while_ = 2.0 * delta + 8.0 * U;
        // The velocity is at most twice the size.
        let least = slope - slope_error - 4.5 * size2 * while_;
        // The root is ahead, so that `least` is below the slope. Where rounding outweighs the slope
        // it may have any sign.
        if !(x > 0.0 && slope > 0.0 && least > 0.0 && bend < 0.0625) {
            return Finding::Undecided;
        }
        let nearness = moving.nearness::<K>(&here, while_);
        let nearness = nearness.or_else(|| {
            let nearness = moving.nearness_of_parallel::<K>(&here, while_)?;
            K::are_always_parallel(positions).then_some(nearness)
        });
        let Some(nearness) = nearness else {
            return Finding::Undecided;
        };
        let error = (nearness.excess + x_error) / (2.0 * least) * (1.0 + 8.0 * U)
            + delta * (4.0 * (slope_error / least) + 3.0 * bend * bend + 16.0 * U);
        if !(error < delta + 8.0 * U) {
            return Finding::Undecided;
        }
        let root = Root::near(two_sum(t, delta), error);
        let refined = |toi| RefinedToi::new(toi, here.spot, &nearness);
        if let Some(below) = root.round_down() {
            if let Some(refined) = refined([below, below.next_up()]) {
                return Finding::Hit(refined);
            }
        } else if least > STEEP * size2
            && while_ < SHORT
            && nearness.error <= PLACE_ERROR / 4.0
            && let Some(at) = root.near_f64()
        {
            return match K::compare_distance(positions, radius, at) {
                Ordering::Less => Finding::of_certain(refined([at.next_down(), at])),
                Ordering::Equal => Finding::of_certain(refined([at; 2])),
                Ordering::Greater if at == 1.0 => Finding::Miss,
                Ordering::Greater => Finding::of_certain(refined([at, at.next_up()])),
            };
        }
        // They are apart until then.
        let next = (t + (delta - error)) * (1.0 - 2.0 * U);
        if next >= 1.0 {
            return Finding::Miss;
        }
        if !(next > t) {
            return Finding::Undecided;
        }
        t = next;
    }
    Finding::Undecided
}

/// The squared distance less `R^2` of the points of a place at a time, in double-double arithmetic,
/// and a bound on its error but for the rounding to `f64`.
///
/// Error bound, with `h = 2^-106` and `s` the sum of the larger magnitudes at both ends: the
/// differences are exact, their products with `u` and `v` add `16 h s`, two sums `16 h s`: below
/// `32 h s` at each end of the step. The change is within `(64 + 24) h s`, the product with the
/// time adds `16 h s`, the sum `24 h s`: below `160 h s`. So `w^2` is off by `320 h |w| s` and the
/// square of that error; products, sums and the radius add `64 h` of both sides. What underflows is
/// far below that of the radius.
fn excess<K: Stages>(
    positions: &Positions,
    radius: Radius,
    t: f64,
    spot: &Spot,
    size: &Vector,
) -> (f64, f64) {
    let points = positions.points::<f64x2>();
    let number = |x: f64| Double {
        high: f64x2::both(x),
        low: f64x2::both(0.0),
    };
    let (u, v, time) = (number(spot.u), number(spot.v), number(t));
    // At both ends of the step.
    let axis = |i: usize| {
        let difference =
            |(from, to): (usize, usize)| two_difference(points[to][i], points[from][i]);
        let [k, l, m] = K::DIFFERENCES;
        let (k, l, m) = (difference(k), difference(l), difference(m));
        m.add(v.mul(l)).sub(u.mul(k))
    };
    let (x, y, z) = (axis(0), axis(1), axis(2));
    let at_time = |[start, end]: [Double<f64x2>; 2]| start.add(end.sub(start).mul(time));
    let (xy, zz) = (at_time(x.transposed(y)), at_time(z.transposed(z)));
    let [first, second] = radius.parts();
    let [zr, _] = zz.transposed(Double::both(two_sum(first, second)));
    let ([x2, y2], [z2, r2]) = (xy.mul(xy).lanes(), zr.mul(zr).lanes());
    let value = x2.add(y2).add(z2).sub(r2).value();
    let difference = [
        xy.high.start().abs(),
        xy.high.end().abs(),
        zz.high.start().abs(),
    ];
    let total = 160.0 * H * (size[0] + size[1] + size[2]);
    let error = 330.0 * H * dot(&difference, size)
        + total * total
        + 64.0 * H * (x2.high + y2.high + z2.high + r2.high);
    (value, error)
}

#[cfg(test)]
mod tests;

//! The time of impact to its last bit.
//!
//! Shortly before it the squared distance of the points that are nearest then is computed in
//! double-double arithmetic. With these points kept it is a polynomial of degree 2 in time, above
//! the squared distance of the two sides, and so little above it ([`nearness`](super::nearness))
//! that its root is the time of impact up to far below the last bit.

use std::cmp::Ordering;

use wide::f64x2;

use super::LARGEST;
use super::advance::Moving;
use super::doubled::excess;
use super::instant::Instant;
use super::nearness::Nearness;
use crate::certified::double::two_sum;
use crate::certified::ends::Ends;
use crate::certified::kind::Stages;
use crate::certified::motion::{Positions, dot};
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
/// radius. It is the only `f64` near, and the distance falls at it: half the rate at which its square
/// falls is `-w . w'` at the nearest place, which is within 2^-32 of the kept one, so that `w` is within
/// `2^-32 s` and `w'` within `2^-31 s` of theirs, and half the rate within `2^-30 s . s` of what
/// `m` bounds, which is above `2^-28 s . s`.
///
/// Edges that stay parallel, `L = l K`, may be nearest in many places, and then that of the kept
/// place is not near. But all have one vector `v`: a convex set has one point that is nearest to 0.
/// `|w - v|^2` is at most the excess, which is below `2^-55 m`, else the time would not be as certain;
/// so `w` differs by less than `2^-27.5 sqrt(m)`, and with `s < 2^14 sqrt(m)` that changes the rate
/// by less than `2^-12 m`. The velocities of two places differ by a multiple of `K`, which `v` is
/// across, and by `r K'`. The kept place is that at an end or across the edges up to the rounding of
/// a slope, so that `r` is below `2^-7 m / (k s)` with the size `k` of the edges, and `v . r K'` below
/// `2^-6 m`.
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
    let mut t = proved;
    // Ends: after so many corrections.
    for _ in 0..MOST_STEPS {
        let query = Query {
            positions,
            moving,
            radius,
            t,
        };
        let here = Instant::new::<K, _>(moving, t);
        let mut next = query.correct::<K>(&here, |while_| query.nearness::<K>(&here, while_));
        if let Correction::Uncertain = next {
            next = query.correct_at_boundary::<K>(&here);
        }
        match next {
            Correction::Decided(finding) => return finding,
            Correction::ApartUntil(next) => t = next,
            Correction::Uncertain => return Finding::Undecided,
        }
    }
    Finding::Undecided
}

/// The error of `w . w'`, from the square of the sum of the sizes.
#[inline(always)]
fn slope_error(size2: f64) -> f64 {
    64.0 * U * size2
}

/// A query that is apart up to a time.
struct Query<'a> {
    positions: &'a Positions,
    moving: &'a Moving<f64x2>,
    radius: Radius,
    t: f64,
}

/// The distance at a place at a time, and how fast that falls: Newton's method, with the proof of
/// [`refine_toi`].
pub(super) struct Approach {
    t: f64,
    /// About how long after the time the place is at the radius.
    delta: f64,
    /// How long what follows holds.
    pub(super) while_: f64,
    /// Half the slope of the squared distance, at least, all the while.
    least: f64,
    bend: f64,
    x_error: f64,
    slope_error: f64,
    /// The square of the sum of the sizes.
    size2: f64,
    /// Whether it falls, to the radius, all the while.
    pub(super) is_ahead: bool,
    /// Whether the place is certainly within the radius.
    pub(super) is_within: bool,
}

impl Approach {
    #[inline(always)]
    pub(super) fn new<K: Stages, E: Ends>(
        points: &[[E; 3]; 4],
        moving: &Moving<E>,
        radii: [f64; 2],
        here: &Instant,
        t: f64,
    ) -> Self {
        let (_, size) = moving.reaches();
        let size2 = dot(&size, &size);
        let slope_error = slope_error(size2);
        let velocity = here.velocity();
        let (x, x_error) = excess::<K, E>(points, radii, t, &here.spot, &size);
        let slope = -dot(&here.difference, &velocity);
        let first = x / (2.0 * slope);
        let bend = first * dot(&velocity, &velocity) / (2.0 * slope);
        let delta = first * (1.0 + bend);
        let while_ = 2.0 * delta + 8.0 * U;
        // The velocity is at most twice the size.
        let least = slope - slope_error - 4.5 * size2 * while_;
        Approach {
            t,
            delta,
            while_,
            least,
            bend,
            x_error,
            slope_error,
            size2,
            // The root is ahead, so that `least` is below the slope. Where rounding outweighs the slope
            // it may have any sign.
            is_within: x * (1.0 - 2.0 * U) < -x_error,
            is_ahead: (x > 0.0) & (slope > 0.0) & (least > 0.0) & (bend < 0.0625),
        }
    }

    /// Whether all differences are below 2^179.
    #[inline(always)]
    pub(super) fn is_small(&self) -> bool {
        self.size2 < 0.25 * LARGEST * LARGEST
    }

    /// The time of impact, and whether it is not before the time by more than rounding.
    #[inline(always)]
    pub(super) fn root(&self, nearness: &Nearness) -> (Root, bool) {
        let &Approach {
            delta, least, bend, ..
        } = self;
        let error = (nearness.excess + self.x_error) / (2.0 * least) * (1.0 + 8.0 * U)
            + delta * (4.0 * (self.slope_error / least) + 3.0 * bend * bend + 16.0 * U);
        let root = Root::near(two_sum(self.t, delta), error);
        (root, error < delta + 8.0 * U)
    }
}

/// What is known after one more correction of the time.
enum Correction {
    Decided(Finding<RefinedToi>),
    /// They are apart up to this later time.
    ApartUntil(f64),
    Uncertain,
}

impl Query<'_> {
    /// What is certain about the nearest place from the time on.
    #[inline(always)]
    fn nearness<K: Stages>(&self, here: &Instant, while_: f64) -> Option<Nearness> {
        self.moving.nearness::<K>(here, while_).or_else(|| {
            let nearness = self.moving.nearness_of_parallel::<K>(here, while_)?;
            K::are_always_parallel(self.positions).then_some(nearness)
        })
    }

    /// A correction where `f64` cannot tell: of edges that are nearly parallel, or that do not come
    /// nearer.
    #[inline(never)]
    fn correct_at_boundary<K: Stages>(&self, here: &Instant) -> Correction {
        let &Query {
            positions,
            moving,
            radius,
            t,
        } = self;
        let stays_apart =
            |here: &Instant| moving.stays_apart_sharply::<K>(positions, radius, here, t);
        if stays_apart(here) {
            return Correction::Decided(Finding::Miss);
        }
        for spot in K::nearest_on_sides(&here.gram) {
            let here = here.at_spot(spot);
            let next = self.correct::<K>(&here, |while_| {
                moving.nearness_at_boundary::<K>(positions, &here, t, while_)
            });
            match next {
                Correction::Uncertain if stays_apart(&here) => {
                    return Correction::Decided(Finding::Miss);
                }
                Correction::Uncertain => {}
                next => return next,
            }
        }
        Correction::Uncertain
    }

    /// One correction of the time, from the distance at a place and how near it is to the nearest
    /// one; the proof is that of [`refine_toi`].
    #[inline(always)]
    fn correct<K: Stages>(
        &self,
        here: &Instant,
        nearness: impl FnOnce(f64) -> Option<Nearness>,
    ) -> Correction {
        let &Query {
            positions,
            moving,
            radius,
            t,
        } = self;
        let points = positions.points::<f64x2>();
        let approach = Approach::new::<K, _>(&points, moving, radius.parts(), here, t);
        if !approach.is_ahead {
            return Correction::Uncertain;
        }
        let Some(nearness) = nearness(approach.while_) else {
            return Correction::Uncertain;
        };
        let (root, is_ahead) = approach.root(&nearness);
        if !is_ahead {
            return Correction::Uncertain;
        }
        let Approach { least, size2, .. } = approach;
        let refined = |toi| RefinedToi::new(toi, here.spot, &nearness);
        if let Some(below) = root.round_down() {
            if let Some(refined) = refined([below, below.next_up()]) {
                return Correction::Decided(Finding::Hit(refined));
            }
        } else if least > STEEP * size2
            && approach.while_ < SHORT
            && nearness.error <= PLACE_ERROR / 4.0
            && let Some(at) = root.near_f64()
        {
            return Correction::Decided(match K::compare_distance(positions, radius, at) {
                Ordering::Less => Finding::of_certain(refined([at.next_down(), at])),
                Ordering::Equal => Finding::of_certain(refined([at; 2])),
                Ordering::Greater if at == 1.0 => Finding::Miss,
                Ordering::Greater => Finding::of_certain(refined([at, at.next_up()])),
            });
        }
        // They are apart until then.
        let next = (t + (approach.delta - root.error())) * (1.0 - 2.0 * U);
        if next >= 1.0 {
            Correction::Decided(Finding::Miss)
        } else if next > t {
            Correction::ApartUntil(next)
        } else {
            Correction::Uncertain
        }
    }
}

//! Bodies that turn: an edge or a vertex, of space or of another body, against a body's edge or face,
//! certified.
//!
//! The path for linear motion is the filter. On a part of the step each point of a body stays
//! near its chord, the linear motion between its places at both ends: let `rho` bound how far it
//! strays, or the sum of both bounds if both sides turn. If the two sides of the linear query of these places are farther apart than `rho` for
//! the whole part, then the turning ones do not touch in it: a point of either side is a mean of its
//! corners, with the same weights in both motions, so that no difference of two points is off by
//! more than `rho`. With a radius `R` they are asked to stay farther apart than `R + rho`. A part of
//! half the length has a quarter of the stray. Ordinary contacts are certified from there
//! ([`contact`]), and what stays open is decided in integers (`exact::rigid`), so that no answer
//! depends on `rho` being small.
//!
//! # The stray
//!
//! `q(t)` stays in a plane, and its angle there has the velocity `W / D`, `W = |q0 ^ q1|` and
//! `D = |q|^2`. The body turns by twice that angle about a fixed axis. So a point at the distance
//! `p` from the centre has an acceleration, the centre's being 0, of at most
//!
//! ```text
//! p (w^2 + |w'|)  with  w = 2 W / D,  |w'| = 2 W |D'| / D^2 <= (W^2 + |D'|^2) / D^2
//! ```
//!
//! and strays from the chord of a part of the length `h` by at most `h^2 / 8` times that. Here
//! `W <= |q0| |q1 - q0|`, likewise with `q1`; `D'` is linear in `t`, so that it is largest at an
//! end; and `D >= min(D0, D1) (1 + cos) / 2`, with the angle between `q0` and `q1`: both ends, and so
//! all between them, are beyond the plane that is across the middle of that angle at this distance.
//! The cosine, which is above 0, is at least `q0 . q1 / max(D0, D1)`.
//!
//! # Rounding
//!
//! With `u = 2^-53`: `q0` and `q1` are at 45 degrees or less, so that `(1 - t) |q0| + t |q1|` is at
//! most `1.09 |q(t)|`. So `q(t)` is computed with an error below `5 u |q|`, which turns a point
//! by less than `10 u p`. [`turned`] adds a vector made of products whose magnitudes add up to at
//! most `3.1 p`, each with fewer than 24 roundings: less than `75 u p`. The centre and the points in space have less than
//! `8 u` times their largest coordinate, and the sum less than `2 u` of both. So a side is off by less
//! than `10 u` times its largest coordinates and `87 u p`. [`ROUNDING`] is `256 u`, times the largest
//! coordinates of both sides and the sum of both `p`. Bounds themselves are computed with a few roundings, which [`UP`]
//! outweighs.

mod ball;
mod contact;
mod differences;
mod features;
mod guess;
mod kind;
mod normal;
mod place;
mod root;
mod rough;
mod series;
mod term;
mod turning;

use wide::f64x2;

use super::ends::{Ends, larger};
use super::exact::Passage;
use super::kind::Stages;
use super::motion::{Vector, largest};
use super::stage::Finding;
use super::thick;
use crate::contact::Hit;
use crate::query::{Point, Radius};
use contact::{APART, CROSSING, touch};
pub use kind::{RigidKind, decide_rigid, decide_rigid_exactly};
pub(super) use turning::{Body, First, Turning};

impl<const FIRST: usize, const SECOND: usize> Turning<'_, FIRST, SECOND> {
    /// The answer as far as `f64` and double-double arithmetic prove it.
    fn decide<K: Stages>(&self, passage: impl FnOnce() -> Passage) -> Finding<Hit<K::Place>> {
        let Some(moving) = Moving::new(self) else {
            return Finding::Undecided;
        };
        let proved = moving.apart_until::<K>(0.0);
        if proved == 1.0 {
            return Finding::Miss;
        }
        Finding::of_certain(self.contact::<K>(&moving, proved, passage))
    }

    /// The contact of what is apart up to a time.
    #[inline(never)]
    fn contact<K: Stages>(
        &self,
        moving: &Moving<FIRST, SECOND>,
        proved: f64,
        passage: impl FnOnce() -> Passage,
    ) -> Option<Hit<K::Place>> {
        let touch = touch::<K, FIRST, SECOND>(self, moving, proved)?;
        let passage = match self.radius.is_zero() {
            true => CROSSING,
            false => self.passage::<K>(proved).unwrap_or_else(passage),
        };
        Some(touch.hit::<K>(passage))
    }

    /// What the midlines do, if that is certain, where `f` is not identically 0.
    fn passage<K: Stages>(&self, proved: f64) -> Option<Passage> {
        let midlines = Turning {
            radius: Radius::ZERO,
            ..*self
        };
        let moving = Moving::new(&midlines)?;
        let proved = moving.apart_until::<K>(proved);
        if proved == 1.0 {
            return Some(APART);
        }
        touch::<K, FIRST, SECOND>(&midlines, &moving, proved).map(|_| CROSSING)
    }
}

/// `256 u`.
const ROUNDING: f64 = f64::from_bits((1023 - 45) << 52);

/// More than the roundings of a bound.
const UP: f64 = 1.0 + f64::from_bits((1023 - 40) << 52);

/// What underflow adds to a distance, and more: 2^-500. The square of a length that underflows is
/// off by less than 2^-1072, and the length by less than 2^-536.
const LEAST: f64 = f64::from_bits((1023 - 500) << 52);

/// 2^160: below it no product over- nor underflows in a way that matters.
const LARGEST: f64 = f64::from_bits((1023 + 160) << 52);

/// A step whose bound is above this share of the reach is halved at first.
const FAR: f64 = 0.0625;

/// The shortest part of the step that is looked at before integers decide, and the most parts.
const SHORTEST: f64 = 1.0 / 256.0;

/// 2^-40: parts that are cut off at the end of the step may be as short. An eighth of a thousandth of
/// it is above 2^-53, and a time is off by half as much.
const LEAST_PART: f64 = 1.0 / (1u64 << 40) as f64;
const MOST_PARTS: u32 = 24;

/// A query in `f64`, of numbers of ordinary size.
struct Moving<'a, const FIRST: usize, const SECOND: usize> {
    first: MovingFirst<'a, FIRST>,
    second: MovingBody<'a, SECOND>,
    /// The radius and what rounding adds to the stray.
    rest: f64,
}

/// The first side.
enum MovingFirst<'a, const N: usize> {
    Straight {
        start: &'a [Point; N],
        end: &'a [Point; N],
    },
    Turning(MovingBody<'a, N>),
}

/// Points of a body.
struct MovingBody<'a, const N: usize> {
    local: &'a [Point; N],
    centres: [Vector; 2],
    quaternions: [[f64; 4]; 2],
    /// At most this, times the square of its length, is the stray of a part.
    bend: f64,
    /// How far from the centre the points are at most: none strays by more than twice that, as it
    /// and its chord stay within it.
    reach: f64,
}

impl<'a, const FIRST: usize, const SECOND: usize> Moving<'a, FIRST, SECOND> {
    /// `None` where squares could over- or underflow.
    fn new(query: &Turning<'a, FIRST, SECOND>) -> Option<Self> {
        let first = MovingFirst::new(&query.first)?;
        let second = MovingBody::new(&query.second)?;
        let far = larger(first.far(), second.far());
        let reach = first.body().map_or(0.0, |body| body.reach) + second.reach;
        // Not below the sum of both numbers.
        let radius = query.radius.rounded() * UP;
        let is_ordinary = far < LARGEST && reach < LARGEST && radius < LARGEST;
        is_ordinary.then_some(Moving {
            first,
            second,
            rest: radius + ROUNDING * (far + reach) + LEAST,
        })
    }

    /// Up to when the two sides are certainly apart, if they are up to some time: 1 for the whole
    /// step.
    #[inline(always)]
    fn apart_until<K: Stages>(&self, mut from: f64) -> f64 {
        let mut length = if self.is_far() { 0.5 } else { 1.0 };
        // Ends: after so many parts.
        for _ in 0..MOST_PARTS {
            let to = f64::min(from + length, 1.0);
            let stray = self.stray(to - from);
            let part = self.places::<f64x2>(Ends::new(from, to));
            let until = thick::apart_until::<K>(&part, Radius::from((stray + self.rest) * UP));
            if until >= 1.0 {
                if to == 1.0 {
                    return 1.0;
                }
                (from, length) = (to, 2.0 * length);
                continue;
            }
            // What is taken off below outweighs the roundings: a part is as long as that.
            if to - from < LEAST_PART {
                break;
            }
            if until > 0.125 {
                from += 0.999 * until * (to - from);
            }
            length *= 0.25;
            if length < SHORTEST {
                break;
            }
        }
        from
    }

    /// Whether a body's points stray by more than [`FAR`].
    #[inline(always)]
    fn is_far(&self) -> bool {
        self.second.is_far() || self.first.body().is_some_and(MovingBody::is_far)
    }

    /// A bound on how far the difference of two points strays in a part of this length.
    #[inline(always)]
    fn stray(&self, length: f64) -> f64 {
        let of_first = self.first.body().map_or(0.0, |body| body.stray(length));
        of_first + self.second.stray(length)
    }

    /// The places of all points at two times.
    #[inline(always)]
    fn places<E: Ends>(&self, t: E) -> [[E; 3]; 4] {
        let first = match &self.first {
            MovingFirst::Straight { start, end } => std::array::from_fn(|i| {
                std::array::from_fn(|axis| between(t, start[i][axis], end[i][axis]))
            }),
            MovingFirst::Turning(body) => body.places(t),
        };
        let second = self.second.places(t);
        std::array::from_fn(|i| match i < FIRST {
            true => first[i],
            false => second[i - FIRST],
        })
    }
}

impl<'a, const N: usize> MovingFirst<'a, N> {
    fn new(first: &First<'a, N>) -> Option<Self> {
        Some(match first {
            First::Straight { start, end } => MovingFirst::Straight { start, end },
            First::Turning(body) => MovingFirst::Turning(MovingBody::new(body)?),
        })
    }

    fn body(&self) -> Option<&MovingBody<'a, N>> {
        match self {
            MovingFirst::Straight { .. } => None,
            MovingFirst::Turning(body) => Some(body),
        }
    }

    /// The largest coordinate of a point, or of a body's centre.
    fn far(&self) -> f64 {
        match self {
            MovingFirst::Straight { start, end } => {
                let points = start.iter().chain(*end);
                points.fold(0.0, |far, point| {
                    larger(far, largest(&plain(point).map(f64::abs)))
                })
            }
            MovingFirst::Turning(body) => body.far(),
        }
    }
}

impl<'a, const N: usize> MovingBody<'a, N> {
    /// `None` where squares of its quaternions could over- or underflow.
    fn new(&Body { local, motion }: &Body<'a, N>) -> Option<Self> {
        let quaternions = motion.quaternions();
        let reach = local.iter().map(|p| p.coords.norm_squared());
        let reach = reach.fold(0.0, larger).sqrt() * UP + LEAST;
        Some(MovingBody {
            local,
            centres: [motion.start(), motion.end()].map(|pose| plain(&pose.centre)),
            bend: bend(&quaternions)? * reach,
            quaternions,
            reach,
        })
    }

    /// The largest coordinate of its centre.
    fn far(&self) -> f64 {
        let [c0, c1] = self
            .centres
            .each_ref()
            .map(|centre| largest(&centre.map(f64::abs)));
        larger(c0, c1)
    }

    fn is_far(&self) -> bool {
        self.bend > FAR * self.reach
    }

    /// A bound on how far its points stray in a part of this length.
    #[inline(always)]
    fn stray(&self, length: f64) -> f64 {
        f64::min(self.bend * length * length, 2.0 * self.reach)
    }

    /// The places of its points at two times.
    #[inline(always)]
    fn places<E: Ends>(&self, t: E) -> [[E; 3]; N] {
        let [c0, c1] = &self.centres;
        let [q0, q1] = &self.quaternions;
        let q: [E; 4] = std::array::from_fn(|i| between(t, q0[i], q1[i]));
        let square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        let factor = E::new(2.0 / square.start(), 2.0 / square.end());
        std::array::from_fn(|i| {
            let turned = turned(&q, factor, &self.local[i]);
            std::array::from_fn(|axis| between(t, c0[axis], c1[axis]) + turned[axis])
        })
    }
}

/// What moves from one number to another, at two times.
#[inline(always)]
fn between<E: Ends>(t: E, from: f64, to: f64) -> E {
    (E::both(1.0) - t) * E::both(from) + t * E::both(to)
}

#[inline(always)]
fn plain(p: &Point) -> Vector {
    [p.x, p.y, p.z]
}

/// `p + 2 (w (v x p) + v x (v x p)) / D`, with `factor` for `2 / D`.
#[inline(always)]
fn turned<E: Ends>(&[w, x, y, z]: &[E; 4], factor: E, p: &Point) -> [E; 3] {
    let cross = |p: &[E; 3]| {
        [
            y * p[2] - z * p[1],
            z * p[0] - x * p[2],
            x * p[1] - y * p[0],
        ]
    };
    let p = [E::both(p.x), E::both(p.y), E::both(p.z)];
    let once = cross(&p);
    let twice = cross(&once);
    std::array::from_fn(|i| p[i] + factor * (w * once[i] + twice[i]))
}

/// A bound on `(w^2 + |w'|) / 8`; `None` where squares could over- or underflow.
#[inline(always)]
fn bend([q0, q1]: &[[f64; 4]; 2]) -> Option<f64> {
    let product =
        |x: &[f64; 4], y: &[f64; 4]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + x[3] * y[3];
    let change: [f64; 4] = std::array::from_fn(|i| q1[i] - q0[i]);
    let (d0, d1, along) = (product(q0, q0), product(q1, q1), product(q0, q1));
    let is_ordinary = |d: f64| d > 1.0 / LARGEST && d < LARGEST;
    if !(is_ordinary(d0) && is_ordinary(d1)) {
        return None;
    }
    // Not above the cosine, as along is not below 0.
    let cosine = along / d0.max(d1);
    let smaller = d0.min(d1);
    let least = smaller * (1.0 + cosine) * 0.5;
    // W^2, and |D'|, which is twice the product of q with q', at the ends.
    let turn = smaller * product(&change, &change);
    let slope = 2.0 * f64::max(product(q0, &change).abs(), product(q1, &change).abs());
    let slope = slope + ROUNDING * (d0 + d1);
    // 2 W |D'| is at most W^2 + |D'|^2.
    Some((5.0 * turn + slope * slope) / (8.0 * least * least) * UP)
}

#[cfg(test)]
mod tests;

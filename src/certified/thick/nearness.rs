//! How far the nearest place can be from where it was shortly before.
//!
//! With `w` the difference at a place, the squared distance from it along its directions `V1` and
//! `V2` is `w^2 + 2 g . s + s . Q s` with `g = (V1 . w, V2 . w)` and the Gram matrix `Q` of the
//! directions. At the nearest place `g` is 0, or leads away from 0 along a direction that is not
//! free.

use super::advance::{LARGEST, Moving, SMALLEST};
use super::instant::Instant;
use crate::certified::cubic::permanents;
use crate::certified::ends::Ends;
use crate::certified::kind::Stages;
use crate::certified::motion::{Motion, Vector, add, cross, dot, reach, scaled};
use crate::certified::nearest::Direction;
use crate::certified::separate::U;

/// What is certain about a place from a time on, for a while.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearness {
    /// The squared distance is below that of the place by no more than this.
    pub(super) excess: f64,
    /// `u` and `v` of the nearest place, which is a single one but for directions of no length,
    /// differ by no more than this.
    pub(super) error: f64,
    /// Whether the two are parallel: then nothing is said of the place.
    pub(super) is_parallel: bool,
}

/// The slopes along both directions.
struct Slopes {
    slopes: [Slope; 2],
    is_uphill: [bool; 2],
    along: [Vector; 2],
    reaches: [Vector; 2],
}

/// `g`, a bound on its error, and bounds on the length, of one direction.
#[derive(Clone, Copy)]
struct Slope {
    value: f64,
    error: f64,
    least: f64,
    most: f64,
}

impl Slope {
    /// Whether it is certainly farther in that direction.
    fn is_uphill(&self, direction: &Direction) -> bool {
        !direction.is_free && self.value > self.error
    }

    fn size(&self) -> f64 {
        self.value.abs() + self.error
    }
}

impl<E: Ends> Moving<E> {
    /// The larger magnitudes at both ends of `K`, `L` and `M`, and their sum.
    pub(super) fn reaches(&self) -> ([Vector; 2], Vector) {
        let Motion { k, l, m } = &self.motion;
        let (k, l, m) = (reach(k), reach(l), reach(m));
        ([k, l], add(&add(&k, &l), &m))
    }

    /// What is certain about the nearest place at a time, up to a time at most `while_` later.
    /// `None` unless `N = K x L` is certainly not 0 all the while, or a direction is 0 throughout the
    /// step: then it has no part in the difference.
    ///
    /// # Proof
    ///
    /// The set is convex and in that which the directions span. Let `s` be the nearest place.
    ///
    /// - Both `g` are above 0 and their directions not free: the product of `g` and `s` is at least
    ///   0, so it is not nearer anywhere, and as near only where `s` is 0.
    /// - One is, `g2`, with `m = g2 - |V1 . V2| |g1| / V1^2 > 0`. With `e = s1 + s2 V1 . V2 / V1^2`
    ///   the squared distance grows by at least `V1^2 e^2 - 2 |g1 e| + 2 m s2`: it falls by at most
    ///   `g1^2 / V1^2`. At the nearest place its gradient leads away from 0, so that
    ///   `V1^2 e^2 + m s2 <= |g1 e|`: `|e| <= |g1| / V1^2` and `s2 <= g1^2 / 4 V1^2 m`.
    /// - Else it falls by no more than where no boundary is in the way, by `g . Q^-1 g`, at most
    ///   `(|g1| |V2| + |g2| |V1|)^2 / N^2`. To go to the nearest point of a convex set makes no
    ///   distance larger, in the norm of `Q`: `s . Q s` is at most that too, and
    ///   `|s1| <= |V2| / |N|` times its root, `|s2|` likewise.
    ///
    /// Along one direction alone it falls by at most `g^2 / V^2`, at most `|g| / V^2` away.
    ///
    /// # Error bounds
    ///
    /// With the larger magnitudes `v` of a direction at both ends, their sum `s` for `K`, `L` and
    /// `M`, and the while `T < 1/8`: a component of a direction is within `6 u v` of the exact one
    /// and changes by up to `2 T v`, one of the difference is within `12 u s` and changes by
    /// `2 T s`. The product adds `3.1 u`: below `(32 u + 6 T) v . s`. Lengths are within
    /// `(8 u + 3 T) |v|` and `8 u` of themselves; `N`, up to its sign the product of the
    /// directions, within `(16 u + 5 T)` of the permanents of their `v`. Everything here passes
    /// fewer than 30 roundings.
    ///
    /// What underflows: a component of a direction or of the difference is off by less than
    /// `2^-1071`, and as the size of the boxes is below `2^180`, a product of the two by less than
    /// `2^-885`: `TINY` is more. A length is off by less than `2^-536`, which is nothing beside
    /// [`SHORTEST`]: a shorter one is not used. Slopes are not below `32 u` of the directions'
    /// squares, so that quotients by these are not below `32 u`.
    pub(super) fn nearness<K: Stages>(&self, here: &Instant, while_: f64) -> Option<Nearness> {
        let Slopes {
            slopes: [first, second],
            is_uphill,
            along,
            reaches,
        } = self.slopes(here, while_)?;
        // Of a face with corners in one place, which weights are meant is for integers to say.
        let is_point = reaches.map(|reach| reach == [0.0; 3] && K::FIRST == 2);
        let (excess, error) = match is_point {
            [true, true] => (0.0, 0.0),
            [true, false] => alone(second, is_uphill[1])?,
            [false, true] => alone(first, is_uphill[0])?,
            [false, false] => {
                let normal = least_normal(&along, &reaches, while_)?;
                let held = match is_uphill {
                    [true, true] => Some((0.0, 0.0)),
                    [false, true] => beside(first, second),
                    [true, false] => beside(second, first),
                    [false, false] => None,
                };
                held.or_else(|| inside(first, second, normal))?
            }
        };
        Some(Nearness {
            excess: excess * (1.0 + 64.0 * U),
            error: error * (1.0 + 64.0 * U),
            is_parallel: false,
        })
    }

    /// The same of two edges that are parallel and do not turn, of the squared distance alone: the
    /// place is not a single one.
    ///
    /// # Proof
    ///
    /// The set is part of a line along `V1`, which is not 0. Along the whole line the squared
    /// distance falls by at most `g1^2 / V1^2`. Where both `g` are above 0 and their directions not
    /// free it does not fall.
    pub(super) fn nearness_of_parallel<K: Stages>(
        &self,
        here: &Instant,
        while_: f64,
    ) -> Option<Nearness> {
        let Slopes {
            slopes: [first, _],
            is_uphill,
            ..
        } = self.slopes(here, while_)?;
        let (excess, _) = alone(first, is_uphill == [true; 2])?;
        Some(Nearness {
            excess: excess * (1.0 + 64.0 * U),
            error: 0.0,
            is_parallel: true,
        })
    }

    /// The slopes along both directions from a time on, for a while; and their vectors with the
    /// larger magnitudes of these at both ends of the step.
    #[inline(always)]
    fn slopes(&self, here: &Instant, while_: f64) -> Option<Slopes> {
        let ([k, l], size) = self.reaches();
        let directions = here.spot.directions;
        let along = here.along();
        let reach = |direction: &Direction| {
            add(
                &scaled(direction.u.abs(), &k),
                &scaled(direction.v.abs(), &l),
            )
        };
        let reaches = [reach(&directions[0]), reach(&directions[1])];
        let slope = |i: usize| {
            let (vector, most) = (&along[i], &reaches[i]);
            let length = dot(vector, vector).sqrt();
            let error = (8.0 * U + 3.0 * while_) * dot(most, most).sqrt();
            Slope {
                value: dot(vector, &here.difference),
                error: (32.0 * U + 6.0 * while_) * dot(most, &size) * (1.0 + 8.0 * U) + TINY,
                least: length * (1.0 - 8.0 * U) - error * (1.0 + 8.0 * U),
                most: length * (1.0 + 8.0 * U) + error * (1.0 + 8.0 * U),
            }
        };
        let (first, second) = (slope(0), slope(1));
        if !((0.0..0.125).contains(&while_) && first.size() < LARGEST && second.size() < LARGEST) {
            return None;
        }
        Some(Slopes {
            slopes: [first, second],
            is_uphill: [
                first.is_uphill(&directions[0]),
                second.is_uphill(&directions[1]),
            ],
            along,
            reaches,
        })
    }
}

/// A length above 0 that the normal of two directions certainly has all the while.
fn least_normal(along: &[Vector; 2], reaches: &[Vector; 2], while_: f64) -> Option<f64> {
    let normal = cross(&along[0], &along[1]);
    let permanent: f64 = permanents(&reaches[0], &reaches[1]).iter().sum();
    let error = (16.0 * U + 5.0 * while_) * permanent * (1.0 + 8.0 * U);
    let square = dot(&normal, &normal);
    let least = square.sqrt() * (1.0 - 8.0 * U) - error;
    (square > SMALLEST && least > 0.0).then_some(least)
}

/// Bounds on the fall of the squared distance and on `|s|` along one direction.
fn alone(slope: Slope, is_uphill: bool) -> Option<(f64, f64)> {
    if is_uphill {
        return Some((0.0, 0.0));
    }
    let Slope { least, .. } = slope;
    let fall = (slope.size() / least) * (slope.size() / least);
    (least > SHORTEST).then(|| (fall, slope.size() / (least * least)))
}

/// Bounds on the fall of the squared distance and on `|s1| + |s2|`, where it is farther along the
/// second direction.
fn beside(first: Slope, second: Slope) -> Option<(f64, f64)> {
    let Slope { least, .. } = first;
    let turn = second.most / least;
    let rest = (second.value - second.error) - turn * first.size() * (1.0 + 8.0 * U);
    if !(least > SHORTEST && rest > 0.0) {
        return None;
    }
    let fall = (first.size() / least) * (first.size() / least);
    let second = fall / (4.0 * rest);
    let first = first.size() / (least * least) + turn * second;
    Some((fall, first + second))
}

/// The same where nothing is in the way, with a bound on `|N|`.
fn inside(first: Slope, second: Slope, normal: f64) -> Option<(f64, f64)> {
    let length = (first.size() * second.most + second.size() * first.most) / normal;
    let (fall, error) = (
        length * length,
        length * ((first.most + second.most) / normal),
    );
    (first.most > SHORTEST && second.most > SHORTEST).then_some((fall, error))
}

/// 2^-450: what is longer has a square that loses nothing to underflow.
pub(super) const SHORTEST: f64 = f64::from_bits((1023 - 450) << 52);

/// 2^-850: far above what underflow adds to a product of two vectors below 2^182 each.
pub(super) const TINY: f64 = f64::from_bits((1023 - 850) << 52);

#[cfg(test)]
mod tests;

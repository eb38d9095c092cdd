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

impl Direction {
    /// The larger magnitudes at both ends, from those of `K` and `L`.
    #[inline(always)]
    fn reach(&self, k: &Vector, l: &Vector) -> Vector {
        add(&scaled(self.u.abs(), k), &scaled(self.v.abs(), l))
    }
}

impl Slope {
    /// Along a direction that is at most so large.
    #[inline(always)]
    fn new(vector: &Vector, most: &Vector, here: &Instant, size: &Vector, while_: f64) -> Self {
        let length = dot(vector, vector).sqrt();
        let error = (8.0 * U + 3.0 * while_) * dot(most, most).sqrt();
        Slope {
            value: dot(vector, &here.difference),
            error: (32.0 * U + 6.0 * while_) * dot(most, size) * (1.0 + 8.0 * U) + TINY,
            least: length * (1.0 - 8.0 * U) - error * (1.0 + 8.0 * U),
            most: length * (1.0 + 8.0 * U) + error * (1.0 + 8.0 * U),
        }
    }

    /// Whether it is certainly farther in that direction.
    #[inline(always)]
    fn is_uphill(&self, direction: &Direction) -> bool {
        !direction.is_free & (self.value > self.error)
    }

    #[inline(always)]
    fn size(&self) -> f64 {
        self.value.abs() + self.error
    }

    /// This one, or else the other.
    #[inline(always)]
    fn or(self, is_this: bool, other: Self) -> Self {
        let of = |this: f64, other: f64| if is_this { this } else { other };
        Slope {
            value: of(self.value, other.value),
            error: of(self.error, other.error),
            least: of(self.least, other.least),
            most: of(self.most, other.most),
        }
    }
}

impl<E: Ends> Moving<E> {
    /// The larger magnitudes at both ends of `K`, `L` and `M`, and their sum.
    #[inline(always)]
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
        } = self.ordinary_slopes(here, while_)?;
        // Of a face with corners in one place, which weights are meant is for integers to say.
        let is_point = reaches.map(|reach| reach == [0.0; 3] && K::FIRST == 2);
        let (excess, error) = match is_point {
            [true, true] => (0.0, 0.0),
            [true, false] => alone(second, is_uphill[1])?,
            [false, true] => alone(first, is_uphill[0])?,
            [false, false] => {
                let (fall, error, is_certain) =
                    in_space(first, second, is_uphill, &along, &reaches, while_);
                is_certain.then_some((fall, error))?
            }
        };
        Some(Nearness {
            excess: excess * (1.0 + 64.0 * U),
            error: error * (1.0 + 64.0 * U),
            is_parallel: false,
        })
    }

    /// The same without a branch, and whether it is certain; not of edges that are points.
    #[inline(always)]
    pub(super) fn nearness_in_space(&self, here: &Instant, while_: f64) -> (Nearness, bool) {
        let (slopes, is_ordinary) = self.slopes(here, while_);
        let Slopes {
            slopes: [first, second],
            is_uphill,
            along,
            reaches,
        } = slopes;
        let is_zero = |[x, y, z]: &Vector| (*x == 0.0) & (*y == 0.0) & (*z == 0.0);
        let is_no_point = !(is_zero(&reaches[0]) | is_zero(&reaches[1]));
        let (fall, error, is_certain) =
            in_space(first, second, is_uphill, &along, &reaches, while_);
        let nearness = Nearness {
            excess: fall * (1.0 + 64.0 * U),
            error: error * (1.0 + 64.0 * U),
            is_parallel: false,
        };
        (nearness, is_certain & is_ordinary & is_no_point)
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
        } = self.ordinary_slopes(here, while_)?;
        let (excess, _) = alone(first, is_uphill == [true; 2])?;
        Some(Nearness {
            excess: excess * (1.0 + 64.0 * U),
            error: 0.0,
            is_parallel: true,
        })
    }

    /// The same as [`slopes`](Self::slopes), if they may be used.
    #[inline(always)]
    fn ordinary_slopes(&self, here: &Instant, while_: f64) -> Option<Slopes> {
        let (slopes, is_ordinary) = self.slopes(here, while_);
        is_ordinary.then_some(slopes)
    }

    /// The slopes along both directions from a time on, for a while; and their vectors with the
    /// larger magnitudes of these at both ends of the step. And whether the while is short, and none
    /// overflows.
    #[inline(always)]
    fn slopes(&self, here: &Instant, while_: f64) -> (Slopes, bool) {
        let ([k, l], size) = self.reaches();
        let [first_direction, second_direction] = here.spot.directions;
        let along = here.along();
        let reaches = [
            first_direction.reach(&k, &l),
            second_direction.reach(&k, &l),
        ];
        let slope = |vector, most| Slope::new(vector, most, here, &size, while_);
        let first = slope(&along[0], &reaches[0]);
        let second = slope(&along[1], &reaches[1]);
        #[allow(clippy::manual_range_contains, reason = "that has a branch")]
        let is_short = (while_ >= 0.0) & (while_ < 0.125);
        let is_ordinary = is_short & (first.size() < LARGEST) & (second.size() < LARGEST);
        let slopes = Slopes {
            slopes: [first, second],
            is_uphill: [
                first.is_uphill(&first_direction),
                second.is_uphill(&second_direction),
            ],
            along,
            reaches,
        };
        (slopes, is_ordinary)
    }
}

/// Bounds on the fall of the squared distance and on `|s1| + |s2|` where neither direction is 0
/// throughout, and whether they are certain.
#[inline(always)]
fn in_space(
    first: Slope,
    second: Slope,
    [is_first_uphill, is_second_uphill]: [bool; 2],
    along: &[Vector; 2],
    reaches: &[Vector; 2],
    while_: f64,
) -> (f64, f64, bool) {
    let (normal, is_normal_certain) = least_normal(along, reaches, while_);
    let chosen = |is_second: bool, first: f64, second: f64| if is_second { second } else { first };
    // The one that is not uphill, and the one that is.
    let flat = second.or(is_first_uphill, first);
    let steep = first.or(is_first_uphill, second);
    let (beside_fall, beside_error, is_beside) = beside(flat, steep);
    let (inside_fall, inside_error, is_inside) = inside(first, second, normal);
    let is_beside = is_beside & (is_first_uphill | is_second_uphill);
    let fall = chosen(is_beside, inside_fall, beside_fall);
    let error = chosen(is_beside, inside_error, beside_error);
    let is_held = is_first_uphill & is_second_uphill;
    (
        chosen(is_held, fall, 0.0),
        chosen(is_held, error, 0.0),
        is_normal_certain & (is_held | is_beside | is_inside),
    )
}

/// A length that the normal of two directions certainly has all the while, and whether it is above
/// 0.
#[inline(always)]
fn least_normal(along: &[Vector; 2], reaches: &[Vector; 2], while_: f64) -> (f64, bool) {
    let normal = cross(&along[0], &along[1]);
    let [x, y, z] = permanents(&reaches[0], &reaches[1]);
    let permanent = x + y + z;
    let error = (16.0 * U + 5.0 * while_) * permanent * (1.0 + 8.0 * U);
    let square = dot(&normal, &normal);
    let least = square.sqrt() * (1.0 - 8.0 * U) - error;
    (least, (square > SMALLEST) & (least > 0.0))
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

/// The same, where it is farther along the second direction.
#[inline(always)]
fn beside(first: Slope, second: Slope) -> (f64, f64, bool) {
    let Slope { least, .. } = first;
    let turn = second.most / least;
    let rest = (second.value - second.error) - turn * first.size() * (1.0 + 8.0 * U);
    let is_certain = (least > SHORTEST) & (rest > 0.0);
    let fall = (first.size() / least) * (first.size() / least);
    let second = fall / (4.0 * rest);
    let first = first.size() / (least * least) + turn * second;
    (fall, first + second, is_certain)
}

/// The same where nothing is in the way, with a bound on `|N|`.
#[inline(always)]
fn inside(first: Slope, second: Slope, normal: f64) -> (f64, f64, bool) {
    let length = (first.size() * second.most + second.size() * first.most) / normal;
    let (fall, error) = (
        length * length,
        length * ((first.most + second.most) / normal),
    );
    let is_certain = (first.most > SHORTEST) & (second.most > SHORTEST);
    (fall, error, is_certain)
}

/// 2^-450: what is longer has a square that loses nothing to underflow.
pub(super) const SHORTEST: f64 = f64::from_bits((1023 - 450) << 52);

/// 2^-850: far above what underflow adds to a product of two vectors below 2^182 each.
pub(super) const TINY: f64 = f64::from_bits((1023 - 850) << 52);

#[cfg(test)]
mod tests;

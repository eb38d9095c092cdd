//! Planes that turn.
//!
//! Where edges turn against each other, a plane that touches both at their nearest points cuts them
//! a moment later, though they are no nearer then. One that turns with them does not: all corners
//! that are as near as the nearest points come nearer to it at the same speed, that of the
//! distance.

use super::advance::{LARGEST, Moving, SMALLEST, difference};
use super::instant::Instant;
use crate::certified::ends::Ends;
use crate::certified::ends::smaller;
use crate::certified::kind::Stages;
use crate::certified::motion::{Vector, both, dot, scaled, sub};
use crate::certified::nearest::{Direction, Gram};
use crate::certified::separate::U;

/// A normal that changes linearly: `normal + s turn` for the time `s` that passes. Any two vectors
/// will do for a proof.
pub(super) struct Turning {
    normal: Vector,
    turn: Vector,
}

impl Turning {
    /// The plane between the nearest points: the directions `V` that are free there stay in it,
    /// `V . n = 0`, up to the second order, for a turn within what they span.
    #[inline(always)]
    pub(super) fn new(here: &Instant) -> Self {
        let normal = here.difference;
        let [k_change, l_change, _] = &here.change;
        let (k_change, l_change) = (dot(k_change, &normal), dot(l_change, &normal));
        let Gram { kk, ll, kl, .. } = here.gram;
        let [first, second] = here.spot.directions;
        // V . V, and -V' . n, which V . turn has to be.
        let square = |difference: &Direction| {
            difference.u * difference.u * kk - 2.0 * difference.u * difference.v * kl
                + difference.v * difference.v * ll
        };
        let target = |difference: &Direction| difference.u * k_change - difference.v * l_change;
        // The turn is `v L - u K`.
        let (u, v) = match (first.is_free, second.is_free) {
            (false, false) => (0.0, 0.0),
            // Both are free only where they are those of u and v.
            (true, true) => {
                let determinant = here.gram.determinant();
                let (p, q) = (k_change, -l_change);
                (
                    (p * ll + q * kl) / determinant,
                    (q * kk + p * kl) / determinant,
                )
            }
            (is_first, _) => {
                let difference = if is_first { first } else { second };
                let along = target(&difference) / square(&difference);
                (along * difference.u, along * difference.v)
            }
        };
        let [k, l, _] = &here.at;
        Self::between(normal, sub(&scaled(v, l), &scaled(u, k)))
    }

    /// With a turn, unless its square underflows or is not a number.
    #[inline(always)]
    fn between(normal: Vector, turn: Vector) -> Self {
        let square = dot(&turn, &turn);
        let is_some = square > SMALLEST && square < LARGEST;
        let turn = if is_some { turn } else { [0.0; 3] };
        Turning { normal, turn }
    }
}

impl<E: Ends> Moving<E> {
    /// How long after a time the plane certainly keeps them more than the radius apart, if not for
    /// `longest`.
    ///
    /// With `n` the normal, `d` its turn and a corner `X + s X'` it does as long as
    ///
    /// ```text
    /// (X + s X') . (n + s d) > R |n + s d|
    /// ```
    ///
    /// and `|n + s d| <= |n| + (2 s n . d + s^2 d . d) / 2 |n|`, as a square root is concave. So it
    /// does while a polynomial of degree 2 is above 0.
    ///
    /// Error bound, with `S` the sum of `e_i |n_i|` of [`SweptBoxes::is_certain`], `T` that of
    /// `e_i |d_i|`: a component of a vector at a time is within `4.1 u e`, its product with
    /// `n` within `7.2 u S`, that of a corner, of three of these and with two sums, within `27 u S`. A
    /// change, of magnitude up to `2 e`, is within `4.1 u e`; its product within `10.4 u S`, that of
    /// a corner within `44 u S`. What is taken from them below adds up to `10 u S` for each.
    /// [`SweptBoxes::bound`] is `24 u S` or `24 u T`: once and a half, and three times that. The
    /// terms with the radius pass at most ten roundings.
    ///
    /// What underflows: a component of a vector at a time is off by at most `2^-1074`. Where
    /// `e_i` is above `2^-1000` that is nothing beside `u e_i`; else `|n_i|` is about as small, and
    /// `|d_i|` below `2^1025 e_i`, as the turn is `v L - u K`: the products are below the `TINY` of
    /// the bounds. `R / |n|` may be off by `2^-1075`, so its product with `n . d` by that of `T`,
    /// and half that with `d . d` by `2^-1076 d . d`, at most `2^-50 T` for the same reason: with
    /// the `54 u T` above less than `72 u T`.
    ///
    /// [`SweptBoxes::is_certain`]: crate::certified::separate::SweptBoxes::is_certain
    /// [`SweptBoxes::bound`]: crate::certified::separate::SweptBoxes::bound
    #[inline(always)]
    pub(super) fn stays_apart_turning<K: Stages>(
        &self,
        here: &Instant,
        Turning { normal, turn }: &Turning,
        longest: f64,
    ) -> f64 {
        let square = dot(normal, normal);
        let (length, turn_square) = (square.sqrt(), dot(turn, turn));
        let (bound, turn_bound) = (self.boxes.bound(normal), self.boxes.bound(turn));
        let share = self.radius / length;
        let least = [
            self.radius * length * (1.0 + 16.0 * U) + 1.5 * bound,
            share * dot(normal, turn)
                + 16.0 * U * self.radius * turn_square.sqrt()
                + (3.0 * bound + 1.5 * turn_bound),
            0.5 * share * turn_square * (1.0 + 16.0 * U) + 3.0 * turn_bound,
        ];
        let [a, b, c] = least;
        let is_finite = (a < LARGEST) & (b.abs() < LARGEST) & (c < LARGEST);
        if !(is_finite && square > SMALLEST && square < LARGEST) {
            return 0.0;
        }
        let (along, across) = (both(normal), both(turn));
        let coefficients = |i: usize| {
            let (at, change) = (&here.at[i], &here.change[i]);
            let pair = |j: usize| E::new(at[j], change[j]);
            let pairs = [pair(0), pair(1), pair(2)];
            let (p, q) = (dot(&pairs, &along), dot(&pairs, &across));
            [p.start(), p.end() + q.start(), q.end()]
        };
        let vectors = [coefficients(0), coefficients(1), coefficients(2)];
        // All of them before any is compared, so that roots and quotients overlap.
        let mut times = [longest; 4];
        for (time, &(u, v)) in times.iter_mut().zip(K::CORNERS) {
            *time = stays_positive(&sub(&difference(&vectors, u, v), &least));
        }
        times.into_iter().fold(longest, smaller)
    }
}

/// How long `a + b s + c s^2` is certainly above 0 from `s = 0` on; 0 if nothing is certain.
///
/// The first root above 0 is `2 a / (sqrt(b^2 - 4 a c) - b)`; there is none if that is not a number
/// above 0. The error of the discriminant is below `8 u` of what is added, so that below it is too
/// large, as the divisor then is: by more than its own rounding, even where it cancels.
#[inline(always)]
fn stays_positive(&[a, b, c]: &[f64; 3]) -> f64 {
    let (square, product) = (b * b, 4.0 * a * c);
    let size = square + product.abs();
    let discriminant = square - product + 16.0 * U * size;
    let divisor = discriminant.sqrt() * (1.0 + 16.0 * U) - b;
    let root = 2.0 * a / divisor * (1.0 - 16.0 * U);
    // What underflows or is not a number is no proof.
    if !((a > 0.0) & (size > SMALLEST) & (size < LARGEST)) {
        0.0
    } else if (discriminant < 0.0) | (divisor <= 0.0) {
        f64::INFINITY
    } else if root > SMALLEST {
        root
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests;

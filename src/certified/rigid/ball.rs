//! Numbers of twice the precision of `f64`, with a bound on their error.

use std::cmp::Ordering;

use crate::certified::double::{Double, two_difference};
use crate::certified::ends::Plain;

/// A number that is known up to an error: the exact one is within `error` of `middle`.
///
/// After an overflow a part is infinite or NaN, and the number has no [`sign`](Self::sign).
#[derive(Clone, Copy)]
pub(super) struct Ball {
    middle: Double<f64>,
    error: f64,
}

/// `2^-102`: more than any relative error of [`Double`], which are below `8 * 2^-106`.
const DOUBLED: f64 = f64::from_bits((1023 - 102) << 52);

/// `2^-1000`: more than what underflow takes from a sum or a product.
pub(super) const LEAST: f64 = f64::from_bits((1023 - 1000) << 52);

/// More than the roundings of a bound, which are fewer than 40 for each.
pub(super) const UP: f64 = 1.0 + f64::from_bits((1023 - 46) << 52);

impl Ball {
    pub(super) const ZERO: Ball = Ball::new(0.0);

    /// Any number.
    pub(super) const UNKNOWN: Ball = Ball {
        error: f64::INFINITY,
        ..Ball::ZERO
    };

    /// An `f64` without an error.
    pub(super) const fn new(number: f64) -> Self {
        Ball {
            middle: Double {
                high: number,
                low: 0.0,
            },
            error: 0.0,
        }
    }

    /// `a - b`, without an error unless it overflows.
    pub(super) fn difference(a: f64, b: f64) -> Self {
        Ball {
            middle: two_difference(a, b),
            error: 0.0,
        }
    }

    /// `a + b`, without an error unless it overflows.
    pub(super) fn sum([a, b]: [f64; 2]) -> Self {
        Ball::difference(a, -b)
    }

    /// The same, known less well by an `f64` of at least 0.
    pub(super) fn widened(self, by: f64) -> Self {
        Ball {
            error: (self.error + by) * UP,
            ..self
        }
    }

    pub(super) fn add(self, other: Self) -> Self {
        self.sum_of(other, self.middle.add(other.middle))
    }

    pub(super) fn sub(self, other: Self) -> Self {
        self.sum_of(other, self.middle.sub(other.middle))
    }

    /// Both operations have the same bound: `2^-102` of both magnitudes. A sum that underflows is
    /// exact, but the bound is not.
    fn sum_of(self, other: Self, middle: Double<f64>) -> Self {
        let size = self.middle.high.abs() + other.middle.high.abs();
        let error = (self.error + other.error + DOUBLED * size + LEAST) * UP;
        Ball { middle, error }
    }

    /// With `x` and `y` off by `d` and `e`, the product is off by at most `|x| e + |y| d + d e`.
    pub(super) fn mul(self, other: Self) -> Self {
        let (x, y) = (self.middle.high.abs(), other.middle.high.abs());
        let (d, e) = (self.error, other.error);
        // The low parts are below the roundings that UP outweighs.
        let error = (x * e + y * d + d * e + DOUBLED * (x * y) + LEAST) * UP;
        let both = |number: Double<f64>| Double::<Plain>::both(number);
        let [middle, _] = both(self.middle).mul(both(other.middle)).lanes();
        Ball { middle, error }
    }

    /// Twice the number.
    pub(super) fn twice(self) -> Self {
        Ball {
            middle: Double {
                high: 2.0 * self.middle.high,
                low: 2.0 * self.middle.low,
            },
            error: 2.0 * self.error,
        }
    }

    pub(super) fn neg(self) -> Self {
        Ball {
            middle: Double {
                high: -self.middle.high,
                low: -self.middle.low,
            },
            ..self
        }
    }

    /// The sign, if it is certain that the number is not 0.
    pub(super) fn sign(self) -> Option<Ordering> {
        if self.least() > 0.0 {
            self.middle.high.partial_cmp(&0.0)
        } else {
            None
        }
    }

    /// About the number.
    pub(super) fn value(self) -> f64 {
        self.middle.high
    }

    /// The number in one `f64`, and a bound on the error of that.
    pub(super) fn rounded(self) -> (f64, f64) {
        let Double { high, low } = self.middle;
        (high, (low.abs() + self.error) * UP)
    }

    /// Not below the magnitude.
    pub(super) fn most(self) -> f64 {
        (self.middle.high.abs() + self.error) * UP
    }

    /// Not above the magnitude, unless it is below 0.
    pub(super) fn least(self) -> f64 {
        self.middle.high.abs() * (2.0 - UP) - self.error * UP
    }
}

#[cfg(test)]
mod tests;

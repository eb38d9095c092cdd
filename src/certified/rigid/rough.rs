//! Numbers of the precision of `f64`, with a bound on their error.

use std::cmp::Ordering;

use super::ball::{Ball, LEAST, UP};
use crate::certified::separate::U;

/// A number that is known up to an error: the exact one is within `error` of `value`. The same as a
/// [`Ball`], at a part of its cost.
#[derive(Clone, Copy)]
pub(super) struct Rough {
    value: f64,
    error: f64,
}

impl Rough {
    pub(super) const ZERO: Rough = Rough::new(0.0, 0.0);

    pub(super) const fn new(value: f64, error: f64) -> Self {
        Rough { value, error }
    }

    pub(super) fn of(ball: Ball) -> Self {
        let (value, error) = ball.rounded();
        Rough { value, error }
    }

    /// A sum that underflows is exact.
    pub(super) fn add(self, other: Self) -> Self {
        let value = self.value + other.value;
        let error = (self.error + other.error + U * value.abs() + LEAST) * UP;
        Rough { value, error }
    }

    pub(super) fn sub(self, other: Self) -> Self {
        self.add(other.neg())
    }

    /// With `x` and `y` off by `d` and `e`, the product is off by at most `|x| e + |y| d + d e`.
    pub(super) fn mul(self, other: Self) -> Self {
        let (x, y) = (self.value.abs(), other.value.abs());
        let (d, e) = (self.error, other.error);
        let value = self.value * other.value;
        let error = (x * e + (y + e) * d + U * value.abs() + LEAST) * UP;
        Rough { value, error }
    }

    pub(super) fn twice(self) -> Self {
        Rough::new(2.0 * self.value, 2.0 * self.error)
    }

    pub(super) fn neg(self) -> Self {
        Rough::new(-self.value, self.error)
    }

    /// The sign, if it is certain that the number is not 0.
    pub(super) fn sign(self) -> Option<Ordering> {
        if self.least() > 0.0 {
            self.value.partial_cmp(&0.0)
        } else {
            None
        }
    }

    /// About the number.
    pub(super) fn value(self) -> f64 {
        self.value
    }

    pub(super) fn error(self) -> f64 {
        self.error
    }

    /// Not below the magnitude.
    pub(super) fn most(self) -> f64 {
        (self.value.abs() + self.error) * UP
    }

    /// Not above the magnitude, unless it is below 0.
    pub(super) fn least(self) -> f64 {
        self.value.abs() * (2.0 - UP) - self.error * UP
    }
}

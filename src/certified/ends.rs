//! A number at both ends of the step: what is done at the start is done at the end too, in one
//! instruction where the processor can.

use std::ops::{Add, Mul, Sub};

use wide::f64x2;

use super::motion::{larger, smaller};

/// What vectors are made of.
pub(super) trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>> Scalar for T {}

/// A number at `t = 0` and at `t = 1`; arithmetic is done at each end by itself, in `f64`.
///
/// There are two, which agree in every bit: [`f64x2`] for one query, in a register that holds both
/// ends, and [`Plain`] for loops over many queries, of which the compiler puts several into a
/// register.
pub(super) trait Ends: Scalar {
    fn new(start: f64, end: f64) -> Self;

    fn start(self) -> f64;

    fn end(self) -> f64;

    fn abs(self) -> Self;

    /// The larger one at each end; of numbers that are not NaN.
    fn larger(self, other: Self) -> Self;

    /// The smaller one at each end; of numbers that are not NaN.
    fn smaller(self, other: Self) -> Self;

    /// Whether it is larger than `other` at the start, and at the end.
    fn is_above(self, other: Self) -> [bool; 2];

    /// The same number at both ends.
    #[inline(always)]
    fn both(value: f64) -> Self {
        Self::new(value, value)
    }

    /// Start and end exchanged.
    #[inline(always)]
    fn swapped(self) -> Self {
        Self::new(self.end(), self.start())
    }

    /// The starts of two numbers, and their ends.
    #[inline(always)]
    fn transposed(self, other: Self) -> [Self; 2] {
        [
            Self::new(self.start(), other.start()),
            Self::new(self.end(), other.end()),
        ]
    }

    #[inline(always)]
    fn largest(self) -> f64 {
        larger(self.start(), self.end())
    }

    #[inline(always)]
    fn least(self) -> f64 {
        smaller(self.start(), self.end())
    }

    #[inline(always)]
    fn sum(self) -> f64 {
        self.start() + self.end()
    }
}

impl Ends for f64x2 {
    #[inline(always)]
    fn new(start: f64, end: f64) -> Self {
        f64x2::new([start, end])
    }

    #[inline(always)]
    fn start(self) -> f64 {
        self.to_array()[0]
    }

    #[inline(always)]
    fn end(self) -> f64 {
        self.to_array()[1]
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64x2::abs(self)
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.fast_max(other)
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        self.fast_min(other)
    }

    #[inline(always)]
    fn is_above(self, other: Self) -> [bool; 2] {
        let mask = self.simd_gt(other).to_bitmask();
        [mask & 1 != 0, mask & 2 != 0]
    }
}

/// The two numbers side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plain {
    start: f64,
    end: f64,
}

impl Plain {
    #[inline(always)]
    fn each(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Plain {
            start: f(self.start, other.start),
            end: f(self.end, other.end),
        }
    }
}

impl Add for Plain {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.each(other, |x, y| x + y)
    }
}

impl Sub for Plain {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.each(other, |x, y| x - y)
    }
}

impl Mul for Plain {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.each(other, |x, y| x * y)
    }
}

impl Ends for Plain {
    #[inline(always)]
    fn new(start: f64, end: f64) -> Self {
        Plain { start, end }
    }

    #[inline(always)]
    fn start(self) -> f64 {
        self.start
    }

    #[inline(always)]
    fn end(self) -> f64 {
        self.end
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self::new(self.start.abs(), self.end.abs())
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.each(other, larger)
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        self.each(other, smaller)
    }

    #[inline(always)]
    fn is_above(self, other: Self) -> [bool; 2] {
        [self.start > other.start, self.end > other.end]
    }
}

#[cfg(test)]
mod tests;

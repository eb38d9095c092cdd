//! Exact numbers: integers times powers of two, so every finite `f64`, sums and products of them.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use num_bigint::BigInt;

/// `digits * 2^exponent`.
#[derive(Clone, Debug)]
pub(in super::super) struct Number {
    digits: BigInt,
    exponent: i64,
}

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        assert!(value.is_finite(), "{value} is not a number");
        let bits = value.to_bits();
        let (field, fraction) = ((bits >> 52 & 0x7ff) as i64, (bits & ((1 << 52) - 1)) as i64);
        let digits = if field == 0 {
            fraction
        } else {
            fraction | 1 << 52
        };
        Number {
            digits: BigInt::from(if value < 0.0 { -digits } else { digits }),
            exponent: field.max(1) - 1075,
        }
    }
}

impl Number {
    pub(in super::super) fn zero() -> Self {
        Self::from(0.0)
    }

    /// `2^exponent`.
    pub(in super::super) fn power(exponent: i64) -> Self {
        Number {
            digits: BigInt::from(1),
            exponent,
        }
    }

    pub(in super::super) fn times(&self, factor: i64) -> Self {
        Number {
            digits: &self.digits * factor,
            exponent: self.exponent,
        }
    }

    pub(in super::super) fn abs(&self) -> Self {
        if self.sign().is_lt() {
            -self
        } else {
            self.clone()
        }
    }

    pub(in super::super) fn sign(&self) -> Ordering {
        self.digits.cmp(&BigInt::ZERO)
    }

    /// The number in the middle of two.
    pub(in super::super) fn middle(&self, other: &Self) -> Self {
        &(self + other) * &Number::power(-1)
    }

    /// The larger of two.
    pub(in super::super) fn larger(self, other: Self) -> Self {
        if self >= other { self } else { other }
    }

    /// The smaller of two.
    pub(in super::super) fn smaller(self, other: Self) -> Self {
        if self <= other { self } else { other }
    }

    /// `self / other`, rounded; of an `other` above 0.
    pub(in super::super) fn ratio(&self, other: &Self) -> f64 {
        let (x, y) = (self.leading(), other.leading());
        let power = (x.1 - y.1).clamp(-1000, 1000) as i32;
        x.0 / y.0 * 2f64.powi(power)
    }

    /// The leading 62 bits, and the exponent that belongs to them.
    fn leading(&self) -> (f64, i64) {
        let shift = self.digits.bits().saturating_sub(62);
        let leading = i64::try_from(&self.digits >> shift).unwrap();
        (leading as f64, self.exponent + shift as i64)
    }

    /// Both numbers as integers in the same unit, and the exponent of that.
    fn aligned(&self, other: &Self) -> (BigInt, BigInt, i64) {
        let exponent = self.exponent.min(other.exponent);
        let digits = |x: &Self| &x.digits << (x.exponent - exponent) as u64;
        (digits(self), digits(other), exponent)
    }
}

impl Add for &Number {
    type Output = Number;

    fn add(self, other: Self) -> Number {
        if other.sign().is_eq() {
            return self.clone();
        }
        if self.sign().is_eq() {
            return other.clone();
        }
        let (x, y, exponent) = self.aligned(other);
        Number {
            digits: x + y,
            exponent,
        }
    }
}

impl Neg for &Number {
    type Output = Number;

    fn neg(self) -> Number {
        self.times(-1)
    }
}

impl Sub for &Number {
    type Output = Number;

    fn sub(self, other: Self) -> Number {
        self + &-other
    }
}

impl Mul for &Number {
    type Output = Number;

    fn mul(self, other: Self) -> Number {
        Number {
            digits: &self.digits * &other.digits,
            exponent: self.exponent + other.exponent,
        }
    }
}

impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        (self - other).sign().is_eq()
    }
}

impl PartialOrd for Number {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some((self - other).sign())
    }
}

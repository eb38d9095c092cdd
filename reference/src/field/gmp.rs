//! The GMP backend, through `rug`.

use std::cmp::Ordering;

use rug::Assign;
use rug::ops::{DivRounding, NegAssign};

use super::{Integer, OrderedField, Ratio};

impl Integer for rug::Integer {
    const BACKEND: &'static str = "gmp";

    type Ratio = rug::Rational;

    fn from_i64(value: i64) -> Self {
        rug::Integer::from(value)
    }

    fn sign(&self) -> Ordering {
        self.cmp0()
    }

    fn bits(&self) -> u64 {
        u64::from(self.significant_bits())
    }

    fn trailing_zeros(&self) -> u64 {
        self.find_one(0).map_or(0, u64::from)
    }

    fn add(&self, other: &Self) -> Self {
        rug::Integer::from(self + other)
    }

    fn sub(&self, other: &Self) -> Self {
        rug::Integer::from(self - other)
    }

    fn mul(&self, other: &Self) -> Self {
        rug::Integer::from(self * other)
    }

    fn neg(&self) -> Self {
        let mut result = self.clone();
        result.neg_assign();
        result
    }

    fn add_assign(&mut self, other: &Self) {
        *self += other;
    }

    fn sub_assign(&mut self, other: &Self) {
        *self -= other;
    }

    fn add_product(&mut self, a: &Self, b: &Self) {
        *self += a * b;
    }

    fn sub_product(&mut self, a: &Self, b: &Self) {
        *self -= a * b;
    }

    fn shl(&self, bits: u64) -> Self {
        let mut result = rug::Integer::new();
        result.assign(self << shift(bits));
        result
    }

    fn shr_floor(&self, bits: u64) -> Self {
        let mut result = rug::Integer::new();
        result.assign(self >> shift(bits));
        result
    }

    fn div_exact(&self, other: &Self) -> Self {
        rug::Integer::from(self.div_exact_ref(other))
    }

    fn div_floor(&self, other: &Self) -> Self {
        DivRounding::div_floor(self, other).into()
    }

    fn gcd(&self, other: &Self) -> Self {
        rug::Integer::from(self.gcd_ref(other))
    }

    fn approximate(&self) -> (f64, i64) {
        if self.is_zero() {
            return (0.0, 0);
        }
        let (fraction, exponent) = self.to_f64_exp();
        (fraction * 2f64.powi(64), i64::from(exponent) - 64)
    }

    fn to_i64(&self) -> Option<i64> {
        rug::Integer::to_i64(self)
    }

    fn from_decimal(text: &str) -> Option<Self> {
        super::is_decimal(text)
            .then(|| text.trim_start_matches('+').parse().ok())
            .flatten()
    }
}

/// GMP counts bits in 32 bits here; an integer of 2^32 bits does not fit in memory anyway.
fn shift(bits: u64) -> u32 {
    u32::try_from(bits).unwrap_or(u32::MAX)
}

impl OrderedField for rug::Rational {
    fn from_i64(value: i64) -> Self {
        rug::Rational::from(value)
    }

    fn sign(&self) -> Ordering {
        self.cmp0()
    }
}

impl Ratio for rug::Rational {
    type Integer = rug::Integer;

    fn new(numerator: rug::Integer, denominator: rug::Integer) -> Self {
        rug::Rational::from((numerator, denominator))
    }

    fn numerator(&self) -> rug::Integer {
        self.numer().clone()
    }

    fn denominator(&self) -> rug::Integer {
        self.denom().clone()
    }
}

//! The pure Rust backend: `num-bigint` and `num-rational`.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::{Integer, OrderedField, Ratio};

impl Integer for BigInt {
    const BACKEND: &'static str = "num-bigint";

    type Ratio = BigRational;

    fn from_i64(value: i64) -> Self {
        BigInt::from(value)
    }

    fn sign(&self) -> Ordering {
        match BigInt::sign(self) {
            Sign::Minus => Ordering::Less,
            Sign::NoSign => Ordering::Equal,
            Sign::Plus => Ordering::Greater,
        }
    }

    fn bits(&self) -> u64 {
        BigInt::bits(self)
    }

    fn trailing_zeros(&self) -> u64 {
        BigInt::trailing_zeros(self).unwrap_or(0)
    }

    fn add(&self, other: &Self) -> Self {
        self + other
    }

    fn sub(&self, other: &Self) -> Self {
        self - other
    }

    fn mul(&self, other: &Self) -> Self {
        self * other
    }

    fn neg(&self) -> Self {
        -self
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
        self << bits
    }

    fn shr_floor(&self, bits: u64) -> Self {
        self >> bits
    }

    fn div_exact(&self, other: &Self) -> Self {
        self / other
    }

    fn div_floor(&self, other: &Self) -> Self {
        num_integer::Integer::div_floor(self, other)
    }

    fn gcd(&self, other: &Self) -> Self {
        num_integer::Integer::gcd(self, other)
    }

    fn approximate(&self) -> (f64, i64) {
        let bits = BigInt::bits(self);
        if bits == 0 {
            return (0.0, 0);
        }
        let magnitude = self.magnitude();
        let top = if bits > 64 {
            (magnitude >> (bits - 64)).to_u64().unwrap_or(u64::MAX)
        } else {
            magnitude.to_u64().unwrap_or(u64::MAX) << (64 - bits)
        };
        let mantissa = top as f64;
        let exponent = i64::try_from(bits).unwrap_or(i64::MAX) - 64;
        (
            if BigInt::sign(self) == Sign::Minus {
                -mantissa
            } else {
                mantissa
            },
            exponent,
        )
    }

    fn to_i64(&self) -> Option<i64> {
        ToPrimitive::to_i64(self)
    }

    fn from_decimal(text: &str) -> Option<Self> {
        super::is_decimal(text).then(|| text.parse().ok()).flatten()
    }
}

impl OrderedField for BigRational {
    fn from_i64(value: i64) -> Self {
        BigRational::from_integer(BigInt::from(value))
    }

    fn sign(&self) -> Ordering {
        Integer::sign(self.numer())
    }
}

impl Ratio for BigRational {
    type Integer = BigInt;

    fn new(numerator: BigInt, denominator: BigInt) -> Self {
        BigRational::new(numerator, denominator)
    }

    fn numerator(&self) -> BigInt {
        self.numer().clone()
    }

    fn denominator(&self) -> BigInt {
        self.denom().clone()
    }
}

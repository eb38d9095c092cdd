//! Exact numbers: integers and the ordered field of rationals, over two backends.
//!
//! [`ratio`] is pure Rust (`num-bigint`, `num-rational`) and always there; `gmp` is GMP through
//! `rug`, behind the feature of that name. Everything exact in this crate is generic over
//! [`Integer`], so that both backends run the same code and can be compared.
//!
//! Inputs are finite `f64` and so dyadic rationals: scaled by one power of two they are integers,
//! and the sign of every predicate is a sign over the integers. Rationals normalise by a gcd at
//! every operation and are kept for where a quotient is the answer.

use std::cmp::Ordering;
use std::fmt::{Debug, Display};
use std::ops::{Add, Div, Mul, Neg, Sub};

#[cfg(feature = "gmp")]
pub mod gmp;
pub mod ratio;

/// The backend that runs where none is asked for: GMP with the feature `gmp`, else pure Rust.
#[cfg(feature = "gmp")]
pub type Default = rug::Integer;
/// The backend that runs where none is asked for: GMP with the feature `gmp`, else pure Rust.
#[cfg(not(feature = "gmp"))]
pub type Default = num_bigint::BigInt;

/// Exact integers of any size.
///
/// Methods instead of operators on references: one trait bound instead of a dozen, and the backends
/// differ in what their operators return.
pub trait Integer: Clone + Debug + Display + Ord + Send + Sync + 'static {
    /// The name of the backend.
    const BACKEND: &'static str;

    /// The field of fractions.
    type Ratio: Ratio<Integer = Self>;

    /// The integer of this value.
    fn from_i64(value: i64) -> Self;
    /// `self` compared with 0.
    fn sign(&self) -> Ordering;
    /// How many bits `|self|` has; 0 for 0.
    fn bits(&self) -> u64;
    /// How many of the lowest bits are 0; 0 for 0.
    fn trailing_zeros(&self) -> u64;
    /// `self + other`.
    fn add(&self, other: &Self) -> Self;
    /// `self - other`.
    fn sub(&self, other: &Self) -> Self;
    /// `self * other`.
    fn mul(&self, other: &Self) -> Self;
    /// `-self`.
    fn neg(&self) -> Self;
    /// `self += other`.
    fn add_assign(&mut self, other: &Self);
    /// `self -= other`.
    fn sub_assign(&mut self, other: &Self);
    /// `self += a b`.
    fn add_product(&mut self, a: &Self, b: &Self);
    /// `self -= a b`.
    fn sub_product(&mut self, a: &Self, b: &Self);
    /// `self 2^bits`.
    fn shl(&self, bits: u64) -> Self;
    /// The largest integer not above `self / 2^bits`.
    fn shr_floor(&self, bits: u64) -> Self;
    /// `self / other`, which the caller knows to leave no remainder.
    fn div_exact(&self, other: &Self) -> Self;
    /// The largest integer not above `self / other`, with `other > 0`.
    fn div_floor(&self, other: &Self) -> Self;
    /// The greatest common divisor, at least 0.
    fn gcd(&self, other: &Self) -> Self;
    /// `self` as `m 2^e` with `|m|` in `[2^63, 2^64)` cut to `f64`; `(0, 0)` for 0. Good to about
    /// 53 bits, for estimates only.
    fn approximate(&self) -> (f64, i64);
    /// The value if it fits.
    fn to_i64(&self) -> Option<i64>;
    /// The integer written in decimal digits with an optional sign.
    fn from_decimal(text: &str) -> Option<Self>;

    /// 0.
    fn zero() -> Self {
        Self::from_i64(0)
    }
    /// 1.
    fn one() -> Self {
        Self::from_i64(1)
    }
    /// Whether it is 0.
    fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }
    /// `|self|`.
    fn abs(&self) -> Self {
        if self.sign() == Ordering::Less {
            self.neg()
        } else {
            self.clone()
        }
    }
}

/// An ordered field: what the thesis' arithmetic needs.
pub trait OrderedField:
    Clone
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The field element of this value.
    fn from_i64(value: i64) -> Self;

    /// `self` compared with 0.
    fn sign(&self) -> Ordering;

    /// `self` compared with `other`.
    fn compare(&self, other: &Self) -> Ordering {
        (self.clone() - other.clone()).sign()
    }

    /// Whether it is 0.
    fn is_zero(&self) -> bool {
        self.sign() == Ordering::Equal
    }

    /// Whether `0 <= self <= 1`.
    fn in_unit_interval(&self) -> bool {
        self.sign() != Ordering::Less && self.compare(&Self::from_i64(1)) != Ordering::Greater
    }
}

/// Exact rationals, always in lowest terms with a positive denominator.
pub trait Ratio: OrderedField + Ord + Display + Send + Sync + 'static {
    /// Numerators and denominators.
    type Integer: Integer<Ratio = Self>;

    /// `numerator / denominator`, the denominator not 0.
    fn new(numerator: Self::Integer, denominator: Self::Integer) -> Self;
    /// The numerator in lowest terms.
    fn numerator(&self) -> Self::Integer;
    /// The denominator in lowest terms, above 0.
    fn denominator(&self) -> Self::Integer;
}

/// Whether `text` is decimal digits with at most one sign before them.
fn is_decimal(text: &str) -> bool {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
}

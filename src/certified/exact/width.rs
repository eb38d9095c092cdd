//! Integers of fixed widths for the coefficients of a motion and for its values at a time.
//!
//! With coordinate differences and their changes over the step below `2^b`, the bits of everything
//! that is computed are known beforehand, so that nothing can overflow:
//!
//! - *linear*: the differences themselves, `b` bits.
//! - *quadratic*: `c0 + c1 t + c2 t^2` whose coefficients are sums of at most 18, 36 and 18
//!   products of two of them for edges (the largest is [`super::motion`]'s `between` of an end), and
//!   27, 54 and 27 for a face. Any sum of these for `t` in `[0, 1]` and the Bernstein coefficients
//!   times 2 are at most `108 2^(2b)`, below `2^(2b + 7)`.
//! - *cubic*: the coefficients of `f = M . N` are sums of at most 6, 18, 18 and 6 products of
//!   three, together at most `48 2^(3b)`; its Bernstein coefficients times 3 are at most three
//!   times that, below `2^(3b + 8)`.
//!
//! With a bit for the sign: `b + 1`, `2b + 8` and `3b + 9` bits. Values at a multiple of `2^-128`
//! are `2^256` and `2^384` times as large. The discriminant of a quadratic is at most
//! `(54^2 + 4 27^2) 2^(4b)`, with its sign `4b + 14` bits; that fits into the `2b + 8 + 256` bits
//! of a value as `b` is at most 124.

use std::borrow::{Borrow, BorrowMut};
use std::cmp::Ordering;

use super::fraction::Fraction;
use super::integer::{Integer, add_limbs, multiply_add, subtract_limbs};
use super::isolate::Isolated;
use super::poly::Poly;

/// Exact numbers of one width.
pub(super) trait Number: Clone {
    /// `self + other`.
    fn add(&self, other: &Self) -> Self;
    /// `self - other`.
    fn sub(&self, other: &Self) -> Self;
    /// Compared with 0.
    fn sign(&self) -> Ordering;
    /// An approximation with a relative error below `2^-53 + 2^-63`; infinite where it is too
    /// large.
    fn to_f64(&self) -> f64;
    /// The same number.
    fn to_integer(&self) -> Integer;

    /// Whether it is 0.
    fn is_zero(&self) -> bool {
        self.sign().is_eq()
    }
}

/// Widths that go together: for differences of coordinates, their products, and products of three.
pub(super) trait Width {
    /// Coefficients of degree 1.
    type Linear: Number;
    /// Coefficients of degree 2.
    type Quadratic: Number;
    /// Coefficients of degree 3.
    type Cubic: Number;
    /// Values of polynomials of degree 2.
    type QuadraticValue: Number;
    /// Values of polynomials of degree 3.
    type CubicValue: Number;
    /// The roots that were isolated in integers of any size: in place, or on the heap where the
    /// numbers are there as well.
    type Isolated: BorrowMut<Isolated> + From<Isolated>;
    /// A polynomial in integers of any size, likewise.
    type Poly: Borrow<Poly> + From<Poly>;

    /// `a b`.
    fn times(a: &Self::Linear, b: &Self::Linear) -> Self::Quadratic;
    /// `a b`.
    fn times_quadratic(a: &Self::Quadratic, b: &Self::Linear) -> Self::Cubic;
    /// `a b`, for coefficients of degree 2.
    fn times_quadratics(a: &Self::Quadratic, b: &Self::Quadratic) -> Self::QuadraticValue;
    /// `2^256` times the value of `c[0] + c[1] t + c[2] t^2` at `t = grid_time / 2^128`.
    fn quadratic_at(c: &[Self::Quadratic; 3], grid_time: u128) -> Self::QuadraticValue;
    /// `2^384` times the value of `c[0] + c[1] t + c[2] t^2 + c[3] t^3` at `t = grid_time / 2^128`.
    fn cubic_at(c: &[Self::Cubic; 4], grid_time: u128) -> Self::CubicValue;
    /// The same number; a value can be doubled [`DOUBLINGS`] times beyond the largest coefficient.
    fn widened(c: &Self::Cubic) -> Self::CubicValue;
    /// `d^2` times the value of the same quadratic at `t = n / d`.
    fn quadratic_at_fraction(c: &[Self::Quadratic; 3], at: Fraction) -> Self::QuadraticValue;
    /// `d^3` times the value of the same cubic at `t = n / d`.
    fn cubic_at_fraction(c: &[Self::Cubic; 4], at: Fraction) -> Self::CubicValue;
}

/// See [`Width::widened`].
pub(super) const DOUBLINGS: u32 = 384;

/// Widths of `L`, `Q` and `C` limbs for the coefficients, `Q + 4` and `C + 6` for the values.
pub(super) struct Fixed<
    const L: usize,
    const Q: usize,
    const C: usize,
    const QV: usize,
    const CV: usize,
>;

impl<const L: usize, const Q: usize, const C: usize, const QV: usize, const CV: usize>
    Fixed<L, Q, C, QV, CV>
{
    /// The largest `b` that the widths are enough for.
    pub(super) const BITS: u32 = {
        assert!(QV == Q + 4 && CV == C + 6);
        let linear = 64 * L as u32 - 1;
        let quadratic = (64 * Q as u32 - 8) / 2;
        let cubic = (64 * C as u32 - 9) / 3;
        let least = if linear < quadratic {
            linear
        } else {
            quadratic
        };
        if least < cubic { least } else { cubic }
    };
}

impl<const L: usize, const Q: usize, const C: usize, const QV: usize, const CV: usize> Width
    for Fixed<L, Q, C, QV, CV>
{
    type Linear = Wide<L>;
    type Quadratic = Wide<Q>;
    type Cubic = Wide<C>;
    type QuadraticValue = Wide<QV>;
    type CubicValue = Wide<CV>;
    type Isolated = Isolated;
    type Poly = Poly;

    #[inline]
    fn times(a: &Wide<L>, b: &Wide<L>) -> Wide<Q> {
        product(a, b)
    }

    #[inline]
    fn times_quadratic(a: &Wide<Q>, b: &Wide<L>) -> Wide<C> {
        product(a, b)
    }

    fn times_quadratics(a: &Wide<Q>, b: &Wide<Q>) -> Wide<QV> {
        product(a, b)
    }

    fn quadratic_at(c: &[Wide<Q>; 3], grid_time: u128) -> Wide<QV> {
        horner(c, grid_time)
    }

    fn cubic_at(c: &[Wide<C>; 4], grid_time: u128) -> Wide<CV> {
        horner(c, grid_time)
    }

    fn widened(c: &Wide<C>) -> Wide<CV> {
        Wide(shifted_limbs(c, 0))
    }

    fn quadratic_at_fraction(c: &[Wide<Q>; 3], at: Fraction) -> Wide<QV> {
        horner_fraction(c, at)
    }

    fn cubic_at_fraction(c: &[Wide<C>; 4], at: Fraction) -> Wide<CV> {
        horner_fraction(c, at)
    }
}

/// An integer of `N` limbs in two's complement, the least significant limb first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Wide<const N: usize>([u64; N]);

impl<const N: usize> Wide<N> {
    fn is_negative(&self) -> bool {
        self.0[N - 1] >> 63 == 1
    }

    /// Its magnitude.
    fn magnitude(&self) -> [u64; N] {
        let mut limbs = self.0;
        if self.is_negative() {
            let mut carry = true;
            for limb in &mut limbs {
                (*limb, carry) = (!*limb).overflowing_add(u64::from(carry));
            }
        }
        limbs
    }
}

impl<const N: usize> From<i64> for Wide<N> {
    #[inline]
    fn from(value: i64) -> Self {
        let mut limbs = [(value >> 63) as u64; N];
        limbs[0] = value as u64;
        Wide(limbs)
    }
}

impl<const N: usize> From<i128> for Wide<N> {
    /// The lowest limbs; the caller knows that they are enough.
    #[inline]
    fn from(value: i128) -> Self {
        let mut limbs = [(value >> 127) as u64; N];
        limbs[0] = value as u64;
        if N > 1 {
            limbs[1] = (value >> 64) as u64;
        }
        debug_assert!(
            N > 1 || i128::from(value as i64) == value,
            "{value} needs two limbs"
        );
        Wide(limbs)
    }
}

impl<const N: usize> Number for Wide<N> {
    #[inline]
    fn add(&self, other: &Self) -> Self {
        let mut sum = *self;
        let mut carry = false;
        for (limb, &own) in sum.0.iter_mut().zip(&other.0) {
            (*limb, carry) = add_limbs(*limb, own, carry);
        }
        debug_assert!(
            self.is_negative() != other.is_negative() || sum.is_negative() == self.is_negative()
        );
        sum
    }

    #[inline]
    fn sub(&self, other: &Self) -> Self {
        let mut difference = *self;
        subtract_high(&mut difference.0, 0, &other.0);
        debug_assert!(
            self.is_negative() == other.is_negative()
                || difference.is_negative() == self.is_negative()
        );
        difference
    }

    #[inline]
    fn sign(&self) -> Ordering {
        if self.is_negative() {
            Ordering::Less
        } else if self.0.iter().all(|&limb| limb == 0) {
            Ordering::Equal
        } else {
            Ordering::Greater
        }
    }

    #[inline]
    fn to_f64(&self) -> f64 {
        let limbs = self.magnitude();
        let Some(top) = (0..N).rev().find(|&i| limbs[i] != 0) else {
            return 0.0;
        };
        // The 64 bits from the highest one on, the last one set where the limbs that they are from
        // have more: they round as these do.
        let zeros = limbs[top].leading_zeros();
        let next = if top > 0 { limbs[top - 1] } else { 0 };
        let both = (u128::from(limbs[top]) << 64 | u128::from(next)) << zeros;
        let mantissa = (both >> 65) as i64 | i64::from(both << 63 != 0);
        // From -62, so that it is added to the bias first.
        let biased = 1023 + 64 * top as u64 + 1 - u64::from(zeros);
        let value = mantissa as f64 * f64::from_bits(biased << 52);
        if self.is_negative() { -value } else { value }
    }

    fn to_integer(&self) -> Integer {
        Integer::from_magnitude(self.is_negative(), &self.magnitude())
    }
}

/// `a b`, which fits into `C` limbs.
#[inline]
fn product<const A: usize, const B: usize, const C: usize>(a: &Wide<A>, b: &Wide<B>) -> Wide<C> {
    let mut limbs = [0; C];
    for i in 0..A {
        let mut carry = 0;
        for j in 0..B {
            if i + j < C {
                (limbs[i + j], carry) = multiply_add(a.0[i], b.0[j], limbs[i + j], carry);
            }
        }
        if i + B < C {
            limbs[i + B] = carry;
        }
    }
    // Read without sign, a negative factor is too large by 2^(64 limbs); so is the product by that
    // times the other factor.
    if a.is_negative() {
        subtract_high(&mut limbs, A, &b.0);
    }
    if b.is_negative() {
        subtract_high(&mut limbs, B, &a.0);
    }
    // Limbs that neither factor reaches hold the sign alone.
    if C > A + B && limbs[A + B - 1] >> 63 == 1 {
        limbs[A + B..].fill(u64::MAX);
    }
    Wide(limbs)
}

/// Horner's rule for a polynomial of degree `D - 1` at `grid_time / 2^128`: the value times
/// `2^(128 (D - 1))`, with the product modulo `2^(64 V)`, which is exact because it is known to
/// fit.
#[inline]
fn horner<const N: usize, const V: usize, const D: usize>(
    coefficients: &[Wide<N>; D],
    grid_time: u128,
) -> Wide<V> {
    const { assert!(N + 2 * (D - 1) <= V) };
    let (low, high) = (grid_time as u64, (grid_time >> 64) as u64);
    let mut value = shifted_limbs(&coefficients[D - 1], 0);
    for step in 1..D {
        // value * grid_time + coefficient 2^(128 step)
        let mut next: [u64; V] = shifted_limbs(&coefficients[D - 1 - step], 2 * step);
        let (mut carry_low, mut carry_high) = (0, 0);
        for i in 0..V {
            (next[i], carry_low) = multiply_add(value[i], low, next[i], carry_low);
            if i > 0 {
                (next[i], carry_high) = multiply_add(value[i - 1], high, next[i], carry_high);
            }
        }
        value = next;
    }
    Wide(value)
}

/// Horner's rule for a polynomial of degree `D - 1` at `n / d`: the value times `d^(D - 1)`.
///
/// The values are below the sum of the coefficients times `d^3`, which is below `2^36`: one limb
/// more is enough, and the others hold the sign.
#[inline]
fn horner_fraction<const N: usize, const V: usize, const D: usize>(
    coefficients: &[Wide<N>; D],
    at: Fraction,
) -> Wide<V> {
    const { assert!(N < V && D <= 4) };
    let mut value: [u64; V] = shifted_limbs(&coefficients[D - 1], 0);
    let mut power = 1;
    for step in 1..D {
        power *= at.denominator;
        let mut next: [u64; V] = shifted_limbs(&coefficients[D - 1 - step], 0);
        let (mut carry, mut carry_next) = (0, 0);
        for i in 0..=N {
            (value[i], carry) = multiply_add(value[i], at.numerator, 0, carry);
            (next[i], carry_next) = multiply_add(next[i], power, value[i], carry_next);
        }
        value = next;
    }
    let sign = (value[N] as i64 >> 63) as u64;
    value[N + 1..].fill(sign);
    Wide(value)
}

/// The limbs of `number 2^(64 by)`, with its sign extended.
#[inline]
fn shifted_limbs<const N: usize, const V: usize>(number: &Wide<N>, by: usize) -> [u64; V] {
    let mut limbs = [if number.is_negative() { u64::MAX } else { 0 }; V];
    limbs[..by].fill(0);
    limbs[by..by + N].copy_from_slice(&number.0);
    limbs
}

/// `limbs -= other 2^(64 from)`, wrapping around.
#[inline]
fn subtract_high(limbs: &mut [u64], from: usize, other: &[u64]) {
    let mut borrow = false;
    for (limb, &own) in limbs.iter_mut().skip(from).zip(other) {
        (*limb, borrow) = subtract_limbs(*limb, own, borrow);
    }
}

#[cfg(test)]
mod bounds;
#[cfg(test)]
mod tests;

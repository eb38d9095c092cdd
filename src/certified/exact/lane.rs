//! Integers of fixed widths for the coefficients of a motion.
//!
//! With coordinate differences and their changes over the step below `2^b`, the bits of everything
//! that is computed are known beforehand, so that nothing can overflow:
//!
//! - *linear*: the differences themselves, `b` bits.
//! - *quadratic*: sums of at most 36 products of two of them (the largest is [`super::motion`]'s
//!   `between` of an end, whose middle coefficient has 6 times 6 terms), below `2^(2b + 6)`.
//! - *cubic*: a coefficient of `f = M . N` is a sum of at most 18 products of three, below
//!   `2^(3b + 5)`, and its Bernstein coefficients times 3 are below 6 times that, `2^(3b + 8)`.
//!
//! With a bit for the sign: `b + 1`, `2b + 7` and `3b + 9` bits.

use std::cmp::Ordering;

use super::integer::{Integer, TWO_64, multiply_add};

/// Exact numbers of one width.
pub(super) trait Number: Clone {
    /// `self + other`.
    fn add(&self, other: &Self) -> Self;
    /// `self - other`.
    fn sub(&self, other: &Self) -> Self;
    /// Compared with 0.
    fn sign(&self) -> Ordering;
    /// An approximation with a relative error below 2^-51; infinite where it is too large.
    fn to_f64(&self) -> f64;
    /// The same number.
    fn to_integer(&self) -> Integer;

    /// Whether it is 0.
    fn is_zero(&self) -> bool {
        self.sign().is_eq()
    }
}

/// Widths that go together: for differences of coordinates, their products, and products of three.
pub(super) trait Lane {
    /// Coefficients of degree 1.
    type Linear: Number;
    /// Coefficients of degree 2.
    type Quadratic: Number;
    /// Coefficients of degree 3.
    type Cubic: Number;

    /// `a b`.
    fn times(a: &Self::Linear, b: &Self::Linear) -> Self::Quadratic;
    /// `a b`.
    fn times_quadratic(a: &Self::Quadratic, b: &Self::Linear) -> Self::Cubic;
}

/// Widths of `L`, `Q` and `C` limbs.
pub(super) struct Fixed<const L: usize, const Q: usize, const C: usize>;

/// Any width, on the heap where it must be.
pub(super) struct Unlimited;

impl<const L: usize, const Q: usize, const C: usize> Fixed<L, Q, C> {
    /// The largest `b` that the widths are enough for.
    pub(super) const BITS: u32 = {
        let linear = 64 * L as u32 - 1;
        let quadratic = (64 * Q as u32 - 7) / 2;
        let cubic = (64 * C as u32 - 9) / 3;
        let least = if linear < quadratic {
            linear
        } else {
            quadratic
        };
        if least < cubic { least } else { cubic }
    };
}

impl<const L: usize, const Q: usize, const C: usize> Lane for Fixed<L, Q, C> {
    type Linear = Wide<L>;
    type Quadratic = Wide<Q>;
    type Cubic = Wide<C>;

    fn times(a: &Wide<L>, b: &Wide<L>) -> Wide<Q> {
        product(a, b)
    }

    fn times_quadratic(a: &Wide<Q>, b: &Wide<L>) -> Wide<C> {
        product(a, b)
    }
}

impl Lane for Unlimited {
    type Linear = Integer;
    type Quadratic = Integer;
    type Cubic = Integer;

    fn times(a: &Integer, b: &Integer) -> Integer {
        Integer::product(a, b)
    }

    fn times_quadratic(a: &Integer, b: &Integer) -> Integer {
        Integer::product(a, b)
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

impl<const N: usize> From<i128> for Wide<N> {
    /// The lowest limbs; the caller knows that they are enough.
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
        let mut limbs = [0; N];
        let mut carry = false;
        for i in 0..N {
            let (sum, first) = self.0[i].overflowing_add(other.0[i]);
            let (sum, second) = sum.overflowing_add(u64::from(carry));
            (limbs[i], carry) = (sum, first | second);
        }
        let sum = Wide(limbs);
        debug_assert!(
            self.is_negative() != other.is_negative() || sum.is_negative() == self.is_negative()
        );
        sum
    }

    #[inline]
    fn sub(&self, other: &Self) -> Self {
        let mut limbs = [0; N];
        let mut borrow = false;
        for i in 0..N {
            let (difference, first) = self.0[i].overflowing_sub(other.0[i]);
            let (difference, second) = difference.overflowing_sub(u64::from(borrow));
            (limbs[i], borrow) = (difference, first | second);
        }
        let difference = Wide(limbs);
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

    fn to_f64(&self) -> f64 {
        // The highest limb that is not 0 and the one below it hold at least 64 bits of the number;
        // each is rounded and so is their sum: 2^-53 three times, and 2^-64 for what is left out.
        let limbs = self.magnitude();
        let mut value = 0.0;
        let mut unit = 1.0;
        for i in 0..N {
            if limbs[i] != 0 {
                let below = if i > 0 {
                    limbs[i - 1] as f64 / TWO_64
                } else {
                    0.0
                };
                value = (limbs[i] as f64 + below) * unit;
            }
            unit *= TWO_64;
        }
        if self.is_negative() { -value } else { value }
    }

    fn to_integer(&self) -> Integer {
        Integer::from_magnitude(self.is_negative(), &self.magnitude())
    }
}

/// `a b`, which fits into `C <= A + B` limbs.
#[inline]
fn product<const A: usize, const B: usize, const C: usize>(a: &Wide<A>, b: &Wide<B>) -> Wide<C> {
    const { assert!(C <= A + B) };
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
    Wide(limbs)
}

/// `limbs -= other 2^(64 from)`, wrapping around.
#[inline]
fn subtract_high(limbs: &mut [u64], from: usize, other: &[u64]) {
    let mut borrow = false;
    for (limb, &own) in limbs[from..].iter_mut().zip(other) {
        let (difference, first) = limb.overflowing_sub(own);
        let (difference, second) = difference.overflowing_sub(u64::from(borrow));
        (*limb, borrow) = (difference, first | second);
    }
}

#[cfg(test)]
mod tests;

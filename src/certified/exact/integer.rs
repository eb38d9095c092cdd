//! Integers of any size: where the width cannot be known beforehand, or is too large to be fixed.
//!
//! Sign and magnitude. Up to [`INLINE`] limbs of 64 bits are held in place, without allocation;
//! beyond that the limbs move to the heap. The operations that evaluate polynomials work in place,
//! because a copy of the whole buffer costs more than the arithmetic.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::width::Number;

/// Limbs that are held without allocation.
///
/// Twelve hold a coefficient of degree 6, a product of six differences of coordinates of 115 bits
/// each: numbers near 1 beside some near 2^-60. Remainders come to longer values: of coordinates of
/// ordinary magnitude 16 are too few, and 20 enough (`tests/allocation.rs`). More would have to be
/// copied wherever a number moves.
pub(super) const INLINE: usize = 20;

type Limbs = SmallVec<[u64; INLINE]>;

/// An integer of any size.
///
/// The magnitude has its least significant limb first and no zero limb at its end; 0 has no limbs
/// and is not negative.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Integer {
    negative: bool,
    limbs: Limbs,
}

impl Clone for Integer {
    fn clone(&self) -> Self {
        Integer {
            negative: self.negative,
            limbs: Limbs::from_slice(&self.limbs),
        }
    }
}

impl From<i128> for Integer {
    fn from(value: i128) -> Self {
        let magnitude = value.unsigned_abs();
        Integer::from_magnitude(value < 0, &[magnitude as u64, (magnitude >> 64) as u64])
    }
}

impl Integer {
    /// 0.
    pub(super) const ZERO: Integer = Integer {
        negative: false,
        limbs: Limbs::new_const(),
    };

    /// The integer of this sign and magnitude, least significant limb first.
    pub(super) fn from_magnitude(negative: bool, limbs: &[u64]) -> Self {
        let length = limbs
            .iter()
            .rposition(|&limb| limb != 0)
            .map_or(0, |at| at + 1);
        Integer {
            negative: negative && length > 0,
            limbs: Limbs::from_slice(&limbs[..length]),
        }
    }

    /// Compared with 0.
    pub(super) fn sign(&self) -> Ordering {
        match (self.limbs.is_empty(), self.negative) {
            (true, _) => Ordering::Equal,
            (false, true) => Ordering::Less,
            (false, false) => Ordering::Greater,
        }
    }

    /// Whether it is 0.
    pub(super) fn is_zero(&self) -> bool {
        self.limbs.is_empty()
    }

    /// How many bits the magnitude has; 0 for 0.
    pub(super) fn bits(&self) -> u64 {
        match self.limbs.last() {
            Some(top) => 64 * self.limbs.len() as u64 - u64::from(top.leading_zeros()),
            None => 0,
        }
    }

    /// Replaces it by its negative.
    pub(super) fn negate(&mut self) {
        self.negative = !self.negative && !self.limbs.is_empty();
    }

    /// The 64 bits of the magnitude from bit `from` on, and whether all bits below are 0.
    pub(super) fn window(&self, from: u64) -> (u64, bool) {
        let (whole, bits) = ((from / 64) as usize, (from % 64) as u32);
        let limb = |at: usize| self.limbs.get(at).copied().unwrap_or(0);
        let both = u128::from(limb(whole + 1)) << 64 | u128::from(limb(whole));
        let below = self.limbs.iter().take(whole).all(|&limb| limb == 0);
        (
            (both >> bits) as u64,
            below && limb(whole) & ((1 << bits) - 1) == 0,
        )
    }

    /// The value as `x 2^e`: `x` is 0 or of magnitude 1 to 2^128, rounded to nearest from at least
    /// 65 bits of the number: with a relative error below `2^-53 + 2^-63`.
    pub(super) fn approximate(&self) -> (f64, i64) {
        let n = self.limbs.len();
        let magnitude = match *self.limbs.as_slice() {
            [] => return (0.0, 0),
            [low] => return (self.signed(low as f64), 0),
            [.., low, high] => (u128::from(high) << 64 | u128::from(low)) as f64,
        };
        (self.signed(magnitude), 64 * (n as i64 - 2))
    }

    /// The [approximation](Self::approximate) of the number times `2^shift`; `None` where that has
    /// less than three limbs.
    pub(super) fn approximate_shifted(&self, shift: i64) -> Option<(f64, i64)> {
        let limbs = (self.bits() as i64 + shift + 63) / 64;
        // What is below the two highest limbs.
        let below = 64 * (limbs - 2);
        let from = below - shift;
        if self.is_zero() || below <= 0 || from < 0 {
            return None;
        }
        let from = from.unsigned_abs();
        let ((low, _), (high, _)) = (self.window(from), self.window(from + 64));
        let magnitude = (u128::from(high) << 64 | u128::from(low)) as f64;
        Some((self.signed(magnitude), below))
    }

    fn signed(&self, magnitude: f64) -> f64 {
        if self.negative { -magnitude } else { magnitude }
    }

    /// `self += other 2^shift`.
    pub(super) fn add_shifted(&mut self, other: &Integer, shift: u64) {
        self.accumulate(other, shift, other.negative);
    }

    /// `self -= other 2^shift`.
    pub(super) fn sub_shifted(&mut self, other: &Integer, shift: u64) {
        self.accumulate(other, shift, !other.negative);
    }

    /// Adds the magnitude of `other 2^shift` with the given sign.
    fn accumulate(&mut self, other: &Integer, shift: u64, negative: bool) {
        if other.is_zero() {
            return;
        }
        let (whole, bits) = ((shift / 64) as usize, (shift % 64) as u32);
        let length = self.limbs.len().max(other.limbs.len() + whole + 1);
        let same_way = self.is_zero() || self.negative == negative;
        self.limbs.resize(length, 0);
        if same_way {
            self.negative = negative;
            let carry = for_shifted(&mut self.limbs, &other.limbs, whole, bits, add_limbs);
            if carry {
                self.limbs.push(1);
            }
        } else if for_shifted(&mut self.limbs, &other.limbs, whole, bits, subtract_limbs) {
            // The difference wrapped around: it is minus its two's complement.
            negate_wrapping(&mut self.limbs);
            self.negative = negative;
        }
        self.trim();
    }

    /// `self *= other`.
    pub(super) fn mul_assign(&mut self, other: &Integer) {
        match *other.limbs.as_slice() {
            [] => *self = Integer::default(),
            [factor] => {
                let mut carry = 0;
                for limb in &mut self.limbs {
                    (*limb, carry) = multiply_add(*limb, factor, 0, carry);
                }
                if carry != 0 {
                    self.limbs.push(carry);
                }
                self.negative = !self.is_zero() && self.negative != other.negative;
            }
            _ => *self = Integer::product(self, other),
        }
    }

    /// `a b`.
    pub(super) fn product(a: &Integer, b: &Integer) -> Integer {
        let mut product = Integer {
            negative: a.negative != b.negative,
            limbs: Limbs::from_elem(0, a.limbs.len() + b.limbs.len()),
        };
        multiply_into(&mut product.limbs, &a.limbs, &b.limbs);
        product.trim();
        product
    }

    /// Divides it by a divisor, which is above 0 (Jebelean, "An algorithm for exact division",
    /// 1993).
    ///
    /// Modulo `2^64` a limb of the quotient is the lowest limb of what is left times the inverse of
    /// the lowest one of the divisor, which is made odd.
    pub(super) fn divide_exactly(&mut self, divisor: &Integer) {
        let zeros = divisor.trailing_zeros();
        let (mut rest, divisor) = (self.shifted_down(zeros), divisor.shifted_down(zeros));
        let Some(&low) = divisor.limbs.first() else {
            return;
        };
        // Right in 3 bits at first, and in twice as many after each step.
        let inverse = (0..5).fold(low, |inverse: u64, _| {
            let error = low.wrapping_mul(inverse).wrapping_sub(2).wrapping_neg();
            inverse.wrapping_mul(error)
        });
        for at in 0..rest.limbs.len() {
            let limb = rest.limbs[at].wrapping_mul(inverse);
            let (mut carry, mut borrow) = (0, false);
            let length = divisor.limbs.len().min(rest.limbs.len() - at);
            let (first, others) = rest.limbs[at..].split_at_mut(length);
            for (own, &other) in first.iter_mut().zip(&divisor.limbs) {
                let product;
                (product, carry) = multiply_add(limb, other, 0, carry);
                (*own, borrow) = subtract_limbs(*own, product, borrow);
            }
            for own in others {
                (*own, borrow) = subtract_limbs(*own, carry, borrow);
                carry = 0;
                if !borrow {
                    break;
                }
            }
            rest.limbs[at] = limb;
        }
        rest.trim();
        *self = rest;
    }

    /// The limbs of the magnitude, the least significant one first.
    pub(super) fn limbs(&self) -> &[u64] {
        &self.limbs
    }

    /// How many of its lowest bits are 0; 0 for 0.
    pub(super) fn trailing_zeros(&self) -> u64 {
        let low = self.limbs.iter().position(|&limb| limb != 0);
        low.map_or(0, |at| {
            64 * at as u64 + u64::from(self.limbs[at].trailing_zeros())
        })
    }

    /// `self / 2^shift`, rounded towards 0.
    pub(super) fn shifted_down(&self, shift: u64) -> Integer {
        let (whole, bits) = ((shift / 64) as usize, (shift % 64) as u32);
        let kept = self.limbs.get(whole..).unwrap_or_default();
        let next = kept.iter().skip(1).chain(&[0]);
        let limbs = kept
            .iter()
            .zip(next)
            .map(|(&low, &high)| ((u128::from(high) << 64 | u128::from(low)) >> bits) as u64);
        let limbs: Limbs = limbs.collect();
        Integer::from_magnitude(self.negative, &limbs)
    }

    /// `|self|`.
    pub(super) fn magnitude(&self) -> Integer {
        let mut magnitude = self.clone();
        magnitude.negative = false;
        magnitude
    }

    /// Whether `|self| > |other|`.
    pub(super) fn exceeds(&self, other: &Integer) -> bool {
        self.compare_magnitude(other).is_gt()
    }

    fn compare_magnitude(&self, other: &Integer) -> Ordering {
        let lengths = self.limbs.len().cmp(&other.limbs.len());
        lengths.then_with(|| self.limbs.iter().rev().cmp(other.limbs.iter().rev()))
    }

    /// `a + b`.
    pub(super) fn sum(a: &Integer, b: &Integer) -> Integer {
        let mut sum = a.clone();
        sum.add_shifted(b, 0);
        sum
    }

    /// `a - b`.
    pub(super) fn difference(a: &Integer, b: &Integer) -> Integer {
        let mut difference = a.clone();
        difference.sub_shifted(b, 0);
        difference
    }

    /// `self 2^shift`.
    pub(super) fn shifted(&self, shift: u64) -> Integer {
        let mut shifted = Integer::default();
        shifted.add_shifted(self, shift);
        shifted
    }

    /// `factor self`, for a small factor.
    pub(super) fn times(&self, factor: i64) -> Integer {
        let mut product = self.clone();
        product.mul_assign(&Integer::from(i128::from(factor)));
        product
    }

    fn trim(&mut self) {
        let length = self
            .limbs
            .iter()
            .rposition(|&limb| limb != 0)
            .map_or(0, |at| at + 1);
        self.limbs.truncate(length);
        self.negative &= length > 0;
    }
}

impl PartialOrd for Integer {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Integer {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self.negative, other.negative) {
            (false, true) => Ordering::Greater,
            (true, false) => Ordering::Less,
            (false, false) => self.compare_magnitude(other),
            (true, true) => other.compare_magnitude(self),
        }
    }
}

impl Number for Integer {
    fn add(&self, other: &Self) -> Self {
        Integer::sum(self, other)
    }

    fn sub(&self, other: &Self) -> Self {
        Integer::difference(self, other)
    }

    fn sign(&self) -> Ordering {
        self.sign()
    }

    fn to_f64(&self) -> f64 {
        let (value, exponent) = self.approximate();
        scale(value, exponent)
    }

    fn to_integer(&self) -> Integer {
        self.clone()
    }
}

/// `n / d` for `0 <= n <= d` and `d > 0`, with a relative error of about 3/2 2^-52: 2^-53 for each
/// of the two and for their quotient.
pub(super) fn ratio(n: &Integer, d: &Integer) -> f64 {
    let ((n, n_exponent), (d, d_exponent)) = (n.approximate(), d.approximate());
    scale(n / d, n_exponent - d_exponent)
}

/// 2^64.
pub(super) const TWO_64: f64 = 18_446_744_073_709_551_616.0;

/// `value 2^exponent`, infinite where it is too large for an `f64`.
pub(super) fn scale(value: f64, exponent: i64) -> f64 {
    // Three steps reach from the largest f64 to the smallest and past either end.
    let exponent = exponent.clamp(-2200, 2200) as i32;
    let third = exponent / 3;
    value * power(third) * power(third) * power(exponent - 2 * third)
}

/// `2^exponent` for an exponent in the range of normal numbers.
fn power(exponent: i32) -> f64 {
    f64::from_bits(((1023 + i64::from(exponent)) as u64) << 52)
}

/// A limb of a sum, and the carry.
pub(super) fn add_limbs(a: u64, b: u64, carry: bool) -> (u64, bool) {
    let (sum, first) = a.overflowing_add(b);
    let (sum, second) = sum.overflowing_add(u64::from(carry));
    (sum, first | second)
}

/// A limb of a difference, and the borrow.
pub(super) fn subtract_limbs(a: u64, b: u64, borrow: bool) -> (u64, bool) {
    let (difference, first) = a.overflowing_sub(b);
    let (difference, second) = difference.overflowing_sub(u64::from(borrow));
    (difference, first | second)
}

/// Applies a step to every limb of `to` with the limbs of `from 2^(64 whole + bits)`; what remains
/// is the last carry.
fn for_shifted(
    to: &mut [u64],
    from: &[u64],
    whole: usize,
    bits: u32,
    step: impl Fn(u64, u64, bool) -> (u64, bool),
) -> bool {
    let (mut carry, mut lower) = (false, 0);
    let mut limbs = to.iter_mut().skip(whole);
    // In this order: `zip` takes from the first one also where the second one has ended.
    for (&own, limb) in from.iter().zip(limbs.by_ref()) {
        let shifted = ((u128::from(own) << 64 | u128::from(lower)) << bits >> 64) as u64;
        (*limb, carry) = step(*limb, shifted, carry);
        lower = own;
    }
    let mut last = (u128::from(lower) << bits >> 64) as u64;
    for limb in limbs {
        if last == 0 && !carry {
            break;
        }
        (*limb, carry) = step(*limb, last, carry);
        last = 0;
    }
    carry
}

/// The two's complement.
fn negate_wrapping(limbs: &mut [u64]) {
    let mut carry = true;
    for limb in limbs {
        (*limb, carry) = (!*limb).overflowing_add(u64::from(carry));
    }
}

/// `a b + c + d` as low and high limb; it always fits.
pub(super) fn multiply_add(a: u64, b: u64, c: u64, d: u64) -> (u64, u64) {
    let sum = u128::from(a) * u128::from(b) + u128::from(c) + u128::from(d);
    (sum as u64, (sum >> 64) as u64)
}

/// Puts the product of two magnitudes into `to`, which has a limb for each of theirs and is 0.
///
/// Long ones by Karatsuba's rule: with halves `a = a1 x + a0` and `b = b1 x + b0`, the middle term
/// `a1 b0 + a0 b1` is `(a1 + a0) (b1 + b0) - a1 b1 - a0 b0`. Ends: each part is shorter.
fn multiply_into(to: &mut [u64], a: &[u64], b: &[u64]) {
    let (long, short) = if a.len() < b.len() { (b, a) } else { (a, b) };
    let half = long.len().div_ceil(2);
    if short.len() < KARATSUBA {
        multiply_plainly(to, long, short);
    } else if short.len() <= half {
        // In parts as long as the shorter one.
        for (i, part) in long.chunks(short.len()).enumerate() {
            let mut product = vec![0; part.len() + short.len()];
            multiply_into(&mut product, part, short);
            for_shifted(&mut to[i * short.len()..], &product, 0, 0, add_limbs);
        }
    } else {
        let ((a0, a1), (b0, b1)) = (long.split_at(half), short.split_at(half));
        let (low, high) = to.split_at_mut(2 * half);
        multiply_into(low, a0, b0);
        multiply_into(high, a1, b1);
        let (a, b) = (sum_of_limbs(a0, a1), sum_of_limbs(b0, b1));
        let mut middle = vec![0; a.len() + b.len()];
        multiply_into(&mut middle, &a, &b);
        for_shifted(&mut middle, low, 0, 0, subtract_limbs);
        for_shifted(&mut middle, high, 0, 0, subtract_limbs);
        // Without the zeros at its end, which may reach beyond the product.
        let length = middle.iter().rposition(|&limb| limb != 0);
        let middle = &middle[..length.map_or(0, |at| at + 1)];
        for_shifted(&mut to[half..], middle, 0, 0, add_limbs);
    }
}

/// From so many limbs on the halves are multiplied.
const KARATSUBA: usize = 32;

/// The sum of two magnitudes, the first not shorter, with a limb more.
fn sum_of_limbs(a: &[u64], b: &[u64]) -> Vec<u64> {
    let mut sum = a.to_vec();
    sum.push(0);
    for_shifted(&mut sum, b, 0, 0, add_limbs);
    sum
}

/// Row by row, two rows at a time: the carries of two do not wait for each other, and a limb of `to`
/// is read and written once for both.
fn multiply_plainly(to: &mut [u64], a: &[u64], b: &[u64]) {
    let mut rows = b.chunks_exact(2);
    for (i, pair) in (0..).step_by(2).zip(&mut rows) {
        let (x, y) = (pair[0], pair[1]);
        let (row, rest) = to[i..].split_at_mut(a.len());
        let (mut carry, mut next, mut before) = (0, 0, 0);
        for (limb, &z) in row.iter_mut().zip(a) {
            let low;
            (low, carry) = multiply_add(x, z, *limb, carry);
            (*limb, next) = multiply_add(y, before, low, next);
            before = z;
        }
        // What is left: the first row's carry, and the second row's last limb.
        (rest[0], rest[1]) = multiply_add(y, before, carry, next);
    }
    if let &[x] = rows.remainder() {
        let (row, rest) = to[b.len() - 1..].split_at_mut(a.len());
        let mut carry = 0;
        for (limb, &z) in row.iter_mut().zip(a) {
            (*limb, carry) = multiply_add(x, z, *limb, carry);
        }
        rest[0] = carry;
    }
}

#[cfg(test)]
mod tests;

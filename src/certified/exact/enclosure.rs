//! The value of a polynomial at a time, as far as a question needs it.
//!
//! At a time with a long numerator the exact value is many times as long as what tells its sign.
//! So Horner's rule goes on with as many bits as are asked for, and an error bound; more of them
//! are taken until they tell, and all of them in the end. Everything is integers: what is told does
//! not depend on rounding in floating point, and is always that of the exact value
//! ([`Poly::evaluate`]).

use std::cell::Cell;
use std::cmp::Ordering;

use super::dyadic::Dyadic;
use super::integer::Integer;
use super::poly::Poly;

/// A number within `value 2^unit` plus or minus `error 2^unit`.
pub(super) struct Enclosure {
    value: Integer,
    error: Integer,
    unit: i64,
}

/// The bits that are tried first.
pub(super) const FIRST: u64 = 128;

/// Exact values with so many bits or fewer are computed at once.
const SHORT: u64 = 1024;

impl Enclosure {
    /// The sign, if it is known.
    fn sign(&self) -> Option<Ordering> {
        self.value.exceeds(&self.error).then(|| self.value.sign())
    }

    /// The least and the largest number, in multiples of `2^unit`; `None` if these are not whole.
    pub(super) fn bounds(&self, unit: i64) -> Option<[Integer; 2]> {
        let shift = u64::try_from(self.unit - unit).ok()?;
        Some([
            Integer::difference(&self.value, &self.error).shifted(shift),
            Integer::sum(&self.value, &self.error).shifted(shift),
        ])
    }
}

impl<const N: usize> Poly<N> {
    /// The value at a time, which is not 0, with an error of at most `(3 n + 1) 2^-bits` of the sum
    /// of the magnitudes of its terms; `n` is the degree.
    ///
    /// With `2^-(k + 1) <= t < 2^-k`, the term of `c_i` is below `2^(length of c_i - i k)`; let `s`
    /// be the largest of these exponents. Horner's rule with `v_i = c_i + t v_(i+1)`, in multiples
    /// of `2^(s - bits + i k)`, is `v_i = c_i + (2^k t) v_(i+1)`, and no `|v_i|` is above
    /// `(n + 1) 2^bits` of them. A coefficient is cut off at such a multiple, and so is the product,
    /// by less than 1 each; `2^k t` is cut off to `bits + 8` bits, by which the product changes by
    /// less than 1 (`n` is below 127). The error of `v_(i+1)` is not enlarged, as `2^k t` is below
    /// 1. So each step adds 3 at most, and the first coefficient 1.
    pub(super) fn enclose(&self, at: &Dyadic, bits: u64) -> Enclosure {
        let length = at.numerator.bits();
        let k = at.exponent as i64 - length as i64;
        let kept = length.min(bits + 8);
        let factor = at.numerator.shifted_down(length - kept);
        let unit = self.size(at) - bits as i64;
        let mut value = Integer::ZERO;
        // Ends: one turn for each coefficient.
        for (i, coefficient) in self.coefficients().iter().enumerate().rev() {
            value = Integer::product(&value, &factor).shifted_down(kept);
            let own = unit + i as i64 * k;
            let cut = match own {
                0.. => coefficient.shifted_down(own.unsigned_abs()),
                _ => coefficient.shifted(own.unsigned_abs()),
            };
            value.add_shifted(&cut, 0);
        }
        Enclosure {
            value,
            error: Integer::from(3 * self.degree() as i128 + 1),
            unit,
        }
    }

    /// The largest `s` such that a term may be as large as `2^s` at a time, which is not 0.
    fn size(&self, at: &Dyadic) -> i64 {
        let k = at.exponent as i64 - at.numerator.bits() as i64;
        let terms = (0i64..).zip(self.coefficients());
        let terms = terms.filter(|(_, c)| !c.is_zero());
        let size = terms.map(|(i, c)| c.bits() as i64 - i * k).max();
        size.unwrap_or(0)
    }

    /// What `tell` says of an enclosure of the value at a time, with more and more bits; `None`
    /// where the exact value is as cheap.
    ///
    /// `enough` is the bits to begin with and becomes those that are tried: where the next question
    /// near by may begin.
    pub(super) fn told<T>(
        &self,
        at: &Dyadic,
        enough: &Cell<u64>,
        tell: impl Fn(&Enclosure) -> Option<T>,
    ) -> Option<T> {
        let whole = self.value_bits(at);
        if whole <= SHORT || at.numerator.is_zero() {
            return None;
        }
        let mut bits = enough.get();
        // Ends: the bits are doubled, up to a share of those of the exact value.
        while 2 * bits <= whole {
            enough.set(bits);
            if let Some(told) = tell(&self.enclose(at, bits)) {
                return Some(told);
            }
            bits *= 2;
        }
        None
    }

    /// About the bits of the exact value.
    fn value_bits(&self, at: &Dyadic) -> u64 {
        let coefficients = self.coefficients().iter().map(Integer::bits);
        coefficients.max().unwrap_or(0) + self.degree() as u64 * at.exponent
    }

    /// The sign of the value at a time.
    pub(super) fn sign_at(&self, at: &Dyadic) -> Ordering {
        self.sign_near(at, &Cell::new(FIRST))
    }

    /// The same, from the bits that were enough near by.
    pub(super) fn sign_near(&self, at: &Dyadic, enough: &Cell<u64>) -> Ordering {
        let told = self.told(at, enough, Enclosure::sign);
        told.unwrap_or_else(|| self.evaluate(at).sign())
    }

    /// The sign of [`evaluate`](Self::evaluate) at a time, and its
    /// [approximation](Integer::approximate), bit for bit.
    pub(super) fn approximate_at(&self, at: &Dyadic, enough: &Cell<u64>) -> (Ordering, (f64, i64)) {
        let scale = self.degree() as i64 * at.exponent as i64;
        let told = self.told(at, enough, |enclosure| {
            let sign = enclosure.sign()?;
            let unit = enclosure.unit + scale;
            let [low, high] = enclosure.bounds(enclosure.unit)?;
            let [low, high] = [low, high].map(|bound| bound.approximate_shifted(unit));
            let low = low?;
            (Some(low) == high).then_some((sign, low))
        });
        told.unwrap_or_else(|| {
            let value = self.evaluate(at);
            (value.sign(), value.approximate())
        })
    }

    /// The value at a time as `x 2^e`, where `x` has a relative error of about `2^-bits`, and the
    /// right sign.
    ///
    /// `lost` is how many leading bits are expected to cancel, and becomes how many do.
    pub(super) fn leading_at(&self, at: &Dyadic, lost: &mut u64, bits: u64) -> (Integer, i64) {
        let tried = Cell::new(*lost + bits + 16);
        let told = self.told(at, &tried, |Enclosure { value, error, unit }| {
            let is_known = value.bits() > error.bits() + bits;
            is_known.then(|| (value.clone(), *unit))
        });
        if let Some((value, unit)) = told {
            *lost = tried.get().saturating_sub(value.bits());
            return (value, unit);
        }
        let scale = self.degree() as i64 * at.exponent as i64;
        let value = self.evaluate(at);
        *lost = match at.numerator.is_zero() {
            true => 0,
            false => (self.size(at) + scale - value.bits() as i64).max(0) as u64,
        };
        (value, -scale)
    }

    /// The sign of the value at a time, if its magnitude is above `2^exponent`. `None` says that it
    /// is not, or not by much.
    pub(super) fn sign_beyond(&self, at: &Dyadic, exponent: i64) -> Option<Ordering> {
        if at.numerator.is_zero() {
            let value = self.coefficient(0);
            let is_beyond = !value.is_zero() && value.bits() as i64 > exponent + 1;
            return is_beyond.then(|| value.sign());
        }
        // Up to a unit of which the error is less than that.
        let (mut bits, mut is_last) = (16, false);
        // Ends: more bits each time, up to those.
        loop {
            let enclosure = self.enclose(at, bits);
            let least = Integer::difference(&enclosure.value.magnitude(), &enclosure.error);
            let size = least.bits() as i64 + enclosure.unit;
            if least.sign().is_gt() && size > exponent + 1 {
                return Some(enclosure.value.sign());
            }
            let most = enclosure.unit + bits as i64 - exponent + enclosure.error.bits() as i64;
            if is_last || most <= bits as i64 {
                return None;
            }
            let most = most.unsigned_abs();
            (bits, is_last) = (most.min(4 * bits), most <= 4 * bits);
        }
    }
}

#[cfg(test)]
mod tests;

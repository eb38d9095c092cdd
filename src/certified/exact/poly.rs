//! Polynomials of degree at most 3 with integers of any size as coefficients.

use std::cmp::Ordering;

use super::dyadic::Dyadic;
use super::integer::Integer;
use super::lane::Number;

/// A polynomial of degree at most 3; the coefficients beyond its degree are 0.
#[derive(Clone, Debug, Default)]
pub(super) struct Poly {
    coefficients: [Integer; 4],
    /// One more than the degree; 0 for the polynomial that is 0.
    length: usize,
}

impl Poly {
    /// The polynomial with these coefficients, at most four, the constant one first.
    pub(super) fn new<Z: Number>(coefficients: &[Z]) -> Self {
        let mut poly = Poly::default();
        for (own, coefficient) in poly.coefficients.iter_mut().zip(coefficients) {
            *own = coefficient.to_integer();
        }
        poly.trim(coefficients.len());
        poly
    }

    fn trim(&mut self, length: usize) {
        let used = self.coefficients[..length]
            .iter()
            .rposition(|c| !c.is_zero());
        self.length = used.map_or(0, |at| at + 1);
    }

    /// The coefficients up to the leading one.
    pub(super) fn coefficients(&self) -> &[Integer] {
        &self.coefficients[..self.length]
    }

    /// The coefficient of `t^i`.
    pub(super) fn coefficient(&self, i: usize) -> &Integer {
        &self.coefficients[i]
    }

    /// Whether it is identically 0.
    pub(super) fn is_zero(&self) -> bool {
        self.length == 0
    }

    /// The degree; 0 for the polynomial that is 0.
    pub(super) fn degree(&self) -> usize {
        self.length.saturating_sub(1)
    }

    /// `2^(exponent degree)` times the value at a time.
    pub(super) fn evaluate(&self, at: &Dyadic) -> Integer {
        let Some((leading, lower)) = self.coefficients().split_last() else {
            return Integer::default();
        };
        let mut value = leading.clone();
        for (coefficient, step) in lower.iter().rev().zip(1..) {
            value.mul_assign(&at.numerator);
            value.add_shifted(coefficient, step * at.exponent);
        }
        value
    }

    /// `2^(exponent degree)` times the value at a time, for a degree that is at least its own.
    pub(super) fn evaluate_as(&self, degree: usize, at: &Dyadic) -> Integer {
        let value = self.evaluate(at);
        match (degree - self.degree()) as u64 * at.exponent {
            0 => value,
            missing => value.shifted(missing),
        }
    }

    /// The sign of the value at a time.
    pub(super) fn sign_at(&self, at: &Dyadic) -> Ordering {
        self.evaluate(at).sign()
    }

    /// A positive multiple of the remainder of a division by `divisor`, which is not 0.
    pub(super) fn remainder(mut self, divisor: &Poly) -> Poly {
        let Some((leading, lower)) = divisor.coefficients().split_last() else {
            return self;
        };
        while self.length >= divisor.length {
            // |leading| self - (own leading term / leading term) |leading| divisor
            let top = self.length - 1;
            let mut own = std::mem::take(&mut self.coefficients[top]);
            if leading.sign().is_lt() {
                own.negate();
            }
            for coefficient in &mut self.coefficients[..top] {
                coefficient.mul_assign(leading);
                if leading.sign().is_lt() {
                    coefficient.negate();
                }
            }
            let shift = self.length - divisor.length;
            for (coefficient, other) in self.coefficients[shift..].iter_mut().zip(lower) {
                coefficient.sub_shifted(&Integer::product(&own, other), 0);
            }
            self.trim(top);
        }
        self
    }

    /// Replaces it by its negative.
    pub(super) fn negate(&mut self) {
        self.coefficients.iter_mut().for_each(Integer::negate);
    }
}

#[cfg(test)]
mod tests;

//! Polynomials of small degree with integers of any size as coefficients.

use std::array;
use std::cmp::Ordering;

use super::dyadic::Dyadic;
use super::integer::Integer;
use super::lane::Number;

/// A polynomial of degree below `N`; the coefficients beyond its degree are 0.
#[derive(Clone, Debug)]
pub(super) struct Poly<const N: usize = 4> {
    coefficients: [Integer; N],
    /// One more than the degree; 0 for the polynomial that is 0.
    length: usize,
}

impl<const N: usize> Default for Poly<N> {
    fn default() -> Self {
        Poly {
            coefficients: array::from_fn(|_| Integer::default()),
            length: 0,
        }
    }
}

impl<const N: usize> Poly<N> {
    /// The polynomial with these coefficients, at most `N`, the constant one first.
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

    /// The remainder of a division by `divisor`, which is not 0, times the magnitude of its leading
    /// coefficient to the power of one more than the difference of the degrees.
    pub(super) fn remainder(mut self, divisor: &Self) -> Self {
        let Some((leading, lower)) = divisor.coefficients().split_last() else {
            return self;
        };
        for top in (divisor.degree()..self.length).rev() {
            // |leading| self - (own leading term / leading term) |leading| divisor
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
            let shift = top - divisor.degree();
            for (coefficient, other) in self.coefficients[shift..].iter_mut().zip(lower) {
                coefficient.sub_shifted(&Integer::product(&own, other), 0);
            }
        }
        self.trim(self.length.min(divisor.degree()));
        self
    }

    /// A positive or negative multiple of the quotient of a division by `divisor`, which is a divisor.
    pub(super) fn quotient(mut self, divisor: &Self) -> Self {
        let mut quotient = Self::default();
        let Some((leading, lower)) = divisor.coefficients().split_last() else {
            return quotient;
        };
        for top in (divisor.degree()..self.length).rev() {
            let shift = top - divisor.degree();
            let own = std::mem::take(&mut self.coefficients[top]);
            let rest = self.coefficients[..top].iter_mut();
            let found = quotient.coefficients[shift..].iter_mut();
            rest.chain(found).for_each(|c| c.mul_assign(leading));
            for (coefficient, other) in self.coefficients[shift..].iter_mut().zip(lower) {
                coefficient.sub_shifted(&Integer::product(&own, other), 0);
            }
            quotient.coefficients[shift] = own;
        }
        quotient.trim(N);
        quotient
    }

    /// `a + b`.
    pub(super) fn sum(a: &Self, b: &Self) -> Self {
        let mut sum = a.clone();
        for (own, other) in sum.coefficients.iter_mut().zip(b.coefficients()) {
            own.add_shifted(other, 0);
        }
        sum.trim(a.length.max(b.length));
        sum
    }

    /// `a - b`.
    pub(super) fn difference(a: &Self, b: &Self) -> Self {
        let mut difference = a.clone();
        for (own, other) in difference.coefficients.iter_mut().zip(b.coefficients()) {
            own.sub_shifted(other, 0);
        }
        difference.trim(a.length.max(b.length));
        difference
    }

    /// `a b`, of a degree below `N`.
    pub(super) fn product(a: &Self, b: &Self) -> Self {
        let mut product = Self::default();
        for (i, x) in a.coefficients().iter().enumerate() {
            for (own, y) in product.coefficients[i..].iter_mut().zip(b.coefficients()) {
                own.add_shifted(&Integer::product(x, y), 0);
            }
        }
        product.trim(N);
        product
    }

    /// The derivative.
    pub(super) fn derivative(&self) -> Self {
        let mut derivative = Self::default();
        let terms = self.coefficients().iter().zip(0..).skip(1);
        for (own, (coefficient, i)) in derivative.coefficients.iter_mut().zip(terms) {
            *own = coefficient.times(i);
        }
        derivative.trim(self.degree());
        derivative
    }

    /// Divides every coefficient by a divisor of all of them, which is above 0.
    pub(super) fn divide_exactly(&mut self, divisor: &Integer) {
        let used = self.coefficients[..self.length].iter_mut();
        used.for_each(|coefficient| coefficient.divide_exactly(divisor));
    }

    /// Replaces it by its negative.
    pub(super) fn negate(&mut self) {
        self.coefficients.iter_mut().for_each(Integer::negate);
    }
}

#[cfg(test)]
mod tests;

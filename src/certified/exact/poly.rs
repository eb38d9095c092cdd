//! Polynomials of small degree with integers of any size as coefficients.

use smallvec::SmallVec;

use super::dyadic::Dyadic;
use super::integer::Integer;
use super::width::Number;

/// A polynomial, of which `N` coefficients are held in place; 0 where moving it costs more than
/// finding it on the heap.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Poly<const N: usize = 4> {
    /// Up to the leading one, which is not 0.
    coefficients: SmallVec<[Integer; N]>,
}

impl<const N: usize> Default for Poly<N> {
    fn default() -> Self {
        Poly {
            coefficients: SmallVec::new(),
        }
    }
}

static ZERO: Integer = Integer::ZERO;

impl<const N: usize> Poly<N> {
    /// The polynomial with these coefficients, the constant one first.
    pub(super) fn new<Z: Number>(coefficients: &[Z]) -> Self {
        Self::of(coefficients.iter().map(Number::to_integer).collect())
    }

    fn of(coefficients: SmallVec<[Integer; N]>) -> Self {
        let mut poly = Poly { coefficients };
        poly.trim();
        poly
    }

    fn trim(&mut self) {
        let used = self.coefficients.iter().rposition(|c| !c.is_zero());
        self.coefficients.truncate(used.map_or(0, |at| at + 1));
    }

    /// The coefficients up to the leading one.
    pub(super) fn coefficients(&self) -> &[Integer] {
        &self.coefficients
    }

    /// The coefficient of `t^i`.
    pub(super) fn coefficient(&self, i: usize) -> &Integer {
        self.coefficients.get(i).unwrap_or(&ZERO)
    }

    /// Whether it is identically 0.
    pub(super) fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// The degree; 0 for the polynomial that is 0.
    pub(super) fn degree(&self) -> usize {
        self.coefficients.len().saturating_sub(1)
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

    /// The remainder of a division by `divisor`, which is not 0, times the magnitude of its leading
    /// coefficient to the power of one more than the difference of the degrees.
    pub(super) fn remainder(mut self, divisor: &Self) -> Self {
        let Some((leading, lower)) = divisor.coefficients().split_last() else {
            return self;
        };
        // Ends: each turn takes a coefficient away.
        while self.coefficients.len() > divisor.degree() {
            let Some(mut own) = self.coefficients.pop() else {
                break;
            };
            // |leading| self - (own leading term / leading term) |leading| divisor
            if leading.sign().is_lt() {
                own.negate();
            }
            for coefficient in &mut self.coefficients {
                coefficient.mul_assign(leading);
                if leading.sign().is_lt() {
                    coefficient.negate();
                }
            }
            let shift = self.coefficients.len() - divisor.degree();
            for (coefficient, other) in self.coefficients[shift..].iter_mut().zip(lower) {
                coefficient.sub_shifted(&Integer::product(&own, other), 0);
            }
        }
        self.trim();
        self
    }

    /// A multiple of the quotient of a division by `divisor`, which is a divisor over the
    /// rationals.
    ///
    /// Times its leading coefficient `l`, the polynomial is a multiple over the integers of that
    /// multiple of the divisor whose leading coefficient is `l` too (Gauss's lemma).
    pub(super) fn quotient(self, divisor: &Self) -> Self {
        let (Some(leading), Some(other)) = (self.coefficients.last(), divisor.coefficients.last())
        else {
            return Self::default();
        };
        let (leading, other) = (leading.magnitude(), other.magnitude());
        let mut divisor = divisor.clone();
        for coefficient in &mut divisor.coefficients {
            coefficient.mul_assign(&leading);
            coefficient.divide_exactly(&other);
        }
        self.times(&leading).divide_by(&divisor)
    }

    /// The quotient of the polynomial, times the magnitude of the leading coefficient of `divisor`,
    /// and `divisor`, which is not 0; `None` if it has a remainder or is not one of integers.
    pub(super) fn divided(&self, divisor: &Self) -> Option<Self> {
        let multiple = self
            .clone()
            .times(&divisor.coefficients.last()?.magnitude());
        let quotient = multiple.clone().divide_by(divisor);
        (Self::product(&quotient, divisor) == multiple).then_some(quotient)
    }

    /// The quotient by a divisor over the integers; any polynomial by another one.
    fn divide_by(mut self, divisor: &Self) -> Self {
        let degree = divisor.degree();
        let Some(leading) = divisor.coefficients.last() else {
            return Self::default();
        };
        let magnitude = leading.magnitude();
        let mut quotient = SmallVec::new();
        // Ends: each turn takes a coefficient away.
        while self.coefficients.len() > degree
            && let Some(mut own) = self.coefficients.pop()
        {
            own.divide_exactly(&magnitude);
            if leading.sign().is_lt() {
                own.negate();
            }
            let shift = self.coefficients.len() - degree;
            let rest = self.coefficients[shift..].iter_mut();
            for (coefficient, other) in rest.zip(divisor.coefficients()) {
                coefficient.sub_shifted(&Integer::product(&own, other), 0);
            }
            quotient.push(own);
        }
        quotient.reverse();
        Self::of(quotient)
    }

    /// `factor` times the polynomial.
    fn times(mut self, factor: &Integer) -> Self {
        let used = self.coefficients.iter_mut();
        used.for_each(|coefficient| coefficient.mul_assign(factor));
        self
    }

    /// `2^shift` times the polynomial.
    pub(super) fn shifted(&self, shift: u64) -> Self {
        Self::of(
            self.coefficients()
                .iter()
                .map(|c| c.shifted(shift))
                .collect(),
        )
    }

    /// Divides it by the largest power of two that divides all coefficients.
    pub(super) fn reduce(&mut self) {
        let used = self.coefficients.iter().filter(|c| !c.is_zero());
        let zeros = used.map(Integer::trailing_zeros).min().unwrap_or(0);
        if zeros > 0 {
            let all = self.coefficients.iter_mut();
            all.for_each(|coefficient| *coefficient = coefficient.shifted_down(zeros));
        }
    }

    /// `a + b`.
    pub(super) fn sum(a: &Self, b: &Self) -> Self {
        Self::combination(a, b, Integer::add_shifted)
    }

    /// `a - b`.
    pub(super) fn difference(a: &Self, b: &Self) -> Self {
        Self::combination(a, b, Integer::sub_shifted)
    }

    fn combination(a: &Self, b: &Self, combine: fn(&mut Integer, &Integer, u64)) -> Self {
        let length = a.coefficients.len().max(b.coefficients.len());
        let coefficient = |i: usize| {
            let mut own = a.coefficient(i).clone();
            combine(&mut own, b.coefficient(i), 0);
            own
        };
        Self::of((0..length).map(coefficient).collect())
    }

    /// `a b`.
    pub(super) fn product(a: &Self, b: &Self) -> Self {
        let (p, q) = (a.coefficients(), b.coefficients());
        if p.is_empty() || q.is_empty() {
            return Self::default();
        }
        let coefficient = |i: usize| {
            let first = i.saturating_sub(q.len() - 1);
            let mut sum = Integer::ZERO;
            for j in first..p.len().min(i + 1) {
                sum.add_shifted(&Integer::product(&p[j], &q[i - j]), 0);
            }
            sum
        };
        Self::of((0..p.len() + q.len() - 1).map(coefficient).collect())
    }

    /// The derivative.
    pub(super) fn derivative(&self) -> Self {
        let terms = self.coefficients().iter().zip(0..).skip(1);
        Self::of(terms.map(|(coefficient, i)| coefficient.times(i)).collect())
    }

    /// Divides every coefficient by a divisor of all of them, which is above 0.
    pub(super) fn divide_exactly(&mut self, divisor: &Integer) {
        let used = self.coefficients.iter_mut();
        used.for_each(|coefficient| coefficient.divide_exactly(divisor));
    }

    /// Replaces it by its negative.
    pub(super) fn negate(&mut self) {
        self.coefficients.iter_mut().for_each(Integer::negate);
    }
}

#[cfg(test)]
mod tests;

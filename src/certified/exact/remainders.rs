//! Signed remainder sequences in integers.
//!
//! `p, q, -rem(p, q), ...`: each is minus the remainder of the two before it, up to a positive
//! factor. Without division the coefficients would grow exponentially. What one remainder was
//! multiplied by is a factor of the next but one (Collins, "Subresultants and reduced polynomial
//! remainder sequences", 1967), so that it is divided out; then they grow linearly. Where only the
//! sign is left, it is not. Powers of two that divide a remainder are divided out as well, and so
//! the factor loses its own.

use super::integer::Integer;
use super::poly::Poly;

/// `q` and what follows it, up to the last that is not 0.
pub(super) struct Remainders<const N: usize> {
    last: Poly<N>,
    current: Poly<N>,
    /// A factor of the next remainder.
    factor: Integer,
}

impl<const N: usize> Remainders<N> {
    /// The sequence of two polynomials, the degree of `p` not below that of `q`.
    pub(super) fn new(p: Poly<N>, q: Poly<N>) -> Self {
        Remainders {
            last: p,
            current: q,
            factor: Integer::from(1),
        }
    }

    fn next_remainder(&mut self) -> Poly<N> {
        let Some((leading, [_, ..])) = self.current.coefficients().split_last() else {
            // A constant divides everything.
            return Poly::default();
        };
        let steps = self.last.degree() - self.current.degree() + 1;
        let mut power = leading.magnitude();
        (1..steps).for_each(|_| power.mul_assign(&leading.magnitude()));
        let mut remainder = std::mem::take(&mut self.last).remainder(&self.current);
        if remainder.degree() > 0 {
            remainder.divide_exactly(&self.factor);
            remainder.reduce();
        }
        remainder.negate();
        self.factor = power.shifted_down(power.trailing_zeros());
        remainder
    }
}

impl<const N: usize> Iterator for Remainders<N> {
    type Item = Poly<N>;

    fn next(&mut self) -> Option<Poly<N>> {
        if self.current.is_zero() {
            return None;
        }
        let next = self.next_remainder();
        self.last = std::mem::replace(&mut self.current, next);
        Some(self.last.clone())
    }
}

#[cfg(test)]
mod tests;

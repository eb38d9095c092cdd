//! A time in integers of any size.

use std::cmp::Ordering;

use super::bracket::{Bracket, Settled, exact_ratio};
use super::dyadic::Dyadic;
use super::poly::Poly;

/// An exact time.
pub(super) enum AlgebraicTime<'a, const N: usize = 4> {
    /// This number.
    At(Dyadic),
    /// A root of a polynomial.
    Between(Bracket<'a, N>),
}

impl<'a, const N: usize> AlgebraicTime<'a, N> {
    /// The root in a bracket, narrowed to between two neighbours in `f64`, and these; both the same
    /// if it is an `f64`.
    pub(super) fn settled(mut bracket: Bracket<'a, N>) -> (Self, [f64; 2]) {
        match bracket.settle() {
            Settled::At(at) => {
                let neighbours = [at.below(), at.above()];
                (AlgebraicTime::At(at), neighbours)
            }
            Settled::Between(below, above) => (AlgebraicTime::Between(bracket), [below, above]),
        }
    }

    /// `self` compared with `other`.
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        match (self, other) {
            (AlgebraicTime::At(a), AlgebraicTime::At(b)) => a.compare(b),
            (AlgebraicTime::At(a), AlgebraicTime::Between(b)) => b.compare_dyadic(a).reverse(),
            (AlgebraicTime::Between(a), AlgebraicTime::At(b)) => a.compare_dyadic(b),
            (AlgebraicTime::Between(a), AlgebraicTime::Between(b)) => a.compare(b),
        }
    }

    /// The sign of a polynomial at the time.
    pub(super) fn sign_of(&self, q: &Poly<N>) -> Ordering {
        match self {
            AlgebraicTime::At(at) => q.sign_at(at),
            AlgebraicTime::Between(bracket) => bracket.sign_of(q.clone()),
        }
    }

    /// `n / d`, which is in `[0, 1]`, with an error of at most [`PARAMETER_ERROR`].
    ///
    /// [`PARAMETER_ERROR`]: super::PARAMETER_ERROR
    pub(super) fn quotient(&self, n: &Poly<N>, d: &Poly<N>) -> f64 {
        match self {
            AlgebraicTime::At(at) => exact_ratio(n, d, at),
            AlgebraicTime::Between(bracket) => bracket.quotient(n, d),
        }
    }
}

//! Times of the step: exact dyadic numbers, and simple roots of polynomials.

use std::cmp::Ordering;

use super::bracket::{Bracket, Settled};
use super::dyadic::Dyadic;
use super::integer::{Integer, ratio};
use super::isolate::{Cell, Place, Roots};
use super::lane::Number;
use super::poly::Poly;

/// An exact time, between its neighbours in `f64`.
#[derive(Clone, Debug)]
pub(super) struct Time<'a> {
    /// The largest `f64` that is not above the time.
    pub(super) below: f64,
    /// The smallest `f64` that is not below the time.
    pub(super) above: f64,
    exact: Exact<'a>,
}

#[derive(Clone, Debug)]
enum Exact<'a> {
    At(Dyadic),
    Root(Bracket<'a>),
}

impl<'a> Time<'a> {
    /// The start of the step.
    pub(super) fn start() -> Self {
        Time::at(Dyadic::new(Integer::default(), 0))
    }

    /// A time that is a dyadic number.
    pub(super) fn at(at: Dyadic) -> Self {
        Time {
            below: at.below(),
            above: at.above(),
            exact: Exact::At(at),
        }
    }

    /// The time of a root.
    pub(super) fn of_root(roots: &'a Roots, cell: &Cell) -> Self {
        match &cell.place {
            Place::At(at) => Time::at(at.clone()),
            Place::Between {
                poly,
                low,
                high,
                before,
            } => Time::between(roots.poly(*poly), low.clone(), high.clone(), *before),
        }
    }

    /// The only root of a polynomial strictly between two numbers, a simple one.
    pub(super) fn between(poly: &'a Poly, low: Dyadic, high: Dyadic, before: Ordering) -> Self {
        let mut bracket = Bracket::new(poly, low, high, before);
        match bracket.settle() {
            Settled::At(at) => Time::at(at),
            Settled::Between(below, above) => Time {
                below,
                above,
                exact: Exact::Root(bracket),
            },
        }
    }

    /// Whether it is strictly inside the step.
    pub(super) fn is_inside(&self) -> bool {
        self.above > 0.0 && self.below < 1.0
    }

    /// The sign of a polynomial of degree 2 at the time.
    pub(super) fn sign_of<Z: Number>(&self, q: &[Z; 3]) -> Ordering {
        if let Some(sign) = self.quick_sign_of(q) {
            return sign;
        }
        let q = Poly::new(q);
        match &self.exact {
            Exact::At(at) => q.sign_at(at),
            Exact::Root(bracket) => bracket.sign_of(q),
        }
    }

    /// The sign of a polynomial of degree 2, where floating point shows it or the polynomial is 0.
    ///
    /// With coefficients of a relative error of 2^-51, and `t` off by at most one unit in the last
    /// place, which is `2^-52 t`: each term is off by 2^-51 of itself for its coefficient, 2 2^-52
    /// for `t`, and at most 4 2^-53 for the operations of Horner's rule: by less than 2^-49 of the
    /// sum of the terms' magnitudes. That sum is computed with a relative error of the same order.
    /// Coefficients are integers and so 0 or at least 1: with `t` above 2^-400 nothing underflows.
    /// Where something is infinite, the comparison fails.
    pub(super) fn quick_sign_of<Z: Number>(&self, q: &[Z; 3]) -> Option<Ordering> {
        let [c0, c1, c2] = q.each_ref().map(Number::to_f64);
        if c0 == 0.0 && c1 == 0.0 && c2 == 0.0 {
            return Some(Ordering::Equal);
        }
        let t = self.above;
        if t == 0.0 {
            return c0.partial_cmp(&0.0);
        }
        let value = (c2 * t + c1) * t + c0;
        let size = (c2.abs() * t + c1.abs()) * t + c0.abs();
        let is_shown = t > SMALLEST && value.abs() > size * TERM_ERROR;
        if is_shown {
            value.partial_cmp(&0.0)
        } else {
            None
        }
    }

    /// `n / d` at the time, which is in `[0, 1]`, with an error of at most [`PARAMETER_ERROR`].
    ///
    /// [`PARAMETER_ERROR`]: super::PARAMETER_ERROR
    pub(super) fn quotient<Z: Number>(&self, n: &[Z; 3], d: &[Z; 3]) -> f64 {
        let (n, d) = (Poly::new(n), Poly::new(d));
        match &self.exact {
            Exact::At(at) => ratio(&n.evaluate_as(2, at), &d.evaluate_as(2, at)),
            Exact::Root(bracket) => bracket.quotient(&n, &d),
        }
    }

    /// `self` compared with `other`.
    pub(super) fn compare(&self, other: &Time) -> Ordering {
        if self.above <= other.below && self.below < other.above {
            return Ordering::Less;
        }
        if other.above <= self.below && other.below < self.above {
            return Ordering::Greater;
        }
        match (&self.exact, &other.exact) {
            (Exact::At(a), Exact::At(b)) => a.compare(b),
            (Exact::Root(a), Exact::At(b)) => a.compare_dyadic(b),
            (Exact::At(a), Exact::Root(b)) => b.compare_dyadic(a).reverse(),
            (Exact::Root(a), Exact::Root(b)) => a.compare(b),
        }
    }
}

/// See [`Time::quick_sign_of`].
const TERM_ERROR: f64 = 1.0 / (1u64 << 48) as f64;

/// 2^-400.
const SMALLEST: f64 = f64::from_bits((1023 - 400) << 52);

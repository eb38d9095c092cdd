//! Real algebraic numbers in `[0, 1]`: roots of integer polynomials, compared and bounded exactly.
//!
//! A number is a polynomial and an interval that isolates one simple root of it. Every question is
//! answered by narrowing the interval until the answer shows; whether something is *equal*, which
//! narrowing can never show, is decided by a greatest common divisor. Nothing takes a tolerance.

use std::cell::RefCell;
use std::cmp::Ordering;

use crate::field::{Integer, Ratio};
use crate::poly::Poly;

mod enclose;
mod interval;
mod isolate;

pub(crate) use enclose::{decompose, dyadic};
pub use isolate::isolate_roots;

use interval::Interval;

/// A real algebraic number in `[0, 1]`.
///
/// The interval narrows as questions are asked, behind a `RefCell`: the number stays the same.
#[derive(Clone, Debug)]
pub struct Algebraic<Z> {
    /// Has the number as a simple root and no other root in the interval.
    poly: Poly<Z>,
    /// A single point (then the number is this dyadic rational), or an interval that holds the
    /// number strictly inside and whose ends are not roots.
    interval: RefCell<Interval<Z>>,
}

impl<Z: Integer> Algebraic<Z> {
    /// The number 0.
    pub fn zero() -> Self {
        Self::dyadic(Z::zero(), 0)
    }

    /// The number `numerator / 2^exponent`, in `[0, 1]`.
    pub fn dyadic(numerator: Z, exponent: u64) -> Self {
        let poly = Poly::new(vec![numerator.neg(), Z::one().shl(exponent)]);
        Algebraic {
            poly,
            interval: RefCell::new(Interval::point(numerator, exponent)),
        }
    }

    /// The number `value`, in `[0, 1]`.
    pub fn ratio(value: &Z::Ratio) -> Self {
        let (numerator, denominator) = (value.numerator(), value.denominator());
        let exponent = denominator.trailing_zeros();
        if denominator == Z::one().shl(exponent) {
            return Self::dyadic(numerator, exponent);
        }
        let poly = Poly::new(vec![numerator.neg(), denominator]);
        Self::isolated(poly, Interval::unit())
    }

    fn isolated(poly: Poly<Z>, interval: Interval<Z>) -> Self {
        Algebraic {
            poly,
            interval: RefCell::new(interval),
        }
    }

    /// A polynomial that has the number as a root.
    pub fn poly(&self) -> &Poly<Z> {
        &self.poly
    }

    /// Whether it is 0.
    pub fn is_zero(&self) -> bool {
        // An interval that is not a point holds the number strictly inside `[0, 1]`.
        let interval = self.interval.borrow();
        interval.is_point() && interval.low.is_zero()
    }

    /// Bounds `low / 2^exponent` and `high / 2^exponent` as they now stand: equal, or with the
    /// number strictly between.
    pub fn bounds(&self) -> (Z, Z, u64) {
        let interval = self.interval.borrow();
        (
            interval.low.clone(),
            interval.high.clone(),
            interval.exponent,
        )
    }

    /// Narrows the interval to a width of at most `2^-bits`.
    pub fn refine(&self, bits: u64) {
        self.interval.borrow_mut().refine(&self.poly, bits);
    }

    /// The number if it is rational.
    ///
    /// A rational root of an integer polynomial has a denominator that divides the leading
    /// coefficient `c`, so `c` times it is an integer: one candidate is left once the interval is
    /// narrower than `1 / c`.
    pub fn rational(&self) -> Option<Z::Ratio> {
        let leading = self.poly.leading()?;
        self.refine(leading.bits() + 1);
        let (low, high, exponent) = self.bounds();
        if low == high {
            return Some(Z::Ratio::new(low, Z::one().shl(exponent)));
        }
        let (numerator, leading) = {
            let sum = low.add(&high).mul(leading);
            (
                sum.add(&Z::one().shl(exponent)).shr_floor(exponent + 1),
                leading,
            )
        };
        let (numerator, denominator) = match leading.sign() {
            Ordering::Less => (numerator.neg(), leading.neg()),
            _ => (numerator, leading.clone()),
        };
        let is_root = self.poly.evaluate(&numerator, &denominator).is_zero();
        let candidate = Z::Ratio::new(numerator, denominator);
        (is_root && self.compare_ratio(&candidate).is_eq()).then_some(candidate)
    }

    /// The sign of `q` at the number.
    pub fn sign_of(&self, q: &Poly<Z>) -> Ordering {
        if q.degree() == 0 {
            return q.leading().map_or(Ordering::Equal, Z::sign);
        }
        if let Some(sign) = self.sign_if_rational(q).or_else(|| self.try_sign_of(q)) {
            return sign;
        }
        self.narrow_to_f64();
        if let Some(sign) = self.try_sign_of(q) {
            return sign;
        }
        if self.is_root_of(q) {
            return Ordering::Equal;
        }
        let mut bits = 64;
        loop {
            self.refine(bits);
            if let Some(sign) = self.sign_if_rational(q).or_else(|| self.try_sign_of(q)) {
                return sign;
            }
            bits *= 2;
        }
    }

    /// The sign of `q` at the number if the interval as it now stands shows it.
    pub fn try_sign_of(&self, q: &Poly<Z>) -> Option<Ordering> {
        self.interval.borrow().sign_of(q)
    }

    fn sign_if_rational(&self, q: &Poly<Z>) -> Option<Ordering> {
        if let [c, a] = self.poly.coefficients() {
            let (numerator, denominator) = if a.sign().is_lt() {
                (c.clone(), a.neg())
            } else {
                (c.neg(), a.clone())
            };
            return Some(q.evaluate(&numerator, &denominator).sign());
        }
        let interval = self.interval.borrow();
        interval
            .is_point()
            .then(|| q.evaluate_dyadic(&interval.low, interval.exponent).sign())
    }

    /// Whether `q` is 0 at the number.
    ///
    /// The common divisor of `q` and the defining polynomial has no root in the interval but the
    /// number, a simple one if any, so it has it exactly if it changes sign between the ends.
    /// Mostly `q` is a multiple of the defining polynomial, which shows at less cost.
    fn is_root_of(&self, q: &Poly<Z>) -> bool {
        if self.poly.divides(q) {
            return true;
        }
        let common = self.poly.gcd(q);
        let interval = self.interval.borrow();
        if interval.is_point() {
            return q
                .evaluate_dyadic(&interval.low, interval.exponent)
                .is_zero();
        }
        common.degree() > 0
            && common
                .evaluate_dyadic(&interval.low, interval.exponent)
                .sign()
                != common
                    .evaluate_dyadic(&interval.high, interval.exponent)
                    .sign()
    }

    /// The number compared with a rational.
    pub fn compare_ratio(&self, value: &Z::Ratio) -> Ordering {
        self.sign_of(&Poly::new(vec![
            value.numerator().neg(),
            value.denominator(),
        ]))
    }

    /// The number compared with another.
    pub fn compare(&self, other: &Self) -> Ordering {
        if let Some(order) = self.compare_intervals(other) {
            return order;
        }
        self.narrow_to_f64();
        other.narrow_to_f64();
        if let Some(order) = self.compare_intervals(other) {
            return order;
        }
        if self.equals(other) {
            return Ordering::Equal;
        }
        let mut bits = 64;
        loop {
            self.refine(bits);
            other.refine(bits);
            if let Some(order) = self.compare_intervals(other) {
                return order;
            }
            bits *= 2;
        }
    }

    /// A dyadic rational strictly between this number and a larger one.
    pub fn between(&self, larger: &Self) -> Self {
        let mut bits = 1;
        loop {
            self.refine(bits);
            larger.refine(bits);
            let exponent = self.bounds().2.max(larger.bounds().2);
            let ((_, high, e), (low, _, f)) = (self.bounds(), larger.bounds());
            let sum = high.shl(exponent - e).add(&low.shl(exponent - f));
            let middle = Algebraic::dyadic(sum, exponent + 1);
            if self.compare(&middle).is_lt() && middle.compare(larger).is_lt() {
                return middle;
            }
            bits *= 2;
        }
    }

    /// Two roots are equal if the polynomial of one vanishes at the other, inside its interval.
    fn equals(&self, other: &Self) -> bool {
        let (low, high, exponent) = other.bounds();
        let versus = |bound: Z| self.sign_of(&Poly::new(vec![bound.neg(), Z::one().shl(exponent)]));
        if low == high {
            return versus(low).is_eq();
        }
        self.sign_of(&other.poly).is_eq() && versus(low).is_gt() && versus(high).is_lt()
    }

    fn compare_intervals(&self, other: &Self) -> Option<Ordering> {
        let (a, b) = (self.interval.borrow(), other.interval.borrow());
        let exponent = a.exponent.max(b.exponent);
        let at = |numerator: &Z, own: u64| numerator.shl(exponent - own);
        let (a_low, a_high) = (at(&a.low, a.exponent), at(&a.high, a.exponent));
        let (b_low, b_high) = (at(&b.low, b.exponent), at(&b.high, b.exponent));
        // An end belongs to the interval only if it is a single point, so touching ends already
        // tell the order unless both are points.
        if a.is_point() && b.is_point() {
            return Some(a_low.cmp(&b_low));
        }
        if a_high <= b_low {
            return Some(Ordering::Less);
        }
        (b_high <= a_low).then_some(Ordering::Greater)
    }
}

#[cfg(test)]
mod tests;

//! A simple root between two numbers, narrowed as far as a question about it needs.
//!
//! Quadratic interval refinement (Abbott, "Quadratic interval refinement for real roots", 2006): a
//! chord says in which of `2^bits` cells the root should be, exact signs at the cell's ends say
//! whether it is. A cell that is right squares the number of cells, one that is wrong takes its
//! root; two cells are halving, which always goes on.

use std::cmp::Ordering;

use super::dyadic::Dyadic;
use super::estimate::between;
use super::integer::{Integer, ratio, scale};
use super::modular::are_coprime;
use super::poly::Poly;
use super::sturm;

/// The only root of a polynomial strictly between two numbers, a simple one.
#[derive(Clone, Debug)]
pub(super) struct Bracket<'a, const N: usize = 4> {
    poly: &'a Poly<N>,
    /// The sign of the polynomial between `low` and the root.
    before: Ordering,
    low: Dyadic,
    high: Dyadic,
    /// Whether the polynomial is known not to be 0 at `low`; another root may be there at first.
    is_low_proved: bool,
    /// Whether the polynomial is known not to be 0 at `high`.
    is_high_proved: bool,
    /// The logarithm of the number of cells that the next step tries.
    bits: u32,
}

/// A root compared with the `f64`s.
pub(super) enum Settled {
    /// It is this number.
    At(Dyadic),
    /// It is strictly between these two neighbours.
    Between(f64, f64),
}

/// How many bits the ends may have, and as many more as the other polynomial's coefficients, before
/// that is likely to be 0 at a root.
const LEAST_EXPONENT: u64 = 64;

/// The most bits that a chord is worth, computed in floating point.
pub(super) const MOST_BITS: u32 = 48;

impl<'a, const N: usize> Bracket<'a, N> {
    /// The only root of `poly` strictly between `low` and `high`; `before` is the sign between
    /// `low` and the root.
    pub(super) fn new(poly: &'a Poly<N>, low: Dyadic, high: Dyadic, before: Ordering) -> Self {
        Bracket {
            poly,
            before,
            low,
            high,
            is_low_proved: false,
            is_high_proved: false,
            // A line is its own chord.
            bits: if poly.degree() == 1 { MOST_BITS } else { 1 },
        }
    }

    /// The same for ends that are known not to be roots.
    pub(super) fn proved(poly: &'a Poly<N>, low: Dyadic, high: Dyadic, before: Ordering) -> Self {
        Bracket {
            is_low_proved: true,
            is_high_proved: true,
            ..Bracket::new(poly, low, high, before)
        }
    }

    /// Narrows it to between two neighbours in `f64`, and such that neither end is a root.
    pub(super) fn settle(&mut self) -> Settled {
        loop {
            let (below, above) = (self.low.below(), self.high.above());
            let met = match between(below, above) {
                None if self.is_low_proved && self.is_high_proved => {
                    return Settled::Between(below, above);
                }
                // The root may be the only one that there is between them.
                Some(cut) if below.next_up() == cut => self.meet(Dyadic::from_f64(cut)),
                _ => self.refine(),
            };
            if let Some(at) = met {
                return Settled::At(at);
            }
        }
    }

    /// Numbers between which the root is.
    pub(super) fn ends(&self) -> [&Dyadic; 2] {
        [&self.low, &self.high]
    }

    /// Compares the root with a number strictly between the ends, if it is that; returns the root
    /// if that is it.
    fn meet(&mut self, at: Dyadic) -> Option<Dyadic> {
        let is_inside = at.compare(&self.low).is_gt() && at.compare(&self.high).is_lt();
        (is_inside && self.cut(&at).is_eq()).then_some(at)
    }

    /// Narrows it to one of its cells, or to what lies on one side of that. Returns the root if it
    /// is met.
    pub(super) fn refine(&mut self) -> Option<Dyadic> {
        let own = self.low.exponent.max(self.high.exponent);
        let exponent = own + u64::from(self.bits);
        let start = self.low.numerator.shifted(exponent - self.low.exponent);
        let mut width = self.high.numerator.shifted(own - self.high.exponent);
        width.sub_shifted(&self.low.numerator, own - self.low.exponent);
        let cells = 1u64 << self.bits;
        let index = ((self.chord() * cells as f64) as u64).min(cells - 1);
        let end = |index: u64| {
            let mut at = start.clone();
            at.add_shifted(&Integer::product(&width, &i128::from(index).into()), 0);
            Dyadic::new(at, exponent)
        };
        let mut is_right = true;
        for (index, side) in [(index, Ordering::Greater), (index + 1, Ordering::Less)] {
            if is_right && index > 0 && index < cells {
                let at = end(index);
                let order = self.cut(&at);
                if order.is_eq() {
                    return Some(at);
                }
                is_right = order == side;
            }
        }
        self.bits = if is_right {
            (2 * self.bits).min(MOST_BITS)
        } else {
            (self.bits / 2).max(1)
        };
        None
    }

    /// Where between the ends the chord of the polynomial is 0; not a number if it is 0 at both
    /// ends.
    fn chord(&self) -> f64 {
        let value = |at: &Dyadic| {
            let (value, exponent) = self.poly.evaluate(at).approximate();
            let degree = self.poly.degree() as i64;
            (value.abs(), exponent - at.exponent as i64 * degree)
        };
        let ((low, low_exponent), (high, high_exponent)) = (value(&self.low), value(&self.high));
        1.0 / (1.0 + scale(high / low, high_exponent - low_exponent))
    }

    /// Compares the root with a number strictly between the ends, which becomes one of them unless
    /// it is the root.
    fn cut(&mut self, at: &Dyadic) -> Ordering {
        let sign = self.poly.sign_at(at);
        if sign.is_eq() {
            Ordering::Equal
        } else if sign == self.before {
            self.low = at.clone();
            self.is_low_proved = true;
            Ordering::Greater
        } else {
            self.high = at.clone();
            self.is_high_proved = true;
            Ordering::Less
        }
    }

    /// The root compared with a number.
    pub(super) fn compare_dyadic(&self, at: &Dyadic) -> Ordering {
        if at.compare(&self.low).is_le() {
            return Ordering::Greater;
        }
        if at.compare(&self.high).is_ge() {
            return Ordering::Less;
        }
        match self.poly.sign_at(at) {
            Ordering::Equal => Ordering::Equal,
            sign if sign == self.before => Ordering::Greater,
            _ => Ordering::Less,
        }
    }

    /// The root compared with another one.
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        if self.compare_dyadic(&other.low).is_le() {
            return Ordering::Less;
        }
        if self.compare_dyadic(&other.high).is_ge() {
            return Ordering::Greater;
        }
        // Between these, the other polynomial changes its sign at the other root alone.
        match self.sign_of(other.poly.clone()) {
            Ordering::Equal => Ordering::Equal,
            sign if sign == other.before => Ordering::Less,
            _ => Ordering::Greater,
        }
    }

    /// The sign of a polynomial at the root.
    ///
    /// One with a factor in common may still not be 0 there: it is narrowed for a while before
    /// remainders, whose numbers are many times as long, tell.
    pub(super) fn sign_of(&self, q: Poly<N>) -> Ordering {
        self.plain_sign_of(&q).unwrap_or_else(|| {
            let limit = if are_coprime(self.poly, &q) {
                u64::MAX
            } else {
                let bits = q.coefficients().iter().map(Integer::bits).max();
                LEAST_EXPONENT + bits.unwrap_or(0)
            };
            self.sign_by_narrowing(&q, limit)
                .unwrap_or_else(|| self.sturm_sign_of(q))
        })
    }

    /// The sign of a polynomial at the root, if it has that in the whole bracket.
    pub(super) fn plain_sign_of(&self, q: &Poly<N>) -> Option<Ordering> {
        let (value, variation) = self.range(q, q.degree().max(1));
        value.exceeds(&variation).then(|| value.sign())
    }

    /// The sign of a polynomial at the root, if it is shown before the ends have so many bits. If
    /// it is not 0, it is shown in the end.
    fn sign_by_narrowing(&self, q: &Poly<N>, most_bits: u64) -> Option<Ordering> {
        let mut bracket = self.clone();
        while bracket.low.exponent.max(bracket.high.exponent) < most_bits {
            if let Some(at) = bracket.refine() {
                return Some(q.sign_at(&at));
            }
            if let Some(sign) = bracket.plain_sign_of(q) {
                return Some(sign);
            }
        }
        None
    }

    /// The same for a polynomial that is likely to be 0 there.
    pub(super) fn sturm_sign_of(&self, q: Poly<N>) -> Ordering {
        sturm::sign_at_root(self.poly, q, self.before, &self.low, &self.high)
    }

    /// The value of a polynomial at `low` and how much it changes at most up to `high`, both times
    /// the same power of two: `2^(degree exponent)` for the exponent of both ends. The degree is at
    /// least 1 and that of the polynomial.
    ///
    /// On `[0, 1]` the derivative of the sum of the `c_i t^i` is at most that of the `i |c_i|`.
    pub(super) fn range(&self, q: &Poly<N>, degree: usize) -> (Integer, Integer) {
        let exponent = self.low.exponent.max(self.high.exponent);
        let missing = exponent - self.low.exponent;
        let value = q
            .evaluate_as(degree, &self.low)
            .shifted(degree as u64 * missing);
        let mut slope = Integer::default();
        for (coefficient, i) in q.coefficients().iter().zip(0..) {
            slope.add_shifted(&coefficient.magnitude().times(i), 0);
        }
        let mut width = self.high.numerator.shifted(exponent - self.high.exponent);
        width.sub_shifted(&self.low.numerator, missing);
        slope.mul_assign(&width);
        (value, slope.shifted((degree as u64 - 1) * exponent))
    }

    /// `n / d` at the root, which is in `[0, 1]`.
    ///
    /// The error is at most [`PARAMETER_ERROR`](super::PARAMETER_ERROR), `2^-50`. The exact
    /// quotient is between two numbers, each known up to 3/2 2^-52; the middle of what is known of
    /// them is taken once these are not more than 4 2^-52 apart, which adds 2 2^-52, and is
    /// rounded.
    ///
    /// It ends: the denominator is not 0 at the root, so that narrowing brings the two numbers
    /// together as near as one likes. What is known of each then differs by a unit in the last
    /// place, 2^-52, in numerator, denominator and quotient: by not more than 3 2^-52.
    pub(super) fn quotient(&self, n: &Poly<N>, d: &Poly<N>) -> f64 {
        let mut bracket = self.clone();
        loop {
            if let Some(value) = bracket.try_quotient(n, d) {
                return value;
            }
            if let Some(at) = bracket.refine() {
                return exact_ratio(n, d, &at);
            }
        }
    }

    fn try_quotient(&self, n: &Poly<N>, d: &Poly<N>) -> Option<f64> {
        let degree = common_degree(n, d).max(1);
        let (mut n, n_variation) = self.range(n, degree);
        let (mut d, d_variation) = self.range(d, degree);
        if d.sign().is_lt() {
            n.negate();
            d.negate();
        }
        if !d.exceeds(&d_variation) {
            return None;
        }
        let (mut least, mut most) = (n.clone(), n);
        least.sub_shifted(&n_variation, 0);
        most.add_shifted(&n_variation, 0);
        let (narrow, wide) = (
            Integer::difference(&d, &d_variation),
            Integer::sum(&d, &d_variation),
        );
        let low = if least.sign().is_gt() {
            ratio(&least, &wide)
        } else {
            0.0
        };
        let high = ratio(&most, &narrow);
        (high - low <= 4.0 * f64::EPSILON).then(|| (0.5 * (low + high)).min(1.0))
    }
}

/// `n / d` at a time, which is in `[0, 1]`.
pub(super) fn exact_ratio<const N: usize>(n: &Poly<N>, d: &Poly<N>, at: &Dyadic) -> f64 {
    let degree = common_degree(n, d);
    let (mut n, mut d) = (n.evaluate_as(degree, at), d.evaluate_as(degree, at));
    if d.sign().is_lt() {
        n.negate();
        d.negate();
    }
    ratio(&n, &d).min(1.0)
}

fn common_degree<const N: usize>(n: &Poly<N>, d: &Poly<N>) -> usize {
    n.degree().max(d.degree())
}

//! A simple root between two numbers, narrowed as far as a question about it needs.
//!
//! Floating point proposes where the root is; exact signs at both sides of the proposal prove it. A
//! bad proposal costs time only: halving always goes on.

use std::cmp::Ordering;

use super::dyadic::Dyadic;
use super::guess::{between, guess_root, slope};
use super::integer::{Integer, ratio, scale};
use super::poly::Poly;
use super::sturm;

/// The only root of a polynomial strictly between two numbers, a simple one.
#[derive(Clone, Debug)]
pub(super) struct Bracket<'a> {
    poly: &'a Poly,
    /// The sign of the polynomial between `low` and the root.
    before: Ordering,
    low: Dyadic,
    high: Dyadic,
    /// Whether the polynomial is known not to be 0 at `low`; another root may be there at first.
    is_low_proved: bool,
    /// Whether the polynomial is known not to be 0 at `high`.
    is_high_proved: bool,
}

/// A root compared with the `f64`s.
pub(super) enum Settled {
    /// It is this number.
    At(Dyadic),
    /// It is strictly between these two neighbours.
    Between(f64, f64),
}

/// The fraction bits of a proposal beyond the last bit of an `f64`.
const EXTRA_BITS: i64 = 64;

impl<'a> Bracket<'a> {
    /// The only root of `poly` strictly between `low` and `high`; `before` is the sign between `low`
    /// and the root.
    pub(super) fn new(poly: &'a Poly, low: Dyadic, high: Dyadic, before: Ordering) -> Self {
        Bracket {
            poly,
            before,
            low,
            high,
            is_low_proved: false,
            is_high_proved: false,
        }
    }

    /// The same for ends that are known not to be roots.
    pub(super) fn proved(poly: &'a Poly, low: Dyadic, high: Dyadic, before: Ordering) -> Self {
        Bracket {
            is_low_proved: true,
            is_high_proved: true,
            ..Bracket::new(poly, low, high, before)
        }
    }

    /// Narrows it to between two neighbours in `f64`, and such that neither end is a root.
    pub(super) fn settle(&mut self) -> Settled {
        if let Some(at) = self.propose() {
            return Settled::At(at);
        }
        loop {
            let (below, above) = (self.low.below(), self.high.above());
            let Some(cut) = between(below, above) else {
                self.prove_ends();
                return Settled::Between(below, above);
            };
            let cut = Dyadic::from_f64(cut);
            if self.cut(&cut).is_eq() {
                return Settled::At(cut);
            }
        }
    }

    /// Compares the root with a number strictly between the ends, which becomes one of them unless
    /// it is the root.
    fn cut(&mut self, at: &Dyadic) -> Ordering {
        self.cut_by_sign(at, self.poly.sign_at(at))
    }

    fn cut_by_sign(&mut self, at: &Dyadic, sign: Ordering) -> Ordering {
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

    /// [`cut`](Self::cut) where the number is strictly between the ends; what is known without that
    /// elsewhere.
    fn cut_or_compare(&mut self, at: &Dyadic) -> Ordering {
        if at.compare(&self.low).is_le() {
            Ordering::Greater
        } else if at.compare(&self.high).is_ge() {
            Ordering::Less
        } else {
            self.cut(at)
        }
    }

    /// Narrows it around a root in floating point, corrected by a Newton step from the exact value
    /// there. Returns the root if it is met.
    fn propose(&mut self) -> Option<Dyadic> {
        let (coefficients, bits) = self.poly.approximate();
        let guess = guess_root(
            &coefficients,
            self.low.below(),
            self.high.above(),
            self.before,
        );
        let at = Dyadic::from_f64(guess);
        if at.compare(&self.low).is_le() || at.compare(&self.high).is_ge() {
            return None;
        }
        let value = self.poly.evaluate(&at);
        if self.cut_by_sign(&at, value.sign()).is_eq() {
            return Some(at);
        }
        let (value, exponent) = value.approximate();
        let own = at.exponent as i64 * self.poly.degree() as i64;
        let step = -scale(value, exponent - own - bits) / slope(&coefficients, guess);
        self.propose_around(&at, guess, step)
    }

    /// Narrows it around `at + step`, in ever wider intervals until one holds the root.
    fn propose_around(&mut self, at: &Dyadic, guess: f64, step: f64) -> Option<Dyadic> {
        let grid = EXTRA_BITS - ulp_exponent(guess);
        let offset = scale(step, grid);
        // Beyond this the proposal is no better than halving.
        if offset.is_nan() || offset.abs() >= 2f64.powi(100) {
            return None;
        }
        let offset = offset as i128;
        let grid = grid.unsigned_abs();
        let mut centre = at.numerator.shifted(grid - at.exponent);
        centre.add_shifted(&Integer::from(offset), 0);
        let mut reach = (offset.abs() >> 24) + (1 << 24);
        while reach < 1 << 100 {
            let reached = Integer::from(reach);
            let low = Dyadic::new(Integer::difference(&centre, &reached), grid);
            let high = Dyadic::new(Integer::sum(&centre, &reached), grid);
            let (from_low, from_high) = (self.cut_or_compare(&low), self.cut_or_compare(&high));
            match (from_low, from_high) {
                (Ordering::Equal, _) => return Some(low),
                (_, Ordering::Equal) => return Some(high),
                (Ordering::Greater, Ordering::Less) => return None,
                _ => reach <<= 16,
            }
        }
        None
    }

    /// Narrows it until neither end is a root.
    fn prove_ends(&mut self) {
        self.is_low_proved = self.is_low_proved || self.poly.sign_at(&self.low).is_ne();
        self.is_high_proved = self.is_high_proved || self.poly.sign_at(&self.high).is_ne();
        while !(self.is_low_proved && self.is_high_proved) {
            self.halve();
        }
    }

    /// Halves it, or takes the middle half where the root is its centre.
    fn halve(&mut self) {
        let middle = Dyadic::middle(&self.low, &self.high);
        if self.cut(&middle).is_eq() {
            self.low = Dyadic::middle(&self.low, &middle);
            self.high = Dyadic::middle(&middle, &self.high);
            (self.is_low_proved, self.is_high_proved) = (true, true);
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
    pub(super) fn compare(&self, other: &Bracket) -> Ordering {
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
    pub(super) fn sign_of(&self, q: Poly) -> Ordering {
        let (value, variation) = self.range(&q);
        if value.exceeds(&variation) {
            return value.sign();
        }
        self.sturm_sign_of(q)
    }

    /// The same for a polynomial that is likely to be 0 there.
    pub(super) fn sturm_sign_of(&self, q: Poly) -> Ordering {
        sturm::sign_at_root(self.poly, q, self.before, &self.low, &self.high)
    }

    /// The value of a polynomial at `low` and how much it changes at most up to `high`, both times
    /// the same power of two: `2^(2 exponent)` for the exponent of both ends, if the degree is at
    /// most 2.
    ///
    /// On `[0, 1]` the derivative of `c0 + c1 t + c2 t^2 + c3 t^3` is at most
    /// `|c1| + 2 |c2| + 3 |c3|`.
    fn range(&self, q: &Poly) -> (Integer, Integer) {
        let degree = q.degree().max(2);
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

    /// `n / d` at the root, which is in `[0, 1]`, for polynomials of degree at most 2.
    ///
    /// The error is at most [`PARAMETER_ERROR`](super::PARAMETER_ERROR), `2^-50`. The exact quotient
    /// is between two numbers, each known up to 3/2 2^-52; the middle of what is known of them is
    /// taken once these are not more than 4 2^-52 apart, which adds 2 2^-52, and is rounded.
    ///
    /// It ends: the denominator is not 0 at the root, so that halving brings the two numbers together
    /// as near as one likes. What is known of each then differs by a unit in the last place, 2^-52,
    /// in numerator, denominator and quotient: by not more than 3 2^-52.
    pub(super) fn quotient(&self, n: &Poly, d: &Poly) -> f64 {
        let mut bracket = self.clone();
        loop {
            if let Some(value) = bracket.try_quotient(n, d) {
                return value;
            }
            for _ in 0..32 {
                bracket.halve();
            }
        }
    }

    fn try_quotient(&self, n: &Poly, d: &Poly) -> Option<f64> {
        let ((mut n, n_variation), (mut d, d_variation)) = (self.range(n), self.range(d));
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

/// The exponent of the unit in the last place of an `f64` above 0.
fn ulp_exponent(value: f64) -> i64 {
    ((value.to_bits() >> 52 & 0x7ff) as i64).max(1) - 1075
}

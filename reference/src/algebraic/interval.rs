//! An interval with dyadic ends that isolates a root, and how it narrows.

use std::cmp::Ordering;

use crate::field::Integer;
use crate::poly::Poly;

/// The interval from `low / 2^exponent` to `high / 2^exponent`, within `[0, 1]`.
#[derive(Clone, Debug)]
pub(super) struct Interval<Z> {
    pub(super) low: Z,
    pub(super) high: Z,
    pub(super) exponent: u64,
    /// The next refinement step divides the interval into `2^stride` parts.
    stride: u64,
}

impl<Z: Integer> Interval<Z> {
    pub(super) fn new(low: Z, high: Z, exponent: u64) -> Self {
        Interval {
            low,
            high,
            exponent,
            stride: 2,
        }
    }

    /// The interval from 0 to 1.
    pub(super) fn unit() -> Self {
        Interval::new(Z::zero(), Z::one(), 0)
    }

    pub(super) fn point(numerator: Z, exponent: u64) -> Self {
        Interval::new(numerator.clone(), numerator, exponent)
    }

    pub(super) fn is_point(&self) -> bool {
        self.low == self.high
    }

    /// The sign of `q` on the whole interval, if an enclosure of its values shows one.
    ///
    /// Horner's rule on intervals; the ends are not negative, so each bound of a product comes from
    /// one product.
    pub(super) fn sign_of(&self, q: &Poly<Z>) -> Option<Ordering> {
        let (below, above) = self.range_of(q);
        match (below.sign(), above.sign()) {
            (Ordering::Greater, _) => Some(Ordering::Greater),
            (_, Ordering::Less) => Some(Ordering::Less),
            (Ordering::Equal, Ordering::Equal) => Some(Ordering::Equal),
            _ => None,
        }
    }

    /// Bounds of `2^(exponent degree) q` on the interval.
    pub(super) fn range_of(&self, q: &Poly<Z>) -> (Z, Z) {
        let Some(leading) = q.leading() else {
            return (Z::zero(), Z::zero());
        };
        let (mut below, mut above) = (leading.clone(), leading.clone());
        let mut weight = 0;
        for coefficient in q.coefficients().iter().rev().skip(1) {
            weight += self.exponent;
            let coefficient = coefficient.shl(weight);
            below = below.mul(if below.sign().is_lt() {
                &self.high
            } else {
                &self.low
            });
            above = above.mul(if above.sign().is_lt() {
                &self.low
            } else {
                &self.high
            });
            below.add_assign(&coefficient);
            above.add_assign(&coefficient);
        }
        (below, above)
    }

    /// Narrows to a width of at most `2^-bits` around the root of `poly` that it isolates.
    ///
    /// Quadratic interval refinement (Abbott 2006, "Quadratic interval refinement for real roots"):
    /// a chord says in which of `2^stride` parts the root should lie; if it does, the stride
    /// doubles, else it halves.
    pub(super) fn refine(&mut self, poly: &Poly<Z>, bits: u64) {
        while !self.is_point() && self.high.sub(&self.low).shl(bits) > Z::one().shl(self.exponent) {
            self.refine_once(poly);
        }
    }

    fn refine_once(&mut self, poly: &Poly<Z>) {
        let at_low = poly.evaluate_dyadic(&self.low, self.exponent);
        let at_high = poly.evaluate_dyadic(&self.high, self.exponent);
        let (numerator, denominator) = if at_low.sign().is_lt() {
            (at_low.neg(), at_high.sub(&at_low))
        } else {
            (at_low.clone(), at_low.sub(&at_high))
        };
        let part = numerator.shl(self.stride).div_floor(&denominator);
        let width = self.high.sub(&self.low);
        let exponent = self.exponent + self.stride;
        let left = self.low.shl(self.stride).add(&part.mul(&width));
        let right = left.add(&width);
        self.low = self.low.shl(self.stride);
        self.high = self.high.shl(self.stride);
        self.exponent = exponent;
        let before = at_low.sign();
        self.split_at(poly, left.clone(), before);
        self.split_at(poly, right.clone(), before);
        let hit = self.is_point() || (self.low == left && self.high == right);
        self.stride = if hit {
            self.stride * 2
        } else {
            (self.stride / 2).max(1)
        };
        self.reduce();
    }

    /// Cuts the interval at `cut / 2^exponent` and keeps the part with the root; `before` is the
    /// sign of `poly` at the low end. A cut outside changes nothing.
    pub(super) fn split_at(&mut self, poly: &Poly<Z>, cut: Z, before: Ordering) {
        if cut <= self.low || cut >= self.high {
            return;
        }
        match poly.evaluate_dyadic(&cut, self.exponent).sign() {
            Ordering::Equal => {
                self.low = cut.clone();
                self.high = cut;
            }
            sign if sign == before => self.low = cut,
            _ => self.high = cut,
        }
    }

    /// Says that the interval is narrow enough for chords to hit.
    pub(super) fn expect_quadratic(&mut self) {
        self.stride = 32;
    }

    /// Writes the ends over the smallest power of two.
    pub(super) fn reduce(&mut self) {
        let zeros = |z: &Z| {
            if z.is_zero() {
                u64::MAX
            } else {
                z.trailing_zeros()
            }
        };
        let spare = zeros(&self.low).min(zeros(&self.high)).min(self.exponent);
        if spare > 0 {
            self.low = self.low.shr_floor(spare);
            self.high = self.high.shr_floor(spare);
            self.exponent -= spare;
        }
    }

    /// Writes the ends over `2^exponent`, at least as large a power as now.
    pub(super) fn widen_exponent(&mut self, exponent: u64) {
        if exponent > self.exponent {
            let more = exponent - self.exponent;
            self.low = self.low.shl(more);
            self.high = self.high.shl(more);
            self.exponent = exponent;
        }
    }
}

//! The quotient of two polynomials at the root in a bracket.

use std::cmp::Ordering;

use super::super::dyadic::Dyadic;
use super::super::enclosure::FIRST;
use super::super::integer::{Integer, ratio};
use super::super::poly::Poly;
use super::{Bracket, FAR, most_bits};

impl<const N: usize> Bracket<'_, N> {
    /// `n / d` at the root, which is in `[0, 1]`.
    ///
    /// The error is at most [`PARAMETER_ERROR`](super::super::PARAMETER_ERROR), `2^-50`. The exact
    /// quotient is between two numbers, each known up to 3/2 2^-52; the middle of what is known of
    /// them is taken once these are not more than 4 2^-52 apart, which adds 2 2^-52, and is
    /// rounded.
    ///
    /// It ends: the denominator is not 0 at the root, so that narrowing brings the two numbers
    /// together as near as one likes. What is known of each then differs by a unit in the last
    /// place, 2^-52, in numerator, denominator and quotient: by not more than 3 2^-52. Where a host
    /// rounds otherwise it may be more, and the lower end is taken for the root in the end.
    pub(in crate::certified::exact) fn quotient(&self, n: &Poly<N>, d: &Poly<N>) -> f64 {
        let mut bracket = self.clone();
        let most = self.most_exponent(common_degree(n, d), most_bits(n).max(most_bits(d)));
        // Ends: each turn narrows it, so that its exponent comes to be as large.
        while bracket.exponent() < most {
            if let Some(value) = bracket.try_quotient(n, d) {
                if bracket.exponent() >= FAR {
                    self.keep(bracket);
                }
                return value;
            }
            // Before that the place does not depend on what else was asked.
            if bracket.exponent() >= FAR {
                bracket.is_far = true;
                bracket.narrow_as_kept();
            }
            if let Some(at) = bracket.refine() {
                return exact_ratio(n, d, &at);
            }
        }
        exact_ratio(n, d, &bracket.low.at)
    }

    /// The same, if it is known near enough in this bracket.
    fn try_quotient(&self, n: &Poly<N>, d: &Poly<N>) -> Option<f64> {
        let degree = common_degree(n, d).max(1);
        let variations = [n, d].map(|q| self.variation(q, degree));
        let enclosed = self.enclosed_bounds([n, d], degree, &variations);
        let (low, high) = enclosed.unwrap_or_else(|| {
            let values = [n, d].map(|q| self.value_at_low(q, degree));
            quotient_bounds(values, &variations)
        })?;
        (high - low <= 4.0 * f64::EPSILON).then(|| (0.5 * (low + high)).min(1.0))
    }

    /// The bounds of the quotient, from enclosures of the values at `low` if these tell them to the
    /// last bit: they are monotonic in both values.
    fn enclosed_bounds(
        &self,
        [n, d]: [&Poly<N>; 2],
        degree: usize,
        variations: &[Integer; 2],
    ) -> Option<Option<(f64, f64)>> {
        let unit = -(degree as i64 * self.exponent() as i64);
        n.told(&self.low.at, &self.enough, |n| {
            let d = d.enclose(&self.low.at, self.enough.get().max(FIRST));
            let ([n_low, n_high], [d_low, d_high]) = (n.bounds(unit)?, d.bounds(unit)?);
            if d_low.sign() != d_high.sign() {
                return None;
            }
            let corners = match d_low.sign() {
                Ordering::Less => [[n_high, d_low], [n_low, d_high]],
                _ => [[n_low, d_high], [n_high, d_low]],
            };
            let [least, most] = corners.map(|values| quotient_bounds(values, variations));
            (least.is_some() && least == most).then_some(least)
        })
    }
}

/// Between which numbers `n / d` is, for values that vary by so much, if `d` has one sign.
fn quotient_bounds(
    [mut n, mut d]: [Integer; 2],
    [n_by, d_by]: &[Integer; 2],
) -> Option<(f64, f64)> {
    if d.sign().is_lt() {
        n.negate();
        d.negate();
    }
    if !d.exceeds(d_by) {
        return None;
    }
    let (least, most) = (Integer::difference(&n, n_by), Integer::sum(&n, n_by));
    let (narrow, wide) = (Integer::difference(&d, d_by), Integer::sum(&d, d_by));
    let low = if least.sign().is_gt() {
        ratio(&least, &wide)
    } else {
        0.0
    };
    Some((low, ratio(&most, &narrow)))
}

/// `n / d` at a time, which is in `[0, 1]`.
pub(in crate::certified::exact) fn exact_ratio<const N: usize>(
    n: &Poly<N>,
    d: &Poly<N>,
    at: &Dyadic,
) -> f64 {
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

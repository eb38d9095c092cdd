//! Contact at a distance: when the two sides first come within a radius of each other.
//!
//! Let `R` be the radius and `s > 0` the first time at which the distance is at most `R`. Then it
//! is `R` at `s`. Of the pairs of features that hold the nearest points at `s` take the one with
//! the fewest points: what its features span is at the distance `R`, with the nearest points
//! strictly inside the features. So `s` is a root of `P = numerator - R^2 denominator` of that
//! [`Pair`]. It is not identically 0: if it were, the features would be `R` apart before `s` too,
//! their nearest points still inside. Conversely, where a pair holds and its `P` is 0 the distance
//! is at most `R`.
//!
//! So the candidates are 0 and, of each pair whose `P` is not identically 0, the roots of it at
//! which the pair holds; the first of them is the time.

use crate::algebraic::{Algebraic, decompose, isolate_roots};
use crate::field::Integer;
use crate::poly::Poly;

use super::locus::Locus;
use super::motion::Motion;
use super::pair::Pair;

/// The distance of the two sides, as pairs of features.
pub(super) struct Proximity<Z> {
    pairs: Vec<Pair<Z>>,
    /// A coordinate is its integer times `2^exponent` metres.
    exponent: i64,
}

/// The square of a distance, `numerator / 2^shift` in units of the squared integers.
pub(super) struct Square<Z> {
    numerator: Z,
    shift: u64,
}

impl<Z: Integer> Square<Z> {
    /// Of the distance that is the sum of these numbers in metres, where 1 is `2^exponent` metres.
    pub(super) fn new(terms: &[f64], exponent: i64) -> Self {
        let terms = || {
            terms
                .iter()
                .filter(|term| **term != 0.0)
                .map(|&term| decompose(term))
        };
        let unit = terms().map(|(_, own)| own).min().unwrap_or(0);
        let mut sum = Z::zero();
        for (mantissa, own) in terms() {
            sum.add_assign(&Z::from_i64(mantissa).shl(own.abs_diff(unit)));
        }
        let square = sum.mul(&sum);
        let exponent = 2 * (unit - exponent);
        let (numerator, shift) = match exponent {
            0.. => (square.shl(exponent.unsigned_abs()), 0),
            _ => (square, exponent.unsigned_abs()),
        };
        Square { numerator, shift }
    }

    /// `P` times `2^shift`.
    pub(super) fn excess(&self, pair: &Pair<Z>) -> Poly<Z> {
        let mut excess = pair.numerator.scale(&Z::one().shl(self.shift));
        excess.sub_product(&Poly::constant(self.numerator.clone()), &pair.denominator);
        excess
    }
}

impl<Z: Integer> Proximity<Z> {
    /// Of a motion in units of `2^exponent` metres.
    pub(super) fn new(motion: &dyn Motion<Z>, exponent: i64) -> Self {
        Proximity {
            pairs: motion.pairs(),
            exponent,
        }
    }

    /// Of a motion of which all lengths are multiplied by something above 0, of which this is the
    /// square.
    pub(super) fn enlarged(motion: &dyn Motion<Z>, exponent: i64, square: &Poly<Z>) -> Self {
        let mut proximity = Proximity::new(motion, exponent);
        for pair in &mut proximity.pairs {
            pair.denominator = pair.denominator.mul(square);
        }
        proximity
    }

    /// The pairs with their `P`. A radius here is a sum of numbers in metres.
    fn excesses(&self, radius: &[f64]) -> impl Iterator<Item = (&Pair<Z>, Poly<Z>)> {
        let square = Square::new(radius, self.exponent);
        let pairs = self.pairs.iter();
        pairs.map(move |pair| (pair, square.excess(pair)))
    }

    /// Whether the distance is at most the radius at a time of the step.
    pub(super) fn is_within(&self, radius: &[f64]) -> bool {
        let start = Algebraic::zero();
        self.excesses(radius).any(|(pair, excess)| {
            start.sign_of(&excess).is_le() && pair.holds(&start)
                || isolate_roots(&excess).iter().any(|time| pair.holds(time))
        })
    }

    /// The first time of the step at which the distance is at most the radius.
    pub(super) fn first_within(&self, radius: &[f64]) -> Option<Algebraic<Z>> {
        let start = Algebraic::zero();
        let excesses: Vec<_> = self.excesses(radius).collect();
        let is_near = |(pair, excess): &(&Pair<Z>, Poly<Z>)| {
            start.sign_of(excess).is_le() && pair.holds(&start)
        };
        if excesses.iter().any(is_near) {
            return Some(start);
        }
        let mut first: Option<Algebraic<Z>> = None;
        for (pair, excess) in &excesses {
            let is_earlier = |time: &Algebraic<Z>| {
                first
                    .as_ref()
                    .is_none_or(|first| time.compare(first).is_lt())
            };
            let roots = isolate_roots(excess).into_iter();
            let earlier = roots.take_while(is_earlier).find(|time| pair.holds(time));
            first = earlier.or(first);
        }
        first
    }

    /// Every time at which a pair is as far apart as the radius and its nearest points are on its
    /// features.
    pub(super) fn times_at(&self, radius: &[f64]) -> Vec<Algebraic<Z>> {
        let of_pair = |(pair, excess): (&Pair<Z>, Poly<Z>)| {
            let mut times = isolate_roots(&excess);
            times.retain(|time| pair.holds(time));
            times
        };
        self.excesses(radius).flat_map(of_pair).collect()
    }

    /// The nearest points at a time; of several, those of the first pair.
    pub(super) fn nearest(&self, motion: &dyn Motion<Z>, time: &Algebraic<Z>) -> Locus<Z> {
        if let Some(overlap) = motion.overlap(time) {
            return overlap;
        }
        let mut nearest: Option<&Pair<Z>> = None;
        // Vertices always hold, so there is one.
        for pair in self.pairs.iter().filter(|pair| pair.holds(time)) {
            if nearest.is_none_or(|nearest| pair.is_nearer(nearest, time)) {
                nearest = Some(pair);
            }
        }
        Locus::at(nearest.unwrap_or(&self.pairs[0]).place.clone())
    }
}

//! Times that are fractions of small numbers: those of contact between points with small
//! coordinates.

use std::cmp::Ordering;

use super::dyadic::decompose;
use super::grid_time::GridTime;

/// The time `numerator / denominator`, in `(0, 1)`; with a denominator below [`Fraction::LIMIT`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Fraction {
    pub(super) numerator: u64,
    pub(super) denominator: u64,
}

impl Fraction {
    /// Denominators are below this.
    pub(super) const LIMIT: u64 = 1 << 12;

    /// The fraction that a time may be the rounded value of: the first convergent of its continued
    /// fraction that is next to it.
    pub(super) fn near(time: f64) -> Option<Self> {
        let (mut last, mut current) = ((1, 0), (0, 1));
        let mut rest = time;
        // Ends: whatever the rest is, a whole number of at least 1 is taken, so that the
        // denominators grow as Fibonacci's numbers do, up to the limit.
        loop {
            rest = rest.recip();
            // Saturates where it is infinite.
            let whole = u64::from(rest as u32);
            rest -= whole as f64;
            // 0 for NaN, and for what rounding has made negative.
            if !(1..Self::LIMIT).contains(&whole) {
                return None;
            }
            let next = |last, current| whole * current + last;
            (last, current) = (current, (next(last.0, current.0), next(last.1, current.1)));
            let (numerator, denominator) = current;
            if denominator >= Self::LIMIT {
                return None;
            }
            let distance = time * denominator as f64 - numerator as f64;
            if distance.abs() <= denominator as f64 * NEAR {
                let is_inside = 0 < numerator && numerator < denominator;
                return is_inside.then_some(Fraction {
                    numerator,
                    denominator,
                });
            }
        }
    }

    /// Its neighbours in `f64`: the largest one that is not above it and the smallest one that is
    /// not below it.
    pub(super) fn neighbours(self) -> (f64, f64) {
        let nearest = self.numerator as f64 / self.denominator as f64;
        // The quotient is above 2^-12, so that its last bit is above 2^-66.
        let (mantissa, exponent) = decompose(nearest);
        let product = u128::from(mantissa.unsigned_abs()) * u128::from(self.denominator);
        match product.cmp(&(u128::from(self.numerator) << exponent.unsigned_abs())) {
            Ordering::Less => (nearest, nearest.next_up()),
            Ordering::Equal => (nearest, nearest),
            Ordering::Greater => (nearest.next_down(), nearest),
        }
    }

    /// Compared with a time on the grid.
    pub(super) fn compare_grid_time(self, at: GridTime) -> Ordering {
        // at d and 2^128 n, the low words apart from the others
        let denominator = u128::from(self.denominator);
        let low = u128::from(at.0 as u64) * denominator;
        let high = (at.0 >> 64) * denominator + (low >> 64);
        (u128::from(self.numerator) << 64, 0).cmp(&(high, low as u64))
    }

    /// `self` compared with `other`.
    pub(super) fn compare(self, other: Self) -> Ordering {
        (self.numerator * other.denominator).cmp(&(other.numerator * self.denominator))
    }
}

/// How near a fraction a rounded time is taken for it, until that is proved or disproved.
const NEAR: f64 = 64.0 * f64::EPSILON;

#[cfg(test)]
mod tests;

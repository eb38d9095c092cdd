//! Times on a grid: multiples of 2^-128 strictly inside the step.
//!
//! Every `f64` from 2^-75 on is on the grid, and the grid has at least 2^22 numbers between any two
//! neighbours among them.

use super::dyadic::{Dyadic, decompose};
use super::integer::Integer;

/// The time `self.0 / 2^128`, in `(0, 1)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct GridTime(pub(super) u128);

/// A number that is no multiple of the grid's unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OffGrid;

impl GridTime {
    /// The time of this value, if it is on the grid.
    pub(super) fn from_f64(value: f64) -> Option<Self> {
        if !(value > 0.0 && value < 1.0) {
            return None;
        }
        let (mantissa, exponent) = decompose(value);
        let shift = u32::try_from(exponent + 128).ok()?;
        Some(GridTime(u128::from(mantissa.unsigned_abs()) << shift))
    }

    /// The time of this number: `None` if it is 0 or 1, the start or the end of the step.
    ///
    /// # Errors
    ///
    /// [`OffGrid`] if it is finer than the grid.
    pub(super) fn from_dyadic(at: &Dyadic) -> Result<Option<Self>, OffGrid> {
        let missing = 128u64.checked_sub(at.exponent).ok_or(OffGrid)?;
        let (high, _) = at.numerator.shifted(missing).window(64);
        let (low, _) = at.numerator.shifted(missing).window(0);
        let is_end = at.exponent == 0;
        let grid_time = u128::from(high) << 64 | u128::from(low);
        Ok((!is_end && grid_time != 0).then_some(GridTime(grid_time)))
    }

    /// The time in floating point, rounded.
    pub(super) fn to_f64(self) -> f64 {
        self.0 as f64 * UNIT
    }

    /// The largest `f64` that is not above the time.
    pub(super) fn below(self) -> f64 {
        let dropped = 75u32.saturating_sub(self.0.leading_zeros());
        (self.0 >> dropped << dropped) as f64 * UNIT
    }

    /// The smallest `f64` that is not below the time.
    pub(super) fn above(self) -> f64 {
        let dropped = 75u32.saturating_sub(self.0.leading_zeros());
        let below = self.below();
        let is_exact = self.0 & ((1 << dropped) - 1) == 0;
        if is_exact { below } else { below.next_up() }
    }

    /// The same time.
    pub(super) fn to_dyadic(self) -> Dyadic {
        let limbs = [self.0 as u64, (self.0 >> 64) as u64];
        Dyadic::new(Integer::from_magnitude(false, &limbs), 128)
    }

    /// How far `other` is behind `self`, times `2^128`, rounded up.
    pub(super) fn distance(self, other: GridTime) -> f64 {
        ((other.0 - self.0) as f64).next_up()
    }
}

/// 2^-128.
const UNIT: f64 = f64::from_bits((1023 - 128) << 52);

#[cfg(test)]
mod tests;

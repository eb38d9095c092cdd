//! A simple root narrowed to the last bit with numbers of fixed width.
//!
//! Floating point proposes where the root is, a Newton step from the exact value there corrects the
//! proposal far beyond the last bit, and exact signs on both sides of it are the proof. Where that
//! does not succeed, or the root is below 2^-75, the caller goes on with [`super::bracket`].

use std::cmp::Ordering;

use super::bracket::MOST_BITS;
use super::curve::Curve;
use super::estimate::{between, estimate_root, slope};
use super::fraction::Fraction;
use super::grid_time::GridTime;
use super::width::Width;

/// A root that is a fraction of small numbers, or on the grid, or between two numbers of it that
/// are between neighbours in `f64`.
#[derive(Clone, Copy, Debug)]
pub(super) enum RefinedRoot {
    Fraction(Fraction),
    At(GridTime),
    Between(GridTime, GridTime),
}

/// Numbers on both sides of the only root between them.
struct Sides<'a, L: Width> {
    curve: &'a Curve<L>,
    before: Ordering,
    /// Just before and just after the root, as far as is proved.
    low: Option<GridTime>,
    high: Option<GridTime>,
}

/// Pins down the only root of a polynomial strictly between `low` and `high` (the start and the end
/// of the step where there is none), a simple one. `before` is the sign between `low` and the root.
pub(super) fn refine_root<L: Width>(
    curve: &Curve<L>,
    before: Ordering,
    low: Option<GridTime>,
    high: Option<GridTime>,
) -> Option<RefinedRoot> {
    let coefficients = curve.approximate();
    let from = low.map_or(0.0, GridTime::to_f64);
    let to = high.map_or(1.0, GridTime::to_f64);
    let estimate = estimate_root(&coefficients, from, to, before);
    let is_the_root = |at: &Fraction| {
        low.is_none_or(|low| at.compare_grid_time(low).is_gt())
            && high.is_none_or(|high| at.compare_grid_time(high).is_lt())
            && curve.is_root(*at)
    };
    if let Some(at) = Fraction::near(estimate).filter(is_the_root) {
        return Some(RefinedRoot::Fraction(at));
    }
    let at = GridTime::from_f64(estimate)?;
    let mut sides = Sides {
        curve,
        before,
        low,
        high,
    };
    let (sign, value) = curve.sample(at);
    if sides.is_strictly_between(at) && sides.move_to(at, sign).is_eq() {
        return Some(RefinedRoot::At(at));
    }
    // The step is right to about half of the bits of an `f64`, or it is of no use.
    let floor = ulp(at) >> 34;
    let is_near = sides.approach(at, -value / slope(&coefficients, estimate), floor);
    if is_near.is_none()
        && let Some(at) = sides.refine()
    {
        return Some(RefinedRoot::At(at));
    }
    sides.part_from_f64()
}

/// Moves both sides of a root nearer to it; neither of them is a root.
pub(super) fn tighten<L: Width>(
    curve: &Curve<L>,
    before: Ordering,
    low: GridTime,
    high: GridTime,
) -> Option<(GridTime, GridTime)> {
    let mut sides = Sides {
        curve,
        before,
        low: Some(low),
        high: Some(high),
    };
    let (_, value) = curve.sample(low);
    let slope = slope(&curve.approximate(), low.to_f64());
    sides.approach(low, -value / slope, 0)?;
    Some((sides.low?, sides.high?))
}

/// The unit in the last place of an `f64` near a time, times `2^128`.
fn ulp(at: GridTime) -> u128 {
    1 << 75u32.saturating_sub(at.0.leading_zeros())
}

impl<L: Width> Sides<'_, L> {
    fn is_strictly_between(&self, at: GridTime) -> bool {
        self.low.is_none_or(|low| low < at) && self.high.is_none_or(|high| at < high)
    }

    /// The root compared with a number strictly between the sides, given the sign there; moves a
    /// side unless it is the root.
    fn move_to(&mut self, at: GridTime, sign: Ordering) -> Ordering {
        if sign.is_eq() {
            Ordering::Equal
        } else if sign == self.before {
            self.low = Some(at);
            Ordering::Greater
        } else {
            self.high = Some(at);
            Ordering::Less
        }
    }

    fn cut(&mut self, at: GridTime) -> Ordering {
        let (sign, _) = self.curve.sample(at);
        self.move_to(at, sign)
    }

    /// Moves both sides near `at + step`: by a fraction of the step or `floor`, or more where that
    /// is too near.
    fn approach(&mut self, at: GridTime, step: f64, floor: u128) -> Option<()> {
        let offset = step * 2f64.powi(128);
        // False for NaN as well.
        let is_inside = offset.abs() < 2f64.powi(127);
        if !is_inside {
            return None;
        }
        let mut reach = (offset.abs() / 2f64.powi(24)) as u128 + floor + 1;
        let centre = if offset < 0.0 {
            at.0.checked_sub(offset.abs() as u128)
        } else {
            at.0.checked_add(offset as u128)
        }?;
        // Ends: the reach is at least 1 and grows by 12 bits each time, up to 85 bits.
        while reach < ulp(at) << 10 {
            let low = GridTime(centre.checked_sub(reach)?);
            let high = GridTime(centre.checked_add(reach)?);
            let is_above_low = !self.is_strictly_between(low) || self.cut(low).is_gt();
            let is_below_high = !self.is_strictly_between(high) || self.cut(high).is_lt();
            if is_above_low && is_below_high {
                return Some(());
            }
            reach <<= 12;
        }
        None
    }

    /// Moves both sides to the root as [`Bracket`](super::bracket::Bracket) does, as far as the
    /// grid goes, without the help of the slope, which floating point does not know near another
    /// root. Returns the root if it is met.
    fn refine(&mut self) -> Option<GridTime> {
        let value = |side: Option<GridTime>, at_end: f64| {
            let inside = side.map(|at| self.curve.sample(at).1);
            inside.unwrap_or(at_end).abs()
        };
        let c = self.curve.approximate();
        let mut low_value = value(self.low, c[0]);
        let mut high_value = value(self.high, c.iter().sum());
        let mut bits = 1;
        // Ends: the values only choose a cell. A cell that is right narrows what is between the
        // sides by its bits, one that is wrong halves these, and two cells halve it either way,
        // until it is of one cell of the grid.
        loop {
            // The end of the step is 2^128, wrapped around.
            let [start, end] = [self.low, self.high].map(|side| side.map_or(0, |at| at.0));
            let cell = end.wrapping_sub(start) >> bits;
            if cell == 0 && bits == 1 {
                return None;
            }
            let cells = 1u128 << bits;
            let index = (cells as f64 / (1.0 + high_value / low_value)) as u128;
            let index = index.min(cells - 1);
            let mut is_right = cell > 0;
            for (index, side) in [(index, Ordering::Greater), (index + 1, Ordering::Less)] {
                if is_right && index > 0 && index < cells {
                    let at = GridTime(start + index * cell);
                    let (sign, value) = self.curve.sample(at);
                    let order = self.move_to(at, sign);
                    match order {
                        Ordering::Equal => return Some(at),
                        Ordering::Greater => low_value = value.abs(),
                        Ordering::Less => high_value = value.abs(),
                    }
                    is_right = order == side;
                }
            }
            bits = if is_right {
                (2 * bits).min(MOST_BITS)
            } else {
                (bits / 2).max(1)
            };
        }
    }

    /// Moves the sides until they are between neighbours in `f64`.
    fn part_from_f64(mut self) -> Option<RefinedRoot> {
        // Ends: each turn halves how many numbers of `f64` there are between the sides. Those on
        // the grid are converted exactly, in any rounding mode, and none of them is subnormal.
        loop {
            let (low, high) = (self.low?, self.high?);
            let (below, above) = (low.below(), high.above());
            let Some(cut) = between(below, above) else {
                return Some(RefinedRoot::Between(low, high));
            };
            let at = GridTime::from_f64(cut)?;
            if self.cut(at).is_eq() {
                return Some(RefinedRoot::At(at));
            }
        }
    }
}

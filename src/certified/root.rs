//! Stage 4: intervals that hold exactly one simple root of `f`, certified in `f64`.

use super::cubic::{Cubic, have_one_sign};
use super::ends::{larger, smaller};
use super::separate::U;
use super::stage::Finding;

/// An interval that holds exactly one root of `f`, a simple one, strictly inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket {
    pub(super) low: f64,
    pub(super) high: f64,
    /// Whether `f` rises through 0.
    pub(super) is_rising: bool,
}

impl Bracket {
    /// From one time to another, whatever roots there are.
    #[inline(always)]
    pub(super) fn around(low: f64, high: f64) -> Self {
        Bracket {
            low,
            high,
            is_rising: false,
        }
    }

    /// The same root, of which a time is the largest `f64` below it.
    #[inline(always)]
    pub(super) fn from(&self, toi: f64) -> Self {
        Bracket {
            low: toi,
            high: toi.next_up(),
            ..*self
        }
    }
}

/// Roots of `f` in `[0, 1]`, ascending.
#[derive(Clone, Copy, Debug)]
pub(super) struct Brackets {
    brackets: [Bracket; 3],
    count: usize,
}

impl Brackets {
    pub(super) fn as_slice(&self) -> &[Bracket] {
        &self.brackets[..self.count]
    }
}

/// What is certain about the roots in a half of `[0, 1]`.
pub(super) struct Half {
    /// A bracket of the root, if there is one.
    pub(super) bracket: Bracket,
    pub(super) has_none: bool,
    pub(super) has_one: bool,
}

impl Cubic {
    /// Brackets of all roots in `[0, 1]` but those of which `is_apart` says that the two sides do not
    /// touch at any root from one time to another; `None` if some cannot be certified.
    pub(super) fn isolate(&self, is_apart: impl Fn(f64, f64) -> bool) -> Option<Brackets> {
        let mut found = Brackets {
            brackets: [Bracket::around(0.0, 1.0); 3],
            count: 0,
        };
        let end = self.decide_at_roots(is_apart, |bracket| {
            let Some(next) = found.brackets.get_mut(found.count) else {
                return Finding::Undecided;
            };
            *next = *bracket;
            found.count += 1;
            Finding::<()>::Miss
        });
        matches!(end, Finding::Miss).then_some(found)
    }

    /// What is found at the first root at which there is no miss, of those that
    /// [`isolate`](Self::isolate) brackets, whatever comes after it. Undecided if one up to there is
    /// not certain.
    #[inline(always)]
    pub(super) fn decide_at_roots<H>(
        &self,
        is_apart: impl Fn(f64, f64) -> bool,
        mut decide_at: impl FnMut(&Bracket) -> Finding<H>,
    ) -> Finding<H> {
        self.decide_in(self.whole(), &is_apart, &mut decide_at)
    }

    /// Halves `part` until each piece has no root, or none that matters, or one that can be
    /// bracketed, from the start on.
    fn decide_in<H>(
        &self,
        part: Part,
        is_apart: &impl Fn(f64, f64) -> bool,
        decide_at: &mut impl FnMut(&Bracket) -> Finding<H>,
    ) -> Finding<H> {
        let error = self.part_error();
        if have_one_sign(&part.bernstein, error) {
            return Finding::Miss;
        }
        let [falls, rises] = part.falls_or_rises(error);
        if falls || rises {
            let (bracket, is_certain) = self.bracket(&part, rises);
            if is_certain {
                return decide_at(&bracket);
            }
        }
        // Of the pieces one starts or ends there again, and so stays open.
        let has_open_end = !part.has_certain_ends(error);
        // Ends: at this depth, in any rounding mode.
        let may_halve = part.depth < MAX_DEPTH;
        if has_open_end || !may_halve {
            match self.is_settled(&part, is_apart) {
                Some(true) => return Finding::Miss,
                Some(false) if may_halve => {}
                _ => return Finding::Undecided,
            }
        }
        let [lower, upper] = part.halves();
        match self.decide_in(lower, is_apart, decide_at) {
            Finding::Miss => self.decide_in(upper, is_apart, decide_at),
            finding => finding,
        }
    }

    /// Whether no root in a part matters; `None` if halving it will not show more: `f` may be 0
    /// throughout, or it may be 0 at an end where the edges are not certain to be apart.
    #[inline(never)]
    fn is_settled(&self, part: &Part, is_apart: &impl Fn(f64, f64) -> bool) -> Option<bool> {
        let error = self.part_error();
        let is_open = |b: f64| !(b.abs() > error);
        let [b0, _, _, b3] = part.bernstein;
        let is_hopeless = part.bernstein.into_iter().all(is_open)
            || is_open(b0) && !is_apart(part.low, part.low)
            || is_open(b3) && !is_apart(part.high, part.high);
        (!is_hopeless).then(|| is_apart(part.low, part.high))
    }

    /// What is certain about the roots in each half of `[0, 1]`, without a branch.
    #[inline(always)]
    pub(super) fn halves(&self) -> [Half; 2] {
        let [lower, upper] = self.whole().halves();
        [self.half(&lower), self.half(&upper)]
    }

    /// The first half of which it is not certain that the two sides are apart at all roots in it. One
    /// half is looked at after the other, with branches.
    #[inline(always)]
    pub(super) fn first_half(&self, is_apart_in: impl Fn(&Half) -> bool) -> Option<Half> {
        let error = self.part_error();
        let halves = self.whole().halves().into_iter();
        let mut open = halves.filter(|part| !have_one_sign(&part.bernstein, error));
        open.find_map(|part| {
            let [falls, rises] = part.falls_or_rises(error);
            if !(falls || rises) {
                let bracket = Bracket::around(part.low, part.high);
                let (has_none, has_one) = (false, false);
                return Some(Half {
                    bracket,
                    has_none,
                    has_one,
                });
            }
            Some(self.half(&part)).filter(|half| !is_apart_in(half))
        })
    }

    /// Whether `f` is certainly not 0 at the start and at the end.
    #[inline(always)]
    pub(super) fn has_certain_ends(&self) -> bool {
        self.whole().has_certain_ends(self.part_error())
    }

    #[inline(always)]
    fn half(&self, part: &Part) -> Half {
        let error = self.part_error();
        let [falls, rises] = part.falls_or_rises(error);
        let (bracket, is_certain) = self.bracket(part, rises);
        Half {
            bracket,
            has_none: have_one_sign(&part.bernstein, error),
            has_one: (falls | rises) & is_certain,
        }
    }

    #[inline(always)]
    fn whole(&self) -> Part {
        Part {
            low: 0.0,
            high: 1.0,
            bernstein: self.bernstein,
            depth: 0,
        }
    }

    /// A bound on the error of the coefficients of parts.
    ///
    /// Subdivision averages neighbours; each level of averages of magnitude B adds at most `3 u B`,
    /// and 16 levels of it less than `48 u P`, three times the bound that it starts from.
    #[inline(always)]
    fn part_error(&self) -> f64 {
        4.0 * self.error
    }

    /// `f` and its derivative.
    ///
    /// Error bound of the value: `1 - t` is rounded once, a term of de Casteljau's sum passes at
    /// most eleven roundings more, so the value is within `12 u P` of that of the given
    /// coefficients and within `12 u P + error` of the exact one; [`Cubic::value_error`] is
    /// `2 error = 32 u P`.
    ///
    /// Of the derivative: three times the difference of two values, each within `25 u P` of the
    /// exact one; [`Cubic::slope_error`] is `12 error = 192 u P`.
    #[inline(always)]
    pub(super) fn evaluate(&self, t: f64) -> (f64, f64) {
        let [b0, b1, b2, b3] = self.bernstein;
        let s = 1.0 - t;
        let (c0, c1, c2) = (s * b0 + t * b1, s * b1 + t * b2, s * b2 + t * b3);
        let (d0, d1) = (s * c0 + t * c1, s * c1 + t * c2);
        (s * d0 + t * d1, 3.0 * (d1 - d0))
    }

    #[inline(always)]
    fn value_error(&self) -> f64 {
        2.0 * self.error
    }

    #[inline(always)]
    pub(super) fn slope_error(&self) -> f64 {
        12.0 * self.error
    }

    /// A short interval around the one root in a part, and whether it is certain to be one: as far
    /// around the next step of Newton's method as that step is long. The interval has a low and a high
    /// end in this order: what rounding takes from `t` and the distance is a few `u P` over the slope,
    /// and the error of a value over the slope, which is added, 64 of these.
    #[inline(always)]
    fn bracket(&self, part: &Part, is_rising: bool) -> (Bracket, bool) {
        let guess = part.guess();
        let (value, slope) = self.evaluate(guess);
        let step = value / slope;
        let distance = step.abs() + 2.0 * self.value_error() / slope.abs() + 2.0 * f64::EPSILON;
        let part = Bracket {
            low: part.low,
            high: part.high,
            is_rising,
        };
        self.within(&part, guess - step, distance)
    }

    /// The part of a bracket up to some distance from `t`, and whether the root is certain to be
    /// there.
    #[inline(always)]
    fn within(&self, bracket: &Bracket, t: f64, distance: f64) -> (Bracket, bool) {
        let (low, high) = (
            larger(t - distance, bracket.low),
            smaller(t + distance, bracket.high),
        );
        let sign = if bracket.is_rising { 1.0 } else { -1.0 };
        let (at_low, at_high) = (sign * self.evaluate(low).0, sign * self.evaluate(high).0);
        let is_certain = (at_low < -self.value_error()) & (at_high > self.value_error());
        (
            Bracket {
                low,
                high,
                ..*bracket
            },
            is_certain,
        )
    }

    /// A bound on the magnitude of the second derivative: `6 (b0 - 2 b1 + b2)` at the start,
    /// `6 (b1 - 2 b2 + b3)` at the end, linear in between.
    ///
    /// Each is computed with an error below `24 error` from the coefficients and `6 * 6 u P`, below
    /// `3 error`, from its own roundings.
    #[inline(always)]
    pub(super) fn curvature(&self) -> f64 {
        let [b0, b1, b2, b3] = self.bernstein;
        let (at_start, at_end) = ((b2 - b1) - (b1 - b0), (b3 - b2) - (b2 - b1));
        6.0 * larger(at_start.abs(), at_end.abs()) + 32.0 * self.error
    }

    /// The least magnitude of the derivative in a bracket that holds a point where it is `slope`; 0
    /// or less, or NaN, if none is certain.
    ///
    /// The difference is rounded relative to the slope. What the last factor does not cover of that,
    /// the bound on the error of the slope does: it is 192 `u P`, where at most 162 are needed.
    #[inline(always)]
    fn least_slope(&self, slope: f64, bracket: &Bracket) -> f64 {
        let width = bracket.high - bracket.low;
        (slope.abs() - self.slope_error() - self.curvature() * width) * (1.0 - 8.0 * U)
    }

    /// A bracket of the same root around `t`, in a bracket in which the derivative has at least some
    /// magnitude above 0.
    #[inline(always)]
    fn narrowed(&self, bracket: &Bracket, t: f64, value: f64, least: f64) -> Bracket {
        // The division and the sums below are rounded.
        let distance = (value.abs() + self.value_error()) / least;
        let distance = distance * (1.0 + 8.0 * U) + 2.0 * U;
        Bracket {
            low: larger(t - distance, bracket.low),
            high: smaller(t + distance, bracket.high),
            ..*bracket
        }
    }

    /// As [`sharpen`](Self::sharpen), by one step without a branch: the least magnitude is 0 or
    /// less, or NaN, where that does not do.
    #[inline(always)]
    pub(super) fn sharpen_once(&self, bracket: &Bracket) -> (Bracket, f64) {
        let t = 0.5 * (bracket.low + bracket.high);
        let (value, slope) = self.evaluate(t);
        let least = self.least_slope(slope, bracket);
        let sharp = self.narrowed(bracket, t, value, least);
        let sharp_least = self.least_slope(slope, &sharp);
        (sharp, if least > 0.0 { sharp_least } else { 0.0 })
    }

    /// A bracket of the same root as small as `f64` can make it, and the least magnitude of the
    /// derivative in it.
    ///
    /// From any `t` in the bracket the root is `f(t) / f'(x)` away, for some `x` in the bracket.
    pub(super) fn sharpen(&self, bracket: &Bracket) -> Option<(Bracket, f64)> {
        let mut bracket = *bracket;
        let mut t = 0.5 * (bracket.low + bracket.high);
        // Ends: after so many steps, converged or not.
        for _ in 0..MAX_NEWTON {
            let (value, slope) = self.evaluate(t);
            let is_converged = value.abs() <= self.value_error();
            if !is_converged {
                // The sign of f is certain at t.
                if (value > 0.0) == bracket.is_rising {
                    bracket.high = t;
                } else {
                    bracket.low = t;
                }
            }
            let least = self.least_slope(slope, &bracket);
            if least > 0.0 {
                bracket = self.narrowed(&bracket, t, value, least);
                if is_converged {
                    return Some((bracket, self.least_slope(slope, &bracket)));
                }
            } else if is_converged {
                // The slope changes too much in the bracket.
                let width = bracket.high - bracket.low;
                let (narrower, is_certain) = self.within(&bracket, t, width / 64.0);
                if !is_certain {
                    return None;
                }
                bracket = narrower;
            }
            let newton = t - value / slope;
            t = if newton > bracket.low && newton < bracket.high {
                newton
            } else {
                0.5 * (bracket.low + bracket.high)
            };
        }
        None
    }
}

const MAX_NEWTON: u32 = 24;
const MAX_DEPTH: u32 = 16;

/// `f` on a part of `[0, 1]`.
#[derive(Clone, Copy)]
struct Part {
    low: f64,
    high: f64,
    bernstein: [f64; 4],
    depth: u32,
}

impl Part {
    /// About where the root is: three steps of Halley's method, each of which about triples the digits
    /// that are right, from where the chord from end to end crosses 0.
    #[inline(always)]
    fn guess(&self) -> f64 {
        let [b0, b1, b2, b3] = self.bernstein;
        // f = b0 + a1 x + a2 x^2 + a3 x^3 for x from 0 to 1.
        let (a1, a2) = (3.0 * (b1 - b0), 3.0 * ((b2 - b1) - (b1 - b0)));
        let a3 = (b3 - b0) - 3.0 * (b2 - b1);
        let step = |x: f64| {
            let inner = a2 + x * a3;
            let f = b0 + x * (a1 + x * inner);
            let slope = a1 + x * (inner + (inner + x * a3));
            let half_curvature = inner + 2.0 * x * a3;
            f * slope / (slope * slope - f * half_curvature)
        };
        let next = |x: f64| smaller(larger(x - step(x), 0.0), 1.0);
        let chord = b0 / (b0 - b3);
        self.low + (self.high - self.low) * next(next(next(chord)))
    }

    /// Whether `f` certainly has one root in the part, a simple one, and falls or rises through it
    /// (Descartes' rule): the signs are `+ ? ? -`, which is one change unless the middle may be
    /// `- +`.
    #[inline(always)]
    fn falls_or_rises(&self, error: f64) -> [bool; 2] {
        let [b0, b1, b2, b3] = self.bernstein;
        let falls = (b0 > error) & (b3 < -error) & ((b1 > error) | (b2 < -error));
        let rises = (b0 < -error) & (b3 > error) & ((b1 < -error) | (b2 > error));
        [falls, rises]
    }

    /// Whether `f` is certainly not 0 at the start and at the end.
    #[inline(always)]
    fn has_certain_ends(&self, error: f64) -> bool {
        let [b0, _, _, b3] = self.bernstein;
        (b0.abs() > error) & (b3.abs() > error)
    }

    /// De Casteljau's algorithm at the middle.
    #[inline(always)]
    fn halves(&self) -> [Part; 2] {
        let [b0, b1, b2, b3] = self.bernstein;
        let (c0, c1, c2) = (0.5 * (b0 + b1), 0.5 * (b1 + b2), 0.5 * (b2 + b3));
        let (d0, d1) = (0.5 * (c0 + c1), 0.5 * (c1 + c2));
        let middle = 0.5 * (d0 + d1);
        let t = 0.5 * (self.low + self.high);
        let depth = self.depth + 1;
        [
            Part {
                low: self.low,
                high: t,
                bernstein: [b0, c0, d0, middle],
                depth,
            },
            Part {
                low: t,
                high: self.high,
                bernstein: [middle, d1, c2, b3],
                depth,
            },
        ]
    }
}

#[cfg(test)]
mod tests;

//! Times of the step and the signs of polynomials at them.
//!
//! A sign is taken from the cheapest source that shows it: floating point, whole numbers of fixed
//! width, integers of any size ([`super::sturm`]), of which the last one always does.

use std::cmp::Ordering;

use super::algebraic_time::AlgebraicTime;
use super::bracket::Bracket;
use super::curve::Curve;
use super::dyadic::Dyadic;
use super::fraction::Fraction;
use super::grid_time::GridTime;
use super::integer::TWO_64;
use super::isolate::{Isolated, Place};
use super::motion::Quadratic;
use super::poly::Poly;
use super::refine_root::{RefinedRoot, refine_root, tighten};
use super::roots::Source;
use super::width::{Number, Width};

/// An exact time, between its neighbours in `f64`.
pub(super) struct Time<'a, L: Width> {
    /// The largest `f64` that is not above the time.
    pub(super) below: f64,
    /// The smallest `f64` that is not below the time.
    pub(super) above: f64,
    exact: Exact<'a, L>,
}

enum Exact<'a, L: Width> {
    Start,
    End,
    At(GridTime),
    /// A root that is this number, the only one strictly between two times.
    Fraction {
        at: Fraction,
        of: Source<'a, L>,
        before: Ordering,
        low: Option<GridTime>,
        high: Option<GridTime>,
    },
    /// The only root strictly between two times, neither of which is a root.
    Root {
        of: Source<'a, L>,
        before: Ordering,
        low: GridTime,
        high: GridTime,
    },
    /// Off the grid.
    Dyadic(Dyadic),
    /// Not pinned down on the grid.
    Bracket(Bracket<'a>),
}

impl<'a, L: Width> Time<'a, L> {
    /// The start of the step.
    pub(super) fn start() -> Self {
        Time {
            below: 0.0,
            above: 0.0,
            exact: Exact::Start,
        }
    }

    /// The end of the step.
    pub(super) fn end() -> Self {
        Time {
            below: 1.0,
            above: 1.0,
            exact: Exact::End,
        }
    }

    /// The only root strictly between two times (`None` is the start or the end of the step), a
    /// simple one with the sign `before` before it.
    #[inline(never)]
    pub(super) fn of_root(
        of: Source<'a, L>,
        before: Ordering,
        low: Option<GridTime>,
        high: Option<GridTime>,
    ) -> Self {
        match refine_root(of.curve, before, low, high) {
            Some(RefinedRoot::Fraction(at)) => {
                let (below, above) = at.neighbours();
                Time {
                    below,
                    above,
                    exact: Exact::Fraction {
                        at,
                        of,
                        before,
                        low,
                        high,
                    },
                }
            }
            Some(RefinedRoot::At(at)) => Time {
                below: at.below(),
                above: at.above(),
                exact: Exact::At(at),
            },
            Some(RefinedRoot::Between(low, high)) => Time {
                below: low.below(),
                above: high.above(),
                exact: Exact::Root {
                    of,
                    before,
                    low,
                    high,
                },
            },
            None => Time::between(of.unproved(before, low, high)),
        }
    }

    /// The time of an isolated root.
    #[inline(never)]
    pub(super) fn of_isolated(isolated: &'a Isolated, index: usize) -> Self {
        match &isolated.cells()[index].place {
            Place::At(at) => Time::at(at.clone()),
            Place::Between {
                poly,
                low,
                high,
                before,
            } => {
                let poly = isolated.poly(*poly);
                Time::between(Bracket::new(poly, low.clone(), high.clone(), *before))
            }
        }
    }

    /// The only root strictly between the ends of a bracket.
    #[inline(never)]
    pub(super) fn between(bracket: Bracket<'a>) -> Self {
        let (moment, [below, above]) = AlgebraicTime::settled(bracket);
        Time {
            below,
            above,
            exact: match moment {
                AlgebraicTime::At(at) => Exact::Dyadic(at),
                AlgebraicTime::Between(bracket) => Exact::Bracket(bracket),
            },
        }
    }

    fn at(at: Dyadic) -> Self {
        Time {
            below: at.below(),
            above: at.above(),
            exact: Exact::Dyadic(at),
        }
    }

    /// Whether it is strictly inside the step.
    pub(super) fn is_inside(&self) -> bool {
        self.above > 0.0 && self.below < 1.0
    }

    /// The sign of a polynomial at the time.
    pub(super) fn sign_of(&self, q: &Quadratic<L>) -> Ordering {
        let quick = self.quick_value_of(q).and_then(sign);
        quick.unwrap_or_else(|| self.exact_sign_of(q))
    }

    /// The same in integers. A function by itself, as its callers ask for many signs, and each
    /// would take room on their stack.
    #[inline(never)]
    fn exact_sign_of(&self, q: &Quadratic<L>) -> Ordering {
        match &self.exact {
            Exact::At(at) => L::quadratic_at(q, at.0).sign(),
            Exact::Root {
                of,
                before,
                low,
                high,
            } => {
                let (value, variation) = range::<L>(q, *low, *high);
                if value > variation {
                    Ordering::Greater
                } else if value < -variation {
                    Ordering::Less
                } else if of.is_multiple(q) {
                    Ordering::Equal
                } else {
                    of.bracket(*before, *low, *high).sturm_sign_of(Poly::new(q))
                }
            }
            Exact::Bracket(bracket) => bracket.sign_of(Poly::new(q)),
            Exact::Dyadic(at) => Poly::<3>::new(q).sign_at(at),
            // These are quick.
            Exact::Start | Exact::End | Exact::Fraction { .. } => Ordering::Equal,
        }
    }

    /// About the value of a polynomial, with the right sign, where floating point shows that; 0 for
    /// the polynomial that is identically 0.
    ///
    /// With coefficients of a relative error of 2^-52, and `t` off by at most one unit in the last
    /// place, which is `2^-52 t`: each term is off by 2^-52 of itself for its coefficient, 2 2^-52
    /// for `t`, and at most 4 2^-53 for the operations of Horner's rule: by less than 2^-49 of the
    /// sum of the terms' magnitudes. That sum is computed with a relative error of the same order.
    /// Coefficients are integers and so 0 or at least 1: with `t` above 2^-400 nothing underflows.
    /// Where something is infinite, the comparison fails.
    pub(super) fn quick_value_of(&self, q: &Quadratic<L>) -> Option<f64> {
        match self.exact {
            Exact::Start => return Some(q[0].to_f64()),
            Exact::End => return Some(q[0].add(&q[1]).add(&q[2]).to_f64()),
            Exact::Fraction { at, .. } => return Some(L::quadratic_at_fraction(q, at).to_f64()),
            _ => {}
        }
        let (c0, c1, c2) = (q[0].to_f64(), q[1].to_f64(), q[2].to_f64());
        if c0 == 0.0 && c1 == 0.0 && c2 == 0.0 {
            return Some(0.0);
        }
        let t = self.above;
        let value = (c2 * t + c1) * t + c0;
        let size = (c2.abs() * t + c1.abs()) * t + c0.abs();
        (t > SMALLEST && value.abs() > size * TERM_ERROR).then_some(value)
    }

    /// `n / d` at the time, which is in `[0, 1]`, with an error of at most [`PARAMETER_ERROR`].
    ///
    /// [`PARAMETER_ERROR`]: super::PARAMETER_ERROR
    pub(super) fn quotient(&self, n: &Quadratic<L>, d: &Quadratic<L>) -> f64 {
        let quick = self.quick_quotient(n, d).or_else(|| {
            let nearer = self.tightened()?;
            let quick = nearer.quick_quotient(n, d);
            quick.or_else(|| nearer.tightened()?.quick_quotient(n, d))
        });
        quick.unwrap_or_else(|| self.exact_quotient(n, d))
    }

    /// The same in integers of any size.
    #[inline(never)]
    fn exact_quotient(&self, n: &Quadratic<L>, d: &Quadratic<L>) -> f64 {
        self.moment().quotient(&Poly::new(n), &Poly::new(d))
    }

    /// The time in narrower bounds, if a Newton step finds them.
    fn tightened(&self) -> Option<Time<'a, L>> {
        let Exact::Root {
            of,
            before,
            low,
            high,
        } = self.exact
        else {
            return None;
        };
        let (low, high) = tighten(of.curve, before, low, high)?;
        Some(Time {
            exact: Exact::Root {
                of,
                before,
                low,
                high,
            },
            ..*self
        })
    }

    /// The same, where numbers of fixed width show it.
    ///
    /// Numerator and denominator at a time that is near enough are known with a relative error of
    /// 2^-53 each, as is their quotient, and each may vary up to the time by `2^-53 d`: not more
    /// than 5 times 2^-53 together, as the quotient is at most 1.
    fn quick_quotient(&self, n: &Quadratic<L>, d: &Quadratic<L>) -> Option<f64> {
        let exactly = |value: f64| (value, 0.0);
        let both = |of: &dyn Fn(&Quadratic<L>) -> (f64, f64)| (of(n), of(d));
        let ((n, n_variation), (d, d_variation)) = match &self.exact {
            Exact::Start => both(&|q| exactly(q[0].to_f64())),
            Exact::End => both(&|q| exactly(q[0].add(&q[1]).add(&q[2]).to_f64())),
            Exact::At(at) => both(&|q| exactly(L::quadratic_at(q, at.0).to_f64())),
            Exact::Fraction { at, .. } => {
                both(&|q| exactly(L::quadratic_at_fraction(q, *at).to_f64()))
            }
            Exact::Root { low, high, .. } => both(&|q| range::<L>(q, *low, *high)),
            Exact::Dyadic(_) | Exact::Bracket(_) => return None,
        };
        let limit = d.abs() * (0.5 * f64::EPSILON);
        let is_shown = d.is_finite() && n_variation <= limit && d_variation <= limit;
        is_shown.then(|| (n / d).clamp(0.0, 1.0))
    }

    /// `self` compared with `other`.
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        if self.above <= other.below && self.below < other.above {
            return Ordering::Less;
        }
        if other.above <= self.below && other.below < self.above {
            return Ordering::Greater;
        }
        if let (Exact::Fraction { at: a, .. }, Exact::Fraction { at: b, .. }) =
            (&self.exact, &other.exact)
        {
            return a.compare(*b);
        }
        if let Some(order) = self.quick_compare(other) {
            return order;
        }
        self.exact_compare(other)
    }

    #[inline(never)]
    fn exact_compare(&self, other: &Self) -> Ordering {
        self.moment().compare(&other.moment())
    }

    /// The same for two roots on the grid, the other one of a polynomial of degree 2.
    fn quick_compare(&self, other: &Self) -> Option<Ordering> {
        let Exact::Root {
            of:
                Source {
                    curve: Curve::Quadratic(q),
                    ..
                },
            before,
            low,
            high,
        } = &other.exact
        else {
            return None;
        };
        if self.compare_grid_time(*low)?.is_le() {
            return Some(Ordering::Less);
        }
        if self.compare_grid_time(*high)?.is_ge() {
            return Some(Ordering::Greater);
        }
        // Between these, the other polynomial changes its sign at the other root alone.
        Some(match self.sign_of(q) {
            Ordering::Equal => Ordering::Equal,
            sign if sign == *before => Ordering::Less,
            _ => Ordering::Greater,
        })
    }

    /// A root on the grid compared with a time on it.
    fn compare_grid_time(&self, at: GridTime) -> Option<Ordering> {
        let Exact::Root {
            of,
            before,
            low,
            high,
        } = &self.exact
        else {
            return None;
        };
        if at <= *low {
            return Some(Ordering::Greater);
        }
        if at >= *high {
            return Some(Ordering::Less);
        }
        let (sign, _) = of.curve.sample(at);
        Some(match sign {
            Ordering::Equal => Ordering::Equal,
            sign if sign == *before => Ordering::Greater,
            _ => Ordering::Less,
        })
    }

    fn moment(&self) -> AlgebraicTime<'_> {
        match &self.exact {
            Exact::Start => AlgebraicTime::At(Dyadic::zero()),
            Exact::End => AlgebraicTime::At(Dyadic::one()),
            Exact::At(at) => AlgebraicTime::At(at.to_dyadic()),
            Exact::Dyadic(at) => AlgebraicTime::At(at.clone()),
            Exact::Fraction {
                of,
                before,
                low,
                high,
                ..
            } => AlgebraicTime::settled(of.unproved(*before, *low, *high)).0,
            Exact::Root {
                of,
                before,
                low,
                high,
            } => AlgebraicTime::Between(of.bracket(*before, *low, *high)),
            Exact::Bracket(bracket) => AlgebraicTime::Between(bracket.clone()),
        }
    }
}

/// See [`Time::quick_value_of`].
const TERM_ERROR: f64 = 1.0 / (1u64 << 48) as f64;

/// 2^-400.
const SMALLEST: f64 = f64::from_bits((1023 - 400) << 52);

/// 2^128, enlarged by more than the rounding of a few operations.
const GRID: f64 = TWO_64 * TWO_64 * (1.0 + TERM_ERROR);

/// Compared with 0.
pub(super) fn sign(value: f64) -> Option<Ordering> {
    value.partial_cmp(&0.0)
}

/// `2^256` times the value of a polynomial at `low`, with a relative error of 2^-53, and a bound of
/// how much that changes up to `high`: on `[0, 1]` the derivative of `c0 + c1 t + c2 t^2` is at
/// most `|c1| + 2 |c2|`.
fn range<L: Width>(q: &Quadratic<L>, low: GridTime, high: GridTime) -> (f64, f64) {
    let slope = q[1].to_f64().abs() + 2.0 * q[2].to_f64().abs();
    let value = L::quadratic_at(q, low.0).to_f64();
    (value, slope * low.distance(high) * GRID)
}

#[cfg(test)]
mod tests;

//! Stage 4: intervals that hold exactly one simple root of `f`, certified in `f64`.

use super::cubic::Cubic;

/// An interval that holds exactly one root of `f`, a simple one, strictly inside.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket {
    pub(super) low: f64,
    pub(super) high: f64,
    /// Whether `f` rises through 0.
    pub(super) is_rising: bool,
}

/// All roots of `f` in `[0, 1]`, ascending.
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

impl Cubic {
    /// Brackets of all roots in `[0, 1]`; `None` if some cannot be certified.
    pub(super) fn isolate(&self) -> Option<Brackets> {
        let empty = Bracket {
            low: 0.0,
            high: 1.0,
            is_rising: false,
        };
        let mut found = Brackets {
            brackets: [empty; 3],
            count: 0,
        };
        let part = Part {
            low: 0.0,
            high: 1.0,
            bernstein: self.bernstein,
            depth: 0,
        };
        self.isolate_in(part, &mut found)?;
        Some(found)
    }

    /// Halves `part` until each piece has no root or one.
    fn isolate_in(&self, part: Part, found: &mut Brackets) -> Option<()> {
        // Subdivision averages neighbours; each level of averages of magnitude B adds at most
        // 3 u B, and 16 levels of it less than 48 u P, three times the bound that it starts from.
        let error = self.error * 4.0;
        match part.variation(error) {
            Variation::None => Some(()),
            Variation::One { is_rising } => {
                let bracket = self.narrow(&part, is_rising)?;
                *found.brackets.get_mut(found.count)? = bracket;
                found.count += 1;
                Some(())
            }
            Variation::Unclear if part.depth < MAX_DEPTH => {
                let [lower, upper] = part.halves();
                self.isolate_in(lower, found)?;
                self.isolate_in(upper, found)
            }
            Variation::Unclear => None,
        }
    }

    /// `f` and its derivative.
    ///
    /// Error bound of the value: `1 - t` is rounded once, a term of de Casteljau's sum passes at most
    /// eleven roundings more, so the value is within `12 u P` of that of the given coefficients and
    /// within `12 u P + error` of the exact one; [`Cubic::value_error`] is `2 error = 32 u P`.
    #[inline]
    pub(super) fn evaluate(&self, t: f64) -> (f64, f64) {
        let [b0, b1, b2, b3] = self.bernstein;
        let s = 1.0 - t;
        let (c0, c1, c2) = (s * b0 + t * b1, s * b1 + t * b2, s * b2 + t * b3);
        let (d0, d1) = (s * c0 + t * c1, s * c1 + t * c2);
        (s * d0 + t * d1, 3.0 * (d1 - d0))
    }

    fn value_error(&self) -> f64 {
        2.0 * self.error
    }

    /// Narrows the interval around the one root in it, to what the error bound lets be certain.
    fn narrow(&self, part: &Part, is_rising: bool) -> Option<Bracket> {
        let (low, high) = (part.low, part.high);
        let (mut a, mut b) = (low, high);
        let mut t = part.chord();
        let mut slope = 0.0;
        for _ in 0..MAX_NEWTON {
            let (value, derivative) = self.evaluate(t);
            slope = derivative;
            if value.abs() <= self.value_error() {
                break;
            }
            if (value > 0.0) == is_rising {
                b = t;
            } else {
                a = t;
            }
            let newton = t - value / derivative;
            t = if newton > a && newton < b {
                newton
            } else {
                0.5 * (a + b)
            };
        }
        let mut width = 2.0 * self.value_error() / slope.abs() + 2.0 * f64::EPSILON * t;
        for _ in 0..MAX_WIDENINGS {
            let (low, high) = ((t - width).max(low), (t + width).min(high));
            let sign_is = |t: f64, positive: bool| {
                let (value, _) = self.evaluate(t);
                if positive {
                    value > self.value_error()
                } else {
                    value < -self.value_error()
                }
            };
            if sign_is(low, !is_rising) && sign_is(high, is_rising) {
                return Some(Bracket {
                    low,
                    high,
                    is_rising,
                });
            }
            width *= 16.0;
        }
        None
    }
}

const MAX_DEPTH: u32 = 16;
const MAX_NEWTON: usize = 24;
const MAX_WIDENINGS: usize = 3;

/// `f` on a part of `[0, 1]`.
#[derive(Clone, Copy)]
struct Part {
    low: f64,
    high: f64,
    bernstein: [f64; 4],
    depth: u32,
}

/// What the signs of the Bernstein coefficients say about roots (Descartes' rule).
enum Variation {
    None,
    One { is_rising: bool },
    Unclear,
}

impl Part {
    /// Where the chord from end to end crosses 0: a first guess.
    fn chord(&self) -> f64 {
        let [at_low, _, _, at_high] = self.bernstein;
        let guess = self.low + (self.high - self.low) * (at_low / (at_low - at_high));
        if guess > self.low && guess < self.high {
            guess
        } else {
            0.5 * (self.low + self.high)
        }
    }

    fn variation(&self, error: f64) -> Variation {
        let [b0, b1, b2, b3] = self.bernstein;
        let positive = [b0, b1, b2, b3].map(|b| b > error);
        let negative = [b0, b1, b2, b3].map(|b| b < -error);
        match (positive, negative) {
            ([true, true, true, true], _) | (_, [true, true, true, true]) => Variation::None,
            // Signs +, ?, ?, -: one change whatever the middle is, unless it may be -, +.
            ([true, _, _, false], [false, _, _, true]) if positive[1] || negative[2] => {
                Variation::One { is_rising: false }
            }
            ([false, _, _, true], [true, _, _, false]) if negative[1] || positive[2] => {
                Variation::One { is_rising: true }
            }
            _ => Variation::Unclear,
        }
    }

    /// De Casteljau's algorithm at the middle.
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

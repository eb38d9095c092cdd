//! The last bit of a time of impact, in double-double arithmetic.
//!
//! One Newton step from an `f64` near the root, with `f` evaluated to twice the precision, gives the
//! root as `t + delta` with an error that is small against an ulp. Nearly always no `f64` lies so
//! near to the root, and rounding down is certain; else the exact stage decides.

use super::cubic::Cubic;
use super::motion::Positions;
use super::root::Bracket;
use super::separate::U;

/// An unevaluated sum `high + low`, `|low|` at most half an ulp of `high`.
#[derive(Clone, Copy)]
struct Double {
    high: f64,
    low: f64,
}

/// `a + b` without error (Knuth; Dekker 1971).
#[inline(always)]
fn two_sum(a: f64, b: f64) -> Double {
    let high = a + b;
    let part = high - a;
    Double {
        high,
        low: (a - (high - part)) + (b - part),
    }
}

/// `a b` without error, unless something over- or underflows (Veltkamp, Dekker 1971).
#[inline(always)]
fn two_product(a: f64, b: f64) -> Double {
    const SPLIT: f64 = 134_217_729.0; // 2^27 + 1
    let halves = |x: f64| {
        let c = SPLIT * x;
        let high = c - (c - x);
        (high, x - high)
    };
    let high = a * b;
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    Double {
        high,
        low: ((ah * bh - high) + ah * bl + al * bh) + al * bl,
    }
}

impl Double {
    #[inline(always)]
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Double {
            high,
            low: b - (high - a),
        }
    }

    /// `self + other`; an error below `8 * 2^-106 (|self| + |other|)`: the low parts are added in
    /// `f64`, which is not precise relative to a sum that cancels, nor need it be.
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let s = two_sum(self.high, other.high);
        Self::sum(s.high, s.low + (self.low + other.low))
    }

    #[inline(always)]
    fn neg(self) -> Self {
        Double {
            high: -self.high,
            low: -self.low,
        }
    }

    /// `self other`; relative error below `8 * 2^-106`.
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let p = two_product(self.high, other.high);
        Self::sum(
            p.high,
            p.low + (self.high * other.low + self.low * other.high),
        )
    }

    /// `self t`; relative error below `4 * 2^-106`.
    #[inline(always)]
    fn scale(self, t: f64) -> Self {
        let p = two_product(self.high, t);
        Self::sum(p.high, p.low + self.low * t)
    }
}

/// `f` at `t` in double-double arithmetic.
fn evaluate(positions: &Positions, t: f64) -> f64 {
    let Positions { start, end } = positions;
    let component = |to: usize, from: usize, i: usize| {
        let first = two_sum(start[to][i], -start[from][i]);
        let last = two_sum(end[to][i], -end[from][i]);
        first.add(last.add(first.neg()).scale(t))
    };
    let difference = |to: usize, from: usize| {
        [
            component(to, from, 0),
            component(to, from, 1),
            component(to, from, 2),
        ]
    };
    let (k, l, m) = (difference(1, 0), difference(3, 2), difference(2, 0));
    let minor = |i: usize, j: usize| k[i].mul(l[j]).add(k[j].mul(l[i]).neg());
    let terms = [
        m[0].mul(minor(1, 2)),
        m[1].mul(minor(2, 0)),
        m[2].mul(minor(0, 1)),
    ];
    let sum = terms[0].add(terms[1]).add(terms[2]);
    sum.high + sum.low
}

/// The largest `f64` not above the root in the bracket, if that is certain; then the root is not an
/// `f64` itself.
///
/// Error bound. Let `t` be the middle of the bracket, `W` its width, `P` the permanent of
/// [`Cubic`] (`error = 16 u P`) and `h = 2^-106`.
///
/// - The value of `f` at `t`: differences are exact double-doubles; a component of `K(t)` is within
///   `(16 + 8 + 24) h k_i` (difference, product, sum; bounds at the operations), a minor within
///   `(8 + 2 * 48 + 8) h p_ij`, a term of the determinant within `(8 + 48 + 112) h`, and the two last
///   sums add `16 h`: `184 h P`, below `2^-49 error = 256 h P`. The rounding to `f64` is relative.
/// - The slope: three times the difference of two values of de Casteljau's scheme, each within
///   `25 u P` of the exact one: `12 error` covers it. It changes by at most `24 P W` over the bracket,
///   because `|f''| <= 6 |b0 - 2 b1 + b2| <= 24 P`. Let `s` be the magnitude less both.
/// - By Taylor the root is `t - f(t) / f'(t)` up to `12 P W^2 / s`.
///
/// So it is `t + delta` up to `(2^-49 error + 12 P W^2) / s` and, for slope, division and rounding,
/// `|delta| (12 error / s + 8 u)`. Underflow: see [`Cubic::new`]; the errors of products that
/// underflow are below `2^-765`, the first bound above `2^-750`.
pub(super) fn round_down(positions: &Positions, cubic: &Cubic, bracket: &Bracket) -> Option<f64> {
    let t = 0.5 * (bracket.low + bracket.high);
    let width = bracket.high - bracket.low;
    let permanent = cubic.error / (15.0 * U);
    let (_, slope) = cubic.evaluate(t);
    let slope_error = 12.0 * cubic.error;
    let least = slope.abs() - slope_error - 24.0 * permanent * width;
    if !(least > 0.0) {
        return None;
    }
    let delta = -evaluate(positions, t) / slope;
    let error = (cubic.error * VALUE_ERROR + 12.0 * permanent * width * width) / least
        + delta.abs() * (slope_error / least + 8.0 * U);
    let Double { high, low } = two_sum(t, delta);
    let below = if low - error > 0.0 {
        high
    } else if low + error < 0.0 {
        high.next_down()
    } else {
        return None;
    };
    // The root is between two neighbours, so neither of them, and inside the step.
    let is_between = error < 0.125 * (below.next_up() - below);
    (is_between && below > 0.0 && below < 1.0).then_some(below)
}

/// `2^-49`: the error of [`evaluate`] in units of that of the cubic.
const VALUE_ERROR: f64 = f64::from_bits((1023 - 49) << 52);

//! The last bit of a time of impact, in double-double arithmetic.
//!
//! One Newton step from an `f64` near the root, with `f` evaluated to twice the precision, gives the
//! root as `t + delta` with an error that is small against an ulp. Nearly always no `f64` lies so
//! near to the root, and rounding down is certain; else the exact stage decides.

use wide::f64x2;

use super::cubic::Cubic;
use super::ends::{Ends, Scalar};
use super::motion::Positions;
use super::root::Bracket;
use super::separate::U;

/// An unevaluated sum `high + low`, `|low|` at most half an ulp of `high`; in each lane.
#[derive(Clone, Copy)]
struct Double<T> {
    high: T,
    low: T,
}

/// `a + b` without error (Knuth; Dekker 1971).
#[inline(always)]
fn two_sum<T: Scalar>(a: T, b: T) -> Double<T> {
    let high = a + b;
    let part = high - a;
    Double {
        high,
        low: (a - (high - part)) + (b - part),
    }
}

/// `a - b` without error.
#[inline(always)]
fn two_difference<T: Scalar>(a: T, b: T) -> Double<T> {
    let high = a - b;
    let part = high - a;
    Double {
        high,
        low: (a - (high - part)) - (b + part),
    }
}

/// `a b` without error, unless something over- or underflows (Veltkamp, Dekker 1971).
#[inline(always)]
fn two_product<E: Ends>(a: E, b: E) -> Double<E> {
    const SPLIT: f64 = 134_217_729.0; // 2^27 + 1
    let halves = |x: E| {
        let c = E::both(SPLIT) * x;
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

impl<T: Scalar> Double<T> {
    #[inline(always)]
    fn sum(a: T, b: T) -> Self {
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

    /// `self - other`; an error as that of [`add`](Self::add).
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let s = two_difference(self.high, other.high);
        Self::sum(s.high, s.low + (self.low - other.low))
    }
}

impl<E: Ends> Double<E> {
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
    fn scale(self, t: E) -> Self {
        let p = two_product(self.high, t);
        Self::sum(p.high, p.low + self.low * t)
    }

    /// The lanes exchanged.
    #[inline(always)]
    fn swapped(self) -> Self {
        Double {
            high: self.high.swapped(),
            low: self.low.swapped(),
        }
    }

    /// The first lanes of two numbers, and their second ones.
    #[inline(always)]
    fn transposed(self, other: Self) -> [Self; 2] {
        let ([high, end_high], [low, end_low]) = (
            self.high.transposed(other.high),
            self.low.transposed(other.low),
        );
        [
            Double { high, low },
            Double {
                high: end_high,
                low: end_low,
            },
        ]
    }

    #[inline(always)]
    fn lanes(self) -> [Double<f64>; 2] {
        [
            Double {
                high: self.high.start(),
                low: self.low.start(),
            },
            Double {
                high: self.high.end(),
                low: self.low.end(),
            },
        ]
    }
}

/// From two points to two others, on an axis each, at `t`: exact up to what the two operations on
/// double-doubles add.
#[inline(always)]
fn difference<E: Ends>(from: [E; 2], to: [E; 2], t: E) -> Double<E> {
    let ([from_start, from_end], [to_start, to_end]) =
        (from[0].transposed(from[1]), to[0].transposed(to[1]));
    let (first, last) = (
        two_difference(to_start, from_start),
        two_difference(to_end, from_end),
    );
    first.add(last.sub(first).scale(t))
}

/// `f` at `t` in double-double arithmetic, two numbers at a time.
fn evaluate(positions: &Positions, t: f64) -> f64 {
    let [a, b, c, d] = positions.points::<f64x2>();
    let t = f64x2::both(t);
    // K and L of an axis; M of two axes.
    let edges = |i: usize| difference([a[i], c[i]], [b[i], d[i]], t);
    let (x, y, z) = (edges(0), edges(1), edges(2));
    let m_xy = difference([a[0], a[1]], [c[0], c[1]], t);
    let m_z = difference([a[2], a[2]], [c[2], c[2]], t);
    let products = |i: Double<f64x2>, j: Double<f64x2>| i.mul(j.swapped());
    let (yz, zx, xy) = (products(y, z), products(z, x), products(x, y));
    let minor = |[first, second]: [Double<f64x2>; 2]| first.sub(second);
    let [first, second] = m_xy.mul(minor(yz.transposed(zx))).lanes();
    let [third, _] = m_z.mul(minor(xy.transposed(xy))).lanes();
    let sum = first.add(second).add(third);
    sum.high + sum.low
}

/// The largest `f64` not above the root in the bracket, if that is certain; then the root is not an
/// `f64` itself.
///
/// Error bound. Let `t` be the middle of the sharpened bracket, `W` its width, `s` the least magnitude
/// of the slope in it, `P` the permanent of [`Cubic`] (`error = 16 u P`) and `h = 2^-106`.
///
/// - The value of `f` at `t`: differences are exact double-doubles; a component of `K(t)` is within
///   `(16 + 8 + 24) h k_i` (difference, product, sum; bounds at the operations), a minor within
///   `(8 + 2 * 48 + 8) h p_ij`, a term of the determinant within `(8 + 48 + 112) h`, and the two last
///   sums add `16 h`: `184 h P`, below `2^-49 error = 256 h P`. The rounding to `f64` is relative.
/// - By Taylor the root is `t - f(t) / f'(t)` up to `C W^2 / 2 s`, with `C` the bound on `|f''|`.
///
/// So it is `t + delta` up to `(2^-49 error + C W^2) / s` and, for slope, division and rounding,
/// `|delta| (slope_error / s + 8 u)`. Underflow: see [`Cubic::new`]; the errors of products that
/// underflow are below `2^-885`, the first bound above `2^-750`.
pub(super) fn round_down(positions: &Positions, cubic: &Cubic, bracket: &Bracket) -> Option<f64> {
    let (sharp, least) = cubic.sharpen(bracket)?;
    if !(least > 0.0) {
        return None;
    }
    let t = 0.5 * (sharp.low + sharp.high);
    let width = sharp.high - sharp.low;
    let (_, slope) = cubic.evaluate(t);
    let delta = -evaluate(positions, t) / slope;
    let error = (cubic.error * VALUE_ERROR + cubic.curvature() * width * width) / least
        + delta.abs() * (cubic.slope_error() / least + 8.0 * U);
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

#[cfg(test)]
mod tests;

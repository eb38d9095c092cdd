//! A root of `f` in double-double arithmetic: the last bit of a time of impact, and where the lines
//! meet there when that is near an edge's end.
//!
//! One Newton step from an `f64` near the root, with `f` evaluated to twice the precision, gives
//! the root as a double-double with an error that is small against an ulp. Nearly always no `f64`
//! lies so near to the root, and rounding down is certain; else the exact stage decides.

use wide::f64x2;

use super::cubic::{Cubic, permanents};
use super::double::{Double, two_difference, two_sum};
use super::ends::Ends;
use super::locate::Meeting;
use super::motion::{Motion, Positions};
use super::root::Bracket;
use super::separate::U;

/// A simple root of `f`.
#[derive(Clone, Copy)]
pub(super) struct Root {
    time: Double<f64>,
    /// The root is no farther from `time` than this.
    error: f64,
}

/// From two points to two others, on an axis each, at a time.
///
/// Error bound, with `h = 2^-106` and `k` the larger magnitude at both ends of the step: the
/// differences at the ends are exact, their difference is within `16 h k`, the product with the
/// time within `8 h 2 k` more, the sum within `24 h k` more (bounds at the operations): `56.1 h k`.
#[inline(always)]
pub(super) fn difference<E: Ends>(from: [E; 2], to: [E; 2], time: Double<f64>) -> Double<E> {
    let ([from_start, from_end], [to_start, to_end]) =
        (from[0].transposed(from[1]), to[0].transposed(to[1]));
    let (first, last) = (
        two_difference(to_start, from_start),
        two_difference(to_end, from_end),
    );
    first.add(last.sub(first).mul(Double::both(time)))
}

/// `f` at a time, two numbers at a time.
///
/// Error bound: a minor of two components is within `(8 + 2 * 56.1 + 8) h p_ij` of the exact one, a
/// term of the determinant within `(8 + 57 + 129) h`, and the two last sums add `16 h`: `210 h P`,
/// with `P` the permanent of [`Cubic`]. Below, `256 h P`. The rounding to `f64` is relative.
///
/// Underflow: all factors are below `2^180`. A product of two double-doubles takes six products in
/// `f64`, each off by at most `2^-1075`: below `2^-1072`. The one with the time adds that to a
/// component, which is then multiplied by two others: with those of the minors and of the
/// determinant, below `18 * 2^-712`. As `P` is above `2^-600`, `40 h P` is more.
#[inline(always)]
fn evaluate<E: Ends>([a, b, c, d]: &[[E; 3]; 4], time: Double<f64>) -> f64 {
    // K and L of an axis; M of two axes.
    let edges = |i: usize| difference([a[i], c[i]], [b[i], d[i]], time);
    let (x, y, z) = (edges(0), edges(1), edges(2));
    let m_xy = difference([a[0], a[1]], [c[0], c[1]], time);
    let m_z = difference([a[2], a[2]], [c[2], c[2]], time);
    let products = |i: Double<E>, j: Double<E>| i.mul(j.swapped());
    let (yz, zx, xy) = (products(y, z), products(z, x), products(x, y));
    let minor = |[first, second]: [Double<E>; 2]| first.sub(second);
    let [first, second] = m_xy.mul(minor(yz.transposed(zx))).lanes();
    let [third, _] = m_z.mul(minor(xy.transposed(xy))).lanes();
    first.add(second).add(third).value()
}

/// `2^-106`.
const SQUARED_U: f64 = U * U;

/// Far above what underflow adds to a minor.
const TINY: f64 = f64::from_bits((1023 - 700) << 52);

/// The error of [`evaluate`] in units of the permanent.
const VALUE_ERROR: f64 = 256.0 * SQUARED_U;

impl Root {
    /// The root in a bracket, if the slope there is certain.
    pub(super) fn new(positions: &Positions, cubic: &Cubic, bracket: &Bracket) -> Option<Self> {
        let (sharp, least) = cubic.sharpen(bracket)?;
        (least > 0.0).then(|| Self::of(&positions.points::<f64x2>(), cubic, &sharp, least))
    }

    /// The root in a sharpened bracket, if the least magnitude of the slope there is above 0.
    ///
    /// Error bound. Let `t` be the middle of the sharpened bracket, `W` its width, `s` the least
    /// magnitude of the slope in it, `C` the bound on `|f''|`. By Taylor the root is
    /// `t - f(t) / f'(t)` up to `C W^2 / 2 s`. So it is `t + delta` up to `(256 h P + C W^2) / s`
    /// and, for slope, division and rounding, `|delta| (slope_error / s + 8 u)`; the first error is
    /// that of [`evaluate`].
    #[inline(always)]
    pub(super) fn of<E: Ends>(
        points: &[[E; 3]; 4],
        cubic: &Cubic,
        sharp: &Bracket,
        least: f64,
    ) -> Self {
        let t = 0.5 * (sharp.low + sharp.high);
        let width = sharp.high - sharp.low;
        let (_, slope) = cubic.evaluate(t);
        let delta = -evaluate(points, Double { high: t, low: 0.0 }) / slope;
        let error = (cubic.permanent * VALUE_ERROR + cubic.curvature() * width * width) / least
            + delta.abs() * (cubic.slope_error() / least + 8.0 * U);
        Root {
            time: two_sum(t, delta),
            error,
        }
    }

    /// The `f64` above 0 and at most 1 that may be the root itself, if there is one: it is the only
    /// one near the root.
    pub(super) fn near_f64(&self) -> Option<f64> {
        let Double { high, low } = self.time;
        let is_near = low.abs() + self.error < 0.125 * (high - high.next_down());
        (is_near && high > 0.0 && high <= 1.0).then_some(high)
    }

    /// A number no farther from `time` than `error`.
    #[inline(always)]
    pub(super) fn near(time: Double<f64>, error: f64) -> Self {
        Root { time, error }
    }

    pub(super) fn error(&self) -> f64 {
        self.error
    }

    /// The largest `f64` not above the root, if that is certain; then the root is not an `f64`
    /// itself.
    pub(super) fn round_down(&self) -> Option<f64> {
        let (below, is_certain) = self.below();
        is_certain.then_some(below)
    }

    /// The same without a branch: the number, and whether it is certain.
    #[inline(always)]
    pub(super) fn below(&self) -> (f64, bool) {
        let Double { high, low } = self.time;
        let (is_above, is_below) = (low - self.error > 0.0, low + self.error < 0.0);
        // Of numbers above 0, as those are that can be certain.
        let before = |x: f64| f64::from_bits(x.to_bits().wrapping_sub(1));
        let after = |x: f64| f64::from_bits(x.to_bits().wrapping_add(1));
        let below = if is_above { high } else { before(high) };
        // The root is between two neighbours, so neither of them, and inside the step.
        let is_between = self.error < 0.125 * (after(below) - below);
        let is_inside = (below > 0.0) & (below < 1.0);
        (below, (is_above | is_below) & is_between & is_inside)
    }

    /// Where the lines meet at the root: as [`Motion::meeting`](super::motion::Motion::meeting), to
    /// twice the precision, with `w` along the axis on which `N` is largest.
    ///
    /// Error bound: a minor is within `128 h p` of the exact one at `time` (see [`evaluate`]), and
    /// moving to the root changes it by at most `4 e p (1 + e)`, `e` the error of the root. A
    /// difference of minors adds `8 h` of both. Below, `(160 h + 5 e) p`, for `e < 1/8`; the
    /// computation of that has a relative error below `4 u`. What underflows is below `2^-1072` in
    /// a component (see [`evaluate`]), so below `2^-889` in a minor, and `TINY` is more.
    pub(super) fn meeting<E: Ends>(
        &self,
        positions: &Positions,
        motion: &Motion<E>,
        cubic: &Cubic,
    ) -> Meeting {
        let [a, b, c, d] = positions.points::<f64x2>();
        let [k, l, m] = &cubic.reach;
        let (n, mixed_l, mixed_k) = (permanents(k, l), permanents(m, l), permanents(m, k));
        let edges = |i: usize| difference([a[i], c[i]], [b[i], d[i]], self.time);
        let far = |i: usize| difference([a[i], a[i]], [c[i], c[i]], self.time);
        let at = |h: usize| {
            let (i, j) = ((h + 1) % 3, (h + 2) % 3);
            let ((x, y), (m_i, m_j)) = ((edges(i), edges(j)), (far(i), far(j)));
            let [first, second] = x.mul(y.swapped()).lanes();
            // Of K, then of L.
            let [v, u] = m_i.mul(y).sub(m_j.mul(x)).lanes();
            (first.sub(second), u, v)
        };
        let [x, y, z] = motion.normal(self.time.high).map(f64::abs);
        let axis = if x >= y && x >= z {
            0
        } else if y >= z {
            1
        } else {
            2
        };
        let factor = if self.error < 0.125 {
            160.0 * SQUARED_U + 5.0 * self.error
        } else {
            f64::INFINITY
        };
        let (normal, u, v) = at(axis);
        let flip = |x: Double<f64>| {
            if normal.high < 0.0 {
                -x.value()
            } else {
                x.value()
            }
        };
        Meeting {
            n: flip(normal),
            u: flip(u),
            v: flip(v),
            before_b: flip(normal.sub(u)),
            before_d: flip(normal.sub(v)),
            error_n: factor * n[axis] + TINY,
            error_u: factor * mixed_l[axis] + TINY,
            error_v: factor * mixed_k[axis] + TINY,
        }
    }
}

#[cfg(test)]
mod tests;

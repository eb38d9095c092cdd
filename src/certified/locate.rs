//! Stage 4, continued: whether the edges touch at a root of `f`.

use super::cubic::{Cubic, permanents};
use super::ends::Ends;
use super::motion::{Motion, Vector, cross, dot};
use super::root::{Bracket, Half};
use super::separate::U;

/// What is certain about the edges at a root of `f`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    /// The lines meet outside an edge.
    Apart,
    /// The lines meet strictly inside both edges.
    Inside {
        u: f64,
        v: f64,
        /// A bound on the error of `u` and `v`.
        error: f64,
    },
    /// The bounds do not tell.
    Unclear,
}

/// What shows where the lines meet.
///
/// At the root, `M x L = u N` and `M x K = v N` with `N = K x L`. So with any vector `w`, here the
/// computed `N`: `u` is the ratio of `(M x L) . w` to `N . w`, `v` that of `(M x K) . w`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    /// `N . w`, `(M x L) . w` and `(M x K) . w`.
    pub(super) n: f64,
    pub(super) u: f64,
    pub(super) v: f64,
    /// `n - u` and `n - v`.
    pub(super) before_b: f64,
    pub(super) before_d: f64,
    /// Bounds on the errors of `n`, `u` and `v`.
    pub(super) error_n: f64,
    pub(super) error_u: f64,
    pub(super) error_v: f64,
}

impl<E: Ends> Motion<E> {
    /// Where the lines meet at the root in the bracket.
    ///
    /// Error bound: let `w` be half the width of the bracket, `t` its middle and `p` the vector of
    /// the `k_i l_j + k_j l_i` of larger magnitudes. A component of `K(t)` is within `4.1 u k_i`
    /// of the exact one (rounded difference, `1 - t`, a product, a sum), so one of `N(t)` is within
    /// `2 * 4.1 u p + 2 u p` of the exact one; moving to the root changes each component of `K` by at
    /// most `2 k_i w`, so of `N` by at most `4 w p (1 + w)`. The product with `N` adds `3.1 u` of
    /// the sum of the `|N_i| p_i`. Below, `(20 u + 5 w)` times that sum, for `w < 1/8`, checked by
    /// whoever reads the result; its computation has a relative error below `9 u`.
    ///
    /// What underflows: with a cubic all factors are below `2^180`. A component of `K(t)` is off by
    /// at most `2^-1074`, one of a cross product so by `4 * 2^180` times that and `2^-1074` more.
    /// Times `N`, below `2^361` a component, this is below `2^-529`: `TINY` is more. Without a
    /// cubic `t` is 0, so that `K(t)` is exact: a component of `N` is off by at most `2^-1074`,
    /// which times the computed one is below `2 u` of its square or below `2^-2000`. What overflows
    /// makes a bound infinite or NaN, so that nothing follows.
    #[inline(always)]
    pub(super) fn meeting(&self, cubic: &Cubic, bracket: &Bracket) -> Meeting {
        let t = 0.5 * (bracket.low + bracket.high);
        let half_width = 0.5 * (bracket.high - bracket.low) + U;
        let (k, l, m) = (at(&self.k, t), at(&self.l, t), at(&self.m, t));
        let normal = cross(&k, &l);
        let size = normal.map(f64::abs);
        let factor = if half_width < 0.125 {
            20.0 * U + 5.0 * half_width
        } else {
            f64::INFINITY
        };
        let bound = |x: &Vector, y: &Vector| factor * dot(&size, &permanents(x, y)) + TINY;
        let [k_reach, l_reach, m_reach] = &cubic.reach;
        let n = dot(&normal, &normal);
        let u = dot(&cross(&m, &l), &normal);
        let v = dot(&cross(&m, &k), &normal);
        Meeting {
            n,
            u,
            v,
            before_b: n - u,
            before_d: n - v,
            error_n: bound(k_reach, l_reach),
            error_u: bound(m_reach, l_reach),
            error_v: bound(m_reach, k_reach),
        }
    }

    /// `N` at a time, about.
    pub(super) fn normal(&self, t: f64) -> Vector {
        cross(&at(&self.k, t), &at(&self.l, t))
    }

    /// Whether the edges certainly do not touch at a root in a half of the step.
    #[inline(always)]
    pub(super) fn is_apart_in(&self, cubic: &Cubic, half: &Half) -> bool {
        half.has_none | (half.has_one & self.meeting(cubic, &half.bracket).is_apart())
    }
}

/// A vector at a time.
#[inline(always)]
pub(super) fn at<E: Ends>([x, y, z]: &[E; 3], t: f64) -> Vector {
    let weights = E::new(1.0 - t, t);
    [
        (weights * *x).sum(),
        (weights * *y).sum(),
        (weights * *z).sum(),
    ]
}

impl Meeting {
    /// Whether the lines certainly meet outside an edge.
    #[inline(always)]
    pub(super) fn is_apart(&self) -> bool {
        let (error_u1, error_v1) = self.far_errors();
        let is_apart = (self.u < -self.error_u)
            | (self.v < -self.error_v)
            | (self.before_b < -error_u1)
            | (self.before_d < -error_v1);
        (self.n > self.error_n) & is_apart
    }

    /// Whether the lines certainly meet strictly inside both edges.
    #[inline(always)]
    pub(super) fn is_inside(&self) -> bool {
        let (error_u1, error_v1) = self.far_errors();
        (self.n > self.error_n)
            & (self.u > self.error_u)
            & (self.v > self.error_v)
            & (self.before_b > error_u1)
            & (self.before_d > error_v1)
    }

    /// The parameters, if the lines certainly meet strictly inside both edges.
    pub(super) fn place(&self) -> Place {
        if self.is_apart() {
            return Place::Apart;
        }
        let (error_u1, error_v1) = self.far_errors();
        let Meeting { n, u, v, .. } = *self;
        if !self.is_inside() {
            return Place::Unclear;
        }
        // |u~/n~ - u/n| <= (error_u + error_n) / (n~ - error_n) for u in [0, 1], and three roundings.
        let error = error_u1.max(error_v1) / (n - self.error_n) + 4.0 * U;
        Place::Inside {
            u: u / n,
            v: v / n,
            error,
        }
    }

    /// Bounds on the errors of `n - u` and `n - v`, which are rounded once: `2 u n` is less than an
    /// eighth of the bounds.
    #[inline(always)]
    fn far_errors(&self) -> (f64, f64) {
        (
            1.25 * (self.error_n + self.error_u),
            1.25 * (self.error_n + self.error_v),
        )
    }
}

/// Far above what underflow adds to a product with `N`.
const TINY: f64 = f64::from_bits((1023 - 500) << 52);

#[cfg(test)]
mod tests;

//! Stage 3: the cubic `f = (K x L) . M` in Bernstein form, with a bound on its error.

use super::motion::{Motion, add, cross, dot, larger, largest, reach, smaller};
use super::separate::U;

/// `f` on `[0, 1]`, up to an error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cubic {
    /// The Bernstein coefficients, each within `error` of the exact one.
    pub(super) bernstein: [f64; 4],
    pub(super) error: f64,
    /// The largest magnitude among the differences that it is computed from.
    size: f64,
}

impl Cubic {
    /// Error bound. `f` is trilinear in `M`, `K`, `L`, so its Bernstein coefficients are averages of
    /// determinants `det(M_a, K_b, L_c)` at the ends `a`, `b`, `c` of the step:
    ///
    /// ```text
    /// b0 = (000), 3 b1 = (100) + (010) + (001), 3 b2 = (110) + (101) + (011), b3 = (111)
    /// ```
    ///
    /// With `k_i`, `l_i`, `m_i` the larger magnitudes at both ends and `P` the permanent, the sum of
    /// `m_h (k_i l_j + k_j l_i)`, every determinant is at most `P` in magnitude, and so is the sum of
    /// the magnitudes of its six terms. A term passes three rounded differences, two products and at
    /// most five sums and the division: its relative error is below `12 u (1 + 12 u)`, `u = 2^-53`, so
    /// each coefficient is within `12.1 u P` of the exact one. `P` is computed with a relative error
    /// below `10 u`. Below, `16 u P`.
    ///
    /// A product that underflows adds at most `2^-1075`, times at most one more factor; [`Cubic::new`]
    /// returns `None` unless all factors are below `2^300` and `16 u P` is above `2^-700`, so what
    /// underflow adds (fewer than 40 times `2^-775`) is below `2^-68` of the bound. Overflow cannot
    /// happen then. NaN and infinities fail the same test.
    #[inline(always)]
    pub(super) fn new(motion: &Motion) -> Option<Self> {
        let cubic = Self::unchecked(motion);
        cubic.is_valid().then_some(cubic)
    }

    /// As [`Cubic::new`], which is right only if it [`is_valid`](Cubic::is_valid).
    #[inline(always)]
    pub(super) fn unchecked(motion: &Motion) -> Self {
        let (k, l, m) = (reach(&motion.k), reach(&motion.l), reach(&motion.m));
        let permanent = m[0] * (k[1] * l[2] + k[2] * l[1])
            + m[1] * (k[2] * l[0] + k[0] * l[2])
            + m[2] * (k[0] * l[1] + k[1] * l[0]);
        let ([k0, k1], [l0, l1], [m0, m1]) = (&motion.k, &motion.l, &motion.m);
        let (n00, n11) = (cross(k0, l0), cross(k1, l1));
        let n01 = add(&cross(k0, l1), &cross(k1, l0));
        let bernstein = [
            dot(m0, &n00),
            (dot(m1, &n00) + dot(m0, &n01)) / 3.0,
            (dot(m0, &n11) + dot(m1, &n01)) / 3.0,
            dot(m1, &n11),
        ];
        let size = larger(larger(largest(&k), largest(&l)), largest(&m));
        Cubic {
            bernstein,
            error: 16.0 * U * permanent,
            size,
        }
    }

    /// Whether neither over- nor underflow spoils the error bound.
    #[inline(always)]
    pub(super) fn is_valid(&self) -> bool {
        (self.size < LARGEST) & (self.error > SMALLEST)
    }

    /// Whether `f` has no root in `[0, 1]`, so that the edges are never coplanar: it is a convex
    /// combination of its coefficients.
    #[inline(always)]
    pub(super) fn has_no_root(&self) -> bool {
        let [b0, b1, b2, b3] = self.bernstein;
        (smaller(smaller(b0, b1), smaller(b2, b3)) > self.error)
            | (larger(larger(b0, b1), larger(b2, b3)) < -self.error)
    }
}

const LARGEST: f64 = f64::from_bits((1023 + 300) << 52);
const SMALLEST: f64 = f64::from_bits((1023 - 700) << 52);

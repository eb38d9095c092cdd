//! Stage 3: the cubic `f = (K x L) . M` in Bernstein form, with a bound on its error.

use super::ends::Ends;
use super::ends::{larger, smaller};
use super::motion::{Motion, Vector, both, cross, dot, largest, reach};
use super::separate::U;

/// `f` on `[0, 1]`, up to an error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cubic {
    /// The Bernstein coefficients, each within `error` of the exact one.
    pub(super) bernstein: [f64; 4],
    pub(super) error: f64,
    /// No determinant at any time has terms of magnitudes with a larger sum.
    pub(super) permanent: f64,
    /// Of `K`, `L`, `M`: the larger magnitude of each component at both ends of the step.
    pub(super) reach: [Vector; 3],
}

impl Cubic {
    /// Error bound. `f` is trilinear in `M`, `K`, `L`, so its Bernstein coefficients are averages
    /// of determinants `det(M_a, K_b, L_c)` at the ends `a`, `b`, `c` of the step:
    ///
    /// ```text
    /// b0 = (000), 3 b1 = (100) + (010) + (001), 3 b2 = (110) + (101) + (011), b3 = (111)
    /// ```
    ///
    /// With `k_i`, `l_i`, `m_i` the larger magnitudes at both ends and `P` the permanent, the sum
    /// of `m_h (k_i l_j + k_j l_i)`, every determinant is at most `P` in magnitude, and so is the
    /// sum of the magnitudes of its six terms. A term passes three rounded differences, two
    /// products and at most five sums and the division: its relative error is below
    /// `12 u (1 + 12 u)`, `u = 2^-53`, so each coefficient is within `12.1 u P` of the exact one.
    /// `P` is computed with a relative error below `10 u`. Below, `16 u P`.
    ///
    /// A product that underflows adds at most `2^-1075`, times at most one more factor;
    /// [`Cubic::new`] returns `None` unless all factors are below `2^180` and `P` is above
    /// `2^-600`, so what underflow adds (fewer than 40 times `2^-895`) is far below the bound.
    /// What needs a larger `P` is `f` in double-double arithmetic (`refine`). Overflow cannot
    /// happen then. NaN and infinities fail the same test.
    #[inline(always)]
    pub(super) fn new<E: Ends>(motion: &Motion<E>) -> Option<Self> {
        let cubic = Self::unchecked(motion);
        cubic.is_valid().then_some(cubic)
    }

    #[inline(always)]
    pub(super) fn unchecked<E: Ends>(motion: &Motion<E>) -> Self {
        let Motion { k, l, m } = motion;
        let reach = [reach(k), reach(l), reach(m)];
        let minor = permanents(&reach[0], &reach[1]);
        let permanent = dot(&reach[2], &minor);
        let [normal_x, normal_y, normal_z] = cross(k, &l.map(E::swapped));
        let same = cross(k, l);
        // K x L of different ends, both of them.
        let mixed = both(&[normal_x.sum(), normal_y.sum(), normal_z.sum()]);
        let outer = dot(m, &same);
        let inner = dot(&m.map(E::swapped), &same) + dot(m, &mixed);
        let bernstein = [
            outer.start(),
            inner.start() / 3.0,
            inner.end() / 3.0,
            outer.end(),
        ];
        Self::of_parts(bernstein, permanent, reach)
    }

    /// Of what has been computed before.
    #[inline(always)]
    pub(super) fn of_parts(bernstein: [f64; 4], permanent: f64, reach: [Vector; 3]) -> Self {
        Cubic {
            bernstein,
            error: 16.0 * U * permanent,
            permanent,
            reach,
        }
    }

    /// Whether neither over- nor underflow spoils the error bound.
    #[inline(always)]
    pub(super) fn is_valid(&self) -> bool {
        let [k, l, m] = &self.reach;
        let size = larger(larger(largest(k), largest(l)), largest(m));
        (size < LARGEST) & (self.permanent > SMALLEST)
    }

    /// Whether `f` is certainly not 0 for the whole step: then not all coefficients are.
    #[inline(always)]
    pub(super) fn is_not_identically_0(&self) -> bool {
        let [b0, b1, b2, b3] = self.bernstein;
        let largest = larger(larger(b0.abs(), b1.abs()), larger(b2.abs(), b3.abs()));
        largest > self.error
    }

    /// Whether `f` has no root in `[0, 1]`, so that the edges are never coplanar: it is a convex
    /// combination of its coefficients.
    #[inline(always)]
    pub(super) fn has_no_root(&self) -> bool {
        have_one_sign(&self.bernstein, self.error)
    }
}

/// Whether all coefficients that are within `error` of these certainly have the same sign.
#[inline(always)]
pub(super) fn have_one_sign([b0, b1, b2, b3]: &[f64; 4], error: f64) -> bool {
    (smaller(smaller(*b0, *b1), smaller(*b2, *b3)) > error)
        | (larger(larger(*b0, *b1), larger(*b2, *b3)) < -error)
}

/// The components of `x X y` with every sign positive.
#[inline(always)]
pub(super) fn permanents(x: &Vector, y: &Vector) -> Vector {
    [
        x[1] * y[2] + x[2] * y[1],
        x[2] * y[0] + x[0] * y[2],
        x[0] * y[1] + x[1] * y[0],
    ]
}

const LARGEST: f64 = f64::from_bits((1023 + 180) << 52);
const SMALLEST: f64 = f64::from_bits((1023 - 600) << 52);

#[cfg(test)]
mod tests;

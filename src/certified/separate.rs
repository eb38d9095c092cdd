//! Stages 1 and 2: proofs that two moving edges stay apart.

use super::motion::Motion;
use crate::query::EdgeEdge;

/// Whether the boxes around the swept edges have no point in common: comparisons are exact.
pub(super) fn swept_boxes_are_disjoint(query: &EdgeEdge) -> bool {
    let ([a, b, c, d], [e, f, g, h]) = (query.start(), query.end());
    let axis_separates = |i: usize| {
        let first = [a[i], b[i], e[i], f[i]];
        let second = [c[i], d[i], g[i], h[i]];
        let low = |x: [f64; 4]| x[0].min(x[1]).min(x[2].min(x[3]));
        let high = |x: [f64; 4]| x[0].max(x[1]).max(x[2].max(x[3]));
        (high(first) < low(second)) | (high(second) < low(first))
    };
    axis_separates(0) | axis_separates(1) | axis_separates(2)
}

impl Motion {
    /// Whether the direction from the middle of one edge's motion to the other's separates them.
    #[inline]
    pub(super) fn is_separated_by_centres(&self) -> bool {
        // C + D - A - B at both ends of the step, up to rounding that does no harm: any direction
        // will do.
        let direction = [0, 1, 2].map(|i| {
            let at = |end: usize| self.m[end][i] + self.q[end][i] - self.k[end][i];
            at(0) + at(1)
        });
        self.is_separated_by(direction)
    }

    /// Whether `d` separates the edges for the whole step: `X . d` is larger for C and D than for A
    /// and B, at `t = 0` and at `t = 1`. It is linear in `t`, so larger in between too.
    ///
    /// Error bound: with `o_i` the largest of `|K_i|`, `|M_i|`, `|Q_i|` (`Q = D - A`), each a rounded
    /// difference (factor `1 + e`, `|e| <= u = 2^-53`) and `S` the sum of `o_i |d_i|`, a product with
    /// `d` in three products and two sums has an error below `4.1 u S` (Higham, Accuracy and
    /// Stability of Numerical Algorithms, 3.1), with the difference's own rounding `5.2 u S`. Two of
    /// them are compared: `10.4 u S`. `S` is itself computed with a relative error below `5 u`. A
    /// product that underflows is off by at most `2^-1075`, absorbed by `TINY`. If something
    /// overflows, the bound is infinite or a comparison meets NaN: no claim.
    #[inline]
    fn is_separated_by(&self, d: [f64; 3]) -> bool {
        const TINY: f64 = 1e-300;
        let dot = |x: &[f64; 3]| x[0] * d[0] + x[1] * d[1] + x[2] * d[2];
        let size = |i: usize| {
            let at = |end: usize| {
                self.k[end][i]
                    .abs()
                    .max(self.m[end][i].abs())
                    .max(self.q[end][i].abs())
            };
            at(0).max(at(1)) * d[i].abs()
        };
        let bound = (size(0) + size(1) + size(2)) * (12.0 * U) + TINY;
        let margin = |end: usize| {
            let (k, m, q) = (dot(&self.k[end]), dot(&self.m[end]), dot(&self.q[end]));
            m.min(q) - k.max(0.0)
        };
        // NaN must not pass for a proof: min and max drop it, so the products are checked as well.
        (margin(0) > bound) & (margin(1) > bound) & (bound < f64::INFINITY)
    }

    /// Looks for a separating direction: a few steps towards the point of the convex hull of the eight
    /// differences C - A, C - B, D - A, D - B that is nearest to 0 (Gilbert 1966, "An iterative procedure
    /// for computing the minimum of a quadratic form on a convex set"). Costs more than the cubic, so it
    /// comes last, before the exact stage.
    pub(super) fn is_separated_by_search(&self) -> bool {
        let sub = |x: &[f64; 3], y: &[f64; 3]| [x[0] - y[0], x[1] - y[1], x[2] - y[2]];
        let dot = |x: &[f64; 3], y: &[f64; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
        let mut corners = [[0.0; 3]; 8];
        for end in 0..2 {
            let (k, m, q) = (&self.k[end], &self.m[end], &self.q[end]);
            corners[4 * end..4 * end + 4].copy_from_slice(&[*m, *q, sub(m, k), sub(q, k)]);
        }
        let mut nearest = [0, 1, 2].map(|i| corners.iter().map(|c| c[i]).sum::<f64>() / 8.0);
        for _ in 0..SEARCH_STEPS {
            let support = corners
                .iter()
                .min_by(|x, y| dot(x, &nearest).total_cmp(&dot(y, &nearest)));
            let Some(support) = support else { return false };
            if dot(support, &nearest) > 0.0 && self.is_separated_by(nearest) {
                return true;
            }
            let step = sub(support, &nearest);
            let share = -dot(&nearest, &step) / dot(&step, &step);
            if !(share > 0.0) {
                return false;
            }
            let share = share.min(1.0);
            nearest = [0, 1, 2].map(|i| nearest[i] + share * step[i]);
        }
        false
    }
}

/// Half the distance from 1 to the next `f64`: the largest relative error of one rounding.
pub(super) const U: f64 = f64::EPSILON / 2.0;

const SEARCH_STEPS: usize = 6;

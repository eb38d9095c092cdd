//! Stage 4, continued: whether the edges touch at a root of `f`.

use super::motion::{Motion, Vector, reach};
use super::root::Bracket;
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

impl Motion {
    /// Where the lines meet at the root in the bracket.
    ///
    /// At the root, `M x L = u N` and `M x K = v N` with `N = K x L`: one component of each, the one
    /// in which `N` is largest, gives `u` and `v`.
    ///
    /// Error bound: let `w` be half the width of the bracket, `t` its middle and `p_ij` the sum
    /// `k_i l_j + k_j l_i` of larger magnitudes. A component of `K(t)` is within `4 u k_i` of the
    /// exact one (rounded difference, `1 - t`, a product, a sum), so `N_h(t)` is within
    /// `2 * 4 u p + 2 u p` of the exact one; moving to the root changes each component of `K` by at
    /// most `2 k_i w`, so `N_h` by at most `4 w p (1 + w)`. Below, `(16 u + 5 w) p`, for `w < 1/8`;
    /// `p` is computed with a relative error below `3 u`. Products that underflow: `p` is above
    /// `2^-700`, checked, and underflow adds less than `2^-1070`.
    pub(super) fn place(&self, bracket: &Bracket) -> Place {
        let t = 0.5 * (bracket.low + bracket.high);
        let half_width = 0.5 * (bracket.high - bracket.low) + U;
        if half_width > 0.125 {
            return Place::Unclear;
        }
        let s = 1.0 - t;
        let at = |[start, end]: &[Vector; 2]| {
            [
                s * start[0] + t * end[0],
                s * start[1] + t * end[1],
                s * start[2] + t * end[2],
            ]
        };
        let (k, l, m) = (at(&self.k), at(&self.l), at(&self.m));
        let cross = |x: &Vector, y: &Vector, i: usize, j: usize| x[i] * y[j] - x[j] * y[i];
        let normal = [
            cross(&k, &l, 1, 2),
            cross(&k, &l, 2, 0),
            cross(&k, &l, 0, 1),
        ];
        let [nx, ny, nz] = normal.map(f64::abs);
        let (i, j, n) = if nx >= ny && nx >= nz {
            (1, 2, normal[0])
        } else if ny >= nz {
            (2, 0, normal[1])
        } else {
            (0, 1, normal[2])
        };
        let reach = [reach(&self.k), reach(&self.l), reach(&self.m)];
        let factor = 16.0 * U + 5.0 * half_width;
        let bound = |x: usize, y: usize| {
            factor * (reach[x][i] * reach[y][j] + reach[x][j] * reach[y][i]) + TINY
        };
        let (error_n, error_u, error_v) = (bound(0, 1), bound(2, 1), bound(2, 0));
        let flip = if n < 0.0 { -1.0 } else { 1.0 };
        let (n, u, v) = (
            n.abs(),
            flip * cross(&m, &l, i, j),
            flip * cross(&m, &k, i, j),
        );
        if !(n > error_n) {
            return Place::Unclear;
        }
        // The differences below are rounded once: 2 u n is less than an eighth of the bounds.
        let (error_u1, error_v1) = (1.25 * (error_n + error_u), 1.25 * (error_n + error_v));
        if u < -error_u || v < -error_v || n - u < -error_u1 || n - v < -error_v1 {
            return Place::Apart;
        }
        if u > error_u && v > error_v && n - u > error_u1 && n - v > error_v1 {
            // |u~/n~ - u/n| <= (error_u + error_n) / (n~ - error_n) for u in [0, 1], and one rounding.
            let error = error_u1.max(error_v1) / (n - error_n) + 2.0 * U;
            return Place::Inside {
                u: u / n,
                v: v / n,
                error,
            };
        }
        Place::Unclear
    }
}

/// Far above what underflow adds, far below any bound that matters.
const TINY: f64 = f64::from_bits((1023 - 700) << 52);

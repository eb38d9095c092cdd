//! The differences that everything else is computed from.

use crate::query::{EdgeEdge, Point};

/// A vector in `f64`.
pub(super) type Vector = [f64; 3];

/// Rounded differences at `t = 0` and `t = 1`, in metres.
///
/// Each component is the exact difference times `1 + e` with `|e| <= 2^-53` (a difference of two
/// `f64` does not underflow), or infinite.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    /// `K = B - A`.
    pub(super) k: [Vector; 2],
    /// `L = D - C`.
    pub(super) l: [Vector; 2],
    /// `M = C - A`.
    pub(super) m: [Vector; 2],
    /// `Q = D - A`.
    pub(super) q: [Vector; 2],
}

impl Motion {
    #[inline]
    pub(super) fn new(query: &EdgeEdge) -> Self {
        let difference = |to: usize, from: usize| {
            let at = |p: &[Point; 4]| [0, 1, 2].map(|i| p[to][i] - p[from][i]);
            [at(query.start()), at(query.end())]
        };
        Motion {
            k: difference(1, 0),
            l: difference(3, 2),
            m: difference(2, 0),
            q: difference(3, 0),
        }
    }

    /// The larger magnitude of each component at both ends: a bound on it for the whole step.
    #[inline]
    pub(super) fn reach(ends: &[Vector; 2]) -> Vector {
        [0, 1, 2].map(|i| ends[0][i].abs().max(ends[1][i].abs()))
    }
}

#[inline]
pub(super) fn cross(x: &Vector, y: &Vector) -> Vector {
    [
        x[1] * y[2] - x[2] * y[1],
        x[2] * y[0] - x[0] * y[2],
        x[0] * y[1] - x[1] * y[0],
    ]
}

#[inline]
pub(super) fn dot(x: &Vector, y: &Vector) -> f64 {
    x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
}

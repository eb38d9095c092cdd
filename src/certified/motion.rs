//! The differences that everything else is computed from.

use crate::query::{EdgeEdge, Point};

/// A vector in `f64`.
pub(super) type Vector = [f64; 3];

/// The points A, B, C, D at `t = 0` and at `t = 1`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Positions {
    pub(super) start: [Vector; 4],
    pub(super) end: [Vector; 4],
}

impl Positions {
    #[inline(always)]
    pub(super) fn new(query: &EdgeEdge) -> Self {
        let plain = |p: &Point| [p.x, p.y, p.z];
        let plain = |[a, b, c, d]: &[Point; 4]| [plain(a), plain(b), plain(c), plain(d)];
        Positions {
            start: plain(query.start()),
            end: plain(query.end()),
        }
    }
}

/// Rounded differences at `t = 0` and `t = 1`, in metres.
///
/// Each component is the exact difference times `1 + e` with `|e| <= 2^-53` (a difference of two
/// `f64` does not underflow), or infinite; never NaN.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    /// `K = B - A`.
    pub(super) k: [Vector; 2],
    /// `L = D - C`.
    pub(super) l: [Vector; 2],
    /// `M = C - A`.
    pub(super) m: [Vector; 2],
}

impl Motion {
    #[inline(always)]
    pub(super) fn new(positions: &Positions) -> Self {
        let ([a0, b0, c0, d0], [a1, b1, c1, d1]) = (&positions.start, &positions.end);
        Motion {
            k: [sub(b0, a0), sub(b1, a1)],
            l: [sub(d0, c0), sub(d1, c1)],
            m: [sub(c0, a0), sub(c1, a1)],
        }
    }
}

/// The larger magnitude of each component at both ends: a bound on it for the whole step.
#[inline(always)]
pub(super) fn reach([start, end]: &[Vector; 2]) -> Vector {
    [
        larger(start[0].abs(), end[0].abs()),
        larger(start[1].abs(), end[1].abs()),
        larger(start[2].abs(), end[2].abs()),
    ]
}

#[inline(always)]
pub(super) fn largest(x: &Vector) -> f64 {
    larger(larger(x[0], x[1]), x[2])
}

#[inline(always)]
pub(super) fn add(x: &Vector, y: &Vector) -> Vector {
    [x[0] + y[0], x[1] + y[1], x[2] + y[2]]
}

#[inline(always)]
pub(super) fn sub(x: &Vector, y: &Vector) -> Vector {
    [x[0] - y[0], x[1] - y[1], x[2] - y[2]]
}

#[inline(always)]
pub(super) fn cross(x: &Vector, y: &Vector) -> Vector {
    [
        x[1] * y[2] - x[2] * y[1],
        x[2] * y[0] - x[0] * y[2],
        x[0] * y[1] - x[1] * y[0],
    ]
}

#[inline(always)]
pub(super) fn dot(x: &Vector, y: &Vector) -> f64 {
    x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
}

/// The larger of two numbers that are not NaN: one instruction, which `f64::max` is not.
#[inline(always)]
pub(super) fn larger(x: f64, y: f64) -> f64 {
    if x > y { x } else { y }
}

/// The smaller of two numbers that are not NaN.
#[inline(always)]
pub(super) fn smaller(x: f64, y: f64) -> f64 {
    if x < y { x } else { y }
}

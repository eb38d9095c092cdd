//! The differences that everything else is computed from.

use crate::query::{EdgeEdge, Point};

/// A vector in `f64`.
pub(super) type Vector = [f64; 3];

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
    pub(super) fn new(query: &EdgeEdge) -> Self {
        let ([a0, b0, c0, d0], [a1, b1, c1, d1]) = (query.start(), query.end());
        Motion {
            k: [difference(b0, a0), difference(b1, a1)],
            l: [difference(d0, c0), difference(d1, c1)],
            m: [difference(c0, a0), difference(c1, a1)],
        }
    }
}

#[inline(always)]
fn difference(to: &Point, from: &Point) -> Vector {
    [to.x - from.x, to.y - from.y, to.z - from.z]
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

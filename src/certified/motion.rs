//! The differences that everything else is computed from.

use super::ends::{Ends, Scalar, larger};
use crate::query::Point;

/// A vector in `f64`.
pub(crate) type Vector = [f64; 3];

/// The points A, B, C, D at `t = 0` and at `t = 1`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Positions {
    pub(crate) start: [Vector; 4],
    pub(crate) end: [Vector; 4],
}

impl Positions {
    /// The positions of the four points of a query at both ends of the step.
    #[inline(always)]
    pub(super) fn of(start: &[Point; 4], end: &[Point; 4]) -> Self {
        let plain = |p: &Point| [p.x, p.y, p.z];
        let plain = |[a, b, c, d]: &[Point; 4]| [plain(a), plain(b), plain(c), plain(d)];
        Positions {
            start: plain(start),
            end: plain(end),
        }
    }

    /// Each coordinate at both ends of the step.
    #[inline(always)]
    pub(super) fn points<E: Ends>(&self) -> [[E; 3]; 4] {
        let Positions { start, end } = self;
        let at = |p: usize| {
            [
                E::new(start[p][0], end[p][0]),
                E::new(start[p][1], end[p][1]),
                E::new(start[p][2], end[p][2]),
            ]
        };
        [at(0), at(1), at(2), at(3)]
    }
}

/// Rounded differences at `t = 0` and `t = 1`, in metres.
///
/// Each component is the exact difference times `1 + e` with `|e| <= 2^-53` (a difference of two
/// `f64` does not underflow), or infinite; never NaN.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<E> {
    /// `K = B - A`.
    pub(super) k: [E; 3],
    /// `L = D - C`.
    pub(super) l: [E; 3],
    /// `M = C - A`.
    pub(super) m: [E; 3],
}

impl<E: Ends> Motion<E> {
    #[inline(always)]
    pub(super) fn new([a, b, c, d]: &[[E; 3]; 4]) -> Self {
        Motion {
            k: sub(b, a),
            l: sub(d, c),
            m: sub(c, a),
        }
    }
}

/// The larger magnitude of each component at both ends: a bound on it for the whole step.
#[inline(always)]
pub(super) fn reach<E: Ends>([x, y, z]: &[E; 3]) -> Vector {
    [x.abs().largest(), y.abs().largest(), z.abs().largest()]
}

#[inline(always)]
pub(super) fn largest(x: &Vector) -> f64 {
    larger(larger(x[0], x[1]), x[2])
}

#[inline(always)]
pub(super) fn add<T: Scalar>(x: &[T; 3], y: &[T; 3]) -> [T; 3] {
    [x[0] + y[0], x[1] + y[1], x[2] + y[2]]
}

#[inline(always)]
pub(super) fn sub<T: Scalar>(x: &[T; 3], y: &[T; 3]) -> [T; 3] {
    [x[0] - y[0], x[1] - y[1], x[2] - y[2]]
}

#[inline(always)]
pub(super) fn scaled<T: Scalar>(factor: T, x: &[T; 3]) -> [T; 3] {
    [factor * x[0], factor * x[1], factor * x[2]]
}

#[inline(always)]
pub(super) fn cross<T: Scalar>(x: &[T; 3], y: &[T; 3]) -> [T; 3] {
    [
        x[1] * y[2] - x[2] * y[1],
        x[2] * y[0] - x[0] * y[2],
        x[0] * y[1] - x[1] * y[0],
    ]
}

#[inline(always)]
pub(super) fn dot<T: Scalar>(x: &[T; 3], y: &[T; 3]) -> T {
    x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
}

/// A vector that is the same at both ends of the step.
#[inline(always)]
pub(super) fn both<E: Ends>(x: &Vector) -> [E; 3] {
    [E::both(x[0]), E::both(x[1]), E::both(x[2])]
}

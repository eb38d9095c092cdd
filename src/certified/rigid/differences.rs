//! The two sides as a set of differences, in the body's frame and times `D = |q|^2`.
//!
//! The vectors from a point of the first side to one of the second are `M + v L - u K`, as for
//! linear motion ([`nearest`](crate::certified::nearest)). In the frame of the body, which `R =
//! M(q) / D` turns into space, a point that moves on a line is `M(q)^T (A - c) / D`, and a point of
//! the body stays. So all of them, times `D`, are polynomials.

use super::Turning;
use super::ball::Ball;
use super::term::{Term, Vector, dot, scaled, sub};
use crate::certified::kind::Stages;

/// `K`, `L` and `M`.
pub(super) struct Differences<T> {
    pub(super) k: Arm<T>,
    pub(super) l: Arm<T>,
    /// `D M`.
    pub(super) m: Vector<T>,
    /// `D`, which is above 0.
    pub(super) d: T,
}

/// A vector between two points of one side.
#[derive(Clone)]
pub(super) struct Arm<T> {
    /// Times `D`, but where it rests.
    pub(super) vector: Vector<T>,
    /// Whether both points are of the body: then it is constant, without the factor `D`.
    pub(super) rests: bool,
}

impl<T: Term> Differences<T> {
    pub(super) fn new<K: Stages, const WORLD: usize, const LOCAL: usize>(
        query: &Turning<WORLD, LOCAL>,
        time: T::Time,
    ) -> Self {
        let Turning {
            start,
            end,
            local,
            motion,
            ..
        } = *query;
        let [c0, c1] = [motion.start(), motion.end()].map(|pose| pose.centre);
        let [q0, q1] = motion.quaternions();
        let q = std::array::from_fn(|i| {
            T::line(Ball::new(q0[i]), Ball::difference(q1[i], q0[i]), time)
        });
        let (rows, d) = transposed(&q);
        let world: [Vector<T>; WORLD] = std::array::from_fn(|i| {
            let way: Vector<T> = std::array::from_fn(|axis| {
                let at_start = Ball::difference(start[i][axis], c0[axis]);
                let at_end = Ball::difference(end[i][axis], c1[axis]);
                T::line(at_start, at_end.sub(at_start), time)
            });
            rows.each_ref().map(|row| dot(row, &way))
        });
        let arm = |(from, to): (usize, usize)| match from < WORLD {
            true => Arm {
                vector: sub(&world[to], &world[from]),
                rests: false,
            },
            false => Arm {
                vector: std::array::from_fn(|axis| {
                    let [from, to] = [from, to].map(|i| local[i - WORLD][axis]);
                    T::constant(Ball::difference(to, from))
                }),
                rests: true,
            },
        };
        let [k, l, (from, to)] = K::DIFFERENCES;
        let resting: Vector<T> =
            std::array::from_fn(|axis| T::constant(Ball::new(local[to - WORLD][axis])));
        Differences {
            k: arm(k),
            l: arm(l),
            m: sub(&scaled(&d, &resting), &world[from]),
            d,
        }
    }
}

/// The rows of `M(q)^T`, and `D`.
fn transposed<T: Term>([w, x, y, z]: &[T; 4]) -> ([Vector<T>; 3], T) {
    let [ww, xx, yy, zz] = [w, x, y, z].map(|a| a.times(a));
    let twice = |a: &T, b: &T| a.times(b).twice();
    let (wx, wy, wz) = (twice(w, x), twice(w, y), twice(w, z));
    let (xy, xz, yz) = (twice(x, y), twice(x, z), twice(y, z));
    let diagonal = |own: &T, a: &T, b: &T| ww.plus(own).minus(&a.plus(b));
    let rows = [
        [diagonal(&xx, &yy, &zz), xy.plus(&wz), xz.minus(&wy)],
        [xy.minus(&wz), diagonal(&yy, &xx, &zz), yz.plus(&wx)],
        [xz.plus(&wy), yz.minus(&wx), diagonal(&zz, &xx, &yy)],
    ];
    (rows, ww.plus(&xx).plus(&yy.plus(&zz)))
}

//! The two sides as a set of differences, in the body's frame and times `D = |q|^2`.
//!
//! The vectors from a point of the first side to one of the second are `M + v L - u K`, as for
//! linear motion ([`nearest`](crate::certified::nearest)). In the frame of the body, which `R =
//! M(q) / D` turns into space, a point that moves on a line is `M(q)^T (A - c) / D`, and a point of
//! the body stays. A point `x` of another body, which `M1 / D1` turns about `c1`, is
//! `M(q)^T (D1 (c1 - c) + M1 x) / D1 D`; then `D` stands for `D1 D`. So all of them, times `D`, are
//! polynomials.

use super::ball::Ball;
use super::term::{Term, Vector, add, dot, scaled, sub};
use super::turning::{self, Turning};
use crate::certified::kind::Stages;
use crate::query::Point;
use crate::rigid::RigidMotion;

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
    pub(super) fn new<K: Stages, const FIRST: usize, const SECOND: usize>(
        query: &Turning<FIRST, SECOND>,
        time: T::Time,
    ) -> Self {
        let local = query.second.local;
        let frame = Frame::new(query.second.motion, time);
        let [k, l, (from, to)] = K::DIFFERENCES;
        let first = frame.first(&query.first, time);
        let arm = |way: (usize, usize)| match way.0 < FIRST {
            true => first.arm(way),
            false => Arm {
                vector: difference(local, (way.0 - FIRST, way.1 - FIRST)),
                rests: true,
            },
        };
        let resting: Vector<T> =
            std::array::from_fn(|axis| T::constant(Ball::new(local[to - FIRST][axis])));
        Differences {
            k: arm(k),
            l: arm(l),
            m: sub(&scaled(&first.d, &resting), &first.points[from]),
            d: first.d,
        }
    }
}

/// The difference of two points that rest.
fn difference<T: Term>(points: &[Point], (from, to): (usize, usize)) -> Vector<T> {
    std::array::from_fn(|axis| T::constant(Ball::difference(points[to][axis], points[from][axis])))
}

/// The frame of the second side's body.
struct Frame<T: Term> {
    centres: [Point; 2],
    /// The rows of `M(q)^T`, and `|q|^2`.
    rows: [Vector<T>; 3],
    d: T,
}

/// The points of the first side there.
struct First<'a, T, const N: usize> {
    /// Times `D`.
    points: [Vector<T>; N],
    /// `D`: `|q|^2`, times that of its own body if it has one.
    d: T,
    /// Its own body's points, and `M^T M1`.
    own: Option<(&'a [Point; N], [Vector<T>; 3])>,
}

impl<T: Term, const N: usize> First<'_, T, N> {
    /// A vector between two points; that of a body has a lower degree than the points.
    fn arm(&self, (from, to): (usize, usize)) -> Arm<T> {
        let vector = match &self.own {
            Some((local, rows)) => times(rows, &difference(&local[..], (from, to))),
            None => sub(&self.points[to], &self.points[from]),
        };
        Arm {
            vector,
            rests: false,
        }
    }
}

impl<T: Term> Frame<T> {
    fn new(motion: &RigidMotion, time: T::Time) -> Self {
        let (rows, d) = transposed(&quaternion(motion, time));
        Frame {
            centres: [motion.start().centre, motion.end().centre],
            rows,
            d,
        }
    }

    /// What moves on a line, from the centre of this frame.
    fn way(&self, start: &Point, end: &Point, time: T::Time) -> Vector<T> {
        let [c0, c1] = &self.centres;
        std::array::from_fn(|axis| {
            let at_start = Ball::difference(start[axis], c0[axis]);
            let at_end = Ball::difference(end[axis], c1[axis]);
            T::line(at_start, at_end.sub(at_start), time)
        })
    }

    fn first<'a, const N: usize>(
        &self,
        first: &turning::First<'a, N>,
        time: T::Time,
    ) -> First<'a, T, N> {
        match first {
            turning::First::Straight { start, end } => First {
                points: std::array::from_fn(|i| {
                    times(&self.rows, &self.way(&start[i], &end[i], time))
                }),
                d: self.d.clone(),
                own: None,
            },
            turning::First::Turning(body) => {
                let [w, x, y, z]: [T; 4] = quaternion(body.motion, time);
                // The conjugate turns the other way.
                let (own, d) = transposed(&[w, x.negative(), y.negative(), z.negative()]);
                let [start, end] = [body.motion.start(), body.motion.end()];
                let centre = self.way(&start.centre, &end.centre, time);
                let centre = times(&self.rows, &scaled(&d, &centre));
                let columns = std::array::from_fn(|j| own.each_ref().map(|row| row[j].clone()));
                let turned: [Vector<T>; 3] = columns.map(|column| times(&self.rows, &column));
                let rows: [Vector<T>; 3] =
                    std::array::from_fn(|i| turned.each_ref().map(|column| column[i].clone()));
                First {
                    points: body.local.each_ref().map(|p| {
                        let p = std::array::from_fn(|axis| T::constant(Ball::new(p[axis])));
                        add(&centre, &times(&rows, &p))
                    }),
                    d: self.d.times(&d),
                    own: Some((body.local, rows)),
                }
            }
        }
    }
}

fn times<T: Term>(rows: &[Vector<T>; 3], v: &Vector<T>) -> Vector<T> {
    rows.each_ref().map(|row| dot(row, v))
}

/// A vector in the frame of a body, turned into space, times `|q|^2`.
pub(super) fn into_space<T: Term>(motion: &RigidMotion, time: T::Time, v: &Vector<T>) -> Vector<T> {
    let ([x, y, z], _) = transposed(&quaternion(motion, time));
    let scaled = [scaled(&v[0], &x), scaled(&v[1], &y), scaled(&v[2], &z)];
    add(&add(&scaled[0], &scaled[1]), &scaled[2])
}

/// w, x, y and z.
fn quaternion<T: Term>(motion: &RigidMotion, time: T::Time) -> [T; 4] {
    let [q0, q1] = motion.quaternions();
    std::array::from_fn(|i| T::line(Ball::new(q0[i]), Ball::difference(q1[i], q0[i]), time))
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

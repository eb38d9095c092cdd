//! The motion of a query in the body's frame, as polynomials with integer coefficients.

use crate::certified::exact::integer::Integer;
use crate::certified::exact::near::{in_unit, integer, unit};
use crate::certified::exact::thick::Poly;
use crate::certified::exact::thick::vector::Vector;
use crate::query::Point;
use crate::rigid::RigidMotion;

/// The world's points and the body's, in the body's frame.
pub(super) struct InBody<const WORLD: usize, const LOCAL: usize> {
    /// `D (A - c)` there: `M^T (A - c)`, of degree 3.
    pub(super) world: [Vector; WORLD],
    /// The points of the body, constant, without the factor `D`.
    pub(super) local: [Vector; LOCAL],
    /// `D = |q|^2`, which is above 0.
    pub(super) d: Poly,
    /// Lengths are in multiples of `2^unit` metres, by `D` where they have this factor.
    pub(super) unit: i32,
}

impl<const WORLD: usize, const LOCAL: usize> InBody<WORLD, LOCAL> {
    pub(super) fn new(
        start: &[Point; WORLD],
        end: &[Point; WORLD],
        local: &[Point; LOCAL],
        motion: &RigidMotion,
    ) -> Self {
        let centres = [motion.start().centre, motion.end().centre];
        let plain = |p: &Point| [p.x, p.y, p.z];
        let points = start.iter().chain(end).chain(local).chain(&centres);
        let lengths: Vec<[f64; 3]> = points.clone().map(plain).collect();
        let own = unit(lengths.iter().flatten());
        let scaled = |p: &Point| -> [Integer; 3] {
            let [point] = in_unit(&[plain(p)], own);
            point
        };
        let [c0, c1] = centres.each_ref().map(scaled);
        let (q, d) = quaternion(motion);
        let rows = transposed(&q);
        let world = std::array::from_fn(|i| {
            let (from, to) = (scaled(&start[i]), scaled(&end[i]));
            let way: Vector = [0, 1, 2].map(|axis: usize| {
                let at_start = Integer::difference(&from[axis], &c0[axis]);
                let at_end = Integer::difference(&to[axis], &c1[axis]);
                line(at_start, &at_end)
            });
            times(&rows, &way)
        });
        let constant = |p: &Point| scaled(p).map(|x| Poly::new(&[x]));
        InBody {
            world,
            local: local.each_ref().map(constant),
            d,
            unit: own,
        }
    }
}

/// From `start` at `t = 0` to `end` at `t = 1`.
fn line(start: Integer, end: &Integer) -> Poly {
    let change = Integer::difference(end, &start);
    Poly::new(&[start, change])
}

/// `w`, `x`, `y` and `z`, and the sum of their squares.
fn quaternion(motion: &RigidMotion) -> ([Poly; 4], Poly) {
    let [q0, q1] = motion.quaternions();
    let own = unit(q0.iter().chain(&q1));
    let q = [0, 1, 2, 3].map(|i: usize| line(integer(q0[i], own), &integer(q1[i], own)));
    let mut d = Poly::default();
    for component in &q {
        d = Poly::sum(&d, &Poly::product(component, component));
    }
    (q, d)
}

/// The rows of `M(q)^T`.
fn transposed([w, x, y, z]: &[Poly; 4]) -> [Vector; 3] {
    let twice = |a: &Poly, b: &Poly| Poly::product(a, b).shifted(1);
    let [ww, xx, yy, zz] = [w, x, y, z].map(|a| Poly::product(a, a));
    let (wx, wy, wz) = (twice(w, x), twice(w, y), twice(w, z));
    let (xy, xz, yz) = (twice(x, y), twice(x, z), twice(y, z));
    let (plus, minus) = (Poly::sum, Poly::difference);
    let diagonal = |own: &Poly, a: &Poly, b: &Poly| minus(&plus(&ww, own), &plus(a, b));
    [
        [diagonal(&xx, &yy, &zz), plus(&xy, &wz), minus(&xz, &wy)],
        [minus(&xy, &wz), diagonal(&yy, &xx, &zz), plus(&yz, &wx)],
        [plus(&xz, &wy), minus(&yz, &wx), diagonal(&zz, &xx, &yy)],
    ]
}

fn times(rows: &[Vector; 3], v: &Vector) -> Vector {
    rows.each_ref()
        .map(|row| crate::certified::exact::thick::vector::dot(row, v))
}

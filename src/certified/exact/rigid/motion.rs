//! The motion of a query in the frame of the second side's body, as polynomials with integer
//! coefficients.

use crate::certified::exact::coordinates::{in_unit, integer, unit};
use crate::certified::exact::integer::Integer;
use crate::certified::exact::thick::Poly;
use crate::certified::exact::thick::vector::{Vector, add};
use crate::certified::rigid::{First, Turning};
use crate::query::Point;
use crate::rigid::RigidMotion;

/// The points of both sides, in the frame of the second one's body.
pub(super) struct InBody<const FIRST: usize, const SECOND: usize> {
    /// Times `D`: `M^T (A - c)`, of degree 3; of a body that turns by `M1 / D1`, whose centre is `c1`,
    /// `M^T (D1 (c1 - c) + M1 x)`, of degree 5.
    pub(super) first: [Vector; FIRST],
    /// Constant, without the factor `D`.
    pub(super) second: [Vector; SECOND],
    /// `|q|^2`, or `D1 |q|^2`, which is above 0.
    pub(super) d: Poly,
    /// Lengths are in multiples of `2^unit` metres, by `D` where they have this factor.
    pub(super) unit: i32,
}

impl<const FIRST: usize, const SECOND: usize> InBody<FIRST, SECOND> {
    pub(super) fn new(query: &Turning<'_, FIRST, SECOND>) -> Self {
        let Turning { first, second, .. } = query;
        let unit = Unit::of(query);
        let (q, d) = quaternion(second.motion);
        let rows = transposed(&q);
        let [c0, c1] = unit.centres(second.motion);
        let constant = |p: &Point| unit.integers(p).map(|x| Poly::new(&[x]));
        let (first, d) = match first {
            First::Straight { start, end } => {
                let turned = std::array::from_fn(|i| {
                    let (from, to) = (unit.integers(&start[i]), unit.integers(&end[i]));
                    times(&rows, &way([&c0, &c1], [&from, &to]))
                });
                (turned, d)
            }
            First::Turning(body) => {
                let (own, own_d) = quaternion(body.motion);
                // The conjugate turns the other way.
                let [w, x, y, z] = own;
                let own_rows = transposed(&[w, negative(&x), negative(&y), negative(&z)]);
                let [from, to] = unit.centres(body.motion);
                let centre = way([&c0, &c1], [&from, &to]).map(|x| Poly::product(&x, &own_d));
                let turned = body.local.each_ref().map(|p| {
                    let point = add(&centre, &times(&own_rows, &constant(p)));
                    times(&rows, &point)
                });
                (turned, Poly::product(&d, &own_d))
            }
        };
        InBody {
            first,
            second: second.local.each_ref().map(constant),
            d,
            unit: unit.0,
        }
    }
}

/// A vector in the frame of a body, turned into space, times `|q|^2`.
pub(super) fn turned(motion: &RigidMotion, v: &Vector) -> Vector {
    let ([w, x, y, z], _) = quaternion(motion);
    // The conjugate turns the other way.
    times(
        &transposed(&[w, negative(&x), negative(&y), negative(&z)]),
        v,
    )
}

/// The power of two of which all lengths are multiples.
struct Unit(i32);

impl Unit {
    fn of<const FIRST: usize, const SECOND: usize>(query: &Turning<'_, FIRST, SECOND>) -> Self {
        let mut points: Vec<Point> = query.second.local.to_vec();
        let mut motions = vec![query.second.motion];
        match &query.first {
            First::Straight { start, end } => points.extend(start.iter().chain(*end)),
            First::Turning(body) => {
                points.extend(body.local);
                motions.push(body.motion);
            }
        }
        for motion in motions {
            points.extend([motion.start().centre, motion.end().centre]);
        }
        let numbers: Vec<[f64; 3]> = points.iter().map(plain).collect();
        Unit(unit(numbers.iter().flatten()))
    }

    fn integers(&self, p: &Point) -> [Integer; 3] {
        let [point] = in_unit(&[plain(p)], self.0);
        point
    }

    /// Where the body's centre is at the start and at the end.
    fn centres(&self, motion: &RigidMotion) -> [[Integer; 3]; 2] {
        [motion.start(), motion.end()].map(|pose| self.integers(&pose.centre))
    }
}

fn plain(p: &Point) -> [f64; 3] {
    [p.x, p.y, p.z]
}

/// The way from what moves between two places to what moves between two other ones.
fn way(from: [&[Integer; 3]; 2], to: [&[Integer; 3]; 2]) -> Vector {
    [0, 1, 2].map(|axis: usize| {
        let at_start = Integer::difference(&to[0][axis], &from[0][axis]);
        let at_end = Integer::difference(&to[1][axis], &from[1][axis]);
        line(at_start, &at_end)
    })
}

fn negative(x: &Poly) -> Poly {
    Poly::difference(&Poly::default(), x)
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

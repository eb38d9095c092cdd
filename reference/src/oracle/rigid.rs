//! The truth about an edge or a vertex and a body that turns.
//!
//! In the body's frame and times `D(t) = |q(t)|^2 > 0`, the four points move polynomially: a point
//! `A` of space as `q* (A - c) q`, the vector part of a product of quaternions, of degree 3, and a
//! point `x` of the body as `D x`. All differences of the four are then `D` times those in space,
//! turned. Every predicate of the oracle is homogeneous in the differences and the same in a turned
//! frame, and none of its reasons needs more than that the motion is continuous and polynomial. So
//! it is the oracle for linear motion, on other polynomials. A radius `R` is `D R` there.
//!
//! Where the first side is of a body of its own, with the quaternion `p` and the centre `b`, its
//! points are `q* (P (b - c) + p x p*) q`, `P = |p|^2`, and those of the second body `P D x`: then all
//! differences have the factor `P D`.

use tunnelproof::query::QueryKind;
use tunnelproof::rigid::RigidQuery;

use crate::answer::ExactAnswer;
use crate::field::{self, Integer};
use crate::poly::Poly;
use crate::scaled::{ScaledBody, ScaledRigid, ScaledSide};

use super::edges::Edges;
use super::face::Face;
use super::motion::Motion;
use super::proximity::Proximity;
use super::vector::Vector;
use super::{Decision, Near};

/// The exact answer to a query of a body that turns, by the default backend.
pub fn decide_rigid_query(query: &RigidQuery) -> ExactAnswer {
    decide_rigid::<field::Default>(query).written()
}

/// The exact answer to a query of a body that turns, its numbers still algebraic.
pub fn decide_rigid<Z: Integer>(query: &RigidQuery) -> Decision<Z> {
    let scaled = ScaledRigid::new(query);
    let body = InBody::<Z>::new(&scaled);
    let motion = body.motion(query.kind().linear());
    let radius = query.radius();
    let near = (!radius.is_zero()).then(|| Near {
        proximity: body.proximity(&*motion, scaled.exponent),
        radius: radius.parts(),
    });
    Decision::of(motion, near)
}

/// The distance of the two sides.
pub(super) fn proximity<Z: Integer>(query: &RigidQuery) -> Proximity<Z> {
    let scaled = ScaledRigid::new(query);
    let body = InBody::<Z>::new(&scaled);
    let motion = body.motion(query.kind().linear());
    body.proximity(&*motion, scaled.exponent)
}

/// The motion in the frame of the second side's body.
struct InBody<Z> {
    /// The four points, times `size`.
    points: Vec<Vector<Z>>,
    /// `D`, or `P D`.
    size: Poly<Z>,
}

impl<Z: Integer> InBody<Z> {
    fn new(points: &ScaledRigid<Z>) -> Self {
        let body = &points.second;
        let q = Quaternion::of(body);
        let [c0, c1] = &body.centres;
        let from_centre = |[start, end]: [&[Z; 3]; 2]| {
            let difference =
                |point: &[Z; 3], centre: &[Z; 3]| [0, 1, 2].map(|h| point[h].sub(&centre[h]));
            Vector::linear(&difference(start, c0), &difference(end, c1))
        };
        let back = q.conjugate();
        let into_frame = |way: Vector<Z>| back.turned(way);
        let mut size = q.size();
        let first: Vec<Vector<Z>> = match &points.first {
            ScaledSide::Straight(points) => {
                let ways = points.iter().map(|point| from_centre(point.each_ref()));
                ways.map(into_frame).collect()
            }
            ScaledSide::Turning(own) => {
                let p = Quaternion::of(own);
                let own_size = p.size();
                let Vector(way) = from_centre(own.centres.each_ref());
                let centre = way.map(|x| x.mul(&own_size));
                size = size.mul(&own_size);
                let turned = |x: &[Z; 3]| {
                    let Vector(x) = p.turned(Vector(x.clone().map(Poly::constant)));
                    into_frame(Vector([0, 1, 2].map(|h| centre[h].add(&x[h]))))
                };
                own.local.iter().map(turned).collect()
            }
        };
        let second = body.local.iter().map(|point| {
            let coordinate = |h: usize| size.scale(&point[h]);
            Vector([0, 1, 2].map(coordinate))
        });
        InBody {
            points: first.into_iter().chain(second).collect(),
            size,
        }
    }

    fn motion(&self, kind: QueryKind) -> Box<dyn Motion<Z>> {
        let way = |from: usize, to: usize| self.points[to].sub(&self.points[from]);
        match kind {
            QueryKind::EdgeEdge => Box::new(Edges::of(way(0, 1), way(2, 3), way(0, 2))),
            QueryKind::VertexFace => Box::new(Face::of(way(1, 0), way(1, 2), way(1, 3))),
        }
    }

    fn proximity(&self, motion: &dyn Motion<Z>, exponent: i64) -> Proximity<Z> {
        Proximity::enlarged(motion, exponent, &self.size.mul(&self.size))
    }
}

/// w, x, y and z.
struct Quaternion<Z>([Poly<Z>; 4]);

impl<Z: Integer> Quaternion<Z> {
    /// That of a body, which moves on a line.
    fn of(body: &ScaledBody<Z>) -> Self {
        let [q0, q1] = &body.quaternions;
        Quaternion([0, 1, 2, 3].map(|i| Poly::line(&q0[i], &q1[i])))
    }

    /// `|q|^2`.
    fn size(&self) -> Poly<Z> {
        let [size, ..] = self.conjugate().product(self).0;
        size
    }

    /// `q x q*`: turned, times the square of the length.
    fn turned(&self, Vector([x, y, z]): Vector<Z>) -> Vector<Z> {
        let way = Quaternion([Poly::zero(), x, y, z]);
        let Quaternion([_, x, y, z]) = self.product(&way).product(&self.conjugate());
        Vector([x, y, z])
    }

    fn conjugate(&self) -> Self {
        let [w, x, y, z] = &self.0;
        Quaternion([w.clone(), x.neg(), y.neg(), z.neg()])
    }

    /// Hamilton's product.
    fn product(&self, other: &Self) -> Self {
        // Row `i` of the table: of which component of `other`, and with which sign, component `j`
        // of `self` is a factor of component `i` of the product.
        const TABLE: [[(usize, bool); 4]; 4] = [
            [(0, true), (1, false), (2, false), (3, false)],
            [(1, true), (0, true), (3, true), (2, false)],
            [(2, true), (3, false), (0, true), (1, true)],
            [(3, true), (2, true), (1, false), (0, true)],
        ];
        Quaternion(TABLE.map(|row| {
            let mut sum = Poly::zero();
            for (own, (at, is_plus)) in self.0.iter().zip(row) {
                match is_plus {
                    true => sum.add_product(own, &other.0[at]),
                    false => sum.sub_product(own, &other.0[at]),
                }
            }
            sum
        }))
    }
}

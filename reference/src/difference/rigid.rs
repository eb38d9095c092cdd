//! The difference of an edge or a vertex and a body that turns, in space.
//!
//! With `X = c + R x`, `R = M / D` and `D = |q|^2 > 0`, a corner times `D` is
//! `D (c - A) + M x`, of degree 3, and the product of two corners times `D` is
//!
//! ```text
//! D (c - A) . (c - A') + (c - A) . M x' + (c - A') . M x + D x . x'
//! ```
//!
//! of degree 4: a turn leaves products as they are, so that no product of two turned vectors is
//! needed. `M x = (w^2 - v . v) x + 2 (v . x) v + 2 w v x x`, with `v` for the vector part of `q`.
//! Contact, parts and places are made of the products, times `D` all of them.

use tunnelproof::query::QueryKind;
use tunnelproof::rigid::RigidQuery;

use crate::answer::ExactAnswer;
use crate::field::Integer;
use crate::poly::Poly;
use crate::scaled::ScaledRigid;

use super::decide_polygon;
use super::polygon::{Polygon, ways};

type Vector<Z> = [Poly<Z>; 3];

/// The exact answer to a query of a body that turns.
pub fn decide_rigid<Z: Integer>(query: &RigidQuery) -> ExactAnswer {
    let kind = match query {
        RigidQuery::EdgeTurningEdge(_) => QueryKind::EdgeEdge,
        RigidQuery::VertexTurningFace(_) => QueryKind::VertexFace,
    };
    let points = ScaledRigid::<Z>::new(query);
    decide_polygon(&polygon(kind, &points), query.radius(), points.exponent)
}

fn polygon<Z: Integer>(kind: QueryKind, points: &ScaledRigid<Z>) -> Polygon<Z> {
    let [q0, q1] = &points.quaternions;
    let q = [0, 1, 2, 3].map(|i| Poly::line(&q0[i], &q1[i]));
    let [w, v] = [&q[..1], &q[1..]];
    let (ww, vv) = (w[0].mul(&w[0]), dot(v, v));
    let size = ww.add(&vv);
    let turned = |x: &Vector<Z>| -> Vector<Z> {
        let along = dot(v, x);
        let across = cross(v, x);
        [0, 1, 2].map(|h| {
            let mut twice = along.mul(&v[h]);
            twice.add_product(&w[0], &across[h]);
            let mut sum = ww.sub(&vv).mul(&x[h]);
            sum.add_product(&Poly::constant(Z::from_i64(2)), &twice);
            sum
        })
    };
    let [c0, c1] = &points.centres;
    // `c - A` for the points of the first side, `x` and `M x` for those of the body.
    let to_centre: Vec<Vector<Z>> = points
        .world
        .iter()
        .map(|[start, end]| {
            [0, 1, 2].map(|h| Poly::line(&c0[h].sub(&start[h]), &c1[h].sub(&end[h])))
        })
        .collect();
    let local: Vec<Vector<Z>> = points
        .local
        .iter()
        .map(|x| x.clone().map(Poly::constant))
        .collect();
    let in_space: Vec<Vector<Z>> = local.iter().map(turned).collect();
    let first = to_centre.len();
    let corner = |&(from, to): &(usize, usize)| -> Vector<Z> {
        let (way, turned) = (&to_centre[from], &in_space[to - first]);
        [0, 1, 2].map(|h| size.mul(&way[h]).add(&turned[h]))
    };
    let product = |&(from, to): &(usize, usize), &(other_from, other_to): &(usize, usize)| {
        let (i, j) = (to - first, other_to - first);
        let (a, b) = (&to_centre[from], &to_centre[other_from]);
        let straight = dot(a, b).add(&dot(&local[i], &local[j]));
        let mixed = dot(a, &in_space[j]).add(&dot(b, &in_space[i]));
        size.mul(&straight).add(&mixed)
    };
    let ways = ways(kind);
    let row = |x| ways.iter().map(|y| product(x, y)).collect();
    Polygon::of(
        kind,
        ways.iter().map(corner).collect(),
        ways.iter().map(row).collect(),
        size.clone(),
    )
}

fn dot<Z: Integer>(x: &[Poly<Z>], y: &[Poly<Z>]) -> Poly<Z> {
    let mut sum = Poly::zero();
    for (x, y) in x.iter().zip(y) {
        sum.add_product(x, y);
    }
    sum
}

fn cross<Z: Integer>(x: &[Poly<Z>], y: &[Poly<Z>]) -> Vector<Z> {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        let mut component = x[i].mul(&y[j]);
        component.sub_product(&x[j], &y[i]);
        component
    })
}

//! The difference of an edge or a vertex, of space or of a body that turns, and a body that turns, in
//! space.
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
//!
//! Of two bodies, with the centres `w` apart, a corner is `P D w + P M x - D N y`, where `N / P` turns the
//! first one, and the product of two of them, times `P D`, has the degree 6:
//!
//! ```text
//! P D (w . w + x . x' + y . y') + P w . (M x + M x') - D w . (N y + N y') - N y . M x' - N y' . M x
//! ```

use tunnelproof::query::QueryKind;
use tunnelproof::rigid::RigidQuery;

use crate::answer::ExactAnswer;
use crate::field::Integer;
use crate::poly::Poly;
use crate::scaled::{ScaledBody, ScaledRigid, ScaledSide};

use super::decide_polygon;
use super::polygon::{Polygon, ways};

type Vector<Z> = [Poly<Z>; 3];

/// The exact answer to a query of bodies that turn.
pub fn decide_rigid<Z: Integer>(query: &RigidQuery) -> ExactAnswer {
    let points = ScaledRigid::<Z>::new(query);
    let polygon = polygon(query.kind().linear(), &points);
    decide_polygon(&polygon, query.radius(), points.exponent)
}

/// A body with its points turned.
struct Body<Z> {
    /// `|q|^2`.
    size: Poly<Z>,
    /// The points in its frame.
    local: Vec<Vector<Z>>,
    /// `M x` for each.
    turned: Vec<Vector<Z>>,
    /// The centre.
    centre: Vector<Z>,
}

impl<Z: Integer> Body<Z> {
    fn new(body: &ScaledBody<Z>) -> Self {
        let [q0, q1] = &body.quaternions;
        let q = [0, 1, 2, 3].map(|i| Poly::line(&q0[i], &q1[i]));
        let [w, v] = [&q[..1], &q[1..]];
        let (ww, vv) = (w[0].mul(&w[0]), dot(v, v));
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
        let local = body.local.iter();
        let local: Vec<Vector<Z>> = local.map(|x| x.clone().map(Poly::constant)).collect();
        Body {
            size: ww.add(&vv),
            turned: local.iter().map(turned).collect(),
            local,
            centre: line(&body.centres),
        }
    }
}

fn line<Z: Integer>([start, end]: &[[Z; 3]; 2]) -> Vector<Z> {
    [0, 1, 2].map(|h| Poly::line(&start[h], &end[h]))
}

fn polygon<Z: Integer>(kind: QueryKind, points: &ScaledRigid<Z>) -> Polygon<Z> {
    let second = Body::new(&points.second);
    match &points.first {
        ScaledSide::Straight(first) => {
            let first: Vec<Vector<Z>> = first.iter().map(line).collect();
            against_lines(kind, &first, &second)
        }
        ScaledSide::Turning(first) => against_body(kind, &Body::new(first), &second),
    }
}

fn against_lines<Z: Integer>(kind: QueryKind, first: &[Vector<Z>], second: &Body<Z>) -> Polygon<Z> {
    let count = first.len();
    let to_centre: Vec<Vector<Z>> = first.iter().map(|a| sub(&second.centre, a)).collect();
    let corner = |&(from, to): &(usize, usize)| -> Vector<Z> {
        let (way, turned) = (&to_centre[from], &second.turned[to - count]);
        [0, 1, 2].map(|h| second.size.mul(&way[h]).add(&turned[h]))
    };
    let product = |&(from, to): &(usize, usize), &(other_from, other_to): &(usize, usize)| {
        let (i, j) = (to - count, other_to - count);
        let (a, b) = (&to_centre[from], &to_centre[other_from]);
        let straight = dot(a, b).add(&dot(&second.local[i], &second.local[j]));
        let mixed = dot(a, &second.turned[j]).add(&dot(b, &second.turned[i]));
        second.size.mul(&straight).add(&mixed)
    };
    of_corners(kind, corner, product, second.size.clone())
}

/// The centres of both bodies are `w` apart.
fn against_body<Z: Integer>(kind: QueryKind, first: &Body<Z>, second: &Body<Z>) -> Polygon<Z> {
    let count = first.local.len();
    let way = sub(&second.centre, &first.centre);
    let both = first.size.mul(&second.size);
    let square = dot(&way, &way);
    let along = |body: &Body<Z>| body.turned.iter().map(|x| dot(&way, x)).collect::<Vec<_>>();
    let (along_first, along_second) = (along(first), along(second));
    let corner = |&(from, to): &(usize, usize)| -> Vector<Z> {
        let (x, y) = (&first.turned[from], &second.turned[to - count]);
        [0, 1, 2].map(|h| {
            let mut sum = both.mul(&way[h]);
            sum.add_product(&first.size, &y[h]);
            sum.sub_product(&second.size, &x[h]);
            sum
        })
    };
    let product = |&(from, to): &(usize, usize), &(other_from, other_to): &(usize, usize)| {
        let (i, j) = (to - count, other_to - count);
        let own = dot(&first.local[from], &first.local[other_from])
            .add(&dot(&second.local[i], &second.local[j]));
        let mut sum = both.mul(&square.add(&own));
        sum.add_product(&first.size, &along_second[i].add(&along_second[j]));
        sum.sub_product(
            &second.size,
            &along_first[from].add(&along_first[other_from]),
        );
        let mixed = dot(&first.turned[from], &second.turned[j])
            .add(&dot(&first.turned[other_from], &second.turned[i]));
        sum.sub(&mixed)
    };
    of_corners(kind, corner, product, both.clone())
}

fn of_corners<Z: Integer>(
    kind: QueryKind,
    corner: impl Fn(&(usize, usize)) -> Vector<Z>,
    product: impl Fn(&(usize, usize), &(usize, usize)) -> Poly<Z>,
    scale: Poly<Z>,
) -> Polygon<Z> {
    let ways = ways(kind);
    let row = |x| ways.iter().map(|y| product(x, y)).collect();
    Polygon::of(
        kind,
        ways.iter().map(corner).collect(),
        ways.iter().map(row).collect(),
        scale,
    )
}

fn sub<Z: Integer>(x: &Vector<Z>, y: &Vector<Z>) -> Vector<Z> {
    [0, 1, 2].map(|h| x[h].sub(&y[h]))
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

//! A vertex A and a face BCD: `s P = C - B`, `s Q = D - B`, `X = A - B`, `N = P x Q`, `f = X . N`.
//!
//! `s` is above 0: 1, but for a face of a body that turns, whose `P` and `Q` are at rest.

use super::pair::{Pair, Place, Share};
use super::vector::{Vector, cross, dot, is_zero, neg, one, sub, times};
use super::{Poly, Polygon, Sides, Time};
use crate::contact::Flags;

pub(in crate::certified::exact) struct Face {
    p: Vector,
    q: Vector,
    /// `s`.
    scale: Poly,
    x: Vector,
    n: Vector,
    n2: Poly,
    f: Poly,
}

impl Face {
    pub(super) fn new([a, b, c, d]: &[Vector; 4]) -> Self {
        Face::of(sub(c, b), sub(d, b), sub(a, b), one())
    }

    /// From `P`, `Q`, `X` and `s`.
    pub(in crate::certified::exact) fn of(p: Vector, q: Vector, x: Vector, scale: Poly) -> Self {
        let n = cross(&p, &q);
        Face {
            n2: dot(&n, &n),
            f: dot(&x, &n),
            scale,
            p,
            q,
            x,
            n,
        }
    }

    /// The foot of the vertex in the plane has the weights `c = (X x Q) . N` and `d = (P x X) . N`
    /// over `s N . N`: with `h` the height, `X - h N = c P + d Q`, crossed with `Q` or `P` and
    /// multiplied by `N`. As `N = P x Q`, these products are of inner products.
    fn inside(&self, [pp, pq, qq, px, qx]: [&Poly; 5]) -> Pair<3> {
        let Face { n2, f, .. } = self;
        let minor = |a: &Poly, b: &Poly, c: &Poly, d: &Poly| {
            Poly::difference(&Poly::product(a, b), &Poly::product(c, d))
        };
        let (c, d) = (minor(px, qq, qx, pq), minor(pp, qx, pq, px));
        let sn2 = Poly::product(&self.scale, n2);
        let b = Poly::difference(&Poly::difference(&sn2, &c), &d);
        let inside = vec![b, c, d];
        let quotient = |n: &Poly| Share::Quotient(n.clone(), sn2.clone());
        let place = [0, 1, 2].map(|i: usize| quotient(&inside[i]));
        Pair::insides(f, n2, inside, place)
    }
}

impl Sides<3> for Face {
    fn pairs(&self) -> Vec<Pair<3>> {
        use Share::{All, None};
        let Face { p, q, x, scale, .. } = self;
        let (pp, pq, qq) = (&dot(p, p), &dot(p, q), &dot(q, q));
        let (px, qx) = (&dot(p, x), &dot(q, x));
        let (spp, sqq) = (&Poly::product(scale, pp), &Poly::product(scale, qq));
        // The ways from A to C and D, and from C to D.
        let to = |way: &Vector| sub(&times(way, scale), x);
        let (to_c, to_d, last) = (&to(p), &to(q), &sub(q, p));
        let (b2, c2, d2) = (&dot(x, x), &dot(to_c, to_c), &dot(to_d, to_d));
        let (last2, c_on_last) = (&dot(last, last), &dot(to_c, last));
        let s_last2 = &Poly::product(scale, last2);
        let negative = |p: &Poly| Poly::difference(&Poly::default(), p);
        let (b_on_p, b_on_q) = (&negative(px), &negative(qx));
        vec![
            Pair::vertices(b2, [All, None, None]),
            Pair::vertices(c2, [None, All, None]),
            Pair::vertices(d2, [None, None, All]),
            Pair::vertex_edge([b2, b_on_p, pp, spp], |[c, b]| [b, c, None]),
            Pair::vertex_edge([c2, c_on_last, last2, s_last2], |[d, c]| [None, c, d]),
            Pair::vertex_edge([b2, b_on_q, qq, sqq], |[d, b]| [b, None, d]),
            self.inside([pp, pq, qq, px, qx]),
        ]
    }

    fn f(&self) -> &Poly {
        &self.f
    }

    /// From A to B, C and D.
    fn polygon(&self) -> Polygon {
        let Face { p, q, x, scale, .. } = self;
        let to = |way: &Vector| sub(&times(way, scale), x);
        Polygon {
            corners: vec![neg(x), to(p), to(q)],
            edges: vec![p.clone(), sub(q, p), neg(q)],
        }
    }

    /// The point of the face that is nearest to the vertex is a single one.
    fn overlap(&self, _time: &Time) -> Option<(Place<3>, Option<Place<3>>)> {
        None
    }

    fn flags(&self, time: &Time) -> Flags {
        let Face { p, q, n, n2, .. } = self;
        if time.sign_of(n2).is_ne() {
            return Flags::default();
        }
        let is_point = [p, q].iter().all(|x| time.sign_of(&dot(x, x)).is_eq());
        let is_always_point = is_zero(p) && is_zero(q);
        Flags {
            temporarily_parallel: !is_point && !is_zero(n),
            temporarily_point: is_point && !is_always_point,
        }
    }
}

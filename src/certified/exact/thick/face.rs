//! A vertex A and a face BCD: `P = C - B`, `Q = D - B`, `X = A - B`, `N = P x Q`, `f = X . N`.

use super::pair::{Pair, Place, Share};
use super::vector::{Vector, cross, dot, is_zero, sub};
use super::{Poly, Sides, Time};
use crate::contact::Flags;

pub(super) struct Face {
    p: Vector,
    q: Vector,
    x: Vector,
    n: Vector,
    n2: Poly,
    f: Poly,
}

impl Face {
    pub(super) fn new([a, b, c, d]: &[Vector; 4]) -> Self {
        let (p, q, x) = (sub(c, b), sub(d, b), sub(a, b));
        let n = cross(&p, &q);
        Face {
            n2: dot(&n, &n),
            f: dot(&x, &n),
            p,
            q,
            x,
            n,
        }
    }

    /// The foot of the vertex in the plane has the weights `c = (X x Q) . N` and `d = (P x X) . N`
    /// over `N . N`: with `h` the height, `X - h N = c P + d Q`, crossed with `Q` or `P` and
    /// multiplied by `N`.
    fn inside(&self) -> Pair<3> {
        let Face { p, q, x, n, n2, f } = self;
        let (c, d) = (dot(&cross(x, q), n), dot(&cross(p, x), n));
        let b = Poly::difference(&Poly::difference(n2, &c), &d);
        let inside = vec![b, c, d];
        let quotient = |n: &Poly| Share::Quotient(n.clone(), n2.clone());
        let place = [0, 1, 2].map(|i: usize| quotient(&inside[i]));
        Pair::insides(f, n2, inside, place)
    }
}

impl Sides<3> for Face {
    fn pairs(&self) -> Vec<Pair<3>> {
        use Share::{All, None};
        let to_b = &sub(&Default::default(), &self.x);
        let (to_c, to_d) = (&sub(&self.p, &self.x), &sub(&self.q, &self.x));
        vec![
            Pair::vertices(to_b, [All, None, None]),
            Pair::vertices(to_c, [None, All, None]),
            Pair::vertices(to_d, [None, None, All]),
            Pair::vertex_edge(to_b, to_c, |[c, b]| [b, c, None]),
            Pair::vertex_edge(to_c, to_d, |[d, c]| [None, c, d]),
            Pair::vertex_edge(to_b, to_d, |[d, b]| [b, None, d]),
            self.inside(),
        ]
    }

    fn f(&self) -> &Poly {
        &self.f
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

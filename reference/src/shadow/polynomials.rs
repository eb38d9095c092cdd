//! The polynomials of a pair of edges, for what is said about a contact once it is found.
//!
//! This and [`configuration`](super::configuration) and [`kind`](super::kind) are no algorithms of
//! the thesis: those say whether and when, not where and how.

use crate::field::Integer;
use crate::poly::Poly;

use super::motion::Motion;
use super::vector::{cross, difference, dot};

/// The four points and the differences between them, as polynomials in `t`.
#[derive(Clone, Debug)]
pub(super) struct Polynomials<Z> {
    /// A, B, C, D.
    pub(super) points: [[Poly<Z>; 3]; 4],
    /// `K = B - A`.
    pub(super) k: [Poly<Z>; 3],
    /// `L = D - C`.
    pub(super) l: [Poly<Z>; 3],
    /// `M = C - A`.
    pub(super) m: [Poly<Z>; 3],
    /// `N = K x L`.
    pub(super) n: [Poly<Z>; 3],
    /// `f = N . M`, whose sign is the side on which the edges are.
    pub(super) f: Poly<Z>,
}

impl<Z: Integer> Polynomials<Z> {
    /// The polynomials of four moving points.
    pub(super) fn new(points: &[Motion<Z>; 4]) -> Self {
        let points @ [a, b, c, d] = &points.each_ref().map(Motion::polys);
        let (k, l, m) = (difference(b, a), difference(d, c), difference(c, a));
        let n = cross(&k, &l);
        let f = dot(&n, &m);
        Polynomials {
            points: points.clone(),
            k,
            l,
            m,
            n,
            f,
        }
    }

    /// The ends of both edges, each with the ends of the other edge.
    pub(super) fn ends(&self) -> [[&[Poly<Z>; 3]; 3]; 4] {
        let [a, b, c, d] = self.points.each_ref();
        [[a, c, d], [b, c, d], [c, a, b], [d, a, b]]
    }

    /// Whether all four points are on one line at all times.
    pub(super) fn are_collinear(&self) -> bool {
        let Polynomials { k, l, m, n, .. } = self;
        is_zero(n) && is_zero(&cross(k, m)) && is_zero(&cross(l, m))
    }
}

/// Whether a vector is 0 at all times.
pub(super) fn is_zero<Z: Integer>(vector: &[Poly<Z>; 3]) -> bool {
    vector.iter().all(Poly::is_zero)
}

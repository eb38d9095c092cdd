//! Two edges at one time: where they touch, and what is special about them then.

use std::cmp::Ordering;

use tunnelproof::contact::Flags;

use crate::algebraic::Algebraic;
use crate::answer::{Enclosure, Parameters};
use crate::field::Integer;
use crate::poly::Poly;

use super::polynomials::{Polynomials, is_zero};
use super::vector::{cross, difference, dot};

/// A pair of edges at a time.
pub(super) struct Configuration<'a, Z> {
    pair: &'a Polynomials<Z>,
    at: &'a Algebraic<Z>,
    /// `K = 0`.
    first_is_point: bool,
    /// `L = 0`.
    second_is_point: bool,
    /// `K x L = 0`.
    parallel: bool,
}

/// The overlap of two edges on a common line, along AB.
struct Overlap<Z> {
    /// `K . K`: B on a scale on which A is 0.
    b: Poly<Z>,
    /// The end of CD that comes first in the direction of AB, on that scale, and its `v`.
    low: (Poly<Z>, f64),
    /// The other end of CD.
    high: (Poly<Z>, f64),
}

impl<'a, Z: Integer> Configuration<'a, Z> {
    /// The pair at the time `at`.
    pub(super) fn new(pair: &'a Polynomials<Z>, at: &'a Algebraic<Z>) -> Self {
        Configuration {
            first_is_point: vanishes(&pair.k, at),
            second_is_point: vanishes(&pair.l, at),
            parallel: vanishes(&pair.n, at),
            pair,
            at,
        }
    }

    /// What is so at this time but not for the whole step.
    pub(super) fn flags(&self) -> Flags {
        let Polynomials { k, l, n, .. } = self.pair;
        let any_point = self.first_is_point || self.second_is_point;
        Flags {
            temporarily_parallel: self.parallel && !any_point && !is_zero(n),
            temporarily_point: (self.first_is_point && !is_zero(k))
                || (self.second_is_point && !is_zero(l)),
        }
    }

    /// The parameters of the contact, and of the other end of an overlap in more than a point.
    ///
    /// If the edges do not touch, which only the text as published takes for contact, the
    /// parameters are those of closest points of the lines, each cut to `[0, 1]`.
    pub(super) fn contact(&self) -> (Parameters, Option<Parameters>) {
        let Polynomials { k, l, m, n, .. } = self.pair;
        let zero = Enclosure::exactly(0.0);
        let one_point = |u, v| (Parameters { u, v }, None);
        match (self.first_is_point, self.second_is_point) {
            (true, true) => one_point(zero, zero),
            (true, false) => one_point(zero, self.fraction(&dot(m, l).neg(), &dot(l, l))),
            (false, true) => one_point(self.fraction(&dot(m, k), &dot(k, k)), zero),
            (false, false) if self.parallel => self.overlap_ends(),
            (false, false) => {
                let n2 = dot(n, n);
                let [u, v] = self.crossing_numerators();
                one_point(self.fraction(&u, &n2), self.fraction(&v, &n2))
            }
        }
    }

    /// Whether the lines, which have a common plane at this time, meet at an angle in a point that
    /// is interior to both edges.
    pub(super) fn cut_inside_both(&self) -> bool {
        let n2 = dot(&self.pair.n, &self.pair.n);
        let inside = |x: &Poly<Z>| self.sign(x).is_gt() && self.sign(&x.sub(&n2)).is_lt();
        !self.parallel && self.crossing_numerators().iter().all(inside)
    }

    /// Whether `x` is on the segment `yz` and neither `y` nor `z`.
    pub(super) fn is_strictly_between(
        &self,
        x: &[Poly<Z>; 3],
        y: &[Poly<Z>; 3],
        z: &[Poly<Z>; 3],
    ) -> bool {
        let (to_y, to_z) = (difference(y, x), difference(z, x));
        self.sign(&dot(&to_y, &to_z)).is_lt() && vanishes(&cross(&to_y, &to_z), self.at)
    }

    /// Whether the edges are on one line and share more than a point.
    pub(super) fn overlaps_in_more_than_a_point(&self) -> bool {
        let Polynomials { k, m, .. } = self.pair;
        self.parallel
            && !self.first_is_point
            && !self.second_is_point
            && vanishes(&cross(k, m), self.at)
            && !self.is_one_point(&self.overlap())
    }

    /// `U` and `W` with `u = U / n2` and `v = W / n2` where the lines are not parallel.
    fn crossing_numerators(&self) -> [Poly<Z>; 2] {
        let Polynomials { k, l, m, n, .. } = self.pair;
        // A + u K = C + v L: the cross product with L gives u, the one with K gives v.
        [dot(&cross(m, l), n), dot(&cross(m, k), n)]
    }

    /// The overlap of edges on a common line, neither of them a point.
    fn overlap(&self) -> Overlap<Z> {
        let Polynomials { k, l, m, .. } = self.pair;
        let (along, c) = (dot(l, k), dot(m, k));
        let (c, d) = ((c.clone(), 0.0), (c.add(&along), 1.0));
        let (low, high) = if self.sign(&along).is_lt() {
            (d, c)
        } else {
            (c, d)
        };
        Overlap {
            b: dot(k, k),
            low,
            high,
        }
    }

    fn is_one_point(&self, Overlap { b, low, high }: &Overlap<Z>) -> bool {
        self.sign(&low.0.sub(b)).is_ge() || self.sign(&high.0).is_le()
    }

    fn overlap_ends(&self) -> (Parameters, Option<Parameters>) {
        let Polynomials { k, l, m, .. } = self.pair;
        let overlap = self.overlap();
        let of_end_of_cd = |(position, v): &(Poly<Z>, f64)| Parameters {
            u: self.fraction(position, &overlap.b),
            v: Enclosure::exactly(*v),
        };
        let of_end_of_ab = |u: f64, from_c: &[Poly<Z>; 3]| Parameters {
            u: Enclosure::exactly(u),
            v: self.fraction(&dot(from_c, l), &dot(l, l)),
        };
        let first = if self.sign(&overlap.low.0).is_gt() {
            of_end_of_cd(&overlap.low)
        } else {
            of_end_of_ab(0.0, &m.each_ref().map(Poly::neg))
        };
        if self.is_one_point(&overlap) {
            return (first, None);
        }
        let second = if self.sign(&overlap.high.0.sub(&overlap.b)).is_lt() {
            of_end_of_cd(&overlap.high)
        } else {
            of_end_of_ab(1.0, &difference(k, m))
        };
        (first, Some(second))
    }

    /// `numerator / denominator`, cut to `[0, 1]`; the denominator is above 0.
    fn fraction(&self, numerator: &Poly<Z>, denominator: &Poly<Z>) -> Enclosure {
        if self.sign(numerator).is_le() {
            Enclosure::exactly(0.0)
        } else if self.sign(&numerator.sub(denominator)).is_ge() {
            Enclosure::exactly(1.0)
        } else {
            self.at.enclose_quotient(numerator, denominator)
        }
    }

    fn sign(&self, poly: &Poly<Z>) -> Ordering {
        self.at.sign_of(poly)
    }
}

/// Whether a vector is 0 at a time.
pub(super) fn vanishes<Z: Integer>(vector: &[Poly<Z>; 3], at: &Algebraic<Z>) -> bool {
    vector.iter().all(|x| at.sign_of(x).is_eq())
}

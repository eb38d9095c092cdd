//! Crossing or graze, as [`answer`](crate::answer) defines them.
//!
//! Not an algorithm of the thesis.

use std::cmp::Ordering;

use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::{Integer, OrderedField};
use crate::poly::Poly;

use super::configuration::{Configuration, vanishes};
use super::motion::Motion;
use super::parallel::{moving_point_point_intersection, static_colinear_overlap};
use super::polynomials::{Polynomials, is_zero};
use super::vector::{cross, difference};

/// The space that the motion is confined to, which decides what a crossing is.
enum Confinement<Z> {
    /// `f` is not identically 0.
    Space,
    /// The four points share a plane for the whole step. Holds, for the four ends `X` of one edge
    /// and the other edge `YZ`, `G = (Y - X) x (Z - X)`.
    Plane(Box<[[Poly<Z>; 3]; 4]>),
    /// The four points share a line for the whole step. Holds the times in `(0, 1)`, ascending,
    /// from which on the edges touch.
    Line(Vec<Algebraic<Z>>),
}

/// The crossings of one step.
pub(super) struct Crossings<'a, Z> {
    pair: &'a Polynomials<Z>,
    confinement: Confinement<Z>,
}

impl<'a, Z: Integer> Crossings<'a, Z> {
    /// The crossings of four moving points with these polynomials.
    pub(super) fn new(points: &[Motion<Z>; 4], pair: &'a Polynomials<Z>) -> Self {
        let confinement = if !pair.f.is_zero() {
            Confinement::Space
        } else if pair.are_collinear() {
            Confinement::Line(beginnings(points))
        } else {
            let g = |[x, y, z]: [&[Poly<Z>; 3]; 3]| cross(&difference(y, x), &difference(z, x));
            Confinement::Plane(Box::new(pair.ends().map(g)))
        };
        Crossings { pair, confinement }
    }

    /// Whether there is a crossing at the time `s`, a root of `f`.
    pub(super) fn is_crossing(&self, s: &Algebraic<Z>) -> bool {
        if !is_inside_step(s) {
            return false;
        }
        let edges = || Configuration::new(self.pair, s);
        match &self.confinement {
            Confinement::Space => {
                let (before, after) = signs_around_root(&self.pair.f, s);
                before != after && edges().cut_inside_both()
            }
            Confinement::Plane(g) => {
                self.pair
                    .ends()
                    .into_iter()
                    .zip(g.iter())
                    .any(|([x, y, z], g)| {
                        reverses(g, s)
                            && (edges().is_strictly_between(x, y, z)
                                || edges().overlaps_in_more_than_a_point())
                    })
            }
            Confinement::Line(beginnings) => beginnings.iter().any(|t| t.compare(s).is_eq()),
        }
    }

    /// Whether there is a crossing at any time of the step.
    pub(super) fn any(&self) -> bool {
        match &self.confinement {
            Confinement::Space => isolate_roots(&self.pair.f)
                .iter()
                .any(|s| self.is_crossing(s)),
            Confinement::Plane(g) => g
                .iter()
                .filter_map(|g| g.iter().find(|component| !component.is_zero()))
                .any(|g| isolate_roots(g).iter().any(|s| self.is_crossing(s))),
            Confinement::Line(beginnings) => !beginnings.is_empty(),
        }
    }
}

/// The signs of `poly` just before and just after its root `s`, both `Equal` only for the zero
/// polynomial.
///
/// The first derivative that is not 0 at `s` has the sign after `s`, and the one before it if its
/// order is even.
pub(super) fn signs_around_root<Z: Integer>(
    poly: &Poly<Z>,
    s: &Algebraic<Z>,
) -> (Ordering, Ordering) {
    let mut derivative = poly.derivative();
    let mut is_even = false;
    while !derivative.is_zero() {
        let after = s.sign_of(&derivative);
        if after.is_ne() {
            let before = if is_even { after } else { after.reverse() };
            return (before, after);
        }
        derivative = derivative.derivative();
        is_even = !is_even;
    }
    (Ordering::Equal, Ordering::Equal)
}

/// Whether a vector of degree at most 2 that is not always 0 has a root of odd multiplicity at `s`:
/// it is 0 there, and its derivative is not.
fn reverses<Z: Integer>(g: &[Poly<Z>; 3], s: &Algebraic<Z>) -> bool {
    !is_zero(g) && vanishes(g, s) && !vanishes(&g.each_ref().map(Poly::derivative), s)
}

/// Whether `0 < s < 1`.
fn is_inside_step<Z: Integer>(s: &Algebraic<Z>) -> bool {
    let from_one = Poly::new(vec![Z::from_i64(-1), Z::one()]);
    !s.is_zero() && s.sign_of(&from_one).is_lt()
}

/// The times in `(0, 1)`, ascending, from which on edges that stay on one line touch, and before
/// which, for a while, they do not.
///
/// Edges on a line begin and cease to touch only where two of their ends meet, so they touch always
/// or never between two such times that follow each other.
fn beginnings<Z: Integer>(points: &[Motion<Z>; 4]) -> Vec<Algebraic<Z>> {
    let [a, b, c, d] = points;
    let (zero, one) = (Z::Ratio::from_i64(0), Z::Ratio::from_i64(1));
    let mut times: Vec<Z::Ratio> = [(a, c), (a, d), (b, c), (b, d)]
        .into_iter()
        .filter_map(|(x, y)| moving_point_point_intersection(x, y))
        .chain([zero.clone()])
        .collect();
    times.sort();
    times.dedup();
    let touch = |t: &Z::Ratio| {
        let [a, b, c, d] = points.each_ref().map(|point| point.at_ratio(t));
        static_colinear_overlap(&a, &b, &c, &d)
    };
    let begins = |pair: &&[Z::Ratio]| {
        let middle = (pair[0].clone() + pair[1].clone()) / Z::Ratio::from_i64(2);
        pair[1] < one && touch(&pair[1]) && !touch(&middle)
    };
    times
        .windows(2)
        .filter(begins)
        .map(|pair| Algebraic::ratio(&pair[1]))
        .collect()
}

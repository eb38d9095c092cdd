//! The direction of the shortest vector between two sides at their first contact, or in the limit
//! just before it.
//!
//! The differences of the second side's points and the first side's are a convex polygon: a
//! parallelogram for two edges, a triangle for a vertex and a face. Each corner moves linearly. The
//! shortest vector `w` is the polygon's point nearest to the origin: the only one with `w . (x - w)
//! >= 0` for every point `x` of the polygon. With `P` and `Q` the edges from a corner `p`, every
//! point is `p + a P + b Q` with `a, b >= 0`, so that
//!
//! - the corner itself is nearest where `p . P >= 0` and `p . Q >= 0`;
//! - `v / P . P` on the edge `P` is nearest, with `q = p + P` and `v = (P . P) p - (p . P) P`,
//!   where `P . P > 0`, `p . P <= 0 <= q . P` and `v . Q >= 0`;
//! - if that is so of no corner and no edge, the nearest point is inside a polygon with an area,
//!   and its direction is that of `P x Q` with the sign of `p . (P x Q)`.
//!
//! None of it depends on how long `P` and `Q` are. At a time these are signs of polynomials. Just
//! before it they are those of the first derivative that is not 0, reversed if its order is odd; and
//! so is the limit of the direction of a vector of polynomials.
//!
//! Of a body that turns, all vectors are in its frame, and times something above 0. What turns them
//! into space is applied to the result, after any derivatives: a product with a matrix that is
//! nowhere 0 has its first derivative that is not 0 where the vector has, and it is the matrix times
//! that of the vector.

use std::cmp::Ordering;

use super::vector::{Vector, cross, dot, is_zero, neg, sub};
use super::{Edges, Face, Poly, Reach, Roots, Sides, Time, first_root, integers, side};
use crate::certified::exact::bracket::Bracket;
use crate::certified::exact::dyadic::Dyadic;
use crate::certified::exact::integer::{Integer, scale};
use crate::certified::motion::{self, Positions};

/// The direction of the shortest vector from AB to CD, within 2^-50 in Euclidean distance, for a
/// first contact whose neighbours in `f64` are `toi`.
///
/// `None` if they touch at the start.
pub(in crate::certified) fn normal_of_edges_exactly(
    positions: &Positions,
    radii: [f64; 2],
    toi: [f64; 2],
) -> Option<motion::Vector> {
    let (points, reach) = integers(positions, radii);
    normal(&Edges::new(&points), &reach, toi, |way| way)
}

/// The direction of `(B - A) x (D - C)` at the start, within 2^-50; `None` if that is 0.
pub(in crate::certified) fn perpendicular_of_edges(
    positions: &Positions,
) -> Option<motion::Vector> {
    let (points, _) = integers(positions, [0.0; 2]);
    let [a, b, c, d] = &points;
    let normal = cross(&sub(b, a), &sub(d, c));
    let time = Time::At(Dyadic::zero());
    let is_parallel = normal.iter().all(|x| time.sign_of(x).is_eq());
    (!is_parallel).then(|| direction(&normal, &time))
}

/// The same from a vertex A to a face BCD.
pub(in crate::certified) fn normal_of_face_exactly(
    positions: &Positions,
    radii: [f64; 2],
    toi: [f64; 2],
) -> Option<motion::Vector> {
    let (points, reach) = integers(positions, radii);
    normal(&Face::new(&points), &reach, toi, |way| way)
}

/// The same of two edges that are given in a frame of their own, from which `into_space` turns
/// vectors, times anything above 0.
pub(in crate::certified::exact) fn normal_of_near_edges(
    edges: &Edges,
    reach: &Reach,
    toi: [f64; 2],
    into_space: impl Fn(Vector) -> Vector,
) -> Option<motion::Vector> {
    normal(edges, reach, toi, into_space)
}

/// The same of a vertex and a face.
pub(in crate::certified::exact) fn normal_of_near_face(
    face: &Face,
    reach: &Reach,
    toi: [f64; 2],
    into_space: impl Fn(Vector) -> Vector,
) -> Option<motion::Vector> {
    normal(face, reach, toi, into_space)
}

fn normal<const W: usize>(
    sides: &impl Sides<W>,
    reach: &Reach,
    toi: [f64; 2],
    into_space: impl Fn(Vector) -> Vector,
) -> Option<motion::Vector> {
    let is_limit = reach.square.is_zero();
    let polygon = sides.polygon();
    let way = |time: &Time| {
        let way = match is_limit {
            true => polygon.way_just_before(time),
            false => polygon.way_at(time),
        };
        way.map(|way| direction(&into_space(way), time))
    };
    let [below, above] = toi;
    match below == above {
        true if is_limit && below == 0.0 => None,
        true => way(&Time::At(Dyadic::from_f64(below))),
        false => with_time(sides, reach, toi, way),
    }
}

/// What `of` says of the time of the first contact, which is strictly between two neighbours in
/// `f64`.
fn with_time<const W: usize, T>(
    sides: &impl Sides<W>,
    reach: &Reach,
    [below, above]: [f64; 2],
    of: impl Fn(&Time) -> Option<T>,
) -> Option<T> {
    let [low, high] = [below, above].map(Dyadic::from_f64);
    // Contact without radius is at a root of f. Mostly there is one between the neighbours.
    if reach.square.is_zero() && !sides.f().is_zero() {
        let roots = Roots::new(sides.f().clone());
        let mut here = roots.times().filter(|(_, toi)| *toi == [below, above]);
        if let (Some((time, _)), None) = (here.next(), here.next()) {
            return of(&time);
        }
    }
    let pairs = sides.pairs();
    let roots = pairs.iter().map(|pair| {
        let excess = pair.excess(reach);
        let here = Bracket::new(&excess, low.clone(), high.clone(), Ordering::Equal);
        // Where it has one sign there, its roots are of no use.
        match here.plain_sign_of(&excess) {
            Some(_) => Roots::new(Poly::default()),
            None => Roots::new(excess),
        }
    });
    let roots: Vec<_> = roots.collect();
    first_root(&pairs, &roots).and_then(|(time, _)| of(&time))
}

/// The differences of two sides, as a convex polygon.
pub(super) struct Polygon {
    pub(super) corners: Vec<Vector>,
    /// From each corner to the next one, the last one's to the first, times anything above 0.
    pub(super) edges: Vec<Vector>,
}

impl Polygon {
    /// A multiple of the shortest vector at a time at which the sides are apart, by a factor that is
    /// above 0; `None` if they are not.
    fn way_at(&self, time: &Time) -> Option<Vector> {
        let way = self.nearest(|poly| time.sign_of(poly))?;
        let is_apart = way.iter().any(|x| time.sign_of(x).is_ne());
        is_apart.then_some(way)
    }

    /// A vector, not 0 at a time, with the direction to which that of the shortest vector tends
    /// before it. Just before the time the sides are apart.
    fn way_just_before(&self, time: &Time) -> Option<Vector> {
        let mut way = self.nearest(|poly| side(poly, time, [1.0; 2]).cmp(&0))?;
        // Ends: each derivative has a lower degree, and the last one is 0.
        while way.iter().all(|x| time.sign_of(x).is_eq()) {
            if is_zero(&way) {
                return None;
            }
            way = neg(&way.each_ref().map(Poly::derivative));
        }
        Some(way)
    }

    /// A multiple of the point that is nearest to the origin, by a factor that is above 0, where
    /// polynomials have the signs that `sign` tells; `None` if the origin is inside the polygon.
    fn nearest(&self, sign: impl Fn(&Poly) -> Ordering) -> Option<Vector> {
        let n = self.corners.len();
        // A corner, the next one, the edge between both, and the one to the last corner.
        let around = |i: usize| {
            let (p, q) = (&self.corners[i], &self.corners[(i + 1) % n]);
            let inward = neg(&self.edges[(i + n - 1) % n]);
            (p, q, &self.edges[i], inward)
        };
        for i in 0..n {
            let (p, _, to_next, to_last) = around(i);
            if sign(&dot(p, to_next)).is_ge() && sign(&dot(p, &to_last)).is_ge() {
                return Some(p.clone());
            }
        }
        for i in 0..n {
            let (p, q, edge, inward) = around(i);
            let (square, along) = (dot(edge, edge), dot(p, edge));
            if sign(&along).is_le() && sign(&dot(q, edge)).is_ge() && sign(&square).is_gt() {
                let way = [0, 1, 2].map(|h: usize| {
                    let own = Poly::product(&square, &p[h]);
                    Poly::difference(&own, &Poly::product(&along, &edge[h]))
                });
                if sign(&dot(&way, &inward)).is_ge() {
                    return Some(way);
                }
            }
        }
        let (p, _, edge, inward) = around(0);
        let mut normal = cross(edge, &inward);
        match sign(&dot(p, &normal)) {
            Ordering::Equal => return None,
            Ordering::Greater => {}
            Ordering::Less => normal.iter_mut().for_each(Poly::negate),
        }
        Some(normal)
    }
}

/// The direction of a vector that is not 0 at a time, with an error below `2^-50`.
///
/// With `e = 2^-53`: the components are off by `(1 + 2^-10) e` of themselves, for they are rounded
/// once, and by 2^-60 of the largest, for the time; the length computed from them by `3 e`, its
/// quotients by `e`: together by less than `6 e` of the length.
fn direction(vector: &Vector, time: &Time) -> motion::Vector {
    let values = match time {
        Time::At(at) => values_at(vector, at),
        Time::Between(bracket) => {
            let mut bracket = bracket.clone();
            // Ends: integers tell that some component is not 0 at the root, and each turn narrows
            // the bracket.
            loop {
                if let Some(values) = values_in(vector, &bracket) {
                    break values;
                }
                if let Some(at) = bracket.refine() {
                    break values_at(vector, &at);
                }
            }
        }
    };
    let largest = values.iter().map(Integer::bits).max().unwrap_or(0) as i64;
    let values = values.each_ref().map(|value| {
        let (mantissa, exponent) = value.approximate();
        scale(mantissa, exponent - largest)
    });
    let length = motion::dot(&values, &values).sqrt();
    values.map(|x| x / length)
}

/// The components of a vector, times one number above 0.
fn values_at(vector: &Vector, at: &Dyadic) -> [Integer; 3] {
    let degree = degree(vector);
    vector.each_ref().map(|x| x.evaluate_as(degree, at))
}

/// The same in a bracket, if the largest varies in it by less than 2^-60 of itself and no other by
/// more than that.
fn values_in(vector: &Vector, bracket: &Bracket<0>) -> Option<[Integer; 3]> {
    let degree = degree(vector).max(1);
    let ranges = vector.each_ref().map(|x| bracket.range(x, degree));
    let largest = ranges.iter().map(|(value, _)| value.bits()).max()?;
    let variation = ranges.iter().map(|(_, variation)| variation.bits()).max()?;
    // The largest is at least 2^(largest - 1), each variation below 2^variation.
    (variation == 0 || variation + 61 <= largest).then(|| ranges.map(|(value, _)| value))
}

fn degree(vector: &Vector) -> usize {
    vector.iter().map(Poly::degree).max().unwrap_or(0)
}

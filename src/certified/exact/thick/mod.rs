//! Contact at a distance: when two edges, or a vertex and a face, first come within a radius of
//! each other, decided in integers.
//!
//! The distance of two convex sets is that of two features, vertices, edges or a face without what
//! bounds them, which hold the nearest points; there these are the nearest points of what the
//! features span: of points, lines and planes. So with the features' squared distance `p / q` and
//! the conditions `i` that the nearest points are inside them ([`pair`], from [`edges`] and
//! [`face`])
//!
//! ```text
//! contact(t)  <=>  for some two features  q > 0,  all i >= 0,  p <= R^2 q
//! ```
//!
//! Let the first contact be at `s > 0`, and take the features with the fewest points that hold the
//! nearest points there. Their `p - R^2 q` is 0 at `s`; not for all `t`, or they would be in
//! contact shortly before too, their nearest points still inside. So the first contact is at 0 or
//! at a root of one of these polynomials ([`roots`]), of degree 2, 4 or 6.
//!
//! The radius is an integer, in a unit of its own, and so never rounded. Here all integers are of
//! any size: what `f64` leaves open is little.

mod at_rest;
mod edges;
mod face;
mod normal;
mod pair;
mod parallel;
mod roots;
pub(super) mod vector;

use std::cmp::Ordering;

use super::PLACE_ERROR;
use super::algebraic_time::AlgebraicTime;
use super::coordinates::{self, Point, in_unit, radius_in_unit, sub, unit};
use super::integer::Integer;
use super::passage::{Passage, passage_of_edges};
use super::poly;
use crate::certified::motion::Positions;
use crate::contact::{EdgePlace, EdgePoint, FacePlace, Flags, Hit};
use crate::query::Radius;
use at_rest::AtRest;
pub(super) use edges::Edges;
pub(super) use face::Face;
use normal::Polygon;
pub(in crate::certified) use normal::{
    normal_of_edges_exactly, normal_of_face_exactly, perpendicular_of_edges,
};
pub(super) use normal::{normal_of_near_edges, normal_of_near_face};
use pair::Pair;
pub(super) use pair::{Place, Share};
pub(in crate::certified) use parallel::{
    are_always_parallel, contact_of_parallel_edges, near_start_of_parallel_edges,
};
pub(super) use roots::Roots;
use vector::Vector;

use super::dyadic::Dyadic;

/// Polynomials of any degree, on the heap: these move a lot.
pub(super) type Poly = poly::Poly<0>;

/// Times at which such a polynomial is 0.
pub(super) type Time<'a> = AlgebraicTime<'a, 0>;

/// The first contact at a distance. A place has `W` numbers: `u` and `v`, or the weights of B, C
/// and D.
struct Approach<const W: usize> {
    /// The neighbours in `f64` of the time of impact.
    toi: [f64; 2],
    /// The sign of `f` just before it; 0 at the start.
    side: i8,
    /// The nearest points; each number is within [`PLACE_ERROR`].
    first: [f64; W],
    /// The other end of the part along which parallel edges are nearest.
    second: Option<[f64; W]>,
    flags: Flags,
}

impl<const W: usize> Approach<W> {
    /// At the start, with the flags where `N` is 0.
    fn at_start(first: [f64; W], second: Option<[f64; W]>, flags: Option<Flags>) -> Self {
        Approach {
            toi: [0.0; 2],
            side: 0,
            first,
            second,
            flags: flags.unwrap_or_default(),
        }
    }

    /// The contact of two sides that pass each other like this without their radius.
    fn hit<P>(self, Passage { case, kind }: Passage, place: P) -> Hit<P> {
        let [toi, toi_above] = self.toi;
        Hit {
            toi,
            toi_above,
            kind,
            side: self.side,
            case,
            flags: self.flags,
            place,
        }
    }
}

/// The first contact of two edges at most a radius apart.
pub(in crate::certified) fn decide_thick_edges(
    positions: &Positions,
    radius: Radius,
) -> Option<Hit<EdgePlace>> {
    let passage = || passage_of_edges(positions);
    let at_start = AtRest::edges(&positions.start, radius.parts());
    let nearest = at_start.nearest_of_edges()?;
    if at_start.compare(&nearest).is_gt() {
        let (points, reach) = integers(positions, radius.parts());
        return decide_near_edges(&Edges::new(&points), &reach, passage);
    }
    let (first, second) = at_start
        .overlap_of_edges()
        .unwrap_or((nearest.values(), None));
    let flags = || Edges::new(&moving_integers(positions).0).flags(&Time::At(Dyadic::zero()));
    let approach = Approach::at_start(first, second, at_start.is_flat().then(flags));
    Some(edge_hit(approach, passage()))
}

/// The same of a vertex A and a face BCD, of which it is known how they pass each other.
pub(in crate::certified) fn decide_thick_face(
    positions: &Positions,
    radius: Radius,
    passage: impl FnOnce() -> Passage,
) -> Option<Hit<FacePlace>> {
    let at_start = AtRest::face(&positions.start, radius.parts());
    let nearest = at_start.nearest_of_face()?;
    if at_start.compare(&nearest).is_gt() {
        let (points, reach) = integers(positions, radius.parts());
        return decide_near_face(&Face::new(&points), &reach, passage);
    }
    let flags = || Face::new(&moving_integers(positions).0).flags(&Time::At(Dyadic::zero()));
    let approach = Approach::at_start(nearest.values(), None, at_start.is_flat().then(flags));
    Some(face_hit(approach, passage()))
}

/// The first contact of two edges, of which it is known how they pass each other.
pub(super) fn decide_near_edges(
    edges: &Edges,
    reach: &Reach,
    passage: impl FnOnce() -> Passage,
) -> Option<Hit<EdgePlace>> {
    Some(edge_hit(first_approach(edges, reach)?, passage()))
}

fn edge_hit(approach: Approach<2>, passage: Passage) -> Hit<EdgePlace> {
    let point = |[u, v]: [f64; 2]| EdgePoint { u, v };
    let place = EdgePlace {
        first: point(approach.first),
        second: approach.second.map(point),
        error: PLACE_ERROR,
    };
    approach.hit(passage, place)
}

/// The same of a vertex and a face.
pub(super) fn decide_near_face(
    face: &Face,
    reach: &Reach,
    passage: impl FnOnce() -> Passage,
) -> Option<Hit<FacePlace>> {
    Some(face_hit(first_approach(face, reach)?, passage()))
}

fn face_hit(approach: Approach<3>, passage: Passage) -> Hit<FacePlace> {
    let place = FacePlace {
        weights: approach.first,
        error: PLACE_ERROR,
    };
    approach.hit(passage, place)
}

/// Two sides that may come near each other.
trait Sides<const W: usize> {
    /// The pairs of features, those with fewer points first; vertices always hold.
    fn pairs(&self) -> Vec<Pair<W>>;

    /// Six times the volume of the four points.
    fn f(&self) -> &Poly;

    /// All differences of a point of the second side and one of the first.
    fn polygon(&self) -> Polygon;

    /// The ends of the part along which two sides are nearest, if that is more than a point or they
    /// are parallel.
    fn overlap(&self, time: &Time) -> Option<(Place<W>, Option<Place<W>>)>;

    /// The configuration at a time.
    fn flags(&self, time: &Time) -> Flags;
}

/// The square of the radius: `square 2^shift` in the unit of the coordinates, squared.
///
/// The radius has a unit of its own: it may be so small that the coordinates in its unit would be
/// hundreds of times as long. The square is a constant, but where the unit of the coordinates
/// changes, as in the frame of a body that turns.
pub(super) struct Reach {
    square: Poly,
    shift: i64,
}

impl Reach {
    /// The radius where the coordinates are in multiples of `2^unit / scale`.
    pub(super) fn new(radii: [f64; 2], unit: i32, scale: &Poly) -> Self {
        let own = coordinates::unit(radii.iter());
        let sum = Poly::new(&[radius_in_unit(radii, own)]);
        let radius = Poly::product(&sum, scale);
        Reach {
            square: Poly::product(&radius, &radius),
            shift: 2 * i64::from(own - unit),
        }
    }
}

/// The positions at the start and their changes, and the radius.
fn integers(positions: &Positions, radii: [f64; 2]) -> ([Vector; 4], Reach) {
    let (points, unit) = moving_integers(positions);
    (points, Reach::new(radii, unit, &vector::one()))
}

/// The positions at the start and their changes, in multiples of 2 to a power.
fn moving_integers(Positions { start, end }: &Positions) -> ([Vector; 4], i32) {
    let [[a, b, c, d], [e, f, g, h]] = [*start, *end];
    let points = [a, b, c, d, e, f, g, h];
    let own = unit(points.iter().flatten());
    let points = in_unit(&points, own);
    let (start, end) = points.split_at(4);
    let moving = |i: usize| -> Vector {
        let change: Point = sub(&end[i], &start[i]);
        [0, 1, 2].map(|axis: usize| Poly::new(&[start[i][axis].clone(), change[axis].clone()]))
    };
    ([0, 1, 2, 3].map(moving), own)
}

/// Whether the segments AB and CD are within the sum of two radii of each other.
pub(in crate::certified) fn are_near(points: &[[f64; 3]; 4], radii: [f64; 2]) -> bool {
    let at_rest = AtRest::edges(points, radii);
    let nearest = at_rest.nearest_of_edges();
    nearest.is_some_and(|nearest| at_rest.compare(&nearest).is_le())
}

/// The distance of two edges at a time in `[0, 1]` compared with a radius.
pub(in crate::certified) fn compare_distance_of_edges(
    positions: &Positions,
    radius: Radius,
    time: f64,
) -> Ordering {
    let (points, unit) = positions_at(positions, time);
    let at_time = AtRest::edges_in(&points, unit, radius.parts());
    let nearest = at_time.nearest_of_edges();
    nearest.map_or(Ordering::Greater, |nearest| at_time.compare(&nearest))
}

/// The same of a vertex A and a face BCD.
pub(in crate::certified) fn compare_distance_of_face(
    positions: &Positions,
    radius: Radius,
    time: f64,
) -> Ordering {
    let (points, unit) = positions_at(positions, time);
    let at_time = AtRest::face_in(&points, unit, radius.parts());
    let nearest = at_time.nearest_of_face();
    nearest.map_or(Ordering::Greater, |nearest| at_time.compare(&nearest))
}

/// The positions at a time in `[0, 1]`, in multiples of 2 to a power.
fn positions_at(Positions { start, end }: &Positions, time: f64) -> ([Point; 4], i32) {
    let unit = unit(start.iter().chain(end).flatten());
    let time = Dyadic::from_f64(time);
    let at_time = |from: Point, to: Point| -> Point {
        let change = sub(&to, &from);
        [0, 1, 2].map(|axis: usize| {
            let moved = Integer::product(&change[axis], &time.numerator);
            Integer::sum(&from[axis].shifted(time.exponent), &moved)
        })
    };
    let [[a, b, c, d], [e, f, g, h]] = [in_unit(start, unit), in_unit(end, unit)];
    let points = [at_time(a, e), at_time(b, f), at_time(c, g), at_time(d, h)];
    (points, unit - time.exponent as i32)
}

fn first_approach<const W: usize>(sides: &impl Sides<W>, reach: &Reach) -> Option<Approach<W>> {
    let pairs = sides.pairs();
    let excesses: Vec<Poly> = pairs.iter().map(|pair| pair.excess(reach)).collect();
    let start = Time::At(Dyadic::zero());
    let is_near = |(pair, excess): &(&Pair<W>, &Poly), time: &Time| {
        time.sign_of(excess).is_le() && pair.holds(time)
    };
    let all = || pairs.iter().zip(&excesses);
    let roots: Vec<Roots>;
    let (time, toi) = if all().any(|pair| is_near(&pair, &start)) {
        (start, [0.0; 2])
    } else {
        roots = excesses.iter().cloned().map(Roots::new).collect();
        first_root(&pairs, &roots)?
    };
    let (first, second) = match sides.overlap(&time) {
        Some(overlap) => overlap,
        None if toi[1] == 0.0 => (Pair::nearest_at_start(&pairs)?.place.clone(), None),
        // They are as far apart as the radius, and no feature is nearer.
        None => {
            let (pair, _) = all().find(|pair| is_near(pair, &time))?;
            (pair.place.clone(), None)
        }
    };
    Some(Approach {
        toi,
        side: side(sides.f(), &time, toi),
        first: first.values(&time),
        second: second.map(|place| place.values(&time)),
        flags: sides.flags(&time),
    })
}

/// The first root, with its neighbours in `f64`, at which the nearest points of its pair are
/// inside.
fn first_root<'a, const W: usize>(
    pairs: &[Pair<W>],
    roots: &'a [Roots],
) -> Option<(Time<'a>, [f64; 2])> {
    let mut first: Option<(Time, [f64; 2])> = None;
    for (pair, roots) in pairs.iter().zip(roots) {
        for (time, neighbours) in roots.times() {
            let is_earlier = |(first, _): &(Time, _)| time.compare(first).is_lt();
            if !first.as_ref().is_none_or(is_earlier) {
                break;
            }
            if pair.holds(&time) {
                first = Some((time, neighbours));
                break;
            }
        }
    }
    first
}

/// The sign of `f` just before a time: that of the first derivative that is not 0, reversed if its
/// order is odd. 0 at the start, or where `f` is identically 0.
fn side(f: &Poly, time: &Time, toi: [f64; 2]) -> i8 {
    if toi[1] == 0.0 {
        return 0;
    }
    let (mut derivative, mut is_odd) = (f.clone(), false);
    // Ends: each derivative has a lower degree, and the last one is 0.
    while !derivative.is_zero() {
        let sign = time.sign_of(&derivative);
        if sign.is_ne() {
            let before: Ordering = if is_odd { sign.reverse() } else { sign };
            return before as i8;
        }
        (derivative, is_odd) = (derivative.derivative(), !is_odd);
    }
    0
}

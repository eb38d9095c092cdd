//! Contact of an edge or a vertex with a body that turns, decided in integers.
//!
//! With `D = |q|^2` and the entries of `M(q)`, which are quadratic in `t`, `R = M / D` turns the
//! body's frame into space. A point `A` that moves on a line is `M^T (A - c) / D` in the body's
//! frame, and a point of the body stays there. All differences of the four points, taken there and
//! times `D`, are polynomials of degree 3 ([`motion`]). The first side may be of a body of its own,
//! which turns by `M1 / D1`: then `A` is `M^T (D1 (c1 - c) + M1 x) / D1 D` in the second body's frame,
//! `D` below stands for `D1 D`, and the differences have the degree 5. `D` is above 0: the two
//! quaternions are at less than a right angle, so that no sum of shares of them is 0. So the signs
//! of all predicates that are homogeneous in the differences are those of polynomials with integer
//! coefficients.
//!
//! The rest is as for linear motion ([`super`]), for none of its reasons needs more than that the
//! points move continuously:
//!
//! 1. What touches is coplanar: a contact time is a root of `f`, of degree 3 for a face, which stands
//!    still in this frame, and 6 for edges; 5 and 9 if both turn ([`decide`]).
//! 2. If `f` is identically 0, let the first contact be at `s > 0`, and suppose that then no vertex is
//!    on an edge of the other side. Then two edges meet at an angle and inside both, or the vertex is
//!    strictly inside a face with an area. Their parameters are continuous and the points coplanar
//!    throughout, so that the same is so shortly before `s`: a contradiction. So the first contact is
//!    at 0 or at a time at which a vertex comes onto an edge ([`confined`]).
//! 3. Multiple roots may have any order up to the degree. A vertex passes through the line of an edge
//!    where the least order of the components of `G = (Y - X) x (Z - X)` is odd: with `m` that order,
//!    `G / (t - s)^m` is continuous and not 0 at `s`.
//!
//! A radius `R` is `D R` there. The squared distances of two features are those of linear motion
//! with other vectors ([`thick`](super::thick)), so that the excess of a pair is
//! `numerator - D^2 R^2 denominator`: of degree 6 for a vertex of either side and a vertex, an edge or
//! a face of the body, 12 for an edge and a vertex or an edge of the body; 10 and 18 if both turn.

mod confined;
mod edges;
mod face;
mod motion;

use std::cmp::Ordering;

use super::PLACE_ERROR;
use super::dyadic::Dyadic;
use super::passage::Passage;
use super::thick::{
    Place, Poly, Roots, Time, decide_near_edges, decide_near_face, normal_of_near_edges,
    normal_of_near_face,
};
use crate::certified::motion::Vector;
use crate::certified::rigid::Turning;
use crate::contact::{Case, ContactKind, EdgePlace, EdgePoint, FacePlace, Flags, Hit};
use confined::End;
use edges::Edges;
use face::Face;
use motion::turned;

/// The first contact of an edge with an edge of a turning body.
pub(in crate::certified) fn decide_turning_edges(
    query: &Turning<'_, 2, 2>,
) -> Option<Hit<EdgePlace>> {
    let edges = Edges::new(query);
    let radius = query.radius;
    if !radius.is_zero() {
        let (thick, reach) = edges.thick(radius);
        return decide_near_edges(&thick, &reach, || passage(&edges));
    }
    let hit = decide(&edges)?;
    let point = |[u, v]: [f64; 2]| EdgePoint { u, v };
    Some(hit.map_place(|(first, second)| EdgePlace {
        first: point(first),
        second: second.map(point),
        error: PLACE_ERROR,
    }))
}

/// The first contact of a vertex with a face of a turning body.
pub(in crate::certified) fn decide_turning_face(
    query: &Turning<'_, 1, 3>,
) -> Option<Hit<FacePlace>> {
    let face = Face::new(query);
    let radius = query.radius;
    if !radius.is_zero() {
        let (thick, reach) = face.thick(radius);
        return decide_near_face(&thick, &reach, || passage(&face));
    }
    let hit = decide(&face)?;
    Some(hit.map_place(|(weights, _)| FacePlace {
        weights,
        error: PLACE_ERROR,
    }))
}

/// The direction in space of the shortest vector from an edge to an edge of a turning body, within
/// 2^-50, for a first contact whose neighbours in `f64` are `toi`; without a radius, its limit just
/// before.
///
/// `None` if they touch at the start.
pub(in crate::certified) fn normal_of_turning_edges(
    query: &Turning<'_, 2, 2>,
    toi: [f64; 2],
) -> Option<Vector> {
    let (edges, reach) = Edges::new(query).thick(query.radius);
    normal_of_near_edges(&edges, &reach, toi, |way| turned(query.second.motion, &way))
}

/// The same from a vertex to a face of a turning body.
pub(in crate::certified) fn normal_of_turning_face(
    query: &Turning<'_, 1, 3>,
    toi: [f64; 2],
) -> Option<Vector> {
    let (face, reach) = Face::new(query).thick(query.radius);
    normal_of_near_face(&face, &reach, toi, |way| turned(query.second.motion, &way))
}

/// What the midlines of two edges do to each other, one of a turning body.
pub(in crate::certified) fn passage_of_turning_edges(query: &Turning<'_, 2, 2>) -> Passage {
    passage(&Edges::new(query))
}

/// What a vertex and a face of a turning body do to each other without their radius.
pub(in crate::certified) fn passage_of_turning_face(query: &Turning<'_, 1, 3>) -> Passage {
    passage(&Face::new(query))
}

/// What the two do to each other without their radius.
fn passage<const W: usize>(sides: &impl Sides<W>) -> Passage {
    let crosses = match sides.f().is_zero() {
        true => confined::crosses_ever(sides),
        false => crosses_ever(sides),
    };
    Passage {
        case: sides.case(),
        kind: kind(crosses),
    }
}

/// Numbers that say where they touch, and the other end of an overlap.
type Places<const W: usize> = ([f64; W], Option<[f64; W]>);

/// Two sides, one of them of a body that turns. A place has `W` numbers: `u` and `v`, or the
/// weights of B, C and D.
trait Sides<const W: usize> {
    /// A polynomial with the sign of `(K x L) . M`, or of `(E1 x E2) . w`.
    fn f(&self) -> &Poly;

    /// Each vertex with each edge of the other side.
    fn ends(&self) -> Vec<End>;

    /// Where they touch at a time at which `f` is 0; `None` if they do not.
    fn locus(&self, time: &Time) -> Option<Locus<W>>;

    /// The case of the motion.
    fn case(&self) -> Case;

    /// The configuration at a time.
    fn flags(&self, time: &Time) -> Flags;
}

/// Where two sides touch.
struct Locus<const W: usize> {
    first: Place<W>,
    second: Option<Place<W>>,
    /// Whether two lines meet at an angle inside both edges, or the vertex is strictly inside the
    /// face.
    is_inside: bool,
}

impl<const W: usize> Locus<W> {
    fn at(first: Place<W>) -> Self {
        Locus {
            first,
            second: None,
            is_inside: false,
        }
    }
}

fn decide<const W: usize>(sides: &impl Sides<W>) -> Option<Hit<Places<W>>> {
    let start = Time::At(Dyadic::zero());
    if sides.f().coefficient(0).is_zero()
        && let Some(locus) = sides.locus(&start)
    {
        return Some(hit(
            sides,
            &start,
            [0.0; 2],
            &locus,
            ContactKind::Graze,
            Ordering::Equal,
        ));
    }
    match sides.f().is_zero() {
        true => confined::decide(sides),
        false => decide_general(sides),
    }
}

/// `f` is not identically 0 and there is no contact at the start: every contact time is a root.
fn decide_general<const W: usize>(sides: &impl Sides<W>) -> Option<Hit<Places<W>>> {
    let roots = Roots::new(sides.f().clone());
    roots.times().find_map(|(time, toi)| {
        let locus = sides.locus(&time)?;
        let (before, after) = signs_around(sides.f(), &time);
        let swaps = before != after && toi[0] < 1.0 && locus.is_inside;
        Some(hit(sides, &time, toi, &locus, kind(swaps), before))
    })
}

/// Whether `f`, which is not identically 0, changes its sign inside the step where they meet
/// inside.
fn crosses_ever<const W: usize>(sides: &impl Sides<W>) -> bool {
    let roots = Roots::new(sides.f().clone());
    let mut times = roots.times();
    times.any(|(time, toi)| {
        let (before, after) = signs_around(sides.f(), &time);
        let meet = || sides.locus(&time).is_some_and(|locus| locus.is_inside);
        before != after && toi[0] < 1.0 && meet()
    })
}

fn kind(crosses: bool) -> ContactKind {
    match crosses {
        true => ContactKind::Crossing,
        false => ContactKind::Graze,
    }
}

fn hit<const W: usize>(
    sides: &impl Sides<W>,
    time: &Time,
    [toi, toi_above]: [f64; 2],
    locus: &Locus<W>,
    kind: ContactKind,
    side: Ordering,
) -> Hit<Places<W>> {
    let second = locus.second.as_ref().map(|place| place.values(time));
    Hit {
        toi,
        toi_above,
        kind,
        side: side as i8,
        case: sides.case(),
        flags: sides.flags(time),
        place: (locus.first.values(time), second),
    }
}

/// The signs of a polynomial, which is not identically 0, just before and just after a time: those
/// of its first derivative that is not 0 there, the former reversed if its order is odd.
fn signs_around(poly: &Poly, time: &Time) -> (Ordering, Ordering) {
    let (mut derivative, mut is_odd) = (poly.clone(), false);
    // Ends: each derivative has a lower degree, and the last one is 0.
    while !derivative.is_zero() {
        let sign = time.sign_of(&derivative);
        if sign.is_ne() {
            return (if is_odd { sign.reverse() } else { sign }, sign);
        }
        (derivative, is_odd) = (derivative.derivative(), !is_odd);
    }
    (Ordering::Equal, Ordering::Equal)
}

/// What a quotient `n / d` is, `d` not 0, relative to the interval from 0 to 1; `None` if it is
/// outside.
fn is_between(time: &Time, n: &Poly, d: &Poly, sign_of_d: Ordering) -> Option<bool> {
    let oriented = |sign: Ordering| match sign_of_d {
        Ordering::Less => sign.reverse(),
        _ => sign,
    };
    let start = oriented(time.sign_of(n));
    if start.is_lt() {
        return None;
    }
    let end = oriented(time.sign_of(&Poly::difference(n, d)));
    end.is_le().then(|| start.is_gt() && end.is_lt())
}

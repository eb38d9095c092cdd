//! The contact normal: the common normal of the nearest features at the time of impact.
//!
//! Let `w(t)` be the shortest vector from the first side (the edge AB, or the vertex A) to the
//! second (the edge CD, or the face BCD). It is unique, because the sides are convex. The contact
//! normal is
//!
//! ```text
//! lim w(t) / |w(t)|   for t -> toi from below, if toi > 0
//! w(0) / |w(0)|       if toi = 0
//! ```
//!
//! Before a contact at `toi > 0` the sides are apart, and `w` is algebraic in `t`: the limit
//! exists. With a radius above 0 it is the direction of `w(toi)`, whose length is the radius. A
//! contact at `t = 0` of sides that touch there has no normal; one of sides apart there, nearer
//! than the radius, has.
//!
//! By features that are nearest just before contact this means, with radius 0:
//!
//! - Edges inside both, at an angle: the common perpendicular `K x L` of `K = B - A` and `L = D -
//!   C`, with the sign of `f` just before. A vertex inside a face: the face's normal, with that
//!   sign.
//! - Two vertices (an end of each edge; the vertex and a corner): their vector is `(t - toi)` times
//!   their relative velocity, so that the normal is that velocity's direction, reversed.
//! - A vertex and an edge, the latter with the direction `E` and relative velocity `y` of the
//!   material points that meet: `-y` without its part along `E`, and where that is 0 the next order
//!   of the same vector: parallel to the change of `E`, perpendicular to `E`.
//! - Which of these are nearest depends on the motion before contact, not on the place of contact:
//!   a vertex that lands on the border of a face from above is nearest to the inner face or to the
//!   border.
//! - Parallel edges that overlap, and coplanar motion: the same rules; the nearest points of
//!   parallel edges are many, their vector is one.
//!
//! Two computations give it. In `f64`, for contact inside both features or with a radius: the
//! perpendicular of the features, or the vector between the nearest points, whichever has the
//! smaller bound; a bound above 2^-33 is refused. What is refused, and every other place of
//! contact, is decided in integers: the first derivative of `w`'s numerator that is not 0 at the
//! exact time (`exact::thick::normal`).
//!
//! Of bodies that turn it is the same, by the same two computations in the frame of a body
//! (`rigid::normal`).
//!
//! The error is mostly 1e-15 to 1e-13 in `f64`, or that of the weights times size over radius;
//! 2^-50 from integers. It is never above [`WORST`].

use nalgebra::Vector3;

use super::exact::{normal_of_edges_exactly, normal_of_face_exactly};
use super::kind::Sealed;
use super::motion::{Positions, Vector, cross, sub};
use crate::contact::{EdgePlace, EdgePoint, FacePlace, Hit};
use crate::query::Radius;

mod bounded;

pub(super) use bounded::Bounded;
use bounded::Step;

/// A contact normal with a bound on its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normal {
    /// From the first side to the second, of length 1 within 2^-50.
    pub direction: Vector3<f64>,
    /// The distance of `direction` from the exact normal is at most this, which is at most 2^-32.
    pub error: f64,
}

/// A query whose hits have a contact normal: of any [`Kind`](super::Kind) or
/// [`RigidKind`](super::RigidKind). `P` is where its sides touch.
///
/// The trait is sealed: no other type can be one.
pub trait HasNormal<P>: Sealed {
    /// The distance at which the two sides count as touching.
    #[doc(hidden)]
    fn contact_radius(&self) -> Radius;

    /// [`Hit::normal`] of a hit whose times are those of a step, and above 0 without a radius.
    #[doc(hidden)]
    fn normal_of(&self, hit: &Hit<P>) -> Option<Normal>;
}

/// The largest [`Normal::error`], 2^-32.
const WORST: f64 = f64::from_bits((1023 - 32) << 52);

/// What is known of the first contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct At {
    /// The largest `f64` that is not above the time of impact.
    pub(super) toi: f64,
    /// The smallest `f64` that is not below it.
    pub(super) toi_above: f64,
    /// The sign of `f` just before, as in [`Hit::side`].
    pub(super) side: i8,
    /// No parameter or weight is farther from the exact one.
    pub(super) error: f64,
}

/// The contact normal of two edges, from AB to CD, which touch or are nearest at `u` on AB and `v`
/// on CD, and also at `second` if they overlap.
///
/// `None` only where the sides touch at the start.
pub(super) fn normal_of_edges(
    start: &[Vector; 4],
    end: &[Vector; 4],
    radius: Radius,
    at: &At,
    [u, v]: [f64; 2],
    second: Option<[f64; 2]>,
) -> Option<Normal> {
    let is_inside = second.is_none() && [u, v].iter().all(|&x| is_inside(x, at.error));
    let step = Step::new(start, end, at);
    let quick = step.and_then(|step| {
        let (k, l, m) = (
            step.difference(0, 1),
            step.difference(2, 3),
            step.difference(0, 2),
        );
        let perpendicular = || k.cross(&l).directed(f64::from(at.side));
        let between = || m.plus(&l.times(v, at.error).minus(&k.times(u, at.error)));
        nearest(is_inside, radius, at, perpendicular, between)
    });
    quick.or_else(|| {
        let positions = positions(start, end);
        normal_of_edges_exactly(&positions, radius.parts(), [at.toi, at.toi_above]).map(exact)
    })
}

/// The contact normal of a vertex A and a face BCD, from A to BCD, which touch or are nearest at
/// the point with these weights of B, C and D.
///
/// `None` only where the vertex touches the face at the start.
pub(super) fn normal_of_face(
    start: &[Vector; 4],
    end: &[Vector; 4],
    radius: Radius,
    at: &At,
    weights: [f64; 3],
) -> Option<Normal> {
    let is_inside = weights.iter().all(|&weight| is_inside(weight, at.error));
    let step = Step::new(start, end, at);
    let quick = step.and_then(|step| {
        let (p, q, to_b) = (
            step.difference(1, 2),
            step.difference(1, 3),
            step.difference(0, 1),
        );
        let [_, c, d] = weights;
        // f is positive where the vertex is on the side that (C - B) x (D - B) points to.
        let perpendicular = || p.cross(&q).directed(-f64::from(at.side));
        let between = || to_b.plus(&p.times(c, at.error).plus(&q.times(d, at.error)));
        nearest(is_inside, radius, at, perpendicular, between)
    });
    quick.or_else(|| {
        let positions = positions(start, end);
        normal_of_face_exactly(&positions, radius.parts(), [at.toi, at.toi_above]).map(exact)
    })
}

/// The normal in `f64`, if its bound is small.
///
/// The perpendicular of two features is parallel to the shortest vector where that ends inside
/// both, at the time of impact. The sign of `f` is that of their scalar product, up to the order of
/// the points. With radius 0 both are so just before contact, too: if `f` were 0 there, the contact
/// would not be the first. The vector between the nearest points is 0 at a contact with radius 0.
pub(super) fn nearest(
    is_inside: bool,
    radius: Radius,
    at: &At,
    perpendicular: impl Fn() -> Bounded,
    between: impl Fn() -> Bounded,
) -> Option<Normal> {
    let has_side = is_inside && at.side != 0 && at.toi > 0.0;
    let perpendicular = has_side.then(perpendicular).and_then(|x| x.normal());
    let between = (!radius.is_zero()).then(between).and_then(|x| x.normal());
    match (perpendicular, between) {
        (Some(x), Some(y)) if y.error < x.error => Some(y),
        (x, y) => x.or(y),
    }
}

/// Whether a parameter is proved to be strictly between 0 and 1. `1 - x` is exact where it matters:
/// from 1/2 on.
pub(super) fn is_inside(x: f64, error: f64) -> bool {
    x > error && 1.0 - x > error
}

fn positions(start: &[Vector; 4], end: &[Vector; 4]) -> Positions {
    Positions {
        start: *start,
        end: *end,
    }
}

/// A normal from integers; they say that the error is at most 2^-50.
pub(super) fn exact(direction: Vector) -> Normal {
    Normal {
        direction: Vector3::from(direction),
        error: 4.0 * f64::EPSILON,
    }
}

/// The normal of a hit of two edges.
pub(super) fn of_edges(
    positions: &Positions,
    radius: Radius,
    hit: &Hit<EdgePlace>,
) -> Option<Normal> {
    let plain = |EdgePoint { u, v }: EdgePoint| [u, v];
    let Positions { start, end } = positions;
    let EdgePlace {
        first,
        second,
        error,
    } = hit.place;
    let at = At::new(hit, error);
    normal_of_edges(start, end, radius, &at, plain(first), second.map(plain))
}

/// The normal of a hit of a vertex and a face.
pub(super) fn of_face(
    positions: &Positions,
    radius: Radius,
    hit: &Hit<FacePlace>,
) -> Option<Normal> {
    let Positions { start, end } = positions;
    let FacePlace { weights, error } = hit.place;
    let at = At::new(hit, error);
    normal_of_face(start, end, radius, &at, weights)
}

impl At {
    pub(super) fn new<P>(hit: &Hit<P>, error: f64) -> Self {
        At {
            toi: hit.toi,
            toi_above: hit.toi_above,
            side: hit.side,
            error,
        }
    }
}

#[cfg(test)]
mod tests;

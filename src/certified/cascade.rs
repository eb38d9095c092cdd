//! The cascade: each stage answers only what it can prove, and hands on the rest.

use wide::f64x2;

use super::crossing;
use super::cubic::Cubic;
use super::kind::{Kind, Stages};
use super::motion::{Motion, Positions};
use super::stage::{Finding, Stage};
use super::thick;
use crate::contact::{Case, Hit};
use crate::environment;
use crate::query::Radius;

/// Whether and when the two sides of a query touch: certified, without thresholds.
///
/// The query is an [`EdgeEdge`](crate::query::EdgeEdge) or a
/// [`VertexFace`](crate::query::VertexFace). With a radius above 0, contact is a distance of at
/// most the radius.
///
/// # Guarantee
///
/// No hit is false, no contact is missed, and [`toi`](Hit::toi) is the exact time of impact rounded
/// down, for every finite query. The proofs assume rounding to nearest and gradual underflow, as
/// Rust does: [`environment::check`] says whether the current thread has them.
///
/// # Panics
///
/// In debug builds, if it has not.
///
/// # Example
///
/// ```
/// use tunnelproof::{EdgeEdge, Point, decide};
///
/// let p = Point::new;
/// let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.5, -1.0, 1.0), p(0.5, 1.0, 1.0)];
/// let mut end = start;
/// end[2].z = -3.0;
/// end[3].z = -3.0;
/// let hit = decide(&EdgeEdge::new(start, end, 0.0)?).expect("the edges cross");
/// assert_eq!((hit.toi, hit.place.first.u, hit.place.first.v), (0.25, 0.75, 0.5));
/// # Ok::<(), tunnelproof::QueryError>(())
/// ```
pub fn decide<K: Kind>(query: &K) -> Option<Hit<K::Place>> {
    decide_observed(query, &mut |_| {})
}

/// As [`decide`], and says which stage decided.
#[inline]
pub fn decide_observed<K: Kind>(
    query: &K,
    observe: &mut impl FnMut(Stage),
) -> Option<Hit<K::Place>> {
    debug_assert_eq!(environment::check(), Ok(()));
    let positions = || Positions::of(query.start(), query.end());
    decide_motion::<K::Stages>(positions, query.radius(), observe)
}

/// As [`decide`], by integer arithmetic alone.
///
/// It takes about a microsecond where the coordinates are of similar magnitude; with a radius above
/// 0, about fifty times that. The slowest queries found, whose exponents span the range of `f64`,
/// take less than 0.015 s without a radius and less than 0.15 s with one.
pub fn decide_exactly<K: Kind>(query: &K) -> Option<Hit<K::Place>> {
    debug_assert_eq!(environment::check(), Ok(()));
    let (positions, radius) = (Positions::of(query.start(), query.end()), query.radius());
    if radius.is_zero() {
        K::Stages::decide_exactly(&positions)
    } else {
        K::Stages::decide_thick_exactly(&positions, radius)
    }
}

/// The case of the motion, whether the two sides touch or not. Exact; the radius has no part in it.
pub fn classify<K: Kind>(query: &K) -> Case {
    K::Stages::case(&Positions::of(query.start(), query.end()))
}

/// The first contact of a motion within a radius, by all stages.
#[inline(always)]
pub(super) fn decide_motion<K: Stages>(
    positions: impl Fn() -> Positions,
    radius: Radius,
    observe: &mut impl FnMut(Stage),
) -> Option<Hit<K::Place>> {
    if radius.is_zero() {
        decide_all::<K>(positions, observe)
    } else {
        thick::decide::<K>(positions, radius, observe)
    }
}

/// All stages, without a radius.
#[inline(always)]
fn decide_all<K: Stages>(
    positions: impl Fn() -> Positions,
    observe: &mut impl FnMut(Stage),
) -> Option<Hit<K::Place>> {
    let points = positions().points::<f64x2>();
    let boxes = K::boxes(&points, 0.0);
    if boxes.are_disjoint {
        observe(Stage::Boxes);
        return None;
    }
    let motion = K::motion(&points);
    if K::is_separated_by_centres(&motion, &boxes) {
        observe(Stage::Direction);
        return None;
    }
    let cubic = Cubic::new(&motion);
    if cubic.is_some_and(|cubic| cubic.has_no_root()) {
        observe(Stage::Signs);
        return None;
    }
    let found = cubic.map_or(Finding::Undecided, |cubic| {
        crossing::decide::<K, _>(&points, &motion, &cubic)
    });
    if let Some(found) = found.decided() {
        observe(Stage::Roots);
        return found;
    }
    K::decide_by_roots(positions, || boxes, &motion, cubic.as_ref(), observe)
}

/// The stages after those without a branch, for a query that those leave open, with the time of the
/// first root, if that was asked for.
#[inline(always)]
pub(super) fn decide_rest<K: Stages>(
    positions: &Positions,
    cubic: impl Fn(&Motion<f64x2>) -> Option<Cubic>,
    crossing_time: Option<f64>,
    observe: &mut impl FnMut(Stage),
) -> Option<Hit<K::Place>> {
    let points = positions.points::<f64x2>();
    let motion = K::motion(&points);
    let cubic = cubic(&motion);
    let found = cubic.map_or(Finding::Undecided, |cubic| match crossing_time {
        Some(time) => Finding::of_certain(crossing::at::<K, _>(time, &motion, &cubic)),
        None => crossing::decide::<K, _>(&points, &motion, &cubic),
    });
    if let Some(found) = found.decided() {
        observe(Stage::Roots);
        return found;
    }
    let boxes = || K::boxes(&points, 0.0);
    K::decide_by_roots(|| *positions, boxes, &motion, cubic.as_ref(), observe)
}

//! The certified path for a vertex and a face: the same cascade as for two edges.
//!
//! A vertex that touches a face is in its plane: with `K = C - B`, `L = D - B` and `M = A - B` the cubic
//! `f = (K x L) . M` is 0, so everything up to its roots is what edges need (`cubic`, `root`). What is
//! its own: the boxes and the direction (`separate`), and where the vertex is at a root (`place`).
//!
//! Up to its sign `f` is that of any order of the four points. For the last bits of a root, and in the exact
//! stage, they are taken as the edges BC and AD, so that `refine` and `exact` are shared as well.

mod place;
mod separate;
mod verdict;

use wide::f64x2;

pub use self::verdict::FaceHit;

pub(super) use self::place::is_apart_in;
pub(super) use self::separate::{boxes, is_separated_by_centres, star};

use self::place::{Place, of_edges, shares};
use super::cascade::Stage;
use super::cubic::Cubic;
use super::ends::Ends;
use super::exact;
use super::motion::{Motion, Positions};
use super::refine::Root;
use super::root::Bracket;
use super::thick;
use crate::contact::{Case, ContactKind, Flags};
use crate::query::VertexFace;

/// The first contact of a moving vertex and a moving face, `None` for a miss: certified, without
/// thresholds. With a radius above 0 contact is a distance of at most the radius.
///
/// No hit is false, no contact is missed, and `toi` is the exact time of impact rounded down.
pub fn decide_vertex_face(query: &VertexFace) -> Option<FaceHit> {
    decide_vertex_face_observed(query, &mut |_| {})
}

/// As [`decide_vertex_face`], by integer arithmetic alone.
pub fn decide_vertex_face_exactly(query: &VertexFace) -> Option<FaceHit> {
    let positions = Positions::of(query.start(), query.end());
    if !query.radius().is_zero() {
        return thick::decide_face_exactly(&positions, query.radius());
    }
    exact::decide_face(&as_edges(&positions))
}

/// As [`decide_vertex_face`], and says which stage decided.
#[inline]
pub fn decide_vertex_face_observed(
    query: &VertexFace,
    observe: &mut impl FnMut(Stage),
) -> Option<FaceHit> {
    let positions = || Positions::of(query.start(), query.end());
    if !query.radius().is_zero() {
        return thick::decide::<thick::Face>(positions, query.radius(), observe);
    }
    decide_all(positions, observe)
}

/// All stages.
#[inline(always)]
pub(super) fn decide_all(
    positions: impl Fn() -> Positions,
    observe: &mut impl FnMut(Stage),
) -> Option<FaceHit> {
    let points = positions().points::<f64x2>();
    let boxes = boxes(&points);
    if boxes.are_disjoint {
        observe(Stage::Boxes);
        return None;
    }
    let motion = star(&points);
    if is_separated_by_centres(&motion, &boxes) {
        observe(Stage::Direction);
        return None;
    }
    decide_open(positions, &motion, observe)
}

/// The stages after the first two, for a query that those leave open.
pub(super) fn decide_rest(
    positions: impl Fn() -> Positions,
    observe: &mut impl FnMut(Stage),
) -> Option<FaceHit> {
    let motion = star(&positions().points::<f64x2>());
    decide_open(positions, &motion, observe)
}

#[inline(always)]
fn decide_open<E: Ends>(
    positions: impl Fn() -> Positions,
    motion: &Motion<E>,
    observe: &mut impl FnMut(Stage),
) -> Option<FaceHit> {
    let cubic = Cubic::new(motion);
    if cubic.is_some_and(|cubic| cubic.has_no_root()) {
        observe(Stage::Signs);
        return None;
    }
    if let Some(answer) = cubic.and_then(|cubic| decide_by_roots(&positions, motion, &cubic)) {
        observe(Stage::Roots);
        return answer;
    }
    observe(Stage::Exact);
    exact::decide_face(&as_edges(&positions()))
}

/// The ends of the edges BC and AD.
pub(super) fn as_edges(Positions { start, end }: &Positions) -> Positions {
    let order = |[a, b, c, d]: [_; 4]| [b, c, a, d];
    Positions {
        start: order(*start),
        end: order(*end),
    }
}

/// A vertex in the face is in its plane: the first root of the cubic at which it is inside the face is the
/// contact. `None` as soon as one root is not certain.
fn decide_by_roots<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
) -> Option<Option<FaceHit>> {
    let is_apart = |low, high| shares(motion, cubic, &Bracket::around(low, high)).are_apart();
    for bracket in cubic.isolate(is_apart)?.as_slice() {
        let answer = decide_at_root(positions, motion, cubic, bracket)?;
        if answer.is_some() {
            return Some(answer);
        }
    }
    Some(None)
}

/// The contact at the root in a bracket; `None` if it is not certain whether there is one.
#[inline(always)]
fn decide_at_root<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
    bracket: &Bracket,
) -> Option<Option<FaceHit>> {
    let settled = |bracket: &Bracket, place| match place {
        Place::Apart => Some(None),
        Place::Inside { .. } => hit(positions, motion, cubic, bracket).map(Some),
        Place::Unclear => None,
    };
    let place = shares(motion, cubic, bracket).place();
    if place != Place::Unclear {
        return settled(bracket, place);
    }
    let (sharp, _) = cubic.sharpen(bracket)?;
    let place = shares(motion, cubic, &sharp).place();
    if place != Place::Unclear {
        return settled(&sharp, place);
    }
    // To twice the precision.
    let edges = as_edges(&positions());
    let edge_motion = Motion::new(&edges.points::<f64x2>());
    let edge_cubic = Cubic::new(&edge_motion)?;
    let root = Root::new(&edges, &edge_cubic, &sharp)?;
    match of_edges(&root.meeting(&edges, &edge_motion, &edge_cubic)).place() {
        Place::Apart => Some(None),
        place => crossing(root.round_down()?, &sharp, place).map(Some),
    }
}

/// Whether the vertex is inside the face at the root in a bracket, if that is certain.
pub(super) fn is_inside_at(
    points: &[[f64x2; 3]; 4],
    cubic: &Cubic,
    bracket: &Bracket,
) -> Option<bool> {
    match shares(&star(points), cubic, bracket).place() {
        Place::Apart => Some(false),
        Place::Inside { .. } => Some(true),
        Place::Unclear => None,
    }
}

/// The contact at a root at which the vertex is inside the face.
fn hit<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
    bracket: &Bracket,
) -> Option<FaceHit> {
    let edges = as_edges(&positions());
    // The same cubic, with the error bound that belongs to the edges.
    let edge_cubic = Cubic::new(&Motion::new(&edges.points::<f64x2>()))?;
    let toi = Root::new(&edges, &edge_cubic, bracket)?.round_down()?;
    let at_toi = Bracket {
        low: toi,
        high: toi.next_up(),
        ..*bracket
    };
    crossing(toi, bracket, shares(motion, cubic, &at_toi).place())
}

/// The contact at a simple root strictly inside the step, strictly inside the face: `f` changes its sign.
fn crossing(toi: f64, bracket: &Bracket, place: Place) -> Option<FaceHit> {
    let Place::Inside { weights, error } = place else {
        return None;
    };
    let hit = FaceHit {
        toi,
        toi_above: toi.next_up(),
        kind: ContactKind::Crossing,
        side: if bracket.is_rising { -1 } else { 1 },
        weights,
        weight_error: error,
        case: Case::General,
        flags: Flags::default(),
    };
    hit.is_precise().then_some(hit)
}

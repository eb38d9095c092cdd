//! The cascade: each stage answers only what it can prove, and hands on the rest.

use wide::f64x2;

use super::cubic::Cubic;
use super::ends::Ends;
use super::exact;
use super::locate::Place;
use super::motion::{Motion, Positions};
use super::refine::Root;
use super::root::Bracket;
use super::separate::SweptBoxes;
use super::start;
use super::thick;
use super::verdict::{Hit, Parameters, Verdict};
use crate::contact::{Case, ContactKind, Flags};
use crate::query::EdgeEdge;

/// The stage of the cascade that decided a query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Stage {
    /// The swept boxes are disjoint.
    Boxes,
    /// A direction separates the edges for the whole step.
    Direction,
    /// The Bernstein coefficients of the cubic have one sign.
    Signs,
    /// The roots of the cubic, bounded in `f64`.
    Roots,
    /// A separating direction, found by search.
    Search,
    /// With a radius: planes that separate, each for a part of the step, up to its end or the contact.
    Planes,
    /// Integers.
    Exact,
}

impl Stage {
    /// Every stage, in the order in which they are tried.
    pub const ALL: [Stage; 7] = [
        Stage::Boxes,
        Stage::Direction,
        Stage::Signs,
        Stage::Roots,
        Stage::Search,
        Stage::Planes,
        Stage::Exact,
    ];

    /// The name used in tables.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Boxes => "boxes",
            Stage::Direction => "direction",
            Stage::Signs => "signs",
            Stage::Roots => "roots",
            Stage::Search => "search",
            Stage::Planes => "planes",
            Stage::Exact => "exact",
        }
    }
}

/// Whether and when two moving edges touch: certified, without thresholds.
///
/// No hit is false, no contact is missed, and `toi` is the exact time of impact rounded down.
///
/// With a radius above 0 contact is a distance of at most the radius, at [`Hit::toi`] that of the nearest points.
pub fn decide(query: &EdgeEdge) -> Verdict {
    decide_observed(query, &mut |_| {})
}

/// As [`decide`], and says which stage decided.
#[inline]
pub fn decide_observed(query: &EdgeEdge, observe: &mut impl FnMut(Stage)) -> Verdict {
    if !query.radius().is_zero() {
        let hit = thick::decide::<thick::Edges>(|| Positions::new(query), query.radius(), observe);
        return hit.map_or(Verdict::Miss, Verdict::Hit);
    }
    decide_all(|| Positions::new(query), observe)
}

/// All stages.
#[inline(always)]
pub(super) fn decide_all(
    positions: impl Fn() -> Positions,
    observe: &mut impl FnMut(Stage),
) -> Verdict {
    let points = positions().points::<f64x2>();
    let boxes = SweptBoxes::new(&points);
    if boxes.are_disjoint {
        observe(Stage::Boxes);
        return Verdict::Miss;
    }
    let motion = Motion::new(&points);
    if motion.is_separated_by_centres(&boxes) {
        observe(Stage::Direction);
        return Verdict::Miss;
    }
    decide_open(positions, &boxes, &motion, observe)
}

/// The stages after the first two, for a query that those leave open.
pub(super) fn decide_rest(
    positions: impl Fn() -> Positions,
    observe: &mut impl FnMut(Stage),
) -> Verdict {
    let points = positions().points::<f64x2>();
    let (boxes, motion) = (SweptBoxes::new(&points), Motion::new(&points));
    decide_open(positions, &boxes, &motion, observe)
}

#[inline(always)]
fn decide_open<E: Ends>(
    positions: impl Fn() -> Positions,
    boxes: &SweptBoxes,
    motion: &Motion<E>,
    observe: &mut impl FnMut(Stage),
) -> Verdict {
    let cubic = Cubic::new(motion);
    if cubic.is_some_and(|cubic| cubic.has_no_root()) {
        observe(Stage::Signs);
        return Verdict::Miss;
    }
    decide_with_roots(positions, boxes, motion, cubic.as_ref(), observe)
}

/// The stages from the roots on.
#[inline(never)]
fn decide_with_roots<E: Ends>(
    positions: impl Fn() -> Positions,
    boxes: &SweptBoxes,
    motion: &Motion<E>,
    cubic: Option<&Cubic>,
    observe: &mut impl FnMut(Stage),
) -> Verdict {
    if let Some(hit) = start::contact(&positions, motion, cubic) {
        observe(Stage::Roots);
        return Verdict::Hit(hit);
    }
    if let Some(verdict) = cubic.and_then(|cubic| decide_by_roots(&positions, motion, cubic)) {
        observe(Stage::Roots);
        return verdict;
    }
    if motion.is_separated_by_search(boxes) {
        observe(Stage::Search);
        return Verdict::Miss;
    }
    observe(Stage::Exact);
    match exact::decide(&positions()).hit {
        None => Verdict::Miss,
        Some(hit) => Verdict::Hit(hit),
    }
}

/// Edges that touch are coplanar: the first root of the cubic at which the lines meet inside both
/// edges is the contact. `None` as soon as one root is not certain.
fn decide_by_roots<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
) -> Option<Verdict> {
    let is_apart = |low, high| {
        motion
            .meeting(cubic, &Bracket::around(low, high))
            .is_apart()
    };
    for bracket in cubic.isolate(is_apart)?.as_slice() {
        let mut bracket = *bracket;
        let mut place = motion.meeting(cubic, &bracket).place();
        if let Place::Unclear = place {
            (bracket, _) = cubic.sharpen(&bracket)?;
            place = motion.meeting(cubic, &bracket).place();
        }
        return match place {
            Place::Apart => continue,
            Place::Inside { .. } => hit(positions, motion, cubic, &bracket),
            Place::Unclear => match decide_near_end(&positions(), motion, cubic, &bracket)? {
                Verdict::Miss => continue,
                hit => Some(hit),
            },
        };
    }
    Some(Verdict::Miss)
}

/// Whether the edges touch at the root in a sharpened bracket where the lines meet near an edge's end;
/// `None` if that is not certain.
#[inline(never)]
fn decide_near_end<E: Ends>(
    positions: &Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
    bracket: &Bracket,
) -> Option<Verdict> {
    let root = Root::new(positions, cubic, bracket)?;
    match root.meeting(positions, motion, cubic).place() {
        Place::Apart => Some(Verdict::Miss),
        place => crossing(root.round_down()?, bracket, place),
    }
}

/// The contact at a root at which the lines meet inside both edges.
fn hit<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
    bracket: &Bracket,
) -> Option<Verdict> {
    let toi = Root::new(&positions(), cubic, bracket)?.round_down()?;
    let at_toi = Bracket {
        low: toi,
        high: toi.next_up(),
        ..*bracket
    };
    crossing(toi, bracket, motion.meeting(cubic, &at_toi).place())
}

/// The contact at a simple root strictly inside the step, strictly inside both edges.
///
/// `f` changes sign there and the lines meet at an angle: a crossing of general motion.
fn crossing(toi: f64, bracket: &Bracket, place: Place) -> Option<Verdict> {
    let Place::Inside { u, v, error } = place else {
        return None;
    };
    if error > Hit::PARAMETER_ERROR {
        return None;
    }
    Some(Verdict::Hit(Hit {
        toi,
        toi_above: toi.next_up(),
        kind: ContactKind::Crossing,
        side: if bracket.is_rising { -1 } else { 1 },
        first: Parameters { u, v },
        second: None,
        parameter_error: error,
        case: Case::General,
        flags: Flags::default(),
    }))
}

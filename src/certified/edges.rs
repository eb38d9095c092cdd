//! Two edges: where they are at the roots of the cubic.

use std::cmp::Ordering;

use super::cubic::Cubic;
use super::ends::Ends;
use super::exact::{self, Passage};
use super::kind::{Kind, Sealed, Stages, query_parts};
use super::locate::Place;
use super::motion::{Motion, Positions};
use super::nearest::{self, Gram, Spot};
use super::normal::{self, HasNormal, Normal};
use super::refine::Root;
use super::root::{Bracket, Half};
use super::separate::SweptBoxes;
use super::stage::{Finding, Stage};
use super::start;
use crate::contact::{Case, ContactKind, EdgePlace, EdgePoint, Flags, Hit, PLACE_ERROR};
use crate::query::{EdgeEdge, Point, Radius};

impl Sealed for EdgeEdge {}

#[allow(private_interfaces, reason = "as of the trait")]
impl Kind for EdgeEdge {
    type Place = EdgePlace;
    query_parts!();
}

impl HasNormal<EdgePlace> for EdgeEdge {
    fn contact_radius(&self) -> Radius {
        self.radius()
    }

    fn normal_of(&self, hit: &Hit<EdgePlace>) -> Option<Normal> {
        let positions = Positions::of(self.start(), self.end());
        normal::of_edges(&positions, self.radius(), hit)
    }
}

impl Stages for EdgeEdge {
    type Place = EdgePlace;
    type Query = Self;

    fn query(positions: &Positions, radius: Radius) -> Self {
        let Positions { start, end } = *positions;
        EdgeEdge::of(start.map(Point::from), end.map(Point::from), radius)
    }

    const FIRST: usize = 2;

    fn weights(place: &EdgePlace) -> ([f64; 4], Option<[f64; 4]>) {
        (place.first.weights(), place.second.map(EdgePoint::weights))
    }

    #[inline(always)]
    fn boxes<E: Ends>([a, b, c, d]: &[[E; 3]; 4], distance: f64) -> SweptBoxes {
        SweptBoxes::around([a, b], [c, d], distance)
    }

    #[inline(always)]
    fn motion<E: Ends>(points: &[[E; 3]; 4]) -> Motion<E> {
        Motion::new(points)
    }

    #[inline(always)]
    fn is_separated_by_centres<E: Ends>(motion: &Motion<E>, boxes: &SweptBoxes) -> bool {
        motion.is_separated_by_centres(boxes)
    }

    #[inline(always)]
    fn is_apart_in<E: Ends>(motion: &Motion<E>, cubic: &Cubic, half: &Half) -> bool {
        motion.is_apart_in(cubic, half)
    }

    #[inline(never)]
    fn decide_by_roots<E: Ends>(
        positions: impl Fn() -> Positions,
        boxes: impl Fn() -> SweptBoxes,
        motion: &Motion<E>,
        cubic: Option<&Cubic>,
        observe: &mut impl FnMut(Stage),
    ) -> Option<Hit<EdgePlace>> {
        if let Some(hit) = start::contact(&positions, motion, cubic) {
            observe(Stage::Roots);
            return Some(hit);
        }
        let finding = cubic.map_or(Finding::Undecided, |cubic| {
            decide_by_cubic(&positions, motion, cubic)
        });
        match finding {
            Finding::Hit(hit) => {
                observe(Stage::Roots);
                return Some(hit);
            }
            Finding::Miss => {
                observe(Stage::Roots);
                return None;
            }
            Finding::Undecided => {}
        }
        if motion.is_separated_by_search(&boxes()) {
            observe(Stage::Search);
            return None;
        }
        observe(Stage::Exact);
        exact::decide_edges(&positions())
    }

    #[inline(always)]
    fn touch_at<E: Ends>(motion: &Motion<E>, cubic: &Cubic, bracket: &Bracket) -> bool {
        motion.meeting(cubic, bracket).is_inside()
    }

    #[inline(always)]
    fn time_at<E: Ends>(points: &[[E; 3]; 4], cubic: &Cubic, bracket: &Bracket) -> (f64, bool) {
        let (sharp, least) = cubic.sharpen_once(bracket);
        let (toi, is_certain) = Root::of(points, cubic, &sharp, least).below();
        (toi, is_certain & (least > 0.0))
    }

    #[inline(always)]
    fn crossing_at<E: Ends>(
        motion: &Motion<E>,
        cubic: &Cubic,
        at: &Bracket,
    ) -> Option<Hit<EdgePlace>> {
        crossing(at, motion.meeting(cubic, at).place())
    }

    fn decide_exactly(positions: &Positions) -> Option<Hit<EdgePlace>> {
        exact::decide_edges(positions)
    }

    fn case(positions: &Positions) -> Case {
        exact::case_of_edges(positions)
    }

    /// `K = B - A`, `L = D - C`, `M = C - A`.
    const DIFFERENCES: [(usize, usize); 3] = [(0, 1), (2, 3), (0, 2)];

    const CORNERS: &'static [(f64, f64)] = &[(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)];

    const MIDDLE: (f64, f64) = (0.5, 0.5);

    #[inline(always)]
    fn least_corner<E: Ends>(k: E, l: E, m: E) -> E {
        let zero = E::both(0.0);
        m + l.smaller(zero) - k.larger(zero)
    }

    #[inline(always)]
    fn nearest(gram: &Gram) -> Spot {
        nearest::nearest_on_edges(gram)
    }

    fn nearest_on_sides(gram: &Gram) -> impl IntoIterator<Item = Spot> {
        nearest::nearest_to_ends(gram)
    }

    fn place(u: f64, v: f64, error: f64) -> EdgePlace {
        EdgePlace {
            first: EdgePoint { u, v },
            second: None,
            error,
        }
    }

    fn crosses_at<E: Ends>(points: &[[E; 3]; 4], cubic: &Cubic, bracket: &Bracket) -> Option<bool> {
        match Motion::new(points).meeting(cubic, bracket).place() {
            Place::Apart => Some(false),
            Place::Inside { .. } => Some(true),
            Place::Unclear => None,
        }
    }

    fn passage(positions: &Positions) -> Passage {
        exact::passage_of_edges(positions)
    }

    fn side(positions: &Positions, toi: [f64; 2]) -> Option<i8> {
        exact::side_of_edges(positions, toi)
    }

    fn are_always_parallel(positions: &Positions) -> bool {
        exact::are_always_parallel(positions)
    }

    fn contact_of_parallel(positions: &Positions, toi: [f64; 2]) -> Option<Hit<EdgePlace>> {
        if toi[1] == 0.0 {
            exact::near_start_of_parallel_edges(positions)
        } else {
            exact::contact_of_parallel_edges(positions, toi)
        }
    }

    fn compare_distance(positions: &Positions, radius: Radius, time: f64) -> Ordering {
        exact::compare_distance_of_edges(positions, radius, time)
    }

    fn decide_thick_exactly(positions: &Positions, radius: Radius) -> Option<Hit<EdgePlace>> {
        exact::decide_thick_edges(positions, radius)
    }
}

/// Edges that touch are coplanar: the first root of the cubic at which the lines meet inside both
/// edges is the contact. Undecided as soon as one root is not certain.
fn decide_by_cubic<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
) -> Finding<Hit<EdgePlace>> {
    let is_apart = |low, high| {
        motion
            .meeting(cubic, &Bracket::around(low, high))
            .is_apart()
    };
    cubic.decide_at_roots(is_apart, |bracket| {
        decide_at_root(positions, motion, cubic, bracket)
    })
}

/// Whether the edges touch at the root in a bracket.
#[inline(always)]
fn decide_at_root<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
    bracket: &Bracket,
) -> Finding<Hit<EdgePlace>> {
    let mut bracket = *bracket;
    let mut place = motion.meeting(cubic, &bracket).place();
    if let Place::Unclear = place {
        let Some((sharp, _)) = cubic.sharpen(&bracket) else {
            return Finding::Undecided;
        };
        bracket = sharp;
        place = motion.meeting(cubic, &bracket).place();
    }
    match place {
        Place::Apart => Finding::Miss,
        Place::Inside { .. } => Finding::of_certain(hit(positions, motion, cubic, &bracket)),
        Place::Unclear => decide_near_end(&positions(), motion, cubic, &bracket),
    }
}

/// Whether the edges touch at the root in a sharpened bracket where the lines meet near an edge's
/// end.
#[inline(never)]
fn decide_near_end<E: Ends>(
    positions: &Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
    bracket: &Bracket,
) -> Finding<Hit<EdgePlace>> {
    let Some(root) = Root::new(positions, cubic, bracket) else {
        return Finding::Undecided;
    };
    match root.meeting(positions, motion, cubic).place() {
        Place::Apart => Finding::Miss,
        place => {
            let toi = root.round_down();
            Finding::of_certain(toi.and_then(|toi| crossing(&bracket.from(toi), place)))
        }
    }
}

/// The contact at a root at which the lines meet inside both edges, if its time is certain.
fn hit<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
    bracket: &Bracket,
) -> Option<Hit<EdgePlace>> {
    let toi = Root::new(&positions(), cubic, bracket)?.round_down()?;
    EdgeEdge::crossing_at(motion, cubic, &bracket.from(toi))
}

/// The contact at a simple root between two neighbours in `f64`, strictly inside both edges.
///
/// `f` changes sign there and the lines meet at an angle: a crossing of general motion.
fn crossing(at: &Bracket, place: Place) -> Option<Hit<EdgePlace>> {
    let Place::Inside { u, v, error } = place else {
        return None;
    };
    if error > PLACE_ERROR {
        return None;
    }
    Some(Hit {
        toi: at.low,
        toi_above: at.high,
        kind: ContactKind::Crossing,
        side: if at.is_rising { -1 } else { 1 },
        case: Case::General,
        flags: Flags::default(),
        place: EdgeEdge::place(u, v, error),
    })
}

//! The certified path for a vertex and a face: the same cascade as for two edges.
//!
//! A vertex that touches a face is in its plane: with `K = C - B`, `L = D - B` and `M = A - B` the
//! cubic `f = (K x L) . M` is 0, so everything up to its roots is what edges need (`cubic`,
//! `root`). What is its own: the boxes and the direction (`separate`), and where the vertex is at a
//! root (`place`).
//!
//! Up to its sign `f` is that of any order of the four points. For the last bits of a root, and in
//! the exact stage, they are taken as the edges BC and AD, so that `refine` and `exact` are shared
//! as well.

mod place;
mod separate;

use std::cmp::Ordering;

use wide::f64x2;

use self::place::{Place, of_edges, raw_weights};
use super::cubic::Cubic;
use super::ends::Ends;
use super::exact::{self, Passage};
use super::kind::{Kind, Sealed, Stages, query_parts};
use super::motion::{Motion, Positions};
use super::nearest::{self, Gram, Spot};
use super::normal::{self, HasNormal, Normal};
use super::refine::Root;
use super::root::{Bracket, Half};
use super::separate::{SweptBoxes, U};
use super::stage::{Finding, Stage};
use crate::contact::{Case, ContactKind, FacePlace, Flags, Hit, PLACE_ERROR};
use crate::query::{EdgeEdge, Point, Radius, VertexFace};

impl Sealed for VertexFace {}

#[allow(private_interfaces, reason = "as of the trait")]
impl Kind for VertexFace {
    type Place = FacePlace;
    query_parts!();
}

impl HasNormal<FacePlace> for VertexFace {
    fn contact_radius(&self) -> Radius {
        self.radius()
    }

    fn normal_of(&self, hit: &Hit<FacePlace>) -> Option<Normal> {
        let positions = Positions::of(self.start(), self.end());
        normal::of_face(&positions, self.radius(), hit)
    }
}

impl Stages for VertexFace {
    type Place = FacePlace;
    type Query = Self;

    fn query(positions: &Positions, radius: Radius) -> Self {
        let Positions { start, end } = *positions;
        VertexFace::of(start.map(Point::from), end.map(Point::from), radius)
    }

    const FIRST: usize = 1;

    fn weights(place: &FacePlace) -> ([f64; 4], Option<[f64; 4]>) {
        let [b, c, d] = place.weights;
        ([1.0, b, c, d], None)
    }

    #[inline(always)]
    fn boxes<E: Ends>([a, b, c, d]: &[[E; 3]; 4], distance: f64) -> SweptBoxes {
        SweptBoxes::around([a], [b, c, d], distance)
    }

    #[inline(always)]
    fn motion<E: Ends>(points: &[[E; 3]; 4]) -> Motion<E> {
        separate::star(points)
    }

    #[inline(always)]
    fn is_separated_by_centres<E: Ends>(motion: &Motion<E>, boxes: &SweptBoxes) -> bool {
        separate::is_separated_by_centres(motion, boxes)
    }

    #[inline(always)]
    fn is_apart_in<E: Ends>(motion: &Motion<E>, cubic: &Cubic, half: &Half) -> bool {
        place::is_apart_in(motion, cubic, half)
    }

    #[inline(always)]
    fn decide_by_roots<E: Ends>(
        positions: impl Fn() -> Positions,
        _: impl Fn() -> SweptBoxes,
        motion: &Motion<E>,
        cubic: Option<&Cubic>,
        observe: &mut impl FnMut(Stage),
    ) -> Option<Hit<FacePlace>> {
        let finding = cubic.map_or(Finding::Undecided, |cubic| {
            decide_by_cubic(&positions, motion, cubic)
        });
        match finding {
            Finding::Hit(hit) => {
                observe(Stage::Roots);
                Some(hit)
            }
            Finding::Miss => {
                observe(Stage::Roots);
                None
            }
            Finding::Undecided => {
                observe(Stage::Exact);
                Self::decide_exactly(&positions())
            }
        }
    }

    #[inline(always)]
    fn touch_at<E: Ends>(motion: &Motion<E>, cubic: &Cubic, bracket: &Bracket) -> bool {
        raw_weights(motion, cubic, bracket).are_inside()
    }

    /// The same cubic, with the error bound that belongs to the edges.
    #[inline(always)]
    fn time_at<E: Ends>(points: &[[E; 3]; 4], _: &Cubic, bracket: &Bracket) -> (f64, bool) {
        let edges = edges_of(points);
        let cubic = Cubic::unchecked(&Motion::new(&edges));
        let (toi, is_certain) = EdgeEdge::time_at(&edges, &cubic, bracket);
        (toi, is_certain & cubic.is_valid())
    }

    #[inline(always)]
    fn crossing_at<E: Ends>(
        motion: &Motion<E>,
        cubic: &Cubic,
        at: &Bracket,
    ) -> Option<Hit<FacePlace>> {
        crossing(at, raw_weights(motion, cubic, at).place())
    }

    fn decide_exactly(positions: &Positions) -> Option<Hit<FacePlace>> {
        exact::decide_face(&as_edges(positions))
    }

    fn case(positions: &Positions) -> Case {
        exact::case_of_face(&as_edges(positions))
    }

    /// `K = B - C`, `L = D - B`, `M = B - A`: `u` and `v` are the weights of C and D.
    const DIFFERENCES: [(usize, usize); 3] = [(2, 1), (1, 3), (0, 1)];

    const CORNERS: &'static [(f64, f64)] = &[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)];

    const MIDDLE: (f64, f64) = (1.0 / 3.0, 1.0 / 3.0);

    #[inline(always)]
    fn least_corner<E: Ends>(k: E, l: E, m: E) -> E {
        let zero = E::both(0.0);
        m + l.smaller(zero - k).smaller(zero)
    }

    #[inline(always)]
    fn nearest(gram: &Gram) -> Spot {
        nearest::nearest_on_face(gram)
    }

    /// The weight of B is what the others leave of 1, rounded twice.
    fn place(u: f64, v: f64, error: f64) -> FacePlace {
        FacePlace {
            weights: [(1.0 - u - v).max(0.0), u, v],
            error: 2.0 * error + 4.0 * U,
        }
    }

    fn crosses_at<E: Ends>(points: &[[E; 3]; 4], cubic: &Cubic, bracket: &Bracket) -> Option<bool> {
        match raw_weights(&separate::star(points), cubic, bracket).place() {
            Place::Apart => Some(false),
            Place::Inside { .. } => Some(true),
            Place::Unclear => None,
        }
    }

    fn passage(positions: &Positions) -> Passage {
        exact::passage_of_face(&as_edges(positions))
    }

    fn side(positions: &Positions, toi: [f64; 2]) -> Option<i8> {
        exact::side_of_face(&as_edges(positions), toi)
    }

    fn compare_distance(positions: &Positions, radius: Radius, time: f64) -> Ordering {
        exact::compare_distance_of_face(positions, radius, time)
    }

    fn decide_thick_exactly(positions: &Positions, radius: Radius) -> Option<Hit<FacePlace>> {
        exact::decide_thick_face(positions, radius, || Self::passage(positions))
    }
}

/// The ends of the edges BC and AD.
fn as_edges(Positions { start, end }: &Positions) -> Positions {
    Positions {
        start: edges_of(start),
        end: edges_of(end),
    }
}

#[inline(always)]
fn edges_of<P: Copy>(&[a, b, c, d]: &[P; 4]) -> [P; 4] {
    [b, c, a, d]
}

/// A vertex in the face is in its plane: the first root of the cubic at which it is inside the face
/// is the contact. Undecided as soon as one root is not certain.
fn decide_by_cubic<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
) -> Finding<Hit<FacePlace>> {
    let is_apart = |low, high| raw_weights(motion, cubic, &Bracket::around(low, high)).are_apart();
    cubic.decide_at_roots(is_apart, |bracket| {
        decide_at_root(positions, motion, cubic, bracket)
    })
}

/// Whether the vertex touches the face at the root in a bracket.
#[inline(always)]
fn decide_at_root<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
    bracket: &Bracket,
) -> Finding<Hit<FacePlace>> {
    let mut bracket = *bracket;
    let mut place = raw_weights(motion, cubic, &bracket).place();
    if place == Place::Unclear {
        let Some((sharp, _)) = cubic.sharpen(&bracket) else {
            return Finding::Undecided;
        };
        bracket = sharp;
        place = raw_weights(motion, cubic, &bracket).place();
    }
    match place {
        Place::Apart => Finding::Miss,
        Place::Inside { .. } => Finding::of_certain(hit(positions, motion, cubic, &bracket)),
        Place::Unclear => decide_near_side(&positions(), &bracket),
    }
}

/// Whether the vertex touches the face at the root in a sharpened bracket, to twice the precision.
fn decide_near_side(positions: &Positions, bracket: &Bracket) -> Finding<Hit<FacePlace>> {
    let edges = as_edges(positions);
    let motion = Motion::new(&edges.points::<f64x2>());
    let Some(cubic) = Cubic::new(&motion) else {
        return Finding::Undecided;
    };
    let Some(root) = Root::new(&edges, &cubic, bracket) else {
        return Finding::Undecided;
    };
    match of_edges(&root.meeting(&edges, &motion, &cubic)).place() {
        Place::Apart => Finding::Miss,
        place => {
            let toi = root.round_down();
            Finding::of_certain(toi.and_then(|toi| crossing(&bracket.from(toi), place)))
        }
    }
}

/// The contact at a root at which the vertex is inside the face, if its time is certain.
fn hit<E: Ends>(
    positions: &impl Fn() -> Positions,
    motion: &Motion<E>,
    cubic: &Cubic,
    bracket: &Bracket,
) -> Option<Hit<FacePlace>> {
    let edges = as_edges(&positions());
    // The same cubic, with the error bound that belongs to the edges.
    let edge_cubic = Cubic::new(&Motion::new(&edges.points::<f64x2>()))?;
    let toi = Root::new(&edges, &edge_cubic, bracket)?.round_down()?;
    VertexFace::crossing_at(motion, cubic, &bracket.from(toi))
}

/// The contact at a simple root between two neighbours in `f64`, strictly inside the face: `f`
/// changes its sign.
fn crossing(at: &Bracket, place: Place) -> Option<Hit<FacePlace>> {
    let Place::Inside { weights, error } = place else {
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
        place: FacePlace { weights, error },
    })
}

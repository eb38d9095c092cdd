//! The two kinds of queries, two edges or a vertex and a face: what the stages ask of them.

use std::cmp::Ordering;
use std::fmt::Debug;

use super::cubic::Cubic;
use super::ends::Ends;
use super::exact::Passage;
use super::motion::{Motion, Positions};
use super::nearest::{Gram, Spot};
use super::normal::HasNormal;
use super::root::{Bracket, Half};
use super::separate::SweptBoxes;
use super::stage::Stage;
use crate::contact::{Case, Hit, Place};
use crate::query::{Point, Radius};

/// A kind of query that the certified path decides: [`EdgeEdge`](crate::query::EdgeEdge) or
/// [`VertexFace`](crate::query::VertexFace).
///
/// The trait is sealed: no other type can be one. `decide`, `Pairs` and `Batch` take either.
pub trait Kind: Sealed + HasNormal<<Self as Kind>::Place> + Copy + Send + Sync + 'static {
    /// Where the two sides touch: [`EdgePlace`](crate::contact::EdgePlace) or
    /// [`FacePlace`](crate::contact::FacePlace).
    type Place: Copy + Debug + PartialEq + Send + Sync + Into<Place> + 'static;

    #[doc(hidden)]
    #[allow(private_bounds, reason = "only the stages of this module use it")]
    type Stages: Stages<Place = Self::Place, Query = Self>;

    /// The four points at `t = 0`.
    fn start(&self) -> &[Point; 4];

    /// The four points at `t = 1`.
    fn end(&self) -> &[Point; 4];

    /// The distance at which the two sides count as touching.
    fn radius(&self) -> Radius;
}

/// Implemented for the two kinds alone.
pub trait Sealed {}

/// A kind of query, as the stages see it: functions of its motion. They are apart from [`Kind`], so
/// that code generic over a kind meets no names but those of the interface.
///
/// The first are of a query, those after them of a motion without a radius, the last ones of a
/// motion with one.
pub(super) trait Stages: 'static {
    /// Where the two sides touch.
    type Place: Copy + 'static;

    /// The kind itself.
    type Query;

    /// The query of finite coordinates and a valid radius.
    fn query(positions: &Positions, radius: Radius) -> Self::Query;

    /// How many of the four points are of the first side.
    const FIRST: usize;

    /// The weights of A, B, C and D in the places of a contact.
    fn weights(place: &Self::Place) -> ([f64; 4], Option<[f64; 4]>);

    /// The swept boxes, disjoint if they are farther apart than a distance.
    fn boxes<E: Ends>(points: &[[E; 3]; 4], distance: f64) -> SweptBoxes;

    /// The differences with which contact is where `f` is 0.
    fn motion<E: Ends>(points: &[[E; 3]; 4]) -> Motion<E>;

    /// Whether the direction from one middle to the other separates the two.
    fn is_separated_by_centres<E: Ends>(motion: &Motion<E>, boxes: &SweptBoxes) -> bool;

    /// Whether the two certainly do not touch at a root in a half of the step.
    fn is_apart_in<E: Ends>(motion: &Motion<E>, cubic: &Cubic, half: &Half) -> bool;

    /// The stages from the roots of the cubic on.
    fn decide_by_roots<E: Ends>(
        positions: impl Fn() -> Positions,
        boxes: impl Fn() -> SweptBoxes,
        motion: &Motion<E>,
        cubic: Option<&Cubic>,
        observe: &mut impl FnMut(Stage),
    ) -> Option<Hit<Self::Place>>;

    /// Whether the two certainly touch at the root in a bracket, strictly inside.
    fn touch_at<E: Ends>(motion: &Motion<E>, cubic: &Cubic, bracket: &Bracket) -> bool;

    /// The time of impact at the root in a bracket, if the two touch there, and whether it is
    /// certain, without a branch.
    fn time_at<E: Ends>(points: &[[E; 3]; 4], cubic: &Cubic, bracket: &Bracket) -> (f64, bool);

    /// The contact at the root between two neighbours in `f64`, the first one at which the two may
    /// touch, if they certainly do, strictly inside.
    fn crossing_at<E: Ends>(
        motion: &Motion<E>,
        cubic: &Cubic,
        at: &Bracket,
    ) -> Option<Hit<Self::Place>>;

    /// The answer of integers.
    fn decide_exactly(positions: &Positions) -> Option<Hit<Self::Place>>;

    /// The case of the motion, decided in integers.
    fn case(positions: &Positions) -> Case;

    /// From which of A, B, C and D to which one `K`, `L` and `M` are with a radius: the vectors
    /// from a point of the first side to one of the second are `M + v L - u K`.
    const DIFFERENCES: [(usize, usize); 3];

    /// The corners of the set of `(u, v)`; each number is 0 or 1.
    const CORNERS: &'static [(f64, f64)];

    /// The mean of the corners.
    const MIDDLE: (f64, f64);

    /// The least product of a corner with a vector, from those of `K`, `L` and `M`.
    fn least_corner<E: Ends>(k: E, l: E, m: E) -> E;

    /// About where the difference is nearest to 0.
    fn nearest(gram: &Gram) -> Spot;

    /// The nearest places on the boundary, a side each, as far as a kind asks for them.
    fn nearest_on_sides(_gram: &Gram) -> impl IntoIterator<Item = Spot> {
        []
    }

    /// The place of `(u, v)` up to an error.
    fn place(u: f64, v: f64, error: f64) -> Self::Place;

    /// Whether the two sides without their radius touch strictly inside at a root of `f`, if that
    /// is certain.
    fn crosses_at<E: Ends>(points: &[[E; 3]; 4], cubic: &Cubic, bracket: &Bracket) -> Option<bool>;

    /// What integers say of the two sides without their radius.
    fn passage(positions: &Positions) -> Passage;

    /// What integers say of the sign of `f` just before a time of impact above 0 with these
    /// neighbours in `f64`; `None` if there may be a root of `f`.
    fn side(positions: &Positions, toi: [f64; 2]) -> Option<i8>;

    /// Whether the two are certainly parallel for the whole step, as far as a kind asks for that.
    fn are_always_parallel(_positions: &Positions) -> bool {
        false
    }

    /// The contact at a time of impact, 0 or of two that are always parallel, where they are
    /// parallel or one is a point. The neighbours of the time in `f64` are given; at 0 they are
    /// within the radius.
    fn contact_of_parallel(_positions: &Positions, _toi: [f64; 2]) -> Option<Hit<Self::Place>> {
        None
    }

    /// The distance at a time in `[0, 1]` compared with a radius above 0, in integers.
    fn compare_distance(positions: &Positions, radius: Radius, time: f64) -> Ordering;

    /// The answer of integers with a radius above 0.
    fn decide_thick_exactly(positions: &Positions, radius: Radius) -> Option<Hit<Self::Place>>;
}

/// The parts of a query that its type itself knows.
macro_rules! query_parts {
    () => {
        type Stages = Self;

        fn start(&self) -> &[Point; 4] {
            self.start()
        }

        fn end(&self) -> &[Point; 4] {
            self.end()
        }

        fn radius(&self) -> Radius {
            self.radius()
        }
    };
}

pub(super) use query_parts;

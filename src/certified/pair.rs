//! The two kinds of queries as the first stages see them: four points in two sets, which are two edges or
//! a vertex and a face.

use super::cascade::{self, Stage};
use super::cubic::Cubic;
use super::ends::Ends;
use super::face::{self, FaceHit};
use super::motion::{Motion, Positions};
use super::root::Half;
use super::separate::SweptBoxes;
use super::thick;
use super::verdict::{Hit, Verdict};
use crate::query::{EdgeEdge, Point, QueryError, Radius, VertexFace};

/// A kind of query that a [`PairBatch`](super::PairBatch) holds: [`EdgeEdge`] or [`VertexFace`].
pub trait Batched {
    /// The first contact of a step.
    type Hit: Send;
}

impl Batched for EdgeEdge {
    type Hit = Hit;
}

impl Batched for VertexFace {
    type Hit = FaceHit;
}

/// A kind of query, as the stages see it.
pub(super) trait Pair: Batched + Sized {
    /// The same with a radius.
    type Thick: thick::Kind<Hit = Self::Hit>;

    fn of_points(start: [Point; 4], end: [Point; 4], radius: Radius) -> Result<Self, QueryError>;

    /// The points at both ends of the step and the radius.
    fn parts(&self) -> ([&[Point; 4]; 2], Radius);

    fn boxes<E: Ends>(points: &[[E; 3]; 4]) -> SweptBoxes;

    /// The differences with which contact is where `f` is 0.
    fn motion<E: Ends>(points: &[[E; 3]; 4]) -> Motion<E>;

    /// Whether the direction from one middle to the other separates the two.
    fn is_separated_by_centres<E: Ends>(motion: &Motion<E>, boxes: &SweptBoxes) -> bool;

    /// Whether the two certainly do not touch at a root in a half of the step.
    fn is_apart_in<E: Ends>(motion: &Motion<E>, cubic: &Cubic, half: &Half) -> bool;

    /// All stages.
    fn decide_all(
        positions: impl Fn() -> Positions,
        observe: &mut impl FnMut(Stage),
    ) -> Option<Self::Hit>;

    /// The stages after the first two.
    fn decide_rest(
        positions: impl Fn() -> Positions,
        observe: &mut impl FnMut(Stage),
    ) -> Option<Self::Hit>;
}

macro_rules! points_and_radius {
    () => {
        fn of_points(
            start: [Point; 4],
            end: [Point; 4],
            radius: Radius,
        ) -> Result<Self, QueryError> {
            Self::new(start, end, radius)
        }

        fn parts(&self) -> ([&[Point; 4]; 2], Radius) {
            ([self.start(), self.end()], self.radius())
        }
    };
}

impl Pair for EdgeEdge {
    type Thick = thick::Edges;

    points_and_radius!();

    #[inline(always)]
    fn boxes<E: Ends>(points: &[[E; 3]; 4]) -> SweptBoxes {
        SweptBoxes::new(points)
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

    #[inline(always)]
    fn decide_all(
        positions: impl Fn() -> Positions,
        observe: &mut impl FnMut(Stage),
    ) -> Option<Hit> {
        hit(cascade::decide_all(positions, observe))
    }

    fn decide_rest(
        positions: impl Fn() -> Positions,
        observe: &mut impl FnMut(Stage),
    ) -> Option<Hit> {
        hit(cascade::decide_rest(positions, observe))
    }
}

fn hit(verdict: Verdict) -> Option<Hit> {
    match verdict {
        Verdict::Miss => None,
        Verdict::Hit(hit) => Some(hit),
    }
}

impl Pair for VertexFace {
    type Thick = thick::Face;

    points_and_radius!();

    #[inline(always)]
    fn boxes<E: Ends>(points: &[[E; 3]; 4]) -> SweptBoxes {
        face::boxes(points)
    }

    #[inline(always)]
    fn motion<E: Ends>(points: &[[E; 3]; 4]) -> Motion<E> {
        face::star(points)
    }

    #[inline(always)]
    fn is_separated_by_centres<E: Ends>(motion: &Motion<E>, boxes: &SweptBoxes) -> bool {
        face::is_separated_by_centres(motion, boxes)
    }

    #[inline(always)]
    fn is_apart_in<E: Ends>(motion: &Motion<E>, cubic: &Cubic, half: &Half) -> bool {
        face::is_apart_in(motion, cubic, half)
    }

    #[inline(always)]
    fn decide_all(
        positions: impl Fn() -> Positions,
        observe: &mut impl FnMut(Stage),
    ) -> Option<FaceHit> {
        face::decide_all(positions, observe)
    }

    fn decide_rest(
        positions: impl Fn() -> Positions,
        observe: &mut impl FnMut(Stage),
    ) -> Option<FaceHit> {
        face::decide_rest(positions, observe)
    }
}

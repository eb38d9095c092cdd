//! The kinds of queries.

use super::error::RigidError;
use super::kind::{Lengths, RigidQueryKind};
use super::motion::{Pose, RigidMotion};
use super::side::Side;
use crate::query::{Point, Radius};

/// A moving edge `AB` and an edge `CD` of a turning body: do they come within `radius` of each other
/// during the step?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeTurningEdge {
    start: [Point; 2],
    end: [Point; 2],
    local: [Point; 2],
    motion: RigidMotion,
    radius: Radius,
}

/// A moving vertex `A` and a face `BCD` of a turning body: do they come within `radius` of each other
/// during the step?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexTurningFace {
    start: [Point; 1],
    end: [Point; 1],
    local: [Point; 3],
    motion: RigidMotion,
    radius: Radius,
}

/// An edge `AB` of a turning body and an edge `CD` of another one: do they come within `radius` of
/// each other during the step?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningEdgeTurningEdge {
    locals: ([Point; 2], [Point; 2]),
    motions: [RigidMotion; 2],
    radius: Radius,
}

/// A vertex `A` of a turning body and a face `BCD` of another one: do they come within `radius` of
/// each other during the step?
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurningVertexTurningFace {
    locals: ([Point; 1], [Point; 3]),
    motions: [RigidMotion; 2],
    radius: Radius,
}

/// Any of these kinds of queries, for collections of all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RigidQuery {
    /// Edge against an edge of a turning body.
    EdgeTurningEdge(EdgeTurningEdge),
    /// Vertex against a face of a turning body.
    VertexTurningFace(VertexTurningFace),
    /// Edge of a turning body against an edge of another one.
    TurningEdgeTurningEdge(TurningEdgeTurningEdge),
    /// Vertex of a turning body against a face of another one.
    TurningVertexTurningFace(TurningVertexTurningFace),
}

/// What all kinds have.
macro_rules! query {
    ($kind:ident) => {
        impl $kind {
            /// The distance at which the two count as touching; 0 asks for the midlines and the
            /// face themselves.
            pub fn radius(&self) -> Radius {
                self.radius
            }

            /// All four points in space at a time in `[0, 1]`, rounded.
            pub fn positions(&self, t: f64) -> [Point; 4] {
                positions(&self.sides(), t)
            }

            /// The point in space of the first side with these
            /// [weights](crate::contact::Place::weights) of A, B, C and D, at a time in `[0, 1]`,
            /// rounded.
            pub fn point(&self, weights: &[f64; 4], t: f64) -> Point {
                point(&self.sides(), weights, t)
            }
        }

        impl From<$kind> for RigidQuery {
            fn from(query: $kind) -> Self {
                RigidQuery::$kind(query)
            }
        }
    };
}

/// A side that moves on straight lines and one of a body.
macro_rules! one_body {
    ($kind:ident, $first:literal, $second:literal, $says:literal) => {
        impl $kind {
            #[doc = $says]
            ///
            /// They touch where they share a point; [`with_radius`](Self::with_radius) asks for
            /// contact at a distance.
            ///
            /// # Errors
            ///
            /// [`RigidError`] names the first coordinate that is NaN or infinite.
            pub fn new(
                start: [Point; $first],
                end: [Point; $first],
                local: [Point; $second],
                motion: RigidMotion,
            ) -> Result<Self, RigidError> {
                Self::with_radius(start, end, local, motion, Radius::ZERO)
            }

            /// As [`new`](Self::new), with the distance in metres at which the two count as
            /// touching: one number, or two of which the exact sum is meant.
            ///
            /// # Errors
            ///
            /// [`RigidError`] names the first coordinate that is NaN or infinite, or a radius that
            /// is not a finite number of at least 0.
            pub fn with_radius(
                start: [Point; $first],
                end: [Point; $first],
                local: [Point; $second],
                motion: RigidMotion,
                radius: impl Into<Radius>,
            ) -> Result<Self, RigidError> {
                let query = $kind {
                    start,
                    end,
                    local,
                    motion,
                    radius: radius.into(),
                };
                check(&query.sides(), query.radius)?;
                Ok(query)
            }

            /// The points in space at `t = 0`.
            pub fn start(&self) -> &[Point; $first] {
                &self.start
            }

            /// The points in space at `t = 1`.
            pub fn end(&self) -> &[Point; $first] {
                &self.end
            }

            /// The points in the body's frame.
            pub fn local(&self) -> &[Point; $second] {
                &self.local
            }

            /// The motion of the body.
            pub fn motion(&self) -> &RigidMotion {
                &self.motion
            }

            /// Both sides: the first one moves on straight lines.
            pub fn sides(&self) -> [Side<'_>; 2] {
                let first = Side::Straight {
                    start: &self.start,
                    end: &self.end,
                };
                [first, turning(&self.local, &self.motion)]
            }
        }

        query!($kind);
    };
}

/// Two sides of a body each.
macro_rules! two_bodies {
    ($kind:ident, $first:literal, $second:literal, $says:literal) => {
        impl $kind {
            #[doc = $says]
            /// Each is given in the frame of its body, with the motion of that.
            ///
            /// They touch where they share a point; [`with_radius`](Self::with_radius) asks for
            /// contact at a distance.
            ///
            /// # Errors
            ///
            /// [`RigidError`] names the first coordinate that is NaN or infinite.
            pub fn new(
                first: [Point; $first],
                first_motion: RigidMotion,
                second: [Point; $second],
                second_motion: RigidMotion,
            ) -> Result<Self, RigidError> {
                Self::with_radius(first, first_motion, second, second_motion, Radius::ZERO)
            }

            /// As [`new`](Self::new), with the distance in metres at which the two count as
            /// touching: one number, or two of which the exact sum is meant.
            ///
            /// # Errors
            ///
            /// [`RigidError`] names the first coordinate that is NaN or infinite, or a radius that
            /// is not a finite number of at least 0.
            pub fn with_radius(
                first: [Point; $first],
                first_motion: RigidMotion,
                second: [Point; $second],
                second_motion: RigidMotion,
                radius: impl Into<Radius>,
            ) -> Result<Self, RigidError> {
                let query = $kind {
                    locals: (first, second),
                    motions: [first_motion, second_motion],
                    radius: radius.into(),
                };
                check(&query.sides(), query.radius)?;
                Ok(query)
            }

            /// The points in the frame of the first body.
            pub fn first(&self) -> &[Point; $first] {
                &self.locals.0
            }

            /// The points in the frame of the second body.
            pub fn second(&self) -> &[Point; $second] {
                &self.locals.1
            }

            /// The motions of the first and of the second body.
            pub fn motions(&self) -> &[RigidMotion; 2] {
                &self.motions
            }

            /// Both sides.
            pub fn sides(&self) -> [Side<'_>; 2] {
                let [first, second] = &self.motions;
                [
                    turning(&self.locals.0, first),
                    turning(&self.locals.1, second),
                ]
            }
        }

        query!($kind);
    };
}

one_body!(
    EdgeTurningEdge,
    2,
    2,
    "The query of an edge AB, given at `t = 0` and `t = 1`, and an edge CD in the body's frame."
);
one_body!(
    VertexTurningFace,
    1,
    3,
    "The query of a vertex A, given at `t = 0` and `t = 1`, and a face BCD in the body's frame."
);
two_bodies!(
    TurningEdgeTurningEdge,
    2,
    2,
    "The query of an edge AB of a body and an edge CD of another one."
);
two_bodies!(
    TurningVertexTurningFace,
    1,
    3,
    "The query of a vertex A of a body and a face BCD of another one."
);

fn turning<'a>(local: &'a [Point], motion: &'a RigidMotion) -> Side<'a> {
    Side::Turning { local, motion }
}

fn check(sides: &[Side<'_>; 2], radius: Radius) -> Result<(), RigidError> {
    let [first, second] = sides;
    first.check(0)?;
    second.check(first.number_of_points())?;
    match radius.is_valid() {
        true => Ok(()),
        false => Err(RigidError::Radius(radius)),
    }
}

/// The point of the first side with these weights of all four points.
fn point(sides: &[Side<'_>; 2], weights: &[f64; 4], t: f64) -> Point {
    let [side, _] = sides;
    let part = |i: usize| side.position(i, t).coords * weights[i];
    let rest = (1..side.number_of_points()).map(part);
    Point::from(rest.fold(part(0), |sum, part| sum + part))
}

fn positions(sides: &[Side<'_>; 2], t: f64) -> [Point; 4] {
    let [first, second] = sides;
    let count = first.number_of_points();
    std::array::from_fn(|i| match i < count {
        true => first.position(i, t),
        false => second.position(i - count, t),
    })
}

impl RigidQuery {
    /// The query of two sides, of which the second one turns: two points against two, edges, or one
    /// against three, a vertex and a face.
    ///
    /// # Errors
    ///
    /// [`RigidError`] if there is no such kind of query, or as the kind's own `with_radius`.
    pub fn new(
        [first, second]: [Side<'_>; 2],
        radius: impl Into<Radius>,
    ) -> Result<Self, RigidError> {
        let Side::Turning { local, motion } = second else {
            return Err(RigidError::SecondSide);
        };
        let no_kind = RigidError::NumberOfPoints {
            first: first.number_of_points(),
            second: second.number_of_points(),
        };
        match first {
            Side::Straight { start, end } => match (start, end, local) {
                (&[a, b], &[c, d], &[e, f]) => {
                    EdgeTurningEdge::with_radius([a, b], [c, d], [e, f], *motion, radius)
                        .map(Self::from)
                }
                (&[a], &[b], &[c, d, e]) => {
                    VertexTurningFace::with_radius([a], [b], [c, d, e], *motion, radius)
                        .map(Self::from)
                }
                _ => Err(no_kind),
            },
            Side::Turning {
                local: own,
                motion: of_first,
            } => match (own, local) {
                (&[a, b], &[c, d]) => {
                    TurningEdgeTurningEdge::with_radius([a, b], *of_first, [c, d], *motion, radius)
                        .map(Self::from)
                }
                (&[a], &[b, c, d]) => TurningVertexTurningFace::with_radius(
                    [a],
                    *of_first,
                    [b, c, d],
                    *motion,
                    radius,
                )
                .map(Self::from),
                _ => Err(no_kind),
            },
        }
    }

    /// The query of a kind from lists of points and poses, as files and arrays have them; what is in
    /// which, and how long they are, says [`RigidQueryKind::lengths`].
    ///
    /// # Errors
    ///
    /// [`RigidError`] if a list has another length, or as [`RigidMotion::new`] and the kind's own
    /// `with_radius`.
    pub fn from_lists(
        kind: RigidQueryKind,
        points: &[Point],
        local: &[Point],
        poses: &[Pose],
        radius: impl Into<Radius>,
    ) -> Result<Self, RigidError> {
        let lengths = Lengths {
            points: points.len(),
            local: local.len(),
            poses: poses.len(),
        };
        if lengths != kind.lengths() {
            return Err(RigidError::Lengths { kind, lengths });
        }
        let motions = poses.chunks_exact(2);
        let motions = motions.map(|pair| RigidMotion::new(pair[0], pair[1]));
        let motions: Vec<RigidMotion> = motions.collect::<Result<_, _>>()?;
        let (start, end) = points.split_at(points.len() / 2);
        let sides = match &motions[..] {
            [motion] => [Side::Straight { start, end }, turning(local, motion)],
            [first, second, ..] => {
                let (own, other) = local.split_at(kind.first());
                [turning(own, first), turning(other, second)]
            }
            [] => return Err(RigidError::Lengths { kind, lengths }),
        };
        Self::new(sides, radius)
    }

    /// Which kind it is.
    pub fn kind(&self) -> RigidQueryKind {
        match self {
            RigidQuery::EdgeTurningEdge(_) => RigidQueryKind::EdgeTurningEdge,
            RigidQuery::VertexTurningFace(_) => RigidQueryKind::VertexTurningFace,
            RigidQuery::TurningEdgeTurningEdge(_) => RigidQueryKind::TurningEdgeTurningEdge,
            RigidQuery::TurningVertexTurningFace(_) => RigidQueryKind::TurningVertexTurningFace,
        }
    }

    /// Both sides; the second one turns.
    pub fn sides(&self) -> [Side<'_>; 2] {
        match self {
            RigidQuery::EdgeTurningEdge(query) => query.sides(),
            RigidQuery::VertexTurningFace(query) => query.sides(),
            RigidQuery::TurningEdgeTurningEdge(query) => query.sides(),
            RigidQuery::TurningVertexTurningFace(query) => query.sides(),
        }
    }

    /// The distance at which the two count as touching.
    pub fn radius(&self) -> Radius {
        match self {
            RigidQuery::EdgeTurningEdge(query) => query.radius(),
            RigidQuery::VertexTurningFace(query) => query.radius(),
            RigidQuery::TurningEdgeTurningEdge(query) => query.radius(),
            RigidQuery::TurningVertexTurningFace(query) => query.radius(),
        }
    }

    /// All four points in space at a time in `[0, 1]`, rounded.
    pub fn positions(&self, t: f64) -> [Point; 4] {
        positions(&self.sides(), t)
    }

    /// The point in space of the first side with these
    /// [weights](crate::contact::Place::weights) of A, B, C and D, at a time in `[0, 1]`, rounded.
    pub fn point(&self, weights: &[f64; 4], t: f64) -> Point {
        point(&self.sides(), weights, t)
    }
}

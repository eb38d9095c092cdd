//! What is asked: one time step of four points that move on straight lines.
//!
//! A query holds the points at both ends of the step; in between, `X(t) = (1 - t) X(0) + t X(1)`
//! with `t` in `[0, 1]`. Positions are stored, not velocities: `X(1) - X(0)` rounds, so `X(0)`
//! and a rounded velocity would be a different motion from the one the simulator made.
//!
//! ```
//! use tunnelproof::query::{EdgeEdge, Point, QueryError};
//!
//! let p = Point::new;
//! let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, -1.0, 1.0), p(0.0, 1.0, 1.0)];
//! let mut end = start;
//! end[2].z = -1.0;
//! end[3].z = -1.0;
//! // Two wires of 1 cm and 2 cm: the radius is the exact sum, which is never rounded.
//! let query = EdgeEdge::new(start, end, [0.01, 0.02])?;
//! assert_eq!(query.end()[3].z, -1.0);
//!
//! end[2].z = f64::NAN;
//! let error = EdgeEdge::new(start, end, 0.0).expect_err("a coordinate is NaN");
//! assert_eq!(error.to_string(), "z of point C at t = 1 is NaN, not a finite number");
//! # Ok::<(), QueryError>(())
//! ```

use std::fmt;

use nalgebra::Point3;

mod radius;
mod shown;

pub use radius::Radius;
pub(crate) use shown::{Counted, Short};

/// A point in space, coordinates in metres.
pub type Point = Point3<f64>;

/// Two moving edges `AB` and `CD`: do they come within `radius` of each other during the step?
///
/// Points are in the order A, B, C, D. All coordinates are finite and the radii are finite and not
/// negative; [`EdgeEdge::new`] sees to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeEdge {
    start: [Point; 4],
    end: [Point; 4],
    radius: Radius,
}

/// A moving vertex `A` and a moving face `BCD`: do they come within `radius` of each other?
///
/// Points are in the order A (vertex), B, C, D (corners). Finite like [`EdgeEdge`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VertexFace {
    start: [Point; 4],
    end: [Point; 4],
    radius: Radius,
}

/// Either kind of query, for collections of both. `decide` takes the query inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Query {
    /// Edge against edge.
    EdgeEdge(EdgeEdge),
    /// Vertex against face.
    VertexFace(VertexFace),
}

/// The kind of a query, without its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum QueryKind {
    /// Edge against edge; written `edge-edge`.
    EdgeEdge,
    /// Vertex against face; written `vertex-face`.
    VertexFace,
}

/// Why eight points and a radius are not a query.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum QueryError {
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Which of the four points, 0 to 3 for A to D.
        point: usize,
        /// Whether it is the position at the end of the step (`t = 1`) or at its start (`t = 0`).
        at_end: bool,
        /// Which coordinate, 0 to 2 for x to z.
        axis: usize,
        /// The value refused.
        value: f64,
    },
    /// A radius is NaN, infinite or negative.
    Radius(Radius),
}

macro_rules! four_points {
    ($kind:ident) => {
        impl $kind {
            /// The query of four points given at `t = 0` and `t = 1`, in metres, and of a radius or
            /// of two.
            ///
            /// # Errors
            ///
            /// [`QueryError`] names the first coordinate that is NaN or infinite, or a radius that
            /// is not a finite number of at least 0.
            pub fn new(
                start: [Point; 4],
                end: [Point; 4],
                radius: impl Into<Radius>,
            ) -> Result<Self, QueryError> {
                let radius = radius.into();
                check(&start, &end, radius)?;
                Ok(Self { start, end, radius })
            }

            /// The query of finite coordinates and a valid radius.
            #[inline(always)]
            pub(crate) fn of(start: [Point; 4], end: [Point; 4], radius: Radius) -> Self {
                debug_assert_eq!(check(&start, &end, radius), Ok(()));
                Self { start, end, radius }
            }

            /// The query of four points that do not move, in metres.
            ///
            /// # Errors
            ///
            /// As [`new`](Self::new).
            pub fn at_rest(
                points: [Point; 4],
                radius: impl Into<Radius>,
            ) -> Result<Self, QueryError> {
                Self::new(points, points, radius)
            }

            /// The four points at `t = 0`.
            pub fn start(&self) -> &[Point; 4] {
                &self.start
            }

            /// The four points at `t = 1`.
            pub fn end(&self) -> &[Point; 4] {
                &self.end
            }

            /// The distance at which the two count as touching; 0 asks for the midlines
            /// themselves.
            pub fn radius(&self) -> Radius {
                self.radius
            }
        }
    };
}

four_points!(EdgeEdge);
four_points!(VertexFace);

impl Query {
    /// A query of the given kind; see [`EdgeEdge::new`].
    ///
    /// # Errors
    ///
    /// As [`EdgeEdge::new`].
    pub fn new(
        kind: QueryKind,
        start: [Point; 4],
        end: [Point; 4],
        radius: impl Into<Radius>,
    ) -> Result<Self, QueryError> {
        match kind {
            QueryKind::EdgeEdge => EdgeEdge::new(start, end, radius).map(Query::EdgeEdge),
            QueryKind::VertexFace => VertexFace::new(start, end, radius).map(Query::VertexFace),
        }
    }

    /// Which kind it is.
    pub fn kind(&self) -> QueryKind {
        match self {
            Query::EdgeEdge(_) => QueryKind::EdgeEdge,
            Query::VertexFace(_) => QueryKind::VertexFace,
        }
    }

    /// The query, if it is of two edges.
    pub fn as_edge_edge(&self) -> Option<&EdgeEdge> {
        match self {
            Query::EdgeEdge(query) => Some(query),
            Query::VertexFace(_) => None,
        }
    }

    /// The query, if it is of a vertex and a face.
    pub fn as_vertex_face(&self) -> Option<&VertexFace> {
        match self {
            Query::VertexFace(query) => Some(query),
            Query::EdgeEdge(_) => None,
        }
    }

    /// The four points at `t = 0`.
    pub fn start(&self) -> &[Point; 4] {
        match self {
            Query::EdgeEdge(q) => q.start(),
            Query::VertexFace(q) => q.start(),
        }
    }

    /// The four points at `t = 1`.
    pub fn end(&self) -> &[Point; 4] {
        match self {
            Query::EdgeEdge(q) => q.end(),
            Query::VertexFace(q) => q.end(),
        }
    }

    /// The distance at which the two count as touching.
    pub fn radius(&self) -> Radius {
        match self {
            Query::EdgeEdge(q) => q.radius(),
            Query::VertexFace(q) => q.radius(),
        }
    }
}

pub(crate) fn check(
    start: &[Point; 4],
    end: &[Point; 4],
    radius: Radius,
) -> Result<(), QueryError> {
    for (at_end, points) in [(false, start), (true, end)] {
        for (point, position) in points.iter().enumerate() {
            for (axis, &value) in position.coords.iter().enumerate() {
                if !value.is_finite() {
                    return Err(QueryError::NotFinite {
                        point,
                        at_end,
                        axis,
                        value,
                    });
                }
            }
        }
    }
    if !radius.is_valid() {
        return Err(QueryError::Radius(radius));
    }
    Ok(())
}

impl QueryKind {
    /// The name used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            QueryKind::EdgeEdge => "edge-edge",
            QueryKind::VertexFace => "vertex-face",
        }
    }

    /// The kind with this [`name`](Self::name), if any.
    pub fn from_name(name: &str) -> Option<Self> {
        [QueryKind::EdgeEdge, QueryKind::VertexFace]
            .into_iter()
            .find(|kind| kind.name() == name)
    }
}

impl fmt::Display for QueryKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for QueryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            QueryError::NotFinite {
                point,
                at_end,
                axis,
                value,
            } => {
                let point = ['A', 'B', 'C', 'D'][point];
                let axis = ['x', 'y', 'z'][axis];
                let time = u8::from(at_end);
                write!(
                    f,
                    "{axis} of point {point} at t = {time} is {value}, not a finite number"
                )
            }
            QueryError::Radius(value) => {
                let [_, second] = value.parts();
                let has = if second == 0.0 { "it has" } else { "both have" };
                write!(
                    f,
                    "the radius is {value}; {has} to be finite, and 0 or more"
                )
            }
        }
    }
}

impl std::error::Error for QueryError {}

/// What positions are stored in: `f64` or `f32`. Every `f32` is an `f64`, so nothing is rounded where
/// positions are asked about. Those that a step returns are rounded to this type, and proved so.
pub trait Coordinate:
    Copy + PartialEq + fmt::Debug + Send + Sync + Into<f64> + sealed::Sealed
{
}

impl Coordinate for f64 {}

impl Coordinate for f32 {}

mod sealed {
    pub trait Sealed {
        /// Whether it is `f32`.
        const IS_SINGLE: bool;

        /// A number of this type, from an `f64` that is one.
        fn of(x: f64) -> Self;

        /// The number in `f32`: itself, if it is one.
        fn single(self) -> f32;
    }

    impl Sealed for f64 {
        const IS_SINGLE: bool = false;

        #[inline(always)]
        fn of(x: f64) -> Self {
            x
        }

        #[inline(always)]
        fn single(self) -> f32 {
            self as f32
        }
    }

    impl Sealed for f32 {
        const IS_SINGLE: bool = true;

        #[inline(always)]
        fn of(x: f64) -> Self {
            let single = x as f32;
            debug_assert_eq!(f64::from(single), x);
            single
        }

        #[inline(always)]
        fn single(self) -> f32 {
            self
        }
    }
}

/// A position in `f64`, exactly.
#[inline(always)]
pub(crate) fn widened<C: Coordinate>(position: &[C; 3]) -> [f64; 3] {
    position.map(Into::into)
}

/// The first coordinate that is not a finite number: of which position, on which axis, and what it
/// is.
pub(crate) fn first_not_finite<C: Coordinate>(positions: &[[C; 3]]) -> Option<(usize, usize, f64)> {
    let mut all = positions.iter().enumerate();
    all.find_map(|(place, position)| {
        let position = widened(position);
        let axis = position.iter().position(|x| !x.is_finite())?;
        Some((place, axis, position[axis]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn query_new_names_the_coordinate_that_is_not_finite() {
        let zero = [Point::origin(); 4];
        let mut end = zero;
        end[2].y = f64::NAN;
        let error = EdgeEdge::new(zero, end, 0.0).unwrap_err();
        assert_eq!(
            error.to_string(),
            "y of point C at t = 1 is NaN, not a finite number"
        );
        let mut start = zero;
        start[3].z = f64::NEG_INFINITY;
        let error = VertexFace::new(start, zero, 0.0).unwrap_err();
        assert_eq!(
            error.to_string(),
            "z of point D at t = 0 is -inf, not a finite number"
        );
    }

    #[test]
    fn query_new_refuses_a_radius_below_zero_or_not_finite() {
        let zero = [Point::origin(); 4];
        for radius in [-1.0, -f64::MIN_POSITIVE, f64::NAN, f64::INFINITY] {
            for parts in [[radius, 0.0], [0.0, radius], [1.0, radius]] {
                let error = EdgeEdge::new(zero, zero, parts).unwrap_err();
                assert!(matches!(error, QueryError::Radius(_)), "{parts:?}");
            }
        }
        let error = VertexFace::new(zero, zero, [0.5, -1.0]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the radius is 0.5 + -1; both have to be finite, and 0 or more"
        );
        assert!(EdgeEdge::new(zero, zero, 0.0).is_ok());
        assert!(EdgeEdge::new(zero, zero, [f64::MAX; 2]).is_ok());
    }
}

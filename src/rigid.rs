//! What is asked of bodies that turn: one time step of a rigid body against a vertex or an edge
//! that moves on straight lines.
//!
//! A body is given by its [`Pose`] at both ends of the step, and by points in its own frame. In
//! between, its centre moves on a line and its quaternion does too, without being brought to length
//! 1:
//!
//! ```text
//! c(t) = (1 - t) c0 + t c1        q(t) = (1 - t) q0 + t q1        X(t) = c(t) + R(q(t)) x
//! ```
//!
//! `R(q) = M(q) / |q|^2`, with quadratic forms for the entries of `M`, is a rotation for every `q`
//! but 0. So the motion is rational in `t`, passes exactly through both poses as they are stored,
//! and turns about one axis, through the orientations of the shortest turn (of slerp). Only the
//! clock is another one: see [`RigidMotion`].
//!
//! ```
//! use tunnelproof::nalgebra::Quaternion;
//! use tunnelproof::rigid::{EdgeTurningEdge, Pose, RigidMotion};
//! use tunnelproof::{Point, decide_rigid};
//!
//! let p = Point::new;
//! // A rod on the x axis of its body, which turns by 90 degrees about z, through a wire at 45.
//! let start = Pose::new(Point::origin(), Quaternion::new(1.0, 0.0, 0.0, 0.0));
//! let end = Pose::new(Point::origin(), Quaternion::new(1.0, 0.0, 0.0, 1.0));
//! let motion = RigidMotion::new(start, end)?;
//! let wire = [p(1.0, 1.0, -1.0), p(1.0, 1.0, 1.0)];
//! let rod = [p(0.0, 0.0, 0.0), p(2.0, 0.0, 0.0)];
//! let query = EdgeTurningEdge::new(wire, wire, rod, motion)?;
//!
//! let hit = decide_rigid(&query).expect("the rod passes the wire");
//! // The square root of 2, less 1: rounded down and up.
//! assert_eq!(hit.toi, 0.414_213_562_373_095_03);
//! assert_eq!(hit.toi_above, 0.414_213_562_373_095_1);
//! # Ok::<(), tunnelproof::rigid::RigidError>(())
//! ```

use nalgebra::{Quaternion, Vector3};

use crate::query::{Point, Radius};

mod error;

pub use error::RigidError;
use error::{check, first_not_finite};

/// Where a body is: its centre, and a quaternion that turns its frame into space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The origin of the body's frame, in metres.
    pub centre: Point,
    /// A quaternion of any length but 0; it is taken as it is stored, exactly.
    pub quaternion: Quaternion<f64>,
}

/// The motion of a body from one pose to another, by at most 90 degrees.
///
/// Both `q` and `-q` are the same orientation: of the two, that is taken for the end which is
/// nearer to the start.
///
/// # The clock
///
/// If the quaternions have the same length, the turn is half done at `t = 1/2`, and at other times
/// it is off a uniform turn by at most 0.034 degrees where the whole turn is 30 degrees, 0.27 at 60
/// and 0.92 at 90. If one is longer, the body turns faster at the other end of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidMotion {
    start: Pose,
    end: Pose,
    /// The sign that the quaternion at the end is taken with.
    sign: f64,
}

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

/// Either kind of query, for collections of both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RigidQuery {
    /// Edge against an edge of a turning body.
    EdgeTurningEdge(EdgeTurningEdge),
    /// Vertex against a face of a turning body.
    VertexTurningFace(VertexTurningFace),
}

/// The largest turn of a step, in degrees. Turns within 1e-12 of it may be taken or refused.
pub const MOST_DEGREES: f64 = 90.0;

/// Below the cosine of half the largest turn by more than any rounding of it.
const LEAST_COSINE: f64 = std::f64::consts::FRAC_1_SQRT_2 - 4e-15;

impl Pose {
    /// The pose with this centre, in metres, and this quaternion.
    pub fn new(centre: Point, quaternion: Quaternion<f64>) -> Self {
        Pose { centre, quaternion }
    }

    /// Checks all numbers; returns the quaternion times a power of two, its largest component
    /// between 1 and 2.
    fn check(&self, at_end: bool) -> Result<[f64; 4], RigidError> {
        if let Some((axis, value)) = first_not_finite(&self.centre) {
            return Err(RigidError::Centre {
                at_end,
                axis,
                value,
            });
        }
        let components = components(&self.quaternion);
        if let Some(component) = components.iter().position(|value| !value.is_finite()) {
            return Err(RigidError::Quaternion {
                at_end,
                component,
                value: components[component],
            });
        }
        scaled(components).ok_or(RigidError::NoOrientation { at_end })
    }
}

impl RigidMotion {
    /// The motion from one pose to another.
    ///
    /// # Errors
    ///
    /// [`RigidError`] names the first number that is NaN or infinite, a quaternion that is 0, or a
    /// turn by more than [`MOST_DEGREES`].
    pub fn new(start: Pose, end: Pose) -> Result<Self, RigidError> {
        let (q0, q1) = (start.check(false)?, end.check(true)?);
        let product = |x: &[f64; 4], y: &[f64; 4]| -> f64 { (0..4).map(|i| x[i] * y[i]).sum() };
        let along = product(&q0, &q1);
        let cosine = along.abs() / (product(&q0, &q0) * product(&q1, &q1)).sqrt();
        if cosine < LEAST_COSINE {
            let degrees = 2.0 * cosine.min(1.0).acos().to_degrees();
            return Err(RigidError::TurnsTooFar { degrees });
        }
        let sign = if along < 0.0 { -1.0 } else { 1.0 };
        Ok(RigidMotion { start, end, sign })
    }

    /// The pose at `t = 0`.
    pub fn start(&self) -> &Pose {
        &self.start
    }

    /// The pose at `t = 1`.
    pub fn end(&self) -> &Pose {
        &self.end
    }

    /// The quaternions between which the motion is, each as w, x, y, z: that of the start, and that
    /// of the end with the sign that makes it the nearer one.
    pub fn quaternions(&self) -> [[f64; 4]; 2] {
        let end = components(&self.end.quaternion);
        [
            components(&self.start.quaternion),
            end.map(|component| self.sign * component),
        ]
    }

    /// Where a point of the body's frame is in space at a time in `[0, 1]`, rounded.
    pub fn position(&self, local: &Point, t: f64) -> Point {
        let [q0, q1] = self.quaternions();
        let q: [f64; 4] = std::array::from_fn(|i| (1.0 - t) * q0[i] + t * q1[i]);
        // It is 0 only where it is below every number that is not.
        let q = scaled(q).or_else(|| scaled(q0)).unwrap_or(q0);
        let (w, v) = (q[0], Vector3::new(q[1], q[2], q[3]));
        let turn = v.cross(&local.coords) * 2.0;
        let turned = local.coords + (turn * w + v.cross(&turn)) / (w * w + v.dot(&v));
        let centre = self.start.centre.coords * (1.0 - t) + self.end.centre.coords * t;
        Point::from(centre + turned)
    }
}

macro_rules! turning {
    ($kind:ident, $world:literal, $local:literal, $first:literal) => {
        impl $kind {
            #[doc = $first]
            ///
            /// They touch where they share a point; [`with_radius`](Self::with_radius) asks for
            /// contact at a distance.
            ///
            /// # Errors
            ///
            /// [`RigidError`] names the first coordinate that is NaN or infinite.
            pub fn new(
                start: [Point; $world],
                end: [Point; $world],
                local: [Point; $local],
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
                start: [Point; $world],
                end: [Point; $world],
                local: [Point; $local],
                motion: RigidMotion,
                radius: impl Into<Radius>,
            ) -> Result<Self, RigidError> {
                let radius = radius.into();
                check(&start, &end, &local, radius)?;
                Ok(Self {
                    start,
                    end,
                    local,
                    motion,
                    radius,
                })
            }

            /// The points in space at `t = 0`.
            pub fn start(&self) -> &[Point; $world] {
                &self.start
            }

            /// The points in space at `t = 1`.
            pub fn end(&self) -> &[Point; $world] {
                &self.end
            }

            /// The points in the body's frame.
            pub fn local(&self) -> &[Point; $local] {
                &self.local
            }

            /// The motion of the body.
            pub fn motion(&self) -> &RigidMotion {
                &self.motion
            }

            /// The distance at which the two count as touching; 0 asks for the midlines and the
            /// face themselves.
            pub fn radius(&self) -> Radius {
                self.radius
            }

            /// All four points in space at a time in `[0, 1]`, rounded.
            pub fn positions(&self, t: f64) -> [Point; 4] {
                std::array::from_fn(|i| match i < $world {
                    true => {
                        let [from, to] = [self.start[i].coords, self.end[i].coords];
                        Point::from(from * (1.0 - t) + to * t)
                    }
                    false => self.motion.position(&self.local[i - $world], t),
                })
            }

            /// The point in space of the side that does not turn, with these
            /// [weights](crate::contact::Place::weights) of A, B, C and D, at a time in `[0, 1]`,
            /// rounded.
            pub fn point(&self, weights: &[f64; 4], t: f64) -> Point {
                let positions = self.positions(t);
                let first = positions[0].coords * weights[0];
                let rest = (1..$world).map(|i| positions[i].coords * weights[i]);
                Point::from(rest.fold(first, |sum, part| sum + part))
            }
        }
    };
}

turning!(
    EdgeTurningEdge,
    2,
    2,
    "The query of an edge AB, given at `t = 0` and `t = 1`, and an edge CD in the body's frame."
);
turning!(
    VertexTurningFace,
    1,
    3,
    "The query of a vertex A, given at `t = 0` and `t = 1`, and a face BCD in the body's frame."
);

impl RigidQuery {
    /// The name of its kind.
    pub fn kind(&self) -> &'static str {
        match self {
            RigidQuery::EdgeTurningEdge(_) => "edge-turning-edge",
            RigidQuery::VertexTurningFace(_) => "vertex-turning-face",
        }
    }

    /// The points in space at `t = 0`.
    pub fn start(&self) -> &[Point] {
        match self {
            RigidQuery::EdgeTurningEdge(query) => query.start(),
            RigidQuery::VertexTurningFace(query) => query.start(),
        }
    }

    /// The points in space at `t = 1`.
    pub fn end(&self) -> &[Point] {
        match self {
            RigidQuery::EdgeTurningEdge(query) => query.end(),
            RigidQuery::VertexTurningFace(query) => query.end(),
        }
    }

    /// The points in the body's frame.
    pub fn local(&self) -> &[Point] {
        match self {
            RigidQuery::EdgeTurningEdge(query) => query.local(),
            RigidQuery::VertexTurningFace(query) => query.local(),
        }
    }

    /// The motion of the body.
    pub fn motion(&self) -> &RigidMotion {
        match self {
            RigidQuery::EdgeTurningEdge(query) => query.motion(),
            RigidQuery::VertexTurningFace(query) => query.motion(),
        }
    }

    /// The distance at which the two count as touching.
    pub fn radius(&self) -> Radius {
        match self {
            RigidQuery::EdgeTurningEdge(query) => query.radius(),
            RigidQuery::VertexTurningFace(query) => query.radius(),
        }
    }

    /// All four points in space at a time in `[0, 1]`, rounded.
    pub fn positions(&self, t: f64) -> [Point; 4] {
        match self {
            RigidQuery::EdgeTurningEdge(query) => query.positions(t),
            RigidQuery::VertexTurningFace(query) => query.positions(t),
        }
    }
}

/// w, x, y, z.
fn components(q: &Quaternion<f64>) -> [f64; 4] {
    [q.w, q.i, q.j, q.k]
}

fn largest(q: &[f64; 4]) -> f64 {
    q.iter().fold(0.0, |a, b| a.max(b.abs()))
}

/// Times a power of two, the largest component between 1 and 2; what is tiny beside it may
/// underflow. `None` of 0.
fn scaled(q: [f64; 4]) -> Option<[f64; 4]> {
    let mut q = q;
    let mut size = largest(&q);
    if size == 0.0 {
        return None;
    }
    if size < f64::MIN_POSITIVE {
        q = q.map(|x| x * SUBNORMAL);
        size *= SUBNORMAL;
    }
    // Powers of two from 2^-1022 to 2^1023; halves of both factors are representable.
    let exponent = (size.to_bits() >> 52) as i32 - 1023;
    let power = |exponent: i32| f64::from_bits(((1023 + exponent) as u64) << 52);
    let (first, second) = (exponent / 2, exponent - exponent / 2);
    Some(q.map(|x| x * power(-first) * power(-second)))
}

/// 2^60: times it, a subnormal number is a normal one.
const SUBNORMAL: f64 = (1u64 << 60) as f64;

#[cfg(test)]
mod tests;

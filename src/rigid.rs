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
//! use tunnelproof::nalgebra::{Quaternion, Vector3};
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
//! // From the wire to the rod, which comes from the x axis.
//! let normal = hit.normal(&query).expect("they are apart at the start");
//! let expected = Vector3::new(1.0, -1.0, 0.0).normalize();
//! assert!((normal.direction - expected).norm() < 1e-15 && normal.error < 1e-14);
//! # Ok::<(), tunnelproof::rigid::RigidError>(())
//! ```

mod error;
mod kind;
mod motion;
mod query;
mod side;

pub use error::RigidError;
pub use kind::{Lengths, RigidQueryKind};
pub use motion::{MOST_DEGREES, Pose, RigidMotion};
pub use query::{
    EdgeTurningEdge, RigidQuery, TurningEdgeTurningEdge, TurningVertexTurningFace,
    VertexTurningFace,
};
pub use side::Side;

#[cfg(test)]
mod tests;

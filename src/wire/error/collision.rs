//! Why wires could not be kept apart.

use std::fmt;

use crate::broad::BroadError;
use crate::narrow::Unsupported;
use crate::query::QueryError;
use crate::rigid::RigidError;
use crate::wire::model::BodyId;
use crate::wire::site::WireSite;

/// Why a step with collisions was not done.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CollisionError {
    /// Midlines touch where the step starts: no motion, however short, keeps them apart.
    Touching {
        /// The two places.
        sites: [WireSite; 2],
    },
    /// A midline touches a body where the step starts, and nothing that moves keeps it away.
    TouchingBody {
        /// The place on the wire.
        site: WireSite,
        /// The body.
        body: BodyId,
    },
    /// Two bodies touch where the step starts, and nothing that moves keeps them apart.
    TouchingBodies {
        /// The bodies.
        bodies: [BodyId; 2],
    },
    /// A scripted body turns too often in the step for its way to be tested.
    TurnsTooFar {
        /// The body.
        body: BodyId,
        /// How many turns it makes in the step.
        turns: f64,
        /// How many it may make.
        most: f64,
    },
    /// A body's motion or a segment beside it is no query.
    Rigid(RigidError),
    /// The collision library does not take the mesh of a body.
    Mesh {
        /// The body.
        body: BodyId,
    },
    /// A segment does not end the step at finite positions.
    Broad(BroadError),
    /// A pair is no query.
    Query(QueryError),
    /// The narrow phase does not take edge-edge queries of radius 0.
    Narrow(Unsupported),
}

impl fmt::Display for CollisionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CollisionError::Touching { sites: [a, b] } => {
                write!(f, "the midlines of {a} and {b} touch before the step")
            }
            CollisionError::TouchingBody { site, body } => {
                write!(
                    f,
                    "the midline of {site} touches body {} before the step",
                    body.0
                )
            }
            CollisionError::TouchingBodies { bodies: [a, b] } => {
                write!(f, "bodies {} and {} touch before the step", a.0, b.0)
            }
            CollisionError::TurnsTooFar { body, turns, most } => write!(
                f,
                "body {} makes {turns:.1} turns in the step, and at most {most} can be tested; \
                 script it slower or take a shorter step",
                body.0
            ),
            CollisionError::Rigid(error) => write!(f, "the motion of a body: {error}"),
            CollisionError::Mesh { body } => {
                write!(
                    f,
                    "the mesh of body {} is no surface that can be tested",
                    body.0
                )
            }
            CollisionError::Broad(error) => write!(f, "broad phase: {error}"),
            CollisionError::Query(error) => write!(f, "query: {error}"),
            CollisionError::Narrow(error) => write!(f, "narrow phase: {error}"),
        }
    }
}

impl std::error::Error for CollisionError {}

impl From<BroadError> for CollisionError {
    fn from(error: BroadError) -> Self {
        CollisionError::Broad(error)
    }
}

impl From<RigidError> for CollisionError {
    fn from(error: RigidError) -> Self {
        CollisionError::Rigid(error)
    }
}

impl From<QueryError> for CollisionError {
    fn from(error: QueryError) -> Self {
        CollisionError::Query(error)
    }
}

impl From<Unsupported> for CollisionError {
    fn from(error: Unsupported) -> Self {
        CollisionError::Narrow(error)
    }
}

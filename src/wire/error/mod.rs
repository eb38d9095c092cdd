//! Why a step was not done.

mod collision;

use std::fmt;

use super::model::{BodyId, ModelError, WireId};
pub use collision::CollisionError;

/// A step that was not done. The world is as it was before.
#[derive(Clone, Debug, PartialEq)]
pub struct StepError {
    /// The step, from 0.
    pub step: u64,
    /// Why.
    pub reason: Reason,
}

/// Why a step was not done.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// A contact that is no contact.
    Contact {
        /// Its index in the contacts given.
        index: usize,
        /// What is wrong with it.
        error: ModelError,
    },
    /// A pivot of the factorisation is on the wrong side of 0 or not finite: masses, stiffness and
    /// step are too far apart for `f64`.
    Pivot {
        /// What it belongs to.
        part: Part,
    },
    /// The solution does not solve the system.
    Residual {
        /// What has the largest residual; if that is NaN, what the largest impulse acts on.
        part: Part,
        /// Its backward error: residual over magnitude of what was summed up, the largest of all
        /// rows.
        error: f64,
        /// The largest accepted.
        limit: f64,
    },
    /// The solution leads to a position, orientation or velocity that is NaN or infinite.
    NotFinite {
        /// The first such part.
        part: Part,
    },
    /// Wires cannot be kept apart.
    Collision(CollisionError),
}

/// What an equation, or a velocity, of a step belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A node of a wire with the segments beside it, by its number at present.
    Node {
        /// The wire.
        wire: WireId,
        /// The node, from 0.
        node: usize,
    },
    /// A body.
    Body(BodyId),
}

impl StepError {
    /// The wires and the bodies that it speaks of, each once.
    pub fn involved(&self) -> (Vec<WireId>, Vec<BodyId>) {
        let (mut wires, mut bodies) = match &self.reason {
            Reason::Contact { .. } => (vec![], vec![]),
            Reason::Pivot { part } | Reason::Residual { part, .. } | Reason::NotFinite { part } => {
                match part {
                    Part::Node { wire, .. } => (vec![*wire], vec![]),
                    Part::Body(body) => (vec![], vec![*body]),
                }
            }
            Reason::Collision(error) => match error {
                CollisionError::Touching { sites } => {
                    (sites.iter().map(|site| site.wire).collect(), vec![])
                }
                CollisionError::TouchingBody { site, body } => (vec![site.wire], vec![*body]),
                CollisionError::TouchingBodies { bodies } => (vec![], bodies.to_vec()),
                CollisionError::TurnsTooFar { body, .. } | CollisionError::Mesh { body } => {
                    (vec![], vec![*body])
                }
                CollisionError::Rigid(_)
                | CollisionError::Broad(_)
                | CollisionError::Query(_)
                | CollisionError::Narrow(_) => (vec![], vec![]),
            },
        };
        wires.dedup();
        bodies.dedup();
        (wires, bodies)
    }
}

impl From<CollisionError> for Reason {
    fn from(error: CollisionError) -> Self {
        Reason::Collision(error)
    }
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "step {}: ", self.step)?;
        match &self.reason {
            Reason::Contact { index, error } => write!(f, "contact {index} is refused: {error}"),
            Reason::Pivot { part } => write!(
                f,
                "the system cannot be factored: at {part} a pivot has the wrong sign or is not \
                 finite; masses, stiffness and time step are too far apart there"
            ),
            Reason::Residual { part, error, limit } => write!(
                f,
                "the system was not solved: its backward error, largest at {part}, is {error:e}, \
                 and must be at most {limit:e}"
            ),
            Reason::NotFinite { part } => write!(
                f,
                "{part} would end at a position or velocity that is not a finite number"
            ),
            Reason::Collision(error @ CollisionError::TurnsTooFar { .. }) => error.fmt(f),
            Reason::Collision(error) => write!(f, "wires cannot be kept apart: {error}"),
        }
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Part::Node { wire, node } => write!(f, "node {node} of wire {}", wire.0),
            Part::Body(body) => write!(f, "body {}", body.0),
        }
    }
}

impl std::error::Error for StepError {}

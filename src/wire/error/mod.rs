//! Why a step was not done.

mod collision;

use std::fmt;

use super::model::ModelError;
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
        /// The unknown that it belongs to, in order of elimination.
        unknown: usize,
    },
    /// The solution does not solve the system.
    Residual {
        /// Its backward error: residual over magnitude of what was summed up, the largest of all
        /// rows.
        error: f64,
        /// The largest accepted.
        limit: f64,
    },
    /// The solution leads to a position, orientation or velocity that is NaN or infinite.
    NotFinite,
    /// Wires cannot be kept apart.
    Collision(CollisionError),
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
            Reason::Pivot { unknown } => write!(
                f,
                "the system cannot be factored: the pivot of unknown {unknown} has the wrong sign \
                or is not finite"
            ),
            Reason::Residual { error, limit } => write!(
                f,
                "the system was not solved: its backward error is {error:e}, it must be at most \
                {limit:e}"
            ),
            Reason::NotFinite => f.write_str(
                "something would end at a position or velocity that is not a finite number",
            ),
            Reason::Collision(error @ CollisionError::TurnsTooFar { .. }) => error.fmt(f),
            Reason::Collision(error) => write!(f, "wires cannot be kept apart: {error}"),
        }
    }
}

impl std::error::Error for StepError {}

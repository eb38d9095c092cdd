//! Names of places on wires: segments by number, points by arc length.

use std::fmt;

use super::model::check::not_negative;
use super::model::{ModelError, WireId};
use super::world::World;

/// A segment of a wire at present; changes of resolution renumber them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SegmentId {
    /// The wire.
    pub wire: WireId,
    /// The segment between its nodes `segment` and `segment + 1`.
    pub segment: usize,
}

/// A point of a wire's material, which stays the same when the resolution changes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WireSite {
    /// The wire.
    pub wire: WireId,
    /// Arc length in m.
    pub arc: f64,
}

impl WireSite {
    pub(in crate::wire) fn check(&self, world: &World) -> Result<(), ModelError> {
        let length = world.wire(self.wire)?.length();
        not_negative("arc", self.arc)?;
        if self.arc > length {
            let accepted = "at most the length of the wire";
            return Err(ModelError::value("arc", self.arc, accepted));
        }
        Ok(())
    }
}

impl fmt::Display for WireSite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "wire {} at {} m", self.wire.0, self.arc)
    }
}

//! What the solver keeps from one step for the next. It changes how fast a step is solved and,
//! within the tolerances, where sweeps that are cut off end; it is no part of the physical state.
//! The bits of later steps depend on the impulses, so they are saved, and not on the structure.

use std::collections::BTreeMap;

use super::Vector;
use super::sparse::Structure;

/// The solver's memory of the last step.
#[derive(Clone, Debug, Default)]
pub(in crate::wire) struct SolverCache {
    pub(in crate::wire) warm_start: WarmStart,
    pub(in crate::wire) structures: Structures,
}

/// The structures of the systems that were solved last, by the least member of their island.
pub(in crate::wire) type Structures = BTreeMap<usize, Structure>;

/// Contact impulses of the last step in N s along x, y, z, sorted by key: the next solve
/// starts there.
#[derive(Clone, Debug, Default)]
pub(in crate::wire) struct WarmStart(Vec<(u64, Vector)>);

impl WarmStart {
    pub(in crate::wire) fn new(impulses: impl Iterator<Item = (u64, Vector)>) -> Self {
        let mut sorted: Vec<_> = impulses.collect();
        sorted.sort_by_key(|(key, _)| *key);
        WarmStart(sorted)
    }

    /// Keys and impulses, sorted by key.
    #[cfg(feature = "recording")]
    pub(in crate::wire) fn impulses(&self) -> &[(u64, Vector)] {
        &self.0
    }

    /// The impulse of the contact with this key; 0 for a new one.
    pub(in crate::wire) fn impulse(&self, key: u64) -> Vector {
        match self.0.binary_search_by_key(&key, |(key, _)| *key) {
            Ok(at) => self.0[at].1,
            Err(_) => Vector::zeros(),
        }
    }
}

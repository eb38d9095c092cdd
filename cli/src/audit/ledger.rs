//! How often wires have passed through each other, counted with signs.
//!
//! A passage at a node is seen by every segment there, and by none as a crossing inside of it. So
//! the ledger counts in general position, every node moved aside by an infinitesimal
//! ([`super::aside`]). It looks at those pairs alone that have an exact contact in the audit of
//! motions or of changes of resolution, for no other pair can come to meet. So what stands has been
//! in contact, and each of these contacts was reported or is a finding.
//!
//! Where contacts are inside the wires, between the first and the last step, and not at a segment
//! that shares a node with the other one, the sum is the same in every general position: it is a
//! degree. Elsewhere it may depend on where nodes are moved. So it is taken in several positions,
//! and is ambiguous if they differ.

use std::collections::BTreeMap;

use serde::Serialize;

use super::aside::{POSITIONS, Passages};

/// Passages by pair of wires.
#[derive(Default)]
pub(super) struct Ledger {
    sums: BTreeMap<[usize; 2], Passages>,
}

/// Two wires of which it cannot be said how often they have passed through each other: a contact is
/// at the end of one, at the start or the end of the run, or where wires are fixed to one point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Ambiguous {
    /// The wires.
    pub wires: [usize; 2],
    /// The least signed number of passages.
    pub least: i64,
    /// The largest.
    pub most: i64,
}

impl Ledger {
    /// Pairs of wires that have passed through each other without coming back, and how often.
    pub(super) fn standing(&self) -> Vec<([usize; 2], i64)> {
        let sums = self.sums.iter();
        let one = sums.filter_map(|(wires, sums)| Some((*wires, agreed(sums)?)));
        one.filter(|(_, sum)| *sum != 0).collect()
    }

    /// Pairs of wires whose number of passages depends on where wires are moved.
    pub(super) fn ambiguous(&self) -> Vec<Ambiguous> {
        let sums = self.sums.iter();
        let differ = sums.filter(|(_, sums)| agreed(sums).is_none());
        let ambiguous = differ.map(|(&wires, sums)| Ambiguous {
            wires,
            least: sums.iter().flatten().min().copied().unwrap_or(0),
            most: sums.iter().flatten().max().copied().unwrap_or(0),
        });
        ambiguous.collect()
    }

    /// Adds the passages of two segments.
    pub(super) fn enter(&mut self, wires: [usize; 2], passages: &Passages) {
        let wires = [wires[0].min(wires[1]), wires[0].max(wires[1])];
        let sums = self.sums.entry(wires).or_insert([Some(0); POSITIONS]);
        for (sum, passages) in sums.iter_mut().zip(passages) {
            *sum = sum.zip(*passages).map(|(sum, passages)| sum + passages);
        }
    }
}

/// The sum that every position gives.
fn agreed(sums: &Passages) -> Option<i64> {
    let first = sums[0]?;
    sums.iter().all(|sum| *sum == Some(first)).then_some(first)
}

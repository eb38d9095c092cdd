//! How often wires have passed through each other, counted with signs.
//!
//! A passage at a node is seen by every segment there, and by none as a crossing inside of it. So
//! the ledger counts in general position, every node moved aside by an infinitesimal
//! ([`super::aside`]). It looks at those pairs alone that have an exact contact in the audit of
//! motions or of changes of resolution, for no other pair can come to meet. So what stands has been
//! in contact, and each of these contacts was reported or is a finding.
//!
//! Where contacts are inside the wires, between the start and the end of the run, and not at
//! segments that share a node, the sum is the same in every general position: it is a degree. At an
//! end of a wire or of the run it may depend on where nodes are moved, so the two wires are
//! ambiguous. So they are if sums in several positions differ.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use super::aside::{POSITIONS, Passages};

/// Passages by pair of wires.
#[derive(Default)]
pub(super) struct Ledger {
    sums: BTreeMap<[usize; 2], Sum>,
}

/// What two wires have come to.
struct Sum {
    passages: Passages,
    /// Whether the run starts or ends with a contact of the two.
    cut: bool,
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
    /// Whether a contact is at the end of a wire.
    pub at_wire_end: bool,
    /// Whether the run starts or ends with a contact.
    pub at_run_end: bool,
}

impl fmt::Display for Ambiguous {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [a, b] = self.wires;
        let why = match (self.at_wire_end, self.at_run_end) {
            (true, true) => "at the end of a wire, and as the run starts or ends",
            (true, false) => "at the end of a wire",
            (false, true) => "as the run starts or ends",
            (false, false) => "next to a point that both share",
        };
        write!(
            f,
            "wires {a} and {b} met {why}: they passed through each other "
        )?;
        match (self.least, self.most) {
            (0, 0) => f.write_str("or not, counted as 0"),
            (least, most) if least == most => write!(f, "or not, counted as {least:+}"),
            (least, most) => write!(f, "from {least:+} to {most:+} times"),
        }
    }
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
        let differ = sums.filter(|(_, sum)| agreed(sum).is_none());
        let ambiguous = differ.map(|(&wires, sum)| Ambiguous {
            wires,
            least: known(sum).min().unwrap_or(0),
            most: known(sum).max().unwrap_or(0),
            at_wire_end: sum.passages.at_end,
            at_run_end: sum.cut,
        });
        ambiguous.collect()
    }

    /// Adds the passages of two segments.
    pub(super) fn enter(&mut self, wires: [usize; 2], passages: &Passages) {
        let sums = &mut self.of(wires).passages;
        sums.at_end |= passages.at_end;
        for (sum, passages) in sums.by_position.iter_mut().zip(passages.by_position) {
            *sum = sum.zip(passages).map(|(sum, passages)| sum + passages);
        }
    }

    /// Notes that the run starts or ends with a contact of two wires.
    pub(super) fn cut(&mut self, wires: [usize; 2]) {
        self.of(wires).cut = true;
    }

    fn of(&mut self, wires: [usize; 2]) -> &mut Sum {
        let wires = [wires[0].min(wires[1]), wires[0].max(wires[1])];
        self.sums.entry(wires).or_insert(Sum {
            passages: Passages {
                by_position: [Some(0); POSITIONS],
                at_end: false,
            },
            cut: false,
        })
    }
}

fn known(sum: &Sum) -> impl Iterator<Item = i64> {
    sum.passages.by_position.iter().flatten().copied()
}

/// The sum that every position gives, and every other one would.
fn agreed(sum: &Sum) -> Option<i64> {
    let Passages {
        by_position,
        at_end,
    } = sum.passages;
    let first = by_position[0]?;
    let same = by_position.iter().all(|other| *other == Some(first));
    (same && !at_end && !sum.cut).then_some(first)
}

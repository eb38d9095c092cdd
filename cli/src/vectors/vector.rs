//! One query with its exact answer, as the files have it.

use serde::Serialize;
use serde_json::Value;
use tunnelproof::query::{Point, Query};

use super::assessment::Assessment;
use super::exact_time::ExactTime;
use super::flag::Flag;
use tunnelproof_reference::corpus::hexfloat;
use tunnelproof_reference::corpus::jsonl::{self, Numbers};
use tunnelproof_reference::report::answer::Fields;

/// A query and what its source says of it.
pub(super) struct Described {
    pub(super) id: String,
    /// What it is, in one line.
    pub(super) comment: String,
    /// The flags that say where it comes from.
    pub(super) flags: Vec<Flag>,
    /// For a segment of a wire that the other edge passes.
    pub(super) wire: Option<Wire>,
    pub(super) query: Query,
}

/// Which segment of which wire the edge AB is.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Wire {
    /// The same for every segment of one wire.
    pub(super) id: String,
    /// From 0, in the order of the wire.
    pub(super) segment: usize,
}

/// A vector as JSON has it.
#[derive(Serialize)]
pub(super) struct Vector {
    id: String,
    comment: String,
    flags: Vec<String>,
    wire: Option<Wire>,
    kind: String,
    /// In metres: a number, or two whose exact sum it is.
    radius: Value,
    radius_hex: Value,
    /// A, B, C and D at the start and at the end.
    points: Vec<[f64; 3]>,
    points_hex: Vec<[String; 3]>,
    result: Fields,
    exact_toi: Option<ExactTime>,
    #[serde(skip)]
    own_flags: Vec<Flag>,
}

impl Vector {
    pub(super) fn new(described: Described) -> Self {
        let query = &described.query;
        let assessment = Assessment::new(query);
        let flags = assessment.flags.iter().chain(&described.flags);
        let own_flags: Vec<Flag> = flags.copied().collect();
        let points = query.start().iter().chain(query.end());
        let points: Vec<[f64; 3]> = points.map(|point: &Point| (*point).into()).collect();
        Vector {
            flags: own_flags.iter().map(|flag| flag.name()).collect(),
            kind: query.kind().to_string(),
            radius: jsonl::radius(query.radius(), Numbers::Decimal),
            radius_hex: jsonl::radius(query.radius(), Numbers::Hexadecimal),
            points_hex: points
                .iter()
                .map(|point| point.map(hexfloat::format))
                .collect(),
            points,
            result: Fields::exact(&assessment.answer),
            exact_toi: assessment.time,
            id: described.id,
            comment: described.comment,
            wire: described.wire,
            own_flags,
        }
    }

    pub(super) fn flags(&self) -> impl Iterator<Item = Flag> {
        self.own_flags.iter().copied()
    }
}

//! The tolerances: how far a subject may be off before `--strict` or a fuzz target fails it. This
//! is the only place in the crate that has any.

use tunnelproof::query::Query;
use tunnelproof::thesis::Thresholds;

use super::margin;

/// What a subject is permitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Permitted {
    /// The name of the subject.
    pub subject: &'static str,
    /// A false hit passes if the edges come within this distance, in metres.
    pub distance: f64,
    /// How much later than the exact time of impact, without unit.
    pub late: f64,
    /// Whether a fuzz target excuses every deviation on queries that bring a decision of the
    /// thesis' algorithms near its border; see [`margin`].
    pub borders: bool,
    /// Where the values come from.
    pub source: &'static str,
}

/// Every permitted deviation. A subject that is not named here is permitted none.
pub const PERMITTED: &[Permitted] = &[Permitted {
    subject: "thesis",
    distance: 1e-6,
    late: 1e-9,
    borders: true,
    source: "thresholds for distance and time, thesis table 3.1; borders: the rounding of f64",
}];

/// What the [registry](crate::registry)'s subject of this name is permitted.
pub fn permitted(subject: &str) -> Permitted {
    let row = PERMITTED.iter().find(|row| row.subject == subject);
    row.copied().unwrap_or(Permitted::NOTHING)
}

impl Permitted {
    /// No deviation.
    pub const NOTHING: Permitted = Permitted {
        subject: "",
        distance: 0.0,
        late: 0.0,
        borders: false,
        source: "none: every deviation counts",
    };

    /// Whether a query is so near to a border between two answers that either is permitted.
    pub fn excuses(&self, query: &Query) -> bool {
        match query {
            Query::EdgeEdge(query) => {
                self.borders && !margin::is_clear(query, &Thresholds::default())
            }
            Query::VertexFace(_) => false,
        }
    }
}

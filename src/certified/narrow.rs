//! The certified path as a narrow phase.

use super::cascade::decide;
use super::kind::Kind;
use crate::contact::{Flags, Verdict};
use crate::narrow::{NarrowPhase, Report, Unsupported};
use crate::query::{EdgeEdge, VertexFace};

/// The certified path: no miss, no false hit, a proved time of impact.
///
/// Takes every query. Of a miss it does not know the case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Certified;

impl NarrowPhase for Certified {
    fn name(&self) -> &str {
        "certified"
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
        Ok(report(query))
    }

    fn vertex_face(&self, query: &VertexFace) -> Result<Report, Unsupported> {
        Ok(report(query))
    }
}

fn report<K: Kind>(query: &K) -> Report {
    match decide(query) {
        None => Report {
            verdict: Verdict::Miss,
            case: None,
            flags: Flags::default(),
        },
        Some(hit) => Report {
            verdict: Verdict::Hit(hit.contact(query)),
            case: Some(hit.case),
            flags: hit.flags,
        },
    }
}

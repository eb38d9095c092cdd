//! The certified path as a narrow phase.

use super::cascade::decide;
use super::face::decide_vertex_face;
use super::verdict::Verdict;
use crate::contact::{self, Flags};
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
        Ok(match decide(query) {
            Verdict::Miss => miss(),
            Verdict::Hit(hit) => Report {
                verdict: contact::Verdict::Hit(hit.contact(query)),
                case: Some(hit.case),
                flags: hit.flags,
            },
        })
    }
    fn vertex_face(&self, query: &VertexFace) -> Result<Report, Unsupported> {
        Ok(match decide_vertex_face(query) {
            None => miss(),
            Some(hit) => Report {
                verdict: contact::Verdict::Hit(hit.contact(query)),
                case: Some(hit.case),
                flags: hit.flags,
            },
        })
    }
}

fn miss() -> Report {
    Report {
        verdict: contact::Verdict::Miss,
        case: None,
        flags: Flags::default(),
    }
}

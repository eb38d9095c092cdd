//! The certified path as a narrow phase.

use super::cascade::decide;
use super::verdict::Verdict;
use crate::contact::{self, Flags};
use crate::narrow::{NarrowPhase, Report, Unsupported};
use crate::query::EdgeEdge;

/// The certified path: no miss, no false hit, a proved time of impact.
///
/// Takes edge-edge queries of radius 0. Of a miss it does not know the case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Certified;

impl NarrowPhase for Certified {
    fn name(&self) -> &str {
        "certified"
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
        Ok(match decide(query)? {
            Verdict::Miss => Report {
                verdict: contact::Verdict::Miss,
                case: None,
                flags: Flags::default(),
            },
            Verdict::Hit(hit) => Report {
                verdict: contact::Verdict::Hit(hit.contact(query)),
                case: Some(hit.case),
                flags: hit.flags,
            },
        })
    }
}

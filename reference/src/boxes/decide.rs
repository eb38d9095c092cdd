//! What verdicts depend on.

use super::body::BoxCast;
use super::pairs::decide_pairs;
use super::spans::span;
use crate::answer::Enclosure;

/// The exact answer to a cast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxAnswer {
    /// The first contact; `None` for a miss.
    pub toi: Option<Enclosure>,
    /// Whether the bodies, without their radii, pass into each other at any time of the step: then to
    /// miss the contact is a tunnel, otherwise it is a missed graze.
    pub overlaps: bool,
}

/// The exact answer to a cast.
pub fn decide(cast: &BoxCast) -> BoxAnswer {
    BoxAnswer {
        toi: decide_pairs(cast),
        overlaps: span(cast).is_some_and(|span| span.overlaps),
    }
}

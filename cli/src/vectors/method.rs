//! Published methods, and what they get wrong.

use std::sync::LazyLock;

use tunnelproof::query::Query;

use tunnelproof_reference::certify::tally::Fault;
use tunnelproof_reference::registry;
use tunnelproof_reference::shrink::{Disagreement, Shrunk};
use tunnelproof_reference::subject::Subject;

/// How many queries are tried at most for a smaller one that a method gets wrong.
const MOST_CALLS: u64 = 1000;

/// A way to decide queries whose failures others share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Method {
    /// The thesis' algorithms in `f64` with their thresholds.
    Thresholded,
    /// The thesis' text to the letter, in exact arithmetic.
    PublishedText,
    /// Additive CCD.
    ConservativeAdvancement,
}

impl Method {
    pub(super) const ALL: [Method; 3] = [
        Method::Thresholded,
        Method::PublishedText,
        Method::ConservativeAdvancement,
    ];

    /// The name that ends the names of flags.
    pub(super) fn name(self) -> &'static str {
        match self {
            Method::Thresholded => "ThresholdedMethod",
            Method::PublishedText => "PublishedText",
            Method::ConservativeAdvancement => "ConservativeAdvancement",
        }
    }

    /// What kind of implementation it is, as in "by ...".
    pub(super) fn description(self) -> &'static str {
        match self {
            Method::Thresholded => {
                "case distinction and roots of polynomials in f64 with hand-chosen thresholds (the \
                 thesis' Algorithms 1 to 20)"
            }
            Method::PublishedText => {
                "the thesis' Algorithms 1 to 20 as they are printed, without rounding: the errors \
                 are of logic (docs/errata.md)"
            }
            Method::ConservativeAdvancement => {
                "advancing in f64 until the distance is below a share of the first one (additive \
                 CCD, rescaling 0.9)"
            }
        }
    }

    /// The name of the subject on the command line.
    pub(super) fn subject_name(self) -> &'static str {
        self.subject().name()
    }

    /// What it gets wrong on this query, if that is more than a time that is ahead of the exact
    /// one, which conservative methods mean to give.
    pub(super) fn fault(self, query: &Query) -> Option<Fault> {
        let fault = self.disagreement().fault(query).ok().flatten();
        fault.filter(|fault| *fault != Fault::Early)
    }

    /// A small query that it gets wrong in the same way.
    pub(super) fn shrink(self, query: &Query, fault: Fault) -> Shrunk {
        self.disagreement().shrink(query, fault, MOST_CALLS)
    }

    fn disagreement(self) -> Disagreement<'static> {
        Disagreement::with_oracle(self.subject())
    }

    fn subject(self) -> &'static dyn Subject {
        static SUBJECTS: LazyLock<[&'static dyn Subject; 3]> = LazyLock::new(|| {
            ["thesis", "shadow-published", "additive"]
                .map(|name| registry::by_name(name).expect("the registry has it"))
        });
        SUBJECTS[self as usize]
    }
}

//! What a subject gets wrong, as something to be shrunk.

use tunnelproof::narrow::Unsupported;

use super::{Shrinkable, Shrunk, shrink};
use crate::answer::ExactAnswer;
use crate::certify::judged::Judged;
use crate::certify::query::AnyQuery;
use crate::certify::tally::Fault;
use crate::subject::Subject;

/// Says what is true, if it takes the query.
pub type Truth = fn(&AnyQuery) -> Result<ExactAnswer, Unsupported>;

/// A subject and who knows better.
#[derive(Clone, Copy)]
pub struct Disagreement<'a> {
    /// Who may be wrong.
    pub subject: &'a dyn Subject,
    /// Who is right.
    pub truth: Truth,
}

impl<'a> Disagreement<'a> {
    /// With the oracle as the one who is right.
    pub fn with_oracle(subject: &'a dyn Subject) -> Self {
        let truth = |query: &AnyQuery| Ok(query.decide());
        Disagreement { subject, truth }
    }

    /// What the subject gets wrong, the worst of all that it does, in the order of [`Fault::ALL`];
    /// `None` if it is right. Times of impact that are off by no more than its tolerance do
    /// not count.
    ///
    /// # Errors
    ///
    /// [`Unsupported`] for a query that the truth does not take.
    pub fn fault<Q: Copy + Into<AnyQuery>>(&self, query: &Q) -> Result<Option<Fault>, Unsupported> {
        let query = (*query).into();
        let truth = (self.truth)(&query)?;
        let judged = Judged {
            subject: self.subject,
            explain: None,
        };
        let tolerance = self.subject.tolerance();
        let counts = |&(fault, severity): &(Fault, f64)| match fault {
            Fault::Late | Fault::Early => !tolerance.permits_late(severity),
            _ => true,
        };
        let faults = judged.judge(query, &truth).faults;
        Ok(faults
            .into_iter()
            .filter(counts)
            .map(|(fault, _)| fault)
            .min())
    }

    /// Whether the subject takes such queries.
    pub fn is_asked<Q: Copy + Into<AnyQuery>>(&self, query: &Q) -> bool {
        let query = (*query).into();
        let judged = Judged {
            subject: self.subject,
            explain: None,
        };
        (self.truth)(&query).is_ok_and(|truth| judged.judge(query, &truth).is_asked)
    }

    /// The smallest query on which the subject does wrong what it does on this one.
    pub fn shrink<Q: Shrinkable>(&self, query: &Q, fault: Fault, most_calls: u64) -> Shrunk<Q> {
        shrink(query, most_calls, |query: &Q| {
            self.fault(query) == Ok(Some(fault))
        })
    }
}

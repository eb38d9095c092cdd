//! One answer compared with the exact one.

use tunnelproof::query::Query;

use crate::answer::{Enclosure, ExactAnswer};
use crate::subject::{Answer, Lapse, LapseKind, Subject};

use super::query::AnyQuery;
use super::reply::{Reply, ask};
use super::tally::Fault;
use super::verdict::{Verdict, judge};

/// The names of the errata that together make an answer differ from the exact one.
pub type Explain<'a> = &'a (dyn Fn(&Query, &ExactAnswer) -> Vec<&'static str> + Sync);

/// Someone to be judged.
#[derive(Clone, Copy)]
pub struct Judged<'a> {
    /// Who answers.
    pub subject: &'a dyn Subject,
    /// For a subject with known errata: which of them explain an answer that differs.
    pub explain: Option<Explain<'a>>,
}

/// What was found of one subject on one query.
#[derive(Clone, Debug)]
pub struct Found {
    /// What the subject says; `None` for no answer.
    pub answer: Option<Answer>,
    /// How it fails, if it does.
    pub lapse: Option<Lapse>,
    /// Whether it takes such queries; if not, nothing is wrong.
    pub is_asked: bool,
    /// Whether it reports a hit.
    pub is_hit: bool,
    /// Whether it reports a miss.
    pub is_miss: bool,
    /// What is wrong, each with its severity.
    pub faults: Vec<(Fault, f64)>,
    /// The errata that together explain an answer that differs.
    pub errata: Vec<&'static str>,
}

impl Found {
    /// Of a subject that does not take such queries.
    const NOT_ASKED: Found = Found {
        answer: None,
        lapse: None,
        is_asked: false,
        is_hit: false,
        is_miss: false,
        faults: Vec::new(),
        errata: Vec::new(),
    };
}

impl Judged<'_> {
    /// Asks the subject and compares its answer with the exact one. The gap of a false hit is an
    /// estimate; see [`AnyQuery::exact_gap`].
    pub fn judge(&self, query: impl Into<AnyQuery>, truth: &ExactAnswer) -> Found {
        let query = query.into();
        self.compare(&query, truth, ask(self.subject, &query))
    }

    pub(super) fn compare(&self, query: &AnyQuery, truth: &ExactAnswer, reply: Reply) -> Found {
        let (answer, lapse) = match reply {
            Reply::NotAsked => return Found::NOT_ASKED,
            Reply::Answer(answer) => (Some(answer), None),
            Reply::Nothing(lapse) => (None, Some(lapse)),
        };
        let declared = self.subject.tolerance().near;
        let judgement = judge(truth, answer.as_ref(), || {
            declared > 0.0 && query.comes_within(declared)
        });
        let gap = || query.estimate_gap();
        let explain = self.explain.filter(|_| judgement.differs);
        let errata = match (explain, query) {
            (Some(explain), AnyQuery::Linear(query)) => explain(query, truth),
            _ => Vec::new(),
        };
        let toi = answer.as_ref().and_then(Answer::toi);
        Found {
            answer,
            lapse: lapse.or_else(|| no_time(judgement.verdict, toi)),
            is_asked: true,
            is_hit: judgement.is_hit,
            is_miss: judgement.is_miss(),
            faults: judgement.faults(&truth.into(), gap),
            errata,
        }
    }
}

/// That a time of impact is no time of the step, if that is why an answer is none.
pub(super) fn no_time(verdict: Verdict, toi: Option<Enclosure>) -> Option<Lapse> {
    let toi = toi.filter(|_| verdict == Verdict::NoAnswer)?;
    let Enclosure { below, above } = toi;
    let said = match below.to_bits() == above.to_bits() {
        true => format!("{below:?}"),
        false => format!("[{below:?}, {above:?}]"),
    };
    let detail = format!("toi is {said}, not a number from 0 to 1");
    Some(Lapse::new(LapseKind::NoTime, detail))
}

//! Whoever answers queries: the judges themselves and the engines that are judged.

use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

use tunnelproof::certified::{decide, decide_rigid};
use tunnelproof::contact::{Case, Hit, Place};
use tunnelproof::narrow::{NarrowPhase, Report, Tolerance, Unsupported};
use tunnelproof::query::Query;
use tunnelproof::rigid::RigidQuery;

use crate::answer::{Enclosure, ExactAnswer};

/// Someone who answers queries.
pub trait Subject: Sync {
    /// The name used in tables and on the command line.
    fn name(&self) -> &str;

    /// The answer to a query.
    ///
    /// # Errors
    ///
    /// [`NoAnswer`] for a query that the subject does not take, or that it fails on.
    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer>;

    /// The answers to several queries, as many and in their order. One that makes the subject panic
    /// has none.
    fn answers(&self, queries: &[Query]) -> Vec<Result<Answer, NoAnswer>> {
        let answer = |query| {
            let attempt = catch_unwind(AssertUnwindSafe(|| self.answer(query)));
            attempt.unwrap_or_else(|panic| Err(Lapse::panicked(&*panic).into()))
        };
        queries.iter().map(answer).collect()
    }

    /// The answer to a query of a body that turns; nobody has to take such queries.
    ///
    /// # Errors
    ///
    /// As [`answer`](Self::answer).
    fn turning_answer(&self, query: &RigidQuery) -> Result<Answer, NoAnswer> {
        Err(refusal(query).into())
    }

    /// The answers to several of these, as [`answers`](Self::answers).
    fn turning_answers(&self, queries: &[RigidQuery]) -> Vec<Result<Answer, NoAnswer>> {
        let answer = |query| {
            let attempt = catch_unwind(AssertUnwindSafe(|| self.turning_answer(query)));
            attempt.unwrap_or_else(|panic| Err(Lapse::panicked(&*panic).into()))
        };
        queries.iter().map(answer).collect()
    }

    /// How far off the subject declares its answers to be; nothing for one that claims exactness.
    fn tolerance(&self) -> Tolerance {
        Tolerance::NONE
    }
}

/// That a subject takes no queries of bodies that turn.
fn refusal(query: &RigidQuery) -> Unsupported {
    Unsupported::Turning(query.kind())
}

/// What a subject says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// An exact subject: every number enclosed by its neighbours.
    Exact(ExactAnswer),
    /// The certified path, `None` for a miss: everything exact but the place, which has a stated
    /// error.
    Certified(Option<Hit<Place>>),
    /// An engine: every number in `f64`.
    Engine(Report),
    /// Someone of whom no more is known than the least that everyone says.
    Said(Said),
}

impl Answer {
    /// The time of impact, as far as it is said; `None` for a miss.
    pub fn toi(&self) -> Option<Enclosure> {
        match self {
            Answer::Exact(exact) => exact.hit.map(|hit| hit.toi),
            Answer::Certified(hit) => hit.as_ref().map(|hit| Enclosure {
                below: hit.toi,
                above: hit.toi_above,
            }),
            Answer::Engine(report) => {
                let contact = report.verdict.contact();
                contact.map(|contact| Enclosure::exactly(contact.toi))
            }
            Answer::Said(said) => said.toi,
        }
    }

    /// The case of the motion, if it is stated.
    pub fn case(&self) -> Option<Case> {
        match self {
            Answer::Exact(exact) => Some(exact.case),
            Answer::Certified(hit) => hit.as_ref().map(|hit| hit.case),
            Answer::Engine(report) => report.case,
            Answer::Said(said) => said.case,
        }
    }
}

/// What a subject says, as far as everyone says it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Said {
    /// Time of impact; `None` for a miss.
    pub toi: Option<Enclosure>,
    /// The case of the motion, if it is stated.
    pub case: Option<Case>,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum NoAnswer {
    /// The subject does not take such queries.
    Unsupported(Unsupported),
    /// It takes such queries, and fails on this one.
    Lapse(Lapse),
}

/// How a subject fails on a query that it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Lapse {
    /// In which way.
    pub kind: LapseKind,
    /// What was seen of it, in one line.
    pub detail: String,
}

/// The ways to fail on a query.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum LapseKind {
    /// It panics.
    Panicked,
    /// It raises an exception, in a language that has them.
    Raised,
    /// It refuses the query for a reason that is not that of the query.
    Refused,
    /// Its time of impact is no time of the step: NaN, or outside `[0, 1]`.
    NoTime,
    /// Its program ends, or cannot be started again.
    Crashed,
    /// Its program does not answer in time.
    Hung,
    /// Its program writes something else than an answer.
    Unreadable,
    /// Its program writes the answer to another query, or one that nobody asked for.
    Misplaced,
    /// Its program hung so often in a row that it is no longer asked.
    GivenUp,
}

/// The engine's certified path as a subject, held to all that it promises.
pub struct Certified;

impl LapseKind {
    /// Every way, in the order of tables.
    pub const ALL: [LapseKind; 9] = [
        LapseKind::Panicked,
        LapseKind::Raised,
        LapseKind::Refused,
        LapseKind::NoTime,
        LapseKind::Crashed,
        LapseKind::Hung,
        LapseKind::Unreadable,
        LapseKind::Misplaced,
        LapseKind::GivenUp,
    ];

    /// The words used in tables and files.
    pub fn name(self) -> &'static str {
        match self {
            LapseKind::Panicked => "panicked",
            LapseKind::Raised => "raised",
            LapseKind::Refused => "refused",
            LapseKind::NoTime => "no time",
            LapseKind::Crashed => "crashed",
            LapseKind::Hung => "hung",
            LapseKind::Unreadable => "unreadable",
            LapseKind::Misplaced => "misplaced",
            LapseKind::GivenUp => "given up",
        }
    }
}

impl Lapse {
    /// A lapse with what was seen of it.
    pub fn new(kind: LapseKind, detail: impl Into<String>) -> Self {
        Lapse {
            kind,
            detail: detail.into(),
        }
    }

    fn panicked(panic: &(dyn std::any::Any + Send)) -> Self {
        let message = panic.downcast_ref::<String>().map(String::as_str);
        let message = message.or_else(|| panic.downcast_ref::<&str>().copied());
        Lapse::new(LapseKind::Panicked, message.unwrap_or("without a message"))
    }
}

impl fmt::Display for Lapse {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.kind.name(), self.detail)
    }
}

impl fmt::Display for NoAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoAnswer::Unsupported(reason) => reason.fmt(f),
            NoAnswer::Lapse(lapse) => lapse.fmt(f),
        }
    }
}

impl std::error::Error for NoAnswer {}

impl From<Unsupported> for NoAnswer {
    fn from(reason: Unsupported) -> Self {
        NoAnswer::Unsupported(reason)
    }
}

impl From<Lapse> for NoAnswer {
    fn from(lapse: Lapse) -> Self {
        NoAnswer::Lapse(lapse)
    }
}

impl Subject for Certified {
    fn name(&self) -> &str {
        "certified"
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        Ok(Answer::Certified(match query {
            Query::EdgeEdge(query) => decide(query).map(|hit| hit.map_place(Place::from)),
            Query::VertexFace(query) => decide(query).map(|hit| hit.map_place(Place::from)),
        }))
    }

    fn turning_answer(&self, query: &RigidQuery) -> Result<Answer, NoAnswer> {
        Ok(Answer::Certified(decide_rigid(query)))
    }
}

/// An engine as a subject.
pub struct Engine<N>(pub N);

impl<N: NarrowPhase> Subject for Engine<N> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn answer(&self, query: &Query) -> Result<Answer, NoAnswer> {
        let report = match query {
            Query::EdgeEdge(query) => self.0.edge_edge(query)?,
            Query::VertexFace(query) => self.0.vertex_face(query)?,
        };
        Ok(Answer::Engine(report))
    }

    fn tolerance(&self) -> Tolerance {
        self.0.tolerance()
    }
}

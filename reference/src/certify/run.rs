//! Corpora judged as a whole.

use std::fmt;
use std::iter;
use std::panic::{AssertUnwindSafe, catch_unwind};

use tunnelproof::narrow::Unsupported;
use tunnelproof::query::Query;

use crate::answer::ExactAnswer;
use crate::corpus::{CorpusError, Entries, Entry};
use crate::oracle;
use crate::subject::{Answer, Subject};

use super::batch::map_in_order;
use super::source::Source;
use super::tally::{Fault, Finding, Sort, Tally, Witness};
use super::verdict::{Outline, judge};

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

/// Who judges and who is judged. A subject with the name of a judge is that judge.
#[derive(Clone)]
pub struct Panel<'a> {
    /// The first of them that takes a query has to agree with the oracle on it.
    pub second_judges: Vec<&'a dyn Subject>,
    /// Who is judged, in the order of tables.
    pub subjects: Vec<Judged<'a>>,
}

/// What was found on one source.
#[derive(Clone, Debug, Default)]
pub struct Block {
    /// The name of the source.
    pub name: String,
    /// How many queries there were.
    pub queries: u64,
    /// How many of them are hits.
    pub hits: u64,
    /// How many of them are crossed.
    pub crossings: u64,
    /// How many whole groups there were of segments of a wire that is passed.
    pub joints: u64,
    /// How many of them are labelled.
    pub labels: u64,
    /// Labels that are not what the oracle says.
    pub wrong_labels: Finding,
    /// What each second judge was asked, in the order of the panel.
    pub agreements: Vec<Agreement>,
    /// What was found of each subject, in the order of the panel.
    pub tallies: Vec<Tally>,
}

/// What a second judge says of the oracle's answers.
#[derive(Clone, Debug, Default)]
pub struct Agreement {
    /// How many queries it was asked.
    pub queries: u64,
    /// Queries on which it does not say what the oracle says.
    pub disagreements: Finding,
}

/// Why judging ended early.
#[derive(Debug)]
pub enum RunError {
    /// The corpus is wrong.
    Corpus(CorpusError),
    /// A query that the oracle does not take.
    Unsupported {
        /// Where the query comes from.
        place: String,
        /// Why it is not taken.
        reason: Unsupported,
    },
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RunError::Corpus(error) => error.fmt(f),
            RunError::Unsupported { place, reason } => write!(f, "{place}: {reason}"),
        }
    }
}

impl std::error::Error for RunError {}

impl From<CorpusError> for RunError {
    fn from(error: CorpusError) -> Self {
        RunError::Corpus(error)
    }
}

impl Panel<'_> {
    /// Judges every query of a source. `progress` is told how many were judged since it was told
    /// before.
    ///
    /// # Errors
    ///
    /// [`RunError`] for the first query that cannot be read or that the oracle does not take.
    pub fn run(&self, source: &Source, progress: impl Fn(u64)) -> Result<Block, RunError> {
        let mut block = Block {
            name: source.name(),
            tallies: vec![Tally::default(); self.subjects.len()],
            agreements: vec![Agreement::default(); self.second_judges.len()],
            ..Block::default()
        };
        let size = source.group_size();
        let groups = groups(source.entries()?, size);
        let work = |group: Vec<Entry>| -> Result<Vec<_>, _> {
            let judged = group.into_iter().map(|entry| self.judge(source, entry));
            judged.collect()
        };
        map_in_order(groups, work, |groups: Vec<Vec<Judgements>>| {
            for group in groups {
                progress(group.len() as u64);
                if group.len() == size && size > 1 {
                    block.add_joint(&group);
                }
                group.into_iter().for_each(|case| block.add(case));
            }
            Ok(())
        })?;
        block.tallies.iter_mut().for_each(measure_gap);
        Ok(block)
    }

    fn judge(&self, source: &Source, entry: Entry) -> Result<Judgements, RunError> {
        let query = entry.query;
        let refused = |reason| RunError::Unsupported {
            place: source.place(&entry),
            reason,
        };
        let truth = oracle::decide_query(&query).map_err(refused)?;
        let second = self.second(&query);
        // What the judges said need not be asked again.
        let said = |judged: &Judged| match judged.subject.name() {
            name if name == oracle::Oracle.name() => Reply::Answer(Answer::Exact(truth)),
            name => match second {
                Some((judge, reply)) if self.second_judges[judge].name() == name => reply,
                _ => ask(judged.subject, &query),
            },
        };
        let found = |judged: &Judged| judged.compare(&query, &truth, said(judged));
        Ok(Judgements {
            subjects: self.subjects.iter().map(found).collect(),
            id: source.identifier(&entry),
            query,
            label: entry.label,
            truth,
            second,
        })
    }

    /// The number of the second judge that takes the query, and what it says.
    fn second(&self, query: &Query) -> Option<(usize, Reply)> {
        let judges = self.second_judges.iter().enumerate();
        let mut replies = judges.map(|(index, judge)| (index, ask(*judge, query)));
        replies.find(|(_, reply)| *reply != Reply::NotAsked)
    }
}

/// The entries in groups of `size`, the last one of what is left.
fn groups(
    mut entries: Entries,
    size: usize,
) -> impl Iterator<Item = Result<Vec<Entry>, RunError>> + Send {
    iter::from_fn(move || {
        let group: Result<Vec<_>, _> = entries.by_ref().take(size).collect();
        match group {
            Ok(group) if group.is_empty() => None,
            group => Some(group.map_err(RunError::from)),
        }
    })
}

/// A query and all that was said and found about it.
struct Judgements {
    id: String,
    query: Query,
    label: Option<bool>,
    truth: ExactAnswer,
    /// The number of the second judge that takes the query, if any, and what it says.
    second: Option<(usize, Reply)>,
    subjects: Vec<Found>,
}

impl Judgements {
    fn witness(&self, answer: Option<Answer>, severity: f64) -> Witness {
        Witness {
            severity,
            id: self.id.clone(),
            query: self.query,
            truth: self.truth,
            answer,
        }
    }

    /// How central the contact is; 0 for a miss.
    fn centrality(&self) -> f64 {
        let outline = Outline::from(&self.truth);
        outline.hit.map_or(0.0, |hit| hit.centrality)
    }
}

/// What was found of one subject on one query.
#[derive(Clone, Debug)]
pub struct Found {
    /// What the subject says; `None` for no answer.
    pub answer: Option<Answer>,
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
        is_asked: false,
        is_hit: false,
        is_miss: false,
        faults: Vec::new(),
        errata: Vec::new(),
    };
}

impl Judged<'_> {
    /// Asks the subject and compares its answer with the exact one. The gap of a false hit is an
    /// estimate; see [`exact_gap`].
    pub fn judge(&self, query: &Query, truth: &ExactAnswer) -> Found {
        self.compare(query, truth, ask(self.subject, query))
    }

    fn compare(&self, query: &Query, truth: &ExactAnswer, reply: Reply) -> Found {
        let answer = match reply {
            Reply::NotAsked => return Found::NOT_ASKED,
            Reply::Answer(answer) => Some(answer),
            Reply::Nothing => None,
        };
        let declared = self.subject.declared_distance();
        let judgement = judge(truth, answer.as_ref(), || {
            declared > 0.0 && oracle::comes_within(query, declared)
        });
        let gap = || oracle::estimate_gap(query);
        let explain = self.explain.filter(|_| judgement.differs);
        Found {
            answer,
            is_asked: true,
            is_hit: judgement.is_hit,
            is_miss: judgement.is_miss(),
            faults: judgement.faults(&truth.into(), gap),
            errata: explain.map_or_else(Vec::new, |explain| explain(query, truth)),
        }
    }
}

impl Block {
    fn add(&mut self, case: Judgements) {
        let witness = |answer, severity| case.witness(answer, severity);
        let hit = case.truth.hit;
        self.queries += 1;
        self.hits += u64::from(hit.is_some());
        self.crossings += u64::from(hit.is_some_and(|hit| hit.crosses));
        self.labels += u64::from(case.label.is_some());
        if case.label.is_some_and(|label| label != hit.is_some()) {
            self.wrong_labels.add(witness(None, 0.0));
        }
        if let Some((judge, reply)) = case.second {
            let agreement = &mut self.agreements[judge];
            agreement.queries += 1;
            if reply != Reply::Answer(Answer::Exact(case.truth)) {
                agreement.disagreements.add(witness(reply.answer(), 0.0));
            }
        }
        for (tally, found) in self.tallies.iter_mut().zip(&case.subjects) {
            let sort = Sort::of(&case.query);
            if found.is_asked {
                tally.taken.insert(sort);
            } else {
                *tally.refused.entry(sort).or_default() += 1;
            }
            tally.hits += u64::from(found.is_hit);
            for &(fault, severity) in &found.faults {
                let finding = tally.faults.entry(fault).or_default();
                finding.add(witness(found.answer, severity));
            }
            for erratum in &found.errata {
                let explained = tally.errata.entry(erratum).or_default();
                let finding = match found.errata.len() {
                    1 => &mut explained.alone,
                    _ => &mut explained.with_others,
                };
                finding.add(witness(found.answer, 0.0));
            }
        }
    }

    /// Counts the joint tunnels of a group: the wire is passed, so that a hit is due in one of its
    /// members.
    fn add_joint(&mut self, members: &[Judgements]) {
        self.joints += 1;
        let more_central =
            |a: &&Judgements, b: &&Judgements| a.centrality().total_cmp(&b.centrality());
        let Some(shown) = members.iter().max_by(more_central) else {
            return;
        };
        for (i, tally) in self.tallies.iter_mut().enumerate() {
            if members.iter().all(|member| member.subjects[i].is_miss) {
                let witness = shown.witness(shown.subjects[i].answer, shown.centrality());
                tally
                    .faults
                    .entry(Fault::JointTunnel)
                    .or_default()
                    .add(witness);
            }
        }
    }

    /// Adds what was found on a later source.
    pub fn merge(&mut self, later: Block) {
        self.queries += later.queries;
        self.hits += later.hits;
        self.crossings += later.crossings;
        self.joints += later.joints;
        self.labels += later.labels;
        self.wrong_labels.merge(later.wrong_labels);
        self.agreements
            .resize_with(later.agreements.len(), Agreement::default);
        for (agreement, later) in self.agreements.iter_mut().zip(later.agreements) {
            agreement.queries += later.queries;
            agreement.disagreements.merge(later.disagreements);
        }
        self.tallies
            .resize_with(later.tallies.len(), Tally::default);
        for (tally, later) in self.tallies.iter_mut().zip(later.tallies) {
            tally.merge(later);
        }
    }
}

/// Puts the exact gap of the worst false hit in the place of the estimate that it was chosen by.
fn measure_gap(tally: &mut Tally) {
    let worst = tally
        .faults
        .get_mut(&Fault::FalseHit)
        .and_then(|finding| finding.worst.as_mut());
    if let Some(witness) = worst {
        witness.severity = exact_gap(&witness.query);
    }
}

/// The gap of a query ([`oracle::least_gap`]), rounded down to about three digits.
pub fn exact_gap(query: &Query) -> f64 {
    oracle::least_gap(query).below
}

/// What comes of asking a subject.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Reply {
    Answer(Answer),
    /// It does not take such queries.
    NotAsked,
    /// It panics, or refuses for a reason that is not that of the query.
    Nothing,
}

impl Reply {
    fn answer(self) -> Option<Answer> {
        match self {
            Reply::Answer(answer) => Some(answer),
            Reply::NotAsked | Reply::Nothing => None,
        }
    }
}

fn ask(subject: &dyn Subject, query: &Query) -> Reply {
    match catch_unwind(AssertUnwindSafe(|| subject.answer(query))) {
        Ok(Ok(answer)) => Reply::Answer(answer),
        Ok(Err(refusal)) if is_of_sort(refusal, query) => Reply::NotAsked,
        Ok(Err(_)) => Reply::Nothing,
        Err(_) => Reply::Nothing,
    }
}

/// Whether what a subject says it does not take is what the query is.
fn is_of_sort(refusal: Unsupported, query: &Query) -> bool {
    match refusal {
        Unsupported::Kind(kind) => kind == query.kind(),
        Unsupported::Radius(radius) => !radius.is_zero() && radius == query.radius(),
    }
}

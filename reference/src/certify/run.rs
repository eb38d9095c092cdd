//! Corpora judged as a whole.

use std::fmt;
use std::iter;
use std::slice;

use tunnelproof::narrow::Unsupported;
use tunnelproof::query::Query;

use crate::answer::ExactAnswer;
use crate::corpus::{CorpusError, Entry};
use crate::oracle;
use crate::subject::{Answer, Lapse, LapseKind, NoAnswer, Subject};

use super::batch::map_chunks_in_order;
use super::fingerprint::Fingerprint;
use super::shard::Shard;
use super::source::{Group, Source};
use super::tally::{Fault, Finding, Sort, Statement, Tally, Witness};
use super::verdict::{Outline, Verdict, judge};

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
    /// A hash of the queries.
    pub fingerprint: Fingerprint,
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
    /// A query that whoever has to answer it does not.
    NoAnswer {
        /// Where the query comes from.
        place: String,
        /// Why there is none.
        reason: NoAnswer,
    },
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RunError::Corpus(error) => error.fmt(f),
            RunError::NoAnswer { place, reason } => write!(f, "{place}: {reason}"),
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
        self.run_shard(source, Shard::WHOLE, progress)
    }

    /// Judges every query of a part of a source, as [`run`](Self::run).
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    pub fn run_shard(
        &self,
        source: &Source,
        shard: Shard,
        progress: impl Fn(u64),
    ) -> Result<Block, RunError> {
        let mut block = Block {
            name: source.name(),
            tallies: vec![Tally::default(); self.subjects.len()],
            agreements: vec![Agreement::default(); self.second_judges.len()],
            ..Block::default()
        };
        let size = source.group_size();
        let groups = source.groups(shard)?;
        let groups = groups.map(|group| group.map_err(RunError::from));
        let work = |groups| self.judge_all(source, groups);
        map_chunks_in_order(groups, CHUNK, work, |groups: Vec<Vec<Judgements>>| {
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

    /// Judges groups of queries. Each subject that is no judge is asked for all of them at once.
    fn judge_all(
        &self,
        source: &Source,
        groups: Vec<Group>,
    ) -> Vec<Result<Vec<Judgements>, RunError>> {
        let entries = groups.iter().flat_map(|group| &group.entries);
        let queries: Vec<_> = entries.map(|entry| entry.query).collect();
        let asked = self.subjects.iter().map(|judged| match judged.subject {
            judge if self.is_judge(judge) => Vec::new(),
            subject => ask_all(subject, &queries),
        });
        let mut asked: Vec<_> = asked.map(Vec::into_iter).collect();
        let mut judge = |(place, entry)| {
            let replies = asked.iter_mut().map(Iterator::next).collect();
            self.judge(source, place, entry, replies)
        };
        let groups = groups.into_iter();
        groups
            .map(|group| (group.first..).zip(group.entries).map(&mut judge).collect())
            .collect()
    }

    fn is_judge(&self, subject: &dyn Subject) -> bool {
        let seconds = self.second_judges.iter().map(|judge| judge.name());
        iter::once(oracle::Oracle.name())
            .chain(seconds)
            .any(|name| name == subject.name())
    }

    /// Judges a query to which the subjects that are no judges gave these replies.
    fn judge(
        &self,
        source: &Source,
        place: u64,
        entry: Entry,
        replies: Vec<Option<Reply>>,
    ) -> Result<Judgements, RunError> {
        let query = entry.query;
        let refused = |reason: Unsupported| RunError::NoAnswer {
            place: source.place(&entry),
            reason: reason.into(),
        };
        let truth = oracle::decide_query(&query).map_err(refused)?;
        let second = self.second(&query);
        // What the judges said need not be asked again.
        let by_judge = |name: &str| match &second {
            _ if name == oracle::Oracle.name() => Some(Reply::Answer(Answer::Exact(truth))),
            Some((judge, reply)) if self.second_judges[*judge].name() == name => {
                Some(reply.clone())
            }
            _ => None,
        };
        let found = |(judged, reply): (&Judged, Option<Reply>)| {
            let reply = reply.or_else(|| by_judge(judged.subject.name()));
            let reply = reply.unwrap_or_else(|| ask(judged.subject, &query));
            judged.compare(&query, &truth, reply)
        };
        Ok(Judgements {
            subjects: self.subjects.iter().zip(replies).map(found).collect(),
            id: source.identifier(&entry),
            place,
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

/// How many groups of queries are judged in one go, so that a subject is asked for several at once.
const CHUNK: usize = 64;

/// A query and all that was said and found about it.
struct Judgements {
    id: String,
    place: u64,
    query: Query,
    label: Option<bool>,
    truth: ExactAnswer,
    /// The number of the second judge that takes the query, if any, and what it says.
    second: Option<(usize, Reply)>,
    subjects: Vec<Found>,
}

impl Judgements {
    fn witness(&self, severity: f64) -> Witness {
        Witness {
            severity,
            rank: severity,
            place: self.place,
            id: self.id.clone(),
            query: self.query,
            truth: self.truth,
            answer: None,
            lapse: None,
        }
    }

    fn witness_of(&self, found: &Found, severity: f64) -> Witness {
        Witness {
            answer: found.answer.map(Statement::Answer),
            lapse: found.lapse.clone(),
            ..self.witness(severity)
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
    /// estimate; see [`exact_gap`].
    pub fn judge(&self, query: &Query, truth: &ExactAnswer) -> Found {
        self.compare(query, truth, ask(self.subject, query))
    }

    fn compare(&self, query: &Query, truth: &ExactAnswer, reply: Reply) -> Found {
        let (answer, lapse) = match reply {
            Reply::NotAsked => return Found::NOT_ASKED,
            Reply::Answer(answer) => (Some(answer), None),
            Reply::Nothing(lapse) => (None, Some(lapse)),
        };
        let declared = self.subject.declared_distance();
        let judgement = judge(truth, answer.as_ref(), || {
            declared > 0.0 && oracle::comes_within(query, declared)
        });
        let gap = || oracle::estimate_gap(query);
        let explain = self.explain.filter(|_| judgement.differs);
        Found {
            answer,
            lapse: lapse.or_else(|| no_time(judgement.verdict)),
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
        let hit = case.truth.hit;
        self.queries += 1;
        self.fingerprint.add(case.place, &case.query);
        self.hits += u64::from(hit.is_some());
        self.crossings += u64::from(hit.is_some_and(|hit| hit.crosses));
        self.labels += u64::from(case.label.is_some());
        if case.label.is_some_and(|label| label != hit.is_some()) {
            self.wrong_labels.add(case.witness(0.0));
        }
        if let Some((judge, reply)) = &case.second {
            let agreement = &mut self.agreements[*judge];
            agreement.queries += 1;
            if *reply != Reply::Answer(Answer::Exact(case.truth)) {
                agreement.disagreements.add(Witness {
                    answer: reply.answer().map(Statement::Answer),
                    ..case.witness(0.0)
                });
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
            if let Some(lapse) = &found.lapse {
                *tally.lapses.entry(lapse.kind).or_default() += 1;
            }
            for &(fault, severity) in &found.faults {
                let finding = tally.faults.entry(fault).or_default();
                finding.add(case.witness_of(found, severity));
            }
            for erratum in &found.errata {
                let explained = tally.errata.entry((*erratum).to_owned()).or_default();
                let finding = match found.errata.len() {
                    1 => &mut explained.alone,
                    _ => &mut explained.with_others,
                };
                finding.add(case.witness_of(found, 0.0));
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
                let witness = shown.witness_of(&shown.subjects[i], shown.centrality());
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
        self.add_block(later, Finding::merge, Tally::merge);
    }

    /// Adds what was found on another part of the same source, whichever was first.
    pub fn join(&mut self, other: Block) {
        self.add_block(other, Finding::join, Tally::join);
    }

    fn add_block(
        &mut self,
        later: Block,
        add: fn(&mut Finding, Finding),
        add_tally: fn(&mut Tally, Tally),
    ) {
        self.fingerprint.merge(later.fingerprint);
        self.queries += later.queries;
        self.hits += later.hits;
        self.crossings += later.crossings;
        self.joints += later.joints;
        self.labels += later.labels;
        add(&mut self.wrong_labels, later.wrong_labels);
        self.agreements
            .resize_with(later.agreements.len(), Agreement::default);
        for (agreement, later) in self.agreements.iter_mut().zip(later.agreements) {
            agreement.queries += later.queries;
            add(&mut agreement.disagreements, later.disagreements);
        }
        self.tallies
            .resize_with(later.tallies.len(), Tally::default);
        for (tally, later) in self.tallies.iter_mut().zip(later.tallies) {
            add_tally(tally, later);
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

/// That a time of impact is no time of the step, if that is why an answer is none.
fn no_time(verdict: Verdict) -> Option<Lapse> {
    let lapse = || Lapse::new(LapseKind::NoTime, "toi is not a number from 0 to 1");
    (verdict == Verdict::NoAnswer).then(lapse)
}

/// What comes of asking a subject.
#[derive(Clone, Debug, PartialEq)]
enum Reply {
    Answer(Answer),
    /// It does not take such queries.
    NotAsked,
    /// It takes them and fails.
    Nothing(Lapse),
}

impl Reply {
    fn answer(&self) -> Option<Answer> {
        match self {
            Reply::Answer(answer) => Some(*answer),
            Reply::NotAsked | Reply::Nothing(_) => None,
        }
    }
}

fn ask(subject: &dyn Subject, query: &Query) -> Reply {
    let mut replies = ask_all(subject, slice::from_ref(query));
    replies.remove(0)
}

fn ask_all(subject: &dyn Subject, queries: &[Query]) -> Vec<Reply> {
    let answers = subject.answers(queries);
    assert_eq!(
        answers.len(),
        queries.len(),
        "{} answers each query once",
        subject.name()
    );
    let replies = answers.into_iter().zip(queries);
    replies
        .map(|(answer, query)| match answer {
            Ok(answer) => Reply::Answer(answer),
            Err(NoAnswer::Lapse(lapse)) => Reply::Nothing(lapse),
            Err(NoAnswer::Unsupported(reason)) if is_of_sort(reason, query) => Reply::NotAsked,
            Err(NoAnswer::Unsupported(reason)) => {
                Reply::Nothing(Lapse::new(LapseKind::Refused, reason.to_string()))
            }
        })
        .collect()
}

/// Whether what a subject says it does not take is what the query is.
fn is_of_sort(refusal: Unsupported, query: &Query) -> bool {
    match refusal {
        Unsupported::Kind(kind) => kind == query.kind(),
        Unsupported::Radius(radius) => !radius.is_zero() && radius == query.radius(),
    }
}

//! Corpora judged as a whole.

use std::fmt;
use std::iter;

use crate::corpus::CorpusError;
use crate::generate;
use crate::oracle;
use crate::subject::{Answer, NoAnswer, Subject};

use super::batch::map_chunks_in_order;
use super::block::{Agreement, Block, Judgements, measure_gap};
use super::fingerprint::Fingerprint;
use super::judged::Judged;
use super::query::AnyQuery;
use super::reply::{Reply, ask, ask_all};
use super::shard::Shard;
use super::source::{AnyEntry, AnySource, Group};
use super::tally::Tally;

/// Who judges and who is judged. A subject with the name of a judge is that judge.
#[derive(Clone)]
pub struct Panel<'a> {
    /// The first of them that takes a query has to agree with the oracle on it.
    pub second_judges: Vec<&'a dyn Subject>,
    /// Who is judged, in the order of tables.
    pub subjects: Vec<Judged<'a>>,
}

/// Why judging ended early.
#[derive(Debug)]
#[non_exhaustive]
pub enum RunError {
    /// No family has this name.
    Family(String),
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
            RunError::Family(name) => {
                let names: Vec<_> = generate::all().map(|family| family.name()).collect();
                write!(
                    f,
                    "no family is called {name}; there are {}",
                    names.join(", ")
                )
            }
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
    /// [`RunError`] for the first query that cannot be read.
    pub fn run(&self, source: &AnySource, progress: impl Fn(u64)) -> Result<Block, RunError> {
        self.run_shard(source, Shard::WHOLE, progress)
    }

    /// Judges every query of a part of a source, as [`run`](Self::run).
    ///
    /// # Errors
    ///
    /// As [`run`](Self::run).
    pub fn run_shard(
        &self,
        source: &AnySource,
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
        let work = |groups| {
            let judged = self.judge_all(groups);
            judged.into_iter().map(Ok).collect()
        };
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
    fn judge_all(&self, groups: Vec<Group>) -> Vec<Vec<Judgements>> {
        let entries = groups.iter().flat_map(|group| &group.entries);
        let queries: Vec<_> = entries.map(|entry| entry.query).collect();
        let asked = self.subjects.iter().map(|judged| match judged.subject {
            judge if self.is_judge(judge) => Vec::new(),
            subject => ask_all(subject, &queries),
        });
        let mut asked: Vec<_> = asked.map(Vec::into_iter).collect();
        let mut judge = |(place, entry)| {
            let replies = asked.iter_mut().map(Iterator::next).collect();
            self.judge(place, entry, replies)
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
    fn judge(&self, place: u64, entry: AnyEntry, replies: Vec<Option<Reply>>) -> Judgements {
        let query = entry.query;
        let truth = query.decide();
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
        Judgements {
            subjects: self.subjects.iter().zip(replies).map(found).collect(),
            id: entry.id,
            place,
            query,
            fingerprint: Fingerprint::of(place, &query),
            label: entry.label,
            truth,
            second,
        }
    }

    /// The number of the second judge that takes the query, and what it says.
    fn second(&self, query: &AnyQuery) -> Option<(usize, Reply)> {
        let judges = self.second_judges.iter().enumerate();
        let mut replies = judges.map(|(index, judge)| (index, ask(*judge, query)));
        replies.find(|(_, reply)| *reply != Reply::NotAsked)
    }
}

/// How many groups of queries are judged in one go, so that a subject is asked for several at once.
const CHUNK: usize = 64;

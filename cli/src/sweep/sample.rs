//! The queries that settings are judged on, and what is known of them.

use std::ops::Range;
use std::sync::OnceLock;

use hmac_sha256::Hash;
use rayon::prelude::*;
use tunnelproof::narrow::Unsupported;
use tunnelproof::query::{EdgeEdge, Query};

use tunnelproof_reference::certify::batch::map_in_order;
use tunnelproof_reference::certify::run::RunError;
use tunnelproof_reference::certify::source::Source;
use tunnelproof_reference::certify::tally::Fault;
use tunnelproof_reference::certify::verdict::{Outline, judge_outline};
use tunnelproof_reference::corpus::{CorpusError, Entry, Problem};
use tunnelproof_reference::distance::estimate_gap;
use tunnelproof_reference::oracle;
use tunnelproof_reference::subject::Said;

use super::container::Key;
use super::domain::Domain;
use super::price::Counts;
use super::record::{self, Record};
use super::run::{Interrupted, Watch};

/// How many queries are judged at once on one thread.
const CHUNK: usize = 4096;

/// Queries of one domain, and what the verdicts need of their exact answers once that was found.
pub struct Sample {
    domain: Domain,
    parts: Vec<Part>,
    ids: Vec<String>,
    queries: Vec<EdgeEdge>,
    truths: Vec<OnceLock<Outline>>,
    /// In floating point: to choose what is measured.
    estimates: Vec<OnceLock<f64>>,
    gaps: Vec<OnceLock<f64>>,
}

/// The queries of a sample that come from one source.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The name of the source.
    pub name: String,
    /// Which queries.
    pub range: Range<usize>,
    /// How many consecutive ones belong together.
    pub group_size: usize,
}

impl Sample {
    /// Reads every query of the sources. `progress` is told how many were read since it was told
    /// before.
    ///
    /// # Errors
    ///
    /// [`RunError`] for the first query that cannot be read, or that is not one of two edges with
    /// radius 0, or whose coordinates are too large for the domain.
    pub fn read(
        domain: Domain,
        sources: &[Source],
        progress: impl Fn(u64),
    ) -> Result<Self, RunError> {
        let mut parts = Vec::new();
        let (mut ids, mut queries) = (Vec::new(), Vec::new());
        for source in sources {
            let start = queries.len();
            let entries = source.entries()?.map(|entry| entry.map_err(RunError::from));
            let place = |entry: Entry| {
                let query = in_domain(&domain, source, &entry)?;
                Ok((source.identifier(&entry), query))
            };
            map_in_order(entries, place, |placed| {
                progress(placed.len() as u64);
                for (id, query) in placed {
                    ids.push(id);
                    queries.push(query);
                }
                Ok::<_, RunError>(())
            })?;
            parts.push(Part {
                name: source.name(),
                range: start..queries.len(),
                group_size: source.group_size(),
            });
        }
        Ok(Sample {
            domain,
            parts,
            ids,
            truths: queries.iter().map(|_| OnceLock::new()).collect(),
            estimates: queries.iter().map(|_| OnceLock::new()).collect(),
            gaps: queries.iter().map(|_| OnceLock::new()).collect(),
            queries,
        })
    }

    /// How large the scene is, and how precise.
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// Where the queries come from.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// The identifiers of the queries; a query is that of its identifier, in the domain.
    pub fn ids(&self) -> &[String] {
        &self.ids
    }

    /// The queries.
    pub fn queries(&self) -> &[EdgeEdge] {
        &self.queries
    }

    /// A query as an entry of a corpus.
    pub fn entry(&self, index: usize) -> Entry {
        Entry::unlabelled(&self.ids[index], Query::EdgeEdge(self.queries[index]))
    }

    /// What the verdicts need of the exact answer to a query; it is found if it is not known.
    pub fn truth(&self, index: usize) -> &Outline {
        self.truths[index].get_or_init(|| {
            let decision = oracle::decide_query(&Query::EdgeEdge(self.queries[index]));
            (&decision).into()
        })
    }

    /// Finds the truth of every query, as far as it is not known.
    ///
    /// # Errors
    ///
    /// [`Interrupted`] if the watch says so; what was found stays.
    pub fn find_truths(&self, watch: &Watch) -> Result<(), Interrupted> {
        (0..self.queries.len())
            .into_par_iter()
            .try_for_each(|index| {
                watch.check()?;
                self.truth(index);
                watch.progress(1);
                Ok(())
            })
    }

    /// How many truths are known.
    pub fn known_truths(&self) -> usize {
        let truths = self.truths.iter();
        truths.filter(|truth| truth.get().is_some()).count()
    }

    /// The least distances of these queries in metres, in floating point. Heuristic.
    pub fn estimate_gaps(&self, queries: &[usize]) -> Vec<f64> {
        let estimate = |&index: &usize| {
            let estimate = || estimate_gap(&Query::EdgeEdge(self.queries[index]));
            *self.estimates[index].get_or_init(estimate)
        };
        queries.par_iter().map(estimate).collect()
    }

    /// The least distance of a query in metres, rounded down to about three digits.
    pub fn gap(&self, index: usize) -> f64 {
        let measure = || oracle::least_gap(&Query::EdgeEdge(self.queries[index])).below;
        *self.gaps[index].get_or_init(measure)
    }

    /// Judges the answers of a subject to the queries of these parts.
    ///
    /// # Errors
    ///
    /// [`Interrupted`] if the watch says so.
    pub fn judge(
        &self,
        subject: &(impl Fn(&EdgeEdge) -> Said + Sync),
        parts: &[Part],
        watch: &Watch,
    ) -> Result<Counts, Interrupted> {
        let chunks: Vec<_> = parts.iter().flat_map(Part::chunks).collect();
        let judged: Vec<_> = chunks
            .into_par_iter()
            .map(|(chunk, group_size)| {
                watch.check()?;
                let counts = self.judge_chunk(subject, chunk.clone(), group_size);
                watch.progress(chunk.len() as u64);
                Ok(counts)
            })
            .collect::<Result<_, _>>()?;
        let mut total = Counts::default();
        judged.into_iter().for_each(|counts| total.merge(counts));
        Ok(total)
    }

    fn judge_chunk(
        &self,
        subject: impl Fn(&EdgeEdge) -> Said,
        chunk: Range<usize>,
        group_size: usize,
    ) -> Counts {
        let mut counts = Counts::default();
        for start in chunk.clone().step_by(group_size) {
            let group = start..chunk.end.min(start + group_size);
            let mut is_missed = group.len() == group_size && group_size > 1;
            for index in group.clone() {
                let truth = self.truth(index);
                let judgement = judge_outline(truth, &subject(&self.queries[index]), || false);
                counts.add(index, truth, &judgement);
                is_missed &= judgement.is_miss();
            }
            if is_missed {
                let (severity, index) = self.most_central(group);
                counts.add_fault(Fault::JointTunnel, severity, index);
            }
        }
        counts
    }

    /// The most central contact of these queries, of equals the last, and whose it is.
    fn most_central(&self, group: Range<usize>) -> (f64, usize) {
        let centrality = |index: usize| self.truth(index).hit.map_or(0.0, |hit| hit.centrality);
        let all = group.map(|index| (centrality(index), index));
        all.fold(
            (0.0, 0),
            |best, other| if other.0 >= best.0 { other } else { best },
        )
    }

    /// A hash of the queries, their domain and where they come from.
    pub(super) fn key(&self) -> Key {
        let mut hash = Hash::new();
        hash.update(env!("CARGO_PKG_VERSION"));
        for part in &self.parts {
            hash.update(&part.name);
            hash.update([0]);
            hash.update((part.range.len() as u64).to_le_bytes());
            hash.update((part.group_size as u64).to_le_bytes());
        }
        for (id, query) in self.ids.iter().zip(&self.queries) {
            hash.update(id);
            hash.update([0]);
            for point in query.start().iter().chain(query.end()) {
                point.iter().for_each(|x| hash.update(x.to_le_bytes()));
            }
        }
        hash.finalize()
    }

    /// What is known of every query.
    pub(super) fn records(&self) -> Vec<u8> {
        let record = |index: usize| Record {
            outline: self.truths[index].get().copied(),
            estimate: self.estimates[index].get().copied(),
            gap: self.gaps[index].get().copied(),
        };
        let records = (0..self.queries.len()).map(|index| record(index).to_bytes());
        records.flatten().collect()
    }

    /// Takes over what was known of every query; all or, if these are no such records, nothing.
    pub(super) fn take_records(&mut self, bytes: &[u8]) -> Option<()> {
        let (records, []) = bytes.as_chunks::<{ record::SIZE }>() else {
            return None;
        };
        if records.len() != self.queries.len() {
            return None;
        }
        let records: Vec<_> = records
            .iter()
            .map(Record::from_bytes)
            .collect::<Option<_>>()?;
        self.truths = records.iter().map(|record| lock(record.outline)).collect();
        self.estimates = records.iter().map(|record| lock(record.estimate)).collect();
        self.gaps = records.iter().map(|record| lock(record.gap)).collect();
        Some(())
    }
}

fn lock<T>(value: Option<T>) -> OnceLock<T> {
    value.map_or_else(OnceLock::new, OnceLock::from)
}

/// The query of an entry in the domain.
fn in_domain(domain: &Domain, source: &Source, entry: &Entry) -> Result<EdgeEdge, RunError> {
    let place = source.place(entry);
    let refuse = |reason: Unsupported| RunError::NoAnswer {
        place: source.place(entry),
        reason: reason.into(),
    };
    match &entry.query {
        Query::VertexFace(_) => Err(refuse(Unsupported::Kind(entry.query.kind()))),
        Query::EdgeEdge(query) if !query.radius().is_zero() => {
            Err(refuse(Unsupported::Radius(query.radius())))
        }
        Query::EdgeEdge(query) => {
            let scaled = domain.apply(query);
            scaled.map_err(|error| CorpusError::new(&place, Problem::Query(error)).into())
        }
    }
}

impl Part {
    /// Ranges of no more than a chunk, none of which cuts a group, and the size of the groups.
    fn chunks(&self) -> impl Iterator<Item = (Range<usize>, usize)> + use<> {
        let Range { start, end } = self.range;
        let size = self.group_size;
        let step = CHUNK / size * size;
        let starts = (start..end).step_by(step);
        starts.map(move |start| (start..end.min(start + step), size))
    }
}

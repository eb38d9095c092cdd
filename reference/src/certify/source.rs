//! Where the queries that are judged come from.

use std::sync::Arc;

use crate::figures::{self, FIGURES};
use tunnelproof::query::Query;

use crate::corpus::turning::{self, TurningEntry};
use crate::corpus::{self, CorpusError, Entries, Entry, ReadOptions};
use crate::generate::{Family, GeneratedId, RigidFamily, RigidId};

use super::query::AnyQuery;
use super::shard::Shard;

/// A finite sequence of queries with a name, which may be of bodies that turn.
#[derive(Clone, Debug)]
pub enum AnySource {
    /// Queries of linear motion.
    Linear(Source),
    /// Queries of bodies that turn.
    Turning(TurningSource),
}

/// A family of queries of linear motion, or of bodies that turn.
#[derive(Clone, Copy, Debug)]
pub enum AnyFamily {
    /// Of linear motion.
    Linear(&'static Family),
    /// Of bodies that turn.
    Turning(&'static RigidFamily),
}

impl AnyFamily {
    /// The name used in identifiers.
    pub fn name(&self) -> &'static str {
        match self {
            AnyFamily::Linear(family) => family.name(),
            AnyFamily::Turning(family) => family.name(),
        }
    }

    /// Whether it is of bodies that turn.
    pub fn turns(&self) -> bool {
        matches!(self, AnyFamily::Turning(_))
    }

    /// The query of this seed and index.
    pub fn query(&self, seed: u64, index: u64) -> AnyQuery {
        match self {
            AnyFamily::Linear(family) => family.query(seed, index).into(),
            AnyFamily::Turning(family) => family.query(seed, index).into(),
        }
    }

    /// Its first queries.
    pub fn first(&self, seed: u64, count: u64) -> AnySource {
        match *self {
            AnyFamily::Linear(family) => Source::Family {
                family,
                seed,
                count,
            }
            .into(),
            AnyFamily::Turning(family) => TurningSource::Family {
                family,
                seed,
                count,
            }
            .into(),
        }
    }
}

/// A finite sequence of queries of bodies that turn, with a name.
#[derive(Clone, Debug)]
pub enum TurningSource {
    /// The first queries of a family.
    Family {
        /// The family.
        family: &'static RigidFamily,
        /// The seed of the family.
        seed: u64,
        /// How many queries.
        count: u64,
    },
    /// A corpus.
    File {
        /// Its path, `-` for the standard input.
        path: String,
    },
}

/// A finite sequence of queries of linear motion with a name.
#[derive(Clone, Debug)]
pub enum Source {
    /// The cases of thesis section 4.1, labelled with whether they are hits.
    Figures,
    /// The first queries of a family.
    Family {
        /// The family.
        family: &'static Family,
        /// The seed of the family.
        seed: u64,
        /// How many queries.
        count: u64,
    },
    /// Queries that are there.
    Queries {
        /// What they are called, together.
        name: String,
        /// The queries.
        queries: Arc<[Query]>,
    },
    /// A corpus.
    File {
        /// Its path, `-` for the standard input.
        path: String,
        /// How it is read.
        options: ReadOptions,
    },
}

/// Consecutive queries that belong together ([`Family::group_size`]).
pub struct Group {
    /// The place of the first in the source, from 0.
    pub first: u64,
    /// The queries.
    pub entries: Vec<AnyEntry>,
}

/// A query that is judged.
pub struct AnyEntry {
    /// What `explain` knows it by.
    pub id: String,
    /// The query.
    pub query: AnyQuery,
    /// Whether it is known to be a hit; `None` if the source does not say.
    pub label: Option<bool>,
}

/// Groups of queries. After an error there are no more.
pub type Groups = Box<dyn Iterator<Item = Result<Group, CorpusError>> + Send>;

fn generated(family: &'static Family, seed: u64, index: u64) -> Entry {
    let id = GeneratedId {
        family,
        seed,
        index,
    };
    Entry::unlabelled(id.to_string(), id.query())
}

impl Source {
    /// The name used in tables.
    pub fn name(&self) -> String {
        match self {
            Source::Figures => figures::SOURCE.to_owned(),
            Source::Family { family, .. } => family.name().to_owned(),
            Source::Queries { name, .. } => name.clone(),
            Source::File { path, .. } => path.clone(),
        }
    }

    /// How many queries there are, if that is known beforehand.
    pub fn count(&self) -> Option<u64> {
        match self {
            Source::Figures => Some(FIGURES.len() as u64),
            Source::Family { count, .. } => Some(*count),
            Source::Queries { queries, .. } => Some(queries.len() as u64),
            Source::File { .. } => None,
        }
    }

    /// How many consecutive queries belong together ([`Family::group_size`]).
    pub fn group_size(&self) -> usize {
        match self {
            Source::Family { family, .. } => family.group_size(),
            Source::Figures | Source::Queries { .. } | Source::File { .. } => 1,
        }
    }

    /// The queries in their order.
    ///
    /// # Errors
    ///
    /// [`CorpusError`] if a corpus cannot be opened.
    pub fn entries(&self) -> Result<Entries, CorpusError> {
        match self {
            Source::Figures => Ok(Box::new(corpus::figures::entries().map(Ok))),
            &Source::Family {
                family,
                seed,
                count,
            } => {
                let entries = (0..count).map(move |index| Ok(generated(family, seed, index)));
                Ok(Box::new(entries))
            }
            Source::Queries { name, queries } => {
                let (name, queries) = (name.clone(), Arc::clone(queries));
                let entry =
                    move |index| Entry::unlabelled(format!("-#{name}:{index}"), queries[index]);
                Ok(Box::new(
                    (0..self.count().unwrap_or(0) as usize).map(entry).map(Ok),
                ))
            }
            Source::File { path, options } => corpus::open(path, *options),
        }
    }

    fn groups(&self, shard: Shard) -> Result<Groups, CorpusError> {
        let size = self.group_size() as u64;
        if let &Source::Family {
            family,
            seed,
            count,
        } = self
        {
            let firsts = (0..count.div_ceil(size)).filter(move |group| shard.has(*group));
            return Ok(Box::new(firsts.map(move |group| {
                let first = group * size;
                let indices = first..count.min(first + size);
                let entries = indices.map(|index| generated(family, seed, index).into());
                let entries = entries.collect();
                Ok(Group { first, entries })
            })));
        }
        let path = self.path().map(str::to_owned);
        let entries = self.entries()?.map(move |entry| {
            let mut entry = AnyEntry::from(entry?);
            entry.id = identifier(path.as_deref(), entry.id);
            Ok(entry)
        });
        Ok(singly(entries, shard))
    }

    /// What `explain` knows an entry of this source by.
    pub fn identifier(&self, entry: &Entry) -> String {
        identifier(self.path(), entry.id.clone())
    }

    fn path(&self) -> Option<&str> {
        match self {
            Source::File { path, .. } => Some(path),
            _ => None,
        }
    }

    /// Where an entry of this source stands, for errors: `file:line`, or its name.
    pub fn place(&self, entry: &Entry) -> String {
        match (self, entry.line) {
            (Source::File { path, .. }, Some(line)) => format!("{path}:{line}"),
            _ => entry.id.clone(),
        }
    }
}

/// What `explain` knows a query by that a file calls so.
fn identifier(path: Option<&str>, id: String) -> String {
    match path {
        Some(path) if !id.starts_with(&format!("{path}#")) => format!("{path}#{id}"),
        _ => id,
    }
}

/// Each query of a part by itself.
fn singly(
    entries: impl Iterator<Item = Result<AnyEntry, CorpusError>> + Send + 'static,
    shard: Shard,
) -> Groups {
    let is_mine = move |(place, entry): &(u64, Result<_, _>)| entry.is_err() || shard.has(*place);
    Box::new((0..).zip(entries).filter(is_mine).map(|(first, entry)| {
        let entries = vec![entry?];
        Ok(Group { first, entries })
    }))
}

impl TurningSource {
    fn groups(&self, shard: Shard) -> Result<Groups, CorpusError> {
        match self.clone() {
            TurningSource::Family {
                family,
                seed,
                count,
            } => {
                let places = (0..count).filter(move |place| shard.has(*place));
                Ok(Box::new(places.map(move |first| {
                    let id = RigidId {
                        family,
                        seed,
                        index: first,
                    };
                    let entries = vec![AnyEntry {
                        id: id.to_string(),
                        query: id.query().into(),
                        label: None,
                    }];
                    Ok(Group { first, entries })
                })))
            }
            TurningSource::File { path } => {
                let entries = turning::open(&path)?.map(move |entry| {
                    let TurningEntry { id, query, label } = entry?;
                    Ok(AnyEntry {
                        id: identifier(Some(&path), id),
                        query: query.into(),
                        label,
                    })
                });
                Ok(singly(entries, shard))
            }
        }
    }
}

impl AnySource {
    /// The name used in tables.
    pub fn name(&self) -> String {
        match self {
            AnySource::Linear(source) => source.name(),
            AnySource::Turning(TurningSource::Family { family, .. }) => family.name().to_owned(),
            AnySource::Turning(TurningSource::File { path }) => path.clone(),
        }
    }

    /// How many queries there are, if that is known beforehand.
    pub fn count(&self) -> Option<u64> {
        match self {
            AnySource::Linear(source) => source.count(),
            AnySource::Turning(TurningSource::Family { count, .. }) => Some(*count),
            AnySource::Turning(TurningSource::File { .. }) => None,
        }
    }

    /// How many consecutive queries belong together ([`Family::group_size`]).
    pub fn group_size(&self) -> usize {
        match self {
            AnySource::Linear(source) => source.group_size(),
            AnySource::Turning(_) => 1,
        }
    }

    /// The groups of queries of a part of the source, in their order. Queries of other parts are
    /// not made, where they need not be read.
    ///
    /// # Errors
    ///
    /// [`CorpusError`] if a corpus cannot be opened.
    pub fn groups(&self, shard: Shard) -> Result<Groups, CorpusError> {
        match self {
            AnySource::Linear(source) => source.groups(shard),
            AnySource::Turning(source) => source.groups(shard),
        }
    }
}

impl From<Source> for AnySource {
    fn from(source: Source) -> Self {
        AnySource::Linear(source)
    }
}

impl From<TurningSource> for AnySource {
    fn from(source: TurningSource) -> Self {
        AnySource::Turning(source)
    }
}

impl From<Entry> for AnyEntry {
    fn from(entry: Entry) -> Self {
        AnyEntry {
            id: entry.id,
            query: entry.query.into(),
            label: entry.label,
        }
    }
}

//! Where the queries that are judged come from.

use std::sync::Arc;

use crate::figures::{self, FIGURES};
use tunnelproof::query::Query;

use crate::corpus::{self, CorpusError, Entries, Entry, ReadOptions};
use crate::generate::{Family, GeneratedId};

use super::shard::Shard;

/// A finite sequence of queries with a name.
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
    pub entries: Vec<Entry>,
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

    /// The groups of queries of a part of the source, in their order. Queries of other parts are
    /// not made, where they need not be read.
    ///
    /// # Errors
    ///
    /// [`CorpusError`] if a corpus cannot be opened.
    pub fn groups(&self, shard: Shard) -> Result<Groups, CorpusError> {
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
                let entries = indices.map(|index| generated(family, seed, index));
                let entries = entries.collect();
                Ok(Group { first, entries })
            })));
        }
        let places = (0..).zip(self.entries()?);
        let is_mine =
            move |(place, entry): &(u64, Result<_, _>)| entry.is_err() || shard.has(*place);
        Ok(Box::new(places.filter(is_mine).map(|(first, entry)| {
            let entries = vec![entry?];
            Ok(Group { first, entries })
        })))
    }

    /// What `explain` knows an entry of this source by.
    pub fn identifier(&self, entry: &Entry) -> String {
        match self {
            Source::File { path, .. } if !entry.id.starts_with(&format!("{path}#")) => {
                format!("{path}#{}", entry.id)
            }
            _ => entry.id.clone(),
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

//! Where the queries that are judged come from.

use tunnelproof::scenario::figures::FIGURES;

use crate::corpus::{self, CorpusError, Entries, Entry, ReadOptions};
use crate::generate::{Family, GeneratedId};

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
    /// A corpus.
    File {
        /// Its path, `-` for the standard input.
        path: String,
        /// How it is read.
        options: ReadOptions,
    },
}

impl Source {
    /// The name used in tables.
    pub fn name(&self) -> String {
        match self {
            Source::Figures => "figures".to_owned(),
            Source::Family { family, .. } => family.name().to_owned(),
            Source::File { path, .. } => path.clone(),
        }
    }

    /// How many queries there are, if that is known beforehand.
    pub fn count(&self) -> Option<u64> {
        match self {
            Source::Figures => Some(FIGURES.len() as u64),
            Source::Family { count, .. } => Some(*count),
            Source::File { .. } => None,
        }
    }

    /// How many consecutive queries belong together ([`Family::group_size`]).
    pub fn group_size(&self) -> usize {
        match self {
            Source::Family { family, .. } => family.group_size(),
            Source::Figures | Source::File { .. } => 1,
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
                let ids = (0..count).map(move |index| GeneratedId {
                    family,
                    seed,
                    index,
                });
                Ok(Box::new(ids.map(|id| {
                    Ok(Entry::unlabelled(id.to_string(), id.query()))
                })))
            }
            Source::File { path, options } => corpus::open(path, *options),
        }
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

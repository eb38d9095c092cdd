//! Corpora: files of queries, and the identifiers that name a query.
//!
//! Read are [`jsonl`], this project's own format, [`csv`], the public CCD query format, and files
//! of test vectors, each, with the feature `packed`, also packed by gzip (`.gz`) or zstd (`.zst`).
//! Queries of bodies that turn are lines of their own, [`turning`].
//! The first two stream, so memory does not grow with the file. Input is exact: a coordinate is the
//! `f64` that the file states, or the file is refused. [`folder`] finds the files of a folder, such
//! as the public benchmarks.
//!
//! A query is known by an identifier that [`locate`](locate::locate) resolves:
//!
//! | identifier | query |
//! | --- | --- |
//! | `PATH.csv#INDEX` | of a csv file, counted from 0 |
//! | `PATH.jsonl#ID` | of a jsonl file, with this `id` |
//! | `PATH.json#ID` | of a file of test vectors, with this `id` |
//! | `FAMILY:SEED:INDEX` | of a [family](crate::generate) |
//! | `figure:NAME` | of a [figure](figures) of the thesis |
//! | `-` | the first on the standard input |

use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

use tunnelproof::query::{Query, QueryKind, Radius};

pub use dyadic::NotF64;
pub use error::{CorpusError, Problem};

pub mod csv;
mod dyadic;
mod error;
pub mod figures;
pub mod folder;
pub mod hexfloat;
pub mod jsonl;
mod lines;
pub mod locate;
mod packed;
pub mod turning;
mod vector_file;

use lines::Lines;
use packed::Packing;

/// A query of a corpus.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// What the query is known by.
    pub id: String,
    /// The query.
    pub query: Query,
    /// Whether it is known to be a hit; `None` if the corpus does not say.
    pub label: Option<bool>,
    /// The line it starts on, from 1; `None` if it does not come from a file.
    pub line: Option<u64>,
}

impl Entry {
    /// A query that comes from no file and of which nothing is known.
    pub fn unlabelled(id: impl Into<String>, query: Query) -> Self {
        Entry {
            id: id.into(),
            query,
            label: None,
            line: None,
        }
    }
}

/// What the reader of a corpus is told besides its path.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReadOptions {
    /// The kind of the queries; needed where the corpus does not state it. A corpus that states
    /// another kind is refused.
    pub kind: Option<QueryKind>,
    /// A radius in place of the one of every query.
    pub radius: Option<Radius>,
}

impl ReadOptions {
    /// The kind of a query whose corpus states `stated`.
    fn kind_of(&self, stated: Option<QueryKind>) -> Result<QueryKind, Problem> {
        match (stated, self.kind) {
            (Some(stated), Some(asked)) if stated != asked => {
                Err(Problem::KindContradiction { stated, asked })
            }
            (stated, asked) => stated.or(asked).ok_or(Problem::KindMissing),
        }
    }
}

/// The formats of corpora.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// [`jsonl`], or a file of test vectors.
    Jsonl,
    /// [`csv`].
    Csv,
}

impl Format {
    /// The format of a file, by its extension: `.jsonl`, `.ndjson` and `.json`, or `.csv`; `.gz` or
    /// `.zst` may follow.
    pub fn of_path(path: &str) -> Option<Self> {
        let (_, path) = Packing::of_path(path);
        let extension = Path::new(path).extension()?.to_str()?;
        match extension.to_ascii_lowercase().as_str() {
            "jsonl" | "ndjson" | "json" => Some(Format::Jsonl),
            "csv" => Some(Format::Csv),
            _ => None,
        }
    }

    /// The format of a text with this first line: a csv starts with an integer.
    fn of_first_line(text: &str) -> Self {
        match text.trim_start().bytes().next() {
            Some(b'0'..=b'9' | b'+' | b'-') => Format::Csv,
            _ => Format::Jsonl,
        }
    }
}

/// The queries of a corpus in their order. After an error there are no more.
pub type Entries = Box<dyn Iterator<Item = Result<Entry, CorpusError>> + Send>;

/// Opens a corpus: the file at `path`, in the format of its extension, or the standard input for
/// `-`, in the format that its first line has.
///
/// # Errors
///
/// [`CorpusError`] if there is no such file, if its format is not known or, for a csv, its kind.
pub fn open(path: &str, options: ReadOptions) -> Result<Entries, CorpusError> {
    if path == "-" {
        return read(BufReader::new(io::stdin()), path, None, options);
    }
    let refuse = |problem| CorpusError::new(path, problem);
    let file = File::open(path).map_err(|error| refuse(Problem::Io(error)))?;
    if file.metadata().is_ok_and(|metadata| metadata.is_dir()) {
        return Err(refuse(Problem::Io(io::ErrorKind::IsADirectory.into())));
    }
    let format = Format::of_path(path).ok_or_else(|| refuse(Problem::Extension))?;
    let (packing, _) = Packing::of_path(path);
    let file = packing
        .unpack(file)
        .map_err(|error| refuse(Problem::Io(error)))?;
    read(file, path, Some(format), options)
}

/// Reads a corpus that is called `path` from anywhere. Without a format, the first line tells it.
///
/// # Errors
///
/// [`CorpusError`] if the kind of a csv is not known, or for a file of vectors that is not JSON.
pub fn read(
    reader: impl BufRead + Send + 'static,
    path: &str,
    format: Option<Format>,
    options: ReadOptions,
) -> Result<Entries, CorpusError> {
    let mut lines = Lines::new(reader, path).peekable();
    let format = format.unwrap_or_else(|| match lines.peek() {
        Some(Ok(line)) => Format::of_first_line(&line.text),
        _ => Format::Jsonl,
    });
    let is_of_vectors = match lines.peek() {
        Some(Ok(line)) => line.text.trim_start() == vector_file::FIRST_LINE,
        _ => false,
    };
    Ok(match format {
        Format::Jsonl if is_of_vectors => {
            Box::new(until_error(vector_file::entries(lines, path, options)?))
        }
        Format::Jsonl => Box::new(until_error(jsonl::entries(lines, path, options))),
        Format::Csv => Box::new(until_error(csv::entries(lines, path, options)?)),
    })
}

/// The items up to the first error, and that error.
fn until_error<T, E>(
    mut items: impl Iterator<Item = Result<T, E>>,
) -> impl Iterator<Item = Result<T, E>> {
    let mut has_failed = false;
    std::iter::from_fn(move || {
        if has_failed {
            return None;
        }
        let item = items.next()?;
        has_failed = item.is_err();
        Some(item)
    })
}

#[cfg(test)]
mod tests;

//! The query that an identifier names.

use tunnelproof::query::Query;

use super::{CorpusError, Entry, Format, Problem, ReadOptions, figures, open};
use crate::generate::{GeneratedId, IdError};

/// The query that `identifier` names: `PATH.csv#INDEX`, `PATH.jsonl#ID`, `PATH.json#ID`,
/// `FAMILY:SEED:INDEX`, `figure:NAME`, or `-` for the first one on the standard input.
///
/// `PATH` ends at the first `#` after an extension of a corpus. A file is read up to the query, and
/// of several with one `id` the first is taken.
///
/// # Errors
///
/// [`CorpusError`] if the identifier is of none of these forms, if what it names does not exist, or
/// if the file is wrong up to there.
pub fn locate(identifier: &str, options: ReadOptions) -> Result<Entry, CorpusError> {
    if identifier == "-" {
        let first = open(identifier, options)?.next();
        return first.unwrap_or_else(|| Err(CorpusError::new(identifier, Problem::Empty)));
    }
    if let Some((path, id)) = split_path(identifier) {
        return in_file(path, id, identifier, options);
    }
    let entry = match figures::name_in(identifier) {
        Some(name) => figures::by_name(name).ok_or(Problem::Figure),
        None => generated(identifier),
    };
    entry
        .and_then(|entry| as_asked(entry, options))
        .map_err(|problem| CorpusError::new(identifier, problem))
}

/// `PATH` and what stands behind its `#`.
fn split_path(identifier: &str) -> Option<(&str, &str)> {
    identifier
        .match_indices('#')
        .map(|(at, _)| (&identifier[..at], &identifier[at + 1..]))
        .find(|(path, _)| Format::of_path(path).is_some())
}

/// A query of a file, by the `id` that its line states or by the whole identifier, which is how a
/// csv calls its queries.
fn in_file(
    path: &str,
    id: &str,
    identifier: &str,
    options: ReadOptions,
) -> Result<Entry, CorpusError> {
    let mut count = 0;
    for entry in open(path, options)? {
        let entry = entry?;
        if entry.id == id || entry.id == identifier {
            return Ok(entry);
        }
        count += 1;
    }
    let id = id.to_owned();
    Err(CorpusError::new(path, Problem::NotFound { id, count }))
}

fn generated(identifier: &str) -> Result<Entry, Problem> {
    let id: GeneratedId = identifier.parse().map_err(|error| match error {
        IdError::Form => Problem::Identifier,
        error => Problem::Generated(error),
    })?;
    Ok(Entry::unlabelled(id.to_string(), id.query()))
}

/// The entry with the kind and the radius that the options ask for.
fn as_asked(entry: Entry, options: ReadOptions) -> Result<Entry, Problem> {
    let query = entry.query;
    let kind = options.kind_of(Some(query.kind()))?;
    let radius = options.radius.unwrap_or(query.radius());
    let query = Query::new(kind, *query.start(), *query.end(), radius)?;
    Ok(Entry { query, ..entry })
}

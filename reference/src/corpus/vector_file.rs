//! Files of test vectors, as the folder `vectors` has them: one object of JSON over many lines,
//! whose field `vectors` lists queries with their answers.
//!
//! A vector is read like a line of [`jsonl`], an edge-edge query if it does not say otherwise, and
//! is labelled with whether its `result` is a hit. A file is read as a whole.

use serde::Deserialize;
use serde_json::Value;
use tunnelproof::query::QueryKind;

use super::error::{CorpusError, Problem};
use super::lines::Line;
use super::{Entry, ReadOptions, jsonl};

/// The first line of such a file. One of [`jsonl`] closes what it opens.
pub(super) const FIRST_LINE: &str = "{";

#[derive(Deserialize)]
struct Document {
    vectors: Vec<Value>,
}

/// The queries of the given lines.
///
/// # Errors
///
/// [`CorpusError`] for a line that cannot be read, or if the lines are no such document.
pub(super) fn entries<I: Iterator<Item = Result<Line, CorpusError>>>(
    lines: I,
    path: &str,
    options: ReadOptions,
) -> Result<impl Iterator<Item = Result<Entry, CorpusError>> + use<I>, CorpusError> {
    let lines: Result<Vec<String>, _> = lines.map(|line| line.map(|line| line.text)).collect();
    let document: Document = serde_json::from_str(&lines?.join("\n")).map_err(|error| {
        let problem = jsonl::problem("vectors".to_owned(), &error);
        CorpusError::at(path, error.line() as u64, problem)
    })?;
    let path = path.to_owned();
    let entry = move |(number, vector): (u64, Value)| {
        let id = vector["id"]
            .as_str()
            .map_or(number.to_string(), str::to_owned);
        entry(number, &vector, options)
            .map_err(|problem| CorpusError::new(&format!("{path}#{id}"), problem))
    };
    Ok((1..).zip(document.vectors).map(entry))
}

/// What a vector has beside the fields of a query.
const ANSWER_FIELDS: [&str; 7] = [
    "comment",
    "flags",
    "wire",
    "radius_hex",
    "points_hex",
    "result",
    "exact_toi",
];

/// One vector; the number names it if it has no `id`.
fn entry(number: u64, vector: &Value, options: ReadOptions) -> Result<Entry, Problem> {
    let mut query = vector.clone();
    if let Some(fields) = query.as_object_mut() {
        fields.retain(|name, _| !ANSWER_FIELDS.contains(&name.as_str()));
    }
    let line = Line {
        number,
        text: query.to_string(),
    };
    let unstated = vector["kind"].is_null().then_some(QueryKind::EdgeEdge);
    let kind = options.kind.or(unstated);
    let entry = jsonl::entry(&line, ReadOptions { kind, ..options })?;
    Ok(Entry {
        label: vector["result"]["hit"].as_bool(),
        line: None,
        ..entry
    })
}

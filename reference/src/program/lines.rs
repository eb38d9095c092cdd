//! Queries and answers as lines of JSON, those that `eval` reads and writes.
//!
//! A query is a line as in [`crate::corpus::jsonl`]; its `id` is a decimal number. An answer is an
//! object:
//!
//! - `hit`: whether there is contact.
//! - `toi`: for a hit, the time of impact: a number, a hexadecimal float in quotes, or
//!   `{"below": B, "above": A}`. What is not finite may be written as `null`, `NaN` or `Infinity`.
//! - `id`: that of the query, as text or as a number; without it answers are taken in order.
//! - `case`: the case of the motion, if the program has such cases.
//! - `unsupported`: `true` instead of `hit`, for queries that the program does not take.
//!
//! Other fields are ignored. One of these that is there twice makes the answer unreadable.

use std::io::{self, BufRead, Read};

use serde::{Deserialize, Deserializer};
use serde_json::Value;
use serde_json::error::Category;
use tunnelproof::contact::Case;
use tunnelproof::query::Query;
use tunnelproof::rigid::RigidQuery;

use crate::answer::Enclosure;
use crate::corpus::jsonl::{self, Numbers};
use crate::corpus::turning::{self, TurningEntry};
use crate::corpus::{Entry, hexfloat};
use crate::subject::Said;

use super::wire::{Message, Reply};

/// The longest line that is read, in bytes.
const LONGEST_LINE: u64 = 1 << 16;

pub(super) fn write(id: u64, query: &Query, bytes: &mut Vec<u8>) {
    let entry = Entry::unlabelled(id.to_string(), *query);
    push(&jsonl::write(&entry, Numbers::Decimal), bytes);
}

/// As in [`crate::corpus::turning`].
pub(super) fn write_rigid(id: u64, query: &RigidQuery, bytes: &mut Vec<u8>) {
    let entry = TurningEntry {
        id: id.to_string(),
        query: *query,
        label: None,
    };
    push(&turning::write(&entry, Numbers::Decimal), bytes);
}

fn push(line: &str, bytes: &mut Vec<u8>) {
    bytes.extend_from_slice(line.as_bytes());
    bytes.push(b'\n');
}

/// The next line that is not blank, without its end.
pub(super) fn read(reader: &mut impl BufRead) -> io::Result<Option<Vec<u8>>> {
    loop {
        let mut line = Vec::new();
        let mut rest = reader.by_ref().take(LONGEST_LINE);
        if rest.read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        if !line.trim_ascii().is_empty() {
            return Ok(Some(line.trim_ascii().to_vec()));
        }
    }
}

/// What a line says, or what is wrong with it.
pub(super) fn parse(line: &[u8]) -> Result<Message, String> {
    let text = std::str::from_utf8(line).map_err(|_| excerpt(line, "not UTF-8"))?;
    let fields = serde_json::from_str(text).or_else(|_| serde_json::from_str(&without_nan(text)));
    let is_object = text.trim_start().starts_with('{');
    fields
        .map_err(|error| match error.classify() {
            Category::Data if is_object => "a field twice",
            Category::Data => "not a JSON object",
            _ => "not JSON",
        })
        // A list of values would do as well.
        .and_then(|fields| match is_object {
            true => message(&fields),
            false => Err("not a JSON object"),
        })
        .map_err(|what| excerpt(line, what))
}

/// The fields of an answer. `null` is a value as any other.
#[derive(Deserialize)]
struct Fields {
    #[serde(default, deserialize_with = "given")]
    id: Option<Value>,
    #[serde(default, deserialize_with = "given")]
    unsupported: Option<Value>,
    #[serde(default, deserialize_with = "given")]
    hit: Option<Value>,
    #[serde(default, deserialize_with = "given")]
    toi: Option<Value>,
    #[serde(default, deserialize_with = "given")]
    case: Option<Value>,
}

fn given<'a, D: Deserializer<'a>>(value: D) -> Result<Option<Value>, D::Error> {
    Value::deserialize(value).map(Some)
}

fn message(fields: &Fields) -> Result<Message, &'static str> {
    let id = match &fields.id {
        None | Some(Value::Null) => None,
        Some(id) => Some(number_of_query(id).ok_or("id is that of no query")?),
    };
    if fields.unsupported == Some(Value::Bool(true)) {
        let reply = Reply::Unsupported;
        return Ok(Message { id, reply });
    }
    let hit = fields.hit.as_ref().and_then(Value::as_bool);
    let toi = match hit.ok_or("hit is neither true nor false")? {
        false => None,
        true => Some(time(fields.toi.as_ref().ok_or("a hit without toi")?)?),
    };
    let case = match fields.case.as_ref().map(Value::as_str) {
        None => None,
        Some(name) => Some(name.and_then(Case::from_name).ok_or("no such case")?),
    };
    let reply = Reply::Said(Said { toi, case });
    Ok(Message { id, reply })
}

fn number_of_query(id: &Value) -> Option<u64> {
    id.as_u64().or_else(|| id.as_str()?.parse().ok())
}

fn time(toi: &Value) -> Result<Enclosure, &'static str> {
    let bound = |name| number(toi.get(name).ok_or("toi lacks a bound")?);
    if !toi.is_object() {
        return Ok(Enclosure::exactly(number(toi)?));
    }
    let (below, above) = (bound("below")?, bound("above")?);
    match below > above {
        true => Err("toi has bounds in the wrong order"),
        false => Ok(Enclosure { below, above }),
    }
}

fn number(json: &Value) -> Result<f64, &'static str> {
    let number = match json {
        Value::Null => Some(f64::NAN),
        Value::Number(number) => number.as_f64(),
        Value::String(text) => hexfloat::parse(text).ok(),
        _ => None,
    };
    number.ok_or("toi is not a number")
}

/// The text with `null` for the numbers that many writers of JSON have beyond JSON.
fn without_nan(text: &str) -> String {
    ["-Infinity", "Infinity", "NaN"]
        .iter()
        .fold(text.to_owned(), |text, name| text.replace(name, "null"))
}

/// What is wrong, and the start of the line.
fn excerpt(line: &[u8], what: &str) -> String {
    let text = String::from_utf8_lossy(line);
    let start: String = text.chars().take(80).collect();
    let more = if start.len() < text.len() { "..." } else { "" };
    format!("{what}: {start:?}{more}")
}

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

use std::fmt;
use std::io::{self, BufRead, Read};

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::error::Category;
use serde_json::value::RawValue;
use tunnelproof::contact::Case;
use tunnelproof::query::Query;
use tunnelproof::rigid::RigidQuery;

use crate::answer::Enclosure;
use crate::corpus::jsonl::{self, Numbers};
use crate::corpus::turning::{self, TurningEntry};
use crate::corpus::{Entry, hexfloat};
use crate::subject::Said;

use super::wire::{Message, Reply};

/// The longest line that is read, in bytes, without its end.
pub const LONGEST_LINE: usize = 1 << 16;

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

/// The next line that is not blank, without its end. Of one that is too long the start, which is too
/// long as well.
pub(super) fn read(reader: &mut impl BufRead) -> io::Result<Option<Vec<u8>>> {
    loop {
        let mut line = Vec::new();
        let mut rest = reader.by_ref().take(LONGEST_LINE as u64 + 1);
        if rest.read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        if line.len() > LONGEST_LINE && line.last() != Some(&b'\n') {
            return Ok(Some(line));
        }
        if !line.trim_ascii().is_empty() {
            return Ok(Some(line.trim_ascii().to_vec()));
        }
    }
}

/// What a line says, or what is wrong with it.
pub(super) fn parse(line: &[u8]) -> Result<Message, String> {
    if line.len() > LONGEST_LINE {
        let what = format!("longer than {LONGEST_LINE} bytes");
        return Err(excerpt(line, &what));
    }
    let text = std::str::from_utf8(line).map_err(|_| excerpt(line, "not UTF-8"))?;
    let answer = object(text).or_else(|_| object(&without_nan(text)));
    answer
        .and_then(|answer| message(&answer))
        .map_err(|what| excerpt(line, &what))
}

/// The fields of an object by their names, each as it is written.
struct Fields(Vec<(String, Box<RawValue>)>);

impl<'de> Deserialize<'de> for Fields {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(AllFields)
    }
}

struct AllFields;

impl<'de> Visitor<'de> for AllFields {
    type Value = Fields;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Fields, M::Error> {
        let mut fields = Vec::new();
        while let Some(field) = map.next_entry()? {
            fields.push(field);
        }
        Ok(Fields(fields))
    }
}

impl Fields {
    /// What is written for a field, which is within one of this name.
    fn get(&self, within: &str, name: &str) -> Result<Option<&str>, String> {
        let mut named = self.0.iter().filter(|(other, _)| other == name);
        let field = named.next().map(|(_, value)| value.get());
        match named.next() {
            None => Ok(field),
            Some(_) => Err(format!("{within}{name} is there twice")),
        }
    }
}

fn object(text: &str) -> Result<Fields, String> {
    serde_json::from_str(text).map_err(|error| {
        let what = match error.classify() {
            Category::Data => "not a JSON object",
            _ => "not JSON",
        };
        what.to_owned()
    })
}

/// `null` is a value as any other.
fn message(answer: &Fields) -> Result<Message, String> {
    let field = |name| answer.get("", name);
    let [id, unsupported, hit, toi, case] = [
        field("id")?,
        field("unsupported")?,
        field("hit")?,
        field("toi")?,
        field("case")?,
    ];
    let id = match id {
        None | Some("null") => None,
        Some(id) => Some(number_of_query(id).ok_or_else(|| is("id", id, "that of no query"))?),
    };
    if truth("unsupported", unsupported.unwrap_or("false"))? {
        let reply = Reply::Unsupported;
        return Ok(Message { id, reply });
    }
    let hit = hit.ok_or("there is no hit")?;
    let toi = match truth("hit", hit)? {
        false => None,
        true => Some(time(toi.ok_or("a hit without toi")?)?),
    };
    let named = |case: &str| text(case).as_deref().and_then(Case::from_name);
    let case = match case {
        None => None,
        Some(case) => Some(named(case).ok_or_else(|| is("case", case, "not the name of one"))?),
    };
    let reply = Reply::Said(Said { toi, case });
    Ok(Message { id, reply })
}

fn truth(name: &str, written: &str) -> Result<bool, String> {
    match written {
        "true" => Ok(true),
        "false" => Ok(false),
        other => Err(is(name, other, "neither true nor false")),
    }
}

fn number_of_query(id: &str) -> Option<u64> {
    text(id).as_deref().unwrap_or(id).parse().ok()
}

/// What is in the quotes, if it is a text.
fn text(written: &str) -> Option<String> {
    serde_json::from_str(written).ok()
}

fn time(toi: &str) -> Result<Enclosure, String> {
    if !toi.starts_with('{') {
        return Ok(Enclosure::exactly(number("toi", toi)?));
    }
    let bounds = object(toi)?;
    let bound = |name| {
        let bound = bounds.get("toi.", name)?;
        let bound = bound.ok_or_else(|| format!("there is no toi.{name}"))?;
        number(&format!("toi.{name}"), bound)
    };
    let (below, above) = (bound("below")?, bound("above")?);
    match below > above {
        true => Err("toi.below is above toi.above".to_owned()),
        false => Ok(Enclosure { below, above }),
    }
}

fn number(name: &str, written: &str) -> Result<f64, String> {
    let number = match (written, text(written)) {
        ("null", _) => Some(f64::NAN),
        (_, Some(text)) => hexfloat::parse(&text).ok(),
        // Neither an object nor a list nor a truth is read by this.
        (_, None) => written.parse().ok(),
    };
    number.ok_or_else(|| is(name, written, "not a number"))
}

/// The text with what JSON has for the numbers that many writers of JSON have beyond it: `null`, and
/// numbers that are too large.
fn without_nan(text: &str) -> String {
    let names = [("Infinity", "1e999"), ("NaN", "null")];
    let replaced = |text: String, (name, json): (&str, &str)| text.replace(name, json);
    names.into_iter().fold(text.to_owned(), replaced)
}

/// What is wrong, and the start of the line.
fn excerpt(line: &[u8], what: &str) -> String {
    format!("{what}: {}", start(&String::from_utf8_lossy(line), 80))
}

/// That a field is not what it has to be.
fn is(name: &str, written: &str, not: &str) -> String {
    format!("{name} is {}, {not}", start(written, 40))
}

/// A text up to so many letters.
fn start(text: &str, most: usize) -> String {
    let mut letters = text.chars();
    let start: String = letters.by_ref().take(most).map(visible).collect();
    let more = if letters.next().is_some() { "..." } else { "" };
    start + more
}

/// A letter as it is, if that can be seen in a line.
fn visible(letter: char) -> char {
    match letter.is_control() {
        true => char::REPLACEMENT_CHARACTER,
        false => letter,
    }
}

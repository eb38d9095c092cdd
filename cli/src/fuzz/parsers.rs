//! The readers of queries on any bytes.

use std::io::Cursor;

use tunnelproof::query::QueryKind;

use tunnelproof_reference::corpus::jsonl::{self, Numbers};
use tunnelproof_reference::corpus::locate::locate;
use tunnelproof_reference::corpus::{self, Entry, Format, ReadOptions};
use tunnelproof_reference::generate::FAMILIES;

/// Reads the bytes after the first, which says how. What is read is written and read again.
pub(super) fn check(bytes: &[u8]) -> Option<String> {
    let (&how, text) = bytes.split_first()?;
    let format = [None, Some(Format::Jsonl), Some(Format::Csv)][usize::from(how % 3)];
    let kinds = [None, Some(QueryKind::EdgeEdge), Some(QueryKind::VertexFace)];
    let options = ReadOptions {
        kind: kinds[usize::from(how / 3 % 3)],
        radius: None,
    };
    if let Ok(identifier) = std::str::from_utf8(text)
        && is_no_file(identifier)
        && let Ok(entry) = locate(identifier, options)
        && let Some(what) = written_and_read(&entry)
    {
        return Some(what);
    }
    let Ok(entries) = corpus::read(Cursor::new(text.to_vec()), "fuzz", format, options) else {
        return None;
    };
    let mut count = 0;
    for entry in entries {
        count += 1;
        if count > text.len() + 1 {
            return Some("more queries than bytes".to_owned());
        }
        match entry {
            Ok(entry) => {
                if let Some(what) = written_and_read(&entry) {
                    return Some(what);
                }
            }
            Err(error) if error.to_string().contains('\n') => {
                return Some("an error of several lines".to_owned());
            }
            Err(_) => {}
        }
    }
    None
}

/// A line of each kind of number, rows, and an identifier, each with its first byte.
pub(super) fn seeds() -> Vec<Vec<u8>> {
    let family = &FAMILIES[0];
    let entry = Entry {
        label: Some(true),
        ..Entry::unlabelled("a", family.query(1, 0))
    };
    let row = "1,2,-3,-4,0,1,1\n";
    [
        (0, jsonl::write(&entry, Numbers::Decimal)),
        (1, jsonl::write(&entry, Numbers::Hexadecimal)),
        (5, row.repeat(8)),
        (3, row.repeat(16)),
        (0, format!("{}:1:4711", family.name())),
        (0, "figure:4.3".to_owned()),
    ]
    .map(|(how, text)| [&[how], text.as_bytes()].concat())
    .into()
}

/// Whether an identifier names neither a file nor the standard input, which a fuzzer leaves alone.
fn is_no_file(identifier: &str) -> bool {
    identifier.contains(':') && !identifier.contains(['#', '-'])
}

/// What is wrong if a query is not read as it is written.
fn written_and_read(entry: &Entry) -> Option<String> {
    for numbers in [Numbers::Decimal, Numbers::Hexadecimal] {
        let line = jsonl::write(entry, numbers);
        let reader = Cursor::new(line.clone().into_bytes());
        let again = corpus::read(reader, "fuzz", Some(Format::Jsonl), ReadOptions::default());
        let again = again.ok()?.next();
        let is_same = matches!(&again, Some(Ok(again)) if
            (&again.id, again.query, again.label) == (&entry.id, entry.query, entry.label));
        if !is_same {
            return Some(format!("{line} is read as {again:?}"));
        }
    }
    None
}

use std::io::Cursor;

use super::*;

mod files;
mod identifiers;
mod properties;
mod read_csv;
mod read_folder;
mod read_jsonl;
mod read_vectors;

const EDGE_EDGE: ReadOptions = ReadOptions {
    kind: Some(QueryKind::EdgeEdge),
    radius: None,
};

/// Eight points in JSON.
const EIGHT: &str = "[[0,0,0],[1,0,0],[0,1,1],[0,1,2],[0,0,0],[1,0,0],[0,-1,1],[0,-1,2]]";

/// What reading `text` as the file `path` gives: line and id of a query, or the error.
fn read_text(path: &str, text: impl Into<Vec<u8>>, options: ReadOptions) -> Vec<String> {
    let format = Format::of_path(path);
    match read(Cursor::new(text.into()), path, format, options) {
        Ok(entries) => entries
            .map(|entry| match entry {
                Ok(entry) => format!("{:?} {}", entry.line, entry.id),
                Err(error) => error.to_string(),
            })
            .collect(),
        Err(error) => vec![error.to_string()],
    }
}

/// The queries of `text`, read as the file `path`, which is right.
fn entries(path: &str, text: impl Into<Vec<u8>>, options: ReadOptions) -> Vec<Entry> {
    read(
        Cursor::new(text.into()),
        path,
        Format::of_path(path),
        options,
    )
    .unwrap()
    .map(Result::unwrap)
    .collect()
}

/// A row of a csv.
const ROW: &str = "1,2,3,4,5,8,0";

/// A csv of one query whose third row is `row`.
fn csv_with(row: &str) -> String {
    [&[ROW, ROW, row], &[ROW; 5][..]].concat().join("\n") + "\n"
}

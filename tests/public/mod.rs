//! The public sets in `../shared/data`: queries with labels, where they are.

use std::fs;
use std::path::{Path, PathBuf};

use tunnelproof::query::{Point, Query, QueryKind};
use tunnelproof_reference::corpus::{self, Entry, ReadOptions};

/// The sets by their names: first the handcrafted ones as one, then pairs of simulations.
pub(crate) const SETS: [&str; 3] = ["handcrafted", "candidates-cloth-ball", "hits-cloth-ball"];

/// The queries of this kind of one set, none if it is not there. What is there is sound, or this
/// panics.
pub(crate) fn set(name: &str, kind: QueryKind) -> Vec<Entry> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let entries: Vec<Entry> = if name == "handcrafted" {
        let files = csv_files(&folder.join("ccd-sample-queries"), kind);
        files.iter().flat_map(|file| csv(file)).collect()
    } else {
        let file = folder.join(format!("{name}.ee.bin"));
        let bytes = fs::read(file).ok();
        let bytes = bytes.filter(|_| kind == QueryKind::EdgeEdge);
        bytes.map_or_else(Vec::new, |bytes| binary(name, &bytes))
    };
    if entries.is_empty() {
        eprintln!(
            "skipped: no {kind} queries of {name} in {}",
            folder.display()
        );
    } else {
        assert!(entries.len() > 1000, "{name}: only {}", entries.len());
    }
    entries
}

/// The csv files with queries of a kind below a folder, in order of their paths.
fn csv_files(folder: &Path, kind: QueryKind) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "csv")
                && path.to_string_lossy().contains(kind.name())
            {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

fn csv(file: &Path) -> Vec<Entry> {
    let entries = corpus::open(&file.to_string_lossy(), ReadOptions::default());
    let entries: Result<Vec<_>, _> = entries.expect("a public csv opens").collect();
    let entries = entries.expect("a public csv is sound");
    let rows = fs::read_to_string(file).expect("text").lines().count();
    assert_eq!(8 * entries.len(), rows, "{}", file.display());
    entries
}

/// `i64 n`, then `n` times the 24 coordinates of eight points, then `n` labels of a byte,
/// little-endian.
fn binary(name: &str, bytes: &[u8]) -> Vec<Entry> {
    let (count, rest) = bytes.split_first_chunk().expect("a count");
    let (queries, labels) = rest.split_at(192 * usize::from_le_bytes(*count));
    assert_eq!(labels.len(), usize::from_le_bytes(*count), "{name}");
    let number = |bytes: &[u8]| f64::from_le_bytes(bytes.try_into().expect("eight bytes"));
    let query = |bytes: &[u8]| {
        let values: Vec<f64> = bytes.chunks_exact(8).map(number).collect();
        let point = |i: usize| Point::new(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
        let (start, end) = ([0, 1, 2, 3].map(point), [4, 5, 6, 7].map(point));
        Query::new(QueryKind::EdgeEdge, start, end, 0.0).expect("finite coordinates")
    };
    let queries = queries.chunks_exact(192).zip(labels).enumerate();
    let entry = |(index, (bytes, &label))| Entry {
        id: format!("{name}#{index}"),
        query: query(bytes),
        label: Some(label == 1),
        line: None,
    };
    queries.map(entry).collect()
}

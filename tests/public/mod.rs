//! Queries with labels: those of the public sets in `../shared/data`, where they are, and those of the
//! project's own `vectors/`, which are always there.

use std::fs;
use std::path::{Path, PathBuf};

use tunnelproof::query::{Point, Query, QueryKind};
use tunnelproof_reference::corpus::{self, Entry, ReadOptions};

/// The sets by their names: first the handcrafted ones as one, then pairs of simulations.
pub(crate) const SETS: [&str; 3] = ["handcrafted", "candidates-cloth-ball", "hits-cloth-ball"];

/// The same of another simulation, by which nothing was tuned.
pub(crate) const OTHERS: [&str; 2] = ["candidates-rod-twist", "hits-rod-twist"];

/// The name of the project's own vectors.
pub(crate) const VECTORS: &str = "vectors";

/// All sets with labels. The first one is never empty.
#[allow(dead_code, reason = "benches take the public sets alone")]
pub(crate) const LABELLED: [&str; 6] = [VECTORS, SETS[0], SETS[1], SETS[2], OTHERS[0], OTHERS[1]];

/// The queries of this kind of one set, none if it is not there. What is there is sound, or this
/// panics.
pub(crate) fn set(name: &str, kind: QueryKind) -> Vec<Entry> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = here.join("../shared/data");
    let entries: Vec<Entry> = if name == VECTORS {
        vectors(&here.join("vectors"), kind)
    } else if name == "handcrafted" {
        let files = csv_files(&folder.join("ccd-sample-queries"), kind);
        files.iter().flat_map(|file| csv(file)).collect()
    } else {
        let file = folder.join(format!("{name}.ee.bin"));
        let bytes = fs::read(file).ok();
        let bytes = bytes.filter(|_| kind == QueryKind::EdgeEdge);
        bytes.map_or_else(Vec::new, |bytes| binary(name, &bytes))
    };
    if entries.is_empty() && name != VECTORS {
        let folder = folder.display();
        eprintln!("skipped: no {kind} queries of {name} in {folder}");
    } else {
        eprintln!("{} {kind} queries of {name}", entries.len());
        let least = if name == VECTORS { 500 } else { 1000 };
        assert!(entries.len() > least, "{name}: only {}", entries.len());
    }
    entries
}

/// The vectors of a kind without a radius.
fn vectors(folder: &Path, kind: QueryKind) -> Vec<Entry> {
    let files = fs::read_dir(folder).expect("the vectors are there");
    let mut files: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    files.retain(|file| {
        let is_json = file
            .extension()
            .is_some_and(|extension| extension == "json");
        is_json && !file.ends_with("schema.json")
    });
    files.sort();
    let entries = files.iter().flat_map(|file| {
        let entries = corpus::open(&file.to_string_lossy(), ReadOptions::default());
        entries.expect("a file of vectors opens")
    });
    let entries = entries.map(|entry| entry.expect("vectors are sound"));
    let entries =
        entries.filter(|entry| entry.query.kind() == kind && entry.query.radius().is_zero());
    entries.collect()
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

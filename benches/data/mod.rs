//! The queries that are measured.

use std::fs;
use std::path::{Path, PathBuf};

use tunnelproof::query::{EdgeEdge, Point, Query, QueryKind, VertexFace};
use tunnelproof_reference::corpus::{self, ReadOptions};
use tunnelproof_reference::generate;

mod wires;

/// A set by its name, made when it is asked for.
type Set = (&'static str, fn() -> Vec<EdgeEdge>);

const SETS: [Set; 6] = [
    ("uniform-overlapping", uniform_overlapping),
    ("lattice", || family("lattice", 4096)),
    ("wires", wires::pairs),
    ("handcrafted", handcrafted),
    ("candidates-cloth-ball", || binary("candidates-cloth-ball")),
    ("hits-cloth-ball", || binary("hits-cloth-ball")),
];

/// Generated sets, then the public ones that are there.
pub(crate) fn sets() -> impl Iterator<Item = (&'static str, Vec<EdgeEdge>)> {
    let made = SETS.into_iter().map(|(name, make)| (name, make()));
    made.filter(|(_, queries)| !queries.is_empty())
}

/// The queries of one set.
#[allow(dead_code, reason = "not every bench asks for one set")]
pub(crate) fn set(name: &str) -> Option<Vec<EdgeEdge>> {
    let (_, make) = SETS.into_iter().find(|(of, _)| *of == name)?;
    Some(make())
}

/// Vertex-face queries: the points of a generated set, and the public ones that are there.
#[allow(dead_code, reason = "not every bench asks for these")]
pub(crate) fn vertex_face_sets() -> Vec<(&'static str, Vec<VertexFace>)> {
    let of_points = |query: &EdgeEdge| VertexFace::new(*query.start(), *query.end(), 0.0);
    let uniform = family("uniform", 8192);
    let uniform = uniform
        .iter()
        .map(|query| of_points(query).expect("finite"));
    let files = csv_files(&shared().join("ccd-sample-queries"), QueryKind::VertexFace);
    let queries = files.iter().flat_map(|path| csv(path));
    let handcrafted = queries.filter_map(|query| match query {
        Query::VertexFace(query) => Some(query),
        Query::EdgeEdge(_) => None,
    });
    let mut sets = vec![
        ("uniform", uniform.collect()),
        ("handcrafted", handcrafted.collect::<Vec<_>>()),
    ];
    sets.retain(|(_, queries)| !queries.is_empty());
    sets
}

fn family(name: &str, count: u64) -> Vec<EdgeEdge> {
    let family = generate::by_name(name).expect("a family");
    let queries = (0..count).map(|index| family.query(1, index));
    queries.filter_map(edge_edge).collect()
}

fn uniform_overlapping() -> Vec<EdgeEdge> {
    let drawn = family("uniform", 8192);
    drawn.into_iter().filter(wires::overlaps).collect()
}

fn shared() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data")
}

fn handcrafted() -> Vec<EdgeEdge> {
    let files = csv_files(&shared().join("ccd-sample-queries"), QueryKind::EdgeEdge);
    let queries = files.iter().flat_map(|path| csv(path));
    queries.filter_map(edge_edge).collect()
}

fn edge_edge(query: Query) -> Option<EdgeEdge> {
    match query {
        Query::EdgeEdge(query) => Some(query),
        Query::VertexFace(_) => None,
    }
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
            } else if path.extension().is_some_and(|e| e == "csv")
                && path.to_string_lossy().contains(kind.name())
            {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

fn csv(path: &Path) -> Vec<Query> {
    let entries = corpus::open(&path.to_string_lossy(), ReadOptions::default());
    let entries = entries.expect("a public csv opens");
    entries
        .map(|entry| entry.expect("a public csv is sound").query)
        .collect()
}

/// `i64 n`, then `n` times the 24 coordinates of eight points, little-endian; nothing if the file is not
/// there.
fn binary(name: &str) -> Vec<EdgeEdge> {
    let Ok(bytes) = fs::read(shared().join(format!("{name}.ee.bin"))) else {
        return Vec::new();
    };
    let (count, rest) = bytes.split_at(8);
    let count = i64::from_le_bytes(count.try_into().expect("eight bytes")) as usize;
    let numbers: Vec<f64> = rest
        .chunks_exact(8)
        .take(24 * count)
        .map(|bytes| f64::from_le_bytes(bytes.try_into().expect("eight bytes")))
        .collect();
    let query = |c: &[f64]| {
        let point = |i: usize| Point::new(c[3 * i], c[3 * i + 1], c[3 * i + 2]);
        EdgeEdge::new([0, 1, 2, 3].map(point), [4, 5, 6, 7].map(point), 0.0)
    };
    numbers
        .chunks_exact(24)
        .map(|c| query(c).expect("finite coordinates"))
        .collect()
}

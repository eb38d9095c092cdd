//! The queries that are measured.

use tunnelproof::query::{EdgeEdge, QueryKind, VertexFace};
use tunnelproof_reference::corpus::Entry;
use tunnelproof_reference::generate;

#[path = "../../tests/public/mod.rs"]
mod public;
mod wires;

/// A set by its name, made when it is asked for.
type Set = (&'static str, Box<dyn Fn() -> Vec<EdgeEdge>>);

/// Generated sets, then the public ones, which are empty where they are not.
pub(crate) fn all() -> Vec<Set> {
    let mut sets: Vec<Set> = vec![
        ("uniform-overlapping", Box::new(uniform_overlapping)),
        ("lattice", Box::new(|| family("lattice", 4096))),
        ("wires", Box::new(wires::pairs)),
    ];
    for name in public::SETS {
        sets.push((name, Box::new(move || public_edges(name))));
    }
    sets
}

/// The sets that are there.
pub(crate) fn sets() -> impl Iterator<Item = (&'static str, Vec<EdgeEdge>)> {
    let made = all().into_iter().map(|(name, make)| (name, make()));
    made.filter(|(_, queries)| !queries.is_empty())
}

/// A set with a radius: a twentieth of the mean length of its edges at the start, as of wires ten
/// times as long as thick.
#[allow(dead_code, reason = "not every bench asks for these")]
pub(crate) fn thick(queries: &[EdgeEdge]) -> Vec<EdgeEdge> {
    let length = |query: &EdgeEdge| {
        let [a, b, c, d] = query.start();
        (b - a).norm() + (d - c).norm()
    };
    let mean = queries.iter().map(length).sum::<f64>() / (2 * queries.len()) as f64;
    let with_radius = |query: &EdgeEdge| EdgeEdge::new(*query.start(), *query.end(), mean / 20.0);
    let queries = queries.iter().map(with_radius);
    queries.map(|query| query.expect("finite")).collect()
}

/// Vertex-face queries: the points of a generated set, and the public ones that are there.
pub(crate) fn vertex_face_sets() -> Vec<(&'static str, Vec<VertexFace>)> {
    let of_points = |query: &EdgeEdge| VertexFace::new(*query.start(), *query.end(), 0.0);
    let uniform = family("uniform", 8192);
    let uniform = uniform
        .iter()
        .map(|query| of_points(query).expect("finite"));
    let handcrafted = public::set("handcrafted", QueryKind::VertexFace);
    let handcrafted = handcrafted.iter();
    let handcrafted = handcrafted.filter_map(|entry| entry.query.as_vertex_face().copied());
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
    queries
        .filter_map(|query| query.as_edge_edge().copied())
        .collect()
}

fn public_edges(name: &str) -> Vec<EdgeEdge> {
    let entries = public::set(name, QueryKind::EdgeEdge);
    let edges = |entry: &Entry| entry.query.as_edge_edge().copied();
    entries.iter().filter_map(edges).collect()
}

fn uniform_overlapping() -> Vec<EdgeEdge> {
    let drawn = family("uniform", 8192);
    drawn.into_iter().filter(wires::overlaps).collect()
}

//! The queries that are measured.

use tunnelproof::query::{EdgeEdge, QueryKind, VertexFace};
use tunnelproof_reference::corpus::Entry;
use tunnelproof_reference::generate;

pub(crate) mod boxes;
#[path = "../../tests/public/mod.rs"]
mod public;
mod wires;

/// A set by its name, made when it is asked for.
pub(crate) type Set = (&'static str, Box<dyn Fn() -> Vec<EdgeEdge>>);

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

/// Sets of another simulation, by which nothing was tuned, as far as they are there.
#[allow(dead_code, reason = "not every bench asks for these")]
pub(crate) fn others() -> impl Iterator<Item = (&'static str, Vec<EdgeEdge>)> {
    let set = |name| -> Set { (name, Box::new(move || public_edges(name))) };
    present(public::OTHERS.map(set).into())
}

/// The sets that are there.
pub(crate) fn sets() -> impl Iterator<Item = (&'static str, Vec<EdgeEdge>)> {
    present(all())
}

/// The sets with a radius that are there.
#[allow(dead_code, reason = "not every bench asks for these")]
pub(crate) fn thick_sets() -> impl Iterator<Item = (&'static str, Vec<EdgeEdge>)> {
    present(all_thick())
}

/// The sets of another simulation with a radius.
#[allow(dead_code, reason = "not every bench asks for these")]
pub(crate) fn thick_others() -> impl Iterator<Item = (&'static str, Vec<EdgeEdge>)> {
    let with_radius = |(name, queries): (_, Vec<EdgeEdge>)| (name, thick(&queries));
    others().map(with_radius)
}

fn present(sets: Vec<Set>) -> impl Iterator<Item = (&'static str, Vec<EdgeEdge>)> {
    let made = sets.into_iter().map(|(name, make)| (name, make()));
    made.filter(|(_, queries)| !queries.is_empty())
}

/// A set with a radius: a twentieth of the mean length of its edges at the start, as of wires ten
/// times as long as thick.
fn thick(queries: &[EdgeEdge]) -> Vec<EdgeEdge> {
    let length = |query: &EdgeEdge| {
        let [a, b, c, d] = query.start();
        (b - a).norm() + (d - c).norm()
    };
    let mean = queries.iter().map(length).sum::<f64>() / (2 * queries.len()) as f64;
    let with_radius = |query: &EdgeEdge| EdgeEdge::new(*query.start(), *query.end(), mean / 20.0);
    let queries = queries.iter().map(with_radius);
    queries.map(|query| query.expect("finite")).collect()
}

/// The same with a radius, and layers of cloth that lie on each other.
#[allow(dead_code, reason = "not every bench asks for these")]
pub(crate) fn all_thick() -> Vec<Set> {
    let with_radius = all()
        .into_iter()
        .map(|(name, make)| -> Set { (name, Box::new(move || thick(&make()))) });
    let layers = ["layers", "touching_layers"].map(|name| -> Set {
        (
            name,
            Box::new(move || family(&format!("thick_{name}"), 8192)),
        )
    });
    with_radius.chain(layers).collect()
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

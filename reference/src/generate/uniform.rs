//! Motion in general position: every coordinate at both ends of the step is drawn by itself, evenly
//! from `[-1, 1)`.
//!
//! Probes the general case with well-conditioned numbers and whole mantissas, where a sound method
//! has no excuse. Edges are about as long as the box and steps about as long as the edges, which makes
//! one query in five a hit.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Query;

use super::{Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "uniform",
    description: "general motion: every coordinate evenly from [-1, 1)",
    draw,
};

fn draw(rng: &mut dyn Rng) -> Query {
    let mut positions = || [(); 4].map(|()| Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0)));
    let start = positions();
    edge_edge(start, positions())
}

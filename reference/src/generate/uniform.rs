//! Motion in general position: every coordinate at both ends of the step is drawn by itself, evenly
//! from `[-1, 1)`.
//!
//! Probes the general case with well-conditioned numbers and whole mantissas, where a sound method
//! has no excuse. Edges are about as long as the box and steps about as long as the edges, which
//! makes one query in five a hit.

use rand::Rng;
use tunnelproof::query::Query;

use super::motion::real_vector;
use super::{Draw, Family, edge_edge};

pub(super) const FAMILY: Family = Family {
    name: "uniform",
    description: "general motion: every coordinate evenly from [-1, 1)",
    draw: Draw::Query(draw),
};

fn draw(rng: &mut dyn Rng) -> Query {
    edge_edge([(); 2].map(|()| [(); 4].map(|()| real_vector(rng, 1.0))))
}

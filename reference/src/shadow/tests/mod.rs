//! Tests of the shadow: each algorithm by itself, the whole against the definition of contact, and
//! the errata of the published text.

use num_bigint::BigInt;
use tunnelproof::query::{EdgeEdge, Point};

use super::motion::Motion;
use crate::scaled::Scaled;

mod algorithms;
mod contact;
mod errata;
mod lattice;
mod witness;

/// The points A, B, C, D at the start of the step and again at its end, in small integers.
type Points = [[i64; 3]; 8];

fn query(points: &Points) -> EdgeEdge {
    let at = |index: usize| {
        let [x, y, z] = points[index].map(|value| value as f64);
        Point::new(x, y, z)
    };
    EdgeEdge::new([0, 1, 2, 3].map(at), [4, 5, 6, 7].map(at), 0.0).unwrap()
}

fn motions(points: &Points) -> [Motion<BigInt>; 4] {
    let query = tunnelproof::query::Query::EdgeEdge(query(points));
    Motion::of_scaled(&Scaled::new(&query))
}

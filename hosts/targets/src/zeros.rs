//! Queries with zeros of both signs.

use tunnelproof::query::{Point, Query, QueryKind};

/// What coordinates and radii are drawn from.
const NUMBERS: [f64; 8] = [-0.0, 0.0, -0.0, 0.0, -1.0, 1.0, 0.5, -2.0];

/// The query with a number: edges or vertex and face, one of four with a radius.
pub(crate) fn query(index: u64) -> Query {
    let mut state = index.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let mut number = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        NUMBERS[(state >> 61) as usize]
    };
    let mut point = || Point::new(number(), number(), number());
    let (start, end) = ([(); 4].map(|()| point()), [(); 4].map(|()| point()));
    let kind = [QueryKind::EdgeEdge, QueryKind::VertexFace][index as usize % 2];
    let radius = if index % 8 < 2 { number().abs() } else { 0.0 };
    Query::new(kind, start, end, radius).expect("its numbers are finite")
}

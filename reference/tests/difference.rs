//! The two exact judges of all kinds of queries against each other, in every field of the answer,
//! on lattices and with every number's bits.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use num_bigint::BigInt;
use proptest::prelude::*;
use tunnelproof::query::{Point, Query, QueryKind};

use tunnelproof_reference::difference::decide;
use tunnelproof_reference::oracle;

type Corners = [[f64; 3]; 8];

fn query(kind: QueryKind, points: Corners, radius: f64) -> Query {
    let p = points.map(|[x, y, z]| Point::new(x, y, z));
    let (start, end) = ([p[0], p[1], p[2], p[3]], [p[4], p[5], p[6], p[7]]);
    Query::new(kind, start, end, radius).unwrap()
}

fn kind() -> impl Strategy<Value = QueryKind> {
    prop::sample::select(vec![QueryKind::EdgeEdge, QueryKind::VertexFace])
}

/// Small integers, confined to a line or a plane as often as not, with points repeated.
fn lattice() -> impl Strategy<Value = Query> {
    let points = prop::array::uniform8(prop::array::uniform3(-2i8..=2));
    let radius = prop::sample::select(vec![0.0, 0.0, 0.5, 1.0, 1.5, 2.0, 5.0]);
    let repeated = (0usize..8, 0usize..8, any::<bool>());
    (kind(), points, 0u8..6, repeated, radius).prop_map(
        |(kind, mut p, confinement, (from, to, repeat), radius)| {
            if repeat {
                p[to] = p[from];
                p[(to + 4) % 8] = p[(from + 4) % 8];
            }
            let q = p.map(|[x, y, z]| match confinement {
                0 => [x, y, 0],
                1 => [x, x, x],
                2 => [x, y, x],
                3 => [x, y, i8::from(z > 0)],
                _ => [x, y, z],
            });
            query(kind, q.map(|c| c.map(f64::from)), radius)
        },
    )
}

fn uniform() -> impl Strategy<Value = Query> {
    let points = prop::array::uniform8(prop::array::uniform3(-1.0f64..1.0));
    (
        kind(),
        points,
        prop::sample::select(vec![0.0, 1e-9, 0.01, 0.3]),
    )
        .prop_map(|(kind, points, radius)| query(kind, points, radius))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(10_000))]

    #[test]
    fn difference_agrees_with_the_oracle_on_lattice(query in lattice()) {
        prop_assert_eq!(decide::<BigInt>(&query), oracle::decide::<BigInt>(&query).written());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn difference_agrees_with_the_oracle_on_uniform(query in uniform()) {
        prop_assert_eq!(decide::<BigInt>(&query), oracle::decide::<BigInt>(&query).written());
    }
}

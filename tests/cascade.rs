//! The cascade of the certified path: batches, and the share that each stage decides.

use std::collections::BTreeMap;

use tunnelproof::certified::{self, Batch, Stage};
use tunnelproof::query::EdgeEdge;
use tunnelproof_reference::generate::{self, FAMILIES, Family};

#[test]
fn certified_batch_is_certified_one_by_one() {
    for family in FAMILIES {
        for count in [0, 1, 7, 8, 9, 255, 256, 257, 5000] {
            let queries: Vec<EdgeEdge> = (0..count)
                .filter_map(|index| family.query(3, index).as_edge_edge().copied())
                .collect();
            let mut batch = Batch::new();
            queries.iter().for_each(|query| batch.push(query));
            let found = batch.decide();
            let expected = queries.iter().map(certified::decide).enumerate();
            let expected: Vec<_> = expected
                .filter_map(|(index, hit)| Some((index, hit?)))
                .collect();
            assert_eq!(found, expected, "{}", family.name());
            #[cfg(feature = "rayon")]
            assert_eq!(batch.par_decide(), expected, "{}", family.name());
        }
    }
}

#[test]
fn certified_batch_names_one_stage_for_each_query() {
    for family in FAMILIES {
        let mut batch = Batch::new();
        for index in 0..1000 {
            if let Some(query) = family.query(3, index).as_edge_edge() {
                batch.push(query);
            }
        }
        let mut named = 0;
        batch.decide_observed(|_, _| {}, |_| named += 1);
        assert_eq!(named, batch.len(), "{}", family.name());
    }
}

/// The share of queries that each stage decides, in percent.
fn shares(queries: impl Iterator<Item = EdgeEdge>) -> BTreeMap<Stage, f64> {
    let mut counts: BTreeMap<Stage, u64> = BTreeMap::new();
    let mut total = 0;
    for query in queries {
        let mut observe = |stage| *counts.entry(stage).or_default() += 1;
        let _ = certified::decide_observed(&query, &mut observe);
        total += 1;
    }
    assert_eq!(
        counts.values().sum::<u64>(),
        total,
        "one stage decides each query"
    );
    counts
        .into_iter()
        .map(|(stage, n)| (stage, 100.0 * n as f64 / total as f64))
        .collect()
}

/// The most that integers may decide of each family, in percent: what they did when this was
/// written, rounded up.
const EXACT_AT_MOST: &[(&str, f64)] = &[
    ("uniform", 0.01),
    ("lattice", 42.0),
    ("near_coplanar", 45.0),
    ("near_parallel", 77.0),
    ("near_collinear", 75.0),
    ("shared_start", 14.0),
    ("point_on_line", 71.0),
    ("temporarily_parallel", 86.0),
    ("temporarily_point", 83.0),
    ("grazing", 65.0),
    ("triple_root", 94.0),
    ("scales", 88.0),
    ("cancellation", 30.0),
    ("slow", 79.0),
    ("long_thin", 61.0),
    ("joint", 41.0),
];

#[test]
fn certified_exact_stage_is_reached_no_more_often_than_it_must() {
    let named: Vec<_> = EXACT_AT_MOST.iter().map(|(name, _)| *name).collect();
    let families: Vec<_> = FAMILIES.iter().map(Family::name).collect();
    assert_eq!(named, families);
    for (family, (_, at_most)) in FAMILIES.iter().zip(EXACT_AT_MOST) {
        let queries = (0..20_000).map(|index| family.query(1, index));
        let shares = shares(queries.filter_map(|query| query.as_edge_edge().copied()));
        let exact = shares.get(&Stage::Exact).copied().unwrap_or(0.0);
        assert!(exact <= *at_most, "{}: {shares:?}", family.name());
    }
}

/// The same with a radius, of a twentieth of the mean length of the edges of a query.
const EXACT_AT_MOST_WITH_A_RADIUS: &[(&str, f64)] = &[
    ("uniform", 0.1),
    ("near_coplanar", 9.0),
    ("near_parallel", 61.0),
];

#[test]
fn certified_exact_stage_is_reached_no_more_often_than_it_must_with_a_radius() {
    for (name, at_most) in EXACT_AT_MOST_WITH_A_RADIUS {
        let family = generate::by_name(name).expect("a family");
        let queries = (0..4000).map(|index| family.query(1, index));
        let thick = queries.filter_map(|query| {
            let [a, b, c, d] = query.start();
            let radius = ((b - a).norm() + (d - c).norm()) / 40.0;
            EdgeEdge::new(*query.start(), *query.end(), radius).ok()
        });
        let shares = shares(thick);
        let exact = shares.get(&Stage::Exact).copied().unwrap_or(0.0);
        eprintln!("{name}: {shares:?}");
        assert!(exact <= *at_most, "{name}: {shares:?}");
    }
}

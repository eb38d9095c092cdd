//! The certified path against the exact oracle, to the last bit, and the share that each stage of
//! its cascade decides.

use std::collections::BTreeMap;

use proptest::prelude::*;
use tunnelproof::certified::{self, Batch, Hit, Stage, Verdict};
use tunnelproof::query::{EdgeEdge, Point, Query};
use tunnelproof_reference::answer::{Enclosure, ExactAnswer, ExactHit, Parameters};
use tunnelproof_reference::generate::{FAMILIES, by_name};
use tunnelproof_reference::{field, oracle};

fn truth(query: &EdgeEdge) -> ExactAnswer {
    oracle::decide::<field::Default>(query)
        .expect("radius 0")
        .written()
}

/// What is not as the oracle says, if anything.
fn difference(query: &EdgeEdge, verdict: &Verdict) -> Option<String> {
    let truth = truth(query);
    match (verdict, truth.hit) {
        (Verdict::Miss, None) => None,
        (Verdict::Hit(hit), Some(exact)) => hit_difference(hit, &exact, &truth),
        (verdict, _) => Some(format!("{verdict:?} instead of {truth:?}")),
    }
}

fn hit_difference(hit: &Hit, exact: &ExactHit, truth: &ExactAnswer) -> Option<String> {
    let is_near = |value: f64, exact: Enclosure| {
        value >= exact.below - hit.parameter_error && value <= exact.above + hit.parameter_error
    };
    let agree = |ours: certified::Parameters, exact: Parameters| {
        is_near(ours.u, exact.u) && is_near(ours.v, exact.v)
    };
    let points_agree = agree(hit.first, exact.first)
        && match (hit.second, exact.second) {
            (None, None) => true,
            (Some(ours), Some(exact)) => agree(ours, exact),
            _ => false,
        };
    let same = (hit.toi, hit.toi_above) == (exact.toi.below, exact.toi.above)
        && (hit.kind, hit.side, hit.flags) == (exact.kind, exact.side, exact.flags)
        && hit.case == truth.case
        && points_agree;
    (!same).then(|| format!("{hit:?} instead of {exact:?}, {:?}", truth.case))
}

fn edge_edge(query: Query) -> Option<EdgeEdge> {
    match query {
        Query::EdgeEdge(query) => Some(query),
        Query::VertexFace(_) => None,
    }
}

#[test]
fn certified_is_the_oracle_on_every_family() {
    for family in FAMILIES {
        for index in 0..40_000 {
            let Some(query) = edge_edge(family.query(2, index)) else {
                continue;
            };
            let verdict = certified::decide(&query).expect("radius 0");
            let difference = difference(&query, &verdict);
            assert_eq!(difference, None, "{}:2:{index}", family.name());
        }
    }
}

#[test]
fn certified_batch_is_certified_one_by_one() {
    for family in FAMILIES {
        for count in [0, 1, 63, 64, 65, 5000] {
            let queries: Vec<EdgeEdge> = (0..count)
                .filter_map(|index| edge_edge(family.query(3, index)))
                .collect();
            let mut batch = Batch::new();
            queries
                .iter()
                .for_each(|query| batch.push(query).expect("radius 0"));
            let mut seen = 0;
            batch.decide(|index, verdict| {
                assert_eq!(index, seen);
                assert_eq!(
                    Ok(verdict),
                    certified::decide(&queries[index]),
                    "{}",
                    family.name()
                );
                seen += 1;
            });
            assert_eq!(seen, queries.len());
        }
    }
}

/// The share of queries that each stage decides, in percent.
fn shares(queries: impl Iterator<Item = EdgeEdge>) -> BTreeMap<Stage, f64> {
    let mut counts: BTreeMap<Stage, u64> = BTreeMap::new();
    let mut total = 0;
    for query in queries {
        let mut observe = |stage| *counts.entry(stage).or_default() += 1;
        let _ = certified::decide_observed(&query, &mut observe).expect("radius 0");
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

#[test]
fn certified_exact_stage_is_reached_no_more_often_than_it_must() {
    for (family, at_most) in [("uniform", 0.01), ("lattice", 60.0)] {
        let family = by_name(family).expect("a family");
        let shares = shares((0..20_000).filter_map(|index| edge_edge(family.query(1, index))));
        let exact = shares.get(&Stage::Exact).copied().unwrap_or(0.0);
        assert!(exact <= at_most, "{}: {shares:?}", family.name());
    }
}

/// Any finite coordinate: every exponent, subnormals and zeros.
fn any_coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>().prop_filter("finite", |x| x.is_finite()),
        (-4i32..=4).prop_map(f64::from),
        (-1.0f64..1.0, -1074i32..1023).prop_map(|(x, e)| x * 2f64.powi(e)),
    ]
}

fn any_query(coordinate: impl Strategy<Value = f64>) -> impl Strategy<Value = EdgeEdge> {
    prop::collection::vec(coordinate, 24).prop_map(|x| {
        let point = |i: usize| Point::new(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
        EdgeEdge::new([0, 1, 2, 3].map(point), [4, 5, 6, 7].map(point), 0.0)
            .expect("finite coordinates")
    })
}

/// A lattice query scaled and shifted, so that sums round, and then disturbed by a few ulp.
fn nearly_degenerate() -> impl Strategy<Value = EdgeEdge> {
    let disturbance = prop::array::uniform24(-2i64..=2);
    (0u64..1_000_000, -300i32..300, -8.0f64..8.0, disturbance).prop_map(
        |(index, exponent, shift, disturbance)| {
            let lattice = by_name("lattice").expect("a family").query(5, index);
            let mut disturbance = disturbance.into_iter();
            let mut disturbed = |p: &Point| {
                let mut q = *p;
                for x in q.coords.iter_mut() {
                    let ulps = disturbance.next().unwrap_or(0);
                    let y = (*x + shift) * 2f64.powi(exponent);
                    *x = f64::from_bits(y.to_bits().saturating_add_signed(ulps));
                }
                q
            };
            let start = lattice.start().each_ref().map(&mut disturbed);
            let end = lattice.end().each_ref().map(&mut disturbed);
            EdgeEdge::new(start, end, 0.0).expect("finite coordinates")
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn certified_is_the_oracle_over_all_magnitudes(query in any_query(any_coordinate())) {
        let verdict = certified::decide(&query).expect("radius 0");
        prop_assert_eq!(difference(&query, &verdict), None);
    }

    #[test]
    fn certified_is_the_oracle_near_degeneracy(query in nearly_degenerate()) {
        let verdict = certified::decide(&query).expect("radius 0");
        prop_assert_eq!(difference(&query, &verdict), None);
    }
}

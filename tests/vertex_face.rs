//! The certified path for a vertex and a face, and its exact stage alone, against the description
//! of contact evaluated at every candidate: the same answer to every query, in every bit.
//!
//! `TUNNELPROOF_CASES` sets the number of queries of a kind.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeMap;

use proptest::prelude::*;
use tunnelproof::certified::{Batch, Certified, Stage, decide, decide_exactly, decide_observed};
use tunnelproof::contact::{FacePlace, Hit, PLACE_ERROR, Verdict};
use tunnelproof::narrow::NarrowPhase;
use tunnelproof::query::{Point, Query, QueryKind, VertexFace};
use tunnelproof_reference::answer::Enclosure;
use tunnelproof_reference::generate::FAMILIES;

use corners::{
    Corners, all_scales, cases, lattice, nearly_degenerate, number, ordinary_scales, uniform,
};

mod corners;
#[path = "vertex_face/literal.rs"]
mod literal;
mod public;

fn query(corners: Corners) -> VertexFace {
    let p = corners.map(Point::from);
    VertexFace::new([p[0], p[1], p[2], p[3]], [p[4], p[5], p[6], p[7]], 0.0).unwrap()
}

/// What differs between the answers of the engine and the exact one.
fn difference(query: &VertexFace) -> Result<(), String> {
    let answers = [decide(query), decide_exactly(query)];
    let expected = literal::first_contact(query);
    for answer in answers {
        let is_same = match (&answer, &expected) {
            (None, None) => true,
            (Some(hit), Some(expected)) => is_same_hit(hit, expected),
            _ => false,
        };
        if !is_same {
            return Err(format!(
                "{answer:#?} instead of {expected:#?} for {query:?}"
            ));
        }
    }
    Ok(())
}

fn is_same_hit(hit: &Hit<FacePlace>, expected: &literal::Contact) -> bool {
    let toi = Enclosure {
        below: hit.toi,
        above: hit.toi_above,
    };
    let FacePlace { weights, error } = &hit.place;
    let near = |(&weight, exact): (&f64, &Enclosure)| {
        (0.0..=1.0).contains(&weight)
            && weight >= exact.below - error
            && weight <= exact.above + error
            && [0.0, 1.0]
                .iter()
                .all(|&end| *exact != Enclosure::exactly(end) || weight == end)
    };
    (toi, hit.kind, hit.side) == (expected.toi, expected.kind, expected.side)
        && (hit.case, hit.flags) == (expected.case, expected.flags)
        && *error <= PLACE_ERROR
        && weights.iter().zip(&expected.weights).all(near)
}

/// A weight of a corner, 0 as often as not.
fn weight() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), 0.0..1.0f64]
}

/// The vertex goes through a place of the face, which may be an edge or a corner, up to rounding.
fn rounded_contact() -> impl Strategy<Value = VertexFace> {
    let points = prop::array::uniform8(prop::array::uniform3(number()));
    let weights = prop::array::uniform3(weight());
    (points, weights, 0.1..=1.0f64, 0u8..4).prop_map(|(mut p, weights, t, what)| {
        let sum = weights.iter().sum::<f64>().max(0.1);
        if what == 0 {
            // The face does not move.
            for i in 1..4 {
                p[4 + i] = p[i];
            }
        }
        for h in [0, 1, 2] {
            let at = |i: usize| (1.0 - t) * p[i][h] + t * p[4 + i][h];
            let place: f64 = (0..3).map(|i| weights[i] / sum * at(1 + i)).sum();
            // At t the vertex is there; it starts anywhere.
            p[4][h] = p[0][h] + (place - p[0][h]) / t;
        }
        query(p)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(2_000)))]

    #[test]
    fn vertex_face_is_exact_on_lattice(corners in lattice()) {
        prop_assert_eq!(difference(&query(corners)), Ok(()));
    }

    #[test]
    fn vertex_face_is_exact_on_uniform(corners in uniform()) {
        prop_assert_eq!(difference(&query(corners)), Ok(()));
    }

    #[test]
    fn vertex_face_is_exact_on_rounded_contact(query in rounded_contact()) {
        prop_assert_eq!(difference(&query), Ok(()));
    }

    #[test]
    fn vertex_face_is_exact_on_ordinary_scales(corners in ordinary_scales()) {
        prop_assert_eq!(difference(&query(corners)), Ok(()));
    }

    #[test]
    fn vertex_face_is_exact_on_all_scales(corners in all_scales()) {
        prop_assert_eq!(difference(&query(corners)), Ok(()));
    }

    #[test]
    fn vertex_face_is_exact_on_nearly_degenerate(corners in nearly_degenerate()) {
        prop_assert_eq!(difference(&query(corners)), Ok(()));
    }
}

/// The four points of the families of edges, as vertex and face.
fn of_family(query: &Query, order: [usize; 4]) -> VertexFace {
    let points = |points: &[Point; 4]| order.map(|i| points[i]);
    VertexFace::new(points(query.start()), points(query.end()), 0.0).unwrap()
}

#[test]
fn vertex_face_is_exact_on_the_points_of_every_family() {
    for family in FAMILIES {
        for index in 0..u64::from(cases(2_000) / 4) {
            let query = family.query(11, index);
            for order in [[0, 1, 2, 3], [2, 0, 1, 3]] {
                let result = difference(&of_family(&query, order));
                assert_eq!(result, Ok(()), "{}:11:{index} {order:?}", family.name());
            }
        }
    }
}

/// The most that integers may decide of the points of each family, C against ABD, in percent: what
/// they did when this was written, rounded up.
const EXACT_AT_MOST: &[(&str, f64)] = &[
    ("uniform", 0.01),
    ("lattice", 68.0),
    ("near_coplanar", 48.0),
    ("near_parallel", 75.0),
    ("near_collinear", 73.0),
    ("shared_start", 50.0),
    ("point_on_line", 73.0),
    ("temporarily_parallel", 67.0),
    ("temporarily_point", 76.0),
    ("grazing", 26.0),
    ("triple_root", 92.0),
    ("scales", 64.0),
    ("cancellation", 8.0),
    ("slow", 19.0),
    ("long_thin", 20.0),
    ("joint", 0.01),
];

#[test]
fn vertex_face_exact_stage_is_reached_no_more_often_than_it_must() {
    for family in FAMILIES {
        let mut exact = 0;
        let count = cases(20_000);
        for index in 0..u64::from(count) {
            let query = of_family(&family.query(1, index), [2, 0, 1, 3]);
            let mut observe = |stage| exact += u32::from(stage == Stage::Exact);
            decide_observed(&query, &mut observe);
        }
        let named = EXACT_AT_MOST
            .iter()
            .find(|(name, _)| *name == family.name());
        let (_, at_most) = named.unwrap();
        let share = 100.0 * f64::from(exact) / f64::from(count);
        assert!(share <= *at_most, "{}: {share}%", family.name());
    }
}

#[test]
fn vertex_face_batch_is_certified_one_by_one() {
    let mut hits = 0;
    for family in FAMILIES {
        for count in [0, 1, 7, 8, 9, 255, 256, 257, 2000] {
            let queries = (0..count).map(|index| family.query(3, index));
            let queries: Vec<_> = queries
                .map(|query| of_family(&query, [2, 0, 1, 3]))
                .collect();
            let mut batch = Batch::new();
            for query in &queries {
                batch.push(query);
            }
            let (mut found, mut named) = (Vec::new(), 0);
            batch.decide_observed(|index, hit| found.push((index, hit)), |_| named += 1);
            let expected: Vec<_> = queries
                .iter()
                .map(decide)
                .enumerate()
                .filter_map(|(index, hit)| Some((index, hit?)))
                .collect();
            assert_eq!(found, expected, "{}", family.name());
            assert_eq!(named, queries.len(), "{}", family.name());
            #[cfg(feature = "rayon")]
            assert_eq!(batch.par_decide(), expected, "{}", family.name());
            hits += found.len();
        }
    }
    assert!(hits > 1000, "{hits}");
}

#[test]
fn vertex_face_is_exact_and_as_labelled_on_the_public_sets() {
    for entry in public::set(public::VECTORS, QueryKind::VertexFace) {
        let query = entry.query.as_vertex_face().unwrap();
        assert_eq!(difference(query), Ok(()), "{}", entry.id);
        assert_eq!(Some(decide(query).is_some()), entry.label, "{}", entry.id);
    }
    let sets = public::SETS.map(|set| public::set(set, QueryKind::VertexFace));
    let entries = sets.concat();
    let mut shares: BTreeMap<Stage, u32> = BTreeMap::new();
    for entry in &entries {
        let query = entry.query.as_vertex_face().unwrap();
        assert_eq!(difference(query), Ok(()), "{}", entry.id);
        let mut observe = |stage| *shares.entry(stage).or_default() += 1;
        let hit = decide_observed(query, &mut observe);
        assert_eq!(Some(hit.is_some()), entry.label, "{}", entry.id);
    }
    eprintln!("{} labelled queries, {shares:?}", entries.len());
    let exact = shares.get(&Stage::Exact).copied().unwrap_or(0);
    assert!(
        f64::from(exact) <= 0.048 * entries.len() as f64,
        "{shares:?}"
    );
}

#[test]
fn vertex_face_hit_is_a_contact_in_space() {
    let face = [[-1., -1., 0.], [3., -1., 0.], [-1., 3., 0.]];
    let at = |vertex: [f64; 3]| [vertex, face[0], face[1], face[2]].map(Point::from);
    let query = VertexFace::new(at([1., 0., 1.]), at([1., 0., -3.]), 0.0).unwrap();
    let report = Certified.vertex_face(&query).unwrap();
    let Verdict::Hit(contact) = report.verdict else {
        unreachable!("it goes through the face")
    };
    assert_eq!(contact.toi, 0.25);
    let first = contact.first;
    assert_eq!(first.weights, [1.0, 0.25, 0.5, 0.25]);
    assert_eq!(first.point, Point::new(1., 0., 0.));
    // The face rises through the vertex, which comes from above.
    assert_eq!(first.relative_velocity.unwrap().as_slice(), [0., 0., 1.]);
    assert_eq!(contact.normal.unwrap().as_slice(), [0., 0., -1.]);
}

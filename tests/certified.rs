//! The certified path and its exact stage alone against the oracle: the same answer to every query,
//! in every bit.
//!
//! `TUNNELPROOF_CASES` sets the number of queries of a kind.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use proptest::prelude::*;
use tunnelproof::contact::{EdgePlace, EdgePoint, Hit, PLACE_ERROR};
use tunnelproof::query::{EdgeEdge, Point, Query, QueryKind};
use tunnelproof::{classify, decide, decide_exactly};
use tunnelproof_reference::answer::{self, Enclosure};
use tunnelproof_reference::generate::FAMILIES;
use tunnelproof_reference::{field, oracle};

use corners::{
    Corners, all_scales, cases, lattice, nearly_degenerate, number, ordinary_scales, uniform,
};

mod corners;
mod public;

fn query(corners: Corners) -> EdgeEdge {
    let p = corners.map(Point::from);
    EdgeEdge::new([p[0], p[1], p[2], p[3]], [p[4], p[5], p[6], p[7]], 0.0).unwrap()
}

/// What differs between the answers of the engine and the oracle's.
fn difference(query: &EdgeEdge) -> Result<(), String> {
    let exact = decide_exactly(query);
    let cascade = decide(query);
    let expected = oracle::decide::<field::Default>(&Query::EdgeEdge(*query)).written();
    let is_same = |hit: &Option<Hit<EdgePlace>>| match (hit, &expected.hit) {
        (None, None) => true,
        (Some(hit), Some(exact)) => hit.case == expected.case && is_same_hit(hit, exact),
        _ => false,
    };
    if classify(query) == expected.case && is_same(&exact) && is_same(&cascade) {
        Ok(())
    } else {
        Err(format!(
            "{cascade:#?} and {exact:#?} instead of {expected:#?} for {query:?}"
        ))
    }
}

fn is_same_hit(hit: &Hit<EdgePlace>, expected: &answer::ExactHit) -> bool {
    let toi = Enclosure {
        below: hit.toi,
        above: hit.toi_above,
    };
    let EdgePlace {
        first,
        second,
        error,
    } = &hit.place;
    let is_same_place = |place: &EdgePoint, expected| is_same_place(place, expected, *error);
    let second = match (second, &expected.second) {
        (None, None) => true,
        (Some(second), Some(expected)) => is_same_place(second, expected),
        _ => false,
    };
    (toi, hit.kind, hit.side, hit.flags)
        == (expected.toi, expected.kind, expected.side, expected.flags)
        && is_same_place(first, &expected.first)
        && second
}

fn is_same_place(place: &EdgePoint, expected: &answer::Parameters, error: f64) -> bool {
    let near = |value: f64, exact: &Enclosure| {
        let is_end = |end: f64| *exact == Enclosure::exactly(end);
        let at_end = [0.0, 1.0].iter().all(|&end| is_end(end) <= (value == end));
        at_end
            && (0.0..=1.0).contains(&value)
            && value >= exact.below - error
            && value <= exact.above + error
    };
    error <= PLACE_ERROR && near(place.u, &expected.u) && near(place.v, &expected.v)
}

/// Uniform, with points of one edge put onto the other, and so contact at given times and places up
/// to rounding.
fn rounded_contact() -> impl Strategy<Value = EdgeEdge> {
    let points = prop::array::uniform8(prop::array::uniform3(number()));
    (points, 0.0..=1.0f64, 0u8..4).prop_map(|(mut p, u, what)| {
        let between =
            |a: [f64; 3], b: [f64; 3], u: f64| [0, 1, 2].map(|h| a[h] + u * (b[h] - a[h]));
        match what {
            0 => p[6] = between(p[4], p[5], u),
            1 => p[2] = between(p[0], p[1], u),
            // The whole edge ends in the line of the other.
            2 => {
                p[6] = between(p[4], p[5], u);
                p[7] = between(p[4], p[5], u + 1.0);
            }
            // A passes D half way.
            _ => p[7] = [0, 1, 2].map(|h| p[0][h] + p[4][h] - p[3][h]),
        }
        query(p)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(5_000)))]

    #[test]
    fn certified_agrees_with_the_oracle_on_lattice(corners in lattice()) {
        prop_assert_eq!(difference(&query(corners)), Ok(()));
    }

    #[test]
    fn certified_agrees_with_the_oracle_on_uniform(corners in uniform()) {
        prop_assert_eq!(difference(&query(corners)), Ok(()));
    }

    #[test]
    fn certified_agrees_with_the_oracle_on_rounded_contact(query in rounded_contact()) {
        prop_assert_eq!(difference(&query), Ok(()));
    }

    #[test]
    fn certified_agrees_with_the_oracle_on_ordinary_scales(corners in ordinary_scales()) {
        prop_assert_eq!(difference(&query(corners)), Ok(()));
    }

    #[test]
    fn certified_agrees_with_the_oracle_on_all_scales(corners in all_scales()) {
        prop_assert_eq!(difference(&query(corners)), Ok(()));
    }

    #[test]
    fn certified_agrees_with_the_oracle_on_nearly_degenerate(corners in nearly_degenerate()) {
        prop_assert_eq!(difference(&query(corners)), Ok(()));
    }
}

#[test]
fn certified_agrees_with_the_oracle_on_every_family() {
    for family in FAMILIES {
        for index in 0..u64::from(cases(5_000)) {
            if let Query::EdgeEdge(query) = family.query(7, index) {
                assert_eq!(difference(&query), Ok(()), "{}:7:{index}", family.name());
            }
        }
    }
}

/// Three roots of the cubic, of which the middle one is 1/2, where an interval is halved.
#[test]
fn certified_agrees_with_the_oracle_where_the_middle_one_of_three_roots_is_a_half() {
    let lattice = FAMILIES.iter().find(|family| family.name() == "lattice");
    for index in [996, 3086] {
        let query = lattice.unwrap().query(1, index);
        let query = query.as_edge_edge().unwrap();
        assert_eq!(difference(query), Ok(()), "lattice:1:{index}");
    }
}

#[test]
fn certified_agrees_with_the_oracle_and_the_labels_of_the_public_sets() {
    for set in public::SETS {
        for entry in public::set(set, QueryKind::EdgeEdge) {
            let query = entry.query.as_edge_edge().unwrap();
            assert_eq!(difference(query), Ok(()), "{}", entry.id);
            let is_hit = decide(query).is_some();
            assert_eq!(Some(is_hit), entry.label, "{}", entry.id);
        }
    }
}

//! The generated families are what they are for: hits and misses, edges that come near each other,
//! and the weakness that each is named for shows.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeMap;

use tunnelproof::contact::Case;
use tunnelproof::query::Query;
use tunnelproof_reference::certify::block::Block;
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::certify::run::Panel;
use tunnelproof_reference::certify::source::Source;
use tunnelproof_reference::certify::tally::Fault::{self, *};
use tunnelproof_reference::generate::{FAMILIES, Family, by_name};
use tunnelproof_reference::{oracle, registry};

const COUNT: u64 = 4000;

fn queries(family: &Family) -> impl Iterator<Item = Query> {
    (0..COUNT).map(|index| family.query(2, index))
}

fn share(family: &Family, is_counted: impl Fn(&Query) -> bool) -> f64 {
    queries(family).filter(is_counted).count() as f64 / COUNT as f64
}

/// Whether the boxes around AB and CD during the whole step have a point in common.
fn boxes_overlap(query: &Query) -> bool {
    let range = |points: [usize; 2], axis: usize| {
        let ends = [query.start(), query.end()];
        let values = ends.map(|end| points.map(|i| end[i][axis]));
        let values = values.as_flattened().iter().copied();
        (
            values.clone().fold(f64::MAX, f64::min),
            values.fold(f64::MIN, f64::max),
        )
    };
    (0..3).all(|axis| {
        let ((a, b), (c, d)) = (range([0, 1], axis), range([2, 3], axis));
        a <= d && c <= b
    })
}

#[test]
fn families_have_hits_and_misses_and_are_seldom_trivial() {
    for family in FAMILIES {
        let hits = share(family, |query| oracle::decide_query(query).hit.is_some());
        let near = share(family, boxes_overlap);
        println!(
            "{}: {hits} hit, {near} with boxes that overlap",
            family.name()
        );
        assert!((0.19..0.8).contains(&hits), "{}: {hits} hit", family.name());
        assert!(near > 0.5, "{}: {near} come near", family.name());
    }
}

#[test]
fn families_meet_the_cases_that_they_are_near_to_and_the_general_one() {
    for (name, case, least) in [
        ("near_coplanar", Case::Coplanar, 0.01),
        ("near_parallel", Case::Parallel, 0.01),
        ("near_collinear", Case::Collinear, 0.01),
        ("shared_start", Case::SharedStart, 0.2),
        ("point_on_line", Case::Coplanar, 0.5),
    ] {
        let family = by_name(name).unwrap();
        let mut shares: BTreeMap<Case, f64> = BTreeMap::new();
        for query in queries(family) {
            let case = oracle::decide_query(&query).case;
            *shares.entry(case).or_default() += 1.0 / COUNT as f64;
        }
        println!("{name}: {shares:?}");
        assert!(shares[&case] > least, "{name}: {shares:?}");
        assert!(shares[&Case::General] > 0.15, "{name}: {shares:?}");
    }
}

fn certify(family: &str, subject: &str) -> Block {
    let panel = Panel {
        second_judges: registry::second_judges().to_vec(),
        subjects: vec![Judged {
            subject: registry::by_name(subject).unwrap(),
            explain: None,
        }],
    };
    let source = Source::Family {
        family: by_name(family).unwrap(),
        seed: 1,
        count: COUNT,
    };
    panel.run(&source.clone().into(), |_| {}).unwrap()
}

#[test]
fn families_reach_the_weakness_that_they_are_for() {
    let table: [(&str, &str, &[Fault]); 15] = [
        ("near_coplanar", "thesis", &[Tunnel, MissedGraze, WrongCase]),
        ("near_parallel", "thesis", &[Tunnel, MissedGraze, WrongCase]),
        (
            "near_collinear",
            "thesis",
            &[Tunnel, MissedGraze, WrongCase],
        ),
        ("shared_start", "thesis", &[NearHit, WrongCase]),
        ("point_on_line", "thesis", &[Tunnel, MissedGraze]),
        ("temporarily_parallel", "thesis", &[Tunnel, MissedGraze]),
        ("temporarily_point", "thesis", &[Tunnel, MissedGraze]),
        ("grazing", "thesis", &[Tunnel, MissedGraze]),
        ("triple_root", "thesis", &[Tunnel, MissedGraze]),
        ("scales", "thesis", &[Tunnel, FalseHit]),
        ("scales", "additive", &[Tunnel, NoAnswer]),
        ("cancellation", "additive", &[Tunnel]),
        ("slow", "additive", &[Tunnel]),
        ("long_thin", "thesis", &[Tunnel, Late]),
        ("joint", "thesis", &[Tunnel, JointTunnel]),
    ];
    for (family, subject, faults) in table {
        let block = certify(family, subject);
        for fault in faults {
            let count = block.tallies[0].count(*fault);
            println!("{subject} on {family}: {count} times {}", fault.name());
            assert!(count > 0, "{subject} on {family}: no {}", fault.name());
        }
    }
}

#[test]
fn joint_wires_are_passed_and_no_exact_subject_misses_both_segments() {
    for subject in ["oracle", "shadow", "certified"] {
        let block = certify("joint", subject);
        assert_eq!(block.joints, COUNT / 2);
        assert_eq!(block.tallies[0].count(JointTunnel), 0, "{subject}");
    }
}

//! The certified path and its exact stage alone against the oracle: the same answer to every query, in
//! every bit.
//!
//! `TUNNELPROOF_CASES` sets the number of queries of a kind.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use tunnelproof::certified::{Hit, Parameters, Verdict, decide, decide_exactly};
use tunnelproof::query::{EdgeEdge, Point, Query};
use tunnelproof_reference::answer::{self, Enclosure};
use tunnelproof_reference::corpus::{self, ReadOptions};
use tunnelproof_reference::generate::FAMILIES;
use tunnelproof_reference::{field, oracle};

use corners::{Corners, all_scales, lattice, nearly_degenerate, number, ordinary_scales, uniform};

mod corners;

/// Queries of a kind.
fn cases() -> u32 {
    let asked = std::env::var("TUNNELPROOF_CASES").ok();
    asked.map_or(5_000, |text| {
        text.parse().expect("TUNNELPROOF_CASES is a number")
    })
}

fn query(corners: Corners) -> EdgeEdge {
    let p = corners.map(Point::from);
    EdgeEdge::new([p[0], p[1], p[2], p[3]], [p[4], p[5], p[6], p[7]], 0.0).unwrap()
}

/// What differs between the answers of the engine and the oracle's.
fn difference(query: &EdgeEdge) -> Result<(), String> {
    let exact = decide_exactly(query).map_err(|e| e.to_string())?;
    let cascade = match decide(query).map_err(|e| e.to_string())? {
        Verdict::Miss => None,
        Verdict::Hit(hit) => Some(hit),
    };
    let expected = oracle::decide::<field::Default>(&Query::EdgeEdge(*query)).written();
    let is_same = |hit: &Option<Hit>| match (hit, &expected.hit) {
        (None, None) => true,
        (Some(hit), Some(exact)) => hit.case == expected.case && is_same_hit(hit, exact),
        _ => false,
    };
    if exact.case == expected.case && is_same(&exact.hit) && is_same(&cascade) {
        Ok(())
    } else {
        Err(format!(
            "{cascade:#?} and {exact:#?} instead of {expected:#?} for {query:?}"
        ))
    }
}

fn is_same_hit(hit: &Hit, expected: &answer::ExactHit) -> bool {
    let toi = Enclosure {
        below: hit.toi,
        above: hit.toi_above,
    };
    let is_same_place =
        |place: &Parameters, expected| is_same_place(place, expected, hit.parameter_error);
    let second = match (&hit.second, &expected.second) {
        (None, None) => true,
        (Some(second), Some(expected)) => is_same_place(second, expected),
        _ => false,
    };
    (toi, hit.kind, hit.side, hit.flags)
        == (expected.toi, expected.kind, expected.side, expected.flags)
        && is_same_place(&hit.first, &expected.first)
        && second
}

fn is_same_place(place: &Parameters, expected: &answer::Parameters, error: f64) -> bool {
    let near = |value: f64, exact: &Enclosure| {
        let is_end = |end: f64| *exact == Enclosure::exactly(end);
        let at_end = [0.0, 1.0].iter().all(|&end| is_end(end) <= (value == end));
        at_end
            && (0.0..=1.0).contains(&value)
            && value >= exact.below - error
            && value <= exact.above + error
    };
    error <= Hit::PARAMETER_ERROR && near(place.u, &expected.u) && near(place.v, &expected.v)
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
    #![proptest_config(ProptestConfig::with_cases(cases()))]

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
        for index in 0..u64::from(cases()) {
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
        let Query::EdgeEdge(query) = lattice.unwrap().query(1, index) else {
            panic!("lattice:1:{index} is edge-edge");
        };
        assert_eq!(difference(&query), Ok(()), "lattice:1:{index}");
    }
}

/// Every file of edge-edge queries below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let name = path.to_string_lossy();
        if path.is_dir() {
            found.extend(files(&path));
        } else if name.contains("edge-edge") && name.ends_with(".csv") || name.ends_with(".ee.bin")
        {
            found.push(path);
        }
    }
    found
}

/// The queries of a file and their labels.
fn labelled(path: &Path) -> Vec<(EdgeEdge, bool)> {
    if path.extension().is_some_and(|extension| extension == "bin") {
        return labelled_binary(&fs::read(path).unwrap());
    }
    let entries = corpus::open(&path.to_string_lossy(), ReadOptions::default()).unwrap();
    let entries = entries.map(|entry| entry.unwrap());
    entries
        .filter_map(|entry| match entry.query {
            Query::EdgeEdge(query) => Some((query, entry.label?)),
            Query::VertexFace(_) => None,
        })
        .collect()
}

/// A count, 24 coordinates for each query, a byte for each label.
fn labelled_binary(bytes: &[u8]) -> Vec<(EdgeEdge, bool)> {
    let (count, rest) = bytes.split_first_chunk().unwrap();
    let (queries, labels) = rest.split_at(192 * usize::from_le_bytes(*count));
    let number = |bytes: &[u8]| f64::from_le_bytes(bytes.try_into().unwrap());
    let queries = queries.chunks_exact(192).map(|bytes| {
        let values: Vec<f64> = bytes.chunks_exact(8).map(number).collect();
        query(std::array::from_fn(|i| {
            std::array::from_fn(|h| values[3 * i + h])
        }))
    });
    queries
        .zip(labels.iter().map(|&label| label == 1))
        .collect()
}

#[test]
fn certified_agrees_with_the_oracle_and_the_labels_of_the_public_sets() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let files = files(&folder);
    if files.is_empty() {
        eprintln!("skipped: no public sets in {}", folder.display());
        return;
    }
    let mut count = 0;
    for path in files {
        for (index, (query, label)) in labelled(&path).into_iter().enumerate() {
            let id = || format!("{} {index}", path.display());
            assert_eq!(difference(&query), Ok(()), "{}", id());
            let is_hit = decide(&query).unwrap() != Verdict::Miss;
            assert_eq!(is_hit, label, "{}", id());
            count += 1;
        }
    }
    eprintln!("{count} labelled queries");
    assert!(count >= 1000, "only {count} queries were read");
}

#[test]
fn certified_refuses_a_radius() {
    let zero = [Point::origin(); 4];
    let query = EdgeEdge::new(zero, zero, 0.5).unwrap();
    let error = decide_exactly(&query).unwrap_err();
    assert_eq!(
        error.to_string(),
        "a radius above 0 is not supported yet (this one is 0.5)"
    );
    assert_eq!(decide(&query).unwrap_err(), error);
}

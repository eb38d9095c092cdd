//! The test vectors, read back from the JSON alone: the schema holds, a second judge and exact
//! arithmetic of this file's own say the same, and the certified path answers every one of them.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod vector_files;

use std::collections::BTreeSet;
use std::fs;

use rayon::prelude::*;
use serde_json::{Value, json};
use tunnelproof::contact::{self, EdgePlace, FacePlace};
use tunnelproof_reference::answer::{Enclosure, Parameters};
use tunnelproof_reference::shadow::Shadow;
use tunnelproof_reference::subject::{Answer, Certified, Subject};
use tunnelproof_reference::{difference, field};

use vector_files::reader::{
    Bounds, ExactTime, Place, Radius, Root, Vector, folder, names, vectors,
};
use vector_files::{rational, says};

/// Every file in the folder but the schema, parsed.
fn documents() -> Vec<(String, Value)> {
    let names = names();
    let read = |name: String| {
        let text = fs::read_to_string(folder().join(&name)).unwrap();
        let document = serde_json::from_str(&text).unwrap();
        (name, document)
    };
    names.into_iter().map(read).collect()
}

fn schema() -> jsonschema::Validator {
    let text = fs::read_to_string(folder().join("schema.json")).unwrap();
    jsonschema::validator_for(&serde_json::from_str(&text).unwrap()).unwrap()
}

#[test]
fn vectors_files_fulfil_the_schema() {
    let schema = schema();
    let documents = documents();
    assert!(documents.len() > 3);
    for (name, document) in documents {
        let errors: Vec<_> = schema.iter_errors(&document).collect();
        let first = errors
            .first()
            .map(|error| format!("{}: {error}", error.instance_path()));
        assert_eq!(first, None, "{name}");
    }
}

#[test]
fn vectors_schema_refuses_what_is_wrong() {
    let schema = schema();
    let (_, good) = documents()
        .into_iter()
        .find(|(name, _)| name == "figures.json")
        .unwrap();
    assert!(schema.is_valid(&good));
    for (pointer, wrong) in [
        ("/number_of_vectors", json!("12")),
        ("/vectors/0/flags/0", json!("no flag")),
        ("/vectors/0/wire", json!({"id": "a"})),
        ("/vectors/0/points/0", json!([0, 0])),
        ("/vectors/0/points_hex/0/0", json!("0x1.8")),
        ("/vectors/0/result/hit", json!(false)),
        ("/vectors/0/result/case", json!("none")),
        ("/vectors/0/result/toi/below", json!(1.5)),
        ("/vectors/0/exact_toi", json!(null)),
        ("/vectors/0/exact_toi/fraction/1", json!("0")),
        ("/vectors/0/radius", json!(-1)),
        ("/vectors/0/radius", json!([1])),
        ("/vectors/0/radius_hex", json!("1")),
        ("/vectors/0/kind", json!("vertex-face")),
        ("/vectors/0/kind", json!("edge")),
        ("/vectors/0/result/features", json!(["A", "BCD"])),
        ("/vectors/0/more", json!(1)),
    ] {
        let mut document = good.clone();
        match document.pointer_mut(pointer) {
            Some(place) => *place = wrong,
            None => document["vectors"][0]["more"] = wrong,
        }
        assert!(!schema.is_valid(&document), "{pointer}");
    }
}

#[test]
fn vectors_have_flags_that_resolve_and_counts_and_ids_that_are_right() {
    let mut ids = BTreeSet::new();
    for (name, document) in documents() {
        let vectors = document["vectors"].as_array().unwrap();
        assert_eq!(document["number_of_vectors"], vectors.len(), "{name}");
        let flags = vectors
            .iter()
            .flat_map(|vector| vector["flags"].as_array().unwrap());
        let flags: BTreeSet<_> = flags.map(|flag| flag.as_str().unwrap()).collect();
        let notes = document["notes"].as_object().unwrap();
        assert_eq!(flags, notes.keys().map(String::as_str).collect(), "{name}");
        for vector in vectors {
            let id = vector["id"].as_str().unwrap().to_owned();
            assert!(ids.insert(id.clone()), "{id} is there twice");
        }
    }
    assert!(ids.len() >= 2000, "{}", ids.len());
}

#[test]
fn vectors_agree_with_the_second_judge_and_with_rational_arithmetic() {
    vectors().par_iter().for_each(|vector| {
        assert_eq!(check(vector), Ok(()), "{}", vector.id);
    });
}

/// What a second way finds wrong with a vector.
fn check(vector: &Vector) -> Result<(), String> {
    second_judge_agrees(vector)?;
    rational::check(vector)
}

/// The shadow judges edges without radius, the difference of the two sides everything else.
fn second_judge_agrees(vector: &Vector) -> Result<(), String> {
    let query = vector.query();
    let of_edges = Shadow::REPAIRED.decide(&query);
    let exact = of_edges.unwrap_or_else(|_| difference::decide::<field::Default>(&query));
    let result = &vector.result;
    says("case", exact.case.name() == result.case)?;
    says("hit", exact.hit.is_some() == result.hit)?;
    let Some(hit) = exact.hit else {
        return says("contact of a miss", result.toi.is_none());
    };
    let bounds = |exact: Enclosure| Bounds {
        below: exact.below,
        above: exact.above,
    };
    let place = |exact: Parameters| Place {
        u: bounds(exact.u),
        v: bounds(exact.v),
    };
    says("toi", Some(bounds(hit.toi)) == result.toi)?;
    let features = hit.features.map(|feature| feature.to_string());
    says("features", Some(features) == result.features)?;
    says("u", Some(bounds(hit.first.u)) == result.u)?;
    says("v", Some(bounds(hit.first.v)) == result.v)?;
    says("overlap", hit.second.map(place) == result.overlap)?;
    says(
        "kind",
        Some(hit.kind.name()) == result.kind_of_contact.as_deref(),
    )?;
    says("crosses", Some(hit.crosses) == result.crosses)?;
    says("side", Some(hit.side) == result.side)?;
    let flags = (
        Some(hit.flags.temporarily_parallel),
        Some(hit.flags.temporarily_point),
    );
    says(
        "flags",
        flags == (result.temporarily_parallel, result.temporarily_point),
    )
}

fn fraction(vector: &mut Vector) -> &mut [String; 2] {
    let exact = vector.exact_toi.as_mut().unwrap();
    exact.fraction.as_mut().unwrap()
}

fn root(vector: &mut Vector) -> &mut Root {
    let exact = vector.exact_toi.as_mut().unwrap();
    exact.root.as_mut().unwrap()
}

#[test]
fn vectors_that_are_changed_are_found_wrong() {
    let all = vectors();
    let find = |wanted: &dyn Fn(&Vector) -> bool| {
        all.iter().find(|vector| wanted(vector)).unwrap().clone()
    };
    let rational = find(&|vector| {
        vector
            .exact_toi
            .as_ref()
            .is_some_and(|toi| toi.fraction.is_some())
            && vector.result.toi.unwrap().below > 0.0
    });
    let irrational = find(&|vector| {
        vector
            .exact_toi
            .as_ref()
            .is_some_and(|toi| toi.root.is_some())
    });
    let irrational_of = |kind: &str, is_thick: bool| {
        find(&|vector| {
            let is_thick_one = matches!(vector.radius, Radius::One(radius) if radius > 0.0);
            let has_root = |toi: &ExactTime| toi.root.is_some();
            vector.kind == kind
                && is_thick_one == is_thick
                && vector.exact_toi.as_ref().is_some_and(has_root)
        })
    };
    type Change = fn(&mut Vector);
    let of_both: [Change; 6] = [
        |vector| vector.result.hit = false,
        |vector| vector.result.toi.as_mut().unwrap().below = 0.0,
        |vector| vector.result.kind_of_contact = None,
        |vector| vector.result.case = "none".to_owned(),
        |vector| vector.points_hex[0][0] = "0x1.8p+7".to_owned(),
        |vector| vector.exact_toi = None,
    ];
    let of_fractions: [Change; 2] = [
        |vector| fraction(vector)[1] += "0",
        |vector| *fraction(vector) = ["1", "1023"].map(str::to_owned),
    ];
    let of_roots: [Change; 4] = [
        |vector| root(vector).polynomial[0] += "1",
        |vector| root(vector).polynomial[1] += "1",
        |vector| root(vector).interval.reverse(),
        |vector| root(vector).interval[0] = root(vector).interval[1].clone(),
    ];
    let of_points: [Change; 2] = [
        |vector| vector.radius = Radius::Sum([1.0, 1.0]),
        |vector| vector.points[7][0] += 1.0,
    ];
    let of_radii: [Change; 2] = [
        |vector| {
            vector.radius = Radius::One(0.0);
            vector.radius_hex = Radius::One("0x0p+0".to_owned());
        },
        |vector| vector.radius_hex = Radius::One("0x1p+9".to_owned()),
    ];
    let of_other_kinds = [
        (irrational_of("vertex-face", false), &of_points[..]),
        (irrational_of("vertex-face", true), &of_points),
        (irrational_of("vertex-face", true), &of_radii),
        (irrational_of("edge-edge", true), &of_radii),
    ];
    let rational_changes = of_both
        .iter()
        .chain(&of_fractions)
        .map(|change| (&rational, change));
    let irrational_changes = of_both
        .iter()
        .chain(&of_roots)
        .map(|change| (&irrational, change));
    let other_changes = of_other_kinds.iter();
    let other_changes = other_changes
        .flat_map(|(vector, changes)| changes.iter().map(move |change| (vector, change)));
    let changes = rational_changes
        .chain(irrational_changes)
        .chain(other_changes);
    for (index, (vector, change)) in changes.enumerate() {
        let mut changed = vector.clone();
        change(&mut changed);
        assert!(check(&changed).is_err(), "change {index} of {}", vector.id);
    }
}

#[test]
fn vectors_are_answered_by_the_certified_path() {
    for vector in vectors() {
        let (id, result) = (&vector.id, &vector.result);
        let answer = Certified.answer(&vector.query());
        let Ok(Answer::Certified(hit)) = answer else {
            panic!("{id}: {answer:?}");
        };
        let Some(hit) = hit else {
            assert!(!result.hit, "{id} is missed");
            continue;
        };
        assert!(result.hit, "{id} is no hit");
        let toi = Bounds {
            below: hit.toi,
            above: hit.toi_above,
        };
        assert_eq!(Some(toi), result.toi, "{id}");
        assert_eq!(hit.case.name(), result.case, "{id}");
        assert_eq!(
            Some(hit.kind.name()),
            result.kind_of_contact.as_deref(),
            "{id}"
        );
        assert_eq!(Some(hit.side), result.side, "{id}");
        let flags = (
            Some(hit.flags.temporarily_parallel),
            Some(hit.flags.temporarily_point),
        );
        assert_eq!(
            flags,
            (result.temporarily_parallel, result.temporarily_point),
            "{id}"
        );
        let (first, second, error) = match hit.place {
            contact::Place::Edges(EdgePlace {
                first,
                second,
                error,
            }) => ([first.u, first.v], second.map(|at| [at.u, at.v]), error),
            contact::Place::Face(FacePlace { weights, error }) => {
                ([weights[1], weights[2]], None, error)
            }
        };
        let is_near = |value: f64, exact: Bounds| {
            value >= exact.below - error && value <= exact.above + error
        };
        let agrees = |[u, v]: [f64; 2], u_exact: Bounds, v_exact: Bounds| {
            is_near(u, u_exact) && is_near(v, v_exact)
        };
        assert!(agrees(first, result.u.unwrap(), result.v.unwrap()), "{id}");
        match (second, result.overlap) {
            (None, None) => {}
            (Some(ours), Some(exact)) => assert!(agrees(ours, exact.u, exact.v), "{id}"),
            _ => panic!("{id}: an overlap against a point"),
        }
    }
}

#[test]
fn vectors_that_are_shrunk_show_the_failure_that_they_are_called_after() {
    let all = vectors();
    let mut seen = 0;
    for vector in &all {
        let parts: Vec<_> = vector.id.split('/').collect();
        let method = match parts[..] {
            [_, "thesis", _] => "InThresholdedMethod",
            [_, "shadow-published", _] => "InPublishedText",
            [_, "additive", _] => "InConservativeAdvancement",
            _ => continue,
        };
        let fault = parts[2].replace('-', "");
        let shows = |flag: &String| {
            let flagged = flag.strip_suffix(method).map(str::to_lowercase);
            flagged == Some(fault.clone())
        };
        assert!(vector.flags.iter().any(shows), "{}", vector.id);
        seen += 1;
    }
    assert!(seen > 50, "{seen}");
}

#[test]
fn vectors_are_as_many_as_their_page_says() {
    let page = fs::read_to_string(folder().join("README.md")).unwrap();
    let [thousands, rest] = [vectors().len() / 1000, vectors().len() % 1000];
    let files = names().len();
    let count = format!("{thousands},{rest:03} vectors in {files} files");
    assert!(page.contains(&count), "the page does not say {count}");
}

#[test]
fn vectors_of_wires_belong_together() {
    let all = vectors();
    let segments: Vec<_> = all.iter().filter(|vector| vector.wire.is_some()).collect();
    assert!(segments.len() >= 20);
    for vector in &segments {
        let wire = vector.wire.as_ref().unwrap();
        let others = segments
            .iter()
            .filter(|other| other.wire.as_ref().unwrap().id == wire.id);
        let others: Vec<_> = others.collect();
        assert_eq!(others.len(), 2, "{}", vector.id);
        assert!(others.iter().any(|other| other.result.hit), "{}", vector.id);
        let [first, second] = others[..] else {
            panic!()
        };
        let at = |vector: &Vector, index: usize| vector.points[index];
        for time in [0, 4] {
            assert_eq!(at(first, time + 1), at(second, time), "{}", vector.id);
            assert_eq!(
                first.points[time + 2..time + 4],
                second.points[time + 2..time + 4]
            );
        }
    }
}

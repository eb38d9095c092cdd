//! The test vectors of bodies that turn, read back from the JSON alone: the schema holds, a second judge
//! and exact arithmetic of this file's own say the same, and the certified path answers every one of
//! them.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[allow(dead_code, reason = "the other vectors need more of it")]
mod vector_files;

use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::fs;

use num_rational::BigRational;
use num_traits::{One, Zero};
use rayon::prelude::*;
use serde_json::{Value, json};
use tunnelproof::rigid::RigidQuery;
use tunnelproof_reference::answer::ExactAnswer;
use tunnelproof_reference::certify::verdict::judge;
use tunnelproof_reference::corpus::turning;
use tunnelproof_reference::registry::turning_subjects;
use tunnelproof_reference::report::answer::{Fields, turning_line};
use tunnelproof_reference::{difference, field};

use vector_files::rational::{self, Vector3, number};
use vector_files::reader::folder;
use vector_files::says;

fn documents() -> Vec<(String, Value)> {
    let mut documents = Vec::new();
    for entry in fs::read_dir(folder().join("turning")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if name != "schema.json" {
            let text = fs::read_to_string(path).unwrap();
            documents.push((name, serde_json::from_str(&text).unwrap()));
        }
    }
    documents
}

fn vectors() -> Vec<Value> {
    let documents = documents().into_iter();
    let vectors = documents.map(|(_, document)| document["vectors"].as_array().unwrap().clone());
    vectors.flatten().collect()
}

#[test]
fn turning_vectors_fulfil_the_schema() {
    let text = fs::read_to_string(folder().join("turning/schema.json")).unwrap();
    let schema = jsonschema::validator_for(&serde_json::from_str(&text).unwrap()).unwrap();
    let documents = documents();
    assert!(documents.len() >= 26);
    for (name, document) in &documents {
        let first = schema.iter_errors(document).next();
        let first = first.map(|error| format!("{}: {error}", error.instance_path()));
        assert_eq!(first, None, "{name}");
        let count = document["vectors"].as_array().unwrap().len();
        assert_eq!(document["number_of_vectors"], count, "{name}");
    }
    for (pointer, wrong) in [
        ("/vectors/0/poses/0", json!([0, 0, 0])),
        ("/vectors/0/local", json!([[0, 0, 0]])),
        ("/vectors/0/kind", json!("edge-edge")),
        ("/vectors/0/result/hit", json!("yes")),
    ] {
        let mut document = documents[0].1.clone();
        *document.pointer_mut(pointer).unwrap() = wrong;
        assert!(!schema.is_valid(&document), "{pointer}");
    }
}

/// The query of a vector, of the fields with this ending.
fn query(vector: &Value, suffix: &str) -> Result<RigidQuery, String> {
    let field = |name: &str| {
        let value = vector.get(format!("{name}{suffix}"))?;
        Some((name.to_owned(), value.clone()))
    };
    let fields = ["points", "local", "poses", "radius"].into_iter();
    let mut query: serde_json::Map<String, Value> = fields.filter_map(field).collect();
    query.insert("kind".to_owned(), vector["kind"].clone());
    let entry = turning::parse(&Value::Object(query).to_string());
    entry
        .map(|entry| entry.query)
        .map_err(|error| error.to_string())
}

/// What is wrong with a vector.
fn check(vector: &Value) -> Result<(), String> {
    let query_of = |suffix| query(vector, suffix);
    let (query, in_hex) = (query_of("")?, query_of("_hex")?);
    says("decimals and hexadecimals", query == in_hex)?;
    let truth = difference::decide_rigid::<field::Default>(&query);
    let result = serde_json::to_value(Fields::exact(&truth)).unwrap();
    says("the second judge", result == vector["result"])?;
    check_distances(vector, &truth)?;
    check_fraction(vector)
}

/// The distance compared with the radius at a time.
fn distance(vector: &Value, time: &BigRational) -> Ordering {
    let parts = vector["radius"].as_array().cloned();
    let parts = parts.unwrap_or_else(|| vec![vector["radius"].clone()]);
    let radius = parts.iter().map(|part| number(part.as_f64().unwrap()));
    let radius: BigRational = radius.sum();
    let square = rational::distance_squared(is_of_edges(vector), &positions(vector, time));
    square.cmp(&(&radius * &radius))
}

/// At a fraction the distance is the radius.
fn check_fraction(vector: &Value) -> Result<(), String> {
    let Ok(fraction) = serde_json::from_value(vector["fraction"].clone()) else {
        return Ok(());
    };
    let time = rational::fraction(&fraction).ok_or("no fraction in lowest terms")?;
    let distance = distance(vector, &time);
    let touches = distance.is_eq() || time.is_zero() && distance.is_lt();
    says("contact at the fraction", touches)
}

/// Before the contact, and in all of a step without one, the distance is larger than the radius.
fn check_distances(vector: &Value, truth: &ExactAnswer) -> Result<(), String> {
    let (end, parts) = match &truth.hit {
        Some(hit) => (number(hit.toi.below), 9),
        None => (BigRational::one(), 33),
    };
    let is_end_open = truth.hit.is_some();
    let last = if is_end_open { parts - 1 } else { parts };
    let is_apart = (0..=last).all(|part| {
        let time = &end * BigRational::new(part.into(), parts.into());
        distance(vector, &time).is_gt() || is_end_open && end.is_zero()
    });
    says("apart before the contact", is_apart)
}

/// The four points at a time.
fn positions(vector: &Value, time: &BigRational) -> [Vector3; 4] {
    let rest = BigRational::one() - time;
    let row = |row: &Value| -> Vec<BigRational> {
        let numbers = row.as_array().unwrap().iter();
        numbers.map(|x| number(x.as_f64().unwrap())).collect()
    };
    let rows = |name: &str| -> Vec<Vec<BigRational>> {
        vector[name].as_array().unwrap().iter().map(row).collect()
    };
    let mean = |a: &[BigRational], b: &[BigRational]| -> Vec<BigRational> {
        a.iter().zip(b).map(|(a, b)| &rest * a + time * b).collect()
    };
    let poses = rows("poses");
    let pose = |pair: &[Vec<BigRational>]| {
        let (first, mut last) = (&pair[0], pair[1].clone());
        let along: BigRational = (3..7).map(|i| &first[i] * &last[i]).sum();
        if along < BigRational::zero() {
            last[3..].iter_mut().for_each(|x| *x = -x.clone());
        }
        mean(first, &last)
    };
    let poses: Vec<Vec<BigRational>> = poses.chunks(2).map(pose).collect();
    let local = rows("local");
    let all: Vec<Vector3> = if let [of_first, of_second] = &poses[..] {
        let first = if is_of_edges(vector) { 2 } else { 1 };
        let (first, second) = local.split_at(first);
        let first = first.iter().map(|x| turned(of_first, x));
        first
            .chain(second.iter().map(|x| turned(of_second, x)))
            .collect()
    } else {
        let points = rows("points");
        let (start, end) = points.split_at(points.len() / 2);
        let in_space = start.iter().zip(end).map(|(a, b)| mean(a, b));
        let body = local.iter().map(|x| turned(&poses[0], x));
        in_space
            .map(|p| p.try_into().unwrap())
            .chain(body)
            .collect()
    };
    all.try_into().unwrap()
}

fn is_of_edges(vector: &Value) -> bool {
    vector["kind"].as_str().unwrap().ends_with("edge")
}

/// `c + q x q* / |q|^2`.
fn turned(pose: &[BigRational], x: &[BigRational]) -> Vector3 {
    let times = |a: [BigRational; 4], b: [BigRational; 4]| {
        let [a0, a1, a2, a3] = &a;
        let [b0, b1, b2, b3] = &b;
        [
            a0 * b0 - a1 * b1 - a2 * b2 - a3 * b3,
            a0 * b1 + a1 * b0 + a2 * b3 - a3 * b2,
            a0 * b2 - a1 * b3 + a2 * b0 + a3 * b1,
            a0 * b3 + a1 * b2 - a2 * b1 + a3 * b0,
        ]
    };
    let q = [3, 4, 5, 6].map(|i: usize| pose[i].clone());
    let conjugate = [q[0].clone(), -&q[1], -&q[2], -&q[3]];
    let size: BigRational = q.iter().map(|x| x * x).sum();
    let x = [
        BigRational::zero(),
        x[0].clone(),
        x[1].clone(),
        x[2].clone(),
    ];
    let turned = times(times(q, x), conjugate);
    [0, 1, 2].map(|i| &pose[i] + &turned[i + 1] / &size)
}

#[test]
fn turning_vectors_agree_with_the_second_judge_and_with_rational_arithmetic() {
    let vectors = vectors();
    assert!(vectors.len() > 300, "{}", vectors.len());
    vectors.par_iter().for_each(|vector| {
        assert_eq!(check(vector), Ok(()), "{}", vector["id"]);
    });
}

#[test]
fn turning_vectors_are_answered_by_the_certified_path() {
    let certified = turning_subjects().into_iter();
    let certified = certified.filter(|subject| subject.name() == "certified");
    let [certified] = <[_; 1]>::try_from(certified.collect::<Vec<_>>())
        .ok()
        .unwrap();
    for vector in vectors() {
        let query = query(&vector, "").unwrap();
        let answer = certified.turning_answer(&query).unwrap();
        let truth = difference::decide_rigid::<field::Default>(&query);
        assert!(
            !judge(&truth, Some(&answer), || false).differs,
            "{}",
            vector["id"]
        );
        let line = turning_line("", &answer);
        let said: Value = serde_json::from_str(&line).unwrap();
        for field in ["hit", "toi", "kind_of_contact", "side"] {
            assert_eq!(
                said.get(field),
                vector["result"].get(field),
                "{}",
                vector["id"]
            );
        }
    }
}

#[test]
fn turning_vectors_have_ids_that_are_unique_and_are_as_many_as_the_page_says() {
    let vectors = vectors();
    let ids: BTreeSet<_> = vectors
        .iter()
        .map(|vector| vector["id"].as_str().unwrap())
        .collect();
    assert_eq!(ids.len(), vectors.len());
    let page = fs::read_to_string(folder().join("README.md")).unwrap();
    let (thousands, rest) = (vectors.len() / 1000, vectors.len() % 1000);
    let count = format!("and {thousands},{rest:03} of [bodies that turn]");
    assert!(page.contains(&count), "the page does not say {count}");
}

#[test]
fn turning_vectors_that_are_changed_are_found_wrong() {
    let vectors = vectors();
    let is_hit = |vector: &&Value| {
        let below = vector["result"]["toi"]["below"].as_f64();
        below.is_some_and(|t| t > 0.0) && vector["fraction"].is_array()
    };
    let vector = vectors.iter().find(is_hit).unwrap();
    for (pointer, wrong) in [
        ("/result/toi/below", json!(0.0)),
        ("/result/side", json!(2)),
        ("/poses/0/0", json!(7.5)),
        ("/local_hex/0/0", json!("0x1.8p+7")),
        ("/fraction/1", json!("1023")),
    ] {
        let mut changed = vector.clone();
        *changed.pointer_mut(pointer).unwrap() = wrong;
        assert!(check(&changed).is_err(), "{pointer}");
    }
}

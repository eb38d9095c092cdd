//! Shared libraries as subjects: the C header, compiled, and a library in C, judged.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use crate::run::{stderr, tunnelproof};

const INCLUDE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../include");

/// Misses everything, talks, and does something else on chosen queries: by x of A at the start,
/// which `lattice` has small integers for.
const MUTE: &str = r#"
#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include "tunnelproof_subject.h"

int tunnelproof_edge_edge(const double points[24], const double radius[2], double *toi) {
    printf("talks\n");
    fflush(stdout);
    if (radius[0] + radius[1] > 0) return TUNNELPROOF_UNSUPPORTED;
    if (points[0] == 1.0) abort();
    if (points[0] == 2.0) { *toi = NAN; return TUNNELPROOF_HIT; }
    if (points[0] == -1.0) return 7;
    return TUNNELPROOF_MISS;
}
"#;

/// Repeats what it is asked: the time of impact is the sum of all numbers, weighted, so that each
/// is seen in its place.
const ECHO: &str = r#"
#include "tunnelproof_subject.h"

static int weigh(const double *points, const double *radius, double *toi) {
    double sum = radius[0] + 2 * radius[1];
    for (int i = 0; i < 24; ++i) sum += (i + 3) * points[i];
    *toi = sum;
    return TUNNELPROOF_HIT;
}
int tunnelproof_edge_edge(const double points[24], const double radius[2], double *toi) {
    return weigh(points, radius, toi);
}
int tunnelproof_vertex_face(const double points[24], const double radius[2], double *toi) {
    weigh(points, radius, toi);
    *toi = -*toi;
    return TUNNELPROOF_HIT;
}

/* Lists of these lengths. */
static int weigh_lists(const double *const lists[], const int lengths[], int count, double sign, double *toi) {
    double sum = 0, weight = 1;
    for (int list = 0; list < count; ++list)
        for (int i = 0; i < lengths[list]; ++i) sum += weight++ * lists[list][i];
    *toi = sign * sum;
    return TUNNELPROOF_HIT;
}
int tunnelproof_edge_turning_edge(const double points[12], const double local[6], const double poses[14],
                                  const double radius[2], double *toi) {
    const double *const lists[] = {radius, points, local, poses};
    const int lengths[] = {2, 12, 6, 14};
    return weigh_lists(lists, lengths, 4, 1, toi);
}
int tunnelproof_vertex_turning_face(const double points[6], const double local[9], const double poses[14],
                                    const double radius[2], double *toi) {
    const double *const lists[] = {radius, points, local, poses};
    const int lengths[] = {2, 6, 9, 14};
    return weigh_lists(lists, lengths, 4, -1, toi);
}
int tunnelproof_turning_edge_turning_edge(const double local[12], const double poses[28], const double radius[2],
                                          double *toi) {
    const double *const lists[] = {radius, local, poses};
    const int lengths[] = {2, 12, 28};
    return weigh_lists(lists, lengths, 3, 2, toi);
}
int tunnelproof_turning_vertex_turning_face(const double local[12], const double poses[28], const double radius[2],
                                            double *toi) {
    const double *const lists[] = {radius, local, poses};
    const int lengths[] = {2, 12, 28};
    return weigh_lists(lists, lengths, 3, -2, toi);
}
"#;

/// A library of this source in a folder; the header has to compile without a warning.
pub(crate) fn library(folder: &Path, name: &str, source: &str) -> String {
    let code = folder.join(format!("{name}.c"));
    let library = folder.join(format!("lib{name}.so"));
    fs::write(&code, source).unwrap();
    let flags = [
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Wpedantic",
        "-Werror",
        "-O1",
    ];
    let compiled = Command::new("cc")
        .args(flags)
        .args([
            "-shared",
            "-fPIC",
            "-fvisibility=hidden",
            "-I",
            INCLUDE,
            "-o",
        ])
        .args([&library, &code])
        .output()
        .unwrap();
    assert!(compiled.status.success(), "{}", stderr(&compiled));
    library.to_str().unwrap().to_owned()
}

/// The result of judging a library on 400 queries of a family.
fn certified(folder: &Path, library: &str, family: &str) -> Value {
    let json = folder.join("result.json");
    let output = tunnelproof(&[
        "certify",
        "--subject",
        &format!("lib:{library}"),
        "--family",
        family,
        "--count",
        "400",
        "--json",
        json.to_str().unwrap(),
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    serde_json::from_str(&fs::read_to_string(json).unwrap()).unwrap()
}

/// How many of these queries of `lattice` have their first coordinate at this value.
fn starting_at(x: f64) -> u64 {
    let family = tunnelproof_reference::generate::by_name("lattice").unwrap();
    let queries = (0..400).map(|index| family.query(1, index));
    queries.filter(|query| query.start()[0].x == x).count() as u64
}

#[test]
fn library_that_crashes_and_lies_is_judged_to_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let library = library(folder.path(), "mute", MUTE);
    let result = certified(folder.path(), &library, "lattice");
    let total = &result["total"];
    let subject = &total["subjects"][0];
    let lapses = &subject["lapses"];
    assert!(starting_at(1.0) > 10 && starting_at(2.0) > 10 && starting_at(-1.0) > 10);
    assert_eq!(lapses["crashed"], starting_at(1.0));
    assert_eq!(lapses["no time"], starting_at(2.0));
    assert_eq!(lapses["unreadable"], starting_at(-1.0));
    assert_eq!(lapses.as_object().unwrap().len(), 3, "{lapses}");
    assert_eq!(total["queries"], 400);
    assert_eq!(subject["faults"]["false hit"]["count"], 0);
    assert!(
        result["programs"][0]["stderr"]
            .as_str()
            .unwrap()
            .contains("talks\n")
    );
    // Faces, and what it refuses, it is not judged on.
    for family in ["face_uniform", "thick_uniform"] {
        let result = certified(folder.path(), &library, family);
        let subject = &result["total"]["subjects"][0];
        assert_eq!(subject["refused"][0]["queries"], 400, "{subject}");
        assert_eq!(subject["taken"].as_array().unwrap().len(), 0);
    }
}

#[test]
fn library_is_given_every_number_in_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let library = library(folder.path(), "echo", ECHO);
    for family in [
        "lattice",
        "face_lattice",
        "thick_lattice",
        "thick_face_lattice",
    ] {
        let queries = tunnelproof_reference::generate::by_name(family).unwrap();
        for index in 0..5 {
            let id = format!("{family}:1:{index}");
            let query = queries.query(1, index);
            let points = query.start().iter().chain(query.end());
            let coordinates = points.flat_map(|point| [point.x, point.y, point.z]);
            let [first, second] = query.radius().parts();
            let weighted = (3..).zip(coordinates).map(|(i, x)| f64::from(i) * x);
            let sum = weighted.fold(first + 2.0 * second, |sum, x| sum + x);
            let expected = if family.contains("face") { -sum } else { sum };
            let query = tunnelproof_reference::corpus::jsonl::write(
                &tunnelproof_reference::corpus::Entry::unlabelled(&id, query),
                tunnelproof_reference::corpus::jsonl::Numbers::Decimal,
            );
            let file = folder.path().join("query.jsonl");
            fs::write(&file, query).unwrap();
            let subject = format!("lib:{library}");
            let output = tunnelproof(&["eval", "--subject", &subject, file.to_str().unwrap()]);
            let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
            assert_eq!(answer["toi"]["below"].as_f64(), Some(expected), "{id}");
        }
    }
}

#[test]
fn library_is_given_every_number_of_bodies_that_turn() {
    use tunnelproof::rigid::RigidQueryKind;
    use tunnelproof_reference::corpus::jsonl::Numbers;
    use tunnelproof_reference::corpus::turning::{self, Fields, TurningEntry};

    let folder = tempfile::tempdir().unwrap();
    let library = library(folder.path(), "echo", ECHO);
    let mut kinds = Vec::new();
    for name in ["turning_thick_lattice", "turning_bodies_thick_lattice"] {
        let family = tunnelproof_reference::generate::rigid_by_name(name).unwrap();
        for query in (0..6).map(|index| family.query(1, index)) {
            let fields = Fields::of(&query);
            let radii = query.radius().parts();
            let points = fields.points.iter().chain(&fields.local).flatten();
            let numbers = radii.iter().chain(points);
            let numbers = numbers.chain(fields.poses.iter().flatten());
            let weighted = (1..).zip(numbers).map(|(i, x)| f64::from(i) * x);
            let sum = weighted.fold(0.0, |sum, x| sum + x);
            let sign = match query.kind() {
                RigidQueryKind::EdgeTurningEdge => 1.0,
                RigidQueryKind::VertexTurningFace => -1.0,
                RigidQueryKind::TurningEdgeTurningEdge => 2.0,
                RigidQueryKind::TurningVertexTurningFace => -2.0,
            };
            kinds.push(query.kind());
            let entry = TurningEntry {
                id: "a".to_owned(),
                query,
                label: None,
            };
            let file = folder.path().join("query.jsonl");
            fs::write(&file, turning::write(&entry, Numbers::Decimal)).unwrap();
            let subject = format!("lib:{library}");
            let file = file.to_str().unwrap();
            let output = tunnelproof(&["eval", "--turning", "--subject", &subject, file]);
            let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
            let toi = answer["toi"]["below"].as_f64();
            assert_eq!(toi, Some(sign * sum), "{entry:?}: {answer}");
        }
    }
    kinds.sort_unstable();
    kinds.dedup();
    assert_eq!(kinds, RigidQueryKind::ALL);
    // A library without these functions does not take such queries.
    let mute = self::library(folder.path(), "mute", MUTE);
    let result = certified(folder.path(), &mute, "turning_bodies_lattice");
    let subject = &result["total"]["subjects"][0];
    assert_eq!(subject["taken"].as_array().unwrap().len(), 0, "{subject}");
}

/// The example of docs/bring-your-own.md that takes edges against edges of bodies that turn, and
/// nothing else.
fn blades() -> String {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/bring-your-own.md");
    let page = fs::read_to_string(page).unwrap();
    let blocks = page.split("```c\n").skip(1);
    let mut blocks = blocks.map(|rest| rest.split("```").next().unwrap().to_owned());
    let is_it = |block: &String| block.contains("tunnelproof_edge_turning_edge(");
    blocks.find(is_it).unwrap()
}

#[test]
fn library_of_bodies_that_turn_alone_is_judged_on_these() {
    let folder = tempfile::tempdir().unwrap();
    let blades = library(folder.path(), "blades", &blades());
    let subject = format!("lib:{blades}");
    let result = folder.path().join("result.json");
    let json = result.to_str().unwrap();
    let words = ["certify", "--one-judge", "--count", "3", "--json", json];
    tunnelproof(&[&words[..], &["--subject", &subject]].concat());
    let result: Value = serde_json::from_str(&fs::read_to_string(result).unwrap()).unwrap();
    let sources = result["sources"].as_array().unwrap();
    let is_turning = |source: &Value| source["name"].as_str().unwrap().starts_with("turning_");
    assert!(sources.iter().all(is_turning), "{sources:?}");
    let subject = &result["total"]["subjects"][0];
    let taken: Vec<_> = subject["taken"].as_array().unwrap().iter().collect();
    assert!(!taken.is_empty(), "{subject}");
    assert!(
        taken.iter().all(|sort| sort["kind"] == "edge-turning-edge"),
        "{subject}"
    );
    // Its bodies are where those of the queries are: only what happens between two times is missed.
    let seen = certified(folder.path(), &blades, "turning_uniform");
    let seen = &seen["total"]["subjects"][0];
    assert!(seen["hits"].as_u64().unwrap() > 30, "{seen}");
    assert_eq!(seen["faults"]["tunnel"]["count"], 0, "{seen}");
}

#[test]
fn library_that_cannot_answer_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let none = library(
        folder.path(),
        "none",
        "int nothing(void);\nint nothing(void) { return 0; }\n",
    );
    for (path, what) in [
        (
            none.as_str(),
            "has neither tunnelproof_edge_edge nor tunnelproof_vertex_face",
        ),
        ("./no-such-library.so", "cannot be loaded: "),
    ] {
        let output = tunnelproof(&[
            "certify",
            "--count",
            "5",
            "--subject",
            &format!("lib:{path}"),
        ]);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(
            message.starts_with(&format!("lib:{path}: {what}")),
            "{message}"
        );
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}

//! Casts of boxes: a library in C, judged, and the numbers of one cast.

use serde_json::Value;
use tunnelproof_reference::boxes::{Shape, box_family};

use crate::lib_subject::library;
use crate::run::{stderr, stdout, tunnelproof};

/// Misses every cast, but for segments, which it does not take.
const MUTE: &str = r#"
#include "tunnelproof_subject.h"

int tunnelproof_box_cast(const int shapes[2], const double bodies[30], const double radius[2], double *toi) {
    (void)bodies;
    (void)toi;
    for (int i = 0; i < 2; ++i)
        if (shapes[i] == TUNNELPROOF_SEGMENT && radius[i] == 0) return TUNNELPROOF_UNSUPPORTED;
    return TUNNELPROOF_MISS;
}
"#;

/// Repeats what it is asked: a hit at a time that is a sum of all numbers, weighted.
const ECHO: &str = r#"
#include "tunnelproof_subject.h"

int tunnelproof_box_cast(const int shapes[2], const double bodies[30], const double radius[2], double *toi) {
    double sum = radius[0] + 2 * radius[1] + 3 * shapes[0] + 4 * shapes[1];
    for (int i = 0; i < 30; ++i) sum += (i + 5) * bodies[i];
    *toi = 0.5 + sum / (1 << 20);
    return TUNNELPROOF_HIT;
}
"#;

fn judge(library: &str, family: &str, count: u64) -> Value {
    let count = count.to_string();
    let subject = format!("lib:{library}");
    let words = [
        "certify-boxes",
        "--json",
        "-",
        "--subject",
        &subject,
        "--family",
        family,
    ];
    let output = tunnelproof(&[&words[..], &["--count", &count]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    serde_json::from_str(&stdout(&output)).unwrap()
}

#[test]
fn certify_boxes_counts_what_a_library_misses_and_does_not_take() {
    let folder = tempfile::tempdir().unwrap();
    let library = library(folder.path(), "mute", MUTE);
    let result = judge(&library, "cast_box_lattice", 100);
    let source = &result["sources"][0];
    let subject = &source["subjects"][0];
    let count = |fault: &str| subject["faults"][fault]["count"].as_u64().unwrap();
    assert_eq!(source["queries"], 100);
    let missed = count("tunnel") + count("missed graze");
    assert_eq!(missed, source["hits"].as_u64().unwrap());
    assert_eq!(count("tunnel"), source["crossings"].as_u64().unwrap());
    assert!(count("missed graze") > 0 && count("false hit") == 0);

    let subject = format!("lib:{library}");
    let words = [
        "certify-boxes",
        "--strict",
        "--subject",
        &subject,
        "--count",
        "20",
    ];
    let families = ["--family", "cast_box_lattice,cast_box_round_lattice"];
    let output = tunnelproof(&[&words[..], &families[..]].concat());
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let text = stdout(&output);
    for part in [" fails: ", " tunnels, ", " missed grazes\n", "\nall  "] {
        assert!(text.contains(part), "{text}");
    }
    assert!(text.contains("explain cast_box_"), "{text}");

    let thin = judge(&library, "cast_box_thin_lattice", 100);
    assert_eq!(
        thin["sources"][0]["subjects"][0]["refused"][0]["queries"],
        100
    );
}

/// Each number arrives in its place: small integers and halves, so that the sum is exact.
/// Does not take what has a negative coordinate first, and misses the rest.
const CHOOSY: &str = r#"
#include "tunnelproof_subject.h"

int tunnelproof_box_cast(const int shapes[2], const double bodies[30], const double radius[2], double *toi) {
    (void)shapes, (void)radius, (void)toi;
    return bodies[0] < 0 ? TUNNELPROOF_UNSUPPORTED : TUNNELPROOF_MISS;
}
"#;

#[test]
fn certify_boxes_fails_a_library_that_chooses_among_casts_of_a_sort() {
    let folder = tempfile::tempdir().unwrap();
    for (code, is_choosy) in [(CHOOSY, true), (MUTE, false)] {
        let library = library(
            folder.path(),
            if is_choosy { "choosy" } else { "mute" },
            code,
        );
        let subject = format!("lib:{library}");
        let words = ["certify-boxes", "--count", "40", "--subject", &subject];
        let output = tunnelproof(&[&words[..], &["--family", "cast_box_lattice"]].concat());
        let text = stdout(&output);
        assert_eq!(
            text.contains("refused of a sort that it takes"),
            is_choosy,
            "{text}"
        );
    }
}

#[test]
fn certify_boxes_sends_every_number() {
    let folder = tempfile::tempdir().unwrap();
    let library = library(folder.path(), "echo", ECHO);
    let result = judge(&library, "cast_box_round_lattice", 1);
    let cast = box_family("cast_box_round_lattice").unwrap().cast(1, 0);
    let mut sum = 0.0;
    let mut weight = 5.0;
    for (i, body) in cast.bodies().iter().enumerate() {
        let shape = Shape::ALL.iter().position(|shape| *shape == body.shape());
        sum += (i as f64 + 1.0) * body.radius() + (i as f64 + 3.0) * shape.unwrap() as f64;
        let points = body.points().map(<[f64; 3]>::from);
        let step: [f64; 3] = body.step().into();
        for number in points.into_iter().chain([step]).flatten() {
            sum += weight * number;
            weight += 1.0;
        }
    }
    let faults = &result["sources"][0]["subjects"][0]["faults"];
    let expected = 0.5 + sum / f64::from(1 << 20);
    let said = |fault: &str| faults[fault]["worst"]["answer"]["toi"].as_f64();
    let said = ["late", "early", "false hit"]
        .iter()
        .find_map(|fault| said(fault));
    assert_eq!(said, Some(expected));
}

#[test]
fn casts_of_boxes_are_asked_in_bytes_of_programs_alone() {
    let lines = tunnelproof(&["certify-boxes", "--subject", "cmd:cat"]);
    assert_eq!(lines.status.code(), Some(2));
    assert!(
        stderr(&lines).contains("pass --wire binary"),
        "{}",
        stderr(&lines)
    );
    let known = tunnelproof(&["certify-boxes", "--subject", "certified"]);
    assert_eq!(known.status.code(), Some(2));
    assert!(
        stderr(&known).contains("takes no casts of boxes"),
        "{}",
        stderr(&known)
    );
}

#[test]
fn explain_says_what_happens_in_a_cast_of_a_box() {
    let output = tunnelproof(&["explain", "cast_box_lattice:1:3"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(
        text.contains("\"kind\": \"box-cast\"") && text.contains("contact"),
        "{text}"
    );
    let wrong = tunnelproof(&["explain", "cast_box_lattice:1:x"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(
        stderr(&wrong).contains("the index is not an integer"),
        "{}",
        stderr(&wrong)
    );
}

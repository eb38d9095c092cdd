//! `explain` and `gap`.

use std::fs;

use crate::run::{
    CROSSING, MISS, assert_refused, code, file, stderr, stdout, tunnelproof, with_input,
};

#[test]
fn explain_says_the_time_of_impact_exactly() {
    let text = stdout(&tunnelproof(&["explain", "figure:4.8"]));
    assert!(text.contains("exactly   3/5"), "{text}");
    assert!(text.contains("decimals  0.6\n"), "{text}");
    let text = stdout(&with_input(&["explain", "-"], CROSSING));
    assert!(text.contains("exactly   1/3"), "{text}");
    assert!(text.contains("0.33333333333333333333..."), "{text}");
    let (_folder, path) = file("queries.jsonl", format!("{MISS}\n{CROSSING}\n"));
    let from_file = stdout(&tunnelproof(&["explain", &format!("{path}#a")]));
    assert_eq!(from_file, text);
}

#[test]
fn explain_writes_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.svg");
    let output = tunnelproof(&["explain", "lattice:1:4711", "--svg", path.to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let svg = fs::read_to_string(path).unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    assert!(document.root_element().has_tag_name("svg"));
}

#[test]
fn explain_names_that_are_wrong_are_refused() {
    for (name, what) in [
        ("knot:1:2", "no such family"),
        ("figure:9.9", "there are 4.1 to 4.12"),
        ("lattice:1:x", "index"),
        ("nothing", "figure:NAME"),
    ] {
        assert_refused(&tunnelproof(&["explain", name]), name, None, what);
    }
    assert_refused(
        &with_input(&["explain", "-"], ""),
        "<stdin>",
        None,
        "holds no query",
    );
}

#[test]
fn gap_is_the_least_distance_beyond_the_radius() {
    let gap = |arguments: &[&str]| -> [f64; 2] {
        let output = tunnelproof(&[&["gap", "figure:4.7"], arguments].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let text = stdout(&output);
        let numbers = text
            .split_whitespace()
            .map(|number| number.parse().unwrap());
        numbers.collect::<Vec<_>>().try_into().unwrap()
    };
    let is_enclosed = |[below, above]: [f64; 2], value: f64, width: f64| {
        below <= value && value <= above && above - below <= width
    };
    assert!(is_enclosed(gap(&[]), 1.0 / 64.0, 1e-9));
    assert!(is_enclosed(gap(&["--width", "1e-15"]), 1.0 / 64.0, 1e-15));
    let thick = ["--radius", "0.0078125+0.00390625"];
    assert!(is_enclosed(gap(&thick), 1.0 / 256.0, 1e-9));
    assert_eq!(gap(&["--radius", "0.015625"]), [0.0, 0.0]);
    for width in ["-1", "nan", "x"] {
        let refused = tunnelproof(&["gap", "figure:4.7", &format!("--width={width}")]);
        assert_eq!(code(&refused), 2);
        assert!(stderr(&refused).contains("--width"), "{}", stderr(&refused));
    }
}

#[test]
fn options_that_a_query_is_not_read_by_are_refused() {
    for (words, problem) in [
        (
            &["gap", "--radius", "0.5", "turning_uniform:1:0"][..],
            "is a query of bodies that turn, which --radius is not for",
        ),
        (
            &["explain", "--kind", "edge-edge", "turning_uniform:1:0"],
            "is a query of bodies that turn, which --kind is not for",
        ),
        (
            &["explain", "--radius", "1", "cast_box_uniform:1:1"],
            "is a cast of a box, which --radius is not for",
        ),
        (
            &["gap", "--turning", "uniform:1:0"],
            "is a query of linear motion, which is read without --turning",
        ),
        (
            &["gap", "--turning", "queries.jsonl"],
            "is neither PATH#ID nor FAMILY:SEED:INDEX of a query of bodies that turn",
        ),
    ] {
        let refused = tunnelproof(words);
        assert_eq!(refused.status.code(), Some(2), "{words:?}");
        let said = stderr(&refused);
        let expected = format!("{}: {problem}", words.last().unwrap());
        assert_eq!(said.trim_end(), expected, "{words:?}");
    }
}

//! `advance`: the steps it prints and what it refuses.

use crate::run::{
    CROSSING, MISS, ORIGIN, assert_refused, code, file, lines, stderr, stdout, tunnelproof,
    with_input,
};

#[test]
fn advance_prints_a_line_for_each_query_in_order() {
    let output = with_input(&["advance", "-"], &format!("{CROSSING}\n{MISS}\n"));
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let [crossing, miss] = &lines(&output)[..] else {
        panic!("two lines: {}", stdout(&output))
    };
    assert_eq!(
        (&crossing["id"], &crossing["blocked"]),
        (&"a".into(), &"ahead".into())
    );
    let step = crossing["step"].as_f64().unwrap();
    assert!(step < 1.0 / 3.0 && step > 0.333, "{step}");
    assert_eq!(crossing["kept"], 0.0);
    // The numbers are those that the engine stores, to the last bit.
    let z = crossing["points"][2][2].as_f64().unwrap();
    assert!(z > 0.0 && z == 1.0 + -3.0 * step, "{z}");
    let whole = r#"{"id":"b","step":1.0,"points":[[0.0,0.0,0.0],[1.0,0.0,0.0],[0.0,0.0,1.0],[1.0,0.0,1.0]],"kept":0.0,"blocked":null}"#;
    assert_eq!(stdout(&output).lines().nth(1), Some(whole));
    assert_eq!(miss["step"], 1.0);
}

#[test]
fn advance_keeps_a_clearance_or_a_share() {
    let kept = |option: &str, value: &str| {
        let output = with_input(&["advance", option, value, "-"], CROSSING);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let line = lines(&output).remove(0);
        let z = line["points"][2][2].as_f64().unwrap();
        let kept = line["kept"].as_f64().unwrap();
        assert!(z > kept, "{z} {kept}");
        kept
    };
    assert_eq!(kept("--clearance", "0.25"), 0.25);
    // About: the distance at the start is about 1.
    assert!((kept("--share", "0.5") - 0.5).abs() < 1e-9);
    let thick = ["advance", "--radius", "0.1+0.2", "--clearance", "0.25", "-"];
    let line = lines(&with_input(&thick, CROSSING)).remove(0);
    assert!((line["kept"].as_f64().unwrap() - 0.55).abs() < 1e-9);
}

#[test]
fn advance_stores_f32_where_that_is_asked() {
    let z = |options: &[&str]| {
        let output = with_input(&[&["advance"], options, &["-"]].concat(), CROSSING);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        lines(&output).remove(0)["points"][2][2].as_f64().unwrap()
    };
    let is_single = |x: f64| f64::from(x as f32) == x;
    let [double, single] = [z(&[]), z(&["--precision", "f32"])];
    assert!(is_single(single) && single > double);
    assert!(single < 1e-5, "{single}");
    let refused = with_input(&["advance", "--precision", "f16", "-"], CROSSING);
    assert_eq!(code(&refused), 2);
}

#[test]
fn advance_of_what_touches_keeps_nothing() {
    let points = [ORIGIN; 8].join(",");
    let touching = format!(r#"{{"id":"t","kind":"vertex-face","points":[{points}]}}"#);
    let line = lines(&with_input(&["advance", "-"], &touching)).remove(0);
    assert_eq!(
        (&line["step"], &line["blocked"]),
        (&0.0.into(), &"touching".into())
    );
    assert!(line["kept"].is_null());
}

#[test]
fn advance_takes_files_and_identifiers() {
    let (_folder, path) = file("queries.jsonl", format!("{CROSSING}\n{MISS}\n"));
    let second = format!("{path}#b");
    let output = tunnelproof(&["advance", &path, &second, "figure:4.3", "lattice:1:7"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let lines = lines(&output);
    let ids: Vec<_> = lines
        .iter()
        .map(|line| line["id"].as_str().unwrap())
        .collect();
    assert_eq!(ids, ["a", "b", "b", "figure:4.3", "lattice:1:7"]);
}

#[test]
fn advance_refuses_bad_input() {
    let (_folder, path) = file("queries.jsonl", format!("{MISS}\n{{\n"));
    let output = tunnelproof(&["advance", &path]);
    assert_refused(&output, &path, Some(2), "EOF");
    assert_eq!(lines(&output).len(), 1, "what was answered before stands");
    let missing = "no/such.jsonl";
    assert_refused(
        &tunnelproof(&["advance", missing]),
        missing,
        None,
        "no such file",
    );
    assert_refused(
        &tunnelproof(&["advance", "a.txt"]),
        "a.txt",
        None,
        "not a query",
    );
    for options in [
        &["--clearance", "-1"][..],
        &["--clearance", "inf"],
        &["--share", "1"],
        &["--share", "nan"],
        &["--share", "0.5", "--clearance", "1"],
    ] {
        let output = with_input(&[&["advance"], options, &["-"]].concat(), MISS);
        assert_eq!(
            (code(&output), stdout(&output).as_str()),
            (2, ""),
            "{options:?}"
        );
    }
}

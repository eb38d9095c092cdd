//! `shrink` and `replay`.

use std::fs;

use crate::run::{
    MISS, assert_refused, code, file, lines, stderr, stdout, tunnelproof, with_input,
};

#[test]
fn shrink_prints_a_query_that_explain_and_shrink_read() {
    let shrink = ["shrink", "--subject", "thesis"];
    let output = tunnelproof(&["shrink", "--subject", "thesis", "lattice:1:12311"]);
    assert_eq!(code(&output), 0);
    let summary = stderr(&output);
    assert!(summary.starts_with("lattice:1:12311: false hit: 35 bits before, "));
    assert_eq!((summary.lines().count(), lines(&output).len()), (1, 1));
    let again = with_input(&shrink, &stdout(&output));
    assert_eq!(stdout(&again), stdout(&output));
    let explained = with_input(&["explain", "-"], &stdout(&output));
    assert_eq!(code(&explained), 0);
}

#[test]
fn shrink_takes_the_first_query_that_is_wrong_and_says_if_there_is_none() {
    let published = [
        "shrink",
        "--subject",
        "shadow-published",
        "--truth",
        "shadow",
    ];
    let wrong = stdout(&tunnelproof(&[
        "shrink",
        "--subject",
        "shadow-published",
        "figure:4.9",
    ]));
    let output = with_input(&published, &format!("{MISS}\n{wrong}"));
    assert_eq!((code(&output), lines(&output).len()), (0, 1));
    let output = with_input(&published, MISS);
    assert_eq!((code(&output), stdout(&output).as_str()), (1, ""));
    assert_eq!(
        stderr(&output),
        "-: shadow-published is right, there is nothing to shrink\n"
    );
    let output = tunnelproof(&["shrink", "--subject", "thesis", "lettuce:1:2"]);
    assert_refused(&output, "lettuce:1:2", None, "no such family");
    let radius = MISS.replace("\"points\"", "\"radius\":1,\"points\"");
    assert_refused(
        &with_input(&published, &radius),
        "b",
        None,
        "a radius above 0",
    );
}

#[test]
fn replay_takes_the_target_from_the_folder_and_shows_the_query() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("oracle_vs_shadow");
    fs::create_dir(&target).unwrap();
    let path = target.join("crash-1");
    fs::write(&path, [0, 2, 1, 9, 8, 7]).unwrap();
    let path = path.to_str().unwrap();
    let output = tunnelproof(&["replay", path]);
    assert_eq!(code(&output), 0);
    let text = stdout(&output);
    let (first, line) = text.split_once('\n').unwrap();
    assert_eq!(first, format!("{path}: oracle_vs_shadow finds nothing"));
    assert_eq!(code(&with_input(&["eval", "-"], line)), 0);
    let output = tunnelproof(&["replay", "--target", "parsers", path]);
    assert!(stdout(&output).ends_with(": parsers finds nothing\n"));
    fs::write(target.join("crash-2"), [0, 2, 1]).unwrap();
    let output = tunnelproof(&["replay", target.to_str().unwrap()]);
    assert_eq!(code(&output), 0);
    assert_eq!(
        stdout(&output)
            .matches(": oracle_vs_shadow finds nothing")
            .count(),
        2
    );
    let (_other, stray) = file("bytes", [1, 2, 3]);
    let output = tunnelproof(&["replay", &stray]);
    assert_refused(&output, &stray, None, "pass --target");
    let output = tunnelproof(&["replay", "--target", "poly", "no-such-file"]);
    assert_refused(&output, "no-such-file", None, "no such file");
}

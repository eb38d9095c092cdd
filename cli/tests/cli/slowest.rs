//! `slowest`.

use crate::run::{code, lines, stderr, stdout, tunnelproof, with_input};

#[test]
fn slowest_prints_queries_that_certify_reads_with_their_times() {
    let output = tunnelproof(&["slowest", "--seconds", "0.3", "--count", "3"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let ids = lines(&output).into_iter().map(|line| line["id"].clone());
    assert!(ids.eq(["slowest-1", "slowest-2", "slowest-3"]));
    let summary = stderr(&output);
    let said: Vec<_> = summary.lines().collect();
    assert_eq!(said.len(), 4, "{summary}");
    assert!(said[0].starts_with("certified: ") && said[0].ends_with(" queries tried"));
    for (line, place) in said[1..].iter().zip(1..) {
        assert!(line.starts_with(&format!("slowest-{place}: ")), "{line}");
        assert!(line.ends_with("s, right"), "{line}");
    }
    let certified = ["certify", "--strict", "--subject", "certified", "-"];
    let judged = with_input(&certified, &stdout(&output));
    assert_eq!(code(&judged), 0, "{}", stderr(&judged));
}

#[test]
fn slowest_writes_queries_times_and_verdicts_as_json() {
    let output = tunnelproof(&["slowest", "--seconds", "0.2", "--count", "2", "--json", "-"]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let found: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(found["subject"], "certified");
    assert!(found["tried"].as_u64().unwrap() >= 2);
    let slow = found["slowest"].as_array().unwrap();
    assert_eq!(slow.len(), 2);
    let seconds = |k: usize| slow[k]["seconds"].as_f64().unwrap();
    assert!(seconds(0) >= seconds(1) && seconds(1) > 0.0);
    for query in slow {
        assert_eq!(query["judged"], "right");
        let again = with_input(
            &["certify", "--strict", "--subject", "certified", "-"],
            &format!("{}\n", query["query"]),
        );
        assert_eq!(code(&again), 0, "{}", stderr(&again));
    }
}

#[test]
fn slowest_says_what_is_wrong_and_what_a_subject_does_not_take() {
    let published = [
        "slowest",
        "--subject",
        "shadow-published",
        "--seconds",
        "0.3",
    ];
    let output = tunnelproof(&[&published[..], &["--family", "point_on_line"]].concat());
    assert_eq!(code(&output), 0);
    assert!(
        !stderr(&output).contains("not judged"),
        "{}",
        stderr(&output)
    );
    let output = tunnelproof(&[&published[..], &["--family", "thick_uniform"]].concat());
    assert_eq!((code(&output), stdout(&output).as_str()), (1, ""));
    assert_eq!(
        stderr(&output),
        "shadow-published answers no query of these families\n"
    );
    let output = tunnelproof(&[
        "slowest",
        "--seconds",
        "0.1",
        "--count",
        "1",
        "--subject",
        "cmd:sh no-such-file.sh",
    ]);
    let said = stderr(&output);
    assert_eq!(code(&output), 1, "{said}");
    for what in [
        "cmd:sh no-such-file.sh answers no query: crashed: ended with exit status: ",
        "\ncmd:sh no-such-file.sh was started ",
        "\nThe end of its standard error:\n  | ",
        "no-such-file.sh",
    ] {
        assert!(said.contains(what), "{what}: {said}");
    }
    for [option, value] in [
        ["--seconds", "0"],
        ["--count", "0"],
        ["--permit", "late=1e-9"],
    ] {
        let output = tunnelproof(&["slowest", option, value]);
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).contains(option), "{}", stderr(&output));
    }
}

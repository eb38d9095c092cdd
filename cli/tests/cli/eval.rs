//! `eval`: what it answers and what it refuses.

use std::io::{BufRead, BufReader, Write};
use std::process::Stdio;

use crate::run::{
    CROSSING, MISS, ORIGIN, assert_refused, code, command, file, lines, stderr, stdout,
    tunnelproof, with_input,
};

#[test]
fn eval_bad_lines_are_refused_with_their_place() {
    let query = |more: &str, points: &str| {
        format!(r#"{{"id":"a","kind":"edge-edge"{more},"points":[{points}]}}"#)
    };
    let seven = [ORIGIN; 7].join(",");
    let eight = [ORIGIN; 8].join(",");
    for (content, what) in [
        ("{".to_owned(), "EOF"),
        (query("", &seven), "7 points, not 8"),
        (
            query("", &format!(r#"["nan",0,0],{seven}"#)),
            "x of point A at t = 0",
        ),
        (query("", &format!("[1e999,0,0],{seven}")), "out of range"),
        (query(r#","radius":-1"#, &eight), "radius is -1"),
        (
            query("", &eight).replace("edge-edge", "knot"),
            "kind is \"knot\"",
        ),
    ] {
        let content = format!("{MISS}\n{content}\n");
        let (_folder, path) = file("queries.jsonl", content);
        let output = tunnelproof(&["eval", &path]);
        assert_refused(&output, &path, Some(2), what);
        assert_eq!(lines(&output).len(), 1, "what was answered before stands");
    }
}

#[test]
fn eval_bad_rows_are_refused_with_their_place() {
    let row = "1,1,1,1,1,1,0\n";
    for (content, line, what) in [
        ("1,2,3\n".to_owned(), 1, "3 columns"),
        (row.to_owned(), 1, "ends after 1 of the 8 rows"),
        ("a,b,c,d,e,f,g\n".to_owned(), 1, "not an integer"),
        (format!("{}1,0,1,1,1,1,0\n", row.repeat(7)), 8, "x_den is 0"),
    ] {
        let (_folder, path) = file("edge-edge.csv", content);
        assert_refused(&tunnelproof(&["eval", &path]), &path, Some(line), what);
    }
}

#[test]
fn eval_files_that_are_none_are_refused() {
    let (_folder, path) = file("empty.jsonl", "");
    assert_refused(
        &tunnelproof(&["eval", &path]),
        &path,
        None,
        "holds no query",
    );
    let (_folder, path) = file("bytes.jsonl", b"\xff\xfe\x00");
    assert_refused(&tunnelproof(&["eval", &path]), &path, Some(1), "UTF-8");
    let (folder, path) = file("some.txt", CROSSING);
    assert_refused(&tunnelproof(&["eval", &path]), &path, None, ".jsonl");
    let path = folder.path().to_str().unwrap();
    assert_refused(
        &tunnelproof(&["eval", path]),
        path,
        None,
        "no file of queries",
    );
    let path = &format!("{path}/no.jsonl");
    assert_refused(&tunnelproof(&["eval", path]), path, None, "no such file");
}

#[test]
fn eval_unsupported_queries_are_refused_with_their_place() {
    let (_folder, path) = file(
        "vertex-face.jsonl",
        CROSSING.replace("edge-edge", "vertex-face"),
    );
    let output = tunnelproof(&["eval", "--subject", "thesis", &path]);
    let reason = "vertex-face queries are not supported";
    assert_refused(&output, &path, Some(1), reason);
    let (_folder, path) = file("a.jsonl", CROSSING);
    let thick = ["eval", "--subject", "shadow", "--radius", "0.5", &path];
    assert_refused(&tunnelproof(&thick), &path, Some(1), "radius");
    let output = tunnelproof(&["eval", "--kind", "vertex-face", &path]);
    assert_refused(&output, &path, Some(1), "edge-edge");
}

#[test]
fn eval_exact_answer_has_the_stated_fields() {
    let output = with_input(&["eval", "-"], &format!("{CROSSING}\n{MISS}\n"));
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let expected = r#"{"id":"a","hit":true,"toi":{"below":0.3333333333333333,"above":0.33333333333333337},"kind_of_contact":"crossing","crosses":true,"side":1,"case":"general","temporarily_parallel":false,"temporarily_point":false,"features":["AB","CD"],"u":{"below":0.5,"above":0.5},"v":{"below":0.5,"above":0.5}}
{"id":"b","hit":false,"case":"parallel"}
"#;
    assert_eq!(stdout(&output), expected);
}

#[test]
fn eval_engine_answer_has_points_and_relative_velocity() {
    let output = with_input(&["eval", "--subject", "thesis", "-"], CROSSING);
    let [answer] = &lines(&output)[..] else {
        panic!("one line: {}", stdout(&output))
    };
    assert_eq!(answer["toi"]["below"], answer["toi"]["above"]);
    assert_eq!(answer["u"]["below"], 0.5);
    assert_eq!(answer["points"].as_array().unwrap().len(), 1);
    assert_eq!(answer["relative_velocity"].as_array().unwrap().len(), 3);
    // The thesis path gives no normal.
    assert!(answer.get("normal").is_none());
    assert!(answer.get("kind_of_contact").is_none());
}

#[test]
fn eval_keeps_the_order_of_files_and_queries() {
    let all: String = (0..10_000)
        .map(|i| MISS.replace("\"b\"", &format!("\"{i}\"")) + "\n")
        .collect();
    let (_folder, path) = file("many.jsonl", all);
    let output = tunnelproof(&["eval", "--threads", "2", &path, &path]);
    let ids: Vec<_> = lines(&output)
        .iter()
        .map(|line| line["id"].to_string())
        .collect();
    let expected: Vec<_> = (0..20_000).map(|i| format!("\"{}\"", i % 10_000)).collect();
    assert_eq!(ids, expected);
}

#[test]
fn eval_answers_a_query_before_the_next_is_asked() {
    let mut child = command(&["eval", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let mut output = BufReader::new(child.stdout.take().unwrap());
    for query in [CROSSING, MISS] {
        writeln!(input, "{query}").unwrap();
        let mut line = String::new();
        output.read_line(&mut line).unwrap();
        assert!(line.ends_with("}\n"));
    }
    drop(input);
    assert!(child.wait().unwrap().success());
}

#[cfg(target_os = "linux")]
#[test]
fn eval_a_vertex_and_a_face_names_the_features_that_touch() {
    // A falls through the middle of BC, and, with a radius, touches before.
    let falls = r#"{"id": "f", "kind": "vertex-face", "points": [[1, 0, 1], [0, 0, 0], [2, 0, 0],
        [0, 2, 0], [1, 0, -3], [0, 0, 0], [2, 0, 0], [0, 2, 0]]}"#
        .replace('\n', " ");
    let output = with_input(&["eval", "-"], &falls);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let [answer] = &lines(&output)[..] else {
        panic!("one line: {}", stdout(&output))
    };
    assert_eq!(answer["toi"]["below"], 0.25);
    assert_eq!(answer["toi"]["above"], 0.25);
    assert_eq!(answer["kind_of_contact"], "graze");
    assert_eq!(answer["features"], serde_json::json!(["A", "BC"]));
    assert_eq!(
        (&answer["u"]["below"], &answer["v"]["above"]),
        (&0.5.into(), &0.0.into())
    );
    for subject in ["oracle", "difference"] {
        let thick = ["eval", "--subject", subject, "--radius", "0.25+0.25", "-"];
        let [answer] = &lines(&with_input(&thick, &falls))[..] else {
            panic!("one line for {subject}")
        };
        assert_eq!(answer["toi"]["below"], 0.125, "{subject}");
        assert_eq!(answer["features"][1], "BC", "{subject}");
    }
}

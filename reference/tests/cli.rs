//! The command line from outside: what it writes, and how it ends.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

const ORIGIN: &str = "[0,0,0]";

/// Two edges that cross at t = 1/3.
const CROSSING: &str = r#"{"id":"a","kind":"edge-edge","points":[[0,0,0],[1,0,0],[0.5,-1,1],[0.5,1,1],[0,0,0],[1,0,0],[0.5,-1,-2],["0x1p-1",1,-2]]}"#;
/// Two edges that keep apart.
const MISS: &str = r#"{"id":"b","kind":"edge-edge","points":[[0,0,0],[1,0,0],[0,0,1],[1,0,1],[0,0,0],[1,0,0],[0,0,1],[1,0,1]]}"#;

fn tunnelproof(arguments: &[&str]) -> Output {
    with_input(arguments, "")
}

fn with_input(arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_tunnelproof"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Whoever does not read the input may close it.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn lines(output: &Output) -> Vec<Value> {
    let text = stdout(output);
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

/// A file in a folder of its own.
fn file(name: &str, content: impl AsRef<[u8]>) -> (TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join(name);
    fs::write(&path, content).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

/// Ends with 2 and one line that starts with the path, a line number if there is one, and says
/// `what`.
fn assert_refused(output: &Output, path: &str, line: Option<u32>, what: &str) {
    let message = stderr(output);
    assert_eq!(code(output), 2, "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    let place = match line {
        Some(line) => format!("{path}:{line}: "),
        None => format!("{path}: "),
    };
    assert!(message.starts_with(&place), "{message} is not at {place}");
    assert!(message.contains(what), "{message} does not say {what}");
}

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
    assert_refused(&tunnelproof(&["eval", path]), path, None, "directory");
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
    let reason = "vertex-face queries are not supported yet";
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
fn eval_engine_answer_has_points_and_normal() {
    let output = with_input(&["eval", "--subject", "thesis", "-"], CROSSING);
    let [answer] = &lines(&output)[..] else {
        panic!("one line: {}", stdout(&output))
    };
    assert_eq!(answer["toi"]["below"], answer["toi"]["above"]);
    assert_eq!(answer["u"]["below"], 0.5);
    assert_eq!(answer["points"].as_array().unwrap().len(), 1);
    assert_eq!(answer["normal"].as_array().unwrap().len(), 3);
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
    use std::io::{BufRead, BufReader};
    let mut child = Command::new(env!("CARGO_BIN_EXE_tunnelproof"))
        .args(["eval", "-"])
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
fn output_that_cannot_be_written_is_reported() {
    for arguments in [
        &["eval", "-"][..],
        &["certify", "--count", "10"],
        &["explain", "figure:4.1"],
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_tunnelproof"))
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(full)
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let _ = child.stdin.take().unwrap().write_all(CROSSING.as_bytes());
        let output = child.wait_with_output().unwrap();
        assert_eq!(code(&output), 2);
        assert!(stderr(&output).starts_with("standard output: cannot be written: "));
        assert_eq!(stderr(&output).lines().count(), 1);
    }
}

#[cfg(unix)]
#[test]
fn output_that_nobody_reads_ends_quietly() {
    let all = format!("{MISS}\n").repeat(20_000);
    let (_folder, path) = file("many.jsonl", all);
    let mut child = Command::new(env!("CARGO_BIN_EXE_tunnelproof"))
        .args(["eval", &path])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
}

#[test]
fn names_that_are_unknown_are_answered_with_the_known_ones() {
    let output = tunnelproof(&["certify", "--subject", "nobody"]);
    assert_eq!(code(&output), 2);
    for name in ["oracle", "shadow", "shadow-published", "thesis"] {
        assert!(stderr(&output).contains(name));
    }
    let output = tunnelproof(&["certify", "--family", "none"]);
    assert_eq!(code(&output), 2);
    for name in ["uniform", "lattice"] {
        assert!(stderr(&output).contains(name));
    }
}

#[test]
fn help_and_version_are_there() {
    for command in [
        &["--help"][..],
        &["help", "eval"],
        &["certify", "--help"],
        &["explain", "-h"],
        &["shrink", "--help"],
        &["replay", "--help"],
        &["vectors", "--help"],
    ] {
        let output = tunnelproof(command);
        assert_eq!(code(&output), 0);
        assert!(stdout(&output).contains("Usage: tunnelproof"));
    }
    let output = tunnelproof(&["--version"]);
    assert_eq!(
        stdout(&output),
        format!("tunnelproof {}\n", env!("CARGO_PKG_VERSION"))
    );
    assert!(stderr(&tunnelproof(&[])).contains("Commands:"));
}

#[test]
fn certify_table_is_the_same_on_any_number_of_threads() {
    let table = |threads| {
        let output = tunnelproof(&[
            "certify",
            "--count",
            "250",
            "--seed",
            "9",
            "--threads",
            threads,
        ]);
        assert_eq!((code(&output), stderr(&output).as_str()), (0, ""));
        stdout(&output)
    };
    let one = table("1");
    assert_eq!(one, table("2"));
    assert_eq!(one, table("2"));
    assert!(
        one.contains("oracle and shadow agree on all 4,012 queries"),
        "{one}"
    );
    // But for the names of the witnesses.
    let mut lines = one
        .lines()
        .filter_map(|line| line.split(" explain ").next());
    assert!(lines.all(|line| line.chars().count() <= 100), "{one}");
}

#[test]
fn certify_strict_passes_the_exact_subjects_and_fails_the_published_text() {
    let certify = |subjects| {
        tunnelproof(&[
            "certify",
            "--strict",
            "--count",
            "2000",
            "--subject",
            subjects,
        ])
    };
    assert_eq!(code(&certify("oracle,shadow")), 0);
    let output = certify("oracle,shadow-published");
    assert_eq!(code(&output), 1);
    assert!(stderr(&output).starts_with("--strict: shadow-published: "));
    assert!(!stdout(&output).contains("unexplained"));
}

#[test]
fn certify_strict_fails_on_a_wrong_label() {
    let label = |label: &str| CROSSING.replace("\"id\"", &format!("\"label\":{label},\"id\""));
    for (text, expected) in [(label("1"), 0), (label("0"), 1)] {
        let (_folder, path) = file("labelled.jsonl", text);
        let output = tunnelproof(&["certify", "--strict", "--subject", "oracle", &path]);
        assert_eq!(code(&output), expected, "{}", stdout(&output));
    }
}

#[cfg(unix)]
#[test]
fn certify_witness_from_the_standard_input_comes_with_its_query() {
    let label = CROSSING.replace("\"id\"", "\"label\":0,\"id\"");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.json");
    let output = with_input(&["certify", "--json", path.to_str().unwrap(), "-"], &label);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let results: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let witness = &results["total"]["wrong_labels"]["worst"];
    let command = witness["command"].as_str().unwrap();
    let command = command.replace("cargo run --release --", env!("CARGO_BIN_EXE_tunnelproof"));
    let explained = Command::new("sh").args(["-c", &command]).output().unwrap();
    assert!(stdout(&explained).contains("exactly   1/3"), "{command}");
}

#[test]
fn certify_of_nothing_is_refused() {
    let output = tunnelproof(&["certify", "--strict", "--family", "lattice", "--count", "0"]);
    assert_eq!((code(&output), stdout(&output).as_str()), (2, ""));
    assert_eq!(stderr(&output), "--count 0: no query is left to judge\n");
    let output = tunnelproof(&["certify", "--count", "0"]);
    assert!(stdout(&output).contains("agree on all 12 queries"));
}

#[test]
fn certify_json_holds_rows_and_witnesses_that_explain_understands() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.json");
    let path = path.to_str().unwrap();
    let output = tunnelproof(&["certify", "--count", "250", "--json", path]);
    assert_eq!(code(&output), 0);
    let results: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    assert_eq!(results["sources"].as_array().unwrap().len(), 17);
    assert_eq!(results["total"]["queries"], 4012);
    assert_eq!(
        results["total"]["agreements"]["shadow"]["disagreements"]["count"],
        0
    );
    let published = &results["total"]["subjects"][2];
    assert_eq!(published["subject"], "shadow-published");
    let tunnel = &published["faults"]["tunnel"];
    assert!(tunnel["count"].as_u64().unwrap() > 0);
    let witness = &tunnel["worst"];
    let explained = tunnelproof(&["explain", witness["id"].as_str().unwrap()]);
    assert!(stdout(&explained).contains("tunnel"));
    for query in ["query", "query_hexadecimal"] {
        let explained = with_input(&["explain", "-"], &witness[query].to_string());
        assert!(
            stdout(&explained).contains("tunnel"),
            "{}",
            stderr(&explained)
        );
    }
}

#[test]
fn certify_json_is_refused_before_the_work_if_it_cannot_be_written() {
    let output = tunnelproof(&["certify", "--json", "no/such/folder/out.json"]);
    assert_eq!((code(&output), stdout(&output).as_str()), (2, ""));
    assert!(stderr(&output).starts_with("no/such/folder/out.json: cannot be written: "));
}

#[test]
fn certify_shrinks_its_witnesses_on_demand() {
    let output = tunnelproof(&[
        "certify",
        "--subject",
        "thesis",
        "--family",
        "lattice",
        "--count",
        "300",
        "--shrink",
    ]);
    let text = stdout(&output);
    let (_, shrunk) = text.split_once("\nShrunk:\n").unwrap();
    assert!(shrunk.contains("thesis, tunnel: "), "{shrunk}");
    let command = shrunk.lines().nth(1).unwrap();
    assert!(
        command.contains("echo '{") && command.ends_with("explain -"),
        "{command}"
    );
}

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
fn vectors_are_written_and_every_difference_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new");
    let path = path.to_str().unwrap();
    let written = tunnelproof(&["vectors", "--out", path]);
    assert_eq!(code(&written), 0, "{}", stderr(&written));
    assert!(
        stdout(&written).contains(" vectors in "),
        "{}",
        stdout(&written)
    );
    let at = |name: &str| format!("{path}/{name}");
    let text = fs::read_to_string(at("lattice.json")).unwrap();
    fs::write(at("lattice.json"), text.replacen("true", "false", 1)).unwrap();
    fs::remove_file(at("uniform.json")).unwrap();
    fs::write(at("more.json"), "{}").unwrap();
    fs::write(at("schema.json"), "{}").unwrap();
    let checked = tunnelproof(&["vectors", "--check", "--out", path]);
    assert_eq!(code(&checked), 1);
    let expected = [
        at("uniform.json") + ": is missing",
        at("lattice.json") + ": is not what would be written",
        at("more.json") + ": would not be written",
    ];
    assert_eq!(stderr(&checked).lines().collect::<Vec<_>>(), expected);
    assert!(!fs::exists(at("uniform.json")).unwrap(), "a check writes");
}

#[test]
fn vectors_that_cannot_be_written_are_refused() {
    let (_folder, path) = file("taken", "");
    let output = tunnelproof(&["vectors", "--out", &path]);
    assert_refused(&output, &path, None, "cannot be written");
}

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
fn certify_faces_and_radii_asks_only_those_who_take_them() {
    let families = "face_lattice,thick_lattice,thick_face_lattice";
    let output = tunnelproof(&[
        "certify",
        "--strict",
        "--family",
        families,
        "--count",
        "200",
        "--subject",
        "oracle,shadow,additive",
    ]);
    let text = stdout(&output);
    assert!(
        text.contains("oracle and difference agree on all "),
        "{text}"
    );
    assert!(text.contains("not asked"), "{text}");
    assert!(!text.contains("DISAGREE"), "{text}");
    let explained = tunnelproof(&["explain", "thick_face_lattice:1:3"]);
    assert_eq!(code(&explained), 0, "{}", stderr(&explained));
    assert!(
        stdout(&explained).contains("not asked"),
        "{}",
        stdout(&explained)
    );
}

//! Programs as subjects, from outside: `certify --subject cmd:...`.

use std::collections::BTreeMap;
use std::fs;

use serde_json::Value;

use crate::run::{PROGRAM, code, file, stderr, stdout, tunnelproof, with_input};

/// What a program does, each time that it is started, on its 40th query.
const MISDEEDS: [&str; 6] = ["crash", "hang", "half a line", "nan", "garbage", "wrong id"];

/// It answers 39 queries, always with a miss, and then misbehaves in the next way. Starts are
/// counted in the file `$1`. After NaN it goes on for one more query, and then ends.
const ADVERSARY: &str = r#"
echo start >> "$1"
way=$(( ($(wc -l < "$1") - 1) % 6 ))
n=0
while read -r line; do
  n=$((n + 1))
  if [ $n = 41 ]; then exit 3; fi
  if [ $n != 40 ]; then echo '{"hit": false}'; continue; fi
  case $way in
    0) echo "about to crash" >&2; kill -ABRT $$;;
    1) sleep 3600;;
    2) printf '{"hit": fal'; exit 0;;
    3) echo '{"hit": true, "toi": NaN}';;
    4) echo 'Loading model...';;
    5) echo '{"id": "1000000", "hit": false}';;
  esac
done
"#;

/// How often each lapse is due: the misdeeds in their order, for as many queries as there are.
fn expected_lapses(queries: u64) -> BTreeMap<String, u64> {
    let names = [
        "crashed",
        "hung",
        "unreadable",
        "no time",
        "unreadable",
        "misplaced",
    ];
    let mut lapses = BTreeMap::new();
    let mut asked = 0;
    for way in (0..names.len()).cycle() {
        for (due, name) in [(40, names[way]), (1, "crashed")] {
            if due == 1 && MISDEEDS[way] != "nan" {
                continue;
            }
            asked += due;
            if asked > queries {
                return lapses;
            }
            *lapses.entry(name.to_owned()).or_default() += 1;
        }
    }
    lapses
}

#[test]
fn certify_adversary_is_judged_to_the_end_with_every_query_accounted_for() {
    const QUERIES: u64 = 500;
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    fs::write(path("adversary.sh"), ADVERSARY).unwrap();
    let subject = format!("cmd:sh {} {}", path("adversary.sh"), path("starts"));
    let json = path("result.json");
    let output = tunnelproof(&[
        "certify",
        "--threads",
        "1",
        "--strict",
        "--family",
        "lattice",
        "--count",
        &QUERIES.to_string(),
        "--time-limit",
        "4",
        "--subject",
        &subject,
        "--json",
        &json,
    ]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let result: Value = serde_json::from_str(&fs::read_to_string(json).unwrap()).unwrap();
    let total = &result["total"];
    let subject = &total["subjects"][0];
    let lapses: BTreeMap<String, u64> = serde_json::from_value(subject["lapses"].clone()).unwrap();
    assert_eq!(lapses, expected_lapses(QUERIES));
    let count = |fault: &str| subject["faults"][fault]["count"].as_u64().unwrap();
    let missing: u64 = lapses.values().sum();
    assert_eq!(count("no answer"), missing);
    assert_eq!(total["queries"], QUERIES);
    // Every answer is a miss: hits that are neither missed nor without answer there are none.
    let hits = total["hits"].as_u64().unwrap();
    let missed = count("tunnel") + count("missed graze");
    assert!(
        missed <= hits && missed + missing >= hits,
        "{missed} of {hits}"
    );
    assert_eq!((count("false hit"), subject["hits"].as_u64()), (0, Some(0)));
    let program = &result["programs"][0];
    let starts = fs::read_to_string(path("starts")).unwrap().lines().count();
    assert_eq!(program["starts"], starts);
    assert!(
        program["stderr"]
            .as_str()
            .unwrap()
            .contains("about to crash\n")
    );
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("  | about to crash\n"), "{text}");
    let said = format!("gives no answer to {missing} queries: ");
    assert!(text.contains(&said), "{text}");
}

#[test]
fn certify_answers_that_nobody_asked_for_are_counted_at_the_end() {
    let script = r#"while read -r line; do echo '{"hit": false}'; done; echo '{"hit": false}'"#;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("talker.sh");
    fs::write(&path, script).unwrap();
    let subject = format!("cmd:sh {}", path.display());
    let arguments = ["--threads", "1", "--strict", "--family", "uniform"];
    let counted = ["--count", "70", "--subject", &subject];
    let output = tunnelproof(&[&["certify"], &arguments[..], &counted[..]].concat());
    assert_eq!(output.status.code(), Some(1));
    let message = stderr(&output);
    assert!(message.contains(", 1 answer too many"), "{message}");
    assert!(!message.contains("without answer"), "{message}");
}

#[test]
fn certify_of_eval_as_a_program_is_that_of_its_subject() {
    let oracle = format!("cmd:{PROGRAM} eval -");
    let additive = format!("cmd:{PROGRAM} eval --subject additive -");
    let folder = tempfile::tempdir().unwrap();
    let result = |subjects: [&str; 2]| -> Value {
        let json = folder.path().join("result.json");
        let json = json.to_str().unwrap();
        let [first, second] = subjects;
        let output = tunnelproof(&[
            "certify",
            "--family",
            "lattice,slow,grazing",
            "--count",
            "700",
            "--subject",
            first,
            "--subject",
            second,
            "--json",
            json,
        ]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        serde_json::from_str(&fs::read_to_string(json).unwrap()).unwrap()
    };
    let [ours, theirs] = [result(["oracle", "additive"]), result([&oracle, &additive])];
    let faults = &ours["total"]["subjects"][1]["faults"];
    assert!(faults["tunnel"]["count"] != 0 && faults["early"]["count"] != 0);
    for subject in 0..2 {
        let [ours, theirs] = [&ours, &theirs].map(|result| &result["total"]["subjects"][subject]);
        assert_eq!(ours["hits"], theirs["hits"]);
        for (fault, finding) in ours["faults"].as_object().unwrap() {
            let other = &theirs["faults"][fault];
            assert_eq!(finding["count"], other["count"], "{fault}");
            assert_eq!(finding["worst"]["id"], other["worst"]["id"], "{fault}");
        }
    }
}

#[test]
fn certify_of_a_program_goes_by_the_tolerance_that_is_declared_for_it() {
    let thesis = format!("cmd:{PROGRAM} eval --subject thesis -");
    let folder = tempfile::tempdir().unwrap();
    let json = folder.path().join("result.json");
    let json = json.to_str().unwrap();
    let result = |subject: &str, options: &[&str]| -> [Vec<String>; 2] {
        let arguments = ["certify", "--json", json, "--subject", subject];
        let sources = ["--family", "uniform,near_coplanar", "--count", "500"];
        let output = tunnelproof(&[&arguments[..], &sources, options].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let result: Value = serde_json::from_str(&fs::read_to_string(json).unwrap()).unwrap();
        ["failures", "exact_failures"].map(|field| {
            let lines = result[field].as_array().unwrap().iter();
            let lines = lines.map(|line| line.as_str().unwrap());
            let of = |line: &str| line.rsplit_once(": ").map(|(_, what)| what.to_owned());
            lines.filter_map(of).collect()
        })
    };
    let own = result("thesis", &[]);
    assert_ne!(own[0], own[1]);
    assert!(own[1][0].contains(" near hits, ") && own[1][0].contains(" late times of impact"));
    assert_eq!(result(&thesis, &["--permit", "late=1e-9,near=1e-6"]), own);
    let [declared, exact] = result(&thesis, &[]);
    assert_eq!(declared, exact);
    assert!(
        declared[0].contains(" false hits") && !declared[0].contains("near hits"),
        "{declared:?}"
    );
}

/// Answers a single query with this line.
fn certify_one(answer: &str, options: &[&str]) -> String {
    let script = format!("while read -r line; do echo '{answer}'; done");
    let (_folder, path) = file("answer.sh", script);
    let subject = format!("cmd:sh {path}");
    let arguments = ["certify", "--count", "1", "--subject", &subject, "--family"];
    let output = tunnelproof(&[&arguments[..], &["shared_start"], options].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    stdout(&output)
}

#[test]
fn certify_takes_bounds_around_the_time_for_right_however_wide_they_are() {
    // The exact time of such a query is 0.
    for (answer, is_late) in [
        (r#"{"hit":true,"toi":{"below":0,"above":5e-324}}"#, false),
        (r#"{"hit":true,"toi":{"below":0,"above":1}}"#, false),
        (r#"{"hit":true,"toi":{"below":5e-324,"above":1}}"#, true),
        (r#"{"hit":true,"toi":5e-324}"#, true),
    ] {
        let text = certify_one(answer, &[]);
        assert_eq!(text.contains(" FAILS "), is_late, "{answer}: {text}");
        assert_eq!(text.contains(", late, by "), is_late, "{answer}: {text}");
    }
}

#[test]
fn certify_shows_what_was_written_in_place_of_a_time() {
    for (toi, what) in [
        ("-0.1", "toi is -0.1, not a number from 0 to 1"),
        ("1.5", "toi is 1.5, not a number from 0 to 1"),
        ("NaN", "toi is NaN, not a number from 0 to 1"),
        ("null", "toi is NaN, not a number from 0 to 1"),
        ("1e999", "toi is inf, not a number from 0 to 1"),
        (
            r#"{"below":0.5,"above":1.5}"#,
            "toi is [0.5, 1.5], not a number from 0 to 1",
        ),
        (
            r#""x""#,
            r#"toi is "x", not a number: {"hit":true,"toi":"x"}"#,
        ),
    ] {
        let text = certify_one(&format!(r#"{{"hit":true,"toi":{toi}}}"#), &[]);
        assert!(text.contains(what), "{toi}: {text}");
        assert!(text.contains(" gives no answer to 1 query: 1 "), "{text}");
    }
    let text = certify_one(r#"{"id":"5","hit":false}"#, &[]);
    let what = "wrote the answer to id 5 where id 0 is due";
    assert!(text.contains(what), "{text}");
}

#[test]
fn tolerances_are_said_where_they_make_a_difference_and_where_they_make_none() {
    let late = r#"{"hit":true,"toi":0.001}"#;
    let permitted = certify_one(late, &["--permit", "late=0.01"]);
    assert!(
        permitted.contains(
            " passes with its tolerance, late=0.01; without it fails: 1 late time of impact\n"
        ),
        "{permitted}"
    );
    let idle = certify_one(late, &["--permit", "near=100"]);
    assert!(
        idle.contains(" has a tolerance, near=100, which makes no difference here\n"),
        "{idle}"
    );
    let script = format!("while read -r line; do echo '{late}'; done");
    let (_folder, path) = file("late.sh", script);
    let subject = format!("cmd:sh {path}");
    let explain = |options: &[&str]| {
        let arguments = ["explain", "shared_start:1:0", "--subject", &subject];
        let output = tunnelproof(&[&arguments[..], options].concat());
        let text = stdout(&output);
        let line = text.lines().find(|line| line.contains("cmd:")).unwrap();
        line.to_owned()
    };
    assert!(
        explain(&[]).ends_with("  late by 1.0e-3"),
        "{}",
        explain(&[])
    );
    let permitted = explain(&["--permit", "late=0.01"]);
    assert!(
        permitted.ends_with("  right, late by 1.0e-3, as it may be"),
        "{permitted}"
    );
}

#[test]
fn options_of_programs_without_a_program_are_refused() {
    for command in [
        &["certify", "--count", "1"][..],
        &["certify", "--count", "1", "--subject", "oracle"],
        &["explain", "figure:4.1"],
        &["explain", "cast_box_lattice:1:3"],
        &["shrink", "--subject", "thesis", "figure:4.1"],
        &["slowest", "--seconds", "0.1"],
        &["eval", "-"],
    ] {
        for option in [["--wire", "binary"], ["--time-limit", "3"]] {
            let output = tunnelproof(&[command, &option].concat());
            assert_eq!(code(&output), 2, "{command:?}");
            let [name, value] = option;
            let what = format!("{name} {value} is for programs and libraries, and none is asked");
            assert!(stderr(&output).starts_with(&what), "{}", stderr(&output));
        }
    }
}

#[test]
fn what_is_named_twice_counts_once_and_numbers_below_0_are_refused() {
    let twice = ["--family", "uniform,uniform", "--subject", "oracle,oracle"];
    let output = tunnelproof(&[&["certify", "--count", "10"], &twice[..]].concat());
    let text = stdout(&output);
    assert!(text.contains("10 queries of uniform: "), "{text}");
    assert_eq!(text.matches("\n  oracle ").count(), 1, "{text}");
    for option in ["--count", "--seed"] {
        let output = tunnelproof(&["certify", option, "-1"]);
        assert_eq!(code(&output), 2);
        let said = stderr(&output);
        assert!(
            said.contains("it has to be a whole number from 0"),
            "{said}"
        );
    }
}

#[test]
fn certify_refuses_what_is_no_tolerance() {
    for (permit, problem) in [
        ("", "\"\" is not near=METRES or late=STEPS"),
        ("1e-9", "\"1e-9\" is not near=METRES or late=STEPS"),
        ("early=1", "\"early\" is neither near nor late"),
        ("near=-1", "near is \"-1\", not a number from 0"),
        ("late=inf", "late is \"inf\", not a number from 0"),
        ("late=1,late=2", "late is there twice"),
        (
            "late=1e-9",
            "add --subject cmd:PROGRAM or --subject lib:FILE",
        ),
    ] {
        let output = tunnelproof(&["certify", "--permit", permit]);
        assert_eq!(output.status.code(), Some(2));
        let message = stderr(&output);
        assert!(message.contains(problem), "{message}");
    }
}

#[test]
fn certify_of_bodies_that_turn_judges_engines_and_programs() {
    let certify = |subject: &str| {
        tunnelproof(&[
            "certify",
            "--strict",
            "--family",
            "turning_lattice,turning_thick_lattice",
            "--count",
            "70",
            "--subject",
            subject,
        ])
    };
    let ours = certify("oracle,difference,certified");
    let text = stdout(&ours);
    assert_eq!(code(&ours), 0, "{text}{}", stderr(&ours));
    assert!(text.contains("140 queries of 2 sources: "), "{text}");
    assert!(
        text.contains("oracle and difference agree on all 140 queries"),
        "{text}"
    );
    let right = certify(&format!(
        "cmd:{PROGRAM} --threads 1 eval --turning --subject certified -"
    ));
    assert_eq!(code(&right), 0, "{}{}", stdout(&right), stderr(&right));
    let misses = certify(r#"cmd:sh -c 'while read -r line; do echo "{\"hit\": false}"; done'"#);
    assert_eq!(code(&misses), 1);
    for fault in [" tunnels, ", " missed grazes"] {
        assert!(stderr(&misses).contains(fault), "{}", stderr(&misses));
    }
    assert!(stdout(&misses).contains("explain turning_"));
}

#[test]
fn certify_of_bodies_that_turn_refuses_what_it_cannot_do() {
    let refused = |more: &[&str], what: &str| {
        let mut arguments = vec!["certify", "--family", "turning_uniform", "--count", "1"];
        arguments.extend(more);
        let output = tunnelproof(&arguments);
        assert_eq!(code(&output), 2, "{more:?}");
        assert!(stderr(&output).contains(what), "{}", stderr(&output));
    };
    refused(&["--subject", "lib:./none.so"], "lib:./none.so");
    refused(
        &["--subject", "thesis"],
        "takes no queries of bodies that turn",
    );
}

#[test]
fn shrink_and_explain_take_queries_of_bodies_that_turn() {
    let blind = r#"cmd:sh -c 'while read -r line; do echo "{\"hit\": false}"; done'"#;
    let shrink = |query: &str| {
        let arguments = ["shrink", "--calls", "300", "--subject", blind, query];
        tunnelproof(&arguments)
    };
    let shrunk = shrink("turning_plates:1:6");
    assert_eq!(code(&shrunk), 0, "{}", stderr(&shrunk));
    let line = stdout(&shrunk);
    assert!(
        line.contains("turning") && line.contains("\"poses\""),
        "{line}"
    );
    let explained = with_input(&["explain", "--turning", "--subject", blind, "-"], &line);
    let text = stdout(&explained);
    assert_eq!(code(&explained), 0, "{}", stderr(&explained));
    assert!(
        text.contains("  tunnel\n") || text.contains("  missed graze\n"),
        "{text}"
    );
    let again = with_input(
        &[
            "shrink",
            "--turning",
            "--calls",
            "1",
            "--subject",
            "certified",
            "-",
        ],
        &line,
    );
    assert_eq!(code(&again), 1, "{}", stderr(&again));
    assert!(stderr(&again).contains("certified is right"));
}

#[test]
fn programs_answer_wherever_a_subject_is_asked_for() {
    let thesis = format!("cmd:{PROGRAM} eval --subject thesis -");
    let shrunk = tunnelproof(&["shrink", "--subject", &thesis, "lattice:1:2552"]);
    assert!(stderr(&shrunk).contains("tunnel: "), "{}", stderr(&shrunk));
    let explained = tunnelproof(&["explain", "--subject", &thesis, "lattice:1:2552"]);
    let text = String::from_utf8(explained.stdout).unwrap();
    let line = text.lines().find(|line| line.contains("cmd:")).unwrap();
    assert!(line.ends_with("tunnel"), "{text}");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.jsonl");
    fs::write(&file, shrunk.stdout).unwrap();
    let file = file.to_str().unwrap();
    let eval = |subject: &str| tunnelproof(&["eval", "--subject", subject, file]).stdout;
    let answer: Value = serde_json::from_slice(&eval(&thesis)).unwrap();
    let own: Value = serde_json::from_slice(&eval("thesis")).unwrap();
    assert_eq!(
        (&answer["hit"], &answer["case"]),
        (&own["hit"], &own["case"])
    );
}

#[test]
fn programs_that_cannot_be_started_are_refused() {
    for (subject, what) in [
        ("cmd:./no-such-program --flag", "cannot be started: "),
        ("cmd: ", "names no program"),
        ("cmd:a 'b", "has a quote that is not closed"),
    ] {
        let output = tunnelproof(&["certify", "--count", "5", "--subject", subject]);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(
            message.starts_with(&format!("{subject}: {what}")),
            "{message}"
        );
        assert_eq!(message.lines().count(), 1, "{message}");
    }
    let output = tunnelproof(&["certify", "--subject", "oracle,nobody"]);
    assert!(
        stderr(&output).contains("no such subject"),
        "{}",
        stderr(&output)
    );
}

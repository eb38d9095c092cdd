//! `sweep` from outside: what it refuses, what it writes, and that it can be interrupted.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::run::{command, stderr, stdout};

fn cached(cache: &Path, arguments: &[&str]) -> Command {
    let mut command = command(&["sweep"]);
    command.args(arguments).arg("--cache").arg(cache);
    command
}

fn sweep(cache: &Path, arguments: &[&str]) -> Output {
    cached(cache, arguments).output().unwrap()
}

const SMALL: [&str; 4] = ["--family", "near_coplanar", "--count", "60"];

#[test]
fn sweep_refuses_what_it_cannot_span_and_names_it() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, what) in [
        (vec!["--threshold", "epsilon"], "coefficients_cubic"),
        (vec!["--threshold", "t", "--from", "NaN"], "--from is NaN"),
        (vec!["--threshold", "t", "--from", "-1"], "--from is -1"),
        (vec!["--threshold", "t", "--from", "2"], "is above --to"),
        (vec!["--threshold", "t", "--steps", "0"], "--steps is 0"),
        (
            vec!["--threshold", "t", "--threshold", "t"],
            "t is there twice",
        ),
        (vec!["--from", "1"], "--from without a --threshold"),
        (
            vec!["--threshold", "t", "--to", "1", "--to", "2"],
            "--to is there twice",
        ),
        (vec!["--scale", "-3"], "--scale is -3"),
        (vec!["--scale", "inf"], "--scale is inf"),
        (vec!["--count", "0"], "no query"),
        (vec!["--precision", "f16"], "f32"),
        (vec!["--resume", "--no-cache"], "--no-cache"),
    ] {
        let mut command = command(&["sweep"]);
        command.args(&arguments);
        if !arguments.contains(&"--no-cache") {
            command.arg("--cache").arg(folder.path());
        }
        let output = command.output().unwrap();
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(what), "{arguments:?}: {message}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn sweep_default_has_thirty_values_of_each_threshold() {
    let folder = tempfile::tempdir().unwrap();
    let json = folder.path().join("out.json");
    let mut arguments = SMALL.to_vec();
    arguments.extend(["--json", json.to_str().unwrap()]);
    let output = sweep(folder.path(), &arguments);
    assert!(output.status.success(), "{}", stderr(&output));
    let json: Value = serde_json::from_str(&fs::read_to_string(json).unwrap()).unwrap();
    assert_eq!(json["axes"].as_array().unwrap().len(), 5);
    assert_eq!(json["settings"].as_array().unwrap().len(), 151);
    assert_eq!(json["settings"][0]["setting"]["dist"], 1e-6);
    assert_eq!(json["sources"][0]["queries"], 60);
    // What the table says of table 3.1 is what the file says.
    let price = &json["settings"][0]["price"];
    let table = stdout(&output);
    let line: Vec<_> = table.lines().nth(4).unwrap().split_whitespace().collect();
    let tunnels = price["tunnels"].as_u64().unwrap() + price["joint_tunnels"].as_u64().unwrap();
    assert_eq!(line[0], tunnels.to_string());
    assert_eq!(line[2], price["false_hits"].to_string());
    // A witness can be asked about.
    let witness = &json["witnesses"]["missed graze"];
    assert!(witness["command"].as_str().unwrap().contains("explain -"));
}

#[test]
fn sweep_of_several_thresholds_has_every_combination() {
    let folder = tempfile::tempdir().unwrap();
    let mut arguments = SMALL.to_vec();
    arguments.extend([
        "--threshold",
        "dist",
        "--from",
        "1e-9",
        "--to",
        "1e-3",
        "--steps",
        "3",
    ]);
    arguments.extend(["--threshold", "t", "--steps", "2"]);
    let output = sweep(folder.path(), &arguments);
    let table = stdout(&output);
    assert!(output.status.success(), "{}", stderr(&output));
    let values = ["1.0e-9, 1.0e-15", "1.0e-6, 1.0e-15", "1.0e-3, 3.2e-1"];
    assert!(values.iter().all(|value| table.contains(value)), "{table}");
    assert_eq!(table.lines().count(), 5 + 3 + 6, "{table}");
}

#[test]
fn sweep_takes_a_corpus_and_refuses_bad_queries_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("queries.jsonl");
    let point = "[0,0,0],[1,0,0],[0.5,-1,1],[0.5,1,1],[0,0,0],[1,0,0],[0.5,-1,-2],[0.5,1,-2]";
    let line = format!(r#"{{"id":"a","kind":"edge-edge","points":[{point}]}}"#);
    fs::write(&path, &line).unwrap();
    let corpus = path.to_str().unwrap();
    let output = sweep(folder.path(), &["--corpus", corpus]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("1 query, 1 crossing,"));
    fs::write(&path, line.replace("edge-edge", "vertex-face")).unwrap();
    let output = sweep(folder.path(), &["--corpus", corpus]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).starts_with(&format!("{corpus}:1: ")));
}

#[test]
fn sweep_notices_a_damaged_cache_and_makes_it_anew() {
    let folder = tempfile::tempdir().unwrap();
    let output = sweep(folder.path(), &SMALL);
    let expected = stdout(&output);
    let kept = |extension: &str| {
        let mut files = fs::read_dir(folder.path())
            .unwrap()
            .map(|file| file.unwrap().path());
        let is_it = |path: &std::path::PathBuf| path.extension().is_some_and(|e| e == extension);
        files.find(is_it).unwrap()
    };
    for (extension, arguments) in [
        ("truths", SMALL.to_vec()),
        ("settings", [&SMALL[..], &["--resume"]].concat()),
    ] {
        let path = kept(extension);
        let good = fs::read(&path).unwrap();
        let mut flipped = good.clone();
        flipped[good.len() / 2] ^= 1;
        let foreign = b"something else".to_vec();
        for bad in [
            flipped,
            foreign,
            good[..good.len() - 1].to_vec(),
            Vec::new(),
        ] {
            fs::write(&path, bad).unwrap();
            let output = sweep(folder.path(), &arguments);
            assert!(output.status.success());
            let message = stderr(&output);
            assert!(
                message.contains("made anew") && message.lines().count() == 1,
                "{message}"
            );
            assert_eq!(stdout(&output), expected);
            assert_eq!(fs::read(&path).unwrap(), good, "the cache is as before");
        }
    }
}

#[cfg(unix)]
#[test]
fn sweep_ctrl_c_leaves_what_was_finished_and_resume_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let (json, cache) = (folder.path().join("out.json"), folder.path().join("cache"));
    let arguments = [
        "--family",
        "near_coplanar",
        "--count",
        "1000",
        "--json",
        json.to_str().unwrap(),
        "--threshold",
        "dist",
        "--steps",
        "1500",
        "--threads",
        "1",
    ];
    let child = cached(&cache, &arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The exact answers are kept as soon as all are found; then settings are judged.
    let start = Instant::now();
    while !fs::read_dir(&cache).is_ok_and(|mut files| files.any(|f| is_truths(&f.unwrap().path())))
    {
        assert!(
            start.elapsed() < Duration::from_secs(120),
            "no exact answers were kept"
        );
        std::thread::sleep(Duration::from_millis(5));
    }
    let signal = format!("kill -INT {}", child.id());
    let signal = Command::new("sh").args(["-c", &signal]).status();
    assert!(signal.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    assert!(stderr(&output).contains("--resume goes on"));
    let finished: Value = serde_json::from_str(&fs::read_to_string(&json).unwrap()).unwrap();
    let finished = finished["settings"].as_array().unwrap().len();
    assert!(finished < 1501, "it was not interrupted");
    let resumed = sweep(&cache, &[&arguments[..], &["--resume"]].concat());
    assert!(resumed.status.success(), "{}", stderr(&resumed));
    let whole = fs::read(&json).unwrap();
    let anew = sweep(&folder.path().join("other"), &arguments);
    assert!(anew.status.success());
    assert_eq!(fs::read(&json).unwrap(), whole);
    assert_eq!(anew.stdout, resumed.stdout);
}

#[cfg(unix)]
fn is_truths(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| extension == "truths")
}

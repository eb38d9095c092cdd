//! `simulate`, `audit` and `table` as a user runs them.

use std::path::Path;

use serde_json::Value;
use tunnelproof_cli::scenes::{EMBEDDED, Scene};

use crate::run::{json, stderr, stdout, tunnelproof};

#[test]
fn simulate_records_what_audit_reads_and_both_find_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let [recording, live, read] =
        ["run.tps", "live.json", "read.json"].map(|name| folder.path().join(name));
    let path = |path: &'_ Path| path.to_str().unwrap().to_owned();
    let output = tunnelproof(&[
        "simulate",
        "basic-collision",
        "--mode",
        "thesis",
        "--narrow",
        "discrete",
        "--duration",
        "0.2",
        "--audit",
        "--record",
        &path(&recording),
        "--json",
        &path(&live),
    ]);
    // Nobody looks at the way of the falling wire.
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let said = stdout(&output);
    assert!(
        said.contains("steps                 12 (0.200 s)"),
        "{said}"
    );
    assert!(said.contains("have passed through each other"), "{said}");
    assert!(said.contains("missed by the narrow phase: wire"), "{said}");
    let output = tunnelproof(&["audit", &path(&recording), "--json", &path(&read)]);
    assert_eq!(output.status.code(), Some(1));
    assert!(said.ends_with(&stdout(&output)), "{said}");
    let (live, read) = (json(&live), json(&read));
    assert_eq!(live["audit"], read);
    // A page from the recording is that of the run, but for names.
    let page = folder.path().join("read.html");
    let output = tunnelproof(&["audit", &path(&recording), "--replay", &path(&page)]);
    assert_eq!(output.status.code(), Some(1));
    let page = std::fs::read_to_string(page).unwrap();
    assert!(page.contains("<title>run</title>"));
    assert!(page.contains(r#"{"what":"missed","at":["#));
    assert_eq!(page.matches("\"time\":").count(), 13);
    assert!(page.contains(r#""names":{"wires":["wire 0","wire 1","wire 2"]"#));
    assert_eq!(live["summary"]["steps"], 12);
    // The witness is a query that the commands read.
    let witness = read["findings"][0]["query"].as_str().unwrap();
    let file = folder.path().join("witness.jsonl");
    std::fs::write(&file, witness).unwrap();
    let output = tunnelproof(&["explain", &format!("{}#witness", path(&file))]);
    assert!(output.status.success(), "{}", stderr(&output));
}

#[test]
fn simulate_in_guard_mode_is_clean() {
    let output = tunnelproof(&[
        "simulate",
        "basic-collision",
        "--duration",
        "0.5",
        "--audit",
    ]);
    let said = stdout(&output);
    assert!(output.status.success(), "{said}{}", stderr(&output));
    assert!(said.contains("standing tunnels        0"), "{said}");
}

#[test]
fn simulate_writes_a_clock_and_a_file_for_each_step_for_paraview() {
    let folder = tempfile::tempdir().unwrap();
    let to = folder.path().join("new");
    let path = to.to_str().unwrap();
    let output = tunnelproof(&[
        "simulate",
        "basic-collision",
        "--duration",
        "0.05",
        "--vtk",
        path,
    ]);
    assert!(output.status.success(), "{}", stderr(&output));
    let clock = std::fs::read_to_string(to.join("steps.pvd")).unwrap();
    assert_eq!(clock.matches("<DataSet").count(), 3);
    assert!(to.join("step-000002.vtp").exists());
}

#[test]
fn simulate_writes_bodies_for_paraview_beside_the_steps() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let scene = ["simulate", "twisting-under-load", "--duration", "0.05"];
    let output = tunnelproof(&[&scene[..], &["--vtk", path]].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    let clock = std::fs::read_to_string(folder.path().join("steps.pvd")).unwrap();
    assert_eq!(clock.matches("file=\"bodies-").count(), 3);
    assert!(folder.path().join("bodies-000002.vtp").exists());
}

#[test]
fn simulate_writes_a_line_for_each_step() {
    let folder = tempfile::tempdir().unwrap();
    let [table, summary] = ["run.csv", "run.json"].map(|name| folder.path().join(name));
    let mut options = vec![
        "simulate",
        "twisting-under-load",
        "--duration",
        "0.5",
        "--csv",
    ];
    options.extend([table.to_str().unwrap(), "--json", summary.to_str().unwrap()]);
    let output = tunnelproof(&options);
    assert!(output.status.success(), "{}", stderr(&output));
    let table = std::fs::read_to_string(table).unwrap();
    let mut lines = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.iter().map(|number| number.parse().unwrap()).collect())
        .collect();
    assert_eq!(rows.len(), 30);
    let column = |name: &str| {
        let at = names.iter().position(|other| *other == name).unwrap();
        rows.iter().map(|row| row[at]).collect::<Vec<_>>()
    };
    let document: Value = serde_json::from_slice(&std::fs::read(summary).unwrap()).unwrap();
    let summary = &document["summary"];
    let energies = ["kinetic (J)", "potential (J)", "elastic (J)"].map(column);
    let end: f64 = energies.iter().map(|energy| energy[29]).sum();
    let close = |a: f64, b: &Value| (a - b.as_f64().unwrap()).abs() < 1e-9 * a.abs().max(1.0);
    assert!(close(end, &summary["energy"]["end"]), "{summary}");
    let largest = |name| column(name).into_iter().fold(0.0, f64::max);
    assert!(close(
        largest("gain (J)"),
        &summary["energy"]["largest_gain"]
    ));
    assert!(close(largest("largest tension (N)"), &summary["tension"]));
    assert!(close(largest("contacts"), &summary["contacts"]));
    let output = tunnelproof(&[
        "simulate",
        "basic-collision",
        "--csv",
        "/no/such/folder/run.csv",
    ]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("/no/such/folder/run.csv"));
}

#[test]
fn simulate_draws_two_runs_beside_each_other() {
    let folder = tempfile::tempdir().unwrap();
    let [pictures, page] = ["pictures", "both.html"].map(|name| folder.path().join(name));
    let output = tunnelproof(&[
        "simulate",
        "basic-collision",
        "--duration",
        "0.05",
        "--beside",
        "discrete",
        "--audit",
        "--frames",
        pictures.to_str().unwrap(),
        "--replay",
        page.to_str().unwrap(),
    ]);
    // Its own run is clean, whatever the one beside it does.
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(std::fs::read_dir(&pictures).unwrap().count(), 4);
    let picture = std::fs::read_to_string(pictures.join("frame-000001.svg")).unwrap();
    for words in [
        "certified, guard mode",
        "discrete, guard mode",
        "prevented",
        "missed",
    ] {
        assert!(picture.contains(words), "{words}: {picture}");
    }
    let page = std::fs::read_to_string(page).unwrap();
    assert_eq!(page.matches("class=\"canvas\"").count(), 2);
    assert!(page.contains("audited: nothing passed unnoticed"));
    assert!(page.contains("contacts missed"));
}

#[test]
fn simulate_refuses_what_is_no_scene() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    let wrong = EMBEDDED[0].1.replacen("radius = 0.02", "radius = -1", 1);
    std::fs::write(&file, &wrong).unwrap();
    let output = tunnelproof(&["simulate", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    let line = 1 + wrong[..wrong.find("radius = -1").unwrap()]
        .matches('\n')
        .count();
    let said = stderr(&output);
    assert!(
        said.contains(&format!(
            "line {line}: wires[0].material.radius: radius is -1"
        )),
        "{said}"
    );
    let output = tunnelproof(&["simulate", "no-such-scene"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("twisting-under-load"));
    let output = tunnelproof(&["audit", file.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("scene.toml: "));
}

#[test]
fn schema_accepts_the_scenes_and_refuses_unknown_fields() {
    let output = tunnelproof(&["simulate", "--schema"]);
    let schema: Value = serde_json::from_slice(&output.stdout).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    for (name, text) in EMBEDDED {
        let scene = serde_json::to_value(Scene::from_toml(text).unwrap()).unwrap();
        assert!(schema.is_valid(&scene), "{name}");
        let mut unknown = scene.clone();
        unknown["wires"][0]["colour"] = "blue".into();
        assert!(!schema.is_valid(&unknown));
        let mut missing = scene;
        missing["wires"][0].as_object_mut().unwrap().remove("route");
        assert!(!schema.is_valid(&missing));
    }
}

#[test]
fn table_has_the_rows_of_every_scene_and_all_hold() {
    let output = tunnelproof(&["table", "rows"]);
    let said = stdout(&output);
    assert!(output.status.success(), "{said}{}", stderr(&output));
    for (name, _) in EMBEDDED {
        let head = said.lines().find(|line| line.starts_with(name));
        assert!(
            head.is_some_and(|head| head.ends_with("accepted")),
            "{said}"
        );
    }
    let row = |what: &str| {
        let row = said.lines().find(|line| line.starts_with(what)).unwrap();
        row[what.len()..].split_whitespace().collect::<Vec<_>>()
    };
    assert_eq!(row("thesis mode: tunnels"), ["2", "2", "2"]);
    let collided = row("the wires collide, s");
    assert_eq!(
        (collided[0], &collided[2..]),
        ("8.85", &["8.35", "to", "9.35"][..])
    );
    let output = tunnelproof(&["table", "rows", "--duration", "1"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(stderr(&output), "--duration: rows are of whole scenes\n");
}

#[test]
fn table_refuses_options_that_say_nothing_to_it() {
    let refusals = [
        (
            ["4.1", "--starts", "3"],
            "--starts: this table has no perturbed starts\n",
        ),
        (
            ["speeds", "--scene", "basic-collision"],
            "--scene: this table has no choice of scenes\n",
        ),
        (
            ["rows", "--scene", "basic-collision"],
            "--scene: this table has no choice of scenes\n",
        ),
    ];
    for (arguments, refusal) in refusals {
        let output = tunnelproof(&["table", arguments[0], arguments[1], arguments[2]]);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert_eq!(stderr(&output), refusal, "{arguments:?}");
    }
}

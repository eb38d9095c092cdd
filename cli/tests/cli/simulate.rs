//! `simulate`, `audit` and `table` as a user runs them.

use std::path::Path;

use serde_json::Value;
use tunnelproof::wire::recording::Recording;
use tunnelproof::wire::state::State;
use tunnelproof::wire::{Phases, StepRecord};
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
        said.contains(&format!("line {line}: wires[0].radius: radius is -1")),
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

/// The steps of a recording, without the time that they took, to the bit.
fn steps(path: &Path) -> Vec<Vec<u8>> {
    let file = std::fs::File::open(path).unwrap();
    let recording = Recording::open(std::io::BufReader::new(file)).unwrap();
    let step = |record: Result<StepRecord, _>| {
        let mut record = record.unwrap();
        record.phases = Phases::default();
        serde_json::to_vec(&record).unwrap()
    };
    recording.map(step).collect()
}

#[test]
fn simulate_goes_on_in_another_process_as_if_it_had_not_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let run = |scene: &str, duration: &str, more: &[&str]| {
        let output = tunnelproof(&[&["simulate", scene, "--duration", duration], more].concat());
        assert!(output.status.success(), "{}", stderr(&output));
        output
    };
    for (scene, part, whole) in [
        ("basic-collision", "1.5", "2.5"),
        ("chains-on-deck", "0.7", "1.1"),
    ] {
        run(
            scene,
            whole,
            &[
                "--record",
                &path("whole.tps"),
                "--save",
                &path("whole.state"),
            ],
        );
        run(
            scene,
            part,
            &["--record", &path("a.tps"), "--save", &path("a.state")],
        );
        let more = [
            "--from",
            &path("a.state"),
            "--record",
            &path("b.tps"),
            "--save",
            &path("b.state"),
            "--audit",
        ];
        let output = run(scene, whole, &more);
        assert_eq!(stderr(&output), "", "nothing is set otherwise");
        let said = stdout(&output);
        assert!(said.contains("continued from        step "), "{said}");
        assert!(said.contains("standing tunnels        0"), "{said}");
        let all = steps(&folder.path().join("whole.tps"));
        let [a, b] = ["a.tps", "b.tps"].map(|name| steps(&folder.path().join(name)));
        assert!(!a.is_empty() && !b.is_empty());
        assert!([a, b].concat() == all, "{scene}");
        let [whole, b] = ["whole.state", "b.state"].map(|name| std::fs::read(path(name)).unwrap());
        assert!(whole == b, "{scene}");
        // Both recordings are judged as one.
        let judge = |recordings: &[&str], out: &str| {
            let output = tunnelproof(&[&["audit"], recordings, &["--json", out]].concat());
            assert!(output.status.success(), "{}", stderr(&output));
            json(Path::new(out))
        };
        let one = judge(&[&path("whole.tps")], &path("one.json"));
        let two = judge(&[&path("a.tps"), &path("b.tps")], &path("two.json"));
        assert_eq!(one, two);
    }
}

#[test]
fn simulate_saves_every_so_often_and_the_later_recording_has_the_word() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let scene = [
        "simulate",
        "basic-collision",
        "--mode",
        "thesis",
        "--narrow",
        "tuned",
    ];
    let [whole, a, b, state] = ["whole.tps", "a.tps", "b.tps", "state"].map(path);
    let run = |more: &[&str]| {
        let output = tunnelproof(&[&scene[..], more].concat());
        assert!(output.status.success(), "{}", stderr(&output));
    };
    run(&["--duration", "1", "--record", &whole]);
    // The state is that of step 40, as after a crash; the recording is cut off later.
    run(&["--duration", "0.6667", "--save", &state]);
    run(&["--duration", "0.9", "--record", &a]);
    let bytes = std::fs::read(&a).unwrap();
    std::fs::write(&a, &bytes[..bytes.len() - 100]).unwrap();
    // How pairs are tested, and the mode, come from the state.
    let output = tunnelproof(&[
        "simulate",
        "basic-collision",
        "--duration",
        "1",
        "--from",
        &state,
        "--record",
        &b,
        "--save",
        &state,
        "--save-every",
        "7",
        "--json",
        "-",
    ]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(stderr(&output), "");
    let said: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(
        (&said["narrow"], &said["mode"]),
        (&"tuned".into(), &"thesis".into())
    );
    assert_eq!(
        (&said["summary"]["from_step"], &said["summary"]["steps"]),
        (&40.into(), &20.into())
    );
    let whole_steps = steps(Path::new(&whole));
    assert!(steps(Path::new(&b)) == whole_steps[40..]);
    let judge = |recordings: &[&str]| tunnelproof(&[&["audit"], recordings].concat());
    assert_eq!(stdout(&judge(&[&whole])), stdout(&judge(&[&a, &b])));
    let said = stderr(&judge(&[&b, &a]));
    assert!(said.contains("b.tps: lacks step "), "{said}");
    let said = stderr(&judge(&[&a]));
    assert!(said.contains("a.tps: byte "), "{said}");
    let other = path("other.tps");
    let output = tunnelproof(&[
        "simulate",
        "pulling-anchor",
        "--duration",
        "0.1",
        "--record",
        &other,
    ]);
    assert!(output.status.success());
    let said = stderr(&judge(&[&a, &other]));
    assert!(
        said.contains("other.tps: has other wires or bodies than "),
        "{said}"
    );
}

#[test]
fn simulate_tells_what_is_set_otherwise_and_refuses_another_scene() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let state = path("state");
    let output = tunnelproof(&[
        "simulate",
        "basic-collision",
        "--duration",
        "0.5",
        "--save",
        &state,
    ]);
    assert!(output.status.success(), "{}", stderr(&output));
    let output = tunnelproof(&[
        "simulate",
        "basic-collision",
        "--duration",
        "0.6",
        "--from",
        &state,
        "--step",
        "0.01",
        "--mode",
        "thesis",
    ]);
    assert!(output.status.success(), "{}", stderr(&output));
    let expected = format!(
        "{state}: settings.step is 0.01, it was 0.016666666666666666\n\
         {state}: mode is thesis, it was guard\n"
    );
    assert_eq!(stderr(&output), expected);
    let said = stdout(&output);
    assert!(
        said.contains("steps                 10 (0.600 s)"),
        "{said}"
    );
    let refused = |scene: &str, said: &str| {
        let output = tunnelproof(&["simulate", scene, "--from", &state]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(said), "{}", stderr(&output));
    };
    refused(
        "pulling-anchor",
        "not as in the state to go on from, which has ",
    );
    let file = path("other.toml");
    let other = EMBEDDED[0].1.replacen("radius = 0.02", "radius = 0.03", 1);
    std::fs::write(&file, other).unwrap();
    refused(
        &file,
        "wires[0].material: not as in the state to go on from, which has Material {",
    );
    let output = tunnelproof(&[
        "simulate",
        "basic-collision",
        "--from",
        &state,
        "--duration",
        "0.5",
    ]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("there is no step left"),
        "{}",
        stderr(&output)
    );
    std::fs::write(&state, "no state").unwrap();
    refused(
        "basic-collision",
        "state: byte 0: this is no state of a world",
    );
    let output = tunnelproof(&["simulate", "basic-collision", "--save-every", "3"]);
    assert_eq!(output.status.code(), Some(2));
    let output = tunnelproof(&[
        "simulate",
        "basic-collision",
        "--save",
        "no/such/folder/state",
    ]);
    assert_eq!(output.status.code(), Some(2));
}

/// Ctrl-C ends a run that is saved after a whole step.
#[cfg(unix)]
#[test]
fn simulate_saves_when_it_is_interrupted() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [state, recording] = [path("state"), path("a.tps")];
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_tunnelproof"))
        .args(["simulate", "basic-collision", "--duration", "3600"])
        .args(["--save", &state, "--record", &recording])
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    // Until it is under way.
    while std::fs::metadata(&recording).map_or(0, |file| file.len()) < 10_000 {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    let kill = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert!(kill.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let saved = State::load(std::fs::read(&state).unwrap().as_slice()).unwrap();
    assert_eq!(
        saved.world.steps(),
        steps(Path::new(&recording)).len() as u64
    );
}

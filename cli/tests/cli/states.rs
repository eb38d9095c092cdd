//! `simulate --save` and `--from`, and `audit` of several recordings, as a user runs them.

use std::path::Path;

use serde_json::Value;
use tunnelproof::wire::recording::Recording;
use tunnelproof::wire::state::State;
use tunnelproof::wire::{Phases, StepRecord};
use tunnelproof_cli::scenes::EMBEDDED;

use crate::run::{PROGRAM, json, stderr, stdout, tunnelproof};

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
    let mut child = std::process::Command::new(PROGRAM)
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

//! What holds of every command: outputs that cannot be written, names that are unknown, `--help`.

use std::fs;
use std::io::Write;
use std::process::Stdio;

use crate::run::{CROSSING, MISS, code, command, file, stderr, stdout, tunnelproof};

#[test]
fn output_that_cannot_be_written_is_reported() {
    for arguments in [
        &["eval", "-"][..],
        &["certify", "--count", "10"],
        &["explain", "figure:4.1"],
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let mut child = command(arguments)
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
    let mut child = command(&["eval", &path])
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
    // Of families there are too many to name.
    let output = tunnelproof(&["certify", "--family", "latice"]);
    assert_eq!(code(&output), 2);
    assert!(stderr(&output).contains("'lattice'"));
}

#[test]
fn json_dash_is_the_standard_output_in_place_of_the_text() {
    let folder = tempfile::tempdir().unwrap();
    let short = ["simulate", "basic-collision", "--duration", "0.05"];
    let recording = folder.path().join("run.tps");
    let recording = recording.to_str().unwrap();
    tunnelproof(&[&short[..], &["--record", recording]].concat());
    for arguments in [
        &["certify", "--family", "lattice", "--count", "20"][..],
        &[
            "certify", "--family", "lattice", "--count", "20", "--shrink",
        ],
        &[
            "sweep",
            "--family",
            "lattice",
            "--count",
            "20",
            "--threshold",
            "t",
            "--steps",
            "3",
        ],
        &short,
        &["audit", recording],
    ] {
        let json = [arguments, &["--json", "-"]].concat();
        let output = command(&json).current_dir(folder.path()).output().unwrap();
        let printed = serde_json::from_slice::<serde_json::Value>(&output.stdout);
        assert!(printed.is_ok_and(|json| json.is_object()), "{arguments:?}");
        assert!(output.stdout.ends_with(b"}\n"), "{arguments:?}");
        assert!(!folder.path().join("-").exists(), "{arguments:?}");
    }
}

#[test]
fn help_and_version_are_there() {
    for command in [
        &["--help"][..],
        &["help", "eval"],
        &["certify", "--help"],
        &["explain", "-h"],
        &["advance", "--help"],
        &["mesh-step", "--help"],
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
fn shells_and_manuals_know_the_commands() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = tunnelproof(&["completions", shell]);
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        assert!(stdout(&output).contains("mesh-step"), "{shell}");
    }
    let folder = tempfile::tempdir().unwrap();
    let output = tunnelproof(&["man", folder.path().to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let page = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(page("tunnelproof.1").contains("certify"));
    assert!(page("tunnelproof-certify.1").contains("subject"));
    assert!(!folder.path().join("tunnelproof-lib-host.1").exists());
}

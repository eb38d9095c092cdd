//! What a package pulls in whose tests judge an engine of their own.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

/// At most this many lines of `cargo tree`.
const MOST: usize = 70;

#[test]
fn judge_pulls_in_few_packages_and_not_the_stepper() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let manifest = format!(
        "[package]\nname = \"judged\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\n\
         tunnelproof.path = {0:?}\ntunnelproof-reference.path = {1:?}\n",
        root,
        root.join("reference"),
    );
    fs::write(path("Cargo.toml"), manifest).unwrap();
    fs::create_dir(path("src")).unwrap();
    fs::write(path("src/lib.rs"), "").unwrap();
    fs::copy(root.join("Cargo.lock"), path("Cargo.lock")).unwrap();
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "-e", "normal", "--prefix", "none"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    let tree = String::from_utf8(output.stdout).unwrap();
    let lines: BTreeSet<&str> = tree.lines().collect();
    let has = |name: &str| lines.iter().any(|line| line.starts_with(name));
    assert!(lines.len() <= MOST, "{} packages: {lines:#?}", lines.len());
    assert!(
        has("tunnelproof-reference ") && !has("parry3d-f64 "),
        "{lines:#?}"
    );
}

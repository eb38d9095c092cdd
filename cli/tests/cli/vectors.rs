//! `vectors`: what is written, and that every difference is found.

use std::fs;

use crate::run::{assert_refused, code, file, stderr, stdout, tunnelproof};

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
    let output = tunnelproof(&["vectors", "--check", "--out", "no/such/folder"]);
    assert_refused(&output, "no/such/folder", None, "no such file");
}

//! `vectors`: what is written, and that every difference is found.

use std::fs;

use crate::run::{assert_refused, code, file, stderr, stdout, tunnelproof};

/// The vectors of the project are what would be written, and three differences in a copy of them are found.
/// That the files that are damaged here are right is a test beside the code.
#[test]
fn vectors_are_what_would_be_written_and_every_difference_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let at = |name: &str| format!("{path}/{name}");
    fs::create_dir(at("turning")).unwrap();
    for within in ["", "turning/"] {
        let from = format!("{}/../vectors/{within}", env!("CARGO_MANIFEST_DIR"));
        for entry in fs::read_dir(from).unwrap() {
            let entry = entry.unwrap();
            if entry.file_type().unwrap().is_file() {
                let name = entry.file_name().into_string().unwrap();
                fs::copy(entry.path(), at(within) + &name).unwrap();
            }
        }
    }
    let text = fs::read_to_string(at("figures.json")).unwrap();
    fs::write(at("figures.json"), text.replacen("true", "false", 1)).unwrap();
    fs::remove_file(at("errata.json")).unwrap();
    fs::write(at("more.json"), "{}").unwrap();
    fs::write(at("schema.json"), "{}").unwrap();
    let checked = tunnelproof(&["vectors", "--check", "--out", path]);
    assert_eq!(code(&checked), 1);
    let expected = [
        at("figures.json") + ": is not what would be written",
        at("errata.json") + ": is missing",
        at("more.json") + ": would not be written",
    ];
    assert_eq!(stderr(&checked).lines().collect::<Vec<_>>(), expected);
    assert!(!fs::exists(at("errata.json")).unwrap(), "a check writes");
}

#[test]
fn vectors_that_cannot_be_written_are_refused() {
    let (_folder, path) = file("taken", "");
    let output = tunnelproof(&["vectors", "--out", &path]);
    assert_refused(&output, &path, None, "cannot be written");
    let output = tunnelproof(&["vectors", "--check", "--out", "no/such/folder"]);
    assert_refused(&output, "no/such/folder", None, "no such file");
}

#[test]
fn vectors_are_packed_as_they_are_in_the_folder() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    fs::create_dir(at("from")).unwrap();
    for name in ["turning_more.json", "schema.json", "README.md", "notes.txt"] {
        fs::write(at("from") + "/" + name, name).unwrap();
    }
    let pack = |to: &str| tunnelproof(&["vectors", "--out", &at("from"), "--package", &at(to)]);
    let output = pack("to");
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    assert!(
        stdout(&output).starts_with("3 files as tunnelproof-vectors-"),
        "{}",
        stdout(&output)
    );
    for name in [
        "crate/data/turning_more.json.gz",
        "python/tunnelproof_vectors/data/turning_more.json.gz",
        "python/pyproject.toml",
    ] {
        assert!(fs::exists(at("to") + "/" + name).unwrap(), "{name}");
    }
    let archive = concat!("tunnelproof-vectors-", env!("CARGO_PKG_VERSION"), ".tar.gz");
    let read = |to: &str| fs::read(at(to) + "/" + archive).unwrap();
    pack("again");
    assert_eq!(read("to"), read("again"));
    fs::create_dir(at("empty")).unwrap();
    let none = tunnelproof(&["vectors", "--out", &at("empty"), "--package", &at("no")]);
    assert_refused(&none, &at("empty"), None, "no file of queries");
}

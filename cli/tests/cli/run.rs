//! Running the program, and what it said.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

pub(crate) const PROGRAM: &str = env!("CARGO_BIN_EXE_tunnelproof");

pub(crate) const ORIGIN: &str = "[0,0,0]";

/// Two edges that cross at t = 1/3.
pub(crate) const CROSSING: &str = r#"{"id":"a","kind":"edge-edge","points":[[0,0,0],[1,0,0],[0.5,-1,1],[0.5,1,1],[0,0,0],[1,0,0],[0.5,-1,-2],["0x1p-1",1,-2]]}"#;
/// Two edges that keep apart.
pub(crate) const MISS: &str = r#"{"id":"b","kind":"edge-edge","points":[[0,0,0],[1,0,0],[0,0,1],[1,0,1],[0,0,0],[1,0,0],[0,0,1],[1,0,1]]}"#;

/// The program with these arguments.
pub(crate) fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(PROGRAM);
    command.args(arguments);
    command
}

pub(crate) fn tunnelproof(arguments: &[&str]) -> Output {
    with_input(arguments, "")
}

pub(crate) fn with_input(arguments: &[&str], input: &str) -> Output {
    let mut child = command(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Whoever does not read the input may close it.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

pub(crate) fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

pub(crate) fn lines(output: &Output) -> Vec<Value> {
    let text = stdout(output);
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

pub(crate) fn json(path: impl AsRef<Path>) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// A file in a folder of its own.
pub(crate) fn file(name: &str, content: impl AsRef<[u8]>) -> (TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join(name);
    fs::write(&path, content).unwrap();
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

/// Ends with 2 and one line that starts with the path, a line number if there is one, and says
/// `what`.
pub(crate) fn assert_refused(output: &Output, path: &str, line: Option<u32>, what: &str) {
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

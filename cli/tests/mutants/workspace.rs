//! A copy of the sources that faults are planted in, and its builds.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::table::Mutant;

/// What the program needs to be built.
const SOURCES: [&str; 12] = [
    "Cargo.toml",
    "Cargo.lock",
    "src",
    "reference",
    "benches",
    "examples",
    "tests",
    "docs",
    "hosts",
    "cli",
    "c",
    "web",
];

/// A copy of the sources. It stays, with what is built from it, so that every mutant and every
/// later run costs one incremental build.
pub(crate) struct Workspace {
    folder: PathBuf,
}

/// What a command said.
#[derive(Debug)]
pub(crate) struct Said {
    /// `None` if it was ended, since it took too long or otherwise.
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
    pub(crate) time: Duration,
}

impl Workspace {
    /// Copies the sources as they are to a folder of this name.
    pub(crate) fn new(name: &str) -> Self {
        let root = super::root();
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::create_dir_all(&folder).expect("a folder can be made");
        for name in SOURCES {
            copy(&root.join(name), &folder.join(name));
        }
        Workspace { folder }
    }

    /// Whether Cargo finds every package of it.
    pub(crate) fn is_whole(&self) -> bool {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args([
            "metadata",
            "--no-deps",
            "--offline",
            "--format-version",
            "1",
        ]);
        let status = cargo
            .current_dir(&self.folder)
            .stdout(Stdio::null())
            .status();
        status.expect("cargo runs").success()
    }

    /// Plants a fault for as long as `work` runs.
    pub(crate) fn with<T>(&self, mutant: &Mutant, work: impl FnOnce() -> T) -> T {
        let path = self.folder.join(mutant.file);
        let sound = fs::read_to_string(&path).expect(mutant.file);
        let count = sound.matches(mutant.text).count();
        assert_eq!(count, 1, "times in {}: {}", mutant.file, mutant.text);
        fs::write(&path, sound.replace(mutant.text, mutant.replacement)).expect(mutant.file);
        let result = work();
        fs::write(&path, sound).expect(mutant.file);
        result
    }

    /// Builds the program: what it depends on as ever, its own sources quickly rather than fast.
    pub(crate) fn build(&self) {
        let quick = ["tunnelproof", "tunnelproof-reference", "tunnelproof-cli"]
            .map(|package| format!("profile.release.package.{package}.opt-level=0"));
        let status = Command::new(env!("CARGO"))
            .args(["build", "--release", "--offline", "--quiet"])
            .args(["--package", "tunnelproof-cli", "--bin", "tunnelproof"])
            .args(quick.iter().flat_map(|setting| ["--config", setting]))
            .current_dir(&self.folder)
            .env("CARGO_TARGET_DIR", self.folder.join("target"))
            .env("CARGO_INCREMENTAL", "1")
            .status();
        assert!(status.expect("cargo runs").success(), "a mutant compiles");
    }

    /// Runs the program that was built, for at most `longest`.
    pub(crate) fn run(&self, arguments: &[&str], longest: Duration) -> Said {
        let output = |name: &str| self.folder.join(name);
        let file = |name| Stdio::from(File::create(output(name)).expect("a file can be written"));
        let start = Instant::now();
        let mut child = Command::new(output("target/release/tunnelproof"))
            .args(arguments)
            .stdout(file("stdout"))
            .stderr(file("stderr"))
            .spawn()
            .expect("the program starts");
        let status = loop {
            match child.try_wait().expect("the program is there") {
                Some(status) => break status,
                None if start.elapsed() < longest => {
                    std::thread::sleep(Duration::from_millis(10));
                }
                None => child.kill().expect("the program can be ended"),
            }
        };
        let read = |name| fs::read_to_string(output(name)).expect("text");
        Said {
            code: status.code(),
            stdout: read("stdout"),
            stderr: read("stderr"),
            time: start.elapsed(),
        }
    }
}

/// Copies what differs, so that Cargo sees no change where there is none.
fn copy(from: &Path, to: &Path) {
    if from.is_dir() {
        fs::create_dir_all(to).expect("a folder can be made");
        for entry in fs::read_dir(from).expect("the folder is there") {
            let name = entry.expect("the folder is there").file_name();
            copy(&from.join(&name), &to.join(&name));
        }
        return;
    }
    let text = fs::read(from).expect("the file is there");
    if fs::read(to).ok().as_ref() != Some(&text) {
        fs::write(to, text).expect("the file can be written");
    }
}

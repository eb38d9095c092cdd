//! `replay`: what a fuzz target finds in the bytes of a file.

use std::path::Path;
use std::process::ExitCode;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use tunnelproof_cli::fuzz::{self, TARGETS, Target};
use tunnelproof_reference::corpus::jsonl::{self, Numbers};
use tunnelproof_reference::corpus::{CorpusError, Entry, Problem};

use super::Failure;
use super::output::print;

/// Show again what a fuzz target finds in the bytes of files
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof replay fuzz/artifacts/oracle_vs_shadow/crash-0a1b2c
  tunnelproof replay fuzz/corpus/thesis_vs_shadow
  tunnelproof replay --target parsers bytes

For each file, or each file in a folder: what is found, with the query, everyone's answer, the smallest query that shows the same
and the commands that explain both; or that nothing is found. Exit code 1 if anything is.")]
pub(super) struct Replay {
    /// Files of bytes, as the fuzzer writes them, or folders of such files
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Which target; by default the one that the file's folder is called after
    #[arg(long, value_parser = target())]
    target: Option<&'static Target>,
}

impl Replay {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let mut code = ExitCode::SUCCESS;
        for path in &files(&self.files)? {
            let target = match self.target.or_else(|| target_of(path)) {
                Some(target) => target,
                None => return Err(Failure::Target(path.clone())),
            };
            let bytes =
                std::fs::read(path).map_err(|error| CorpusError::new(path, Problem::Io(error)))?;
            match target.run(&bytes) {
                Ok(()) => print(&nothing(path, target, &bytes))?,
                Err(finding) => {
                    print(&format!("{path}: {finding}"))?;
                    code = ExitCode::FAILURE;
                }
            }
        }
        Ok(code)
    }
}

/// The paths, and instead of a folder the files in it, in the order of their names.
fn files(paths: &[String]) -> Result<Vec<String>, CorpusError> {
    let mut files = Vec::new();
    for path in paths {
        let failed = |error| CorpusError::new(path, Problem::Io(error));
        if !Path::new(path).is_dir() {
            files.push(path.clone());
            continue;
        }
        let entries = std::fs::read_dir(path).map_err(failed)?;
        let names: Result<Vec<_>, _> = entries
            .map(|entry| entry.map(|entry| entry.path()))
            .collect();
        let mut names = names.map_err(failed)?;
        names.sort();
        files.extend(names.iter().map(|name| name.to_string_lossy().into_owned()));
    }
    Ok(files)
}

fn nothing(path: &str, target: &Target, bytes: &[u8]) -> String {
    let line = target.query(bytes).map_or_else(String::new, |query| {
        let entry = Entry::unlabelled(path, query);
        jsonl::write(&entry, Numbers::Decimal) + "\n"
    });
    format!("{path}: {} finds nothing\n{line}", target.name)
}

/// By the name of the folder that the file is in.
fn target_of(path: &str) -> Option<&'static Target> {
    let folder = Path::new(path).parent()?.file_name()?;
    fuzz::by_name(folder.to_str()?)
}

fn target() -> impl TypedValueParser<Value = &'static Target> {
    PossibleValuesParser::new(TARGETS.iter().map(|target| target.name))
        .try_map(|name| fuzz::by_name(&name).ok_or("unknown target"))
}

//! `merge`: the parts of one certification put together.

use std::path::Path;
use std::process::ExitCode;

use clap::Args;
use tunnelproof_reference::corpus::{CorpusError, Problem};
use tunnelproof_reference::report::merge::{self, Kept};
use tunnelproof_reference::report::results::Results;

use super::Failure;
use super::certificate::Certificate;

/// Put the results of the shards of one certification together
#[derive(Args)]
#[command(after_help = "\
Examples:
  for i in 1 2 3 4; do tunnelproof certify --shard $i/4 --json part-$i.json; done
  tunnelproof merge part-*.json --json all.json --html all.html

What comes out is what certify gives without --shard, to the last byte; of programs, how often they were
started is added up. Every shard has to be there, once, and of the same command and version.")]
pub(super) struct Merge {
    /// The files that certify --shard --json wrote
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    #[command(flatten)]
    certificate: Certificate,
}

impl Merge {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let parts: Vec<_> = (self.files.iter())
            .map(|path| Ok((path.as_str(), read(path)?)))
            .collect::<Result<_, Failure>>()?;
        let merged = merge::merge(parts).map_err(|(path, error)| Failure::merge(path, error))?;
        let findings = merged.findings();
        self.certificate
            .prepare(&findings.panel)?
            .write(&findings)?;
        Ok(self.certificate.code(&findings))
    }
}

/// The result in a file.
pub(super) fn read(path: &str) -> Result<Kept, Failure> {
    let unreadable = |error| CorpusError::new(path, Problem::Io(error));
    let text = std::fs::read_to_string(path).map_err(unreadable)?;
    let kept = Results::read(&text).and_then(|results| Kept::new(&results));
    kept.map_err(|error| Failure::merge(path, error))
}

/// The result in a file, if there is one.
pub(super) fn read_if_there(path: &Path) -> Result<Option<Kept>, Failure> {
    match path.is_file() {
        true => read(&path.display().to_string()).map(Some),
        false => Ok(None),
    }
}

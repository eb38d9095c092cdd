//! `audit`: a recording, checked for missed tunnels.

use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;
use tunnelproof::wire::recording::Recording;
use tunnelproof_cli::audit::Audit as Auditor;
use tunnelproof_cli::replay::{self, Replay};
use tunnelproof_cli::report::audit;

use super::output::{JsonOutput, OutputFile, shell};
use super::{Failure, progress};

/// Check a recording of a simulation for missed tunnels by the exact oracle
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof simulate basic-collision --record run.tps
  tunnelproof audit run.tps
  tunnelproof audit run.tps --exact --json -
  tunnelproof audit run.tps --replay run.html

Every pair of segments whose swept boxes meet, in every step and every change of resolution, of one wire too. Exit code
1 if anything passed unnoticed, or stands or may stand on the wrong side at the end.")]
pub(super) struct Audit {
    /// The recording
    recording: PathBuf,
    /// Fail as well if a time of impact is not exact, or a contact is none
    #[arg(long)]
    exact: bool,
    /// Write what was found to this file, as JSON; - is the standard output, in place of the text
    #[arg(long, value_name = "OUT")]
    json: Option<PathBuf>,
    /// Write a page to watch the run, what was found marked on it, to this file
    #[arg(long, value_name = "OUT")]
    replay: Option<PathBuf>,
}

impl Audit {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let json = JsonOutput::create(self.json.as_deref())?;
        let page = self.replay.as_deref().map(OutputFile::create).transpose()?;
        let mut replay = page.is_some().then(|| self.empty_page()).transpose()?;
        let recording = self.open()?;
        let mut auditor = Auditor::of_recording(recording.header());
        progress::counting("steps", |done| {
            for record in recording {
                let record = record.map_err(|error| self.wrong(error))?;
                auditor.step(&record);
                if let Some(replay) = &mut replay {
                    replay.step(&record);
                }
                done(1);
            }
            Ok::<(), Failure>(())
        })?;
        let report = auditor.finish();
        if let Some((page, replay)) = page.zip(replay) {
            let runs = [replay.audited(&report)];
            page.write(&replay::page(&runs).map_err(no_json)?)?;
        }
        json.write(|| as_json(&report), || audit::text(&report, &shell()))?;
        let good = if self.exact {
            report.is_exact()
        } else {
            report.is_clean()
        };
        Ok(if good {
            ExitCode::SUCCESS
        } else {
            ExitCode::FAILURE
        })
    }

    fn open(&self) -> Result<Recording<BufReader<File>>, Failure> {
        let file = File::open(&self.recording).map_err(|error| self.wrong(error))?;
        Recording::open(BufReader::new(file)).map_err(|error| self.wrong(error))
    }

    /// A page that the steps are still to be added to, called after the file. It has to know how many there are.
    fn empty_page(&self) -> Result<Replay, Failure> {
        let recording = self.open()?;
        let header = recording.header().clone();
        let title = self.recording.file_stem().unwrap_or_default();
        let steps = recording.count() as u64;
        Ok(Replay::new(&title.to_string_lossy(), header, steps))
    }

    fn wrong(&self, error: impl ToString) -> Failure {
        Failure::File {
            path: self.recording.display().to_string(),
            problem: error.to_string(),
        }
    }
}

/// A document as JSON, with a line end.
pub(super) fn as_json(document: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(document).map_err(no_json)?;
    Ok(text + "\n")
}

/// That something cannot be written as JSON.
pub(super) fn no_json(error: serde_json::Error) -> Failure {
    Failure::Output {
        name: "JSON".to_owned(),
        error: error.into(),
    }
}

//! `audit`: a recording, checked for missed tunnels.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;
use tunnelproof_cli::audit::Audit as Auditor;
use tunnelproof_cli::replay::{self, Replay};
use tunnelproof_cli::report::audit;

use super::output::{JsonOutput, OutputFile, shell};
use super::recordings::Recordings;
use super::{Failure, progress};

/// Check a recording of a simulation for missed tunnels by the exact oracle
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof simulate basic-collision --record run.tps
  tunnelproof audit run.tps
  tunnelproof audit run.tps --exact --json -
  tunnelproof audit run.tps --replay run.html
  tunnelproof audit monday.tps tuesday.tps

Every pair of segments whose swept boxes meet, in every step and every change of resolution, of one wire too. Exit code
1 if anything passed unnoticed, or stands or may stand on the wrong side at the end.")]
pub(super) struct Audit {
    /// The recording, or several of one run that was stopped and went on, in their order: each is read
    /// as far as the next one starts
    #[arg(required = true)]
    recordings: Vec<PathBuf>,
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
        let mut recordings = Recordings::open(&self.recordings)?;
        let mut auditor = Auditor::of_recording(recordings.header());
        progress::counting("steps", |done| {
            while let Some(record) = recordings.next_step()? {
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

    /// A page that the steps are still to be added to, called after the first file. It has to know how many there are.
    fn empty_page(&self) -> Result<Replay, Failure> {
        let mut recordings = Recordings::open(&self.recordings)?;
        let header = recordings.header().clone();
        let title = self.recordings[0].file_stem().unwrap_or_default();
        let mut steps = 0;
        while recordings.next_step()?.is_some() {
            steps += 1;
        }
        Ok(Replay::new(&title.to_string_lossy(), header, steps))
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

//! What `certify` and `merge` write.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use tunnelproof_cli::report::{badge, junit, page};
use tunnelproof_reference::certify::findings::Findings;
use tunnelproof_reference::certify::run::Panel;
use tunnelproof_reference::certify::strict::failures;
use tunnelproof_reference::certify::table::{self, Shown};
use tunnelproof_reference::report::results::Results;

use super::Failure;
use super::output::{JsonOutput, OutputFile, is_standard_output, paint, print};

/// Where the findings are written, and whether they decide the exit code.
#[derive(Args)]
pub(super) struct Certificate {
    /// Write the whole result to this file, as JSON; - is the standard output, in place of the tables
    #[arg(long, value_name = "OUT")]
    pub(super) json: Option<PathBuf>,
    /// Write the certificate to this file: a page with pictures of the worst; it needs no network
    #[arg(long, value_name = "OUT")]
    html: Option<PathBuf>,
    /// Write what passes and what fails to this file, as JUnit XML
    #[arg(long, value_name = "OUT")]
    junit: Option<PathBuf>,
    /// Write a badge that says whether the one subject passes to this file, as SVG
    #[arg(long, value_name = "OUT")]
    badge: Option<PathBuf>,
    /// Also print every family, all witnesses and the errata
    #[arg(long)]
    details: bool,
    /// Exit with 1 unless every subject passes and all judges and labels agree
    #[arg(long)]
    pub(super) strict: bool,
}

/// The files, seen to be writable.
pub(super) struct Prepared {
    json: JsonOutput,
    html: Option<OutputFile>,
    junit: Option<OutputFile>,
    badge: Option<OutputFile>,
    shown: Shown,
}

impl Certificate {
    /// Sees to it that the files can be made.
    ///
    /// # Errors
    ///
    /// A file that cannot be written, or a badge for several subjects.
    pub(super) fn prepare(&self, panel: &Panel) -> Result<Prepared, Failure> {
        if self.badge.is_some() && panel.subjects.len() != 1 {
            let count = panel.subjects.len();
            let problem = format!("is about one subject, and {count} are judged");
            return Err(Failure::file("--badge", problem));
        }
        let file = |path: &Option<PathBuf>| path.as_deref().map(OutputFile::create).transpose();
        Ok(Prepared {
            json: JsonOutput::create(self.json.as_deref())?,
            html: file(&self.html)?,
            junit: file(&self.junit)?,
            badge: file(&self.badge)?,
            shown: self.shown(),
        })
    }

    /// How much is printed.
    pub(super) fn shown(&self) -> Shown {
        Shown {
            details: self.details,
            paint: paint(),
        }
    }
}

impl Prepared {
    /// Writes the findings, to the standard output as well.
    pub(super) fn write(self, findings: &Findings) -> Result<(), Failure> {
        if let Some(file) = self.html {
            file.write(&page::certificate(findings))?;
        }
        if let Some(file) = self.junit {
            file.write(&junit::text(findings))?;
        }
        if let Some(file) = self.badge {
            file.write(&badge::draw(findings))?;
        }
        self.json.write(
            || Ok(Results::new(findings).text()),
            || table::text(findings, self.shown) + hint(self.shown),
        )
    }
}

/// How to see more.
fn hint(shown: Shown) -> &'static str {
    match shown.details {
        true => "",
        false => "\n--details shows every family; --html FILE writes all of it as a page.\n",
    }
}

impl Certificate {
    /// Prints lines after the certificate: to the standard error where the standard output is JSON.
    pub(super) fn print_after(&self, text: &str) -> Result<(), Failure> {
        if self.json.as_deref().is_some_and(is_standard_output) {
            eprint!("{text}");
            return Ok(());
        }
        print(text)
    }

    /// How the command ends.
    pub(super) fn code(&self, findings: &Findings) -> ExitCode {
        let failures = failures(&findings.panel, &findings.total);
        if !self.strict || failures.is_empty() {
            return ExitCode::SUCCESS;
        }
        failures
            .iter()
            .for_each(|failure| eprintln!("--strict: {failure}"));
        ExitCode::FAILURE
    }
}

//! `table`: the tables of the thesis' chapter 4 beside ours.

use std::process::ExitCode;

use clap::{Args, ValueEnum};
use tunnelproof_reference::perturb;
use tunnelproof_reference::tables::{cases, missed, rows, scenes, speeds, starts, times};

use super::Failure;
use super::output::print;

/// Print a table of the thesis beside ours
///
/// Exit code 1 if a row of `rows` does not hold.
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof table 4.1
  tunnelproof table rows
  tunnelproof table missed --duration 1
  tunnelproof table speeds --duration 0.5")]
pub(super) struct Table {
    #[arg(value_enum)]
    table: Which,
    /// Run no scene for longer than this, in s; `rows` are of whole scenes
    #[arg(long, value_name = "S", default_value_t = f64::INFINITY, hide_default_value = true)]
    duration: f64,
}

#[derive(Clone, Copy, ValueEnum)]
enum Which {
    /// Which cases occur in each scene
    #[value(name = "4.1")]
    Cases,
    /// Run time of continuous detection against discrete at the largest step that does not tunnel, from one start and from eleven
    #[value(name = "4.2")]
    Times,
    /// What the thesis says of each scene beside what comes out, and whether that is accepted
    Rows,
    /// Tunnels missed by each narrow phase, by the audit
    Missed,
    /// The first scene at 1 to 200 m/s
    Speeds,
    /// Guard mode from ten starts moved by up to a millimetre, by the audit
    Starts,
}

/// How many perturbed starts each scene has.
const STARTS: u64 = 10;

impl Table {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let text = match self.table {
            Which::Cases => cases(&scenes(self.duration)?)?,
            Which::Times => times(&scenes(self.duration)?, STARTS, perturb::USUAL)?,
            Which::Rows if self.duration.is_finite() => {
                return Err(Failure::File {
                    path: "--duration".to_owned(),
                    problem: "rows are of whole scenes".to_owned(),
                });
            }
            Which::Rows => {
                let (text, hold) = rows();
                print(&text)?;
                return Ok(if hold {
                    ExitCode::SUCCESS
                } else {
                    ExitCode::FAILURE
                });
            }
            Which::Missed => missed(&scenes(self.duration)?)?,
            Which::Speeds => speeds(self.duration)?,
            Which::Starts => starts(&scenes(self.duration)?, STARTS, perturb::USUAL)?,
        };
        print(&text)?;
        Ok(ExitCode::SUCCESS)
    }
}

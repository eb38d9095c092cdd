//! `table`: the tables of the thesis' chapter 4 beside ours.

use std::process::ExitCode;

use clap::{Args, ValueEnum};
use tunnelproof_cli::perturb;
use tunnelproof_cli::tables::{
    OfThesis, cases, chances, missed, rows, scenes, speeds, starts, times,
};

use super::Failure;
use super::output::print;

/// Print a table of the thesis beside ours
///
/// Exit code 1 if a row of `rows` does not hold.
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof table 4.1
  tunnelproof table 4.2 --starts 100 --scene chains-on-deck
  tunnelproof table rows
  tunnelproof table missed --duration 1
  tunnelproof table speeds --duration 0.5")]
pub(super) struct Table {
    #[arg(value_enum)]
    table: Which,
    /// Run no scene for longer than this, in s; `rows` are of whole scenes
    #[arg(long, value_name = "S", default_value_t = f64::INFINITY, hide_default_value = true)]
    duration: f64,
    /// How many perturbed starts `4.2`, `chances` and `starts` look at beside the scene as it is
    /// [default: 10]
    #[arg(long, value_name = "N")]
    starts: Option<u64>,
    /// Only one scene of the thesis, by its name; not for `rows` and `speeds`
    #[arg(long, value_name = "NAME")]
    scene: Option<String>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Which {
    /// Which cases occur in each scene
    #[value(name = "4.1")]
    Cases,
    /// Run time of continuous detection against discrete at the largest step that does not tunnel:
    /// from one start, and from others as well, moved by up to the radius of a wire
    #[value(name = "4.2")]
    Times,
    /// What the thesis says of each scene beside what comes out, and whether that is accepted
    Rows,
    /// From how many starts, moved by up to the radius of a wire, discrete detection lets a wire
    /// through, at steps of 1 to 16 ms
    Chances,
    /// Tunnels missed by each narrow phase, by the audit
    Missed,
    /// The first scene at 1 to 200 m/s
    Speeds,
    /// Guard mode from starts moved by up to a millimetre, by the audit
    Starts,
}

/// How many perturbed starts each scene has if nothing else is said.
const STARTS: u64 = 10;

impl Table {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let perturbs = matches!(self.table, Which::Times | Which::Chances | Which::Starts);
        if self.starts.is_some() && !perturbs {
            return Err(refused("--starts", "this table has no perturbed starts"));
        }
        let count = self.starts.unwrap_or(STARTS);
        let text = match self.table {
            Which::Cases => cases(&self.scenes()?)?,
            Which::Times => times(&self.scenes()?, count)?,
            Which::Chances => chances(&self.scenes()?, count)?,
            Which::Missed => missed(&self.scenes()?)?,
            Which::Starts => starts(&self.scenes()?, count, perturb::USUAL)?,
            Which::Rows | Which::Speeds if self.scene.is_some() => {
                return Err(refused("--scene", "this table has no choice of scenes"));
            }
            Which::Speeds => speeds(self.duration)?,
            Which::Rows if self.duration.is_finite() => {
                return Err(refused("--duration", "rows are of whole scenes"));
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
        };
        print(&text)?;
        Ok(ExitCode::SUCCESS)
    }

    fn scenes(&self) -> Result<Vec<OfThesis>, Failure> {
        Ok(scenes(self.duration, self.scene.as_deref())?)
    }
}

/// An option that does not go with the table.
fn refused(option: &str, problem: &str) -> Failure {
    Failure::file(option, problem)
}

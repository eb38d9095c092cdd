//! `gap`: how near the two sides of a query come to each other.

use std::process::ExitCode;

use clap::Args;
use tunnelproof_reference::corpus::locate::locate;
use tunnelproof_reference::corpus::turning;
use tunnelproof_reference::oracle::least_gap_to;

use super::output::print;
use super::{Failure, Reading, not_negative};

/// Enclose the least distance during the step of one query, beyond its radius
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof gap figure:4.7
  tunnelproof gap figure:4.7 --radius 0.01+0.003
  tunnelproof gap --width 1e-15 'unit-tests/vertex-face/data_0_0.csv#12'
  tunnelproof gap turning_plates:1:6
  tunnelproof gap --turning 'queries.jsonl#a'

Two numbers in metres, between which the gap is: the least distance during the step less the radius; 0
twice for a hit. Both bounds are proved. Where f64 has no two numbers that are so near to each other,
they are neighbours.")]
pub(super) struct Gap {
    /// figure:NAME, FAMILY:SEED:INDEX, PATH.csv#INDEX, PATH.jsonl#ID, or - for a line on the
    /// standard input
    query: String,
    /// How far the two numbers may be apart, in metres
    #[arg(long, value_name = "W", default_value = "1e-9", value_parser = not_negative, allow_negative_numbers = true)]
    width: f64,
    /// PATH#ID and - are of queries of bodies that turn; families of them are known by name
    #[arg(long, conflicts_with_all = ["kind", "radius"])]
    turning: bool,
    #[command(flatten)]
    reading: Reading,
}

impl Gap {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let gap = match self.reading.is_turning(self.turning, &self.query)? {
            true => least_gap_to(&turning::locate(&self.query)?.query, self.width),
            false => least_gap_to(
                &locate(&self.query, self.reading.options())?.query,
                self.width,
            ),
        };
        print(&format!("{} {}\n", gap.below, gap.above))?;
        Ok(ExitCode::SUCCESS)
    }
}

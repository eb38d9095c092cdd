//! `advance`: how far the two sides of each query may move, and the points to store.

use std::io::{self, BufWriter};
use std::process::ExitCode;

use clap::Args;
use serde::Serialize;
use tunnelproof::certified::{Clearance, ClearanceError, Precision, advance_in};
use tunnelproof::query::Query;
use tunnelproof_cli::report::step::{blocked_name, rounded_down};
use tunnelproof_reference::certify::batch::map_in_order;
use tunnelproof_reference::corpus::locate::locate;
use tunnelproof_reference::corpus::{self, Entries, Entry, Format, ReadOptions};

use super::eval::write_lines;
use super::keep::{Keep, precision};
use super::{Failure, Reading};

/// Find the largest step of each query that is proved to touch nothing, and the points to store
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof advance queries.jsonl
  tunnelproof advance --clearance 0.001 --kind edge-edge unit-tests/edge-edge/*.csv
  tunnelproof advance figure:4.3 lattice:1:4711
  tunnelproof advance --precision f32 queries.jsonl
  head -1 queries.jsonl | tunnelproof advance -

A line of JSON for each query:
  {\"id\": \"a\", \"step\": 0.4, \"points\": [[0, 0, 0], ...], \"kept\": 0, \"blocked\": \"ahead\"}
step is how much of the motion is made, from 0 to 1. points are A B C D to store. Straight motion
from the start to them keeps a distance above kept. kept is null if no step is proved, so that the
points stay.

blocked is null for a whole step. ahead: a larger step would come too near. near: the two start so
near to what is kept that rounding has no room; the largest of a few steps that is proved is made, or
none. touching: they touch at the start.")]
pub(super) struct Advance {
    /// Files of queries (.jsonl, .json or .csv); - is the standard input. Or single queries:
    /// figure:NAME, FAMILY:SEED:INDEX, PATH.csv#INDEX, PATH.jsonl#ID, PATH.json#ID
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    #[command(flatten)]
    keep: Keep,
    /// Store positions in these numbers. With f32, coordinates that start at an f32 are stored as
    /// f32, and those at the end are rounded to f32 first
    #[arg(long, value_name = "PRECISION", default_value = "f64", value_parser = precision())]
    precision: Precision,
    #[command(flatten)]
    reading: Reading,
}

#[derive(Serialize)]
struct Line<'a> {
    id: &'a str,
    step: f64,
    points: [[f64; 3]; 4],
    kept: Option<f64>,
    blocked: Option<&'static str>,
}

impl Advance {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let (clearance, precision) = (self.keep.clearance(), self.precision);
        let mut output = BufWriter::new(io::stdout().lock());
        for file in &self.files {
            let entries = entries(file, self.reading.options())?;
            map_in_order(
                entries.map(|entry| entry.map_err(Failure::from)),
                |entry| Ok(line(&entry, clearance, precision)?),
                |lines: Vec<String>| write_lines(&mut output, &lines),
            )?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// The queries of a file, or the one that an identifier names.
fn entries(name: &str, options: ReadOptions) -> Result<Entries, Failure> {
    if name == "-" || Format::of_path(name).is_some() {
        return Ok(corpus::open(name, options)?);
    }
    let entry = locate(name, options)?;
    Ok(Box::new(std::iter::once(Ok(entry))))
}

fn line(
    entry: &Entry,
    clearance: Clearance,
    precision: Precision,
) -> Result<String, ClearanceError> {
    let moved = match &entry.query {
        Query::EdgeEdge(query) => advance_in(query, clearance, precision)?,
        Query::VertexFace(query) => advance_in(query, clearance, precision)?,
    };
    let line = Line {
        id: &entry.id,
        step: moved.step,
        points: moved.points.map(Into::into),
        kept: moved.kept.map(rounded_down),
        blocked: moved.blocked.map(blocked_name),
    };
    Ok(serde_json::to_string(&line).expect("fields of text and numbers are JSON"))
}

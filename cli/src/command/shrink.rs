//! `shrink`: the smallest query on which a subject is wrong in the same way.

use std::process::ExitCode;
use std::slice;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use tunnelproof::narrow::Unsupported;
use tunnelproof_reference::certify::run::RunError;
use tunnelproof_reference::corpus::locate::locate;
use tunnelproof_reference::corpus::{self, CorpusError, Entries};
use tunnelproof_reference::registry;
use tunnelproof_reference::shrink::{Disagreement, MOST_CALLS, Truth};

use super::output::print;
use super::subjects::{Asked, Permit, Programs, asked};
use super::{Failure, Reading};

/// Find the smallest query on which a subject is wrong in the same way
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof shrink --subject thesis lattice:1:12311
  tunnelproof shrink --subject additive uniform:1:8 | tunnelproof explain -
  tunnelproof shrink --subject thesis < queries.jsonl

What is wrong is one of the faults that certify counts: a tunnel, a missed graze, a false hit, a near
hit, no answer, a wrong case, a time of impact that is late or early beyond what the subject is
permitted. Of several, the first in this order is kept. Numbers lose bits, become integers, the same
or 0, offsets go, points come to rest, as long as that fault is there.

The query is printed as a line that eval and explain read; what was done stands on the standard error.
Of several queries the first on which the subject is wrong is taken. Exit code 1 if there is none.")]
pub(super) struct Shrink {
    /// figure:NAME, FAMILY:SEED:INDEX, PATH.csv#INDEX, PATH.jsonl#ID, PATH.json#ID of a test
    /// vector, or
    /// - for the standard input
    #[arg(default_value = "-")]
    query: String,
    /// Who is wrong: a subject by its name, cmd: and the command of a program, or lib: and the path
    /// of a shared library
    #[arg(long, value_parser = asked)]
    subject: Asked,
    #[command(flatten)]
    programs: Programs,
    #[command(flatten)]
    permit: Permit,
    /// Who is right
    #[arg(long, default_value = "oracle", value_parser = truth())]
    truth: NamedTruth,
    /// How many queries are tried at most
    #[arg(long, value_name = "N", default_value_t = MOST_CALLS)]
    calls: u64,
    #[command(flatten)]
    reading: Reading,
}

/// What follows the name of a query in that of the smallest one found.
const SHRUNK: &str = "/shrunk";

impl Shrink {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let mut answering = self.programs.start(&self.subject)?;
        self.permit.grant(slice::from_mut(&mut answering))?;
        let disagreement = Disagreement {
            subject: answering.subject(),
            truth: self.truth.truth,
        };
        for entry in self.entries()? {
            let entry = entry?;
            let refused = |reason: Unsupported| RunError::NoAnswer {
                place: format!("{}: {} as the truth", entry.id, self.truth.name),
                reason: reason.into(),
            };
            let Some(fault) = disagreement.fault(&entry.query).map_err(refused)? else {
                continue;
            };
            let shrunk = disagreement.shrink(&entry.query, fault, self.calls);
            eprintln!("{}: {}: {shrunk}", entry.id, fault.name());
            let id = entry.id.strip_suffix(SHRUNK).unwrap_or(&entry.id);
            print(&format!("{}\n", shrunk.line(&format!("{id}{SHRUNK}"))))?;
            return Ok(ExitCode::SUCCESS);
        }
        eprintln!(
            "{}: {} is right, there is nothing to shrink",
            self.query,
            answering.subject().name()
        );
        Ok(ExitCode::FAILURE)
    }

    fn entries(&self) -> Result<Entries, CorpusError> {
        let options = self.reading.options();
        match self.query.as_str() {
            "-" => corpus::open("-", options),
            identifier => Ok(Box::new(std::iter::once(locate(identifier, options)))),
        }
    }
}

/// Who is right, by name.
#[derive(Clone, Copy)]
struct NamedTruth {
    name: &'static str,
    truth: Truth,
}

fn truth() -> impl TypedValueParser<Value = NamedTruth> {
    PossibleValuesParser::new(registry::truths().map(|(name, _)| name)).try_map(|asked| {
        let mut truths = registry::truths().into_iter();
        let named = truths.find(|(name, _)| *name == asked);
        named
            .map(|(name, truth)| NamedTruth { name, truth })
            .ok_or("unknown truth")
    })
}

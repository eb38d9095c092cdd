//! `shrink`: the smallest query on which a subject is wrong in the same way.

use std::iter;
use std::process::ExitCode;
use std::slice;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use tunnelproof::narrow::Unsupported;
use tunnelproof_reference::certify::query::AnyQuery;
use tunnelproof_reference::certify::run::RunError;
use tunnelproof_reference::corpus::locate::locate;
use tunnelproof_reference::corpus::{self, CorpusError, turning};
use tunnelproof_reference::registry;
use tunnelproof_reference::shrink::{Disagreement, MOST_CALLS, Shrunk, Truth};

use super::output::print;
use super::subjects::{Asked, Permit, Programs, asked, check_turning};
use super::{Failure, Reading};

/// Find the smallest query on which a subject is wrong in the same way
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof shrink --subject thesis lattice:1:12311
  tunnelproof shrink --subject additive uniform:1:8 | tunnelproof explain -
  tunnelproof shrink --subject 'cmd:./my_ccd' turning_plates:1:6
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
    /// PATH#ID and - are of queries of bodies that turn; families of them are known by name
    #[arg(long, conflicts_with_all = ["kind", "radius"])]
    turning: bool,
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
        let is_turning = self.reading.is_turning(self.turning, &self.query)?;
        if is_turning {
            check_turning(slice::from_ref(&answering))?;
        }
        let disagreement = Disagreement {
            subject: answering.subject(),
            truth: self.truth.truth,
        };
        let mut is_asked = false;
        for entry in self.entries(is_turning)? {
            let (id, query) = entry?;
            let refused = |reason: Unsupported| RunError::NoAnswer {
                place: format!("{id}: {} as the truth", self.truth.name),
                reason: reason.into(),
            };
            let Some(fault) = disagreement.fault(&query).map_err(refused)? else {
                is_asked = is_asked || disagreement.is_asked(&query);
                continue;
            };
            let name = format!("{}{SHRUNK}", id.strip_suffix(SHRUNK).unwrap_or(&id));
            let [found, line] = match &query {
                AnyQuery::Linear(query) => {
                    found(&disagreement.shrink(query, fault, self.calls), &name)
                }
                AnyQuery::Turning(query) => {
                    found(&disagreement.shrink(query, fault, self.calls), &name)
                }
            };
            eprintln!("{id}: {}: {found}", fault.name());
            print(&format!("{line}\n"))?;
            return Ok(ExitCode::SUCCESS);
        }
        let name = answering.subject().name();
        match is_asked {
            true => eprintln!(
                "{}: {name} is right, there is nothing to shrink",
                self.query
            ),
            false => eprintln!("{}: {name} takes no such queries", self.query),
        }
        Ok(ExitCode::FAILURE)
    }

    fn entries(&self, is_turning: bool) -> Result<Named, CorpusError> {
        let options = self.reading.options();
        Ok(match (is_turning, self.query.as_str()) {
            (true, "-") => {
                let entries = turning::open("-")?;
                Box::new(entries.map(|entry| entry.map(|entry| (entry.id, entry.query.into()))))
            }
            (true, identifier) => {
                let entry = turning::locate(identifier)?;
                Box::new(iter::once(Ok((entry.id, entry.query.into()))))
            }
            (false, "-") => {
                let entries = corpus::open("-", options)?;
                Box::new(entries.map(|entry| entry.map(|entry| (entry.id, entry.query.into()))))
            }
            (false, identifier) => {
                let entry = locate(identifier, options)?;
                Box::new(iter::once(Ok((entry.id, entry.query.into()))))
            }
        })
    }
}

/// Queries with what each is known by.
type Named = Box<dyn Iterator<Item = Result<(String, AnyQuery), CorpusError>>>;

/// What was found in a few words, and the query as a line.
fn found<Q: Copy + Into<AnyQuery>>(shrunk: &Shrunk<Q>, id: &str) -> [String; 2] {
    [shrunk.to_string(), shrunk.line(id)]
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

//! `slowest`: the queries that a subject takes longest on.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use clap::Args;
use serde_json::{Value, json};
use tunnelproof::query::Query;
use tunnelproof_reference::certify::query::AnyQuery;
use tunnelproof_reference::certify::table;
use tunnelproof_reference::corpus::jsonl::Numbers;
use tunnelproof_reference::generate::{self, Family};
use tunnelproof_reference::shrink::Disagreement;
use tunnelproof_reference::slowest::{Costly, Search, time};
use tunnelproof_reference::subject::NoAnswer;

use super::Failure;
use super::keeping::{interrupted, interruption};
use super::output::JsonOutput;
use super::sources::{family, once};
use super::subjects::{Answering, Asked, Permit, Programs, asked, seconds};
use super::whole;

/// Search for the queries that a subject takes longest on
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof slowest
  tunnelproof slowest --subject additive --family uniform,lattice --seconds 300
  tunnelproof slowest --subject lib:./libmy_ccd.so --count 4 > slowest.jsonl
  tunnelproof slowest --seconds 10 --json slowest.json
  tunnelproof slowest | tunnelproof certify --subject certified,additive -

Searches side by side, as many as --count, each begin at the slowest of 64 queries of the families.
Each changes a few numbers of its query at a time: other exponents, other bits, positions that
coincide. It keeps a change if the query takes longer each of four times. After 2000 changes in a row
that are not kept it begins anew. One thread works, so that nothing else disturbs the clock.

The time is the smallest of the four, by the clock: other programs that run disturb it. That of a
program or a library includes the time to ask it, some 0.1 ms. Queries on which it crashes are passed
over; certify finds these.

The queries are printed as lines that eval, explain and certify read, the slowest first. Their times,
and what certify says of the answers, are written to the standard error. Ctrl-C ends the search and
prints what was found. Times vary, so the seed alone does not repeat what is found.")]
pub(super) struct Slowest {
    /// Who is timed: a subject by its name, cmd: and the command of a program, or lib: and the path
    /// of a shared library
    #[arg(long, value_parser = asked, default_value = "certified")]
    subject: Asked,
    #[command(flatten)]
    programs: Programs,
    #[command(flatten)]
    permit: Permit,
    /// Families of queries that searches begin at; by default all of linear motion
    #[arg(long, value_delimiter = ',', value_parser = family())]
    family: Vec<&'static Family>,
    /// How many slow queries to find, by as many searches
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u16).range(1..=1000), allow_negative_numbers = true)]
    count: u16,
    /// How long to search, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = seconds, allow_negative_numbers = true)]
    seconds: f64,
    /// The seed of the search
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = whole, allow_negative_numbers = true)]
    seed: u64,
    /// Write the queries with their times and what certify says to this file; - is the standard
    /// output, in place of the queries alone
    #[arg(long, value_name = "OUT")]
    json: Option<PathBuf>,
}

impl Slowest {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let output = JsonOutput::create(self.json.as_deref())?;
        let mut answering = self.programs.start(&self.subject)?;
        self.permit.grant(std::slice::from_mut(&mut answering))?;
        let subject = answering.subject();
        let families = match self.family.is_empty() {
            true => generate::all().collect(),
            false => once(self.family, |family| family.name()),
        };
        let count = usize::from(self.count);
        let mut failed = None;
        let cost = |query: &Query| match time(subject, query) {
            Ok(time) => Some(time),
            Err(reason) => {
                failed.get_or_insert(reason);
                None
            }
        };
        let mut search = Search::new(&families, self.seed, count, cost);
        let limit = Duration::from_secs_f64(self.seconds);
        let start = Instant::now();
        let stop = interruption()?;
        // Each search has a query, so that there is something to print.
        while search.asked() < count as u64 || start.elapsed() < limit {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            search.turn();
        }
        let asked = search.asked();
        let found = search.costliest();
        let is_stopped = stop.load(Ordering::Relaxed);
        if found.is_empty() && !is_stopped {
            eprint!("{}", no_answer(&answering, failed));
            return Ok(ExitCode::FAILURE);
        }
        eprintln!("{}: {asked} queries tried", subject.name());
        let disagreement = Disagreement::with_oracle(subject);
        let (mut lines, mut slow) = (String::new(), Vec::new());
        for (Costly { query, cost }, place) in found.iter().zip(1..) {
            let id = format!("slowest-{place}");
            let line = AnyQuery::from(*query).line(&id, Numbers::Decimal);
            let fault = disagreement.fault(query);
            let judged = match &fault {
                Ok(Some(fault)) => fault.name(),
                Ok(None) => "right",
                Err(_) => "not judged",
            };
            eprintln!("{id}: {cost:.2?}, {judged}");
            // The line is JSON, as it is printed.
            let query: Value = serde_json::from_str(&line).unwrap_or_default();
            slow.push(json!({ "query": query, "seconds": cost.as_secs_f64(), "judged": judged }));
            lines += &(line + "\n");
        }
        let found = json!({ "subject": subject.name(), "tried": asked, "slowest": slow });
        output.write(|| Ok(format!("{found:#}")), || lines)?;
        match is_stopped {
            true => Ok(interrupted()),
            false => Ok(ExitCode::SUCCESS),
        }
    }
}

/// That there was no answer, how the first one failed, and what a program did.
fn no_answer(answering: &Answering, first: Option<NoAnswer>) -> String {
    let name = answering.subject().name();
    let Some(NoAnswer::Lapse(lapse)) = first else {
        return format!("{name} answers no query of these families\n");
    };
    let conduct = answering.program().map(|program| program.finish());
    let conduct = conduct.map(|conduct| (name.to_owned(), conduct));
    let conduct = table::programs(conduct.as_slice());
    format!("{name} answers no query: {lapse}\n{}", conduct.trim_start())
}

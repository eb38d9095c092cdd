//! `slowest`: the queries that a subject takes longest on.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Args;
use tunnelproof_reference::certify::query::AnyQuery;
use tunnelproof_reference::corpus::jsonl::Numbers;
use tunnelproof_reference::generate::{self, Family};
use tunnelproof_reference::shrink::Disagreement;
use tunnelproof_reference::slowest::{Costly, Search, time};

use super::Failure;
use super::output::print;
use super::sources::family;
use super::subjects::{Asked, Permit, Programs, asked, seconds};

/// Search for the queries that a subject takes longest on
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof slowest
  tunnelproof slowest --subject additive --family uniform,lattice --seconds 300
  tunnelproof slowest --subject lib:./my_ccd.so --count 4 > slowest.jsonl
  tunnelproof slowest | tunnelproof certify --subject certified,additive -

Several climbs go on side by side, as many as --count. Each begins at the slowest of 64 queries of the
families, changes a few numbers of its query at a time, by other exponents and bits, or so that
positions coincide, and keeps what takes longer each time it is asked; it begins anew after 2000 changes in a row that do
not. One thread works, so that nothing else disturbs the clock; the least of four measurements counts,
and that of a program has its pipe in it.

The queries are printed as lines that eval, explain and certify read, the slowest first. The times,
and whether the answers are right, stand on the standard error. As times vary, so does what is found:
the seed alone does not repeat it.")]
pub(super) struct Slowest {
    /// Who is timed: a subject by its name, cmd: and the command of a program, or lib: and the path
    /// of a shared library
    #[arg(long, value_parser = asked, default_value = "certified")]
    subject: Asked,
    #[command(flatten)]
    programs: Programs,
    #[command(flatten)]
    permit: Permit,
    /// Families of queries that climbs begin at; by default all of linear motion
    #[arg(long, value_delimiter = ',', value_parser = family())]
    family: Vec<&'static Family>,
    /// How many queries are looked for
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u16).range(1..=1000))]
    count: u16,
    /// How long to search, in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = seconds, allow_negative_numbers = true)]
    seconds: f64,
    /// The seed of the search
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
}

impl Slowest {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let mut answering = self.programs.start(&self.subject)?;
        self.permit.grant(std::slice::from_mut(&mut answering))?;
        let subject = answering.subject();
        let families = match self.family.is_empty() {
            true => generate::all().collect(),
            false => self.family,
        };
        let count = usize::from(self.count);
        let mut search = Search::new(&families, self.seed, count, |query| time(subject, query));
        let limit = Duration::from_secs_f64(self.seconds);
        let start = Instant::now();
        // Each climb has a query, so that there is something to print.
        while search.asked() < count as u64 || start.elapsed() < limit {
            search.turn();
        }
        let asked = search.asked();
        let found = search.costliest();
        if found.is_empty() {
            eprintln!("{} takes no query of these families", subject.name());
            return Ok(ExitCode::FAILURE);
        }
        eprintln!("{}: {asked} queries tried", subject.name());
        let disagreement = Disagreement::with_oracle(subject);
        for (Costly { query, cost }, place) in found.iter().zip(1..) {
            let id = format!("slowest-{place}");
            print(&format!(
                "{}\n",
                AnyQuery::from(*query).line(&id, Numbers::Decimal)
            ))?;
            let fault = disagreement.fault(query);
            let judged = match &fault {
                Ok(Some(fault)) => fault.name(),
                Ok(None) => "right",
                Err(_) => "not judged",
            };
            eprintln!("{id}: {cost:.2?}, {judged}");
        }
        Ok(ExitCode::SUCCESS)
    }
}

//! `certify`: subjects judged on files and families against the exact answer.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use tunnelproof_reference::certify::run::{Block, Judged, Panel};
use tunnelproof_reference::certify::source::Source;
use tunnelproof_reference::certify::strict::failures;
use tunnelproof_reference::certify::table;
use tunnelproof_reference::field::{self, Integer};
use tunnelproof_reference::generate::{FAMILIES, Family};
use tunnelproof_reference::oracle;
use tunnelproof_reference::registry;
use tunnelproof_reference::report::results::Results;
use tunnelproof_reference::shadow::Shadow;
use tunnelproof_reference::shrink::{Disagreement, MOST_CALLS};
use tunnelproof_reference::subject::Subject;

use super::output::{OutputFile, print};
use super::sources::{family, of_families, of_files};
use super::{Failure, Reading, progress};

/// Judge subjects against the exact answer
///
/// The oracle is the truth, and a second exact judge has to agree with it on every query.
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof certify
  tunnelproof certify --subject thesis --family lattice --count 1000000 --seed 7
  tunnelproof certify --subject thesis --count 1000 --shrink
  tunnelproof certify --strict --subject oracle,shadow queries.jsonl unit-tests/edge-edge/*.csv

Without files: the figure cases and every family of edges without radius. With files: these, and the
families asked for. Families of vertices and faces, and of radii: face_... and thick_...; subjects that do
not take such queries are not asked.

Columns: hits that the subject reports; tunnels, crossings that it misses; missed grazes, contacts
without crossing that it misses; false hits; near hits, false hits within the distance that the
subject declares of itself; wrong cases; queries it takes and gives no answer to; and how far the worst time of
impact is behind (late: dangerous) or ahead of (early: safe) the exact one. Joint tunnels are edges that
pass through a wire at a node and are missed by both of its segments there.

Of the witnesses, \"central\" is 1 if the time and the parameters of the missed contact are in the
middle of the step and the edges, 0 if they are at the ends; \"gap\" is the least distance during the
step.")]
pub(super) struct Certify {
    /// Files of queries (.jsonl or .csv); - is the standard input
    #[arg(value_name = "FILE")]
    files: Vec<String>,
    /// Who is judged; by default everyone but the slow second judge, difference
    #[arg(long, value_delimiter = ',', value_parser = super::subject())]
    subject: Vec<&'static dyn Subject>,
    /// Families of generated queries; by default all of edges without radius, or none if files are given
    #[arg(long, value_delimiter = ',', value_parser = family())]
    family: Vec<&'static Family>,
    /// How many queries of each family; 0 for none
    #[arg(long, value_name = "N", default_value_t = 20_000)]
    count: u64,
    /// The seed of the families
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Take the oracle's word without asking the second judge, for long runs of other subjects
    #[arg(long)]
    one_judge: bool,
    /// Write the whole result to this file, as JSON
    #[arg(long, value_name = "OUT")]
    json: Option<PathBuf>,
    /// Also print a shrunk twin of each worst witness
    #[arg(long)]
    shrink: bool,
    /// Exit with 1 unless every subject passes and all judges and labels agree
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    reading: Reading,
}

impl Certify {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let sources = self.sources();
        if sources.is_empty() {
            return Err(Failure::Nothing);
        }
        let json = self.json.as_deref().map(OutputFile::create).transpose()?;
        let panel = self.panel();
        let blocks = judge(&panel, &sources)?;
        let mut total = Block {
            name: "all".to_owned(),
            ..Block::default()
        };
        blocks.iter().for_each(|block| total.merge(block.clone()));
        if let Some(file) = json {
            let results = Results::new(&panel, self.seed, self.count, &blocks, &total);
            file.write(&results.text())?;
        }
        print(&self.text(&panel, &blocks, &total))?;
        if self.shrink {
            print(&shrunk_witnesses(&panel, &total))?;
        }
        let failures = failures(&panel, &total);
        if !self.strict || failures.is_empty() {
            return Ok(ExitCode::SUCCESS);
        }
        failures
            .iter()
            .for_each(|failure| eprintln!("--strict: {failure}"));
        Ok(ExitCode::FAILURE)
    }

    fn panel(&self) -> Panel<'static> {
        let subjects = match self.subject.is_empty() {
            true => registry::judged_by_default().collect(),
            false => self.subject.clone(),
        };
        Panel {
            second_judges: match self.one_judge {
                true => Vec::new(),
                false => registry::second_judges().to_vec(),
            },
            subjects: subjects.into_iter().map(judged).collect(),
        }
    }

    fn sources(&self) -> Vec<Source> {
        let is_everything = self.family.is_empty() && self.files.is_empty();
        let families = match is_everything {
            true => FAMILIES.iter().collect(),
            false => self.family.clone(),
        };
        let figures = is_everything.then_some(Source::Figures);
        let families = of_families(&families, self.seed, self.count);
        let files = of_files(&self.files, &self.reading);
        figures.into_iter().chain(families).chain(files).collect()
    }

    fn text(&self, panel: &Panel, blocks: &[Block], total: &Block) -> String {
        let everything = (blocks.len() > 1).then(|| total.clone());
        let blocks: Vec<_> = blocks.iter().cloned().chain(everything).collect();
        let settings = format!(
            "tunnelproof {}, seed {}, exact arithmetic by {}",
            env!("CARGO_PKG_VERSION"),
            self.seed,
            field::Default::BACKEND
        );
        [
            settings,
            table::blocks(panel, &blocks),
            table::agreement(panel, total),
            table::witnesses(panel, total),
        ]
        .join("\n")
    }
}

/// The worst witness of each fault of each subject, shrunk, with the command that explains it. Where a
/// witness shows a worse fault than the one it is listed under, or one that is permitted, there is none.
fn shrunk_witnesses(panel: &Panel, total: &Block) -> String {
    let mut lines = vec!["\nShrunk:".to_owned()];
    for (judged, tally) in panel.subjects.iter().zip(&total.tallies) {
        let disagreement = Disagreement {
            subject: judged.subject,
            truth: oracle::decide_query,
        };
        for (&fault, finding) in &tally.faults {
            let Some(witness) = &finding.worst else {
                continue;
            };
            if disagreement.fault(&witness.query) == Ok(Some(fault)) {
                let shrunk = disagreement.shrink(&witness.query, fault, MOST_CALLS);
                let name = judged.subject.name();
                lines.push(format!("  {name}, {}: {shrunk}", fault.name()));
                lines.push(format!("    {}", shrunk.command(&witness.id)));
            }
        }
    }
    lines.push(String::new());
    lines.join("\n")
}

pub(super) fn judged(subject: &'static dyn Subject) -> Judged<'static> {
    let is_published = subject.name() == Shadow::PUBLISHED.name();
    Judged {
        subject,
        explain: is_published.then_some(&registry::errata),
    }
}

/// Judges every source, with a progress bar on the standard error if that is a terminal.
fn judge(panel: &Panel, sources: &[Source]) -> Result<Vec<Block>, Failure> {
    let progress = progress::of_sources(sources);
    let blocks = sources.iter().map(|source| {
        progress.set_message(source.name());
        Ok(panel.run(source, |judged| progress.inc(judged))?)
    });
    let blocks = blocks.collect();
    progress.finish_and_clear();
    blocks
}

//! `certify`: subjects judged on files and families against the exact answer.

use std::process::ExitCode;

use clap::Args;
use tunnelproof_reference::certify::block::Block;
use tunnelproof_reference::certify::findings::{Findings, Settings};
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::certify::run::Panel;
use tunnelproof_reference::certify::shard::Shard;
use tunnelproof_reference::certify::source::Source;
use tunnelproof_reference::certify::table;
use tunnelproof_reference::generate::{FAMILIES, Family};
use tunnelproof_reference::program::Conduct;
use tunnelproof_reference::registry;
use tunnelproof_reference::report::merge::{Kept, MergeError};
use tunnelproof_reference::shadow::Shadow;
use tunnelproof_reference::shrink::{Disagreement, MOST_CALLS};
use tunnelproof_reference::subject::Subject;

use super::certificate::Certificate;
use super::sources::{family, of_families, of_files};
use super::subjects::{Answering, AskedList, Permit, Programs, asked_list};
use super::{Failure, Reading, merge, progress};

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
  tunnelproof certify --subject 'cmd:./my_ccd --flags' --html certificate.html
  tunnelproof certify --shard 3/8 --json part-3.json queries.jsonl.zst

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
step.

A program is started once for each thread. It reads queries as eval does and writes a line for each, at once:
{\"hit\": false} or {\"hit\": true, \"toi\": 0.25}. A crash, a hang or garbage is no answer to the query whose
answer is due, and the program is started again. docs/bring-your-own.md has the rest.")]
pub(super) struct Certify {
    /// Files of queries (.jsonl or .csv); - is the standard input
    #[arg(value_name = "FILE")]
    files: Vec<String>,
    /// Who is judged: subjects by their names, cmd: and the command of a program, or lib: and the
    /// path of a shared library; by default every subject but the slow second judge, difference
    #[arg(long, value_parser = asked_list)]
    subject: Vec<AskedList>,
    #[command(flatten)]
    programs: Programs,
    #[command(flatten)]
    permit: Permit,
    /// Families of generated queries; by default all of edges without radius, or none if files are
    /// given
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
    /// Also print a shrunk twin of each worst witness
    #[arg(long)]
    shrink: bool,
    /// Judge part I of N of the queries alone; merge puts the parts together
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE)]
    shard: Shard,
    /// If the file of --json is there and of the same command, take the result from it
    #[arg(long, requires = "json")]
    resume: bool,
    #[command(flatten)]
    certificate: Certificate,
    #[command(flatten)]
    reading: Reading,
}

impl Certify {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        self.reading.check(&self.files)?;
        let sources = self.sources();
        if sources.is_empty() {
            return Err(Failure::Nothing);
        }
        let answering = self.answering()?;
        let settings = self.settings(&answering);
        if let Some(kept) = self.kept(&settings)? {
            let findings = kept.findings();
            self.certificate.prepare()?.write(&findings)?;
            return Ok(self.certificate.code(&findings));
        }
        let files = self.certificate.prepare()?;
        let panel = self.panel(&answering);
        let blocks = judge(&panel, &sources, self.shard)?;
        let findings = Findings::new(panel, settings, blocks, finish(&answering));
        files.write(&findings)?;
        if self.shrink {
            self.certificate.print_after(&shrunk_witnesses(&findings))?;
        }
        Ok(self.certificate.code(&findings))
    }

    /// The result of this command that is there already, if it may be taken.
    fn kept(&self, settings: &Settings) -> Result<Option<Kept>, Failure> {
        let path = self.certificate.json.as_deref().filter(|_| self.resume);
        let Some(path) = path else { return Ok(None) };
        match merge::read_if_there(path)? {
            Some(kept) if kept.settings() != settings => {
                let path = path.display().to_string();
                Err(Failure::merge(&path, MergeError::Other("command")))
            }
            kept => Ok(kept),
        }
    }

    /// What is judged, and the command that does it again.
    fn settings(&self, answering: &[Answering]) -> Settings {
        let mut words = vec![format!("{} certify", table::CHECKOUT)];
        let mut option = |name: &str, value: String| {
            words.push(format!("--{name} {}", table::quoted(&value)));
        };
        if !self.subject.is_empty() {
            for answering in answering {
                option("subject", answering.subject().name().to_owned());
            }
        }
        if answering
            .iter()
            .any(|answering| answering.program().is_some())
        {
            let [wire, limit] = self.programs.values();
            option("wire", wire);
            option("time-limit", limit);
            if let Some(permit) = self.permit.value() {
                option("permit", permit);
            }
        }
        if !self.family.is_empty() {
            let names: Vec<_> = self.family.iter().map(|family| family.name()).collect();
            option("family", names.join(","));
        }
        if self.files.is_empty() || !self.family.is_empty() {
            option("count", self.count.to_string());
            option("seed", self.seed.to_string());
        }
        if let Some(kind) = self.reading.kind {
            option("kind", kind.to_string());
        }
        if let Some(radius) = self.reading.radius {
            option("radius", radius.to_string());
        }
        words.extend(self.one_judge.then(|| "--one-judge".to_owned()));
        words.extend(self.files.iter().map(|file| table::quoted(file)));
        Settings {
            command: words.join(" "),
            seed: self.seed,
            count: self.count,
            shard: self.shard,
        }
    }

    fn answering(&self) -> Result<Vec<Answering>, Failure> {
        let mut answering = match self.subject.is_empty() {
            true => registry::judged_by_default()
                .map(Answering::Known)
                .collect(),
            false => self.programs.start_all(&self.subject)?,
        };
        self.permit.grant(&mut answering)?;
        Ok(answering)
    }

    fn panel<'a>(&self, answering: &'a [Answering]) -> Panel<'a> {
        Panel {
            second_judges: match self.one_judge {
                true => Vec::new(),
                false => registry::second_judges().to_vec(),
            },
            subjects: (answering.iter().map(Answering::subject))
                .map(judged)
                .collect(),
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
}

/// The worst witness of each fault of each subject, shrunk, with the command that explains it.
/// Where a witness shows a worse fault than the one it is listed under, or one that is permitted,
/// there is none.
fn shrunk_witnesses(findings: &Findings) -> String {
    let mut lines = vec!["\nShrunk:".to_owned()];
    let subjects = findings.panel.subjects.iter();
    for (judged, tally) in subjects.zip(&findings.total.tallies) {
        let disagreement = Disagreement::with_oracle(judged.subject);
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

/// Ends the programs and says what each of them did.
fn finish(answering: &[Answering]) -> Vec<(String, Conduct)> {
    let programs = answering.iter().filter_map(Answering::program);
    programs
        .map(|program| (program.name().to_owned(), program.finish()))
        .collect()
}

pub(super) fn judged(subject: &dyn Subject) -> Judged<'_> {
    let is_published = subject.name() == Shadow::PUBLISHED.name();
    Judged {
        subject,
        explain: is_published.then_some(&registry::errata),
    }
}

/// Judges every source, with a progress bar on the standard error if that is a terminal.
fn judge(panel: &Panel, sources: &[Source], shard: Shard) -> Result<Vec<Block>, Failure> {
    let progress = progress::of_sources(sources, shard);
    let blocks = sources.iter().map(|source| {
        progress.set_message(source.name());
        Ok(panel.run_shard(source, shard, |judged| progress.inc(judged))?)
    });
    let blocks = blocks.collect();
    progress.finish_and_clear();
    blocks
}

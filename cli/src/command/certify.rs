//! `certify`: subjects judged on files and families against the exact answer.

use std::process::ExitCode;

use clap::Args;
use tunnelproof_reference::certify::block::Block;
use tunnelproof_reference::certify::caller::{self, Caller};
use tunnelproof_reference::certify::defaults;
use tunnelproof_reference::certify::findings::{Findings, Settings};
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::certify::query::AnyQuery;
use tunnelproof_reference::certify::run::Panel;
use tunnelproof_reference::certify::shard::Shard;
use tunnelproof_reference::certify::source::{AnyFamily, AnySource, Source, TurningSource};
use tunnelproof_reference::certify::tally::{Fault, Witness};
use tunnelproof_reference::difference::Difference;
use tunnelproof_reference::generate::{FAMILIES, Family};
use tunnelproof_reference::program::Conduct;
use tunnelproof_reference::registry;
use tunnelproof_reference::shadow::Shadow;
use tunnelproof_reference::shrink::{Disagreement, MOST_CALLS};
use tunnelproof_reference::subject::Subject;

use super::certificate::Certificate;
use super::resume::Resumed;
use super::sources::{any_family, of_files, once};
use super::subjects::{Answering, AskedList, Permit, Programs, asked_list, check_turning};
use super::{Failure, Reading, output, progress, whole};

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
  tunnelproof certify --subject lib:./my_ccd.so Sample-Scalable-CCD-Data/cloth-funnel
  tunnelproof certify --family turning_plates,turning_thick_plates --count 1000
  tunnelproof certify --shard 3/8 --json part-3.json queries.jsonl.zst
  tunnelproof certify --count 10000000 --json result.json --resume

Without files: the figure cases and every family of edges without radius, or, if no subject takes
these, every family that one of them takes. With files: these, and the families asked for. Families of
vertices and faces, of radii, and of bodies that turn: face_..., thick_... and turning_...; subjects
that do not take such queries are not asked. A folder stands for the files of queries in it. Both public benchmarks are read as they are
published, with their labels.

With --resume, what is judged so far is kept in OUT.part beside OUT, the file of --json, after each family
and file. The same command goes on there, and removes it at the end. If OUT is there, it is taken. What
programs wrote and how often they were started is counted from the last start.

A line for each subject, those that fail first, and a line on what each column means. --details has
every family. Of the witnesses, \"central\" is 1 if the time and the parameters of the missed contact are in the
middle of the step and the edges, 0 if they are at the ends; \"gap\" is the least distance during the
step.

A program is started once for each thread. It reads queries as eval does and writes a line for each, at once:
{\"hit\": false} or {\"hit\": true, \"toi\": 0.25}. A crash, a hang or garbage is no answer to the query whose
answer is due, and the program is started again. docs/bring-your-own.md has the rest.")]
pub(super) struct Certify {
    /// Files of queries (.jsonl or .csv), or folders of them, such as the public benchmarks; - is the
    /// standard input
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
    #[arg(long, value_delimiter = ',', value_parser = any_family())]
    family: Vec<AnyFamily>,
    /// How many queries of each family; 0 for none
    #[arg(long, value_name = "N", default_value_t = 20_000, value_parser = whole, allow_negative_numbers = true)]
    count: u64,
    /// The seed of the families
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = whole, allow_negative_numbers = true)]
    seed: u64,
    /// Take the oracle's word without asking the second judge, for long runs of other subjects
    #[arg(long)]
    one_judge: bool,
    /// The files hold queries of bodies that turn
    #[arg(long, requires = "files", conflicts_with_all = ["kind", "radius"])]
    turning: bool,
    /// Also print a shrunk twin of each worst witness
    #[arg(long)]
    shrink: bool,
    /// Judge part I of N of the queries alone; merge puts the parts together
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE)]
    shard: Shard,
    /// Go on where the same command was interrupted, and keep what is judged beside the file of --json
    #[arg(long, requires = "json")]
    resume: bool,
    #[command(flatten)]
    certificate: Certificate,
    #[command(flatten)]
    reading: Reading,
}

impl Certify {
    pub(super) fn run(mut self) -> Result<ExitCode, Failure> {
        self.family = once(self.family, |family| family.name());
        self.reading.check(&self.files)?;
        let files = self.files()?;
        if files.is_empty() && self.count == 0 && !self.family.is_empty() {
            return Err(Failure::Nothing);
        }
        let answering = self.answering()?;
        let settings = self.settings(&answering);
        let resumed = Resumed::new(self.resume, self.certificate.json.as_deref(), &settings)?;
        if let Some(kept) = resumed.whole()? {
            let findings = kept.findings();
            self.certificate
                .prepare(&findings.panel)?
                .write(&findings)?;
            return Ok(self.certificate.code(&findings));
        }
        let panel = self.panel(&answering);
        let outputs = self.certificate.prepare(&panel)?;
        let sources = self.sources(&panel, files);
        let blocks = judge(&panel, &settings, &sources, &resumed)?;
        let findings = Findings::new(panel, settings.clone(), blocks, finish(&answering));
        outputs.write(&findings)?;
        resumed.finish()?;
        if self.shrink {
            self.certificate.print_after(&shrunk_witnesses(&findings))?;
        }
        Ok(self.certificate.code(&findings))
    }

    /// What is judged, and the command that does it again.
    fn settings(&self, answering: &[Answering]) -> Settings {
        let program = output::program();
        let mut words = vec![format!("{program} certify")];
        let mut option = |name: &str, value: String| {
            words.push(format!("--{name} {}", caller::quoted(&value)));
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
            let names: Vec<_> = self.family.iter().map(AnyFamily::name).collect();
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
        words.extend(self.turning.then(|| "--turning".to_owned()));
        words.extend(self.one_judge.then(|| "--one-judge".to_owned()));
        words.extend(self.files.iter().map(|file| caller::quoted(file)));
        Settings {
            command: words.join(" "),
            caller: Caller::Shell {
                program: program.to_owned(),
                options: [self.programs.options(), self.permit.options()]
                    .join(" ")
                    .trim()
                    .to_owned(),
            },
            seed: self.seed,
            count: self.count,
            shard: self.shard,
        }
    }

    /// The queries of files.
    fn files(&self) -> Result<Vec<AnySource>, Failure> {
        if self.turning {
            let files = self.files.iter().cloned();
            let files = files.map(|path| TurningSource::File { path }.into());
            return Ok(files.collect());
        }
        let files = of_files(&self.files, &self.reading)?.into_iter();
        Ok(files.map(AnySource::from).collect())
    }

    /// Whether everything that is judged is of bodies that turn.
    fn is_all_turning(&self) -> bool {
        let has_linear_files = !self.files.is_empty() && !self.turning;
        let is_some = self.turning || !self.family.is_empty();
        is_some && !has_linear_files && self.family.iter().all(AnyFamily::turns)
    }

    fn answering(&self) -> Result<Vec<Answering>, Failure> {
        let mut answering = match self.subject.is_empty() {
            true if self.is_all_turning() => {
                let subjects = registry::turning_subjects().into_iter();
                let second = Difference.name();
                let subjects = subjects.filter(|subject| subject.name() != second);
                subjects.map(Answering::Known).collect()
            }
            true => registry::judged_by_default()
                .map(Answering::Known)
                .collect(),
            false => self.programs.start_all(&self.subject)?,
        };
        self.programs.check_used(&answering)?;
        self.permit.grant(&mut answering)?;
        // Beside queries of linear motion, such a subject is just not asked the others.
        if self.is_all_turning() {
            check_turning(&answering)?;
        }
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

    /// What is judged: by default what the subjects can answer.
    fn sources(&self, panel: &Panel, files: Vec<AnySource>) -> Vec<AnySource> {
        let families: Vec<_> = match self.family.is_empty() && files.is_empty() {
            true => {
                let subjects: Vec<_> = panel.subjects.iter().map(|judged| judged.subject).collect();
                defaults::families(&subjects)
            }
            false => self.family.clone(),
        };
        let names = families.iter().map(AnyFamily::name);
        let is_everything = self.family.is_empty() && names.eq(FAMILIES.iter().map(Family::name));
        let figures = is_everything.then_some(Source::Figures.into());
        let families = families.iter().filter(|_| self.count > 0);
        let families = families.map(|family| family.first(self.seed, self.count));
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
                let name = judged.subject.name();
                let [found, command] = shrunk(&disagreement, witness, fault);
                lines.push(format!("  {name}, {}: {found}", fault.name()));
                lines.push(format!("    {command}"));
            }
        }
    }
    lines.push(String::new());
    lines.join("\n")
}

/// What was found, and the command that explains it.
fn shrunk(disagreement: &Disagreement, witness: &Witness, fault: Fault) -> [String; 2] {
    match &witness.query {
        AnyQuery::Turning(query) => {
            let shrunk = disagreement.shrink(query, fault, MOST_CALLS);
            [shrunk.to_string(), shrunk.command(&witness.id)]
        }
        AnyQuery::Linear(query) => {
            let shrunk = disagreement.shrink(query, fault, MOST_CALLS);
            [shrunk.to_string(), shrunk.command(&witness.id)]
        }
    }
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

/// Judges every source that is not judged yet, with a progress bar on the standard error if that is
/// a terminal.
fn judge(
    panel: &Panel,
    settings: &Settings,
    sources: &[AnySource],
    resumed: &Resumed,
) -> Result<Vec<Block>, Failure> {
    let mut blocks = resumed.blocks(sources)?;
    let rest = &sources[blocks.len()..];
    let progress = progress::of_sources(rest, settings.shard);
    for source in rest {
        progress.set_message(source.name());
        blocks.push(panel.run_shard(source, settings.shard, |judged| progress.inc(judged))?);
        if blocks.len() < sources.len() {
            resumed.keep(panel, &blocks)?;
        }
    }
    progress.finish_and_clear();
    Ok(blocks)
}

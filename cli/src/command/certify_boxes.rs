//! `certify-boxes`: programs judged on boxes that are cast along lines.

use std::borrow::Borrow;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use clap::builder::TypedValueParser;
use tunnelproof_reference::boxes::{BOX_FAMILIES, BoxFamily, box_family};
use tunnelproof_reference::certify::boxes::{self, Judged, judge_family};
use tunnelproof_reference::certify::table::short;
use tunnelproof_reference::certify::tally::Fault;
use tunnelproof_reference::report::boxes::report;
use tunnelproof_reference::subject::Subject;

use super::output::JsonOutput;
use super::sources::{Listed, once};
use super::subjects::{Asked, Permit, Programs, asked};
use super::{Failure, whole};

/// Judge a program on boxes that are cast along lines, against the exact answer
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof certify-boxes --subject lib:target/peers/bullet.so --count 1000
  tunnelproof certify-boxes --subject 'cmd:./casts' --wire binary --family cast_box_lattice --json out.json
  tunnelproof explain cast_box_lattice:1:3

A box is cast against a box, a capsule or a sphere, a triangle or a segment; a cast is asked in frames of
bytes (docs/bring-your-own.md), or of the function tunnelproof_box_cast of a library.")]
pub(super) struct CertifyBoxes {
    /// Who is judged: cmd: and the command of a program, or lib: and the path of a shared library
    #[arg(long, value_parser = asked)]
    subject: Asked,
    #[command(flatten)]
    programs: Programs,
    #[command(flatten)]
    permit: Permit,
    /// Families of casts; by default all
    #[arg(long, value_delimiter = ',', value_parser = family())]
    family: Vec<&'static BoxFamily>,
    /// How many casts of each family
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = whole, allow_negative_numbers = true)]
    count: u64,
    /// The seed of the families
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = whole, allow_negative_numbers = true)]
    seed: u64,
    /// Write what was found to this file, - for the standard output
    #[arg(long, value_name = "OUT")]
    json: Option<PathBuf>,
    /// End with exit code 1 unless the program passes
    #[arg(long)]
    strict: bool,
}

impl CertifyBoxes {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let output = JsonOutput::create(self.json.as_deref())?;
        let mut answering = [self.programs.start(&self.subject)?];
        self.permit.grant(&mut answering)?;
        let [answering] = &answering;
        let Some(program) = answering.program() else {
            return Err(Failure::Program {
                name: answering.subject().name().to_owned(),
                reason: "takes no casts of boxes: these are for cmd: and lib:".to_owned(),
            });
        };
        self.programs.check_casts(program)?;
        let families = match self.family.is_empty() {
            true => BOX_FAMILIES.iter().collect(),
            false => once(self.family, |family| family.name()),
        };
        let judge = |family| judge_family(program, family, self.seed, self.count);
        let found: Vec<Judged> = families.into_iter().map(judge).collect();
        let (tolerance, conduct) = (program.tolerance(), program.finish());
        let failures = boxes::failures(&found, tolerance, conduct.surplus);
        let value = report(program.name(), tolerance, &found, &conduct);
        let text = || {
            format!(
                "{}\n{}",
                table(&found),
                verdict(program.name(), &found, &failures)
            )
        };
        output.write(|| Ok(format!("{value:#}")), text)?;
        Ok(match self.strict && !failures.is_empty() {
            true => ExitCode::FAILURE,
            false => ExitCode::SUCCESS,
        })
    }
}

/// What a program fails by, and what shows the worst of each fault.
fn verdict(name: &str, found: &[Judged], failures: &[String]) -> String {
    let mut text = match failures {
        [] => format!("{name} passes\n"),
        failures => format!("{name} fails: {}\n", failures.join(", ")),
    };
    let faults = boxes::faults(found);
    if !faults.is_empty() {
        text += "\nWorst of each fault, and the command that explains it:\n";
    }
    for (fault, finding) in &faults {
        let (name, id) = (fault.name(), finding.worst.id);
        text += &format!("  {name:<14}tunnelproof explain {id}\n");
    }
    text
}

/// What was found, a line for each family, and one of all.
fn table(found: &[Judged]) -> String {
    let heads = [
        "family",
        "casts",
        "hits",
        "missed",
        "false",
        "near",
        "no answer",
        "refused",
        "late",
        "early",
    ];
    let mut lines = vec![line(&heads.map(str::to_owned))];
    lines.extend(found.iter().map(|judged| row(judged.name, &[judged])));
    if found.len() > 1 {
        lines.push(row("all", found));
    }
    lines.concat()
}

/// What some families have together.
fn row(name: &str, found: &[impl Borrow<Judged>]) -> String {
    let found = || found.iter().map(Borrow::borrow);
    let findings = |fault| found().filter_map(move |judged| judged.faults.get(&fault));
    let count = |fault| findings(fault).map(|finding| finding.count).sum::<u64>();
    let worst =
        |fault| findings(fault).fold(0.0, |worst, finding| finding.worst.severity.max(worst));
    let counts = [
        found().map(|judged| judged.queries).sum(),
        found().map(|judged| judged.hits).sum(),
        count(Fault::Tunnel) + count(Fault::MissedGraze),
        count(Fault::FalseHit),
        count(Fault::NearHit),
        count(Fault::NoAnswer),
        found().map(Judged::refused).sum(),
    ];
    let [a, b, c, d, e, f, g] = counts.map(|count| count.to_string());
    let [late, early] = [Fault::Late, Fault::Early].map(|fault| short(worst(fault)));
    line(&[name.to_owned(), a, b, c, d, e, f, g, late, early])
}

fn line([name, rest @ ..]: &[String; 10]) -> String {
    let cells: String = rest.iter().map(|cell| format!("{cell:>10}")).collect();
    format!("{name:<25}{cells}\n")
}

fn family() -> impl TypedValueParser<Value = &'static BoxFamily> {
    Listed::new(BOX_FAMILIES.iter().map(BoxFamily::name))
        .try_map(|name| box_family(&name).ok_or("unknown family"))
}

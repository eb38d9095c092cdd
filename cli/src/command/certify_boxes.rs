//! `certify-boxes`: programs judged on boxes that are cast along lines.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use tunnelproof_reference::boxes::{BOX_FAMILIES, BoxFamily, box_family};
use tunnelproof_reference::certify::boxes::{Judged, judge_family};
use tunnelproof_reference::certify::tally::Fault;
use tunnelproof_reference::report::boxes::report;
use tunnelproof_reference::subject::Subject;

use super::Failure;
use super::output::JsonOutput;
use super::subjects::{Asked, Permit, Programs, asked};

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
    #[arg(long, value_name = "N", default_value_t = 1000)]
    count: u64,
    /// The seed of the families
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Write what was found to this file, - for the standard output
    #[arg(long, value_name = "OUT")]
    json: Option<PathBuf>,
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
            false => self.family,
        };
        let judge = |family| judge_family(program, family, self.seed, self.count);
        let found: Vec<Judged> = families.into_iter().map(judge).collect();
        let near = program.tolerance().near;
        let value = report(program.name(), near, &found, &program.finish());
        output.write(|| Ok(format!("{value:#}")), || table(&found))?;
        Ok(ExitCode::SUCCESS)
    }
}

/// What was found, a line for each family.
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
    lines.extend(found.iter().map(|judged| {
        let count = |fault| judged.faults.get(&fault).map_or(0, |found| found.count);
        let worst = |fault| {
            judged
                .faults
                .get(&fault)
                .map_or(0.0, |found| found.worst.severity)
        };
        let missed = count(Fault::Tunnel) + count(Fault::MissedGraze);
        let counts = [
            judged.queries,
            judged.hits,
            missed,
            count(Fault::FalseHit),
            count(Fault::NearHit),
            count(Fault::NoAnswer),
            judged.refused,
        ];
        let [a, b, c, d, e, f, g] = counts.map(|count| count.to_string());
        let [late, early] =
            [Fault::Late, Fault::Early].map(|fault| format!("{:.1e}", worst(fault)));
        line(&[judged.name.to_owned(), a, b, c, d, e, f, g, late, early])
    }));
    lines.concat()
}

fn line([name, rest @ ..]: &[String; 10]) -> String {
    let cells: String = rest.iter().map(|cell| format!("{cell:>10}")).collect();
    format!("{name:<25}{cells}\n")
}

fn family() -> impl TypedValueParser<Value = &'static BoxFamily> {
    PossibleValuesParser::new(BOX_FAMILIES.iter().map(BoxFamily::name))
        .try_map(|name| box_family(&name).ok_or("unknown family"))
}

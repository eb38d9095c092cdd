//! The details of a certification: every source, every fault.

use std::iter;

use super::block::Block;
use super::findings::Findings;
use super::judged::Judged;
use super::run::Panel;
use super::strict;
use super::summary::worst_of;
use super::table::{
    Paint, QUERIES, Tone, contents, count, cut, first, grouped, many, name_width, tolerance, worst,
};
use super::tally::{Explained, Fault, Tally};
use crate::figures;
use crate::generate::{self, Family, RigidFamily};

/// A column after the subject: two lines of heading, the width, what stands in it.
type Column = ([&'static str; 2], usize, fn(&Tally) -> String);

const COLUMNS: [Column; 9] = [
    (["", "hits"], 9, |tally| grouped(tally.hits)),
    (["", "tunnels"], 9, |tally| count(tally, Fault::Tunnel)),
    (["missed", "grazes"], 8, |tally| {
        count(tally, Fault::MissedGraze)
    }),
    (["false", "hits"], 8, |tally| count(tally, Fault::FalseHit)),
    (["near", "hits"], 8, |tally| count(tally, Fault::NearHit)),
    (["wrong", "cases"], 8, |tally| {
        count(tally, Fault::WrongCase)
    }),
    (["no", "answer"], 8, |tally| count(tally, Fault::NoAnswer)),
    (["worst", "late"], 10, |tally| worst(tally, Fault::Late)),
    (["worst", "early"], 10, |tally| worst(tally, Fault::Early)),
];

/// What was found on each source, why subjects fail, the errata that explain answers, and the worst
/// witness of each fault.
pub fn text(findings: &Findings, paint: Paint) -> String {
    let Findings { panel, total, .. } = findings;
    let mut all: Vec<_> = findings.blocks.iter().collect();
    all.extend((findings.blocks.len() > 1).then_some(total));
    let witnesses = worst_of(findings, |_, _| true, paint);
    let parts = [
        blocks(panel, &all, paint),
        errata(panel, total),
        verdicts(panel, total),
        witnesses,
    ];
    let parts = parts.into_iter().filter(|part| !part.is_empty());
    parts.collect::<Vec<_>>().join("\n")
}

/// What was found, a block of lines for each source; those without a fault together.
fn blocks(panel: &Panel, blocks: &[&Block], paint: Paint) -> String {
    let width = name_width(panel);
    let (clean, faulty): (Vec<_>, Vec<_>) = blocks.iter().partition(|block| is_clean(block));
    let mut lines = Vec::new();
    if !faulty.is_empty() {
        lines.push(line(width, "", |(heading, ..)| heading[0].to_owned()));
        lines.push(line(width, "subject", |(heading, ..)| {
            heading[1].to_owned()
        }));
    }
    for block in faulty {
        lines.push(String::new());
        lines.push(paint(Tone::Heading, &heading(block)));
        lines.extend(description(&block.name).map(|words| format!("  {words}")));
        for (judged, tally) in panel.subjects.iter().zip(&block.tallies) {
            lines.push(row(width, judged.subject.name(), block, tally));
        }
    }
    for block in clean {
        lines.push(paint(Tone::Heading, &heading(block)) + ": no fault");
        lines.extend(description(&block.name).map(|words| format!("  {words}")));
    }
    lines.push(String::new());
    lines.join("\n")
}

/// Whether every subject takes all queries of it and does nothing wrong.
pub fn is_clean(block: &Block) -> bool {
    let is_clean = |tally: &Tally| tally.not_asked() == 0 && tally.faults.is_empty();
    block.tallies.iter().all(is_clean)
}

/// What the queries of a source are like, if it is known.
pub fn description(source: &str) -> Option<&'static str> {
    let linear = generate::by_name(source).map(Family::description);
    let turning = || generate::rigid_by_name(source).map(RigidFamily::description);
    let figures = || (source == figures::SOURCE).then_some(figures::DESCRIPTION);
    linear.or_else(turning).or_else(figures)
}

/// A line of the table: a name, then a cell in each column.
fn line(width: usize, name: &str, cell: impl Fn(&Column) -> String) -> String {
    let cells = COLUMNS
        .iter()
        .map(|column| format!("{:>width$}", cell(column), width = column.1));
    format!("  {:<width$}{}", cut(name), cells.collect::<String>())
}

/// The line of a subject, with how many queries it was not asked where it takes only some.
fn row(width: usize, name: &str, block: &Block, tally: &Tally) -> String {
    match tally.not_asked() {
        0 => line(width, name, |(.., cell)| cell(tally)),
        all if all == block.queries => format!("  {:<width$}{:>9}", cut(name), "not asked"),
        some => {
            let cells = line(width, name, |(.., cell)| cell(tally));
            format!("{cells}  (not asked {})", grouped(some))
        }
    }
}

fn heading(block: &Block) -> String {
    let queries = many(block.queries, QUERIES);
    format!("{}: {queries}, {}", block.name, contents(block))
}

/// Which errata explain the answers of subjects that have any.
fn errata(panel: &Panel, total: &Block) -> String {
    let mut lines = Vec::new();
    for (judged, tally) in panel.subjects.iter().zip(&total.tallies) {
        if tally.errata.is_empty() {
            continue;
        }
        lines.push(format!(
            "{} differs from the exact answer on {}, which is explained by:",
            judged.subject.name(),
            many(tally.count(Fault::Differs), QUERIES)
        ));
        lines.push(format!(
            "  {:<26}{:>9}{:>13}  witness",
            "erratum", "alone", "with others"
        ));
        for (erratum, Explained { alone, with_others }) in &tally.errata {
            let witness = if alone.count > 0 { alone } else { with_others };
            lines.push(format!(
                "  {erratum:<26}{:>9}{:>13}  {}",
                grouped(alone.count),
                grouped(with_others.count),
                first(witness)
            ));
        }
    }
    lines.push(String::new());
    lines.join("\n")
}

/// Who passes and who fails, as `--strict` counts it; where that depends on a tolerance, also
/// without it.
pub fn verdicts(panel: &Panel, total: &Block) -> String {
    let width = name_width(panel);
    let mut lines = vec!["Verdict:".to_owned()];
    for (judged, tally) in panel.subjects.iter().zip(&total.tallies) {
        let name = cut(judged.subject.name());
        let names = iter::once(name.as_str()).chain(iter::repeat(""));
        let words = verdict(judged, total, tally);
        lines.extend(
            names
                .zip(words)
                .map(|(name, words)| format!("  {name:<width$}{words}")),
        );
    }
    lines.push(String::new());
    lines.join("\n")
}

/// That a subject passes, or a line for each thing that it fails by, with and without its tolerance.
fn verdict(judged: &Judged, total: &Block, tally: &Tally) -> Vec<String> {
    let failures = strict::failures_of(judged, total, tally);
    let tolerated = strict::tolerated(judged, tally);
    let tolerance = tolerance(judged.subject.tolerance());
    let first = match (failures.is_empty(), tolerated.is_empty()) {
        (true, true) => Some("passes".to_owned()),
        (true, false) => Some(format!("passes with its tolerance, {tolerance}")),
        (false, _) => None,
    };
    let without = match first {
        Some(_) => "without it fails: ".to_owned(),
        None => format!("without its tolerance, {tolerance}, fails: "),
    };
    let idle = (tolerated.is_empty() && !tolerance.is_empty())
        .then(|| format!("its tolerance, {tolerance}, makes no difference"));
    let failures = failures.iter().map(|what| format!("fails: {what}"));
    let tolerated = tolerated.iter().map(|what| format!("{without}{what}"));
    let words = first.into_iter().chain(failures).chain(tolerated);
    words.chain(idle).collect()
}

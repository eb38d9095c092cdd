//! The summary of a certification: who passes, who fails and by what.

use std::cmp::Reverse;

use super::block::Block;
use super::findings::Findings;
use super::judged::Judged;
use super::run::Panel;
use super::strict;
use super::table::{Paint, Tone, count, cut, grouped, measure, tolerance, worst};
use super::tally::{Fault, Tally};

/// A column of the summary: how often a fault was found, or how bad the worst is.
pub struct Column {
    /// Two lines of heading.
    pub heading: [&'static str; 2],
    /// What stands in it, in a sentence.
    pub meaning: &'static str,
    fault: Fault,
    is_worst: bool,
}

impl Column {
    fn counting(fault: Fault, heading: [&'static str; 2]) -> Self {
        Column {
            heading,
            meaning: fault.meaning(),
            fault,
            is_worst: false,
        }
    }

    /// What stands in it of a subject; of one that took no query a dash.
    pub fn cell(&self, tally: &Tally) -> String {
        match self.is_worst {
            _ if tally.taken.is_empty() => "-".to_owned(),
            true => worst(tally, self.fault),
            false => count(tally, self.fault),
        }
    }

    /// As wide as the longest of its heading and its cells, and two blanks.
    fn width(&self, tallies: &[Tally]) -> usize {
        let cells = tallies.iter().map(|tally| self.cell(tally).len());
        let heading = self.heading.iter().map(|line| line.len());
        heading.chain(cells).max().unwrap_or(0) + 2
    }
}

/// The columns that say anything of these findings: what nobody can have is left out.
pub fn columns(findings: &Findings) -> Vec<Column> {
    let total = &findings.total;
    let has = |fault| total.tallies.iter().any(|tally| tally.count(fault) > 0);
    let columns = [
        (Fault::Tunnel, ["", "tunnels"], true),
        (Fault::JointTunnel, ["joint", "tunnels"], total.joints > 0),
        (Fault::MissedGraze, ["missed", "grazes"], true),
        (Fault::FalseHit, ["false", "hits"], true),
        (Fault::NearHit, ["near", "hits"], has(Fault::NearHit)),
        (Fault::NoAnswer, ["no", "answer"], true),
        (Fault::Differs, ["", "differ"], has(Fault::Differs)),
        (Fault::Late, ["", "late"], true),
    ];
    let columns = columns.into_iter().filter(|(.., is_there)| *is_there);
    let counting = columns.map(|(fault, heading, _)| Column::counting(fault, heading));
    let latest = Column {
        heading: ["worst", "late"],
        meaning: "by how much the latest of these is late, as a part of the step",
        fault: Fault::Late,
        is_worst: true,
    };
    counting.chain([latest]).collect()
}

/// The numbers of the subjects, those that fail first, the gravest faults first.
pub fn order(findings: &Findings) -> Vec<usize> {
    let Findings { panel, total, .. } = findings;
    let mut order: Vec<_> = (0..panel.subjects.len()).collect();
    order.sort_by_key(|&index| {
        let tally = &total.tallies[index];
        let count = |fault| tally.count(fault);
        (
            passes(&panel.subjects[index], total, tally),
            Reverse(count(Fault::Tunnel) + count(Fault::JointTunnel)),
            Reverse(count(Fault::MissedGraze)),
            Reverse(count(Fault::NoAnswer)),
            Reverse(count(Fault::FalseHit)),
        )
    });
    order
}

/// Whether a subject passes within its tolerance.
pub fn passes(judged: &Judged, total: &Block, tally: &Tally) -> bool {
    strict::failures_of(judged, total, tally).is_empty()
}

/// Every subject with its faults, a line each.
pub(super) fn table(findings: &Findings, paint: Paint) -> String {
    let Findings { panel, total, .. } = findings;
    let columns = columns(findings).into_iter();
    let columns: Vec<_> = columns
        .map(|column| (column.width(&total.tallies), column))
        .collect();
    let names = panel.subjects.iter();
    let names = names.map(|judged| cut(judged.subject.name()).chars().count() + 1);
    let width = names.max().unwrap_or(0).max("subject ".len());
    let heading = |line: usize, name: &str| {
        let cells = columns.iter();
        let cells = cells.map(|(wide, column)| format!("{:>wide$}", column.heading[line]));
        let text = format!("  {name:<width$}{:<6}{}", "", cells.collect::<String>());
        paint(Tone::Heading, &text)
    };
    let mut lines = vec![heading(0, ""), heading(1, "subject")];
    for index in order(findings) {
        let (judged, tally) = (&panel.subjects[index], &total.tallies[index]);
        let (tone, verdict) = match passes(judged, total, tally) {
            true => (Tone::Good, "passes"),
            false => (Tone::Bad, "FAILS"),
        };
        let verdict = paint(tone, &format!("{verdict:<6}"));
        let cells = columns.iter();
        let cells = cells.map(|(wide, column)| {
            let cell = format!("{:>wide$}", column.cell(tally));
            match cell.trim() {
                "0" | "-" => paint(Tone::Pale, &cell),
                _ => cell,
            }
        });
        let not_asked = match tally.not_asked() {
            0 => String::new(),
            some => format!("  (not asked {})", grouped(some)),
        };
        let name = cut(judged.subject.name());
        let cells: String = cells.collect();
        lines.push(format!("  {name:<width$}{verdict}{cells}{not_asked}"));
    }
    lines.push(String::new());
    lines.join("\n")
}

/// What each column means, a sentence each.
pub(super) fn legend(findings: &Findings, paint: Paint) -> String {
    let mut lines = Vec::new();
    for column in columns(findings) {
        let heading = column.heading.join(" ");
        lines.push(paint(
            Tone::Pale,
            &format!("  {:<16}{}", heading.trim(), column.meaning),
        ));
    }
    lines.push(String::new());
    lines.join("\n")
}

/// What a line of the table does not say: tolerances that matter, and queries that are refused.
pub(super) fn notes(panel: &Panel, total: &Block) -> String {
    let mut lines = Vec::new();
    for (judged, tally) in panel.subjects.iter().zip(&total.tallies) {
        let name = cut(judged.subject.name());
        let tolerated = strict::tolerated(judged, tally).join(", ");
        let tolerance = tolerance(judged.subject.tolerance());
        if !tolerated.is_empty() {
            let [with, without] = match passes(judged, total, tally) {
                true => ["passes", "fails"],
                false => ["fails", "also fails"],
            };
            lines.push(format!(
                "{name} {with} with its tolerance, {tolerance}; without it {without}: {tolerated}"
            ));
        } else if !tolerance.is_empty() {
            lines.push(format!(
                "{name} has a tolerance, {tolerance}, which makes no difference here"
            ));
        }
        let refusals = strict::refusals(total, tally);
        lines.extend(refusals.map(|what| format!("{name} fails: {what}")));
    }
    lines.iter().map(|line| format!("{line}\n")).collect()
}

/// The worst witness of each fault that fails a subject, with the command that explains it.
pub(super) fn witnesses(findings: &Findings, paint: Paint) -> String {
    let fails = |judged: &Judged, (fault, tally): (Fault, &Tally)| {
        strict::fails(judged.subject.tolerance(), tally, fault)
    };
    worst_of(findings, fails, paint)
}

/// The worst witness of each of these faults of each subject, with the command that explains it.
pub(super) fn worst_of(
    findings: &Findings,
    is_shown: impl Fn(&Judged, (Fault, &Tally)) -> bool,
    paint: Paint,
) -> String {
    let mut lines = Vec::new();
    for index in order(findings) {
        let judged = &findings.panel.subjects[index];
        let tally = &findings.total.tallies[index];
        let name = judged.subject.name();
        for (fault, finding) in &tally.faults {
            let witness = finding.worst.as_ref();
            let Some(witness) = witness.filter(|_| is_shown(judged, (*fault, tally))) else {
                continue;
            };
            let by = match measure(*fault, witness.severity) {
                by if by.is_empty() => by,
                by => format!(", {by}"),
            };
            lines.push(format!("  {}, {}{by}", cut(name), fault.name()));
            let command = findings.settings.caller.explain(witness, Some(name));
            lines.push(paint(Tone::Pale, &format!("    {command}")));
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    let heading = "Worst of each fault, and the command that explains it:";
    format!("{}\n{}\n", paint(Tone::Heading, heading), lines.join("\n"))
}

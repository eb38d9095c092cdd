//! The result of certification as text.

use super::run::{Block, Panel};
use super::tally::{Explained, Fault, Finding, Tally, Witness};
use crate::corpus::Entry;
use crate::corpus::jsonl::{self, Numbers};

/// The width of the subjects' names.
const NAME: usize = 18;

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

/// What was found, a block of lines for each source.
pub fn blocks(panel: &Panel, blocks: &[Block]) -> String {
    let mut lines = vec![
        line("", |(heading, ..)| heading[0].to_owned()),
        line("subject", |(heading, ..)| heading[1].to_owned()),
    ];
    for block in blocks {
        lines.push(String::new());
        lines.push(heading(block));
        for (judged, tally) in panel.subjects.iter().zip(&block.tallies) {
            lines.push(row(judged.subject.name(), block, tally));
        }
    }
    lines.push(String::new());
    lines.join("\n")
}

/// A line of the table: a name, then a cell in each column.
fn line(name: &str, cell: impl Fn(&Column) -> String) -> String {
    let cells = COLUMNS
        .iter()
        .map(|column| format!("{:>width$}", cell(column), width = column.1));
    format!("  {name:<NAME$}{}", cells.collect::<String>())
}

/// The line of a subject, with how many queries it was not asked where it takes only some.
fn row(name: &str, block: &Block, tally: &Tally) -> String {
    match tally.not_asked() {
        0 => line(name, |(.., cell)| cell(tally)),
        all if all == block.queries => format!("  {name:<NAME$}{:>9}", "not asked"),
        some => {
            let cells = line(name, |(.., cell)| cell(tally));
            format!("{cells}  (not asked {})", grouped(some))
        }
    }
}

fn heading(block: &Block) -> String {
    let some = |number, of| match number {
        0 => String::new(),
        number => format!(", {} {of}", grouped(number)),
    };
    format!(
        "{}: {} queries, {} hits, {} crossings{}{}",
        block.name,
        grouped(block.queries),
        grouped(block.hits),
        grouped(block.crossings),
        some(block.joints, "joints"),
        some(block.labels, "labels"),
    )
}

/// Whether the judges and the labels agree, and which errata explain the answers of subjects that
/// have any.
pub fn agreement(panel: &Panel, total: &Block) -> String {
    let mut lines = Vec::new();
    for (second, agreement) in panel.second_judges.iter().zip(&total.agreements) {
        if agreement.queries > 0 {
            let who = format!("oracle and {}", second.name());
            lines.push(agree(&who, agreement.queries, &agreement.disagreements));
        }
    }
    if total.labels > 0 {
        lines.push(agree(
            "oracle and labels",
            total.labels,
            &total.wrong_labels,
        ));
    }
    if total.joints > 0 {
        lines.push(joints(panel, total));
    }
    for (judged, tally) in panel.subjects.iter().zip(&total.tallies) {
        if tally.errata.is_empty() {
            continue;
        }
        lines.push(String::new());
        lines.push(format!(
            "{} differs from the exact answer on {} queries, which is explained by:",
            judged.subject.name(),
            count(tally, Fault::Differs)
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

/// Who lets wires tunnel though no single segment's miss looks bad.
fn joints(panel: &Panel, total: &Block) -> String {
    let subjects = panel.subjects.iter().zip(&total.tallies);
    let tunnels = subjects
        .filter(|(_, tally)| tally.count(Fault::JointTunnel) > 0)
        .map(|(judged, tally)| {
            let count = count(tally, Fault::JointTunnel);
            format!("{count} are missed by {}", judged.subject.name())
        });
    let tunnels = match tunnels.collect::<Vec<_>>() {
        missed if missed.is_empty() => "none is missed".to_owned(),
        missed => missed.join(", "),
    };
    format!(
        "of {} wires that are passed at a joint, {tunnels}",
        grouped(total.joints)
    )
}

fn agree(who: &str, queries: u64, against: &Finding) -> String {
    match against.count {
        0 => format!("{who} agree on all {} queries", grouped(queries)),
        count => format!(
            "{who} DISAGREE on {} of {} queries, first on {}",
            grouped(count),
            grouped(queries),
            first(against)
        ),
    }
}

fn first(finding: &Finding) -> &str {
    finding.worst.as_ref().map_or("", |witness| &witness.id)
}

/// The worst witness of each fault of each subject, with the command that explains it.
pub fn witnesses(panel: &Panel, total: &Block) -> String {
    let mut lines = Vec::new();
    for (judged, tally) in panel.subjects.iter().zip(&total.tallies) {
        for (fault, finding) in &tally.faults {
            let Some(witness) = &finding.worst else {
                continue;
            };
            lines.push(format!(
                "  {:<NAME$}{:<14}{:<15}{}",
                judged.subject.name(),
                fault.name(),
                measure(*fault, witness.severity),
                command(witness)
            ));
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    format!("Worst witness of each kind:\n{}\n", lines.join("\n"))
}

/// How bad a witness is, in a few letters.
fn measure(fault: Fault, severity: f64) -> String {
    match fault {
        Fault::Tunnel | Fault::JointTunnel | Fault::MissedGraze => format!("central {severity:.2}"),
        Fault::FalseHit => format!("gap {} m", short(severity)),
        Fault::Late | Fault::Early => format!("by {}", short(severity)),
        Fault::NearHit | Fault::NoAnswer | Fault::WrongCase | Fault::Differs => String::new(),
    }
}

/// The command that explains a witness, ready to paste into a shell.
pub fn command(witness: &Witness) -> String {
    if witness.id.starts_with(STANDARD_INPUT) {
        return explain_line(&witness.entry());
    }
    format!("{EXPLAIN} {}", quoted(&witness.id))
}

/// The command that explains a query that is in no file, ready to paste into a shell.
pub fn explain_line(entry: &Entry) -> String {
    let line = jsonl::write(entry, Numbers::Decimal);
    format!("echo {} | {EXPLAIN} -", quoted(&line))
}

const EXPLAIN: &str = "cargo run --release -- explain";

/// What the identifiers of queries begin with that no file holds.
const STANDARD_INPUT: &str = "-#";

/// A text as one word of a shell.
fn quoted(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./:@%+,=".contains(c);
    match text.chars().all(is_plain) {
        true => text.to_owned(),
        false => format!("'{}'", text.replace('\'', r"'\''")),
    }
}

fn count(tally: &Tally, fault: Fault) -> String {
    grouped(tally.count(fault))
}

fn worst(tally: &Tally, fault: Fault) -> String {
    short(tally.worst(fault))
}

/// A number of at least 0 to about three digits.
pub fn short(number: f64) -> String {
    match number {
        0.0 => "0".to_owned(),
        0.01..1000.0 => format!("{number:.3}"),
        _ => format!("{number:.1e}"),
    }
}

/// A number with a comma between groups of three digits.
pub fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quoted_text_is_one_word() {
        assert_eq!(quoted("lattice:1:4711"), "lattice:1:4711");
        assert_eq!(quoted("a b.csv#3"), "'a b.csv#3'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
    }

    #[test]
    fn grouped_has_a_comma_between_thousands() {
        for (number, text) in [
            (0, "0"),
            (999, "999"),
            (1000, "1,000"),
            (1234567, "1,234,567"),
        ] {
            assert_eq!(grouped(number), text);
        }
    }

    #[test]
    fn short_is_about_three_digits() {
        for (number, text) in [
            (0.0, "0"),
            (1.0, "1.000"),
            (2.449, "2.449"),
            (1.1e-16, "1.1e-16"),
        ] {
            assert_eq!(short(number), text);
        }
    }
}

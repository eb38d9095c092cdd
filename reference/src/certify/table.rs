//! The result of certification as text.

use std::iter;

use tunnelproof::narrow::Tolerance;

use super::block::Block;
use super::findings::Findings;
use super::judged::Judged;
use super::run::Panel;
use super::strict;
use super::tally::{Explained, Fault, Finding, Tally, Witness};
use crate::corpus::Entry;
use crate::corpus::jsonl::{self, Numbers};
use crate::field::{self, Integer};
use crate::program::Conduct;

/// The least and the greatest width of the subjects' names.
const NAME: [usize; 2] = [18, 48];

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

/// All that was found, as text. Its commands begin with `program`, [`CHECKOUT`] or [`INSTALLED`].
pub fn text(findings: &Findings, program: &str) -> String {
    let Findings {
        panel,
        settings,
        total,
        ..
    } = findings;
    let everything = (findings.blocks.len() > 1).then(|| total.clone());
    let all: Vec<_> = findings.blocks.iter().cloned().chain(everything).collect();
    let shard = match settings.shard.is_whole() {
        true => String::new(),
        false => format!(", shard {}", settings.shard),
    };
    let heading = format!(
        "tunnelproof {}, seed {}, exact arithmetic by {}{shard}",
        env!("CARGO_PKG_VERSION"),
        settings.seed,
        field::Default::BACKEND
    );
    [
        heading,
        blocks(panel, &all),
        agreement(panel, total),
        verdicts(panel, total),
        witnesses(panel, total, program) + &programs(&findings.programs),
    ]
    .join("\n")
}

/// What was found, a block of lines for each source.
pub fn blocks(panel: &Panel, blocks: &[Block]) -> String {
    let width = name_width(panel);
    let mut lines = vec![
        line(width, "", |(heading, ..)| heading[0].to_owned()),
        line(width, "subject", |(heading, ..)| heading[1].to_owned()),
    ];
    for block in blocks {
        lines.push(String::new());
        lines.push(heading(block));
        for (judged, tally) in panel.subjects.iter().zip(&block.tallies) {
            lines.push(row(width, judged.subject.name(), block, tally));
        }
    }
    lines.push(String::new());
    lines.join("\n")
}

/// A line of the table: a name, then a cell in each column.
fn line(width: usize, name: &str, cell: impl Fn(&Column) -> String) -> String {
    let cells = COLUMNS
        .iter()
        .map(|column| format!("{:>width$}", cell(column), width = column.1));
    format!("  {:<width$}{}", cut(name), cells.collect::<String>())
}

/// As wide as the longest name and a blank, so that columns stand below each other.
fn name_width(panel: &Panel) -> usize {
    let names = panel.subjects.iter().map(|judged| judged.subject.name());
    let longest = names.map(|name| cut(name).chars().count() + 1).max();
    longest.unwrap_or(0).max(NAME[0])
}

/// A name, or as much of its start and its end as there is room for: programs often differ in their
/// last argument.
fn cut(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    let Some(over) = letters.len().checked_sub(NAME[1]).filter(|&over| over > 0) else {
        return name.to_owned();
    };
    let (start, rest) = letters.split_at(NAME[1] / 3);
    let dots = &['.'; 3];
    [start, dots, &rest[over + dots.len()..]]
        .iter()
        .flat_map(|part| part.iter())
        .collect()
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
        lines.extend(lapses(judged.subject.name(), tally));
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
    let failures = failures.iter().map(|what| format!("fails: {what}"));
    let tolerated = tolerated.iter().map(|what| format!("{without}{what}"));
    first.into_iter().chain(failures).chain(tolerated).collect()
}

/// As `--permit` takes it.
pub fn tolerance(Tolerance { near, late }: Tolerance) -> String {
    let parts = [("near", near), ("late", late)].into_iter();
    let parts = parts.filter(|(_, value)| *value > 0.0);
    let parts: Vec<_> = parts
        .map(|(name, value)| format!("{name}={value:e}"))
        .collect();
    parts.join(",")
}

/// In which ways a subject gives no answer, and how often.
pub fn lapse_counts(tally: &Tally) -> String {
    let kinds = tally.lapses.iter();
    let kinds = kinds.map(|(kind, count)| format!("{} {}", grouped(*count), kind.name()));
    kinds.collect::<Vec<_>>().join(", ")
}

/// In which ways a subject gives no answer, with the first of them.
fn lapses(name: &str, tally: &Tally) -> Option<String> {
    let first = tally.faults.get(&Fault::NoAnswer)?.worst.as_ref()?;
    let detail = first.lapse.as_ref().map_or("", |lapse| &lapse.detail);
    Some(format!(
        "{name} gives no answer to {} queries: {}\n  first on {}: {detail}",
        count(tally, Fault::NoAnswer),
        lapse_counts(tally),
        first.id,
    ))
}

/// What programs did besides answering.
fn programs(programs: &[(String, Conduct)]) -> String {
    let mut text = String::new();
    for (name, conduct) in programs {
        let times = match conduct.starts {
            1 => "once".to_owned(),
            starts => format!("{} times", grouped(starts)),
        };
        text += &format!("\n{name} was started {times}");
        if conduct.surplus > 0 {
            text += &format!(", and wrote {} answers too many", grouped(conduct.surplus));
        }
        text += "\n";
        if !conduct.stderr.is_empty() {
            text += "The end of its standard error:\n";
        }
        let shown = conduct.stderr.lines().count().saturating_sub(SHOWN);
        for line in conduct.stderr.lines().skip(shown) {
            text += &format!("  | {line}\n");
        }
    }
    text
}

/// How many lines of a program's standard error are shown.
const SHOWN: usize = 10;

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
pub fn witnesses(panel: &Panel, total: &Block, program: &str) -> String {
    let width = name_width(panel);
    let mut lines = Vec::new();
    for (judged, tally) in panel.subjects.iter().zip(&total.tallies) {
        for (fault, finding) in &tally.faults {
            let Some(witness) = &finding.worst else {
                continue;
            };
            lines.push(format!(
                "  {:<width$}{:<14}{:<15}{}",
                cut(judged.subject.name()),
                fault.name(),
                measure(*fault, witness.severity),
                command_of(witness, Some(judged.subject.name()), program)
            ));
        }
    }
    if lines.is_empty() {
        return String::new();
    }
    format!("Worst witness of each kind:\n{}\n", lines.join("\n"))
}

/// How bad a witness is, in a few letters.
pub fn measure(fault: Fault, severity: f64) -> String {
    match fault {
        Fault::Tunnel | Fault::JointTunnel | Fault::MissedGraze => format!("central {severity:.2}"),
        Fault::FalseHit => format!("gap {} m", short(severity)),
        Fault::Late | Fault::Early => format!("by {}", short(severity)),
        Fault::NearHit | Fault::NoAnswer | Fault::WrongCase | Fault::Differs => String::new(),
    }
}

/// The command that explains a witness against a subject, ready to paste into a shell in a checkout.
pub fn command(witness: &Witness, subject: Option<&str>) -> String {
    command_of(witness, subject, CHECKOUT)
}

fn command_of(witness: &Witness, subject: Option<&str>, program: &str) -> String {
    let explain = if witness.id.starts_with(STANDARD_INPUT) {
        line_of(&witness.entry(), program)
    } else {
        format!("{program} explain {}", quoted(&witness.id))
    };
    // The others are asked without being named.
    match subject.filter(|name| PROGRAMS.iter().any(|program| name.starts_with(program))) {
        Some(name) => format!("{explain} --subject {}", quoted(name)),
        None => explain,
    }
}

/// The command that explains a query that is in no file, ready to paste into a shell in a checkout.
pub fn explain_line(entry: &Entry) -> String {
    line_of(entry, CHECKOUT)
}

fn line_of(entry: &Entry, program: &str) -> String {
    let line = jsonl::write(entry, Numbers::Decimal);
    format!("echo {} | {program} explain -", quoted(&line))
}

/// What commands begin with in a checkout of the project.
pub const CHECKOUT: &str = "cargo run --release --";

/// What commands begin with where the program is installed.
pub const INSTALLED: &str = "tunnelproof";

/// What the names of programs and of shared libraries begin with on the command line.
const PROGRAMS: [&str; 2] = ["cmd:", "lib:"];

/// What the identifiers of queries begin with that no file holds.
const STANDARD_INPUT: &str = "-#";

/// A text as one word of a shell.
pub fn quoted(text: &str) -> String {
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

    #[test]
    fn cut_names_keep_their_ends_and_are_as_wide_as_there_is_room() {
        let name = |last: &str| format!("cmd:python a/long/way/to/where/it/is/adapter.py {last}");
        let [one, other] = ["tight-inclusion", "additive"].map(|last| cut(&name(last)));
        assert_ne!(one, other);
        for (cut, last) in [(one, "tight-inclusion"), (other, "additive")] {
            assert_eq!(cut.chars().count(), NAME[1]);
            assert!(
                cut.starts_with("cmd:python a/") && cut.contains("..."),
                "{cut}"
            );
            assert!(cut.ends_with(last), "{cut}");
        }
        let short = "x".repeat(NAME[1]);
        assert_eq!(cut(&short), short);
    }
}

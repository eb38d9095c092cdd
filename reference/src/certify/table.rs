//! The result of certification as text.

use tunnelproof::narrow::Tolerance;

use super::block::Block;
use super::findings::Findings;
use super::run::Panel;
use super::tally::{Fault, Finding, Tally};
use super::{details, summary};
use crate::field::{self, Integer};
use crate::program::Conduct;

/// How much of the result is written, and in which colours.
#[derive(Clone, Copy)]
pub struct Shown {
    /// Also every family, all witnesses and the errata.
    pub details: bool,
    /// How words are coloured.
    pub paint: Paint,
}

/// Gives a text the colour of its meaning.
pub type Paint = fn(Tone, &str) -> String;

/// What a text means, for its colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Tone {
    /// That something passes.
    Good,
    /// That something fails.
    Bad,
    /// A heading.
    Heading,
    /// An aside.
    Pale,
}

impl Shown {
    /// The summary, without colours.
    pub const SUMMARY: Shown = Shown {
        details: false,
        paint: |_, text| text.to_owned(),
    };

    /// Everything, without colours.
    pub const EVERYTHING: Shown = Shown {
        details: true,
        ..Shown::SUMMARY
    };
}

/// What was found, as text: the summary, and the details if they are shown.
pub fn text(findings: &Findings, shown: Shown) -> String {
    let Findings { panel, total, .. } = findings;
    let mut parts = vec![
        heading(findings),
        summary::table(findings, shown.paint),
        summary::legend(findings, shown.paint),
        agreement(panel, total),
    ];
    if shown.details {
        parts.push(details::text(findings, shown.paint));
    } else {
        parts.push(summary::notes(panel, total));
        parts.push(summary::witnesses(findings, shown.paint));
    }
    parts.push(programs(&findings.programs).trim_start().to_owned());
    parts.retain(|part| !part.is_empty());
    parts.join("\n")
}

fn heading(findings: &Findings) -> String {
    let Findings {
        settings, total, ..
    } = findings;
    let shard = match settings.shard.is_whole() {
        true => String::new(),
        false => format!(", shard {}", settings.shard),
    };
    format!(
        "tunnelproof {}, seed {}, exact arithmetic by {}{shard}\n{} of {}: {}\n",
        env!("CARGO_PKG_VERSION"),
        settings.seed,
        field::Default::BACKEND,
        many(total.queries, QUERIES),
        match &findings.blocks[..] {
            [one] => one.name.clone(),
            several => format!("{} sources", several.len()),
        },
        contents(total),
    )
}

/// How many of the queries are hits and crossings, and how many are of joints or have labels.
pub(super) fn contents(block: &Block) -> String {
    let always = [
        (block.hits, ["hit", "hits"]),
        (block.crossings, ["crossing", "crossings"]),
    ];
    let sometimes = [
        (block.joints, ["joint", "joints"]),
        (block.labels, ["label", "labels"]),
    ];
    let there = sometimes.into_iter().filter(|(number, _)| *number > 0);
    let all = always.into_iter().chain(there);
    let all = all.map(|(number, names)| many(number, names));
    all.collect::<Vec<_>>().join(", ")
}

/// The least and the greatest width of the subjects' names.
const NAME: [usize; 2] = [18, 48];

/// As wide as the longest name and a blank, so that columns stand below each other.
pub(super) fn name_width(panel: &Panel) -> usize {
    let names = panel.subjects.iter().map(|judged| judged.subject.name());
    let longest = names.map(|name| cut(name).chars().count() + 1).max();
    longest.unwrap_or(0).max(NAME[0])
}

/// A name, or as much of its start and its end as there is room for: programs often differ in their
/// last argument.
pub fn cut(name: &str) -> String {
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

/// Whether the judges and the labels agree, which labels do not, and why answers are missing.
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
        lines.extend(wrong_labels(total));
    }
    if total.joints > 0 {
        lines.push(joints(panel, total));
    }
    for (judged, tally) in panel.subjects.iter().zip(&total.tallies) {
        lines.extend(lapses(judged.subject.name(), tally));
    }
    lines.push(String::new());
    lines.join("\n")
}

/// The queries whose labels are wrong, by name; of many the first.
fn wrong_labels(total: &Block) -> Vec<String> {
    let named = total.wrong_label_names.names().take(SHOWN_LABELS);
    let mut lines: Vec<_> = named.map(|name| format!("  wrong label: {name}")).collect();
    let more = total.wrong_labels.count.saturating_sub(lines.len() as u64);
    lines.extend((more > 0).then(|| format!("  and {} more", grouped(more))));
    lines
}

/// How many wrong labels are named.
const SHOWN_LABELS: usize = 20;

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
        0 if queries == 1 => format!("{who} agree on the query"),
        0 => format!("{who} agree on all {} queries", grouped(queries)),
        count => format!(
            "{who} DISAGREE on {} of {}, first on {}",
            grouped(count),
            many(queries, QUERIES),
            first(against)
        ),
    }
}

/// In which ways a subject gives no answer, with the first of them.
fn lapses(name: &str, tally: &Tally) -> Option<String> {
    let first = tally.faults.get(&Fault::NoAnswer)?.worst.as_ref()?;
    let detail = first.lapse.as_ref().map_or("", |lapse| &lapse.detail);
    Some(format!(
        "{name} gives no answer to {}: {}\n  first on {}: {detail}",
        many(tally.count(Fault::NoAnswer), QUERIES),
        lapse_counts(tally),
        first.id,
    ))
}

/// As `--permit` takes it.
pub fn tolerance(Tolerance { near, late }: Tolerance) -> String {
    let parts = [("near", near), ("late", late)].into_iter();
    let parts = parts.filter(|(_, value)| *value > 0.0);
    let parts: Vec<_> = parts
        .map(|(name, value)| match value {
            0.001..1e6 => format!("{name}={value}"),
            _ => format!("{name}={value:e}"),
        })
        .collect();
    parts.join(",")
}

/// In which ways a subject gives no answer, and how often.
pub fn lapse_counts(tally: &Tally) -> String {
    let kinds = tally.lapses.iter();
    let kinds = kinds.map(|(kind, count)| format!("{} {}", grouped(*count), kind.name()));
    kinds.collect::<Vec<_>>().join(", ")
}

/// What programs did besides answering.
pub fn programs(programs: &[(String, Conduct)]) -> String {
    let mut text = String::new();
    for (name, conduct) in programs {
        let times = match conduct.starts {
            1 => "once".to_owned(),
            starts => format!("{} times", grouped(starts)),
        };
        text += &format!("\n{name} was started {times}");
        if conduct.surplus > 0 {
            text += &format!(", and wrote {}", many(conduct.surplus, SURPLUS));
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

pub(super) fn first(finding: &Finding) -> &str {
    finding.worst.as_ref().map_or("", |witness| &witness.id)
}

/// How bad a witness is, in a few letters.
pub fn measure(fault: Fault, severity: f64) -> String {
    match fault {
        Fault::Tunnel | Fault::JointTunnel | Fault::MissedGraze => format!("central {severity:.2}"),
        // Not measured of bodies that turn.
        Fault::FalseHit if severity == 0.0 => String::new(),
        Fault::FalseHit => format!("gap {} m", short(severity)),
        Fault::Late | Fault::Early => format!("by {}", short(severity)),
        Fault::NearHit | Fault::NoAnswer | Fault::WrongCase | Fault::Differs => String::new(),
    }
}

pub(super) fn count(tally: &Tally, fault: Fault) -> String {
    grouped(tally.count(fault))
}

pub(super) fn worst(tally: &Tally, fault: Fault) -> String {
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

/// So many of something, of which one is called by the first name and several by the second.
pub fn many(number: u64, [one, several]: [&str; 2]) -> String {
    let name = if number == 1 { one } else { several };
    format!("{} {name}", grouped(number))
}

/// What queries are called, one and several.
pub const QUERIES: [&str; 2] = ["query", "queries"];

/// What is said of answers that nobody asked for.
pub const SURPLUS: [&str; 2] = ["answer too many", "answers too many"];

/// How many there are of something, as [`grouped`] writes it.
pub fn grouped_count(number: u64, one: &str, many: &str) -> String {
    format!(
        "{} {}",
        grouped(number),
        if number == 1 { one } else { many }
    )
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
    fn one_is_singular_and_thousands_have_commas() {
        let texts = [0, 1, 1234].map(|count| grouped_count(count, "query", "queries"));
        assert_eq!(texts, ["0 queries", "1 query", "1,234 queries"]);
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
    fn tolerance_is_written_as_people_write_numbers() {
        for (near, late, text) in [
            (0.0, 0.0, ""),
            (1.0, 0.01, "near=1,late=0.01"),
            (100.0, 1e-9, "near=100,late=1e-9"),
            (1e9, 0.0, "near=1e9"),
        ] {
            assert_eq!(tolerance(Tolerance { near, late }), text);
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

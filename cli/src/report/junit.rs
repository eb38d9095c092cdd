//! What was found as JUnit XML, which continuous integration systems show: a suite for each
//! subject, a case for each source.

use std::fmt::Write as _;

use tunnelproof_reference::certify::block::Block;
use tunnelproof_reference::certify::findings::Findings;
use tunnelproof_reference::certify::strict;

/// The findings as JUnit XML. A case fails if [`strict::failures_of`] says so, and is skipped if
/// the subject takes none of its queries. What the judges and the labels disagree on is a suite of
/// its own.
pub fn text(findings: &Findings) -> String {
    let subjects = findings.panel.subjects.iter().enumerate();
    let suites: String = subjects
        .map(|(index, judged)| {
            let cases = findings.blocks.iter().map(|block| {
                let tally = &block.tallies[index];
                let outcome = match tally.not_asked() == block.queries {
                    true => Outcome::Skipped,
                    false => Outcome::new(strict::failures_of(judged, block, tally)),
                };
                let witnesses = tally.faults.values().filter_map(|f| f.worst.as_ref());
                let name = Some(judged.subject.name());
                let commands =
                    witnesses.map(|witness| findings.settings.caller.explain(witness, name));
                let commands: Vec<_> = commands.collect();
                (block, outcome, commands)
            });
            suite(judged.subject.name(), &cases.collect::<Vec<_>>())
        })
        .collect();
    let judges = findings.blocks.iter().map(|block| {
        let failures = strict::disagreements(&findings.panel, block);
        (block, Outcome::new(failures), Vec::new())
    });
    let judges = suite("judges", &judges.collect::<Vec<_>>());
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n{suites}{judges}</testsuites>\n"
    )
}

enum Outcome {
    Passed,
    Skipped,
    Failed(Vec<String>),
}

impl Outcome {
    fn new(failures: Vec<String>) -> Self {
        match failures.is_empty() {
            true => Outcome::Passed,
            false => Outcome::Failed(failures),
        }
    }
}

fn suite(name: &str, cases: &[(&Block, Outcome, Vec<String>)]) -> String {
    let count =
        |is: fn(&Outcome) -> bool| cases.iter().filter(|(_, outcome, _)| is(outcome)).count();
    let name = escaped(name);
    let mut text = format!(
        "  <testsuite name=\"{name}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n",
        cases.len(),
        count(|outcome| matches!(outcome, Outcome::Failed(_))),
        count(|outcome| matches!(outcome, Outcome::Skipped)),
    );
    for (block, outcome, commands) in cases {
        let _ = write!(
            text,
            "    <testcase classname=\"{name}\" name=\"{}\"",
            escaped(&block.name)
        );
        text += &match outcome {
            Outcome::Passed => "/>\n".to_owned(),
            Outcome::Skipped => ">\n      <skipped/>\n    </testcase>\n".to_owned(),
            Outcome::Failed(failures) => format!(
                ">\n      <failure message=\"{}\">{}</failure>\n    </testcase>\n",
                escaped(&failures.join(", ")),
                escaped(&commands.join("\n")),
            ),
        };
    }
    text + "  </testsuite>\n"
}

/// The text as content or attribute of XML. Control characters, which XML cannot have, become
/// blanks.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\n' => escaped += "&#10;",
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

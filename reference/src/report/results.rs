//! The result of certification as JSON.
//!
//! | field | meaning |
//! | --- | --- |
//! | `version`, `arithmetic` | of this crate; the backend of the exact numbers |
//! | `seed`, `count` | of the families |
//! | `second_judges` | the first of them that takes a query has to agree with the oracle |
//! | `permitted` | the tolerances that `failures` goes by |
//! | `sources` | what was found on each source, in the order of the table |
//! | `total` | the same over all of them |
//! | `failures` | what fails; empty if everything passes |
//!
//! A source has `name`, `queries`, `hits`, `crossings`, `joints` (pairs of consecutive segments of a
//! wire that is passed), `labels`, the findings `wrong_labels` and
//! `disagreements` (oracle against each second judge, by its name), and `subjects`. A subject has
//! `subject`, `not_asked` (queries that it does not take), `hits` (that it reports), `faults`, a finding by name, and `errata`, by the erratum that explains
//! an answer two findings, `alone` and `with_others`. A finding has `count` and `worst`, its worst witness: `severity`, `id`,
//! the `command` that explains it, the `query` with decimal and with hexadecimal numbers
//! ([`crate::corpus::jsonl`] reads both), `truth` and `answer` ([`super::answer`]; `null` for no
//! answer). `severity` is the gap of a false hit in metres, the difference of a late or early time
//! of impact, and for missed contacts how far time and place are from their ends
//! ([`crate::certify::tally`]).

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;

use crate::certify::permitted::{PERMITTED, Permitted};
use crate::certify::run::{Block, Panel};
use crate::certify::strict::failures;
use crate::certify::table::command;
use crate::certify::tally::{Explained, Fault, Finding, Tally, Witness};
use crate::corpus::jsonl::{self, Numbers};
use crate::field::{self, Integer};

use super::answer::Fields;

/// The result of certification.
#[derive(Serialize)]
pub struct Results<'a> {
    version: &'static str,
    arithmetic: &'static str,
    seed: u64,
    count: u64,
    second_judges: Vec<&'a str>,
    permitted: Vec<PermittedRow>,
    sources: Vec<Source<'a>>,
    total: Source<'a>,
    failures: Vec<String>,
}

#[derive(Serialize)]
struct PermittedRow {
    subject: &'static str,
    distance: f64,
    late: f64,
    source: &'static str,
}

#[derive(Serialize)]
struct Source<'a> {
    name: &'a str,
    queries: u64,
    hits: u64,
    crossings: u64,
    joints: u64,
    labels: u64,
    wrong_labels: Found<'a>,
    disagreements: BTreeMap<&'a str, Found<'a>>,
    subjects: Vec<Subject<'a>>,
}

#[derive(Serialize)]
struct Subject<'a> {
    subject: &'a str,
    not_asked: u64,
    hits: u64,
    faults: BTreeMap<&'static str, Found<'a>>,
    errata: BTreeMap<&'a str, ExplainedFields<'a>>,
}

#[derive(Serialize)]
struct Found<'a> {
    count: u64,
    worst: Option<WitnessFields<'a>>,
}

#[derive(Serialize)]
struct ExplainedFields<'a> {
    alone: Found<'a>,
    with_others: Found<'a>,
}

#[derive(Serialize)]
struct WitnessFields<'a> {
    severity: f64,
    id: &'a str,
    command: String,
    query: Value,
    query_hexadecimal: Value,
    truth: Fields,
    answer: Option<Fields>,
}

impl<'a> Results<'a> {
    /// The result of judging families of `count` queries of `seed`, and other sources.
    pub fn new(
        panel: &Panel<'a>,
        seed: u64,
        count: u64,
        blocks: &'a [Block],
        total: &'a Block,
    ) -> Self {
        Results {
            version: env!("CARGO_PKG_VERSION"),
            arithmetic: field::Default::BACKEND,
            seed,
            count,
            second_judges: panel
                .second_judges
                .iter()
                .map(|judge| judge.name())
                .collect(),
            permitted: PERMITTED.iter().map(PermittedRow::from).collect(),
            sources: blocks.iter().map(|block| source(panel, block)).collect(),
            total: source(panel, total),
            failures: failures(panel, total),
        }
    }

    /// The result as text, indented.
    pub fn text(&self) -> String {
        let text = serde_json::to_string_pretty(self).expect("fields of text and numbers are JSON");
        text + "\n"
    }
}

fn source<'a>(panel: &Panel<'a>, block: &'a Block) -> Source<'a> {
    let subjects = panel.subjects.iter().zip(&block.tallies);
    let judges = panel.second_judges.iter();
    Source {
        name: &block.name,
        queries: block.queries,
        hits: block.hits,
        crossings: block.crossings,
        joints: block.joints,
        labels: block.labels,
        wrong_labels: (&block.wrong_labels).into(),
        disagreements: (judges.zip(&block.agreements))
            .map(|(judge, agreement)| (judge.name(), (&agreement.disagreements).into()))
            .collect(),
        subjects: subjects
            .map(|(judged, tally)| subject(judged.subject.name(), tally))
            .collect(),
    }
}

fn subject<'a>(name: &'a str, tally: &'a Tally) -> Subject<'a> {
    let found = |fault| {
        let nothing = Found {
            count: 0,
            worst: None,
        };
        tally.faults.get(&fault).map_or(nothing, Found::from)
    };
    Subject {
        subject: name,
        not_asked: tally.not_asked(),
        hits: tally.hits,
        faults: Fault::ALL
            .into_iter()
            .map(|fault| (fault.name(), found(fault)))
            .collect(),
        errata: tally
            .errata
            .iter()
            .map(|(&erratum, explained)| (erratum, explained.into()))
            .collect(),
    }
}

impl From<&Permitted> for PermittedRow {
    fn from(
        &Permitted {
            subject,
            distance,
            late,
            borders: _,
            source,
        }: &Permitted,
    ) -> Self {
        PermittedRow {
            subject,
            distance,
            late,
            source,
        }
    }
}

impl<'a> From<&'a Finding> for Found<'a> {
    fn from(finding: &'a Finding) -> Self {
        Found {
            count: finding.count,
            worst: finding.worst.as_ref().map(WitnessFields::from),
        }
    }
}

impl<'a> From<&'a Explained> for ExplainedFields<'a> {
    fn from(explained: &'a Explained) -> Self {
        ExplainedFields {
            alone: (&explained.alone).into(),
            with_others: (&explained.with_others).into(),
        }
    }
}

impl<'a> From<&'a Witness> for WitnessFields<'a> {
    fn from(witness: &'a Witness) -> Self {
        let entry = witness.entry();
        let query = |numbers| {
            let line = jsonl::write(&entry, numbers);
            serde_json::from_str(&line).expect("a query is written as JSON")
        };
        WitnessFields {
            severity: witness.severity,
            id: &witness.id,
            command: command(witness),
            query: query(Numbers::Decimal),
            query_hexadecimal: query(Numbers::Hexadecimal),
            truth: Fields::exact(&witness.truth),
            answer: witness.answer.as_ref().map(Fields::new),
        }
    }
}

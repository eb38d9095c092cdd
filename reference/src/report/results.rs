//! The result of certification as JSON. [`super::merge`] reads it again, and puts parts together.
//!
//! | field | meaning |
//! | --- | --- |
//! | `version`, `arithmetic` | of this crate; the backend of the exact numbers |
//! | `command` | that judges all of it again |
//! | `caller` | who asked: `test`, `python`, or `shell` with what its commands begin with |
//! | `seed`, `count` | of the families |
//! | `shard` | which part of the queries this is, `1/1` for all |
//! | `second_judges` | the first of them that takes a query has to agree with the oracle |
//! | `tolerances` | what each subject declares of itself: `near` in metres and `late`, without unit |
//! | `sources` | what was found on each source, in the order of the table |
//! | `total` | the same over all of them |
//! | `failures` | what fails, each subject within its tolerance; empty if everything passes |
//! | `exact_failures` | what fails if none has a tolerance |
//! | `programs` | of subjects that are programs: `subject`, `starts` (how often it was started), `surplus` (answers at the end that nobody asked for), the end of its `stderr` |
//!
//! `reference/schema/certificate.json` is its JSON schema.
//!
//! A source has `name`, `fingerprint` ([`crate::certify::fingerprint`]), `queries`, `hits`,
//! `crossings`, `joints` (pairs of consecutive segments of a wire that is passed), `labels`, the
//! finding `wrong_labels`, the first of these queries by `place` and `id` in `wrong_label_names`, `agreements` (oracle against each second judge, by its name: how many
//! `queries` it was asked, and the finding `disagreements`), and `subjects`. A subject has
//! `subject`, `taken` and `refused` (sorts of queries: `kind`, `has_radius`,
//! of those refused how many `queries`), `hits` (that it reports), `lapses` (in which ways it gives
//! no answer, and how often), `faults`, a finding by name, and `errata`, by the erratum that
//! explains an answer two findings, `alone` and `with_others`. A finding has `count` and `worst`,
//! its worst witness: `severity`, `rank` (what it was chosen by), `place` (of the query in its
//! source, from 0), `id`, the `command` that explains it, the `query` with decimal and with
//! hexadecimal numbers ([`crate::corpus::jsonl`] and [`crate::corpus::turning`] read both), `truth` and `answer`
//! ([`super::answer`]; `null` for no answer), and `lapse`, how the subject failed, if it did:
//! `kind` and `detail`. `severity` is the gap of a false hit in metres, the difference of a late or
//! early time of impact, and for missed contacts how far time and place are from their ends
//! ([`crate::certify::tally`]).

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, Serialize};
use serde_json::{Value, json};

use crate::certify::block::Block;
use crate::certify::caller::Caller;
use crate::certify::findings::Findings;
use crate::certify::judged::Judged;
use crate::certify::run::Panel;
use crate::certify::strict::{exact_failures, failures};
use crate::certify::tally::{Explained, Fault, Finding, Sort, Statement, Tally, Witness};
use crate::corpus::jsonl::Numbers;
use crate::field::{self, Integer};

use super::answer::Fields;
use tunnelproof::narrow::Tolerance;
use tunnelproof::query::QueryKind;

/// The result of certification.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Results {
    pub(super) version: String,
    pub(super) arithmetic: String,
    pub(super) command: String,
    pub(super) caller: Caller,
    pub(super) seed: u64,
    pub(super) count: u64,
    pub(super) shard: String,
    pub(super) second_judges: Vec<String>,
    pub(super) tolerances: Vec<ToleranceRow>,
    pub(super) sources: Vec<SourceRow>,
    total: SourceRow,
    failures: Vec<String>,
    exact_failures: Vec<String>,
    pub(super) programs: Vec<ProgramRow>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct ProgramRow {
    pub(super) subject: String,
    pub(super) starts: u64,
    pub(super) surplus: u64,
    pub(super) stderr: String,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct ToleranceRow {
    pub(super) subject: String,
    pub(super) near: f64,
    pub(super) late: f64,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct SourceRow {
    pub(super) name: String,
    pub(super) fingerprint: String,
    pub(super) queries: u64,
    pub(super) hits: u64,
    pub(super) crossings: u64,
    pub(super) joints: u64,
    pub(super) labels: u64,
    pub(super) wrong_labels: FindingRow,
    pub(super) wrong_label_names: Vec<NameRow>,
    pub(super) agreements: BTreeMap<String, AgreementRow>,
    pub(super) subjects: Vec<SubjectRow>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct NameRow {
    pub(super) place: u64,
    pub(super) id: String,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct AgreementRow {
    pub(super) queries: u64,
    pub(super) disagreements: FindingRow,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct SubjectRow {
    pub(super) subject: String,
    pub(super) taken: Vec<SortRow>,
    pub(super) refused: Vec<RefusedRow>,
    pub(super) hits: u64,
    pub(super) lapses: BTreeMap<String, u64>,
    pub(super) faults: BTreeMap<String, FindingRow>,
    pub(super) errata: BTreeMap<String, ExplainedRow>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct SortRow {
    pub(super) kind: String,
    pub(super) has_radius: bool,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct RefusedRow {
    #[serde(flatten)]
    pub(super) sort: SortRow,
    pub(super) queries: u64,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct FindingRow {
    pub(super) count: u64,
    pub(super) worst: Option<WitnessRow>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct ExplainedRow {
    pub(super) alone: FindingRow,
    pub(super) with_others: FindingRow,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct WitnessRow {
    #[serde(deserialize_with = "infinite_if_null")]
    pub(super) severity: f64,
    #[serde(deserialize_with = "infinite_if_null")]
    pub(super) rank: f64,
    pub(super) place: u64,
    pub(super) id: String,
    command: String,
    query: Value,
    pub(super) query_hexadecimal: Value,
    truth: Value,
    pub(super) answer: Option<Value>,
    pub(super) lapse: Option<LapseRow>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct LapseRow {
    pub(super) kind: String,
    pub(super) detail: String,
}

/// JSON has no infinity: it is written as `null`.
fn infinite_if_null<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Option::deserialize(deserializer).map(|number| number.unwrap_or(f64::INFINITY))
}

impl Results {
    /// The result of a certification.
    pub fn new(findings: &Findings) -> Self {
        let Findings {
            panel,
            settings,
            blocks,
            total,
            programs,
        } = findings;
        let judges = panel.second_judges.iter();
        let programs = programs.iter().map(|(subject, conduct)| ProgramRow {
            subject: subject.clone(),
            starts: conduct.starts,
            surplus: conduct.surplus,
            stderr: conduct.stderr.clone(),
        });
        Results {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            arithmetic: field::Default::BACKEND.to_owned(),
            command: settings.command.clone(),
            caller: settings.caller.clone(),
            seed: settings.seed,
            count: settings.count,
            shard: settings.shard.to_string(),
            second_judges: judges.map(|judge| judge.name().to_owned()).collect(),
            tolerances: panel.subjects.iter().map(ToleranceRow::from).collect(),
            sources: (blocks.iter())
                .map(|block| source(panel, block, &settings.caller))
                .collect(),
            total: source(panel, total, &settings.caller),
            failures: failures(panel, total),
            exact_failures: exact_failures(panel, total),
            programs: programs.collect(),
        }
    }

    /// The result as text, indented.
    pub fn text(&self) -> String {
        let text = serde_json::to_string_pretty(self).expect("fields of text and numbers are JSON");
        text + "\n"
    }
}

fn source(panel: &Panel, block: &Block, caller: &Caller) -> SourceRow {
    let subjects = panel.subjects.iter().zip(&block.tallies);
    let judges = panel.second_judges.iter().zip(&block.agreements);
    let agreements = judges.map(|(judge, agreement)| {
        let row = AgreementRow {
            queries: agreement.queries,
            disagreements: FindingRow::new(&agreement.disagreements, None, caller),
        };
        (judge.name().to_owned(), row)
    });
    SourceRow {
        name: block.name.clone(),
        fingerprint: block.fingerprint.to_string(),
        queries: block.queries,
        hits: block.hits,
        crossings: block.crossings,
        joints: block.joints,
        labels: block.labels,
        wrong_labels: FindingRow::new(&block.wrong_labels, None, caller),
        wrong_label_names: (block.wrong_label_names.all().iter())
            .map(|(place, id)| NameRow {
                place: *place,
                id: id.clone(),
            })
            .collect(),
        agreements: agreements.collect(),
        subjects: subjects
            .map(|(judged, tally)| subject(judged, tally, caller))
            .collect(),
    }
}

fn subject(judged: &Judged, tally: &Tally, caller: &Caller) -> SubjectRow {
    let found = |fault| {
        let nothing = FindingRow {
            count: 0,
            worst: None,
        };
        let found = tally.faults.get(&fault);
        found.map_or(nothing, |found| {
            FindingRow::new(found, Some(judged.subject.name()), caller)
        })
    };
    let refused = tally.refused.iter().map(|(sort, queries)| RefusedRow {
        sort: sort.into(),
        queries: *queries,
    });
    let lapses = tally.lapses.iter();
    let errata = tally.errata.iter();
    SubjectRow {
        subject: judged.subject.name().to_owned(),
        taken: tally.taken.iter().map(SortRow::from).collect(),
        refused: refused.collect(),
        hits: tally.hits,
        lapses: lapses
            .map(|(kind, count)| (kind.name().to_owned(), *count))
            .collect(),
        faults: Fault::ALL
            .into_iter()
            .map(|fault| (fault.name().to_owned(), found(fault)))
            .collect(),
        errata: errata
            .map(|(erratum, explained)| (erratum.clone(), ExplainedRow::new(explained, caller)))
            .collect(),
    }
}

/// What a subject says of a query of this kind, as JSON.
pub fn written(kind: QueryKind, answer: &Statement) -> Value {
    match answer {
        Statement::Answer(answer) => json!(Fields::new(kind, answer)),
        Statement::Written(answer) => answer.clone(),
    }
}

impl From<&Sort> for SortRow {
    fn from(sort: &Sort) -> Self {
        SortRow {
            kind: sort.kind.name().to_owned(),
            has_radius: sort.has_radius,
        }
    }
}

impl From<&Judged<'_>> for ToleranceRow {
    fn from(judged: &Judged) -> Self {
        let Tolerance { near, late } = judged.subject.tolerance();
        ToleranceRow {
            subject: judged.subject.name().to_owned(),
            near,
            late,
        }
    }
}

impl FindingRow {
    fn new(finding: &Finding, subject: Option<&str>, caller: &Caller) -> Self {
        let worst = finding.worst.as_ref();
        FindingRow {
            count: finding.count,
            worst: worst.map(|witness| WitnessRow::new(witness, subject, caller)),
        }
    }
}

impl ExplainedRow {
    fn new(explained: &Explained, caller: &Caller) -> Self {
        let [alone, with_others] = [&explained.alone, &explained.with_others]
            .map(|finding| FindingRow::new(finding, None, caller));
        ExplainedRow { alone, with_others }
    }
}

impl WitnessRow {
    fn new(witness: &Witness, subject: Option<&str>, caller: &Caller) -> Self {
        let query = |numbers| {
            let line = witness.query.line(&witness.id, numbers);
            serde_json::from_str(&line).expect("a query is written as JSON")
        };
        WitnessRow {
            severity: witness.severity,
            rank: witness.rank,
            place: witness.place,
            id: witness.id.clone(),
            command: caller.explain(witness, subject),
            query: query(Numbers::Decimal),
            query_hexadecimal: query(Numbers::Hexadecimal),
            truth: json!(Fields::exact(&witness.truth)),
            answer: witness
                .answer
                .as_ref()
                .map(|answer| written(witness.query.shape(), answer)),
            lapse: witness.lapse.as_ref().map(|lapse| LapseRow {
                kind: lapse.kind.name().to_owned(),
                detail: lapse.detail.clone(),
            }),
        }
    }
}

//! Bodies that turn: subjects judged on the families of such queries.
//!
//! As for linear motion, the oracle is the truth and a second judge has to agree with it. The gap of
//! a false hit is not measured, so that no hit counts as near.

use std::collections::BTreeMap;
use std::ops::Range;

use rayon::prelude::*;
use tunnelproof::narrow::Tolerance;
use tunnelproof::rigid::RigidQuery;

use crate::answer::ExactAnswer;
use crate::field::{self, Integer};
use crate::generate::{RigidFamily, RigidId};
use crate::oracle::{Oracle, decide_rigid_query};
use crate::subject::{Answer, NoAnswer, RigidSubject, Subject};

use super::strict::{counts, took_none, words};
use super::table::{Paint, Shown, Tone, cut, grouped, short};
use super::tally::Fault;
use super::verdict::{Judgement, judge};

/// Who judges and who is judged. A subject with the name of a judge is that judge.
pub struct RigidPanel<'a> {
    /// Has to agree with the oracle on every query.
    pub second: Option<&'a dyn RigidSubject>,
    /// Who is judged, in the order of tables.
    pub subjects: Vec<&'a dyn RigidSubject>,
}

/// The first queries of a family.
#[derive(Clone, Copy)]
pub struct RigidSource {
    /// The family.
    pub family: &'static RigidFamily,
    /// The seed of the family.
    pub seed: u64,
    /// How many queries.
    pub count: u64,
}

/// What was found on some queries.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RigidBlock {
    /// The name of the family.
    pub name: String,
    /// How many queries there were.
    pub queries: u64,
    /// How many of them are hits.
    pub hits: u64,
    /// How many of them are crossed.
    pub crossings: u64,
    /// Queries on which the second judge does not say what the oracle says.
    pub disagreements: RigidFinding,
    /// What was found of each subject, in the order of the panel.
    pub tallies: Vec<RigidTally>,
}

/// What was found of one subject.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RigidTally {
    /// How many queries it does not take.
    pub not_asked: u64,
    /// What was wrong with its answers.
    pub faults: BTreeMap<Fault, RigidFinding>,
}

/// How often something was found, and its worst witness, of equals the first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RigidFinding {
    /// How often.
    pub count: u64,
    /// How bad the worst is, by the measure of its [`Fault`].
    pub severity: f64,
    /// The identifier of the worst.
    pub id: String,
    /// Why it has no answer, if it has none.
    pub lapse: Option<String>,
}

/// How many queries a subject is asked for at once.
const CHUNK: u64 = 64;

impl RigidPanel<'_> {
    /// Judges every query of a source. `progress` is told how many were judged since it was told
    /// before.
    pub fn run(&self, source: RigidSource, progress: impl Fn(u64) + Sync) -> RigidBlock {
        let chunks = (0..source.count.div_ceil(CHUNK)).into_par_iter();
        let blocks = chunks.map(|chunk| {
            let first = chunk * CHUNK;
            let block = self.judge(source, first..source.count.min(first + CHUNK));
            progress(block.queries);
            block
        });
        let block = blocks.reduce(RigidBlock::default, |mut earlier, later| {
            earlier.merge(later);
            earlier
        });
        RigidBlock {
            name: source.family.name().to_owned(),
            tallies: match block.tallies.is_empty() {
                true => vec![RigidTally::default(); self.subjects.len()],
                false => block.tallies,
            },
            ..block
        }
    }

    fn judge(&self, source: RigidSource, indices: Range<u64>) -> RigidBlock {
        let id = |index: u64| RigidId {
            family: source.family,
            seed: source.seed,
            index,
        };
        let ids: Vec<RigidId> = indices.map(id).collect();
        let queries: Vec<RigidQuery> = ids.iter().map(RigidId::query).collect();
        let truths: Vec<ExactAnswer> = queries.iter().map(decide_rigid_query).collect();
        let second = self
            .second
            .map(|judge| (judge.name(), judge.answers(&queries)));
        let ids: Vec<String> = ids.iter().map(RigidId::to_string).collect();
        let mut block = RigidBlock {
            queries: truths.len() as u64,
            tallies: vec![RigidTally::default(); self.subjects.len()],
            ..RigidBlock::default()
        };
        for hit in truths.iter().filter_map(|truth| truth.hit) {
            block.hits += 1;
            block.crossings += u64::from(hit.crosses);
        }
        if let Some((_, answers)) = &second {
            let judged = truths.iter().zip(answers).zip(&ids);
            let differing =
                judged.filter(|((truth, answer), _)| **answer != Ok(Answer::Exact(**truth)));
            differing.for_each(|(_, id)| block.disagreements.add(id, 0.0, None));
        }
        for (subject, tally) in self.subjects.iter().zip(&mut block.tallies) {
            let answers = match &second {
                _ if subject.name() == Oracle.name() => truths
                    .iter()
                    .map(|truth| Ok(Answer::Exact(*truth)))
                    .collect(),
                Some((name, answers)) if subject.name() == *name => answers.clone(),
                _ => subject.answers(&queries),
            };
            assert_eq!(
                answers.len(),
                queries.len(),
                "{} answers each query once",
                subject.name()
            );
            for ((truth, answer), id) in truths.iter().zip(answers).zip(&ids) {
                tally.add(id, truth, answer);
            }
        }
        block
    }
}

impl RigidTally {
    fn add(&mut self, id: &str, truth: &ExactAnswer, answer: Result<Answer, NoAnswer>) {
        let (answer, lapse) = match answer {
            Ok(answer) => (Some(answer), None),
            Err(NoAnswer::Unsupported(_)) => {
                self.not_asked += 1;
                return;
            }
            Err(NoAnswer::Lapse(lapse)) => (None, Some(lapse.detail)),
        };
        let judgement: Judgement = judge(truth, answer.as_ref(), || false);
        for (fault, severity) in judgement.faults(&truth.into(), || 0.0) {
            let finding = self.faults.entry(fault).or_default();
            finding.add(id, severity, lapse.clone());
        }
    }

    /// How often this fault was found.
    pub fn count(&self, fault: Fault) -> u64 {
        self.faults.get(&fault).map_or(0, |finding| finding.count)
    }

    /// Whether there is such a fault, and it counts.
    fn fails(&self, tolerance: Tolerance, fault: Fault) -> bool {
        let found = self.faults.get(&fault);
        found.is_some_and(|found| counts(tolerance, fault, found.severity))
    }

    fn merge(&mut self, later: RigidTally) {
        self.not_asked += later.not_asked;
        for (fault, finding) in later.faults {
            self.faults.entry(fault).or_default().merge(finding);
        }
    }
}

impl RigidFinding {
    fn add(&mut self, id: &str, severity: f64, lapse: Option<String>) {
        self.merge(RigidFinding {
            count: 1,
            severity,
            id: id.to_owned(),
            lapse,
        });
    }

    fn merge(&mut self, later: RigidFinding) {
        let count = self.count + later.count;
        if self.count == 0 || later.count > 0 && later.severity > self.severity {
            *self = later;
        }
        self.count = count;
    }
}

impl RigidBlock {
    /// Adds what was found on later queries.
    pub fn merge(&mut self, later: RigidBlock) {
        self.queries += later.queries;
        self.hits += later.hits;
        self.crossings += later.crossings;
        self.disagreements.merge(later.disagreements);
        self.tallies.resize_with(
            later.tallies.len().max(self.tallies.len()),
            RigidTally::default,
        );
        for (tally, later) in self.tallies.iter_mut().zip(later.tallies) {
            tally.merge(later);
        }
    }
}

/// What fails: a line for each subject, and for the second judge if it disagrees; none if everything
/// passes. As [`strict`](super::strict::failures) has it: early times of impact and wrong cases
/// alone fail nobody.
pub fn failures(panel: &RigidPanel, total: &RigidBlock) -> Vec<String> {
    let subjects = panel.subjects.iter().zip(&total.tallies);
    let lines = subjects.filter_map(|(subject, tally)| {
        let failures = failures_of(*subject, total, tally).join(", ");
        (!failures.is_empty()).then(|| format!("{}: {failures}", subject.name()))
    });
    let mut lines: Vec<_> = lines.collect();
    if let Some(second) = panel.second.filter(|_| total.disagreements.count > 0) {
        let count = grouped(total.disagreements.count);
        lines.push(format!(
            "oracle and {} disagree on {count} queries",
            second.name()
        ));
    }
    lines
}

fn failures_of(subject: &dyn RigidSubject, total: &RigidBlock, tally: &RigidTally) -> Vec<String> {
    let tolerance = subject.tolerance();
    let faults = Fault::ALL.into_iter();
    let faults = faults.filter(|&fault| tally.fails(tolerance, fault));
    let faults = faults.map(|fault| {
        format!(
            "{} {}",
            grouped(tally.count(fault)),
            words(tolerance, fault)
        )
    });
    let takes_none = total.queries > 0 && tally.not_asked == total.queries;
    let none = takes_none.then(|| took_none(total.queries));
    faults.chain(none).collect()
}

/// What was found, as text: a table of all queries, with `details` one of each family as well.
pub fn text(panel: &RigidPanel, seed: u64, blocks: &[RigidBlock], shown: Shown) -> String {
    let mut total = RigidBlock::default();
    blocks.iter().for_each(|block| total.merge(block.clone()));
    total.name = match blocks {
        [one] => one.name.clone(),
        several => format!("{} families", several.len()),
    };
    let heading = format!(
        "tunnelproof {}, seed {seed}, exact arithmetic by {}\n",
        env!("CARGO_PKG_VERSION"),
        field::Default::BACKEND,
    );
    let mut text = heading + &table(panel, &total, shown.paint);
    text += &agreement(panel, &total);
    text += &witnesses(panel, &total);
    if shown.details {
        for block in blocks {
            text += &format!("\n{}", table(panel, block, shown.paint));
        }
    }
    text
}

const COLUMNS: [(Fault, &str); 6] = [
    (Fault::Tunnel, "tunnels"),
    (Fault::MissedGraze, "missed grazes"),
    (Fault::FalseHit, "false hits"),
    (Fault::NoAnswer, "no answer"),
    (Fault::Differs, "differ"),
    (Fault::Late, "late"),
];

fn table(panel: &RigidPanel, block: &RigidBlock, paint: Paint) -> String {
    let RigidBlock {
        name,
        queries,
        hits,
        crossings,
        ..
    } = block;
    let [queries, hits, crossings] = [queries, hits, crossings].map(|&number| grouped(number));
    let names = panel.subjects.iter();
    let width = names.map(|subject| cut(subject.name()).chars().count() + 1);
    let width = width.max().unwrap_or(0).max("subject ".len());
    let headings = COLUMNS.map(|(_, heading)| format!("  {heading}")).concat();
    let heading = format!("  {:<width$}{:<6}{headings}  worst late", "subject", "");
    let mut lines = vec![
        format!("{queries} queries of {name}: {hits} hits, {crossings} crossings\n"),
        paint(Tone::Heading, &heading),
    ];
    for (subject, tally) in panel.subjects.iter().zip(&block.tallies) {
        let (tone, verdict) = match failures_of(*subject, block, tally).is_empty() {
            true => (Tone::Good, "passes"),
            false => (Tone::Bad, "FAILS "),
        };
        let cells = COLUMNS.map(|(fault, heading)| {
            format!("{:>1$}", grouped(tally.count(fault)), heading.len() + 2)
        });
        let late = tally.faults.get(&Fault::Late);
        let late = short(late.map_or(0.0, |late| late.severity));
        let not_asked = match tally.not_asked {
            0 => String::new(),
            some => format!("  (not asked {})", grouped(some)),
        };
        let (name, cells) = (cut(subject.name()), cells.concat());
        let verdict = paint(tone, verdict);
        lines.push(format!(
            "  {name:<width$}{verdict}{cells}{late:>12}{not_asked}"
        ));
    }
    lines.join("\n") + "\n"
}

fn agreement(panel: &RigidPanel, total: &RigidBlock) -> String {
    let Some(second) = panel.second else {
        return String::new();
    };
    let (name, queries) = (second.name(), grouped(total.queries));
    match &total.disagreements {
        RigidFinding { count: 0, .. } => {
            format!("\noracle and {name} agree on all {queries} queries\n")
        }
        RigidFinding { count, id, .. } => format!(
            "\noracle and {name} DISAGREE on {} of {queries} queries, first on {id}\n",
            grouped(*count)
        ),
    }
}

/// The worst witness of each fault that fails a subject.
fn witnesses(panel: &RigidPanel, total: &RigidBlock) -> String {
    let mut lines = Vec::new();
    for (subject, tally) in panel.subjects.iter().zip(&total.tallies) {
        for (&fault, RigidFinding { id, lapse, .. }) in &tally.faults {
            if tally.fails(subject.tolerance(), fault) {
                let lapse = lapse
                    .as_ref()
                    .map_or(String::new(), |lapse| format!(": {lapse}"));
                lines.push(format!(
                    "  {}, {}{lapse}",
                    cut(subject.name()),
                    fault.name()
                ));
                lines.push(format!("    tunnelproof explain {id}"));
            }
        }
    }
    match lines.is_empty() {
        true => String::new(),
        false => format!(
            "\nWorst of each fault, and the command that explains it:\n{}\n",
            lines.join("\n")
        ),
    }
}

#[cfg(test)]
mod tests {
    use tunnelproof::narrow::Unsupported;
    use tunnelproof::query::QueryKind;

    use super::*;
    use crate::generate::rigid_by_name;
    use crate::subject::{Lapse, LapseKind, Said};

    /// The oracle, changed.
    struct Changed {
        name: &'static str,
        change: fn(&RigidQuery, ExactAnswer) -> Result<Answer, NoAnswer>,
        tolerance: Tolerance,
    }

    impl RigidSubject for Changed {
        fn name(&self) -> &str {
            self.name
        }

        fn answers(&self, queries: &[RigidQuery]) -> Vec<Result<Answer, NoAnswer>> {
            let answer = |query| (self.change)(query, decide_rigid_query(query));
            queries.iter().map(answer).collect()
        }

        fn tolerance(&self) -> Tolerance {
            self.tolerance
        }
    }

    fn changed(
        name: &'static str,
        change: fn(&RigidQuery, ExactAnswer) -> Result<Answer, NoAnswer>,
    ) -> Changed {
        Changed {
            name,
            change,
            tolerance: Tolerance::NONE,
        }
    }

    fn said(answer: ExactAnswer) -> Said {
        Said {
            toi: answer.hit.map(|hit| hit.toi),
            case: None,
        }
    }

    const RIGHT: fn(&RigidQuery, ExactAnswer) -> Result<Answer, NoAnswer> =
        |_, truth| Ok(Answer::Exact(truth));
    const LATE: fn(&RigidQuery, ExactAnswer) -> Result<Answer, NoAnswer> = |_, truth| {
        let mut said = said(truth);
        if let Some(toi) = &mut said.toi {
            toi.above = (toi.above + 1e-10).min(1.0);
        }
        Ok(Answer::Said(said))
    };

    fn judged(
        second: &dyn RigidSubject,
        subject: &dyn RigidSubject,
    ) -> (RigidBlock, Vec<String>, String) {
        let panel = RigidPanel {
            second: Some(second),
            subjects: vec![subject],
        };
        let family = rigid_by_name("turning_lattice").unwrap();
        let source = RigidSource {
            family,
            seed: 1,
            count: 150,
        };
        let block = panel.run(source, |_| {});
        let failures = failures(&panel, &block);
        let text = text(&panel, 1, std::slice::from_ref(&block), Shown::EVERYTHING);
        (block, failures, text)
    }

    #[test]
    fn rigid_subject_that_is_right_passes() {
        let (block, failures, text) = judged(&changed("second", RIGHT), &changed("engine", RIGHT));
        assert_eq!(failures, [""; 0]);
        assert_eq!(block.queries, 150);
        assert!(block.hits > 5 && block.hits < 140, "{}", block.hits);
        assert!(
            text.contains("oracle and second agree on all 150 queries"),
            "{text}"
        );
    }

    #[test]
    fn rigid_subject_fails_by_each_fault() {
        type Change = fn(&RigidQuery, ExactAnswer) -> Result<Answer, NoAnswer>;
        let of_misses: Change = |_, _| Ok(Answer::Said(Said::default()));
        let of_hits: Change = |_, truth| {
            let toi = said(truth)
                .toi
                .or(Some(crate::answer::Enclosure::exactly(0.5)));
            Ok(Answer::Said(Said { toi, case: None }))
        };
        let wrong_side: Change = |_, mut truth| {
            if let Some(hit) = &mut truth.hit {
                hit.side = 2;
            }
            Ok(Answer::Exact(truth))
        };
        let silent: Change = |_, _| Err(Lapse::new(LapseKind::Crashed, "gone").into());
        let refusing: Change = |_, _| Err(Unsupported::Kind(QueryKind::EdgeEdge).into());
        for (change, words) in [
            (of_misses, "tunnels"),
            (of_misses, "missed grazes"),
            (of_hits, "false hits"),
            (LATE, "late times of impact"),
            (wrong_side, "answers that differ from the exact one"),
            (silent, "150 queries without answer"),
            (
                refusing,
                "takes none of the 150 queries, so it gave no answer",
            ),
        ] {
            let (_, failures, text) = judged(&changed("second", RIGHT), &changed("engine", change));
            let [failure] = &failures[..] else {
                panic!("{failures:?}")
            };
            assert!(
                failure.starts_with("engine: ") && failure.contains(words),
                "{failure}"
            );
            assert!(text.contains("FAILS"), "{text}");
        }
    }

    #[test]
    fn rigid_subject_may_be_as_late_as_it_declares() {
        let late = |late| Changed {
            tolerance: Tolerance { near: 0.0, late },
            ..changed("engine", LATE)
        };
        assert_eq!(judged(&changed("second", RIGHT), &late(2e-10)).1, [""; 0]);
        assert_eq!(judged(&changed("second", RIGHT), &late(0.5e-10)).1.len(), 1);
    }

    #[test]
    fn rigid_second_judge_that_differs_is_named() {
        let of_misses = changed("second", |_, mut truth| {
            truth.hit = None;
            Ok(Answer::Exact(truth))
        });
        let (block, failures, text) = judged(&of_misses, &changed("engine", RIGHT));
        assert_eq!(block.disagreements.count, block.hits);
        let line = format!("oracle and second disagree on {} queries", block.hits);
        assert_eq!(failures, [line]);
        assert!(text.contains("oracle and second DISAGREE on"), "{text}");
        assert!(text.contains("first on turning_lattice:1:"), "{text}");
    }
}

//! Whether what was found passes.

use tunnelproof::narrow::Tolerance;

use super::block::Block;
use super::judged::Judged;
use super::run::Panel;
use super::table::{QUERIES, SURPLUS, grouped, many};
use super::tally::{Fault, Tally};

/// What fails: a line for each subject and for each disagreement among judges and labels; none if
/// everything passes.
///
/// A subject fails if it takes none of the queries, or only some of one sort; by a tunnel, one at a
/// joint, a missed graze, a false hit or a missing answer, and by a late time of impact beyond its
/// [`Tolerance`]; an exact one by any other field that differs. A wrong case alone does not fail an engine: it is a way to an answer, not the
/// answer.
pub fn failures(panel: &Panel, total: &Block) -> Vec<String> {
    all_failures(panel, total, failures_of)
}

/// The same if no subject had a tolerance: near hits and all late times of impact fail too.
pub fn exact_failures(panel: &Panel, total: &Block) -> Vec<String> {
    all_failures(panel, total, |_, block, tally| {
        exact_failures_of(block, tally)
    })
}

fn all_failures(
    panel: &Panel,
    total: &Block,
    failures: impl Fn(&Judged, &Block, &Tally) -> Vec<String>,
) -> Vec<String> {
    let subjects = panel.subjects.iter().zip(&total.tallies);
    let lines = subjects.filter_map(|(judged, tally)| {
        let failures = failures(judged, total, tally);
        let name = judged.subject.name();
        (!failures.is_empty()).then(|| format!("{name}: {}", failures.join(", ")))
    });
    lines.chain(disagreements(panel, total)).collect()
}

/// What a subject fails by, of all that was found, within its tolerance; none if it passes.
pub fn failures_of(judged: &Judged, block: &Block, tally: &Tally) -> Vec<String> {
    let faults = faults(judged.subject.tolerance(), tally);
    faults.chain(refusals(block, tally)).collect()
}

/// What a subject without any tolerance fails by.
pub fn exact_failures_of(block: &Block, tally: &Tally) -> Vec<String> {
    let faults = faults(Tolerance::NONE, tally);
    faults.chain(refusals(block, tally)).collect()
}

/// What judges and labels disagree on with the oracle: a line each.
pub fn disagreements(panel: &Panel, total: &Block) -> Vec<String> {
    let mut lines = Vec::new();
    let judges = panel.second_judges.iter().zip(&total.agreements);
    let seconds = judges.map(|(judge, agreement)| {
        let what = format!("oracle and {} disagree", judge.name());
        (what, agreement.disagreements.count)
    });
    let labels = "labels disagree with the oracle".to_owned();
    for (what, count) in seconds.chain([(labels, total.wrong_labels.count)]) {
        if count > 0 {
            lines.push(format!("{what} on {}", many(count, QUERIES)));
        }
    }
    lines
}

/// A subject that does not answer each query once does not pass.
pub(super) fn refusals(total: &Block, tally: &Tally) -> impl Iterator<Item = String> {
    let refused = tally.refused_of_taken();
    let of_taken = (refused > 0).then(|| refused_of_taken(refused));
    let takes_none = total.queries > 0 && tally.taken.is_empty();
    let none = takes_none.then(|| took_none(total.queries));
    let surplus = (tally.surplus > 0).then(|| many(tally.surplus, SURPLUS));
    of_taken.into_iter().chain(none).chain(surplus)
}

/// Of a subject that answers other queries of the same sort.
pub(super) fn refused_of_taken(queries: u64) -> String {
    format!("{} refused of a sort that it takes", many(queries, QUERIES))
}

/// Of a subject that takes no query, so that nothing but this can be said of it.
pub(super) fn took_none(queries: u64) -> String {
    match queries {
        1 => "does not take the query, so it gave no answer".to_owned(),
        _ => {
            let queries = grouped(queries);
            format!("takes none of the {queries} queries, so it gave no answer")
        }
    }
}

/// What a subject would fail by without its tolerance, and does not with it.
pub fn tolerated(judged: &Judged, tally: &Tally) -> Vec<String> {
    let tolerance = judged.subject.tolerance();
    let faults = failing(Tolerance::NONE, tally).filter(|&fault| !fails(tolerance, tally, fault));
    faults
        .map(|fault| counted(Tolerance::NONE, tally, fault))
        .collect()
}

fn faults(tolerance: Tolerance, tally: &Tally) -> impl Iterator<Item = String> {
    failing(tolerance, tally).map(move |fault| counted(tolerance, tally, fault))
}

fn failing(tolerance: Tolerance, tally: &Tally) -> impl Iterator<Item = Fault> {
    Fault::ALL
        .into_iter()
        .filter(move |&fault| fails(tolerance, tally, fault))
}

/// Whether there is such a fault, and it counts.
pub fn fails(tolerance: Tolerance, tally: &Tally, fault: Fault) -> bool {
    counts(tolerance, fault, tally.worst(fault)) && tally.count(fault) > 0
}

/// Whether a fault counts of which this is the severity of the worst.
pub(super) fn counts(tolerance: Tolerance, fault: Fault, worst: f64) -> bool {
    match fault {
        // A hit is near, not false, by the tolerance of whoever reports it.
        Fault::NearHit => tolerance.near == 0.0,
        Fault::Late => !tolerance.permits_late(worst),
        Fault::Early | Fault::WrongCase => false,
        _ => true,
    }
}

fn counted(tolerance: Tolerance, tally: &Tally, fault: Fault) -> String {
    many(tally.count(fault), words(tolerance, fault))
}

/// What a fault is called, and what several are.
pub(super) fn words(tolerance: Tolerance, fault: Fault) -> [&'static str; 2] {
    match fault {
        Fault::Tunnel => ["tunnel", "tunnels"],
        Fault::JointTunnel => ["joint tunnel", "joint tunnels"],
        Fault::MissedGraze => ["missed graze", "missed grazes"],
        Fault::FalseHit => ["false hit", "false hits"],
        Fault::NoAnswer => ["query without answer", "queries without answer"],
        Fault::NearHit => ["near hit", "near hits"],
        Fault::Late if tolerance.late > 0.0 => [
            "late time of impact beyond its tolerance",
            "late times of impact beyond its tolerance",
        ],
        Fault::Late => ["late time of impact", "late times of impact"],
        Fault::Early => ["early time of impact", "early times of impact"],
        Fault::WrongCase => ["wrong case", "wrong cases"],
        Fault::Differs => [
            "answer that differs from the exact one",
            "answers that differ from the exact one",
        ],
    }
}

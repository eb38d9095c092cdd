//! Whether what was found passes.

use super::block::Block;
use super::judged::Judged;
use super::run::Panel;
use super::table::grouped;
use super::tally::{Fault, Tally};

/// What fails: a line for each subject and for each disagreement among judges and labels; none if
/// everything passes.
///
/// A subject fails if it takes none of the queries, or only some of one sort; by a tunnel, one at a
/// joint, a missed graze, a false hit or a missing answer, and by a near hit or a late time of
/// impact beyond what it is [permitted](super::permitted::Permitted); an exact one by any other field
/// that differs. A wrong case alone does not fail an engine: it is a way to an answer, not the
/// answer.
pub fn failures(panel: &Panel, total: &Block) -> Vec<String> {
    let subjects = panel.subjects.iter().zip(&total.tallies);
    let lines = subjects.filter_map(|(judged, tally)| {
        let failures = failures_of(judged, total, tally);
        let name = judged.subject.name();
        (!failures.is_empty()).then(|| format!("{name}: {}", failures.join(", ")))
    });
    lines.chain(disagreements(panel, total)).collect()
}

/// What a subject fails by, of all that was found; none if it passes.
pub fn failures_of(judged: &Judged, block: &Block, tally: &Tally) -> Vec<String> {
    let faults = faults(judged, tally);
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
            lines.push(format!("{what} on {} queries", grouped(count)));
        }
    }
    lines
}

/// A subject that does not answer each query once does not pass.
fn refusals(total: &Block, tally: &Tally) -> impl Iterator<Item = String> {
    let refused = tally.refused_of_taken();
    let of_taken = (refused > 0).then(|| {
        format!(
            "{} queries refused of a sort that it takes",
            grouped(refused)
        )
    });
    let takes_none = total.queries > 0 && tally.taken.is_empty();
    let none = takes_none.then(|| "takes none of the queries".to_owned());
    let surplus =
        (tally.surplus > 0).then(|| format!("{} answers too many", grouped(tally.surplus)));
    of_taken.into_iter().chain(none).chain(surplus)
}

fn faults<'a>(judged: &Judged, tally: &'a Tally) -> impl Iterator<Item = String> + use<'a> {
    let declared = judged.subject.declared_distance();
    let permitted = judged.permitted;
    let counted = [
        (Fault::Tunnel, "tunnels"),
        (Fault::JointTunnel, "joint tunnels"),
        (Fault::MissedGraze, "missed grazes"),
        (Fault::FalseHit, "false hits"),
        (Fault::NoAnswer, "queries without answer"),
        (Fault::NearHit, "near hits beyond what is permitted"),
        (Fault::Late, "late times of impact beyond what is permitted"),
        (Fault::Differs, "answers that differ from the exact one"),
    ];
    let passes = move |fault: Fault| match fault {
        Fault::NearHit => declared <= permitted.distance,
        Fault::Late => tally.worst(Fault::Late) <= permitted.late,
        _ => false,
    };
    counted
        .into_iter()
        .filter(move |(fault, _)| tally.count(*fault) > 0 && !passes(*fault))
        .map(|(fault, words)| format!("{} {words}", grouped(tally.count(fault))))
}

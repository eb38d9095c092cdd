//! What an audit came to, as text.

use crate::audit::{Penetration, Report};
use tunnelproof_reference::certify::caller::Caller;
use tunnelproof_reference::certify::table::grouped;

/// Findings that are shown.
const SHOWN: usize = 10;

/// Counts, then the first findings with the commands that explain them to whoever asked.
pub fn text(report: &Report, caller: &Caller) -> String {
    let [broad, exclusion, narrow] = report.missed.map(grouped);
    let worst = |(count, by): (u64, f64)| match count {
        0 => "0".to_owned(),
        count => format!("{}, worst {by:.1e} of a step", grouped(count)),
    };
    let both = |[apart, near]: [u64; 2]| {
        let [all, near] = [apart + near, near].map(grouped);
        format!("{all}, of them within before {near}")
    };
    let rows = [
        ("steps", grouped(report.steps)),
        ("pairs asked about", grouped(report.pairs)),
        (
            "contacts made",
            format!(
                "{}, of them crossings {}",
                grouped(report.contacts),
                grouped(report.crossings)
            ),
        ),
        ("contacts prevented", grouped(report.prevented)),
        ("changes of resolution", grouped(report.remeshes)),
        ("missed by broad phase", broad),
        ("missed by exclusion", exclusion),
        ("missed by narrow phase", narrow),
        ("missed crossings", grouped(report.missed_crossings)),
        ("changes that pass", grouped(report.remeshes_through)),
        ("segments beside bodies", grouped(report.body_pairs)),
        ("touches of bodies made", grouped(report.body_contacts)),
        ("  prevented", grouped(report.body_prevented)),
        ("  missed", grouped(report.body_missed)),
        ("changes into bodies", grouped(report.body_remeshes_through)),
        ("bodies near each other", grouped(report.core_pairs)),
        ("touches of two made", grouped(report.core_contacts)),
        ("  prevented", grouped(report.core_prevented)),
        ("  missed", grouped(report.core_missed)),
        ("thickness guarded", format!("{}", report.guarded_thickness)),
        ("thick pairs", grouped(report.thick_pairs)),
        ("nearer than guarded", both(report.nearer)),
        ("changes nearer", both(report.remeshes_nearer)),
        ("deepest penetration", penetration(&report.deepest)),
        (
            "standing penetration",
            penetration(&report.standing_penetration),
        ),
        ("jumps", grouped(report.jumps)),
        ("nodes astray", grouped(report.astray)),
        ("times late", worst(report.late)),
        ("times early", worst(report.early)),
        ("contacts made up", grouped(report.false_hits)),
        ("standing tunnels", grouped(report.standing.len() as u64)),
        (
            "standing in bodies",
            grouped(report.body_standing.len() as u64),
        ),
        (
            "bodies in each other",
            grouped(report.core_standing.len() as u64),
        ),
        ("ambiguous", grouped(report.ambiguous.len() as u64)),
    ];
    let mut text = String::from("Audit by the exact oracle\n");
    for (name, value) in rows {
        text += &format!("  {name:<24}{value}\n");
    }
    for ([a, b], passages) in &report.standing {
        text += &format!("  wires {a} and {b} have passed through each other: {passages:+}\n");
    }
    for [wire, body] in &report.body_standing {
        text += &format!("  wire {wire} is inside body {body}\n");
    }
    for [a, b] in &report.core_standing {
        text += &format!("  bodies {a} and {b} are inside each other\n");
    }
    for ambiguous in &report.ambiguous {
        text += &format!("  {ambiguous}\n");
    }
    let (tunnels, others): (Vec<_>, Vec<_>) = report
        .findings
        .iter()
        .partition(|finding| finding.is_tunnel());
    for finding in tunnels.into_iter().chain(others).take(SHOWN) {
        text += &format!("  {finding}\n");
        if let Some(command) = finding.command(caller) {
            text += &format!("    {command}\n");
        }
    }
    text
}

/// The share as a percentage, and where.
fn penetration(found: &Option<Penetration>) -> String {
    let Some(Penetration {
        step,
        low,
        high,
        segments: [a, b],
    }) = found
    else {
        return "none".to_owned();
    };
    let percent = match high - low < 1e-5 {
        true => format!("{:.3}%", 100.0 * high),
        false => format!("{:.3}% to {:.3}%", 100.0 * low, 100.0 * high),
    };
    let name = |wire: usize, segment: usize| format!("wire {wire} segment {segment}");
    let (a, b) = (name(a.wire.0, a.segment), name(b.wire.0, b.segment));
    format!("{percent} of the thickness: step {step}, {a} and {b}")
}

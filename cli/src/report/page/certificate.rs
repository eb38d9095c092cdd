//! The certificate: what was found of each subject, the worst of it in pictures, and how to find it
//! again.

use maud::{Markup, html};

use tunnelproof::query::QueryKind;
use tunnelproof_reference::certify::block::Block;
use tunnelproof_reference::certify::findings::Findings;
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::certify::strict;
use tunnelproof_reference::certify::table::{
    command, grouped, lapse_counts, measure, short, tolerance,
};
use tunnelproof_reference::certify::tally::{Fault, Statement, Tally, Witness};
use tunnelproof_reference::field::{self, Integer};
use tunnelproof_reference::program::Conduct;

use super::super::picture;
use super::{data_url, page};
use tunnelproof_reference::report::results::written;

/// The page of a certification.
pub fn certificate(findings: &Findings) -> String {
    let subjects = findings.panel.subjects.iter().enumerate();
    let body = html! {
        h1 { "Certificate" }
        p.pale {
            (grouped(findings.total.queries)) " queries, " (grouped(findings.total.hits)) " of them hits, "
            (grouped(findings.total.crossings)) " crossings, judged against the exact answer. A missed crossing \
            is a tunnel: what moves gets through."
        }
        @for (index, judged) in subjects { (subject(findings, index, judged)) }
        h2 { "Judges" }
        (judges(findings))
        h2 { "How to find it again" }
        (settings(findings))
        h2 { "Queries" }
        (sources(findings))
    };
    page("Certificate", &body)
}

fn subject(findings: &Findings, index: usize, judged: &Judged) -> Markup {
    let name = judged.subject.name();
    let blocks: Vec<_> = findings.blocks.iter().collect();
    let all = (blocks.len() > 1).then_some(&findings.total);
    let tally = &findings.total.tallies[index];
    let failures = strict::failures_of(judged, &findings.total, tally);
    let tolerated = strict::tolerated(judged, tally);
    let declared = tolerance(judged.subject.tolerance());
    html! {
        h2 { (name) " " (verdict(failures.is_empty())) }
        @if !failures.is_empty() { p { (failures.join(", ")) "." } }
        @if !tolerated.is_empty() { p { "Fails without its tolerance, " (declared) ": " (tolerated.join(", ")) "." } }
        @if !tally.lapses.is_empty() { p { "No answer: " (lapse_counts(tally)) "." } }
        .table { table {
            tr {
                th { "family" } th { "verdict" } th { "queries" } th { "hits" }
                @for fault in Fault::COUNTED { th { (fault.name()) } }
                th { "worst late" } th { "worst early" }
            }
            @for block in blocks.into_iter().chain(all) { (row(block, index, judged)) }
        } }
        (witnesses(name, tally))
        @for (program, conduct) in &findings.programs { @if program == name { (conduct_of(conduct)) } }
    }
}

fn row(block: &Block, index: usize, judged: &Judged) -> Markup {
    let tally = &block.tallies[index];
    let passes = strict::failures_of(judged, block, tally).is_empty();
    html! {
        tr {
            td { (block.name) }
            @if tally.not_asked() == block.queries {
                td { "not asked" }
            } @else {
                td { (verdict(passes)) }
            }
            td { (grouped(block.queries - tally.not_asked())) }
            td { (grouped(tally.hits)) }
            @for fault in Fault::COUNTED { td { (grouped(tally.count(*fault))) } }
            td { (short(tally.worst(Fault::Late))) }
            td { (short(tally.worst(Fault::Early))) }
        }
    }
}

fn verdict(passes: bool) -> Markup {
    match passes {
        true => html! { span.passes { "passes" } },
        false => html! { span.fails { "fails" } },
    }
}

/// The worst witness of each fault, with a picture.
fn witnesses(subject: &str, tally: &Tally) -> Markup {
    let worst = tally.faults.iter();
    let worst = worst.filter_map(|(fault, finding)| Some((*fault, finding.worst.as_ref()?)));
    html! {
        .charts { @for (fault, witness) in worst { (witness_of(subject, fault, witness)) } }
    }
}

fn witness_of(subject: &str, fault: Fault, witness: &Witness) -> Markup {
    let truth = match witness.truth.hit {
        Some(hit) => format!("hit at {}", hit.toi),
        None => "miss".to_owned(),
    };
    html! {
        figure {
            img alt={ "What moves in " (witness.id) }
                src=(data_url(&picture::draw(&witness.id, &witness.query, &witness.truth)));
            figcaption {
                strong { (title(fault, witness.severity)) } ". Exact answer: " (truth) "."
                @if let Some(answer) = &witness.answer { " It says: " (said(witness.query.kind(), answer)) "." }
                @if let Some(lapse) = &witness.lapse { " No answer: " (lapse) "." }
                pre { (command(witness, Some(subject))) }
            }
        }
    }
}

/// The fault that a witness shows, and how bad it is.
fn title(fault: Fault, severity: f64) -> String {
    match measure(fault, severity) {
        by if by.is_empty() => format!("First {}", fault.name()),
        by => format!("Worst {}, {by}", fault.name()),
    }
}

/// What a subject says, in a few words.
fn said(kind: QueryKind, answer: &Statement) -> String {
    let answer = written(kind, answer);
    let toi = &answer["toi"]["below"];
    match (answer["hit"].as_bool(), toi.as_f64()) {
        (Some(true), Some(toi)) => format!("hit at {toi}"),
        (Some(true), None) => "hit at no time".to_owned(),
        _ => "miss".to_owned(),
    }
}

fn conduct_of(conduct: &Conduct) -> Markup {
    html! {
        p.pale {
            "Started " (grouped(conduct.starts)) " times."
            @if conduct.surplus > 0 { " It wrote " (grouped(conduct.surplus)) " answers too many." }
        }
        @if !conduct.stderr.is_empty() {
            details { summary { "The end of its standard error" } pre { (conduct.stderr) } }
        }
    }
}

fn judges(findings: &Findings) -> Markup {
    let seconds = findings.panel.second_judges.iter();
    let seconds = seconds.zip(&findings.total.agreements);
    html! {
        @for (judge, agreement) in seconds {
            @if agreement.queries > 0 {
                p {
                    "The oracle and " (judge.name()) " were asked " (grouped(agreement.queries)) " queries and disagree on "
                    (grouped(agreement.disagreements.count)) "."
                }
            }
        }
        @if findings.panel.second_judges.is_empty() { p { "The oracle alone." } }
        @if findings.total.labels > 0 {
            p {
                (grouped(findings.total.labels)) " queries are labelled, "
                (grouped(findings.total.wrong_labels.count)) " of them wrong."
            }
        }
    }
}

fn settings(findings: &Findings) -> Markup {
    let settings = &findings.settings;
    html! {
        pre { (settings.command) }
        p.pale {
            "tunnelproof " (env!("CARGO_PKG_VERSION")) ", exact arithmetic by " (field::Default::BACKEND)
            ", seed " (settings.seed) "."
            @if !settings.shard.is_whole() { " This is shard " (settings.shard) " of the queries." }
        }
        .table { table {
            tr { th { "subject" } th { "tolerance: near, m" } th { "late" } }
            @for judged in &findings.panel.subjects {
                @let tolerance = judged.subject.tolerance();
                tr {
                    td { (judged.subject.name()) }
                    td { (short(tolerance.near)) }
                    td { (short(tolerance.late)) }
                }
            }
        } }
    }
}

fn sources(findings: &Findings) -> Markup {
    html! {
        .table { table {
            tr { th { "source" } th { "queries" } th { "hits" } th { "crossings" } th { "hash of the queries" } }
            @for block in &findings.blocks {
                tr {
                    td { (block.name) }
                    td { (grouped(block.queries)) }
                    td { (grouped(block.hits)) }
                    td { (grouped(block.crossings)) }
                    td { code { (block.fingerprint) } }
                }
            }
        } }
    }
}

//! The certificate: what was found of each subject, the worst of it in pictures, and how to find it
//! again.

use maud::{Markup, html};

use tunnelproof::query::QueryKind;
use tunnelproof_reference::certify::block::Block;
use tunnelproof_reference::certify::caller::Caller;
use tunnelproof_reference::certify::details;
use tunnelproof_reference::certify::findings::Findings;
use tunnelproof_reference::certify::judged::Judged;
use tunnelproof_reference::certify::strict;
use tunnelproof_reference::certify::summary;
use tunnelproof_reference::certify::table::{
    SURPLUS, grouped, lapse_counts, many, measure, short, tolerance,
};
use tunnelproof_reference::certify::tally::{Fault, Statement, Tally, Witness};
use tunnelproof_reference::field::{self, Integer};
use tunnelproof_reference::program::Conduct;

use super::super::picture;
use super::{data_url, page};
use tunnelproof_reference::report::results::written;

/// The page of a certification.
pub fn certificate(findings: &Findings) -> String {
    let order = summary::order(findings);
    let body = html! {
        h1 { "Certificate" }
        (lead(findings))
        (summary_table(findings, &order))
        @for &index in &order { (subject(findings, index)) }
        h2 { "Judges" }
        (judges(findings))
        h2 { "How to find it again" }
        (settings(findings))
        h2 { "Queries" }
        (sources(findings))
    };
    page("Certificate", &body)
}

/// What was judged, and how many pass, in two sentences.
fn lead(findings: &Findings) -> Markup {
    let total = &findings.total;
    let subjects = findings.panel.subjects.iter().zip(&total.tallies);
    let passing = subjects
        .filter(|(judged, tally)| summary::passes(judged, total, tally))
        .count();
    html! {
        p {
            (grouped(total.queries)) " queries, each of two things that move during one step. In "
            (grouped(total.hits)) " of them they touch: a " (term("hit", "a contact at some time of the step")) ". In "
            (grouped(total.crossings)) " of these they pass through each other: a "
            (term("crossing", "the two swap sides, and small disturbances do not undo it")) ". Each answer was compared with the "
            (term("exact one", "computed in integers and real algebraic numbers, without rounding")) "."
        }
        p { strong { (passing) " of " (findings.panel.subjects.len()) " subjects " (if passing == 1 { "passes" } else { "pass" }) "." }
            " A subject passes if it misses no contact, invents none, is never late, and answers every query that it takes." }
    }
}

/// A word whose meaning is shown on hover.
fn term(word: &str, meaning: &str) -> Markup {
    html! { abbr title=(meaning) { (word) } }
}

/// Subjects by faults, failures first.
fn summary_table(findings: &Findings, order: &[usize]) -> Markup {
    let columns = summary::columns(findings);
    let headings: Vec<_> = columns
        .iter()
        .map(|column| column.heading.join(" ").trim().to_owned())
        .collect();
    html! {
        .table { table.stack {
            thead { tr {
                th { "subject" } th { "verdict" }
                @for (column, heading) in columns.iter().zip(&headings) { th { (term(heading, column.meaning)) } }
            } }
            tbody { @for &index in order {
                @let (judged, tally) = (&findings.panel.subjects[index], &findings.total.tallies[index]);
                tr {
                    td { a href={ "#subject-" (index) } { (judged.subject.name()) } }
                    td data-label="verdict" { (verdict(summary::passes(judged, &findings.total, tally))) }
                    @for (column, heading) in columns.iter().zip(&headings) {
                        (cell(heading, &column.cell(tally)))
                    }
                }
            } }
        } }
        details { summary { "What the columns count" } dl {
            @for (column, heading) in columns.iter().zip(&headings) {
                dt { (heading) } dd { (column.meaning) }
            }
        } }
    }
}

/// A cell with the name of its column, for narrow screens; nothing is pale.
fn cell(heading: &str, text: &str) -> Markup {
    html! { td data-label=(heading) class=[(text == "0").then_some("pale")] { (text) } }
}

fn subject(findings: &Findings, index: usize) -> Markup {
    let judged = &findings.panel.subjects[index];
    let name = judged.subject.name();
    let tally = &findings.total.tallies[index];
    let failures = strict::failures_of(judged, &findings.total, tally);
    let tolerated = strict::tolerated(judged, tally);
    let declared = tolerance(judged.subject.tolerance());
    html! {
        h2 id={ "subject-" (index) } { (name) " " (verdict(failures.is_empty())) }
        @if !failures.is_empty() { p { (failures.join(", ")) "." } }
        @if tally.not_asked() > 0 && tally.not_asked() < findings.total.queries {
            p { "It does not take " (grouped(tally.not_asked())) " of the " (grouped(findings.total.queries)) " queries: it was not judged on these." }
        }
        @if !tolerated.is_empty() { p { "Fails without its tolerance, " (declared) ": " (tolerated.join(", ")) "." } }
        @if !tally.lapses.is_empty() { p { "No answer: " (lapse_counts(tally)) "." } }
        (families(findings, index))
        (witnesses(&findings.settings.caller, name, tally))
        @for (program, conduct) in &findings.programs { @if program == name { (conduct_of(conduct)) } }
    }
}

/// What a subject did on each source; those without a fault in one line.
fn families(findings: &Findings, index: usize) -> Markup {
    let judged = &findings.panel.subjects[index];
    let is_clean = |block: &&Block| {
        let tally = &block.tallies[index];
        tally.faults.is_empty() && tally.not_asked() == 0
    };
    let (clean, others): (Vec<_>, Vec<_>) = findings.blocks.iter().partition(is_clean);
    html! {
        details { summary { "By family" @if !clean.is_empty() { ": no fault in " (clean.len()) " of " (findings.blocks.len()) } }
            @if !others.is_empty() { .table { table.stack {
                thead { tr {
                    th { "family" } th { "verdict" } th { "queries" } th { "hits" }
                    @for fault in Fault::COUNTED { th { (term(fault.name(), fault.meaning())) } }
                    th { (term("worst late", Fault::Late.meaning())) } th { (term("worst early", Fault::Early.meaning())) }
                } }
                tbody { @for block in others { (row(block, index, judged)) } }
            } } }
            @if !clean.is_empty() {
                p { "No fault: " @for (at, block) in clean.iter().enumerate() {
                    @if at > 0 { ", " } (source_name(block)) " (" (grouped(block.queries)) ")"
                } "." }
            }
        }
    }
}

/// The name of a source, with what its queries are like on hover.
fn source_name(block: &Block) -> Markup {
    match details::description(&block.name) {
        Some(words) => term(&block.name, words),
        None => html! { (block.name) },
    }
}

fn row(block: &Block, index: usize, judged: &Judged) -> Markup {
    let tally = &block.tallies[index];
    let passes = summary::passes(judged, block, tally);
    html! {
        tr {
            td { (block.name) @if let Some(words) = details::description(&block.name) { br; small { (words) } } }
            td data-label="verdict" {
                @if tally.not_asked() == block.queries { "not asked" } @else { (verdict(passes)) }
            }
            (cell("queries", &grouped(block.queries - tally.not_asked())))
            (cell("hits", &grouped(tally.hits)))
            @for fault in Fault::COUNTED { (cell(fault.name(), &grouped(tally.count(*fault)))) }
            (cell("worst late", &short(tally.worst(Fault::Late))))
            (cell("worst early", &short(tally.worst(Fault::Early))))
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
fn witnesses(caller: &Caller, subject: &str, tally: &Tally) -> Markup {
    let worst = tally.faults.iter();
    let worst = worst.filter_map(|(fault, finding)| Some((*fault, finding.worst.as_ref()?)));
    html! {
        .charts { @for (fault, witness) in worst { (witness_of(caller, subject, fault, witness)) } }
    }
}

fn witness_of(caller: &Caller, subject: &str, fault: Fault, witness: &Witness) -> Markup {
    let truth = match witness.truth.hit {
        Some(hit) => format!("hit at {}", hit.toi),
        None => "miss".to_owned(),
    };
    html! {
        figure {
            img alt={ "What moves in " (witness.id) }
                src=(data_url(&picture::draw_any(&witness.id, &witness.query, &witness.truth)));
            figcaption {
                strong { (title(fault, witness.severity)) } ". Exact answer: " (truth) "."
                @if let Some(answer) = &witness.answer { " It says: " (said(witness.query.shape(), answer)) "." }
                @if let Some(lapse) = &witness.lapse { " No answer: " (lapse) "." }
                pre { (caller.explain(witness, Some(subject))) }
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
            "Started " (grouped(conduct.starts)) @if conduct.starts == 1 { " time." } @else { " times." }
            @if conduct.surplus > 0 { " It wrote " (many(conduct.surplus, SURPLUS)) "." }
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
            @if findings.total.wrong_labels.count > 0 {
                details { summary { "Wrong labels" } pre {
                    @for name in findings.total.wrong_label_names.names() { (name) "\n" }
                } }
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
        @let declared = findings.panel.subjects.iter().map(|judged| (judged, tolerance(judged.subject.tolerance())));
        @for (judged, tolerance) in declared {
            @if !tolerance.is_empty() { p.pale { (judged.subject.name()) " declares a tolerance: " (tolerance) "." } }
        }
    }
}

fn sources(findings: &Findings) -> Markup {
    html! {
        details { summary { "Families and files, with hashes of their queries" } .table { table.stack {
            thead { tr { th { "source" } th { "queries" } th { "hits" } th { "crossings" } th { "hash of the queries" } } }
            tbody { @for block in &findings.blocks {
                tr {
                    td { (block.name) @if let Some(words) = details::description(&block.name) { br; small { (words) } } }
                    (cell("queries", &grouped(block.queries)))
                    (cell("hits", &grouped(block.hits)))
                    (cell("crossings", &grouped(block.crossings)))
                    td data-label="hash" { code { (block.fingerprint) } }
                }
            } }
        } } }
    }
}

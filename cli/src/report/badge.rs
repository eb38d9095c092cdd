//! A badge from a certification: how many queries the one subject was judged on, and what came of it.

use maud::html;

use tunnelproof_reference::certify::findings::Findings;
use tunnelproof_reference::certify::strict;
use tunnelproof_reference::certify::table::grouped_count;

/// The mean width of a letter, the margin beside a text, and the height of the badge, in pixels.
const LETTER: usize = 7;
const MARGIN: usize = 8;
const HEIGHT: usize = 20;

/// The badge of the first subject, as SVG.
pub fn draw(findings: &Findings) -> String {
    let failures = strict::failures(&findings.panel, &findings.total);
    let label = format!("tunnelproof {}", env!("CARGO_PKG_VERSION"));
    let (verdict, colour) = match failures.is_empty() {
        true => (passed(findings), "#1a7f4b"),
        false => (failed(findings), "#b3261e"),
    };
    let [left, right] = [&label, &verdict].map(|text| text.chars().count() * LETTER + 2 * MARGIN);
    let width = left + right;
    let title = format!("{label}: {verdict}");
    let texts = [(left / 2, &label), (left + right / 2, &verdict)];
    let badge = html! {
        svg xmlns="http://www.w3.org/2000/svg" width=(width) height=(HEIGHT)
            viewBox={ "0 0 " (width) " " (HEIGHT) } role="img" aria-label=(title) {
            title { (title) }
            clipPath id="round" { rect width=(width) height=(HEIGHT) rx="4" {} }
            g clip-path="url(#round)" {
                rect width=(left) height=(HEIGHT) fill="#3c4650" {}
                rect x=(left) width=(right) height=(HEIGHT) fill=(colour) {}
            }
            g fill="#ffffff" font-family="Verdana, DejaVu Sans, sans-serif" font-size="11" text-anchor="middle" {
                @for (x, text) in texts { text x=(x) y="14" { (text) } }
            }
        }
    };
    badge.into_string() + "\n"
}

fn passed(findings: &Findings) -> String {
    let queries = grouped_count(findings.total.queries, "query", "queries");
    format!("passes {queries}")
}

/// The first thing that fails, and how much more does.
fn failed(findings: &Findings) -> String {
    let subjects = findings.panel.subjects.iter().zip(&findings.total.tallies);
    let own =
        subjects.flat_map(|(judged, tally)| strict::failures_of(judged, &findings.total, tally));
    let all = own.chain(strict::disagreements(&findings.panel, &findings.total));
    let all: Vec<_> = all.collect();
    match &all[..] {
        [] => "fails".to_owned(),
        [one] => format!("fails: {one}"),
        [first, rest @ ..] => format!("fails: {first}, {} more", rest.len()),
    }
}

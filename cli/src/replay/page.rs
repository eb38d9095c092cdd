//! One run, or two beside each other, as one page of HTML.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use serde::Serialize;

use super::Replay;
use super::frame::{MARKS, MarkKind};

/// Speeds to choose from: the factor on time, and its name.
const SPEEDS: [(&str, &str); 6] = [
    ("0.01", "1/100"),
    ("0.05", "1/20"),
    ("0.25", "1/4"),
    ("1", "1"),
    ("4", "4"),
    ("16", "16"),
];

#[derive(Serialize)]
struct Document<'a> {
    marks: &'static [MarkKind],
    runs: &'a [Replay],
}

/// The page of runs on one clock. It needs nothing else, no network.
///
/// # Errors
///
/// A number of a run that JSON cannot say.
pub fn page(runs: &[Replay]) -> serde_json::Result<String> {
    let title = runs.first().map_or("", |run| &run.title);
    // No text in it may end the element.
    let data = serde_json::to_string(&Document {
        marks: &MARKS,
        runs,
    })?
    .replace('<', "\\u003c");
    if runs.iter().all(|run| run.frames.is_empty()) {
        return Ok(nothing(title).into_string() + "\n");
    }
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            (head(title))
            body {
                header {
                    h1 { (title) }
                    p { "step " (format!("{:.4}", runs.first().map_or(0.0, |run| run.header.settings.step))) " s" }
                }
                main #views {
                    @for run in runs {
                        section .view {
                            p .head { strong { (run.how) } " " span { (run.verdict) } " "
                                @if let Some(why) = &run.stopped { strong .red { (why) } " " }
                                span .events role="status" {} }
                            div .canvas {}
                        }
                    }
                }
                div #legend {}
                aside #charts {}
                (controls())
                script #runs type="application/json" { (PreEscaped(data)) }
                script { (PreEscaped(include_str!("libraries.min.js"))) }
                @for part in [include_str!("view.js"), include_str!("charts.js"), include_str!("page.js")] {
                    script { (PreEscaped(part)) }
                }
            }
        }
    };
    Ok(page.into_string() + "\n")
}

fn head(title: &str) -> Markup {
    html! {
        head {
            meta charset="utf-8";
            meta name="viewport" content="width=device-width, initial-scale=1";
            title { (title) }
            link rel="icon" href="data:,";
            style { (PreEscaped(include_str!("uplot.min.css"))) (PreEscaped(include_str!("style.css"))) }
        }
    }
}

/// The page of a recording that ends before its first step.
fn nothing(title: &str) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            (head(title))
            body {
                header {
                    h1 { (title) }
                    p { "There is nothing to see: the recording has no step." }
                }
            }
        }
    }
}

/// What is pressed, chosen and drawn along.
fn controls() -> Markup {
    html! {
        div #controls {
            div #line {
                input #time type="range" min="0" value="0" step="1" aria-label="Time";
                svg #marks viewBox="0 0 1003 10" preserveAspectRatio="none" aria-hidden="true" {}
                div #mark-legend {}
            }
            div #buttons {
                button #back type="button" title="One step back (left arrow)" aria-label="One step back" { "◀" }
                button #play type="button" title="Play or pause (space)" { "Play" }
                button #on type="button" title="One step on (right arrow)" aria-label="One step on" { "▶" }
                output #clock {}
                label { "Speed " select #speed {
                    @for (factor, text) in SPEEDS { option value=(factor) selected[factor == "1"] { "× " (text) } }
                } }
                label { "Follow " select #follow { option value="" { "nothing" } } }
                label { "Colour " select #tone {
                    option value="tension" { "by tension" }
                    option value="name" { "by wire" }
                } }
                button #fit type="button" title="See all of it again" { "Fit" }
                label { input #names type="checkbox" checked; " Names" }
                label { input #nodes type="checkbox"; " Nodes" }
                label { input #contacts type="checkbox" checked; " Contacts" }
            }
        }
    }
}

//! The result of a sweep or of a search as one page of HTML, which needs nothing else: no network,
//! no script. It is readable on a telephone, and follows the dark mode of the reader.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use tunnelproof::thesis::Threshold;

use crate::sweep::{Evaluated, Sample, Setting};
use crate::tune::Cost;
use tunnelproof_reference::certify::table::{grouped, short};
use tunnelproof_reference::oracle::decide_query;

use super::picture;
use super::prices::Prices;
use super::tuning::{Priced, Tuning};

mod certificate;
mod chart;
mod figures;
#[cfg(test)]
mod tests;
mod ticks;

pub use certificate::certificate;
pub use figures::{Figure, of_search, of_sweep};

/// The page of a sweep, with its charts and pictures of the worst witnesses.
pub fn sweep_page(prices: &Prices, figures: &[Figure], sample: &Sample) -> String {
    let queries: usize = prices.sources.iter().map(|source| source.queries).sum();
    let body = html! {
        h1 { "What the thresholds of the thesis cost" }
        p.pale {
            "Scale " (prices.scale) " m, coordinates in " (prices.precision) ", "
            (grouped(queries as u64)) " queries, judged against the exact answer. A missed crossing lets \
            edges or wires through. Grey lines: table 3.1, whose values the other thresholds have."
        }
        h2 { "Charts" }
        (charts(figures))
        h2 { "Numbers" }
        @if let Some((published, swept)) = prices.settings.split_first() {
            (table_of("Table 3.1", &Threshold::ALL, std::slice::from_ref(published)))
            @for block in prices.blocks(swept) {
                (table_of(&block.name, &block.thresholds, block.evaluated))
            }
        }
        h2 { "Queries" }
        details { summary { "Families and files" } .table { table {
            tr { th { "source" } th { "queries" } th { "hits" } th { "crossings" } }
            @for source in &prices.sources {
                tr {
                    td { (source.name) }
                    td { (grouped(source.queries as u64)) }
                    td { (grouped(source.hits as u64)) }
                    td { (grouped(source.crossings as u64)) }
                }
            }
        } } }
        h2 { "Worst witnesses" }
        (witnesses(prices, sample))
    };
    page("Thresholds: sweep", &body)
}

/// The page of a search.
pub fn search_page(tuning: &Tuning, figures: &[Figure]) -> String {
    let body = html! {
        h1 { "The best thresholds, and what they are worth" }
        p.pale {
            "Scale " (tuning.scale) " m, coordinates in " (tuning.precision) ". Searched on "
            (grouped(tuning.queries as u64)) " queries, " (grouped(tuning.judged as u64)) " settings. A \
            missed crossing lets edges or wires through; it is taken to be as bad as "
            (tuning.penalty.false_hits) " false hits."
        }
        h2 { "Fronts" }
        (charts(figures))
        h2 { "Recommended" }
        (priced_table(&[
            ("table 3.1", &tuning.published),
            ("recommended", &tuning.recommended),
            ("reduced", &tuning.reduced),
            ("one relative threshold", &tuning.relative.priced),
        ]))
        p { "Thresholds that can be 0 together for no more than 1%: "
            @if tuning.superfluous.is_empty() { "none" } @else { (tuning.superfluous.join(", ")) }
            "." }
        h2 { "What each threshold matters" }
        .table { table {
            tr { th { "threshold" } th { "penalty at 0" } th { "within 1% from" } th { "to" } }
            @for influence in &tuning.influences {
                tr {
                    td { (influence.threshold) }
                    td { (format!("{:+.1}%", tuning.excess(&influence.at_zero.cost) * 100.0)) }
                    @for end in influence.indifferent { td { (number(end)) } }
                }
            }
        } }
        h2 { "Judged on other queries" }
        @for validation in &tuning.validation {
            p { (validation.name) ", seed " (validation.seed) ": "
                (grouped(validation.queries as u64)) " queries, "
                (grouped(validation.crossings as u64)) " crossings" }
            .table { table {
                (cost_heading())
                @for candidate in &validation.candidates {
                    (cost_row(candidate.name, candidate.setting.as_ref(), &candidate.cost))
                }
            } }
        }
        h2 { "Numbers" }
        @for (name, front) in [
            ("Front by the number of false hits", &tuning.front_by_count),
            ("Front by the gaps of false hits together", &tuning.front_by_gap),
        ] {
            details { summary { (name) }
                (priced_table(&front.iter().map(|priced| ("", priced)).collect::<Vec<_>>()))
            }
        }
    };
    page("Thresholds: search", &body)
}

fn page(title: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                link rel="icon" href="data:,";
                style { (PreEscaped(include_str!("style.css"))) }
            }
            body { (body) }
        }
    };
    page.into_string() + "\n"
}

fn charts(figures: &[Figure]) -> Markup {
    html! {
        .charts {
            @for figure in figures {
                figure id=(figure.name) { (PreEscaped(themed(&figure.svg))) }
            }
        }
    }
}

/// A chart in the colours of the page, as wide as there is room.
fn themed(svg: &str) -> String {
    let colours = [
        (chart::PAPER, "--card"),
        (chart::INK, "--ink"),
        (chart::GRID, "--grid"),
        (chart::GREY, "--grey"),
        (chart::RED, "--red"),
        (chart::BLUE, "--blue"),
        (chart::AMBER, "--amber"),
    ];
    let mut themed = svg.to_owned();
    for (plotters::style::RGBColor(r, g, b), name) in colours {
        themed = themed.replace(
            &format!("\"#{r:02X}{g:02X}{b:02X}\""),
            &format!("\"var({name})\""),
        );
    }
    themed
}

fn table_of(name: &str, thresholds: &[Threshold], evaluated: &[Evaluated]) -> Markup {
    let gap = |gap: Option<f64>| gap.map_or_else(|| "–".to_owned(), short);
    html! {
        details open[evaluated.len() == 1] { summary { (name) }
            .table { table {
                tr {
                    th { "value" } th { "missed crossings" } th { "missed grazes" } th { "false hits" }
                    th { "median gap, m" } th { "largest gap, m" } th { "wrong cases" } th { "late" }
                    th { "early" }
                }
                @for Evaluated { setting, price } in evaluated {
                    tr {
                        td { (values(setting, thresholds)) }
                        td { (grouped(price.missed_crossings())) }
                        td { (grouped(price.missed_grazes)) }
                        td { (grouped(price.false_hits)) }
                        td { (gap(price.gaps.as_ref().map(|gaps| gaps.median))) }
                        td { (gap(price.gaps.as_ref().map(|gaps| gaps.max))) }
                        td { (grouped(price.wrong_cases)) }
                        td { (grouped(price.late)) }
                        td { (grouped(price.early)) }
                    }
                }
            } }
        }
    }
}

/// The values of some thresholds.
fn values(setting: &Setting, thresholds: &[Threshold]) -> String {
    let values = thresholds
        .iter()
        .map(|threshold| number(setting.get(*threshold)));
    values.collect::<Vec<_>>().join(", ")
}

fn priced_table(rows: &[(&str, &Priced)]) -> Markup {
    html! {
        .table { table {
            (cost_heading())
            @for (name, priced) in rows { (cost_row(name, Some(&priced.setting), &priced.cost)) }
        } }
    }
}

fn cost_heading() -> Markup {
    html! {
        tr {
            th { "" }
            @for threshold in Threshold::ALL { th { (breakable(threshold.name())) } }
            th { "missed crossings" } th { "missed grazes" } th { "false hits" } th { "gaps together, m" }
        }
    }
}

/// A name that may go on in the next line after each `_`.
fn breakable(name: &str) -> PreEscaped<String> {
    PreEscaped(name.replace('_', "_<wbr>"))
}

fn cost_row(name: &str, setting: Option<&Setting>, cost: &Cost) -> Markup {
    html! {
        tr {
            td { (name) }
            @for threshold in Threshold::ALL {
                td { (setting.map_or_else(|| "–".to_owned(), |setting| number(setting.get(threshold)))) }
            }
            td { (grouped(cost.missed_crossings)) }
            td { (grouped(cost.missed_grazes)) }
            td { (grouped(cost.false_hits)) }
            td { (short(cost.total_gap)) }
        }
    }
}

fn number(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        value => format!("{value:.1e}"),
    }
}

/// The worst witness of each fault over all settings, with a picture.
fn witnesses(prices: &Prices, sample: &Sample) -> Markup {
    html! {
        .charts {
            @for (fault, witness) in &prices.witnesses {
                @let entry = sample.entry(witness.worst.index);
                @let answer = decide_query(&entry.query);
                figure {
                    img alt={ "The edges of " (entry.id) }
                        src=(data_url(&picture::draw(&entry.id, &entry.query, &answer)));
                    figcaption {
                        strong { (fault) } ", severity " (short(witness.worst.severity)) ": "
                        (values(witness.setting, &Threshold::ALL))
                        pre { (witness.command) }
                    }
                }
            }
        }
    }
}

/// A picture as an address that holds it.
fn data_url(svg: &str) -> String {
    let mut url = "data:image/svg+xml,".to_owned();
    for byte in svg.bytes() {
        match byte {
            b'a'..=b'z'
            | b'A'..=b'Z'
            | b'0'..=b'9'
            | b'-'
            | b'_'
            | b'.'
            | b'='
            | b'/'
            | b':'
            | b';'
            | b','
            | b'('
            | b')' => url.push(char::from(byte)),
            byte => url.push_str(&format!("%{byte:02X}")),
        }
    }
    url
}

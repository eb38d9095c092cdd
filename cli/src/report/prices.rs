//! The result of a sweep as JSON and as text.
//!
//! | field | meaning |
//! | --- | --- |
//! | `version`, `arithmetic` | of this crate; the backend of the exact numbers |
//! | `scale`, `precision` | what a metre of the queries became, in metres; what coordinates were rounded to |
//! | `sources` | name, queries, hits and crossings of each source |
//! | `axes`, `is_product` | the values that were swept, and whether every one with every other |
//! | `settings` | the thresholds and what they cost ([`Price`]), first those of table 3.1 |
//! | `witnesses` | of each fault the worst over all settings, with its query and a command |

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;
use tunnelproof::thesis::Threshold;

use crate::sweep::{Evaluated, Grid, Part, Price, Sample, Setting, Worst};
use tunnelproof_reference::certify::caller::explain_line;
use tunnelproof_reference::certify::table::{grouped, grouped_count, short};
use tunnelproof_reference::corpus::jsonl::{self, Numbers};
use tunnelproof_reference::field::{self, Integer};

/// The result of a sweep.
#[derive(Serialize)]
pub struct Prices<'a> {
    version: &'static str,
    arithmetic: &'static str,
    pub(super) scale: f64,
    pub(super) precision: &'static str,
    pub(super) sources: Vec<SourceFields>,
    pub(super) is_product: bool,
    pub(super) axes: Vec<AxisFields<'a>>,
    pub(super) settings: &'a [Evaluated],
    pub(super) witnesses: BTreeMap<&'a str, WitnessFields<'a>>,
}

#[derive(Serialize)]
pub(super) struct SourceFields {
    pub(super) name: String,
    pub(super) queries: usize,
    pub(super) hits: usize,
    pub(super) crossings: usize,
}

#[derive(Serialize)]
pub(super) struct AxisFields<'a> {
    pub(super) threshold: &'static str,
    pub(super) values: &'a [f64],
}

#[derive(Serialize)]
pub(super) struct WitnessFields<'a> {
    #[serde(flatten)]
    pub(super) worst: &'a Worst,
    pub(super) setting: &'a Setting,
    pub(super) command: String,
    query: Value,
}

impl<'a> Prices<'a> {
    /// What was found with these settings, the first of which is table 3.1.
    pub fn new(sample: &Sample, grid: &'a Grid, evaluated: &'a [Evaluated]) -> Self {
        let axis = |axis: &'a crate::sweep::Axis| AxisFields {
            threshold: axis.threshold.name(),
            values: &axis.values,
        };
        let source = |part: &Part| {
            let hits: Vec<_> = part
                .range
                .clone()
                .filter_map(|index| sample.truth(index).hit)
                .collect();
            SourceFields {
                name: part.name.clone(),
                queries: part.range.len(),
                hits: hits.len(),
                crossings: hits.iter().filter(|hit| hit.crosses).count(),
            }
        };
        Prices {
            version: env!("CARGO_PKG_VERSION"),
            arithmetic: field::Default::BACKEND,
            scale: sample.domain().metres(),
            precision: sample.domain().precision().name(),
            sources: sample.parts().iter().map(source).collect(),
            is_product: grid.is_product,
            axes: grid.axes.iter().map(axis).collect(),
            settings: evaluated,
            witnesses: witnesses(sample, evaluated),
        }
    }

    /// As JSON.
    pub fn json(&self) -> String {
        let json = serde_json::to_string_pretty(self).expect("a result is written as JSON");
        json + "\n"
    }

    /// As a table.
    pub fn text(&self) -> String {
        let queries: usize = self.sources.iter().map(|source| source.queries).sum();
        let crossings: usize = self.sources.iter().map(|source| source.crossings).sum();
        let mut lines = vec![format!(
            "tunnelproof {}, scale {} m, coordinates in {}, {}, {}, exact arithmetic by {}",
            self.version,
            self.scale,
            self.precision,
            grouped_count(queries as u64, "query", "queries"),
            grouped_count(crossings as u64, "crossing", "crossings"),
            self.arithmetic
        )];
        lines.extend(heading("table 3.1"));
        let Some((published, swept)) = self.settings.split_first() else {
            return lines.join("\n") + "\n";
        };
        lines.push(line("", &published.price));
        for block in self.blocks(swept) {
            lines.extend(heading(&block.name));
            for Evaluated { setting, price } in block.evaluated {
                let values = block
                    .thresholds
                    .iter()
                    .map(|threshold| setting.get(*threshold));
                let values: Vec<_> = values.map(|value| format!("{value:.1e}")).collect();
                lines.push(line(&values.join(", "), price));
            }
        }
        lines.push(String::new());
        lines.join("\n")
    }

    /// The settings that were swept, as far as they were judged: those of each axis alone, or all.
    pub(super) fn blocks(&self, mut swept: &'a [Evaluated]) -> Vec<SweptBlock<'a>> {
        let thresholds = self
            .axes
            .iter()
            .filter_map(|axis| Threshold::from_name(axis.threshold));
        let thresholds: Vec<_> = thresholds.collect();
        if self.is_product {
            return vec![SweptBlock::new(thresholds, swept)];
        }
        let mut blocks = Vec::new();
        for (axis, threshold) in self.axes.iter().zip(thresholds) {
            let own;
            (own, swept) = swept.split_at(axis.values.len().min(swept.len()));
            blocks.push(SweptBlock::new(vec![threshold], own));
        }
        blocks
    }
}

/// Settings that differ in these thresholds alone.
pub(super) struct SweptBlock<'a> {
    pub(super) name: String,
    pub(super) thresholds: Vec<Threshold>,
    pub(super) evaluated: &'a [Evaluated],
}

impl<'a> SweptBlock<'a> {
    fn new(thresholds: Vec<Threshold>, evaluated: &'a [Evaluated]) -> Self {
        let names: Vec<_> = thresholds
            .iter()
            .map(|threshold| threshold.name())
            .collect();
        SweptBlock {
            name: names.join(", "),
            thresholds,
            evaluated,
        }
    }
}

/// The worst witness of each fault over all settings; of equals the first.
fn witnesses<'a>(
    sample: &Sample,
    evaluated: &'a [Evaluated],
) -> BTreeMap<&'a str, WitnessFields<'a>> {
    let mut worst: BTreeMap<&str, (&Setting, &Worst)> = BTreeMap::new();
    for Evaluated { setting, price } in evaluated {
        for (fault, found) in &price.worst {
            let held = worst.entry(fault).or_insert((setting, found));
            if found.severity > held.1.severity {
                *held = (setting, found);
            }
        }
    }
    let fields = |(setting, worst): (&'a Setting, &'a Worst)| {
        let entry = sample.entry(worst.index);
        let line = jsonl::write(&entry, Numbers::Decimal);
        WitnessFields {
            worst,
            setting,
            command: explain_line(&entry.id, &entry.query.into()),
            query: serde_json::from_str(&line).expect("a query is written as JSON"),
        }
    };
    worst
        .into_iter()
        .map(|(fault, found)| (fault, fields(found)))
        .collect()
}

const NAME: usize = 24;

fn heading(name: &str) -> [String; 3] {
    let columns = |words: [&str; 8]| {
        let cells: String = words.iter().map(|word| format!("{word:>10}")).collect();
        cells
    };
    [
        String::new(),
        format!(
            "{:<NAME$}{}",
            "",
            columns([
                "missed", "missed", "false", "median", "largest", "wrong", "", ""
            ])
        ),
        format!(
            "{name:<NAME$}{}",
            columns([
                "crossings",
                "grazes",
                "hits",
                "gap",
                "gap",
                "cases",
                "late",
                "early"
            ])
        ),
    ]
}

fn line(name: &str, price: &Price) -> String {
    let gap = |gap: Option<f64>| gap.map_or_else(|| "-".to_owned(), short);
    let cells = [
        grouped(price.missed_crossings()),
        grouped(price.missed_grazes),
        grouped(price.false_hits),
        gap(price.gaps.as_ref().map(|gaps| gaps.median)),
        gap(price.gaps.as_ref().map(|gaps| gaps.max)),
        grouped(price.wrong_cases),
        grouped(price.late),
        grouped(price.early),
    ];
    let cells: String = cells.iter().map(|cell| format!("{cell:>10}")).collect();
    format!("{name:<NAME$}{cells}")
}

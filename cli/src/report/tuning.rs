//! The result of a search for thresholds as JSON and as text.
//!
//! | field | meaning |
//! | --- | --- |
//! | `version`, `arithmetic` | of this crate; the backend of the exact numbers |
//! | `scale`, `precision` | the size of the scene in metres; what coordinates were rounded to |
//! | `queries`, `crossings` | of the sample that was searched on |
//! | `penalty` | how many false hits a missed crossing is as bad as |
//! | `judged` | how many settings were judged |
//! | `front_by_count`, `front_by_gap` | the settings of which none is better in both: crossings that get through, and the number of false hits or their gaps together |
//! | `recommended` | of the first front the setting of least penalty |
//! | `relative` | the best one threshold without unit in the place of all |
//! | `influences` | of each threshold: the best setting in which it is 0, and the values at which the recommended setting stays as good up to 1% |
//! | `superfluous`, `reduced` | thresholds that can be 0 together for no more than 1%, and the best setting then |
//! | `validation` | candidates judged on samples that were not searched on |

use serde::Serialize;
use tunnelproof::thesis::Threshold;

use crate::sweep::{Sample, Setting};
use crate::tune::{Advice, Cost, Influence, Lattice, Member, Penalty, Validated};
use tunnelproof_reference::certify::table::{grouped, grouped_count, short};
use tunnelproof_reference::field::{self, Integer};

/// The result of a search.
#[derive(Serialize)]
pub struct Tuning {
    version: &'static str,
    arithmetic: &'static str,
    pub(super) scale: f64,
    pub(super) precision: &'static str,
    pub(super) queries: usize,
    pub(super) crossings: usize,
    pub(super) penalty: Penalty,
    pub(super) judged: usize,
    pub(super) published: Priced,
    pub(super) front_by_count: Vec<Priced>,
    pub(super) front_by_gap: Vec<Priced>,
    pub(super) recommended: Priced,
    pub(super) relative: Relative,
    pub(super) influences: Vec<InfluenceFields>,
    pub(super) superfluous: Vec<&'static str>,
    pub(super) reduced: Priced,
    pub(super) validation: Vec<Validation>,
}

/// A setting and what it costs.
#[derive(Serialize)]
pub(super) struct Priced {
    pub(super) setting: Setting,
    pub(super) cost: Cost,
}

/// One threshold in the place of all.
#[derive(Serialize)]
pub(super) struct Relative {
    pub(super) threshold: f64,
    #[serde(flatten)]
    pub(super) priced: Priced,
}

/// What a threshold matters.
#[derive(Serialize)]
pub(super) struct InfluenceFields {
    pub(super) threshold: &'static str,
    pub(super) at_zero: Priced,
    /// In the unit of the threshold.
    pub(super) indifferent: [f64; 2],
}

/// Candidates on one sample.
#[derive(Serialize)]
pub struct Validation {
    /// What kind of sample.
    pub name: &'static str,
    /// The families of it.
    pub families: Vec<String>,
    /// Its seed.
    pub seed: u64,
    /// How many queries.
    pub queries: usize,
    /// How many of them are crossed.
    pub crossings: usize,
    /// What the candidates cost on it.
    pub candidates: Vec<Validated>,
}

impl Validation {
    /// What was found on a sample.
    pub fn new(name: &'static str, seed: u64, sample: &Sample, candidates: Vec<Validated>) -> Self {
        Validation {
            name,
            families: sample
                .parts()
                .iter()
                .map(|part| part.name.clone())
                .collect(),
            seed,
            queries: sample.queries().len(),
            crossings: crossings(sample),
            candidates,
        }
    }
}

fn crossings(sample: &Sample) -> usize {
    let all = 0..sample.queries().len();
    all.filter(|&index| sample.truth(index).hit.is_some_and(|hit| hit.crosses))
        .count()
}

impl Tuning {
    /// What was found on a sample and on others; `published` is what table 3.1 costs on it.
    pub fn new(
        sample: &Sample,
        lattice: &Lattice,
        penalty: Penalty,
        published: Cost,
        advice: &Advice,
        validation: Vec<Validation>,
    ) -> Self {
        let priced = |member: &Member| Priced {
            setting: lattice.setting(member.place),
            cost: member.cost,
        };
        let influence = |influence: &Influence| {
            let axis = influence.threshold as usize;
            InfluenceFields {
                threshold: influence.threshold.name(),
                at_zero: priced(&influence.at_zero),
                indifferent: influence.indifferent.map(|value| {
                    let mut place = advice.best.place;
                    place[axis] = value;
                    lattice.setting(place).get(influence.threshold)
                }),
            }
        };
        Tuning {
            version: env!("CARGO_PKG_VERSION"),
            arithmetic: field::Default::BACKEND,
            scale: sample.domain().metres(),
            precision: sample.domain().precision().name(),
            queries: sample.queries().len(),
            crossings: crossings(sample),
            penalty,
            judged: advice.judged,
            published: Priced {
                setting: Setting::published(),
                cost: published,
            },
            front_by_count: advice.by_count.members().map(priced).collect(),
            front_by_gap: advice.by_gap.members().map(priced).collect(),
            recommended: priced(&advice.best),
            relative: Relative {
                threshold: Lattice::relative(advice.relative.place[0]),
                priced: priced(&advice.relative),
            },
            influences: advice.influences.iter().map(influence).collect(),
            superfluous: advice.superfluous.iter().map(|gone| gone.name()).collect(),
            reduced: priced(&advice.reduced),
            validation,
        }
    }

    /// How much more the penalty of a cost is than that of the recommended setting, as a part of
    /// it.
    pub(super) fn excess(&self, cost: &Cost) -> f64 {
        self.penalty.of(cost) / self.penalty.of(&self.recommended.cost) - 1.0
    }

    /// As JSON.
    pub fn json(&self) -> String {
        let json = serde_json::to_string_pretty(self).expect("a result is written as JSON");
        json + "\n"
    }

    /// As text.
    pub fn text(&self) -> String {
        let mut lines = vec![format!(
            "tunnelproof {}, scale {} m, coordinates in {}, {}, {}, {} judged",
            self.version,
            self.scale,
            self.precision,
            grouped_count(self.queries as u64, "query", "queries"),
            grouped_count(self.crossings as u64, "crossing", "crossings"),
            grouped_count(self.judged as u64, "setting", "settings"),
        )];
        lines.extend(self.fronts());
        lines.extend(self.recommendation());
        lines.extend(self.validation.iter().flat_map(validation));
        lines.push(String::new());
        lines.join("\n")
    }

    fn fronts(&self) -> Vec<String> {
        let front = |against: &str, members: &[Priced]| {
            let title = format!("Missed crossings against {against}: none better in both");
            let mut lines = vec![String::new(), title, heading()];
            lines.extend(members.iter().map(|member| line("", member)));
            lines
        };
        let mut lines = front("false hits", &self.front_by_count);
        lines.extend(front(
            "the gaps of the false hits together",
            &self.front_by_gap,
        ));
        lines
    }

    fn recommendation(&self) -> Vec<String> {
        let mut lines = vec![
            String::new(),
            format!(
                "Recommended, where a missed crossing is as bad as {} false hits",
                self.penalty.false_hits
            ),
            heading(),
            line("table 3.1", &self.published),
            line("recommended", &self.recommended),
            line("reduced", &self.reduced),
            line("relative", &self.relative.priced),
            String::new(),
            match self.superfluous.is_empty() {
                true => "No threshold can be 0 for 1% of the penalty".to_owned(),
                false => format!(
                    "Can be 0 together for 1% of the penalty: {}",
                    self.superfluous.join(", ")
                ),
            },
        ];
        for influence in &self.influences {
            let [from, to] = influence.indifferent;
            lines.push(format!(
                "  {:<24}at 0 the penalty is {:+.1}%; from {from:.0e} to {to:.0e} it stays within 1%",
                influence.threshold,
                self.excess(&influence.at_zero.cost) * 100.0,
            ));
        }
        lines.push(format!(
            "One relative threshold, {:.0e}: the penalty is {:+.1}%",
            self.relative.threshold,
            self.excess(&self.relative.priced.cost) * 100.0
        ));
        lines
    }
}

fn validation(validation: &Validation) -> Vec<String> {
    let mut lines = vec![
        String::new(),
        format!(
            "Judged on {}, seed {}: {}, {}",
            validation.name,
            validation.seed,
            grouped_count(validation.queries as u64, "query", "queries"),
            grouped_count(validation.crossings as u64, "crossing", "crossings")
        ),
        heading(),
    ];
    for Validated {
        name,
        setting,
        cost,
    } in &validation.candidates
    {
        let thresholds = setting.map_or_else(no_thresholds, thresholds);
        lines.push(cells(name, &thresholds, cost));
    }
    lines
}

fn no_thresholds() -> String {
    format!("{:>10}", "-").repeat(5)
}

fn heading() -> String {
    let names = ["dist", "dist_1d", "t", "quadratic", "cubic"];
    let names: String = names.iter().map(|name| format!("{name:>10}")).collect();
    format!(
        "  {:<24}{names}{:>11}{:>9}{:>9}{:>11}",
        "", "crossings", "grazes", "false", "gaps, m"
    )
}

fn line(name: &str, Priced { setting, cost }: &Priced) -> String {
    cells(name, &thresholds(*setting), cost)
}

fn thresholds(setting: Setting) -> String {
    let values = Threshold::ALL.map(|threshold| setting.get(threshold));
    let cells = values.map(|value| match value {
        0.0 => format!("{:>10}", "0"),
        value => format!("{:>10}", format!("{value:.1e}")),
    });
    cells.concat()
}

fn cells(name: &str, thresholds: &str, cost: &Cost) -> String {
    format!(
        "  {name:<24}{thresholds}{:>11}{:>9}{:>9}{:>11}",
        grouped(cost.missed_crossings),
        grouped(cost.missed_grazes),
        grouped(cost.false_hits),
        short(cost.total_gap),
    )
}

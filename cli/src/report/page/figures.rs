//! The charts of a sweep and of a search.

use tunnelproof::thesis::Threshold;

use crate::sweep::{Evaluated, Price};
use crate::tune::Front;

use super::super::prices::Prices;
use super::super::tuning::{Priced, Tuning};
use super::chart::{AMBER, Axis, BLUE, Chart, GREY, HeatMap, RED, Series, Shape};

/// A chart with the name of its file.
pub struct Figure {
    /// Letters, digits, `-` and `_` alone.
    pub name: String,
    /// An SVG document.
    pub svg: String,
}

/// The charts of a sweep.
pub fn of_sweep(prices: &Prices) -> Vec<Figure> {
    let mut figures = Vec::new();
    let swept = prices.settings.get(1..).unwrap_or_default();
    match &prices.axes[..] {
        [first, second] if prices.is_product => {
            let values = [first.values, second.values].map(<[f64]>::to_vec);
            let names = [first.threshold, second.threshold];
            figures.extend(heat_maps(names, &values, swept));
        }
        _ => {
            for block in prices.blocks(swept) {
                if let [threshold] = block.thresholds[..] {
                    figures.extend(curves(threshold, block.evaluated));
                }
            }
        }
    }
    figures.push(front_of_sweep(prices.settings));
    figures.extend(prices.settings.first().map(|first| gaps(&first.price)));
    figures
}

/// The charts of a search.
pub fn of_search(tuning: &Tuning) -> Vec<Figure> {
    let missed = |priced: &Priced| priced.cost.missed_crossings as f64;
    let count = |priced: &Priced| [missed(priced), priced.cost.false_hits as f64];
    let gap = |priced: &Priced| [missed(priced), priced.cost.total_gap];
    let chart = |name: &str,
                 title: &str,
                 label: &str,
                 is_log,
                 front: &[Priced],
                 at: &dyn Fn(&Priced) -> [f64; 2]| {
        let one = |name: &str, colour, priced| series(name, colour, Shape::Dots, vec![at(priced)]);
        let chart = Chart {
            title: title.to_owned(),
            axes: [axis("missed crossings", false), axis(label, is_log)],
            series: vec![
                series("front", BLUE, Shape::Line, front.iter().map(at).collect()),
                one("table 3.1", GREY, &tuning.published),
                one("relative", AMBER, &tuning.relative.priced),
                one("recommended", RED, &tuning.recommended),
            ],
            mark: None,
        };
        figure(name, &chart)
    };
    vec![
        chart(
            "front-by-count",
            "Front by the number of false hits",
            "false hits",
            false,
            &tuning.front_by_count,
            &count,
        ),
        chart(
            "front-by-gap",
            "Front by the gaps of false hits",
            "gaps together, m",
            true,
            &tuning.front_by_gap,
            &gap,
        ),
    ]
}

/// What changes with one threshold: two charts.
fn curves(threshold: Threshold, evaluated: &[Evaluated]) -> [Figure; 2] {
    let name = threshold.name();
    let along = |of: &dyn Fn(&Price) -> f64| -> Vec<[f64; 2]> {
        let point =
            |evaluated: &Evaluated| [evaluated.setting.get(threshold), of(&evaluated.price)];
        evaluated.iter().map(point).collect()
    };
    let line = |name: &str, colour, of: &dyn Fn(&Price) -> f64| {
        series(name, colour, Shape::Line, along(of))
    };
    let mark = Some(threshold.published());
    let answers = Chart {
        title: format!("{name}: wrong answers"),
        axes: [axis(&unit(name), true), axis("queries", false)],
        series: vec![
            line("missed crossings", RED, &|price| {
                price.missed_crossings() as f64
            }),
            line("missed grazes", AMBER, &|price| price.missed_grazes as f64),
            line("false hits", BLUE, &|price| price.false_hits as f64),
        ],
        mark,
    };
    let gap = |price: &Price, largest: bool| {
        let gaps = price.gaps.as_ref();
        gaps.map_or(0.0, |gaps| if largest { gaps.max } else { gaps.median })
    };
    let gaps = Chart {
        title: format!("{name}: gaps of false hits"),
        axes: [axis(&unit(name), true), axis("m", true)],
        series: vec![
            line("largest", RED, &|price| gap(price, true)),
            line("median", BLUE, &|price| gap(price, false)),
        ],
        mark,
    };
    [
        figure(&format!("{name}-answers"), &answers),
        figure(&format!("{name}-gaps"), &gaps),
    ]
}

fn heat_maps(names: [&str; 2], values: &[Vec<f64>; 2], evaluated: &[Evaluated]) -> [Figure; 2] {
    let map = |name: &str, title: &str, of: &dyn Fn(&Price) -> u64| {
        let map = HeatMap {
            title: title.to_owned(),
            axes: names.map(|name| axis(&unit(name), true)),
            values: values.clone(),
            numbers: evaluated
                .iter()
                .map(|evaluated| of(&evaluated.price) as f64)
                .collect(),
        };
        Figure {
            name: name.to_owned(),
            svg: map.svg(),
        }
    };
    [
        map(
            "heat-crossings",
            "Missed crossings",
            &Price::missed_crossings,
        ),
        map("heat-false-hits", "False hits", &|price| price.false_hits),
    ]
}

/// Missed crossings against false hits, of every setting that was swept.
fn front_of_sweep(evaluated: &[Evaluated]) -> Figure {
    let pair = |evaluated: &Evaluated| {
        let price = &evaluated.price;
        [price.missed_crossings() as f64, price.false_hits as f64]
    };
    let all: Vec<_> = evaluated.iter().map(pair).collect();
    let published = all.first().copied().into_iter().collect();
    let mut front = Front::default();
    all.iter().for_each(|pair| front.offer(*pair, ()));
    let chart = Chart {
        title: "Missed crossings against false hits".to_owned(),
        axes: [axis("missed crossings", false), axis("false hits", false)],
        series: vec![
            series("settings", GREY, Shape::Dots, all),
            series("front", BLUE, Shape::Line, front.numbers().collect()),
            series("table 3.1", RED, Shape::Dots, published),
        ],
        mark: None,
    };
    figure("front", &chart)
}

/// How the gaps of false hits are distributed with table 3.1.
fn gaps(price: &Price) -> Figure {
    let decades = price.gaps.iter().flat_map(|gaps| &gaps.decades);
    let bars = decades
        .map(|(decade, count)| [f64::from(*decade), *count as f64])
        .collect();
    let chart = Chart {
        title: "Gaps of the false hits of table 3.1".to_owned(),
        axes: [
            axis("gap, decimal logarithm of metres", false),
            axis("false hits", false),
        ],
        series: vec![series("in each decade", BLUE, Shape::Bars, bars)],
        mark: None,
    };
    figure("gaps", &chart)
}

fn figure(name: &str, chart: &Chart) -> Figure {
    Figure {
        name: name.to_owned(),
        svg: chart.svg(),
    }
}

fn axis(label: &str, is_log: bool) -> Axis {
    Axis {
        label: label.to_owned(),
        is_log,
    }
}

fn series(
    name: &str,
    colour: plotters::style::RGBColor,
    shape: Shape,
    points: Vec<[f64; 2]>,
) -> Series {
    Series {
        name: name.to_owned(),
        colour,
        shape,
        points,
    }
}

/// A threshold with its unit.
fn unit(name: &str) -> String {
    let unit = match Threshold::from_name(name).map(Threshold::dimension) {
        Some(1) => "m",
        Some(2) => "m²",
        Some(3) => "m³",
        _ => "step",
    };
    format!("{name}, {unit}")
}

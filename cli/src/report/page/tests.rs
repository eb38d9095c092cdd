//! Pages as a browser would take them, up to drawing them (`tests/browser.rs` has them drawn).

use std::sync::atomic::AtomicBool;

use tunnelproof::thesis::Threshold;

use super::*;
use crate::report::tuning::Validation;
use crate::sweep::{self, Axis, Domain, Grid, Precision, Watch};
use crate::tune::{Judge, Lattice, Penalty, advise, validate};
use tunnelproof_reference::certify::source::Source;
use tunnelproof_reference::generate::by_name;

static NEVER: AtomicBool = AtomicBool::new(false);

fn watch() -> Watch<'static> {
    Watch {
        stop: &NEVER,
        progress: &|_| {},
    }
}

fn sample() -> Sample {
    let source = |name| Source::Family {
        family: by_name(name).unwrap(),
        seed: 1,
        count: 40,
    };
    let sources = ["near_coplanar", "joint", "lattice"].map(source);
    let domain = Domain::new(1.0, Precision::F64).unwrap();
    Sample::read(domain, &sources, |_| {}).unwrap()
}

/// The figures of a sweep, and its page.
fn sweep_of(grid: &Grid) -> (Vec<Figure>, String) {
    let sample = sample();
    let settings: Vec<_> = [Setting::published()]
        .into_iter()
        .chain(grid.settings())
        .collect();
    let evaluated = sweep::run(&sample, &settings, &[], &watch(), |_| {}).unwrap();
    let prices = Prices::new(&sample, grid, &evaluated);
    let figures = of_sweep(&prices);
    let page = sweep_page(&prices, &figures, &sample);
    (figures, page)
}

fn axes(thresholds: &[Threshold]) -> Vec<Axis> {
    let axis = |threshold: &Threshold| Axis::new(*threshold, 1e-9, 1e-3, 4).unwrap();
    thresholds.iter().map(axis).collect()
}

fn names(figures: &[Figure]) -> Vec<&str> {
    figures.iter().map(|figure| figure.name.as_str()).collect()
}

fn assert_needs_nothing_else(page: &str) {
    let outside = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!outside.contains("http"), "an address in the page");
    assert!(!page.contains("<script"), "a script in the page");
    for attribute in ["src=\"", "href=\""] {
        for (at, _) in page.match_indices(attribute) {
            assert!(
                page[at + attribute.len()..].starts_with("data:"),
                "{}",
                &page[at..at + 80]
            );
        }
    }
    assert!(!page.contains("NaN"));
}

#[test]
fn page_of_thresholds_alone_has_two_charts_of_each_and_the_common_ones() {
    let grid = Grid::alone(axes(&[Threshold::Dist, Threshold::T]));
    let (figures, page) = sweep_of(&grid);
    let expected = [
        "dist-answers",
        "dist-gaps",
        "t-answers",
        "t-gaps",
        "front",
        "gaps",
    ];
    assert_eq!(names(&figures), expected);
    assert_needs_nothing_else(&page);
    for name in expected {
        assert!(
            page.contains(&format!("<figure id=\"{name}\"><svg")),
            "{name}"
        );
    }
    for name in ["missed graze", "false hit"] {
        assert!(page.contains(&format!("<strong>{name}</strong>")), "{name}");
    }
    assert!(page.contains("explain -"), "the command of a witness");
}

#[test]
fn page_of_two_thresholds_has_heat_maps() {
    let grid = Grid::product(axes(&[Threshold::Dist, Threshold::CoefficientsCubic])).unwrap();
    let (figures, page) = sweep_of(&grid);
    assert_eq!(
        names(&figures),
        ["heat-crossings", "heat-false-hits", "front", "gaps"]
    );
    assert_needs_nothing_else(&page);
}

#[test]
fn page_of_one_threshold_or_three_has_what_can_be_drawn() {
    let one = Grid::product(axes(&[Threshold::T])).unwrap();
    assert_eq!(
        names(&sweep_of(&one).0),
        ["t-answers", "t-gaps", "front", "gaps"]
    );
    let all = [Threshold::T, Threshold::Dist, Threshold::Dist1d];
    let three = Grid::product(axes(&all)).unwrap();
    assert_eq!(names(&sweep_of(&three).0), ["front", "gaps"]);
}

#[test]
fn page_charts_take_the_colours_of_the_page() {
    let (figures, page) = sweep_of(&Grid::alone(axes(&[Threshold::Dist])));
    assert!(
        figures
            .iter()
            .all(|figure| figure.svg.contains("\"#FCFCFA\""))
    );
    assert!(!page.contains("\"#FCFCFA\"") && page.contains("fill=\"var(--card)\""));
}

#[test]
fn page_of_a_search_shows_what_was_recommended() {
    let sample = sample();
    let lattice = Lattice { length: 1.0 };
    let penalty = Penalty { false_hits: 10.0 };
    let mut judge = Judge::new(lattice, &sample, sample.parts(), watch());
    let advice = advise(&mut judge, penalty).unwrap();
    let candidates = validate(&lattice, &advice, &sample, &watch()).unwrap();
    let validation = vec![Validation::new("the same", 1, &sample, candidates)];
    let published = advice.best.cost;
    let tuning = Tuning::new(&sample, &lattice, penalty, published, &advice, validation);
    let figures = of_search(&tuning);
    assert_eq!(names(&figures), ["front-by-count", "front-by-gap"]);
    let page = search_page(&tuning, &figures);
    assert_needs_nothing_else(&page);
    assert!(page.contains("<td>certified path</td>"));
    let json: serde_json::Value = serde_json::from_str(&tuning.json()).unwrap();
    let missed = &json["recommended"]["cost"]["missed_crossings"];
    assert_eq!(missed, advice.best.cost.missed_crossings);
    assert!(tuning.text().contains("One relative threshold"));
}

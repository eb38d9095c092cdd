use tunnelproof::contact::{Case, Verdict};
use tunnelproof::narrow::{NarrowPhase, Report, Tolerance, Unsupported};
use tunnelproof::query::EdgeEdge;
use tunnelproof::query::{Point, QueryKind};
use tunnelproof::rigid::RigidQuery;
use tunnelproof::thesis::{Options, Thesis, Thresholds};

use super::*;
use crate::certify::tally::Fault;
use crate::corpus::figures;
use crate::generate::FAMILIES;
use crate::registry;
use crate::shape::Shape;
use crate::subject::{Answer, Engine, NoAnswer, Said, Subject};

/// Shrinks a query on which the subject is wrong, and checks what has to hold of every result.
fn shrunk(subject: &dyn Subject, query: &Query) -> Option<(Fault, Shrunk)> {
    let disagreement = Disagreement::with_oracle(subject);
    let fault = disagreement.fault(query).unwrap()?;
    let shrunk = disagreement.shrink(query, fault, MOST_CALLS);
    assert_eq!(disagreement.fault(&shrunk.query), Ok(Some(fault)));
    assert_eq!(shrunk.before, Complexity::new(&Shape::new(query)));
    assert_eq!(shrunk.after, Complexity::new(&Shape::new(&shrunk.query)));
    assert!(shrunk.after < shrunk.before || shrunk.query == *query);
    assert!(shrunk.calls <= MOST_CALLS);
    assert!(shrunk.is_minimal, "{shrunk}");
    let again = disagreement.shrink(&shrunk.query, fault, MOST_CALLS);
    assert_eq!(again.query, shrunk.query, "shrunk twice");
    assert_eq!(disagreement.shrink(query, fault, MOST_CALLS), shrunk);
    Some((fault, shrunk))
}

/// The first queries of a family on which the subject is wrong, shrunk.
fn first_shrunk(subject: &dyn Subject, family: &str, count: usize) -> Vec<(Fault, Shrunk)> {
    let family = crate::generate::by_name(family).unwrap();
    let queries = (0..20_000).map(|index| family.query(2, index));
    let found: Vec<_> = queries
        .filter_map(|query| shrunk(subject, &query))
        .take(count)
        .collect();
    assert_eq!(found.len(), count);
    found
}

fn integers(query: &Query) -> Vec<f64> {
    let points = query.start().iter().chain(query.end());
    let numbers: Vec<f64> = points.flat_map(|point| point.iter().copied()).collect();
    assert!(
        numbers.iter().all(|number| number.fract() == 0.0),
        "{numbers:?}"
    );
    numbers
}

fn assert_few_small_integers(shrunk: &Shrunk, largest: f64, most: usize) {
    let numbers = integers(&shrunk.query);
    let line = shrunk.line("shrunk");
    assert!(numbers.iter().all(|n| n.abs() <= largest), "{line}");
    let count = numbers.iter().filter(|&&n| n != 0.0).count();
    assert!(count <= most, "{line}");
}

/// The thesis path, its reports changed.
struct Faulty<F>(F);

impl<F: Fn(Report) -> Report + Sync> NarrowPhase for Faulty<F> {
    fn name(&self) -> &str {
        "faulty"
    }

    /// That of the path which is right but for rounding.
    fn tolerance(&self) -> Tolerance {
        Thesis::default().tolerance()
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
        Thesis::default().edge_edge(query).map(&self.0)
    }
}

#[test]
fn shrink_a_threshold_raised_is_shown_by_a_few_small_integers() {
    let subject = Engine(Thesis {
        options: Options {
            thresholds: Thresholds {
                parallel: 0.5,
                ..Thresholds::default()
            },
            ..Options::default()
        },
    });
    for (fault, shrunk) in first_shrunk(&subject, "uniform", 5) {
        assert_eq!(fault, Fault::Tunnel);
        assert!(shrunk.before.bits() > 2000);
        assert!(shrunk.after.bits() < 100, "{}", shrunk.line("shrunk"));
    }
}

#[test]
fn shrink_an_early_root_dropped_is_shown_by_a_few_small_integers() {
    let early = |report: Report| match report.verdict {
        Verdict::Hit(contact) if contact.toi < 0.25 => Report {
            verdict: Verdict::Miss,
            ..report
        },
        _ => report,
    };
    for (fault, shrunk) in first_shrunk(&Engine(Faulty(early)), "uniform", 5) {
        assert_eq!(fault, Fault::Tunnel);
        assert_few_small_integers(&shrunk, 5.0, 10);
    }
}

#[test]
fn shrink_a_wrong_case_stays_one() {
    let renamed = |report: Report| Report {
        case: report.case.map(|case| match case {
            Case::General => Case::Coplanar,
            case => case,
        }),
        ..report
    };
    for (fault, shrunk) in first_shrunk(&Engine(Faulty(renamed)), "uniform", 3) {
        assert_eq!(fault, Fault::WrongCase);
        assert_few_small_integers(&shrunk, 1.0, 6);
    }
}

#[test]
fn shrink_what_every_subject_gets_wrong_on_figures_and_families() {
    let mut faults = std::collections::BTreeSet::new();
    for subject in registry::subjects() {
        let figures = figures::entries().map(|entry| entry.query);
        let families = FAMILIES
            .iter()
            .flat_map(|family| (0..60).map(|index| family.query(3, index)));
        let wrong = figures
            .chain(families)
            .filter_map(|query| shrunk(subject, &query));
        faults.extend(wrong.take(12).map(|(fault, _)| (subject.name(), fault)));
    }
    for fault in [Fault::Tunnel, Fault::MissedGraze] {
        assert!(faults.contains(&("shadow-published", fault)), "{faults:?}");
    }
    assert!(
        faults.contains(&("additive", Fault::FalseHit)),
        "{faults:?}"
    );
    let exact = ["oracle", "shadow", "certified"];
    assert!(
        !faults.iter().any(|(name, _)| exact.contains(name)),
        "{faults:?}"
    );
}

#[test]
fn shrink_asks_no_more_often_than_it_may() {
    let query = FAMILIES[0].query(1, 0);
    for most_calls in [0, 1, 7, 100] {
        let mut calls = 0;
        let shrunk = shrink(&query, most_calls, |_| {
            calls += 1;
            calls % 3 == 0
        });
        assert_eq!(calls, shrunk.calls);
        assert!(shrunk.calls <= most_calls);
    }
    assert_eq!(shrink(&query, 0, |_| true).query, query);
    assert!(!shrink(&query, 0, |_| true).is_minimal);
}

#[test]
fn shrink_without_a_condition_ends_at_nothing_but_zeros() {
    for kind in [QueryKind::EdgeEdge, QueryKind::VertexFace] {
        let numbers = FAMILIES[0].query(5, 5);
        let query = Query::new(kind, *numbers.start(), *numbers.end(), [0.25, 0.5]).unwrap();
        let shrunk = shrink(&query, MOST_CALLS, |query| query.kind() == kind);
        assert_eq!(shrunk.after.bits(), 0);
        assert_eq!(shrunk.query.start(), &[Point::origin(); 4]);
        assert!(shrunk.query.radius().is_zero());
        assert!(shrunk.calls < 5);
    }
}

#[test]
fn shrink_takes_any_finite_numbers() {
    for number in [f64::MAX, f64::MIN_POSITIVE, 5e-324, 0.1, -1e300] {
        let point = Point::new(number, -number, number);
        let query = Query::new(QueryKind::EdgeEdge, [point; 4], [point; 4], 0.0).unwrap();
        let is_large = |query: &Query| query.start()[2].x.abs() >= number.abs();
        let shrunk = shrink(&query, MOST_CALLS, is_large);
        assert!(is_large(&shrunk.query) && shrunk.is_minimal);
        assert_eq!(shrunk.query.start()[0], Point::origin());
    }
}

#[test]
fn failure_names_a_query_that_explain_reads() {
    let query = FAMILIES[0].query(1, 0);
    let text = failure(&query, |query| query.end()[3].y >= 0.5);
    let mut lines = text.lines();
    assert!(lines.next().unwrap().contains(" calls"));
    let line = lines.next().unwrap();
    assert!(line.contains("[0.0,1.0,0.0]],"), "{line}");
    assert!(lines.next().unwrap().ends_with("explain -"));
}

/// Misses every contact of a body that turns.
struct Blind;

impl Subject for Blind {
    fn name(&self) -> &str {
        "blind"
    }

    fn answer(&self, _: &Query) -> Result<Answer, NoAnswer> {
        Ok(Answer::Said(Said::default()))
    }

    fn turning_answer(&self, _: &RigidQuery) -> Result<Answer, NoAnswer> {
        Ok(Answer::Said(Said::default()))
    }
}

#[test]
fn shrunk_query_of_a_body_that_turns_shows_the_same_in_few_small_integers() {
    let disagreement = Disagreement::with_oracle(&Blind);
    for name in [
        "turning_uniform",
        "turning_thick_lattice",
        "turning_bodies_lattice",
        "turning_bodies_thick_lattice",
    ] {
        let family = crate::generate::rigid_by_name(name).unwrap();
        let mut kinds = std::collections::BTreeSet::new();
        for query in (0..400).map(|index| family.query(2, index)) {
            let Some(fault) = disagreement.fault(&query).unwrap() else {
                continue;
            };
            if !kinds.insert((query.kind(), fault)) {
                continue;
            }
            let shrunk = disagreement.shrink(&query, fault, 2_000);
            assert_eq!(disagreement.fault(&shrunk.query), Ok(Some(fault)));
            assert_eq!(shrunk.before, query.form().complexity());
            assert_eq!(shrunk.after, shrunk.query.form().complexity());
            assert!(shrunk.after < shrunk.before, "{shrunk}");
            assert!(shrunk.is_minimal, "{shrunk}");
            assert!(
                shrunk.after.bits() <= 24,
                "{shrunk}: {}",
                shrunk.line("shrunk")
            );
            assert!(shrunk.command("shrunk").ends_with("explain --turning -"));
        }
        assert!(kinds.len() >= 2, "{name}: {kinds:?}");
    }
}

#[test]
fn turning_forms_are_the_queries_that_they_were_made_of() {
    for family in crate::generate::all_rigid() {
        for index in 0..50 {
            let query = family.query(1, index);
            assert_eq!(
                query.form().query(),
                Some(query),
                "{}:1:{index}",
                family.name()
            );
        }
    }
}

/// Every number counts: of two bodies there are the most.
#[test]
fn turning_complexity_is_of_all_numbers_and_both_radii() {
    let family = crate::generate::rigid_by_name("turning_bodies_uniform").unwrap();
    let query = family.query(1, 0);
    let of = |radii: [f64; 2]| {
        let query = RigidQuery::new(query.sides(), radii).unwrap();
        query.form().complexity()
    };
    let [none, one, two] = [[0.0, 0.0], [1.0, 0.0], [1.0, 3.0]].map(of);
    assert_eq!([one.bits() - none.bits(), two.bits() - one.bits()], [1, 2]);
}

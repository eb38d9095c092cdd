use std::collections::{HashMap, HashSet};

use num_rational::BigRational;
use proptest::prelude::*;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tunnelproof::contact::{Case, Verdict};
use tunnelproof::narrow::{NarrowPhase, Report, Tolerance, Unsupported};
use tunnelproof::query::{EdgeEdge, Point, QueryKind};
use tunnelproof::thesis::{Erratum, Options, Repairs, Thesis};

use super::euclid::{Polynomial, Sturm};
use super::*;
use tunnelproof_reference::certify::margin::excuses;
use tunnelproof_reference::generate::{FAMILIES, by_name as family};
use tunnelproof_reference::oracle::decide_query;
use tunnelproof_reference::subject::Engine;

/// Runs a target on bytes that stand for queries of every family, and on random ones.
fn finds_nothing(target: &Target, count: u64) {
    for seed in 0..count {
        let family = seed as usize % FAMILIES.len();
        for bytes in [input::seed(family, &random(seed)), random(seed)] {
            if let Err(finding) = target.run(&bytes) {
                panic!("{finding}");
            }
        }
    }
}

#[test]
fn targets_find_nothing_in_what_is_right() {
    let names: HashSet<_> = TARGETS.iter().map(|target| target.name).collect();
    assert_eq!(names.len(), TARGETS.len());
    for target in TARGETS {
        assert_eq!(by_name(target.name).unwrap().name, target.name);
        finds_nothing(target, 300);
        for seed in target.seeds(SEEDS) {
            assert_eq!(target.run(&seed), Ok(()), "{}", target.name);
        }
        for bytes in [&[][..], &[0], &[255; 4], &[7; 1000]] {
            assert_eq!(target.run(bytes), Ok(()), "{}", target.name);
        }
    }
    assert!(by_name("thesis").is_none());
}

proptest! {
    #[test]
    fn input_any_bytes_make_one_query(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let query = input::query(&bytes);
        prop_assert_eq!(query, input::query(&bytes));
    }
}

#[test]
fn input_seeds_reach_every_family_and_mean_its_queries() {
    for (index, family) in FAMILIES.iter().enumerate() {
        let queries: Vec<_> = (0..50)
            .map(|seed| input::query(&input::seed(index, &random(seed))))
            .collect();
        for seed in 0..50 {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            assert_eq!(
                queries[seed as usize],
                family.draw(&mut rng),
                "{}",
                family.name()
            );
        }
        // Where there are no bytes, drawing ends all the same.
        input::query(&input::seed(index, &[]));
    }
}

#[test]
fn input_edges_are_the_query_without_its_kind_and_radius() {
    for seed in 0..1000 {
        let (query, edges) = (input::query(&random(seed)), input::edges(&random(seed)));
        assert_eq!(edges.kind(), QueryKind::EdgeEdge);
        assert!(edges.radius().is_zero());
        assert_eq!((query.start(), query.end()), (edges.start(), edges.end()));
    }
}

#[test]
fn input_bases_have_any_bits_and_small_integers() {
    let of_base = |base: u8, first: u8, seed| {
        input::query(&[&[0, base, first], random(seed).as_slice()].concat())
    };
    let numbers = |query: &Query| -> Vec<f64> {
        let points = query.start().iter().chain(query.end());
        points.flat_map(|point| point.iter().copied()).collect()
    };
    for seed in 0..100 {
        let wide = numbers(&of_base(1, 0, seed));
        assert!(wide.iter().any(|n| n.abs() > 1e30 || n.abs() < 1e-30));
        let narrow = numbers(&of_base(1, 63, seed));
        assert!(narrow.iter().all(|n| (0.25..8.0).contains(&n.abs())));
        let integers = numbers(&of_base(2, 3, seed));
        assert!(integers.iter().all(|n| n.fract() == 0.0 && n.abs() <= 4.0));
    }
}

/// The thesis path with a planted fault.
struct Faulty<Q, R>(Q, R);

impl<Q, R> NarrowPhase for Faulty<Q, R>
where
    Q: Fn(&EdgeEdge) -> EdgeEdge + Sync,
    R: Fn(Report) -> Report + Sync,
{
    fn name(&self) -> &str {
        "faulty"
    }

    fn tolerance(&self) -> Tolerance {
        Thesis::default().tolerance()
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
        Thesis::default().edge_edge(&self.0(query)).map(&self.1)
    }
}

/// The share of the queries of a family on which a subject is reported, of a thousand.
fn reported(engine: impl NarrowPhase, family_name: &str) -> u64 {
    let subject = Engine(engine);
    let family = family(family_name).unwrap();
    let queries = (0..4000).map(|index| family.query(9, index));
    let is_reported = |query: &Query| judges::engine_vs_shadow(&subject, query).is_some();
    queries.filter(is_reported).count() as u64 / 4
}

#[test]
fn thesis_vs_shadow_reports_planted_faults() {
    let same = |query: &EdgeEdge| *query;
    let right = |report: Report| report;
    assert_eq!(reported(Faulty(same, right), "uniform"), 0);
    assert_eq!(reported(Faulty(same, right), "lattice"), 0);
    // The sign of one component of C - A is wrong.
    let sign = |query: &EdgeEdge| {
        let mut ends = [*query.start(), *query.end()];
        for [a, _, c, _] in &mut ends {
            c.x = 2.0 * a.x - c.x;
        }
        EdgeEdge::new(ends[0], ends[1], 0.0).unwrap()
    };
    assert!(reported(Faulty(sign, right), "uniform") > 50);
    assert!(reported(Faulty(sign, right), "lattice") > 5);
    let late = |report: Report| match report.verdict {
        Verdict::Hit(mut contact) => {
            contact.toi += 1e-8;
            Report {
                verdict: Verdict::Hit(contact),
                ..report
            }
        }
        Verdict::Miss => report,
    };
    assert!(reported(Faulty(same, late), "uniform") > 100);
    let first_dropped = |report: Report| match report.verdict {
        Verdict::Hit(contact) if contact.first.on_edges().u > 0.5 => Report {
            verdict: Verdict::Miss,
            ..report
        },
        _ => report,
    };
    assert!(reported(Faulty(same, first_dropped), "uniform") > 50);
}

/// The thesis path with other options, under its name.
#[test]
fn thesis_vs_shadow_reports_confined_motion_that_is_wrong() {
    let with = |repairs: Repairs| {
        let options = Options {
            repairs,
            ..Options::default()
        };
        reported(Thesis { options }, "lattice")
    };
    assert_eq!(with(Repairs::SLIPS), 0);
    // Algorithms 13, 17 and 18.
    let repaired = Repairs::SLIPS.with(Erratum::CollapsedLine);
    assert!(with(repaired) >= 1);
    for (erratum, least) in [
        (Erratum::SegmentDirection, 20),
        (Erratum::InitialArguments, 20),
    ] {
        let count = with(Repairs::SLIPS.without(erratum));
        assert!(count >= least, "{erratum}: {count}");
    }
}

/// Confined motion in small integers, each coordinate up to 16 of any unit: where the rule does not
/// excuse the path, it is right.
#[test]
fn thesis_is_right_on_confined_motion_in_small_integers() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut judged = HashMap::new();
    // A third where Rust checks its arithmetic.
    let count = if cfg!(debug_assertions) {
        10_000
    } else {
        30_000
    };
    for _ in 0..count {
        let largest = rng.random_range(1..=16);
        let unit = 2f64.powi(rng.random_range(-4..=4));
        let query = planar(&mut rng, largest, unit);
        assert_eq!(judges::thesis_vs_shadow(&query), None, "{query:?}");
        let case = decide_query(&query).case;
        let excused = excuses(&query);
        *judged.entry((case, excused)).or_insert(0) += 1;
    }
    eprintln!("{judged:?}");
    for case in [Case::Coplanar, Case::Parallel, Case::Collinear] {
        assert!(judged[&(case, false)] > count / 60, "{judged:?}");
    }
}

/// Points in the plane `z = 0`, sometimes with equal directions or on one axis.
fn planar(rng: &mut ChaCha8Rng, largest: i32, unit: f64) -> Query {
    let kind = rng.random_range(0..4);
    let mut ends = [[Point::origin(); 4]; 2];
    for points in &mut ends {
        for point in points.iter_mut() {
            let [x, y] = [(); 2].map(|()| f64::from(rng.random_range(-largest..=largest)) * unit);
            *point = Point::new(x, if kind == 0 { 0.0 } else { y }, 0.0);
        }
        if kind == 1 {
            let [a, b, c, d] = points;
            b.y = a.y;
            d.y = c.y;
        }
    }
    Query::new(QueryKind::EdgeEdge, ends[0], ends[1], 0.0).unwrap()
}

/// The rule excuses few queries in general position; so what it excuses elsewhere is their doing.
#[test]
fn thesis_is_excused_seldom_in_general_position() {
    let excused = |name: &str, count: u64| {
        let family = family(name).unwrap();
        let queries = (0..count).map(|index| family.query(9, index));
        1000 * queries.filter(excuses).count() as u64 / count
    };
    assert!(excused("uniform", 4000) < 20);
    assert!(excused("lattice", 4000) < 300);
}

#[test]
fn finding_shows_the_query_the_verdicts_and_the_smallest_twin() {
    let points = |z: f64| {
        [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.5, -1.0, z],
            [0.5, 1.0, z],
        ]
    };
    let [start, end] = [1.0, -1.0].map(|z| points(z).map(Point::from));
    let query = Query::EdgeEdge(EdgeEdge::new(start, end, 0.0).unwrap());
    let finding = Finding {
        target: "oracle_vs_shadow",
        what: "differs".to_owned(),
        query: Some(Box::new(query)),
    };
    let text = finding.to_string();
    assert!(text.starts_with("oracle_vs_shadow: differs\n{\"id\":\"oracle_vs_shadow\""));
    assert!(
        text.contains("\n  {\"id\":\"certified\",\"hit\":true,"),
        "{text}"
    );
    assert!(text.contains("explain -\nshrunk, "), "{text}");
}

#[test]
fn finding_of_a_panic_has_its_query() {
    let target = Target {
        name: "planted",
        description: "ends where A does not start in the origin",
        check: Check::Query(|query| {
            assert_eq!(query.start()[0], Point::origin());
            None
        }),
    };
    assert_eq!(target.run(&[0, 2, 0]).unwrap_err().what, "panics");
    let finding = target.run(&input::seed(0, &random(1))).unwrap_err();
    assert!(finding.query.is_some());
    assert!(finding.to_string().contains("explain -"));
}

/// The slow way by itself, on polynomials whose roots are known.
#[test]
fn euclid_roots_divisors_and_signs_of_known_products() {
    let polynomial = |c: &[i64]| Polynomial::new(c.iter().map(|&c| c.into()).collect());
    let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    // (2t - 1)^2 (3t - 1) t and -7 (2t - 1)(t - 2)
    let p = polynomial(&[0, -1, 7, -16, 12]);
    let q = polynomial(&[-14, 35, -14]);
    assert_eq!(q, polynomial(&[-2, 5, -2]));
    assert_eq!(p.gcd(&q), polynomial(&[-1, 2]));
    let chain = Sturm::new(&p);
    let roots = chain.roots(10);
    assert_eq!(roots.len(), 3);
    for (interval, root) in roots.iter().zip([ratio(0, 1), ratio(1, 3), ratio(1, 2)]) {
        let [low, high] = interval.ends();
        assert!(low < root && root <= high);
        assert!(high - low <= ratio(1, 1 << 10));
        assert_eq!(chain.count(interval), 1);
    }
    let signs = q.signs_at(&chain, &roots);
    assert_eq!(
        signs.iter().map(|&sign| sign as i8).collect::<Vec<_>>(),
        [-1, -1, 0]
    );
    let none = polynomial(&[]);
    assert!(
        none.signs_at(&chain, &roots)
            .iter()
            .all(|sign| sign.is_eq())
    );
    assert_eq!(Sturm::new(&polynomial(&[-2, 0, 1])).roots(10).len(), 0);
}

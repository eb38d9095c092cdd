//! The whole against the definition of contact, which knows no cases.
//!
//! At a rational time the question is one of integers, asked here of all four points at once. For
//! every query: at many times before the reported time of impact, or at many times of a miss, there
//! is no contact; at the time of impact there is, exactly if it is rational and to rounding if not.

use num_bigint::BigInt;
use num_traits::ToPrimitive;
use tunnelproof::thesis::Repairs;

use super::lattice::{Random, lattice_query};
use super::{Points, motions, query};
use crate::algebraic::Algebraic;
use crate::answer::{Enclosure, ExactAnswer, Parameters};
use crate::field::Ratio;
use crate::shadow::edge_edge;
use crate::shadow::general::handle_general_case;

type V = [i128; 3];

fn sub(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: V, b: V) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: V, b: V) -> V {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn is_on_segment(x: V, y: V, z: V) -> bool {
    cross(sub(x, y), sub(x, z)) == [0; 3] && dot(sub(x, y), sub(x, z)) <= 0
}

/// Whether the edges touch at `numerator / denominator`. All points are scaled by the denominator,
/// which changes no sign.
fn is_contact(points: &Points, (numerator, denominator): (i128, i128)) -> bool {
    let [a, b, c, d] = [0, 1, 2, 3].map(|point| {
        [0, 1, 2].map(|i| {
            let (start, end) = (
                i128::from(points[point][i]),
                i128::from(points[point + 4][i]),
            );
            (denominator - numerator) * start + numerator * end
        })
    });
    let (k, l, m) = (sub(b, a), sub(d, c), sub(c, a));
    let n = cross(k, l);
    let n2 = dot(n, n);
    let (u, w) = (dot(cross(m, l), n), dot(cross(m, k), n));
    let lines_meet = n2 > 0 && dot(m, n) == 0;
    (lines_meet && (0..=n2).contains(&u) && (0..=n2).contains(&w))
        || is_on_segment(c, a, b)
        || is_on_segment(d, a, b)
        || is_on_segment(a, c, d)
        || is_on_segment(b, c, d)
}

/// The fractions of `[0, 1]` with denominators up to 12, and some that are none of these.
pub(super) fn times() -> Vec<(i128, i128)> {
    let small = (1..=12).flat_map(|d| (0..=d).map(move |n| (n, d)));
    let other = (0..64).map(|n| (16 * n + 5, 1024 + 5));
    small.chain(other).collect()
}

fn ratio((numerator, denominator): (i128, i128)) -> <BigInt as crate::field::Integer>::Ratio {
    Ratio::new(BigInt::from(numerator), BigInt::from(denominator))
}

/// How far apart the two edges' points with these parameters are at `t`, in rounded arithmetic.
fn gap(points: &Points, t: f64, parameters: &Parameters) -> f64 {
    let at = |point: usize, i: usize| {
        (1.0 - t) * points[point][i] as f64 + t * points[point + 4][i] as f64
    };
    let (u, v) = (parameters.u.below, parameters.v.below);
    let on = |start: usize, s: f64, i: usize| (1.0 - s) * at(start, i) + s * at(start + 1, i);
    (0..3)
        .map(|i| (on(0, u, i) - on(2, v, i)).abs())
        .fold(0.0, f64::max)
}

/// What is wrong with the time of impact, judged by the definition.
pub(super) fn fault(points: &Points, times: &[(i128, i128)], repairs: Repairs) -> Option<String> {
    let (_, toi) = handle_general_case(&motions(points), repairs);
    let before = |t: (i128, i128)| {
        let toi: Option<&Algebraic<BigInt>> = toi.as_ref();
        toi.is_none_or(|toi| toi.compare_ratio(&ratio(t)).is_gt())
    };
    if let Some(t) = times.iter().find(|&&t| is_contact(points, t) && before(t)) {
        return Some(format!("contact at {t:?} is missed"));
    }
    let toi = toi?;
    if let Some(t) = toi.rational() {
        let integer = |z: BigInt| z.to_i128().unwrap();
        let t = (integer(t.numerator()), integer(t.denominator()));
        return (!is_contact(points, t)).then(|| format!("no contact at {t:?}"));
    }
    let answer = edge_edge::<BigInt>(&query(points), repairs);
    let gap = worst_gap(points, &answer);
    (gap > 1e-9).then(|| format!("gap {gap} at {answer:?}"))
}

fn worst_gap(points: &Points, answer: &ExactAnswer) -> f64 {
    let Some(hit) = answer.hit else { return 0.0 };
    [Some(hit.first), hit.second]
        .iter()
        .flatten()
        .map(|parameters| gap(points, hit.toi.below, parameters))
        .fold(0.0, f64::max)
}

#[test]
fn shadow_repaired_is_right_on_lattice_queries() {
    let times = times();
    let mut random = Random(1);
    let mut hits = 0;
    // A quarter where Rust checks its arithmetic.
    let count = if cfg!(debug_assertions) {
        10_000
    } else {
        40_000
    };
    for index in 0..count {
        let points = lattice_query(&mut random);
        if let Some(fault) = fault(&points, &times, Repairs::ALL) {
            panic!("query {index}, {points:?}: {fault}");
        }
        let answer = edge_edge::<BigInt>(&query(&points), Repairs::ALL);
        let gap = worst_gap(&points, &answer);
        assert!(gap < 1e-9, "query {index}, {points:?}: gap {gap}");
        hits += usize::from(answer.hit.is_some());
    }
    assert!((count / 4..count * 7 / 8).contains(&hits), "{hits} hits");
}

#[cfg(feature = "gmp")]
#[test]
fn shadow_backends_agree_on_lattice_queries() {
    let mut random = Random(4);
    for _ in 0..10_000 {
        let points = lattice_query(&mut random);
        for repairs in [Repairs::ALL, Repairs::NONE] {
            assert_eq!(
                edge_edge::<BigInt>(&query(&points), repairs),
                edge_edge::<rug::Integer>(&query(&points), repairs),
                "{points:?}"
            );
        }
    }
}

#[test]
fn shadow_published_says_something_finite_of_every_contact_it_reports() {
    let mut random = Random(6);
    let unit = |enclosure: Enclosure| {
        (0.0..=1.0).contains(&enclosure.below)
            && (enclosure.above == enclosure.below || enclosure.above == enclosure.below.next_up())
    };
    let mut false_hits = 0;
    for _ in 0..20_000 {
        let points = lattice_query(&mut random);
        let answer = edge_edge::<BigInt>(&query(&points), Repairs::NONE);
        let Some(hit) = answer.hit else { continue };
        let ends = [Some(hit.first), hit.second];
        assert!(
            unit(hit.toi) && ends.iter().flatten().all(|at| unit(at.u) && unit(at.v)),
            "{points:?}: {hit:?}"
        );
        false_hits += usize::from(worst_gap(&points, &answer) > 1e-9);
    }
    assert!(false_hits > 100, "{false_hits}");
}

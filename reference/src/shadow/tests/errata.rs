//! A witness for every erratum that shows in exact arithmetic, and the proof by search that the
//! others do not.

use num_bigint::BigInt;
use tunnelproof::contact::Case;
use tunnelproof::thesis::{Erratum, Repairs};

use super::contact::{fault, times};
use super::lattice::{Random, lattice_query};
use super::{Points, motions, query};
use crate::shadow::edge_edge;
use crate::shadow::general::handle_general_case;

/// Time of impact, for witnesses in which it is an `f64`.
fn toi(points: &Points, repairs: Repairs) -> Option<f64> {
    let hit = edge_edge::<BigInt>(&query(points), repairs).hit?;
    assert!(hit.toi.is_exact(), "{}", hit.toi);
    Some(hit.toi.below)
}

/// The answer is `truth` with every erratum repaired, `wrong` with all but this one, and `wrong` to
/// the letter of the text.
fn check(erratum: Erratum, points: &Points, truth: Option<f64>, wrong: Option<f64>) {
    let all_but = Repairs::ALL.without(erratum);
    assert_eq!(toi(points, Repairs::ALL), truth, "repaired");
    assert_eq!(toi(points, all_but), wrong, "all but {erratum} repaired");
    assert_eq!(toi(points, Repairs::NONE), wrong, "published");
    let times = times();
    assert_eq!(fault(points, &times, Repairs::ALL), None);
    assert!(fault(points, &times, all_but).is_some());
}

/// A, B, C and D at the start and at the end.
fn points(start: [[i64; 3]; 4], end: [[i64; 3]; 4]) -> Points {
    let ([a, b, c, d], [e, f, g, h]) = (start, end);
    [a, b, c, d, e, f, g, h]
}

#[test]
fn erratum_strict_skip_misses_parallel_edges_in_a_coordinate_plane() {
    // CD falls on AB; two of the three equations are 0 = 0.
    let ab = [[0, 0, 0], [2, 0, 0]];
    let points = points(
        [ab[0], ab[1], [0, 1, 0], [2, 1, 0]],
        [ab[0], ab[1], [0, -1, 0], [2, -1, 0]],
    );
    check(Erratum::StrictSkip, &points, Some(0.5), None);
}

#[test]
fn erratum_collapsed_line_takes_a_point_beside_the_line_for_contact() {
    // A and B change places through the origin; CD lies still on a parallel line.
    let (low, high) = ([-1, -1, -1], [1, 1, 1]);
    let cd = [[-1, 0, -2], [1, 2, 0]];
    let points = points([low, high, cd[0], cd[1]], [high, low, cd[0], cd[1]]);
    check(Erratum::CollapsedLine, &points, None, Some(0.5));
}

#[test]
fn erratum_overlap_arguments_misses_an_edge_that_lies_on_a_longer_one() {
    // C from one side and D from another come down on AB at the same time.
    let ab = [[0, 0, 0], [3, 0, 0]];
    let points = points(
        [ab[0], ab[1], [1, 1, 0], [2, 0, 1]],
        [ab[0], ab[1], [1, -1, 0], [2, 0, -1]],
    );
    check(Erratum::OverlapArguments, &points, Some(0.5), None);
}

#[test]
fn erratum_overlap_arguments_takes_edges_one_after_the_other_for_contact() {
    let ab = [[0, 0, 0], [1, 0, 0]];
    let points = points(
        [ab[0], ab[1], [2, 1, 0], [3, 0, 1]],
        [ab[0], ab[1], [2, -1, 0], [3, 0, -1]],
    );
    check(Erratum::OverlapArguments, &points, None, Some(0.5));
}

#[test]
fn erratum_segment_direction_misses_an_end_that_passes_an_edge() {
    // In the plane x + y + z = 1, where no equation is 0 = 0, C passes the middle of AB.
    let ab = [[2, 0, -1], [0, 0, 1]];
    let points = points(
        [ab[0], ab[1], [1, 1, -1], [1, 2, -2]],
        [ab[0], ab[1], [1, -1, 1], [1, 1, -1]],
    );
    check(Erratum::SegmentDirection, &points, Some(0.5), None);
}

#[test]
fn erratum_initial_arguments_misses_edges_that_cross_and_lie_still() {
    let cross = [[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0]];
    let points = points(cross, cross);
    check(Erratum::InitialArguments, &points, Some(0.0), None);
}

#[test]
fn erratum_point_for_whole_step_misses_a_point_that_passes_an_edge() {
    let cd = [[-1, 0, 0], [1, 0, 0]];
    let points = points(
        [[0, 1, 0], [0, 1, 0], cd[0], cd[1]],
        [[0, -1, 0], [0, -1, 0], cd[0], cd[1]],
    );
    check(Erratum::PointForWholeStep, &points, Some(0.5), None);
}

#[test]
fn erratum_permanent_point_on_line_misses_a_point_that_comes_along_the_line() {
    let cd = [[0, 0, 0], [1, 0, 0]];
    let points = points(
        [[-1, 0, 0], [-1, 0, 0], cd[0], cd[1]],
        [[1, 0, 0], [1, 0, 0], cd[0], cd[1]],
    );
    check(Erratum::PermanentPointOnLine, &points, Some(0.5), None);
}

/// How many of the queries for which `applies` get another time of impact from `b` than from `a`.
fn differences(a: Repairs, b: Repairs, applies: fn(Case) -> bool) -> usize {
    let mut random = Random(2);
    // A quarter where Rust checks its arithmetic.
    let count = if cfg!(debug_assertions) {
        10_000
    } else {
        40_000
    };
    let queries = (0..count).map(|_| lattice_query(&mut random));
    queries
        .filter(|points| {
            let motions = motions(points);
            let (case, first) = handle_general_case(&motions, a);
            let (_, second) = handle_general_case(&motions, b);
            let same = match (&first, &second) {
                (Some(first), Some(second)) => first.compare(second).is_eq(),
                (first, second) => first.is_none() && second.is_none(),
            };
            applies(case) && !same
        })
        .count()
}

#[test]
fn erratum_singular_system_does_not_show_where_a_singular_system_has_no_solution() {
    let erratum = Erratum::SingularSystem;
    let (all, none) = (Repairs::ALL, Repairs::NONE);
    assert_eq!(differences(all, all.without(erratum), |_| true), 0);
    assert_eq!(differences(none, none.with(erratum), |_| true), 0);
}

#[test]
fn erratum_permanent_point_on_line_does_not_show_while_both_edges_have_length() {
    // Such a point enters the other edge at one of its ends. That end is then on the point's own
    // edge, on whose line it cannot always be unless all points share one line.
    let erratum = Erratum::PermanentPointOnLine;
    let all = Repairs::ALL;
    let has_length = |case| case != Case::Degenerate;
    assert_eq!(differences(all, all.without(erratum), has_length), 0);
    assert!(differences(all, all.without(erratum), |_| true) > 0);
    // The comparison itself can find differences.
    assert!(differences(all, all.without(Erratum::StrictSkip), has_length) > 0);
}

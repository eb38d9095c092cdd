//! Each algorithm by itself, on values worked out by hand.

use num_bigint::BigInt;
use num_rational::BigRational;
use tunnelproof::contact::Case;
use tunnelproof::thesis::Repairs;

use super::lattice::Random;
use super::motions;
use crate::algebraic::Algebraic;
use crate::field::{OrderedField, Ratio};
use crate::shadow::detect::*;
use crate::shadow::element::Element;
use crate::shadow::general::{handle_general_case, handle_non_degenerate_case};
use crate::shadow::given::gaussian_elimination_with_pivoting;
use crate::shadow::motion::Motion;
use crate::shadow::parallel::*;
use crate::shadow::planar::*;
use crate::shadow::solve::solve;
use crate::shadow::vector::Vector;

const ALL: Repairs = Repairs::ALL;

fn integers<const N: usize>(values: [i64; N]) -> [BigInt; N] {
    values.map(BigInt::from)
}

fn moving(p: [i64; 3], v: [i64; 3]) -> Motion<BigInt> {
    Motion {
        p: integers(p),
        v: integers(v),
    }
}

fn still(p: [i64; 3]) -> Motion<BigInt> {
    moving(p, [0; 3])
}

fn vector<F: OrderedField>(values: [i64; 3]) -> Vector<F> {
    Vector(values.map(F::from_i64))
}

fn exact(values: [i64; 3]) -> Vector<BigRational> {
    vector(values)
}

fn ratio(numerator: i64, denominator: i64) -> BigRational {
    Ratio::new(BigInt::from(numerator), BigInt::from(denominator))
}

fn is_at(toi: Option<Algebraic<BigInt>>, numerator: i64, denominator: i64) -> bool {
    toi.is_some_and(|toi| toi.compare_ratio(&ratio(numerator, denominator)).is_eq())
}

#[test]
fn algorithms_1_and_2_compare_positions_and_velocities() {
    let (a, b) = (moving([1, 2, 3], [4, 5, 6]), moving([1, 2, 3], [4, 5, 7]));
    let c = still([0; 3]);
    let case1 = |points: [&Motion<BigInt>; 4]| detect_case1(&points.map(Clone::clone));
    assert!(case1([&a, &a, &b, &c]) && case1([&b, &c, &a, &a]));
    assert!(!case1([&a, &b, &a, &b]));
    assert!(detect_case2(&a, &a) && !detect_case2(&a, &b));
}

#[test]
fn algorithm_3_has_the_highest_power_first() {
    // (1 + 2t, 3 + 4t, 5 + 6t) x (7 + 8t, 9 + 10t, 11 + 13t), third component.
    let (k, l) = (
        moving([1, 3, 5], [2, 4, 6]),
        moving([7, 9, 11], [8, 10, 13]),
    );
    let found = compute_quadratic_coefficients_from_cross(&k, &l, 2);
    assert_eq!(found, integers([2 * 10 - 4 * 8, 10 - 24 + 18 - 28, 9 - 21]));
}

#[test]
fn algorithms_4_and_5_find_directions_that_turn_together() {
    let (k, l) = (
        moving([1, 2, 3], [-2, 1, 0]),
        moving([-2, -4, -6], [4, -2, 0]),
    );
    assert!(are_vectors_permanently_parallel(&k, &l));
    let other = moving([-2, -4, -6], [4, -2, 1]);
    assert!(!are_vectors_permanently_parallel(&k, &other));
    let (a, c) = (still([0; 3]), still([5, 5, 5]));
    let d = moving([3, 1, -1], [4, -2, 0]);
    assert!(detect_case3(&[a.clone(), k.clone(), c.clone(), d]));
    let d = moving([3, 1, -1], [4, -2, 1]);
    assert!(!detect_case3(&[a, k, c, d]));
}

#[test]
fn algorithms_6_and_7_find_points_in_one_plane() {
    let [alpha, beta, gamma] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(integers);
    let (delta, nu) = (integers([2, 3, 5]), integers([7, 11, 13]));
    let cubic = compute_cubic_coefficients(&alpha, &beta, &gamma, &delta, &nu);
    assert_eq!(cubic, integers([7, 2 + 11, 3 + 13, 5]));
    let a = moving([0, 0, 0], [1, 1, 0]);
    let [b, c] = [[1, 0, 0], [0, 1, 0]].map(still);
    assert!(detect_case4(&[
        a.clone(),
        b.clone(),
        c.clone(),
        still([5, 7, 0])
    ]));
    assert!(!detect_case4(&[a, b, c, moving([5, 7, 0], [0, 0, 1])]));
}

#[test]
fn solve_is_ascending_within_the_step() {
    // (2t - 1) (3t - 1) (t + 1)
    let roots = solve(&integers([6, 1, -4, 1]));
    assert_eq!(roots.len(), 2);
    assert!(roots[0].compare_ratio(&ratio(1, 3)).is_eq());
    assert!(roots[1].compare_ratio(&ratio(1, 2)).is_eq());
    assert!(solve(&integers([0, 0, 0])).is_empty());
}

#[test]
fn algorithm_8_holds_for_a_point_on_a_line_that_turns() {
    let (y, z) = (moving([0, 0, 0], [1, 0, 0]), moving([1, 1, 1], [0, -3, 2]));
    // X = 2 Z - Y.
    let x = moving([2, 2, 2], [-1, -6, 4]);
    assert!(is_point_permanently_on_line(&y, &z, &x));
    assert!(!is_point_permanently_on_line(&y, &z, &still([2, 2, 2])));
}

#[test]
fn algorithm_9_overlaps_on_closed_intervals_and_points() {
    let at = |x: i64| exact([x, -x, 2 * x]);
    let overlap = |[a, b, c, d]: [i64; 4]| static_colinear_overlap(&at(a), &at(b), &at(c), &at(d));
    assert!(overlap([0, 2, 1, 3]) && overlap([2, 0, 3, 1]) && overlap([0, 3, 1, 2]));
    assert!(overlap([0, 1, 1, 2]) && overlap([0, 1, 2, 1]));
    assert!(!overlap([0, 1, 2, 3]) && !overlap([3, 2, 0, 1]));
    assert!(overlap([1, 1, 0, 2]) && overlap([0, 2, 2, 2]) && !overlap([3, 3, 0, 2]));
    assert!(overlap([1, 1, 1, 1]) && !overlap([1, 1, 2, 2]));
}

#[test]
fn algorithm_10_asks_for_one_time_in_every_dimension() {
    let meet = |v| moving_point_point_intersection(&moving([0, 0, 0], v), &still([1, 2, 0]));
    assert_eq!(meet([3, 6, 0]), Some(ratio(1, 3)));
    assert_eq!(meet([3, 5, 0]), None);
    assert_eq!(meet([3, 6, 1]), None);
    assert_eq!(meet([1, 2, 0]), Some(ratio(1, 1)));
    assert_eq!(meet([-3, -6, 0]), None);
    assert_eq!(meet([0, 0, 0]), None);
    let same = moving([1, 2, 3], [4, 5, 6]);
    assert_eq!(
        moving_point_point_intersection(&same, &same),
        Some(ratio(0, 1))
    );
}

#[test]
fn algorithm_11_takes_the_earliest_meeting_of_ends() {
    let on_line = |start: [i64; 4], velocity: [i64; 4]| {
        [0, 1, 2, 3].map(|i| moving([start[i], 0, 0], [velocity[i], 0, 0]))
    };
    let toi = |start, velocity| handle_parallel_colinear_case(&on_line(start, velocity));
    assert!(is_at(toi([0, 1, 3, 4], [0, 0, -3, -3]), 2, 3));
    assert!(is_at(toi([0, 1, 4, 3], [0, 0, -3, -3]), 2, 3));
    // Both edges are points at t = 1/2, and meet then only.
    assert!(is_at(toi([0, 2, 0, 4], [2, -2, 4, -4]), 0, 1));
    assert!(toi([0, 1, 3, 4], [0, 0, -1, -1]).is_none());
    assert!(is_at(toi([0, 1, 1, 4], [0; 4]), 0, 1));
}

#[test]
fn algorithm_12_keeps_common_roots_only() {
    // (t - 1/2) (1, 1, 0) crossed with (0, 0, 1) and with a vector that vanishes elsewhere.
    let k = moving([-1, -1, 0], [2, 2, 0]);
    let roots = solve_three_quadratic_equations(&k, &still([0, 0, 1]), ALL);
    assert_eq!(roots.len(), 1);
    assert!(roots[0].compare_ratio(&ratio(1, 2)).is_eq());
    let k = moving([-1, -1, 0], [2, 3, 0]);
    assert!(solve_three_quadratic_equations(&k, &still([0, 0, 1]), ALL).is_empty());
    // (3t^2 - 1) in two components: an irrational root, equal by proof and not by rounding.
    let (k, l) = (moving([1, 1, 0], [0, 0, 3]), moving([0, 0, 1], [1, 1, 0]));
    let roots = solve_three_quadratic_equations(&k, &l, ALL);
    assert_eq!(roots.len(), 1);
    assert!(roots[0].rational().is_none());
}

#[test]
fn algorithms_13_and_14_tell_a_common_line_from_a_parallel_one() {
    let [a, b] = [[0, 0, 0], [2, 0, 0]].map(still);
    let falling = |x: i64| moving([x, 1, 0], [0, -2, 0]);
    let case =
        |c: i64, d: i64| handle_parallel_case(&[a.clone(), b.clone(), falling(c), falling(d)], ALL);
    let (name, toi) = case(1, 5);
    assert_eq!(name, Case::Parallel);
    assert!(is_at(toi, 1, 2));
    assert!(case(3, 5).1.is_none());
    let along = |x: i64| moving([x, 0, 0], [-2, 0, 0]);
    let (name, toi) = handle_parallel_case(&[a.clone(), b.clone(), along(3), along(4)], ALL);
    assert_eq!(name, Case::Collinear);
    assert!(is_at(toi, 1, 2));
    let [c, d] = [falling(3), falling(5)];
    assert!(handle_parallel_non_degenerate_case(&[a, b, c, d], ALL).is_none());
}

#[test]
fn algorithm_15_finds_a_point_on_a_closed_segment() {
    let on = |p: [i64; 3], s: [i64; 3]| {
        static_point_segment_intersection(&exact(p), &exact([1, 1, 1]), &exact(s))
    };
    assert!(on([1, 1, 1], [2, 4, 0]) && on([2, 3, 1], [2, 4, 0]) && on([3, 5, 1], [2, 4, 0]));
    assert!(!on([4, 7, 1], [2, 4, 0]) && !on([0, -1, 1], [2, 4, 0]));
    assert!(!on([2, 3, 2], [2, 4, 0]) && !on([2, 4, 1], [2, 4, 0]));
    assert!(on([1, 1, 1], [0; 3]) && !on([1, 1, 2], [0; 3]));
}

#[test]
fn algorithm_16_handles_every_configuration_of_two_segments() {
    let touch = |p, q, r, s| {
        static_segment_segment_intersection(&exact(p), &exact(q), &exact(r), &exact(s), ALL)
    };
    let zero = [0; 3];
    assert!(touch([-1, 0, 0], [0, -1, 0], [2, 0, 0], [0, 2, 0]));
    assert!(touch([-1, 0, 0], [0, 0, 0], [2, 0, 0], [0, 2, 0]));
    assert!(!touch([-1, 0, 0], [0, 1, 0], [2, 0, 0], [0, 2, 0]));
    assert!(!touch([-1, 0, 0], [0, -1, 1], [2, 0, 0], [0, 2, 0]));
    assert!(touch([0, 0, 0], [1, 0, 0], [3, 0, 0], [1, 0, 0]));
    assert!(!touch([0, 0, 0], [2, 0, 0], [1, 0, 0], [1, 0, 0]));
    assert!(!touch([0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 0, 0]));
    assert!(touch([1, 0, 0], [0, 0, 0], zero, [2, 0, 0]));
    assert!(!touch([1, 1, 0], [0, 0, 0], zero, [2, 0, 0]));
    assert!(touch([0, 0, 0], [1, 0, 0], [2, 0, 0], zero));
    assert!(touch([1, 2, 3], [1, 2, 3], zero, zero));
    assert!(!touch([1, 2, 3], [1, 2, 4], zero, zero));
}

#[test]
fn algorithm_17_finds_a_point_that_reaches_a_moving_segment() {
    let (y, z) = (moving([0, 0, 0], [0, 1, 0]), moving([2, 0, 0], [0, 1, 0]));
    let toi = |x: &Motion<BigInt>| moving_point_segment_intersection(x, &y, &z, ALL);
    assert!(is_at(toi(&moving([1, 2, 0], [0, -2, 0])), 2, 3));
    assert!(toi(&moving([3, 2, 0], [0, -2, 0])).is_none());
    // Always on the line, and past the end at t = 1/2.
    assert!(is_at(toi(&moving([3, 0, 0], [-2, 1, 0])), 1, 2));
}

#[test]
fn algorithm_18_looks_at_the_start_and_then_at_the_ends() {
    let [a, b] = [[-1, 0, 0], [1, 0, 0]].map(still);
    let toi = |c, d| handle_2d_case(&[a.clone(), b.clone(), c, d], ALL);
    assert!(is_at(toi(still([0, -1, 0]), still([0, 1, 0])), 0, 1));
    let (c, d) = (moving([0, 1, 0], [0, -4, 0]), still([0, 2, 0]));
    assert!(is_at(toi(c, d.clone()), 1, 4));
    assert!(toi(moving([0, 1, 0], [3, -1, 0]), d).is_none());
}

#[test]
fn algorithm_19_takes_the_first_root_within_both_edges() {
    let [a, b] = [[-1, 0, 0], [1, 0, 0]].map(still);
    let toi = |x: i64| {
        let c = moving([x, -1, 1], [0, 0, -4]);
        let d = moving([x, 1, 1], [1, 0, -4]);
        handle_non_degenerate_case(&[a.clone(), b.clone(), c, d], ALL)
    };
    assert!(is_at(toi(0), 1, 4));
    assert!(toi(2).is_none());
}

#[test]
fn algorithm_20_takes_the_cases_in_order() {
    let [a, b, up, down] = [[-1, 0, 0], [1, 0, 0], [0, 0, 1], [0, 0, -1]].map(still);
    let case = |points: [&Motion<BigInt>; 4]| {
        let (case, toi) = handle_general_case(&points.map(Clone::clone), ALL);
        (case, toi.is_some())
    };
    assert_eq!(case([&a, &a, &a, &b]), (Case::Degenerate, true));
    assert_eq!(case([&up, &up, &a, &b]), (Case::Degenerate, false));
    assert_eq!(case([&a, &b, &a, &up]), (Case::SharedStart, true));
    assert_eq!(case([&a, &b, &b, &a]), (Case::Collinear, true));
    assert_eq!(case([&a, &b, &up, &down]), (Case::Coplanar, true));
    let swing = moving([0, 2, 1], [1, -3, 1]);
    assert_eq!(case([&a, &b, &up, &swing]).0, Case::General);
}

#[test]
fn gaussian_elimination_swaps_a_zero_pivot_and_refuses_a_singular_matrix() {
    let solve = |m: [[i64; 2]; 2], l: [i64; 2]| {
        let field = |row: [i64; 2]| row.map(BigRational::from_i64);
        gaussian_elimination_with_pivoting(m.map(field), field(l))
    };
    assert_eq!(
        solve([[0, 2], [4, 1]], [6, 7]),
        Some([ratio(1, 1), ratio(3, 1)])
    );
    assert_eq!(
        solve([[3, 1], [1, 2]], [1, 1]),
        Some([ratio(1, 5), ratio(2, 5)])
    );
    assert_eq!(solve([[1, -2], [-2, 4]], [1, 1]), None);
    assert_eq!(solve([[0, 0], [0, 0]], [1, 1]), None);
}

#[test]
fn static_algorithms_are_the_same_over_both_fields() {
    let mut random = Random(3);
    let mut touching = 0;
    for _ in 0..20_000 {
        let [p, q, r, s] = [0; 4].map(|_| [0; 3].map(|_| random.within(-1, 1)));
        let by_ratio =
            static_segment_segment_intersection(&exact(p), &exact(q), &exact(r), &exact(s), ALL);
        let [a, b, c, d] = [p, q, r, s].map(vector::<Element<'_, BigInt>>);
        let by_element = static_segment_segment_intersection(&a, &b, &c, &d, ALL);
        assert_eq!(by_ratio, by_element, "{p:?} {q:?} {r:?} {s:?}");
        touching += usize::from(by_ratio);
    }
    assert!(touching > 1000, "{touching}");
}

#[test]
fn motions_are_exact_where_velocities_round() {
    let motions = motions(&[
        [1; 3], [0; 3], [0; 3], [0; 3], [-3; 3], [0; 3], [0; 3], [0; 3],
    ]);
    assert_eq!(motions[0].p, integers([1; 3]));
    assert_eq!(motions[0].v, integers([-4; 3]));
}

//! Edges that are parallel for the whole step (thesis 3.1.2, Algorithms 8 to 14).

use nalgebra::Vector3;

use super::detect::{are_vectors_permanently_parallel, compute_quadratic_coefficients_from_cross};
use super::given::{line_segments_colinear, negligible, static_equality};
use super::motion::Motion;
use super::options::Options;
use super::solve::{Roots, solve};
use super::text::Erratum;
use super::threshold::Thresholds;
use crate::contact::Case;

/// Algorithm 8, `IsPointPermanentlyOnLine` (3.1.2.1): whether `p2` is on the line through `p0` and
/// `p1` for the whole step.
pub fn is_point_permanently_on_line(
    p0: &Motion,
    p1: &Motion,
    p2: &Motion,
    thresholds: &Thresholds,
) -> bool {
    are_vectors_permanently_parallel(&(*p1 - *p0), &(*p2 - *p0), thresholds)
}

/// Algorithm 9, `StaticCoLinearOverlap` (3.1.2.2, equations 3.16 and 3.17): whether two segments
/// `ab` and `cd` on one line overlap. That they are on one line is taken for granted.
///
/// The projections are compared without a threshold. The text projects `P - X` here and `X - P` in
/// equation 3.16; the sign does not matter.
pub fn static_colinear_overlap(
    a: &Vector3<f64>,
    b: &Vector3<f64>,
    c: &Vector3<f64>,
    d: &Vector3<f64>,
    thresholds: &Thresholds,
) -> bool {
    let (r, p) = if static_equality(a, b, thresholds.dist) {
        if static_equality(c, d, thresholds.dist) {
            return static_equality(a, c, thresholds.dist);
        }
        (d - c, c)
    } else {
        (b - a, a)
    };
    let [al, bl, cl, dl] = [a, b, c, d].map(|x| (p - x).dot(&r));
    al.min(bl).max(cl.min(dl)) <= al.max(bl).min(cl.max(dl))
}

/// Algorithm 10, `MovingPointPointIntersection` (3.1.2.2, equation 3.18): when in `[0, 1]` two
/// points are the same.
///
/// Where they are the same for the whole step, every component is passed over and the time is 0.
/// The time is that of the first component in which they move against each other.
pub fn moving_point_point_intersection(
    k: &Motion,
    l: &Motion,
    thresholds: &Thresholds,
) -> Option<f64> {
    let alpha = k.v - l.v;
    let beta = l.p - k.p;
    let mut previous = None;
    for h in 0..3 {
        if negligible(alpha[h], thresholds.dist_1d) {
            if !negligible(beta[h], thresholds.dist_1d) {
                return None;
            }
            continue;
        }
        let t = beta[h] / alpha[h];
        if !(0.0..=1.0).contains(&t) {
            return None;
        }
        match previous {
            None => previous = Some(t),
            Some(previous) if !negligible(t - previous, thresholds.t) => return None,
            Some(_) => {}
        }
    }
    // `abs` turns -0 into 0.
    Some(previous.unwrap_or(0.0).abs())
}

/// Algorithm 11, `HandleParallelCoLinearCase` (3.1.2.2): the time of impact of edges on one line.
pub fn handle_parallel_colinear_case(
    [p0, p1, p2, p3]: &[Motion; 4],
    thresholds: &Thresholds,
) -> Option<f64> {
    if static_colinear_overlap(&p0.p, &p1.p, &p2.p, &p3.p, thresholds) {
        return Some(0.0);
    }
    [(p0, p2), (p0, p3), (p1, p2), (p1, p3)]
        .into_iter()
        .filter_map(|(k, l)| moving_point_point_intersection(k, l, thresholds))
        .min_by(f64::total_cmp)
}

/// Algorithm 12, `SolveThreeQuadraticEquations` (3.1.2.3): the times in `[0, 1]` when
/// `(P + R t) × (Q + S t)` is zero, ascending.
///
/// Empty where all three equations are passed over, though then every time is a solution. That
/// roots of two equations are the same is read as [`Thresholds::same_root`]; the one from the first
/// equation stays.
pub fn solve_three_quadratic_equations(k: &Motion, l: &Motion, options: &Options) -> Roots {
    let threshold = options.thresholds.coefficients_quadratic;
    let mut solutions: Option<Roots> = None;
    for h in 0..3 {
        let coefficients = compute_quadratic_coefficients_from_cross(k, l, h);
        // Published: |c| < threshold; Algorithm 4 takes |c| <= threshold for zero.
        let passed_over = if options.repairs.contains(Erratum::StrictSkip) {
            coefficients.iter().all(|&c| negligible(c, threshold))
        } else {
            coefficients.iter().all(|c| c.abs() < threshold)
        };
        if passed_over {
            continue;
        }
        let roots = solve(coefficients);
        let common = match solutions {
            None => roots,
            Some(before) => intersection(&before, &roots, options.thresholds.same_root),
        };
        if common.is_empty() {
            return common;
        }
        solutions = Some(common);
    }
    solutions.unwrap_or_default()
}

/// `solutions ∩ tmpSolutions` in Algorithm 12.
fn intersection(solutions: &Roots, others: &Roots, same_root: f64) -> Roots {
    solutions.filter(|t| {
        others
            .as_slice()
            .iter()
            .any(|other| negligible(t - other, same_root))
    })
}

/// Algorithm 13, `HandleParallelNonDegenerateCase` (3.1.2.3): the time of impact of parallel edges
/// that are on one line at times.
pub fn handle_parallel_non_degenerate_case(
    [p0, p1, p2, p3]: &[Motion; 4],
    options: &Options,
) -> Option<f64> {
    let thresholds = &options.thresholds;
    let solutions = solve_three_quadratic_equations(&(*p1 - *p0), &(*p2 - *p0), options);
    solutions.as_slice().iter().copied().find(|&t| {
        let [a, b, c, d] = [p0, p1, p2, p3].map(|p| p.at(t));
        // Published: overlap alone. Where AB is a point, the root says nothing about C.
        let repaired = options.repairs.contains(Erratum::CollapsedLine);
        if repaired
            && static_equality(&a, &b, thresholds.dist)
            && !line_segments_colinear(&c, &a, &(d - c), thresholds.colinear)
        {
            return false;
        }
        static_colinear_overlap(&a, &b, &c, &d, thresholds)
    })
}

/// Algorithm 14, `HandleParallelCase` (3.1.2.3): the time of impact of parallel edges, and whether
/// they are [`Case::Collinear`] or [`Case::Parallel`].
pub fn handle_parallel_case(points: &[Motion; 4], options: &Options) -> (Case, Option<f64>) {
    let [p0, p1, p2, _] = points;
    if is_point_permanently_on_line(p0, p1, p2, &options.thresholds) {
        let toi = handle_parallel_colinear_case(points, &options.thresholds);
        (Case::Collinear, toi)
    } else {
        let toi = handle_parallel_non_degenerate_case(points, options);
        (Case::Parallel, toi)
    }
}

#[cfg(test)]
mod tests {
    use super::super::motion::testing::{moving, still};
    use super::super::text::Repairs;
    use super::*;

    fn on_x(x: [f64; 4]) -> [Vector3<f64>; 4] {
        x.map(|x| Vector3::new(x, 0.0, 0.0))
    }

    fn overlap(x: [f64; 4]) -> bool {
        let [a, b, c, d] = on_x(x);
        static_colinear_overlap(&a, &b, &c, &d, &Thresholds::default())
    }

    #[test]
    fn point_permanently_on_line_may_slide_along_a_moving_line() {
        let p0 = moving([0.0; 3], [0.0, 0.0, 1.0]);
        let p1 = moving([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        let sliding = moving([5.0, 0.0, 0.0], [-9.0, 0.0, 1.0]);
        let rising = moving([5.0, 0.0, 0.0], [-9.0, 0.0, 2.0]);
        assert!(is_point_permanently_on_line(
            &p0,
            &p1,
            &sliding,
            &Thresholds::ZERO
        ));
        assert!(!is_point_permanently_on_line(
            &p0,
            &p1,
            &rising,
            &Thresholds::default()
        ));
    }

    #[test]
    fn colinear_overlap_compares_intervals_whatever_their_orientation() {
        assert!(overlap([0.0, 2.0, 1.0, 3.0]));
        assert!(overlap([2.0, 0.0, 3.0, 1.0]));
        assert!(overlap([0.0, 3.0, 1.0, 2.0]));
        assert!(overlap([0.0, 1.0, 1.0, 2.0]));
        assert!(!overlap([0.0, 1.0, 1.25, 2.0]));
        assert!(!overlap([3.0, 2.0, 0.0, 1.0]));
    }

    #[test]
    fn colinear_overlap_takes_the_second_segment_where_the_first_is_a_point() {
        assert!(overlap([1.0, 1.0, 0.0, 2.0]));
        assert!(!overlap([3.0, 3.0, 0.0, 2.0]));
        assert!(overlap([0.0, 2.0, 1.0, 1.0]));
    }

    #[test]
    fn colinear_overlap_of_two_points_is_their_equality() {
        assert!(overlap([1.0, 1.0, 1.0, 1.0]));
        assert!(overlap([1.0, 1.0, 1.0 + 5e-7, 1.0]));
        assert!(!overlap([1.0, 1.0, 2.0, 2.0]));
    }

    #[test]
    fn moving_points_meet_at_the_time_all_components_agree_on() {
        let k = moving([0.0, 0.0, 0.0], [4.0, 2.0, 0.0]);
        let meets = moving([1.0, 0.5, 0.0], [0.0, 0.0, 0.0]);
        let passes = moving([1.0, 1.0, 0.0], [0.0, 0.0, 0.0]);
        let beside = moving([1.0, 0.5, 0.1], [0.0, 0.0, 0.0]);
        let later = moving([5.0, 2.5, 0.0], [0.0, 0.0, 0.0]);
        let thresholds = Thresholds::default();
        assert_eq!(
            moving_point_point_intersection(&k, &meets, &thresholds),
            Some(0.25)
        );
        for other in [passes, beside, later] {
            assert_eq!(
                moving_point_point_intersection(&k, &other, &thresholds),
                None
            );
        }
    }

    #[test]
    fn points_that_are_the_same_for_the_whole_step_meet_at_zero() {
        let k = moving([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]);
        let near = moving([1.0, 2.0, 3.0 + 1e-7], [4.0, 5.0, 6.0]);
        assert_eq!(
            moving_point_point_intersection(&k, &k, &Thresholds::ZERO),
            Some(0.0)
        );
        assert_eq!(
            moving_point_point_intersection(&k, &near, &Thresholds::default()),
            Some(0.0)
        );
        assert_eq!(
            moving_point_point_intersection(&k, &near, &Thresholds::ZERO),
            None
        );
    }

    #[test]
    fn colinear_case_takes_the_earliest_meeting_of_ends() {
        let [a, b, c, d] = on_x([0.0, 1.0, 2.0, 3.0]).map(|p| Motion {
            p,
            v: Vector3::zeros(),
        });
        let reach = |motion: Motion, x: f64| Motion {
            v: Vector3::new(x, 0.0, 0.0),
            ..motion
        };
        let thresholds = Thresholds::default();
        // A overtakes B and meets C first.
        let toi = handle_parallel_colinear_case(&[reach(a, 4.0), b, c, d], &thresholds);
        assert_eq!(toi, Some(0.5));
        // D turns round and meets B before C does.
        let toi = handle_parallel_colinear_case(&[a, b, c, reach(d, -4.0)], &thresholds);
        assert_eq!(toi, Some(0.5));
        assert_eq!(
            handle_parallel_colinear_case(&[a, b, c, d], &thresholds),
            None
        );
        assert_eq!(
            handle_parallel_colinear_case(&[a, c, b, d], &thresholds),
            Some(0.0)
        );
    }

    #[test]
    fn three_equations_keep_only_common_roots() {
        let options = Options::default();
        // K × L = (0, -(2t - 1) c, (2t - 1) b): both equations have the root 1/2.
        let k = still([1.0, 0.0, 0.0]);
        let common = moving([0.0, -1.0, -3.0], [0.0, 2.0, 6.0]);
        let apart = moving([0.0, -1.0, -3.0], [0.0, 2.0, 5.0]);
        let roots = solve_three_quadratic_equations(&k, &common, &options);
        assert_eq!(roots.as_slice(), [0.5]);
        assert!(solve_three_quadratic_equations(&k, &apart, &options).is_empty());
    }

    #[test]
    fn three_equations_join_roots_that_round_differently() {
        let k = still([1.0, 0.0, 0.0]);
        let near = moving([0.0, -0.3, -0.3 - 1e-13], [0.0, 1.0, 1.0]);
        let joined = solve_three_quadratic_equations(&k, &near, &Options::default());
        assert_eq!(joined.as_slice().len(), 1);
        let mut bitwise = Options::default();
        bitwise.thresholds.same_root = 0.0;
        assert!(solve_three_quadratic_equations(&k, &near, &bitwise).is_empty());
    }

    #[test]
    fn three_equations_all_passed_over_give_no_root() {
        let k = still([1.0, 0.0, 0.0]);
        for repairs in [Repairs::NONE, Repairs::ALL] {
            let options = Options {
                repairs,
                ..Options::default()
            };
            assert!(solve_three_quadratic_equations(&k, &k, &options).is_empty());
        }
    }

    #[test]
    fn strict_skip_with_threshold_zero_solves_an_equation_without_content() {
        let k = still([1.0, 0.0, 0.0]);
        let l = moving([0.0, -1.0, 0.0], [0.0, 2.0, 0.0]);
        let published = Options {
            thresholds: Thresholds::ZERO,
            ..Options::default()
        };
        let repaired = Options {
            repairs: Repairs::ALL,
            ..published
        };
        assert!(solve_three_quadratic_equations(&k, &l, &published).is_empty());
        let roots = solve_three_quadratic_equations(&k, &l, &repaired);
        assert_eq!(roots.as_slice(), [0.5]);
    }

    #[test]
    fn parallel_case_tells_collinear_from_parallel() {
        let a = still([0.0; 3]);
        let b = still([1.0, 0.0, 0.0]);
        let falling = |x: f64| moving([x, 3.0, 0.0], [0.0, -4.0, 0.0]);
        let options = Options::default();
        let points = [a, b, falling(0.5), falling(2.0)];
        assert_eq!(
            handle_parallel_case(&points, &options),
            (Case::Parallel, Some(0.75))
        );
        let points = [a, b, falling(1.5), falling(2.0)];
        assert_eq!(
            handle_parallel_case(&points, &options),
            (Case::Parallel, None)
        );
        let points = [a, b, still([1.0, 0.0, 0.0]), still([3.0, 0.0, 0.0])];
        assert_eq!(
            handle_parallel_case(&points, &options),
            (Case::Collinear, Some(0.0))
        );
    }

    #[test]
    fn collapsed_line_is_a_false_hit_unless_repaired() {
        // AB shrinks to the origin at 1/2 and grows again; CD passes one metre beside it.
        let a = moving([-1.0, 0.0, 0.0], [2.0, 0.0, 0.0]);
        let b = moving([1.0, 0.0, 0.0], [-2.0, 0.0, 0.0]);
        let beside = [still([-1.0, 1.0, 0.0]), still([1.0, 1.0, 0.0])];
        let through = [
            moving([-1.0, 1.0, 0.0], [0.0, -2.0, 0.0]),
            moving([1.0, 1.0, 0.0], [0.0, -2.0, 0.0]),
        ];
        let repaired = Options {
            repairs: Repairs::ALL,
            ..Options::default()
        };
        let solve = handle_parallel_non_degenerate_case;
        let points = [a, b, beside[0], beside[1]];
        assert_eq!(solve(&points, &Options::default()), Some(0.5));
        assert_eq!(solve(&points, &repaired), None);
        let points = [a, b, through[0], through[1]];
        assert_eq!(solve(&points, &repaired), Some(0.5));
    }
}

//! Edges that share a plane for the whole step (thesis 3.1.3, Algorithms 15 to 18).

use nalgebra::{Matrix2, Vector2, Vector3};

use super::given::{
    gaussian_elimination_with_pivoting, line_segments_colinear, negligible, static_equality,
};
use super::motion::Motion;
use super::options::{Options, Residual};
use super::parallel::{
    is_point_permanently_on_line, moving_point_point_intersection, solve_three_quadratic_equations,
    static_colinear_overlap,
};
use super::text::Erratum;
use super::threshold::Thresholds;

/// Algorithm 15, `StaticPointSegmentIntersection` (3.1.3.1): whether point `p` is on the segment
/// from `q` in direction `s`.
///
/// Line parameters of different coordinates are compared by [`Thresholds::dist_1d`], though they
/// have no unit; that they are in `[0, 1]` is asked without a threshold.
pub fn static_point_segment_intersection(
    p: &Vector3<f64>,
    q: &Vector3<f64>,
    s: &Vector3<f64>,
    thresholds: &Thresholds,
) -> bool {
    if static_equality(s, &Vector3::zeros(), thresholds.segment) {
        return static_equality(p, q, thresholds.dist);
    }
    let b = p - q;
    let mut found_u = None;
    for i in 0..3 {
        if negligible(s[i], thresholds.dist_1d) {
            if !negligible(b[i], thresholds.dist_1d) {
                return false;
            }
            continue;
        }
        let ui = b[i] / s[i];
        match found_u {
            None => found_u = Some(ui),
            Some(u) if !negligible(u - ui, thresholds.dist_1d) => return false,
            Some(_) => {}
        }
    }
    (0.0..=1.0).contains(&found_u.unwrap_or(0.0))
}

/// Algorithm 16, `StaticSegmentSegmentIntersection` (3.1.3.1): whether the segments from `p` in
/// direction `r` and from `q` in direction `s`, which share a plane, intersect.
pub fn static_segment_segment_intersection(
    p: &Vector3<f64>,
    q: &Vector3<f64>,
    r: &Vector3<f64>,
    s: &Vector3<f64>,
    options: &Options,
) -> bool {
    let thresholds = &options.thresholds;
    let zero = Vector3::zeros();
    if static_equality(r, &zero, thresholds.direction) {
        return static_point_segment_intersection(p, q, s, thresholds);
    }
    if static_equality(s, &zero, thresholds.direction) {
        return static_point_segment_intersection(q, p, r, thresholds);
    }
    if static_equality(&s.cross(r), &zero, thresholds.parallel) {
        if line_segments_colinear(p, q, r, thresholds.colinear) {
            // Published: the segments P to Q and P + R to Q + S.
            return if options.repairs.contains(Erratum::OverlapArguments) {
                static_colinear_overlap(p, &(p + r), q, &(q + s), thresholds)
            } else {
                static_colinear_overlap(p, q, &(p + r), &(q + s), thresholds)
            };
        }
        // Published: go on. 3.1.3.1: "if not, there is no overlap".
        if options.repairs.contains(Erratum::SingularSystem) {
            return false;
        }
    }
    lines_meet_within_segments(p, q, r, s, options)
}

/// The second half of Algorithm 16: `R u - S v = Q - P` by least squares (equations 3.21 to 3.23),
/// then `u` and `v` in `[0, 1]`, without a threshold, and the residual.
///
/// A system that elimination finds singular has no solution here; the text does not say.
fn lines_meet_within_segments(
    p: &Vector3<f64>,
    q: &Vector3<f64>,
    r: &Vector3<f64>,
    s: &Vector3<f64>,
    options: &Options,
) -> bool {
    let b = q - p;
    let m = Matrix2::new(r.dot(r), -r.dot(s), -r.dot(s), s.dot(s));
    let l = Vector2::new(r.dot(&b), -s.dot(&b));
    let Some(x) = gaussian_elimination_with_pivoting(m, l) else {
        return false;
    };
    let (u, v) = (x[0], x[1]);
    if !(0.0..=1.0).contains(&u) || !(0.0..=1.0).contains(&v) {
        return false;
    }
    let delta = r * u - s * v - b;
    let fulfilled = |i: usize| negligible(delta[i], options.thresholds.dist_1d);
    match options.residual {
        Residual::Third => fulfilled(2),
        Residual::All => (0..3).all(fulfilled),
    }
}

/// Algorithm 17, `MovingPointSegmentIntersection` (3.1.3.2, 3.1.3.3): when in `[0, 1]` the moving
/// point `point` is on the segment from `p0` to `p1`.
///
/// The text names the point `P`, `V` in the head and `P2`, `V2` in the body, and leaves out the
/// threshold that Algorithm 12 takes. 3.1.3.3 asks for times in `(0, 1]`, `Solve` gives those in
/// `[0, 1]`; a contact at 0 was found by Algorithm 16 before, except within the thresholds.
pub fn moving_point_segment_intersection(
    point: &Motion,
    p0: &Motion,
    p1: &Motion,
    options: &Options,
) -> Option<f64> {
    let thresholds = &options.thresholds;
    // Published: without this branch, which 3.1.3.2 describes.
    if options.repairs.contains(Erratum::PermanentPointOnLine)
        && is_point_permanently_on_line(p0, p1, point, thresholds)
    {
        return [p0, p1]
            .into_iter()
            .filter_map(|end| moving_point_point_intersection(point, end, thresholds))
            .min_by(f64::total_cmp);
    }
    let solutions = solve_three_quadratic_equations(&(*p1 - *p0), &(*point - *p0), options);
    solutions.as_slice().iter().copied().find(|&t| {
        // Published: the end P1 + V1 t in the place of the direction.
        let s = if options.repairs.contains(Erratum::SegmentDirection) {
            (*p1 - *p0).at(t)
        } else {
            p1.at(t)
        };
        static_point_segment_intersection(&point.at(t), &p0.at(t), &s, thresholds)
    })
}

/// Algorithm 18, `Handle2DCase` (3.1.3.3): the time of impact of coplanar edges.
///
/// The text assigns `overlap, t` from Algorithm 16, which returns no time; the time is 0.
pub fn handle_2d_case([p0, p1, p2, p3]: &[Motion; 4], options: &Options) -> Option<f64> {
    let (r, s) = (p1.p - p0.p, p3.p - p2.p);
    // Published: P0, P1 - P0, P2, P3 - P2, which Algorithm 16 takes as P, Q, R, S.
    let overlap = if options.repairs.contains(Erratum::InitialArguments) {
        static_segment_segment_intersection(&p0.p, &p2.p, &r, &s, options)
    } else {
        static_segment_segment_intersection(&p0.p, &r, &p2.p, &s, options)
    };
    if overlap {
        return Some(0.0);
    }
    [(p0, p2, p3), (p1, p2, p3), (p2, p0, p1), (p3, p0, p1)]
        .into_iter()
        .filter_map(|(point, from, to)| moving_point_segment_intersection(point, from, to, options))
        .min_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::super::motion::testing::{moving, still};
    use super::super::text::Repairs;
    use super::*;

    const ORIGIN: Vector3<f64> = Vector3::new(0.0, 0.0, 0.0);

    fn on_segment(p: [f64; 3], s: [f64; 3]) -> bool {
        static_point_segment_intersection(&p.into(), &ORIGIN, &s.into(), &Thresholds::default())
    }

    /// Segments from the origin in direction `r` and from `q` in direction `s`.
    fn meet(q: [f64; 3], r: [f64; 3], s: [f64; 3], options: &Options) -> bool {
        static_segment_segment_intersection(&ORIGIN, &q.into(), &r.into(), &s.into(), options)
    }

    fn published() -> Options {
        Options {
            repairs: Repairs::NONE,
            ..Options::default()
        }
    }

    #[test]
    fn static_point_is_on_a_segment_where_all_parameters_agree_in_the_unit_interval() {
        let s = [2.0, 4.0, -8.0];
        assert!(on_segment([0.5, 1.0, -2.0], s));
        assert!(on_segment([0.0, 0.0, 0.0], s));
        assert!(on_segment([2.0, 4.0, -8.0], s));
        assert!(!on_segment([0.5, 1.0, -2.5], s));
        assert!(!on_segment([3.0, 6.0, -12.0], s));
        assert!(!on_segment([-0.5, -1.0, 2.0], s));
    }

    #[test]
    fn static_point_must_agree_where_the_segment_has_no_extent() {
        assert!(on_segment([0.5, 1e-7, 0.0], [2.0, 0.0, 0.0]));
        assert!(!on_segment([0.5, 1e-5, 0.0], [2.0, 0.0, 0.0]));
    }

    #[test]
    fn static_point_is_compared_with_a_segment_that_is_a_point() {
        assert!(on_segment([1e-7, 0.0, 0.0], [0.0; 3]));
        assert!(!on_segment([1e-5, 0.0, 0.0], [0.0; 3]));
        // Below `dist_1d` in every coordinate, any parameter will do.
        assert!(on_segment([5e-7, 0.0, 0.0], [1e-7, 0.0, 0.0]));
    }

    #[test]
    fn static_segments_intersect_where_both_parameters_are_in_the_unit_interval() {
        let options = Options::default();
        let r = [4.0, 0.0, 0.0];
        assert!(meet([1.0, -1.0, 0.0], r, [0.0, 2.0, 0.0], &options));
        assert!(meet([4.0, 0.0, 0.0], r, [0.0, 2.0, 0.0], &options));
        assert!(!meet([5.0, -1.0, 0.0], r, [0.0, 2.0, 0.0], &options));
        assert!(!meet([1.0, 1.0, 0.0], r, [0.0, 2.0, 0.0], &options));
        assert!(meet([1.0, -1.0, -1.0], r, [0.0, 2.0, 2.0], &options));
    }

    #[test]
    fn static_segments_that_are_points_go_to_the_point_test() {
        let options = Options::default();
        assert!(meet([-1.0, 0.0, 0.0], [0.0; 3], [2.0, 0.0, 0.0], &options));
        assert!(!meet([1.0, 0.0, 0.0], [0.0; 3], [2.0, 0.0, 0.0], &options));
        assert!(meet([1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0; 3], &options));
        assert!(!meet([3.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0; 3], &options));
        assert!(meet([0.0; 3], [0.0; 3], [0.0; 3], &options));
    }

    #[test]
    fn static_segments_residual_is_asked_of_the_third_component_or_of_all() {
        let third = Options::default();
        let all = Options {
            residual: Residual::All,
            ..third
        };
        // Skew lines, one metre apart along y and along z.
        let along_y = ([1.0, 1.0, -1.0], [4.0, 0.0, 0.0], [0.0, 0.0, 2.0]);
        let along_z = ([1.0, -1.0, 1.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
        assert!(meet(along_y.0, along_y.1, along_y.2, &third));
        assert!(!meet(along_y.0, along_y.1, along_y.2, &all));
        assert!(!meet(along_z.0, along_z.1, along_z.2, &third));
        assert!(!meet(along_z.0, along_z.1, along_z.2, &all));
    }

    #[test]
    fn static_segments_below_a_millimetre_never_cross_by_the_distance_threshold() {
        let mut by_distance = Options::default();
        by_distance.thresholds.parallel = by_distance.thresholds.dist;
        // Perpendicular segments of half a millimetre.
        let (q, r, s) = ([1e-4, -1e-4, 0.0], [5e-4, 0.0, 0.0], [0.0, 5e-4, 0.0]);
        assert!(meet(q, r, s, &Options::default()));
        assert!(!meet(q, r, s, &by_distance));
    }

    #[test]
    fn overlap_arguments_as_published_see_and_miss_the_wrong_overlaps() {
        let repaired = Options::default();
        let (unit, apart, within) = ([1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.5, 0.0, 0.0]);
        assert!(meet(apart, unit, unit, &published()), "false hit");
        assert!(!meet(apart, unit, unit, &repaired));
        assert!(!meet(within, unit, unit, &published()), "miss");
        assert!(meet(within, unit, unit, &repaired));
    }

    #[test]
    fn parallel_segments_on_two_lines_do_not_intersect() {
        let (q, r) = ([0.0, 1.0, 0.0], [3.0, 0.0, 0.0]);
        assert!(!meet(q, r, [6.0, 0.0, 0.0], &Options::default()));
        let all = Options {
            repairs: Repairs::NONE,
            residual: Residual::All,
            ..Options::default()
        };
        assert!(!meet(q, r, [6.0, 0.0, 0.0], &all));
    }

    #[test]
    fn singular_system_as_published_can_be_a_false_hit() {
        // Parallel, 0.14 metres apart; elimination leaves a pivot of rounding errors, u = v = 0.
        let (q, r, s) = ([-0.1, 0.1, 0.0], [0.1, 0.1, 0.0], [0.03, 0.03, 0.0]);
        assert!(meet(q, r, s, &published()));
        assert!(!meet(q, r, s, &Options::default()));
    }

    #[test]
    fn moving_point_meets_a_moving_segment_at_the_first_root_within_it() {
        let options = Options::default();
        let (p0, p1) = (still([2.0, 0.0, 0.0]), still([4.0, 0.0, 0.0]));
        let falling = |x: f64| moving([x, 1.0, 0.0], [0.0, -4.0, 0.0]);
        let meet = |x: f64| moving_point_segment_intersection(&falling(x), &p0, &p1, &options);
        assert_eq!(meet(3.0), Some(0.25));
        assert_eq!(meet(4.0), Some(0.25));
        assert_eq!(meet(5.0), None);
    }

    #[test]
    fn segment_direction_as_published_reaches_as_far_as_its_end_is_from_the_origin() {
        let (p0, p1) = (still([2.0, 0.0, 0.0]), still([4.0, 0.0, 0.0]));
        let beyond = moving([5.0, 1.0, 0.0], [0.0, -4.0, 0.0]);
        let toi = moving_point_segment_intersection(&beyond, &p0, &p1, &published());
        assert_eq!(toi, Some(0.25));
        let (p0, p1) = (still([-2.0, 0.0, 0.0]), still([0.0, 0.0, 0.0]));
        let inside = moving([-1.0, 1.0, 0.0], [0.0, -4.0, 0.0]);
        let toi = moving_point_segment_intersection(&inside, &p0, &p1, &published());
        assert_eq!(toi, None);
        let toi = moving_point_segment_intersection(&inside, &p0, &p1, &Options::default());
        assert_eq!(toi, Some(0.25));
    }

    #[test]
    fn point_permanently_on_line_meets_an_end_of_the_segment() {
        let (p0, p1) = (still([2.0, 0.0, 0.0]), still([3.0, 0.0, 0.0]));
        let sliding = moving([0.0, 0.0, 0.0], [8.0, 0.0, 0.0]);
        let returning = moving([7.0, 0.0, 0.0], [-8.0, 0.0, 0.0]);
        let options = Options::default();
        let toi = moving_point_segment_intersection(&sliding, &p0, &p1, &options);
        assert_eq!(toi, Some(0.25));
        let toi = moving_point_segment_intersection(&returning, &p0, &p1, &options);
        assert_eq!(toi, Some(0.5));
        let toi = moving_point_segment_intersection(&sliding, &p0, &p1, &published());
        assert_eq!(toi, None);
    }

    #[test]
    fn planar_case_without_permanent_points_loses_contacts_to_rounding() {
        // A slides along the line of CD and meets D at 1/3.
        let a = moving([1.0, 1.0, 0.0], [-2.0, 0.0, 0.0]);
        let b = moving([1.0, 0.0, 0.0], [0.0, -1.0, 0.0]);
        let c = moving([0.0, 1.0, 0.0], [1.0, 0.0, 0.0]);
        let d = moving([-1.0, 1.0, 0.0], [1.0, 0.0, 0.0]);
        let without = Options {
            repairs: Repairs::SLIPS.without(Erratum::PermanentPointOnLine),
            ..Options::default()
        };
        let toi = handle_2d_case(&[a, b, c, d], &Options::default());
        assert_eq!(toi, Some(1.0 / 3.0));
        assert_eq!(handle_2d_case(&[a, b, c, d], &without), None);
    }

    #[test]
    fn planar_case_takes_the_earliest_end_that_reaches_the_other_edge() {
        let options = Options::default();
        let (c, d) = (still([-4.0, 0.0, 0.0]), still([4.0, 0.0, 0.0]));
        let a = moving([0.0, 1.0, 0.0], [0.0, -2.0, 0.0]);
        let b = moving([1.0, 2.0, 0.0], [0.0, -8.0, 0.0]);
        assert_eq!(handle_2d_case(&[a, b, c, d], &options), Some(0.25));
        assert_eq!(handle_2d_case(&[c, d, b, a], &options), Some(0.25));
        let high = moving([0.0, 1.0, 0.0], [0.0, -0.5, 0.0]);
        let higher = moving([1.0, 2.0, 0.0], [0.0, -1.0, 0.0]);
        assert_eq!(handle_2d_case(&[high, higher, c, d], &options), None);
    }

    #[test]
    fn initial_arguments_as_published_mistake_the_segments() {
        // AB and CD cross at (1, 1, 0) at the start.
        let points = [
            [0.0, 0.0, 0.0],
            [2.0, 2.0, 0.0],
            [0.0, 2.0, 0.0],
            [2.0, 0.0, 0.0],
        ];
        let crossing = points.map(still);
        assert_eq!(handle_2d_case(&crossing, &Options::default()), Some(0.0));
        assert_eq!(handle_2d_case(&crossing, &published()), None);
        // Far apart at the start, and at rest.
        let points = [
            [0.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [4.0, 0.0, 0.0],
            [4.0, 2.0, 0.0],
        ];
        let apart = points.map(still);
        assert_eq!(handle_2d_case(&apart, &Options::default()), None);
    }
}

//! The general motion, and all cases together (thesis 3.1.4, Algorithms 19 and 20).

use super::detect::{
    detect_case1, detect_case2, detect_case3, detect_case4, triple_product_coefficients,
};
use super::motion::Motion;
use super::options::Options;
use super::parallel::handle_parallel_case;
use super::planar::{handle_2d_case, static_segment_segment_intersection};
use super::solve::solve;
use super::text::Erratum;
use crate::contact::Case;

/// Algorithm 19, `HandleNonDegenerateCase` (3.1.4): the time of impact of edges in general motion,
/// the first root of equation 3.9 at which the segments intersect.
pub fn handle_non_degenerate_case(points: &[Motion; 4], options: &Options) -> Option<f64> {
    let [p0, p1, p2, p3] = points;
    let solutions = solve(triple_product_coefficients(points));
    solutions.as_slice().iter().copied().find(|&t| {
        let (pk, qk) = (p0.at(t), p2.at(t));
        let (rk, sk) = ((*p1 - *p0).at(t), (*p3 - *p2).at(t));
        static_segment_segment_intersection(&pk, &qk, &rk, &sk, options)
    })
}

/// Algorithm 20, `HandleGeneralCase` (3.1.4): the case that the motion belongs to and the time of
/// impact, if any.
///
/// An edge that is a point for the whole step gives no contact in the text ("Should not come here
/// by design"). With [`Erratum::PointForWholeStep`] repaired it goes to Algorithm 18: a point and
/// an edge always share a plane, and a point on the line of the edge for the whole step is found by
/// the branch of [`Erratum::PermanentPointOnLine`], which has to be repaired too.
pub fn handle_general_case(points: &[Motion; 4], options: &Options) -> (Case, Option<f64>) {
    let [p0, _, p2, _] = points;
    let thresholds = &options.thresholds;
    if detect_case1(points, thresholds) {
        let toi = if options.repairs.contains(Erratum::PointForWholeStep) {
            handle_2d_case(points, options)
        } else {
            None
        };
        return (Case::Degenerate, toi);
    }
    if detect_case2(p0, p2, thresholds) {
        return (Case::SharedStart, Some(0.0));
    }
    if detect_case3(points, thresholds) {
        return handle_parallel_case(points, options);
    }
    if detect_case4(points, thresholds) {
        return (Case::Coplanar, handle_2d_case(points, options));
    }
    (Case::General, handle_non_degenerate_case(points, options))
}

#[cfg(test)]
mod tests {
    use super::super::motion::testing::{moving, still};
    use super::super::text::Repairs;
    use super::*;

    #[test]
    fn general_case_takes_the_first_root_within_both_edges() {
        let (a, b) = (still([-1.0, 0.0, 0.0]), still([1.0, 0.0, 0.0]));
        let options = Options::default();
        let c = moving([0.0, -1.0, 1.0], [0.0, 0.0, -4.0]);
        let d = moving([0.0, 1.0, 1.0], [0.25, 0.0, -4.0]);
        assert_eq!(
            handle_non_degenerate_case(&[a, b, c, d], &options),
            Some(0.25)
        );
        let c = moving([2.0, -1.0, 1.0], [0.0, 0.0, -4.0]);
        let d = moving([2.0, 1.0, 1.0], [0.25, 0.0, -4.0]);
        assert_eq!(handle_non_degenerate_case(&[a, b, c, d], &options), None);
    }

    #[test]
    fn all_cases_are_told_apart() {
        let options = Options::default();
        let case = |points: [Motion; 4]| handle_general_case(&points, &options);
        let (a, b) = (still([-1.0, 0.0, 0.0]), still([1.0, 0.0, 0.0]));
        let point = moving([0.0, 1.0, 0.0], [0.0, -2.0, 0.0]);
        let (up, down) = (still([0.0, 0.0, 1.0]), still([0.0, 0.0, -1.0]));
        let shifted = [still([0.0, 0.0, 0.0]), still([2.0, 0.0, 0.0])];
        let above = [still([0.0, 1.0, 0.0]), still([2.0, 1.0, 0.0])];
        let swing = moving([0.0, 2.0, 1.0], [1.0, -3.0, 0.5]);
        assert_eq!(case([a, b, point, point]), (Case::Degenerate, None));
        assert_eq!(case([a, b, a, up]), (Case::SharedStart, Some(0.0)));
        assert_eq!(
            case([a, b, shifted[0], shifted[1]]),
            (Case::Collinear, Some(0.0))
        );
        assert_eq!(case([a, b, above[0], above[1]]), (Case::Parallel, None));
        assert_eq!(case([a, b, up, down]), (Case::Coplanar, Some(0.0)));
        assert_eq!(case([a, b, up, swing]).0, Case::General);
    }

    #[test]
    fn point_for_the_whole_step_is_missed_unless_repaired() {
        let repaired = Options {
            repairs: Repairs::ALL,
            ..Options::default()
        };
        let (a, b) = (still([-1.0, 0.0, 0.0]), still([1.0, 0.0, 0.0]));
        let onto = |x: f64| moving([x, 1.0, 0.5], [0.0, -2.0, -1.0]);
        let along = moving([-3.0, 0.0, 0.0], [4.0, 0.0, 0.0]);
        let opposite = moving([3.0, 0.0, 0.0], [-8.0, 0.0, 0.0]);
        let toi = |points| handle_general_case(&points, &repaired);
        let (hit, miss) = (onto(0.5), onto(2.0));
        assert_eq!(toi([a, b, hit, hit]), (Case::Degenerate, Some(0.5)));
        assert_eq!(toi([hit, hit, a, b]), (Case::Degenerate, Some(0.5)));
        assert_eq!(toi([a, b, miss, miss]), (Case::Degenerate, None));
        assert_eq!(toi([a, b, along, along]), (Case::Degenerate, Some(0.5)));
        assert_eq!(
            toi([along, along, opposite, opposite]),
            (Case::Degenerate, Some(0.5))
        );
        assert_eq!(
            toi([hit, hit, opposite, opposite]),
            (Case::Degenerate, None)
        );
        assert_eq!(toi([hit, hit, hit, hit]), (Case::Degenerate, Some(0.0)));
        let published = handle_general_case(&[a, b, hit, hit], &Options::default());
        assert_eq!(published, (Case::Degenerate, None));
    }
}

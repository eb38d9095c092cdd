//! The general case, and all cases together: Algorithms 19 and 20 (thesis 3.1.4).

use tunnelproof::contact::Case;
use tunnelproof::thesis::{Erratum, Repairs};

use crate::algebraic::Algebraic;
use crate::field::Integer;

use super::detect::{
    detect_case1, detect_case2, detect_case3, detect_case4, triple_product_coefficients,
};
use super::motion::Motion;
use super::parallel::handle_parallel_case;
use super::planar::{handle_2d_case, static_segment_segment_intersection};
use super::solve::solve;

/// Algorithm 19: the first contact of edges that do not share a plane for the whole step.
pub(super) fn handle_non_degenerate_case<Z: Integer>(
    points @ [p0, p1, p2, p3]: &[Motion<Z>; 4],
    repairs: Repairs,
) -> Option<Algebraic<Z>> {
    let (k, l) = (p1.minus(p0), p3.minus(p2));
    let intersects = |t_k: &Algebraic<Z>| {
        let [p_k, q_k, r_k, s_k] = [p0, p2, &k, &l].map(|motion| motion.at(t_k));
        static_segment_segment_intersection(&p_k, &q_k, &r_k, &s_k, repairs)
    };
    solve(&triple_product_coefficients(points))
        .into_iter()
        .find(intersects)
}

/// Algorithm 20: the case of the motion and its first contact.
///
/// The repair of `Erratum::PointForWholeStep` is Algorithm 18: a point and an edge always share a
/// plane. A point on the line of the edge for the whole step is found by the branch of
/// `Erratum::PermanentPointOnLine`, which has to be repaired too.
pub(super) fn handle_general_case<Z: Integer>(
    points: &[Motion<Z>; 4],
    repairs: Repairs,
) -> (Case, Option<Algebraic<Z>>) {
    if detect_case1(points) {
        let toi = repairs
            .contains(Erratum::PointForWholeStep)
            .then(|| handle_2d_case(points, repairs));
        return (Case::Degenerate, toi.flatten());
    }
    let [p0, _, p2, _] = points;
    if detect_case2(p0, p2) {
        return (Case::SharedStart, Some(Algebraic::zero()));
    }
    if detect_case3(points) {
        return handle_parallel_case(points, repairs);
    }
    if detect_case4(points) {
        return (Case::Coplanar, handle_2d_case(points, repairs));
    }
    (Case::General, handle_non_degenerate_case(points, repairs))
}

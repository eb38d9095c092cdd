//! The coplanar case: Algorithms 15 to 18 (thesis 3.1.3).

use tunnelproof::thesis::{Erratum, Repairs};

use crate::algebraic::Algebraic;
use crate::field::{Integer, OrderedField};

use super::given::{gaussian_elimination_with_pivoting, line_segments_colinear, static_equality};
use super::motion::Motion;
use super::parallel::{
    is_point_permanently_on_line, moving_point_point_intersection, solve_three_quadratic_equations,
    static_colinear_overlap,
};
use super::vector::Vector;

/// Algorithm 15: whether the point `p` is on the segment from `q` in direction `s`.
pub(super) fn static_point_segment_intersection<F: OrderedField>(
    p: &Vector<F>,
    q: &Vector<F>,
    s: &Vector<F>,
) -> bool {
    if s.is_zero() {
        return static_equality(p, q);
    }
    let Vector(b) = p - q;
    let mut found: Option<F> = None;
    for (b_i, s_i) in b.into_iter().zip(&s.0) {
        if s_i.is_zero() {
            if !b_i.is_zero() {
                return false;
            }
            continue;
        }
        let u_i = b_i / s_i.clone();
        match &found {
            Some(u) if u.compare(&u_i).is_ne() => return false,
            Some(_) => {}
            None => found = Some(u_i),
        }
    }
    found.is_none_or(|u| u.in_unit_interval())
}

/// Algorithm 16: whether the segments from `p` in direction `r` and from `q` in direction `s`
/// intersect.
///
/// "Check third equation" is read as the last of the three (equation 3.22). Which one it is makes
/// no difference where all four ends are in one plane, as wherever the repaired text comes here:
/// then the least-squares solution fulfils all three.
pub(super) fn static_segment_segment_intersection<F: OrderedField>(
    p: &Vector<F>,
    q: &Vector<F>,
    r: &Vector<F>,
    s: &Vector<F>,
    repairs: Repairs,
) -> bool {
    if r.is_zero() {
        return static_point_segment_intersection(p, q, s);
    }
    if s.is_zero() {
        return static_point_segment_intersection(q, p, r);
    }
    if s.is_parallel_to(r) {
        if line_segments_colinear(p, q, r) {
            let (b, d) = (p + r, q + s);
            return if repairs.contains(Erratum::OverlapArguments) {
                static_colinear_overlap(p, &b, q, &d)
            } else {
                static_colinear_overlap(p, q, &b, &d)
            };
        }
        if repairs.contains(Erratum::SingularSystem) {
            return false;
        }
    }
    let b = q - p;
    let m01 = -r.dot(s);
    let m = [[r.dot(r), m01.clone()], [m01, s.dot(s)]];
    let l = [r.dot(&b), -s.dot(&b)];
    // A singular system has no single solution, hence none with u and v in [0, 1].
    let Some([u, v]) = gaussian_elimination_with_pivoting(m, l) else {
        return false;
    };
    if !u.in_unit_interval() || !v.in_unit_interval() {
        return false;
    }
    let [[.., r], [.., s], [.., b]] = [&r.0, &s.0, &b.0].map(|x| x.each_ref().map(F::clone));
    (r * u - s * v - b).is_zero()
}

/// Algorithm 17: the first time at which the moving point `x` is on the moving segment `yz`.
pub(super) fn moving_point_segment_intersection<Z: Integer>(
    x: &Motion<Z>,
    y: &Motion<Z>,
    z: &Motion<Z>,
    repairs: Repairs,
) -> Option<Algebraic<Z>> {
    if repairs.contains(Erratum::PermanentPointOnLine) && is_point_permanently_on_line(y, z, x) {
        // 3.1.3.2: on the line, and not on the segment at first, it comes in at an end.
        let at_end = |end| moving_point_point_intersection(x, end);
        let t = [y, z].into_iter().filter_map(at_end).min()?;
        return Some(Algebraic::ratio(&t));
    }
    let solutions = solve_three_quadratic_equations(&z.minus(y), &x.minus(y), repairs);
    let intersects = |t_k: &Algebraic<Z>| {
        let [x, y, z] = [x, y, z].map(|point| point.at(t_k));
        if repairs.contains(Erratum::SegmentDirection) {
            static_point_segment_intersection(&x, &y, &(&z - &y))
        } else {
            static_point_segment_intersection(&x, &y, &z)
        }
    };
    solutions.into_iter().find(intersects)
}

/// Algorithm 18: the first contact of edges that share a plane for the whole step.
pub(super) fn handle_2d_case<Z: Integer>(
    points @ [p0, p1, p2, p3]: &[Motion<Z>; 4],
    repairs: Repairs,
) -> Option<Algebraic<Z>> {
    if initial_overlap(points, repairs) {
        return Some(Algebraic::zero());
    }
    [(p0, p2, p3), (p1, p2, p3), (p2, p0, p1), (p3, p0, p1)]
        .into_iter()
        .filter_map(|(x, y, z)| moving_point_segment_intersection(x, y, z, repairs))
        .min_by(Algebraic::compare)
}

/// The first step of Algorithm 18: whether the edges intersect at `t = 0`.
fn initial_overlap<Z: Integer>(points: &[Motion<Z>; 4], repairs: Repairs) -> bool {
    let [p0, p1, p2, p3] = points.each_ref().map(Motion::at_start);
    let (first, second) = (&p1 - &p0, &p3 - &p2);
    if repairs.contains(Erratum::InitialArguments) {
        static_segment_segment_intersection(&p0, &p2, &first, &second, repairs)
    } else {
        static_segment_segment_intersection(&p0, &first, &p2, &second, repairs)
    }
}

//! The parallel case: Algorithms 8 to 14 (thesis 3.1.2).

use tunnelproof::contact::Case;
use tunnelproof::thesis::{Erratum, Repairs};

use crate::algebraic::Algebraic;
use crate::field::{Integer, OrderedField, Ratio};

use super::detect::{are_vectors_permanently_parallel, compute_quadratic_coefficients_from_cross};
use super::given::static_equality;
use super::motion::Motion;
use super::solve::solve;
use super::vector::Vector;

/// Algorithm 8: whether the point `p2` is on the line through `p0` and `p1` for the whole step.
pub(super) fn is_point_permanently_on_line<Z: Integer>(
    p0: &Motion<Z>,
    p1: &Motion<Z>,
    p2: &Motion<Z>,
) -> bool {
    are_vectors_permanently_parallel(&p1.minus(p0), &p2.minus(p0))
}

/// Algorithm 9: whether two segments that are known to lie on one line overlap.
pub(super) fn static_colinear_overlap<F: OrderedField>(
    a: &Vector<F>,
    b: &Vector<F>,
    c: &Vector<F>,
    d: &Vector<F>,
) -> bool {
    let (p, r) = if !static_equality(a, b) {
        (a, b - a)
    } else if !static_equality(c, d) {
        (c, d - c)
    } else {
        return static_equality(a, c);
    };
    let ab = ordered([a, b].map(|x| (p - x).dot(&r)));
    let cd = ordered([c, d].map(|x| (p - x).dot(&r)));
    ab[0].compare(&cd[1]).is_le() && cd[0].compare(&ab[1]).is_le()
}

fn ordered<F: OrderedField>([x, y]: [F; 2]) -> [F; 2] {
    if x.compare(&y).is_gt() {
        [y, x]
    } else {
        [x, y]
    }
}

/// Algorithm 10: the time in `[0, 1]` at which two moving points meet, the first if they are the
/// same point at all times.
pub(super) fn moving_point_point_intersection<Z: Integer>(
    Motion { p, v: r }: &Motion<Z>,
    Motion { p: q, v: s }: &Motion<Z>,
) -> Option<Z::Ratio> {
    let mut previous: Option<Z::Ratio> = None;
    for h in 0..3 {
        let (alpha, beta) = (r[h].sub(&s[h]), q[h].sub(&p[h]));
        if alpha.is_zero() {
            if !beta.is_zero() {
                return None;
            }
            continue;
        }
        let t = Z::Ratio::new(beta, alpha);
        if !t.in_unit_interval() || previous.as_ref().is_some_and(|previous| *previous != t) {
            return None;
        }
        previous = Some(t);
    }
    Some(previous.unwrap_or_else(|| Z::Ratio::from_i64(0)))
}

/// Algorithm 11: the first contact of edges on a common line.
pub(super) fn handle_parallel_colinear_case<Z: Integer>(
    points: &[Motion<Z>; 4],
) -> Option<Algebraic<Z>> {
    let [a, b, c, d] = points.each_ref().map(Motion::at_start);
    if static_colinear_overlap(&a, &b, &c, &d) {
        return Some(Algebraic::zero());
    }
    let [p0, p1, p2, p3] = points;
    [(p0, p2), (p0, p3), (p1, p2), (p1, p3)]
        .into_iter()
        .filter_map(|(x, y)| moving_point_point_intersection(x, y))
        .min()
        .map(|t| Algebraic::ratio(&t))
}

/// Algorithm 12: the times in `[0, 1]`, ascending, at which the cross product of two moving vectors
/// is 0; none if it is 0 at all times.
pub(super) fn solve_three_quadratic_equations<Z: Integer>(
    k: &Motion<Z>,
    l: &Motion<Z>,
    repairs: Repairs,
) -> Vec<Algebraic<Z>> {
    // `|c| < 0` holds for no c, so that the published comparison passes over no equation.
    let skips_zero = repairs.contains(Erratum::StrictSkip);
    let mut solutions: Option<Vec<Algebraic<Z>>> = None;
    for h in 0..3 {
        let coefficients = compute_quadratic_coefficients_from_cross(k, l, h);
        if skips_zero && coefficients.iter().all(Z::is_zero) {
            continue;
        }
        let found = solve(&coefficients);
        let common = match solutions {
            None => found,
            Some(mut solutions) => {
                solutions.retain(|t| found.iter().any(|other| t.compare(other).is_eq()));
                solutions
            }
        };
        if common.is_empty() {
            return common;
        }
        solutions = Some(common);
    }
    solutions.unwrap_or_default()
}

/// Algorithm 13: the first contact of edges that stay parallel, not always on a common line.
pub(super) fn handle_parallel_non_degenerate_case<Z: Integer>(
    points @ [p0, p1, p2, _]: &[Motion<Z>; 4],
    repairs: Repairs,
) -> Option<Algebraic<Z>> {
    let solutions = solve_three_quadratic_equations(&p1.minus(p0), &p2.minus(p0), repairs);
    let overlaps = |t_k: &Algebraic<Z>| {
        let [a, b, c, d] = points.each_ref().map(|point| point.at(t_k));
        // Where B = A at the root, (B - A) x (C - A) = 0 says nothing about the line CD.
        let on_one_line = || (&d - &c).is_parallel_to(&(&a - &c));
        (!repairs.contains(Erratum::CollapsedLine) || on_one_line())
            && static_colinear_overlap(&a, &b, &c, &d)
    };
    solutions.into_iter().find(overlaps)
}

/// Algorithm 14: the first contact of edges that are parallel for the whole step, and whether they
/// are on a common line for the whole step.
pub(super) fn handle_parallel_case<Z: Integer>(
    points @ [p0, p1, p2, _]: &[Motion<Z>; 4],
    repairs: Repairs,
) -> (Case, Option<Algebraic<Z>>) {
    if is_point_permanently_on_line(p0, p1, p2) {
        (Case::Collinear, handle_parallel_colinear_case(points))
    } else {
        (
            Case::Parallel,
            handle_parallel_non_degenerate_case(points, repairs),
        )
    }
}

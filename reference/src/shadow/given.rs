//! Functions that Algorithms 1 to 20 call without stating them (`Solve` is in
//! [`solve`](super::solve)), with every threshold 0.

use crate::field::OrderedField;

use super::vector::Vector;

/// `StaticEquality(a, b, 0)`: whether two points are the same.
pub(super) fn static_equality<F: OrderedField>(a: &Vector<F>, b: &Vector<F>) -> bool {
    (a - b).is_zero()
}

/// `LineSegmentsCoLinear(P, Q, R, S)`: whether two segments that are known to be parallel lie on
/// one line, which goes through `p` in direction `r`, not 0; `q` is a point of the other segment.
pub(super) fn line_segments_colinear<F: OrderedField>(
    p: &Vector<F>,
    q: &Vector<F>,
    r: &Vector<F>,
) -> bool {
    (q - p).is_parallel_to(r)
}

/// `GaussianEliminationWithPivoting(M, L)`: the solution of `m x = l`, rows first; `None` where `m`
/// is singular.
///
/// Without division until the end (Bareiss 1968), so that both components have the determinant for
/// a denominator. Nothing rounds, so any pivot but 0 is as good as the largest.
pub(super) fn gaussian_elimination_with_pivoting<F: OrderedField>(
    [mut upper, mut lower]: [[F; 2]; 2],
    [mut l0, mut l1]: [F; 2],
) -> Option<[F; 2]> {
    if upper[0].is_zero() {
        std::mem::swap(&mut upper, &mut lower);
        std::mem::swap(&mut l0, &mut l1);
    }
    let ([m00, m01], [m10, m11]) = (upper, lower);
    // Row 1 times m00 less row 0 times m10, which leaves x1; and so, upwards, x0.
    let determinant = m11.clone() * m00.clone() - m10.clone() * m01.clone();
    if determinant.is_zero() {
        return None;
    }
    let x1 = (l1.clone() * m00 - l0.clone() * m10) / determinant.clone();
    let x0 = (l0 * m11 - l1 * m01) / determinant;
    Some([x0, x1])
}

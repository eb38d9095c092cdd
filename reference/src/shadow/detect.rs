//! Which case: Algorithms 1 to 7 (thesis 3.1.1) over the integers.

use crate::field::Integer;

use super::motion::Motion;
use super::vector::dot;

/// Algorithm 1: whether an edge is a point for the whole step.
pub(super) fn detect_case1<Z: Integer>([p0, p1, p2, p3]: &[Motion<Z>; 4]) -> bool {
    same_for_whole_step(p0, p1) || same_for_whole_step(p2, p3)
}

/// Algorithm 2: whether A and C are the same point for the whole step.
pub(super) fn detect_case2<Z: Integer>(p0: &Motion<Z>, p2: &Motion<Z>) -> bool {
    same_for_whole_step(p0, p2)
}

/// The condition that Algorithms 1 and 2 share: `P_i = P_j` and `V_i = V_j`.
fn same_for_whole_step<Z: Integer>(a: &Motion<Z>, b: &Motion<Z>) -> bool {
    a.p == b.p && a.v == b.v
}

/// Algorithm 3: the coefficients `c0 t^2 + c1 t + c2` of component `h` of the cross product of
/// `K = P + R t` and `L = Q + S t` (equation 3.3).
pub(super) fn compute_quadratic_coefficients_from_cross<Z: Integer>(
    Motion { p, v: r }: &Motion<Z>,
    Motion { p: q, v: s }: &Motion<Z>,
    h: usize,
) -> [Z; 3] {
    let (i, j) = ((h + 1) % 3, (h + 2) % 3);
    let mut c0 = r[i].mul(&s[j]);
    c0.sub_product(&r[j], &s[i]);
    let mut c1 = p[i].mul(&s[j]);
    c1.sub_product(&p[j], &s[i]);
    c1.add_product(&r[i], &q[j]);
    c1.sub_product(&r[j], &q[i]);
    let mut c2 = p[i].mul(&q[j]);
    c2.sub_product(&p[j], &q[i]);
    [c0, c1, c2]
}

/// Algorithm 4: whether two vectors are parallel, or one is 0, at all times.
pub(super) fn are_vectors_permanently_parallel<Z: Integer>(k: &Motion<Z>, l: &Motion<Z>) -> bool {
    (0..3).all(|h| {
        compute_quadratic_coefficients_from_cross(k, l, h)
            .iter()
            .all(Z::is_zero)
    })
}

/// Algorithm 5: whether the edges are parallel for the whole step.
pub(super) fn detect_case3<Z: Integer>([p0, p1, p2, p3]: &[Motion<Z>; 4]) -> bool {
    are_vectors_permanently_parallel(&p1.minus(p0), &p3.minus(p2))
}

/// Algorithm 6: the coefficients, highest power first, of the cubic `(K x L) . M` (equation 3.9).
pub(super) fn compute_cubic_coefficients<Z: Integer>(
    alpha: &[Z; 3],
    beta: &[Z; 3],
    gamma: &[Z; 3],
    delta: &[Z; 3],
    nu: &[Z; 3],
) -> [Z; 4] {
    [
        dot(alpha, nu),
        dot(alpha, delta).add(&dot(beta, nu)),
        dot(beta, delta).add(&dot(gamma, nu)),
        dot(delta, gamma),
    ]
}

/// The lines that Algorithms 7 and 19 share: the coefficients of `((B - A) x (D - C)) . (C - A)`.
pub(super) fn triple_product_coefficients<Z: Integer>([p0, p1, p2, p3]: &[Motion<Z>; 4]) -> [Z; 4] {
    let (k, l, m) = (p1.minus(p0), p3.minus(p2), p2.minus(p0));
    let [x, y, z] = [0, 1, 2].map(|h| compute_quadratic_coefficients_from_cross(&k, &l, h));
    let ([a0, b0, c0], [a1, b1, c1], [a2, b2, c2]) = (x, y, z);
    compute_cubic_coefficients(&[a0, a1, a2], &[b0, b1, b2], &[c0, c1, c2], &m.p, &m.v)
}

/// Algorithm 7: whether all four points share a plane at all times.
pub(super) fn detect_case4<Z: Integer>(points: &[Motion<Z>; 4]) -> bool {
    triple_product_coefficients(points).iter().all(Z::is_zero)
}

//! Which case a motion belongs to (thesis 3.1.1, Algorithms 1 to 7).

use nalgebra::Vector3;

use super::given::{negligible, static_equality};
use super::motion::Motion;
use super::threshold::Thresholds;

/// Algorithm 1, `DetectCase1` (3.1.1.1): whether an edge is a point for the whole step.
///
/// Velocities are compared by the same threshold as points.
pub fn detect_case1([p0, p1, p2, p3]: &[Motion; 4], thresholds: &Thresholds) -> bool {
    same_for_whole_step(p0, p1, thresholds) || same_for_whole_step(p2, p3, thresholds)
}

/// Algorithm 2, `DetectCase2` (3.1.1.2): whether the edges start in one point for the whole step.
pub fn detect_case2(p0: &Motion, p2: &Motion, thresholds: &Thresholds) -> bool {
    same_for_whole_step(p0, p2, thresholds)
}

/// The condition that Algorithms 1 and 2 share: `P_i = P_j` and `V_i = V_j`.
pub(super) fn same_for_whole_step(a: &Motion, b: &Motion, thresholds: &Thresholds) -> bool {
    static_equality(&a.p, &b.p, thresholds.dist) && static_equality(&a.v, &b.v, thresholds.dist)
}

/// Algorithm 3, `ComputeQuadraticCoefficientsFromCross` (3.1.1.3, equation 3.3): component `h` of
/// `(P + R t) × (Q + S t)`, for `h` in 0 to 2.
///
/// The text numbers from the highest power: `c0` belongs to `t²`, and `Solve(c0, c1, c2)` takes
/// them in that order. Algorithms 6 and 19 do the same for `t³`, and so do the coefficients here.
pub fn compute_quadratic_coefficients_from_cross(k: &Motion, l: &Motion, h: usize) -> [f64; 3] {
    let (p, r) = (&k.p, &k.v);
    let (q, s) = (&l.p, &l.v);
    let i = (h + 1) % 3;
    let j = (h + 2) % 3;
    let c0 = r[i] * s[j] - r[j] * s[i];
    let c1 = p[i] * s[j] - p[j] * s[i] + r[i] * q[j] - r[j] * q[i];
    let c2 = p[i] * q[j] - p[j] * q[i];
    [c0, c1, c2]
}

/// Algorithm 4, `AreVectorsPermanentlyParallel` (3.1.1.3, equation 3.4): whether `P + R t` and
/// `Q + S t` are parallel for the whole step; zero is parallel to everything.
pub fn are_vectors_permanently_parallel(k: &Motion, l: &Motion, thresholds: &Thresholds) -> bool {
    (0..3).all(|h| {
        compute_quadratic_coefficients_from_cross(k, l, h)
            .iter()
            .all(|&c| negligible(c, thresholds.coefficients_quadratic))
    })
}

/// Algorithm 5, `DetectCase3` (3.1.1.3): whether the edges are parallel for the whole step.
pub fn detect_case3([p0, p1, p2, p3]: &[Motion; 4], thresholds: &Thresholds) -> bool {
    are_vectors_permanently_parallel(&(*p1 - *p0), &(*p3 - *p2), thresholds)
}

/// Algorithm 6, `ComputeCubicCoefficients` (3.1.1.4, equation 3.9): the coefficients of
/// `(α t² + β t + γ) · (δ + ν t)`, that of `t³` first.
pub fn compute_cubic_coefficients(
    alpha: &Vector3<f64>,
    beta: &Vector3<f64>,
    gamma: &Vector3<f64>,
    delta: &Vector3<f64>,
    nu: &Vector3<f64>,
) -> [f64; 4] {
    let c0 = alpha.dot(nu);
    let c1 = alpha.dot(delta) + beta.dot(nu);
    let c2 = beta.dot(delta) + gamma.dot(nu);
    let c3 = delta.dot(gamma);
    [c0, c1, c2, c3]
}

/// Algorithm 7, `DetectCase4` (3.1.1.4): whether the four points share a plane for the whole step.
pub fn detect_case4(points: &[Motion; 4], thresholds: &Thresholds) -> bool {
    triple_product_coefficients(points)
        .iter()
        .all(|&c| negligible(c, thresholds.coefficients_cubic))
}

/// The lines that Algorithms 7 and 19 share: the coefficients of `((B - A) × (D - C)) · (C - A)`.
///
/// Both call `ComputeQuadraticCoefficients`, which is Algorithm 3.
pub(super) fn triple_product_coefficients([p0, p1, p2, p3]: &[Motion; 4]) -> [f64; 4] {
    let (k, l) = (*p1 - *p0, *p3 - *p2);
    let [x, y, z] = [0, 1, 2].map(|h| compute_quadratic_coefficients_from_cross(&k, &l, h));
    let [alpha, beta, gamma] = [0, 1, 2].map(|n| Vector3::new(x[n], y[n], z[n]));
    let Motion { p: delta, v: nu } = *p2 - *p0;
    compute_cubic_coefficients(&alpha, &beta, &gamma, &delta, &nu)
}

#[cfg(test)]
mod tests {
    use super::super::motion::testing::{moving, still};
    use super::*;

    fn usual() -> Thresholds {
        Thresholds::default()
    }

    #[test]
    fn detect_case1_needs_equal_points_and_equal_velocities() {
        let edge = [still([0.0; 3]), still([1.0, 0.0, 0.0])];
        let point = moving([0.0, 1.0, 0.0], [0.0, 2.0, 0.0]);
        let diverging = moving([0.0, 1.0, 0.0], [0.0, 3.0, 0.0]);
        assert!(detect_case1(&[edge[0], edge[1], point, point], &usual()));
        assert!(detect_case1(&[point, point, edge[0], edge[1]], &usual()));
        assert!(!detect_case1(
            &[edge[0], edge[1], point, diverging],
            &usual()
        ));
        assert!(!detect_case1(
            &[edge[0], edge[1], edge[0], edge[1]],
            &usual()
        ));
    }

    #[test]
    fn detect_case1_and_case2_compare_with_the_distance_threshold() {
        let a = still([0.0; 3]);
        let near = still([1e-6, 0.0, 0.0]);
        let far = still([1.1e-6, 0.0, 0.0]);
        let drifting = moving([0.0; 3], [1.1e-6, 0.0, 0.0]);
        let edge = [still([1.0, 0.0, 0.0]), still([2.0, 0.0, 0.0])];
        assert!(detect_case1(&[a, near, edge[0], edge[1]], &usual()));
        assert!(!detect_case1(&[a, far, edge[0], edge[1]], &usual()));
        assert!(detect_case2(&a, &near, &usual()));
        assert!(!detect_case2(&a, &far, &usual()));
        assert!(!detect_case2(&a, &drifting, &usual()));
        assert!(!detect_case2(&a, &near, &Thresholds::ZERO));
    }

    #[test]
    fn quadratic_coefficients_are_those_of_the_cross_product_highest_power_first() {
        let k = moving([1.0, 2.0, 3.0], [4.0, 5.0, 6.0]);
        let l = moving([7.0, 8.0, 10.0], [-1.0, 2.0, 0.5]);
        for h in 0..3 {
            let [c0, c1, c2] = compute_quadratic_coefficients_from_cross(&k, &l, h);
            for t in [0.0, 0.5, 1.0, 2.0] {
                let cross = k.at(t).cross(&l.at(t))[h];
                assert_eq!(c0 * t * t + c1 * t + c2, cross, "component {h} at {t}");
            }
        }
        assert_eq!(
            compute_quadratic_coefficients_from_cross(&k, &l, 0),
            [-9.5, -3.0, -4.0]
        );
    }

    #[test]
    fn permanently_parallel_vectors_may_turn_together() {
        let k = moving([1.0, 0.0, 0.0], [-1.0, 1.0, 0.0]);
        let l = moving([-2.0, 0.0, 0.0], [2.0, -2.0, 0.0]);
        assert!(are_vectors_permanently_parallel(&k, &l, &Thresholds::ZERO));
        let crossing = moving([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        assert!(!are_vectors_permanently_parallel(&k, &crossing, &usual()));
    }

    #[test]
    fn permanently_parallel_takes_a_coefficient_at_the_threshold_for_zero() {
        let thresholds = usual();
        let k = still([1.0, 0.0, 0.0]);
        let at = still([1.0, thresholds.coefficients_quadratic, 0.0]);
        let above = still([1.0, thresholds.coefficients_quadratic.next_up(), 0.0]);
        assert!(are_vectors_permanently_parallel(&k, &at, &thresholds));
        assert!(!are_vectors_permanently_parallel(&k, &above, &thresholds));
    }

    #[test]
    fn permanently_parallel_is_false_where_coefficients_overflow() {
        let k = moving([f64::MAX, 1.0, 0.0], [f64::MAX, 2.0, 0.0]);
        assert!(!are_vectors_permanently_parallel(&k, &k, &usual()));
    }

    #[test]
    fn detect_case3_compares_the_directions_not_the_places() {
        let ab = [
            moving([0.0; 3], [1.0, 0.0, 0.0]),
            moving([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
        ];
        let cd = [still([0.0, 5.0, 1.0]), still([3.0, 5.0, 1.0])];
        let turning = moving([3.0, 5.0, 1.0], [0.0, 0.0, 1.0]);
        assert!(detect_case3(
            &[ab[0], ab[1], cd[0], cd[1]],
            &Thresholds::ZERO
        ));
        assert!(!detect_case3(&[ab[0], ab[1], cd[0], turning], &usual()));
    }

    #[test]
    fn cubic_coefficients_are_those_of_the_dot_product_highest_power_first() {
        let v = Vector3::new;
        let c = compute_cubic_coefficients(
            &v(1.0, 2.0, 3.0),
            &v(0.0, 1.0, 0.0),
            &v(2.0, 0.0, 1.0),
            &v(1.0, 1.0, 1.0),
            &v(0.0, 5.0, -1.0),
        );
        assert_eq!(c, [7.0, 11.0, 0.0, 3.0]);
    }

    #[test]
    fn detect_case4_sees_a_plane_that_turns() {
        let a = moving([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        let b = moving([2.0, 1.0, 0.0], [0.0, 0.0, 2.0]);
        let c = moving([-1.0, 3.0, 0.0], [0.0, 0.0, -1.0]);
        let d = moving([0.0, 4.0, 0.0], [0.0, 0.0, 0.0]);
        assert!(detect_case4(&[a, b, c, d], &Thresholds::ZERO));
        let off = moving([0.0, 4.0, 0.0], [0.0, 0.0, 1.0]);
        assert!(!detect_case4(&[a, b, c, off], &usual()));
    }
}

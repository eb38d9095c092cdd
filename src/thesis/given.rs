//! Functions that Algorithms 1 to 20 call without stating them (`Solve` is in
//! [`solve`](super::solve)).

use nalgebra::{Matrix2, Vector2, Vector3};

/// Whether `value` counts as zero: its magnitude is not above `threshold`. A NaN does not.
pub fn negligible(value: f64, threshold: f64) -> bool {
    value.abs() <= threshold
}

/// `StaticEquality(a, b, threshold)`: whether two points or vectors are no farther apart than
/// `threshold`.
///
/// The thesis asks for "approximative equality of 3-dimensional points or vectors" (3.1.1.1) and
/// calls its threshold a distance (3.1.1.3), apart from the one "in one dimension"; so the distance
/// is the Euclidean one, and a threshold of 0 asks for equality.
pub fn static_equality(a: &Vector3<f64>, b: &Vector3<f64>, threshold: f64) -> bool {
    let difference = a - b;
    difference.iter().all(|&x| negligible(x, threshold)) && length(&difference) <= threshold
}

/// The Euclidean length, without overflow or underflow of the squares; NaN if a coordinate is
/// infinite or NaN.
pub fn length(vector: &Vector3<f64>) -> f64 {
    let largest = vector
        .iter()
        .fold(0.0, |largest: f64, x| largest.max(x.abs()));
    if largest == 0.0 {
        // A sum keeps a NaN, which `max` ignores.
        return vector.sum();
    }
    largest * (vector / largest).norm()
}

/// `LineSegmentsCoLinear(P, Q, R, S)`: whether two segments that are known to be parallel lie on
/// one line, which goes through `p` in direction `r`; `q` is a point of the other segment.
///
/// 3.1.3.1 asks "if one point of one segment is on the line of the other segment": the distance
/// `|(q - p) × r| / |r|` is compared with `threshold`, in metres. `r` is not zero.
pub fn line_segments_colinear(
    p: &Vector3<f64>,
    q: &Vector3<f64>,
    r: &Vector3<f64>,
    threshold: f64,
) -> bool {
    length(&(q - p).cross(r)) <= threshold * length(r)
}

/// `GaussianEliminationWithPivoting(M, L)`: the solution of `m x = l`; `None` where a pivot is 0
/// or NaN.
pub fn gaussian_elimination_with_pivoting(
    mut m: Matrix2<f64>,
    mut l: Vector2<f64>,
) -> Option<Vector2<f64>> {
    if m[(1, 0)].abs() > m[(0, 0)].abs() {
        m.swap_rows(0, 1);
        l.swap_rows(0, 1);
    }
    let factor = m[(1, 0)] / m[(0, 0)];
    let pivot = m[(1, 1)] - factor * m[(0, 1)];
    if pivot == 0.0 || pivot.is_nan() {
        return None;
    }
    let x1 = (l[1] - factor * l[0]) / pivot;
    let x0 = (l[0] - m[(0, 1)] * x1) / m[(0, 0)];
    Some(Vector2::new(x0, x1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn static_equality_is_by_euclidean_distance() {
        let zero = Vector3::zeros();
        assert!(static_equality(&Vector3::new(3.0, 4.0, 0.0), &zero, 5.0));
        assert!(!static_equality(&Vector3::new(3.0, 4.0, 0.5), &zero, 5.0));
        assert!(!static_equality(&Vector3::new(1.0, 1.0, 1.0), &zero, 1.5));
    }

    #[test]
    fn static_equality_with_threshold_zero_is_equality() {
        let zero = Vector3::zeros();
        assert!(static_equality(
            &Vector3::new(1.0, -2.0, 3.0),
            &Vector3::new(1.0, -2.0, 3.0),
            0.0
        ));
        assert!(!static_equality(
            &Vector3::new(1e-200, 0.0, 0.0),
            &zero,
            0.0
        ));
        assert!(!static_equality(
            &Vector3::new(5e-324, 0.0, 0.0),
            &zero,
            0.0
        ));
    }

    #[test]
    fn static_equality_is_false_where_differences_overflow() {
        let huge = Vector3::new(f64::MAX, 0.0, 0.0);
        assert!(!static_equality(&huge, &-huge, f64::MAX));
        let infinite = Vector3::new(f64::INFINITY, 0.0, 0.0);
        assert!(!static_equality(&infinite, &infinite, 1.0));
    }

    #[test]
    fn length_neither_overflows_nor_underflows() {
        assert_eq!(length(&Vector3::new(3e300, 4e300, 0.0)), 5e300);
        assert_eq!(length(&Vector3::new(0.0, 3e-300, -4e-300)), 5e-300);
        assert_eq!(length(&Vector3::zeros()), 0.0);
        assert!(length(&Vector3::new(f64::NAN, 0.0, 0.0)).is_nan());
        assert!(length(&Vector3::new(f64::INFINITY, 0.0, 0.0)).is_nan());
    }

    #[test]
    fn line_segments_colinear_compares_the_distance_to_the_line() {
        let p = Vector3::new(1.0, 0.0, 0.0);
        let r = Vector3::new(100.0, 0.0, 0.0);
        assert!(line_segments_colinear(
            &p,
            &Vector3::new(-7.0, 0.0, 0.25),
            &r,
            0.25
        ));
        assert!(!line_segments_colinear(
            &p,
            &Vector3::new(-7.0, 0.0, 0.25),
            &r,
            0.125
        ));
        assert!(line_segments_colinear(
            &p,
            &Vector3::new(-7.0, 0.0, 0.0),
            &r,
            0.0
        ));
    }

    #[test]
    fn gaussian_elimination_swaps_rows_for_the_larger_pivot() {
        let m = Matrix2::new(0.0, 2.0, 4.0, 1.0);
        let x = gaussian_elimination_with_pivoting(m, Vector2::new(6.0, 7.0));
        assert_eq!(x, Some(Vector2::new(1.0, 3.0)));
    }

    #[test]
    fn gaussian_elimination_has_no_solution_where_singular() {
        for m in [
            Matrix2::new(1.0, -2.0, -2.0, 4.0),
            Matrix2::zeros(),
            Matrix2::new(f64::NAN, 1.0, 1.0, 1.0),
        ] {
            assert_eq!(
                gaussian_elimination_with_pivoting(m, Vector2::new(1.0, 1.0)),
                None
            );
        }
    }
}

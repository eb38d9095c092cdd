//! GMRES (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 1986): solves `A x = b` with products of
//! `A` alone.

/// The most products; what is found then is taken.
pub(super) const PRODUCTS: usize = 60;

/// The residual at which it ends, as a fraction of the right side.
const TOLERANCE: f64 = 1e-13;

/// A product with `A` for each new direction, until the residual is rounding. None if `A` is
/// singular on the directions that it gives.
pub(super) fn gmres(mut product: impl FnMut(&[f64]) -> Vec<f64>, b: &[f64]) -> Option<Vec<f64>> {
    let size = norm(b);
    if size == 0.0 {
        return Some(vec![0.0; b.len()]);
    }
    // Orthonormal directions; the projection of `A` on them, a triangle after the rotations; and
    // the right side so rotated. Its last component is the residual.
    let mut basis = vec![scaled(b, 1.0 / size)];
    let mut triangle: Vec<Vec<f64>> = Vec::new();
    let mut rotations: Vec<[f64; 2]> = Vec::new();
    let mut right = vec![size];
    for k in 0..b.len().min(PRODUCTS) {
        let mut next = product(&basis[k]);
        let mut column = Vec::with_capacity(k + 2);
        for direction in &basis {
            let along = dot(&next, direction);
            subtract(&mut next, direction, along);
            column.push(along);
        }
        let rest = norm(&next);
        for (i, &[cos, sin]) in rotations.iter().enumerate() {
            let [above, below] = [column[i], column[i + 1]];
            column[i] = cos * above + sin * below;
            column[i + 1] = cos * below - sin * above;
        }
        let length = (column[k] * column[k] + rest * rest).sqrt();
        if length.is_nan() || length <= 0.0 {
            return None;
        }
        let [cos, sin] = [column[k] / length, rest / length];
        column[k] = length;
        let residual = right[k];
        right[k] = cos * residual;
        right.push(-sin * residual);
        rotations.push([cos, sin]);
        triangle.push(column);
        if (sin * residual).abs() <= TOLERANCE * size {
            break;
        }
        basis.push(scaled(&next, 1.0 / rest));
    }
    // What is left is a triangle.
    let n = triangle.len();
    let mut weights = right;
    for k in (0..n).rev() {
        for j in k + 1..n {
            weights[k] -= triangle[j][k] * weights[j];
        }
        weights[k] /= triangle[k][k];
    }
    let mut x = vec![0.0; b.len()];
    for (weight, direction) in weights[..n].iter().zip(&basis) {
        subtract(&mut x, direction, -weight);
    }
    x.iter().all(|value| value.is_finite()).then_some(x)
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn scaled(a: &[f64], factor: f64) -> Vec<f64> {
    a.iter().map(|a| a * factor).collect()
}

/// `a -= factor b`.
fn subtract(a: &mut [f64], b: &[f64], factor: f64) {
    for (a, b) in a.iter_mut().zip(b) {
        *a -= factor * b;
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    fn times(matrix: &[Vec<f64>], x: &[f64]) -> Vec<f64> {
        matrix.iter().map(|row| dot(row, x)).collect()
    }

    #[test]
    fn solution_is_what_the_right_side_was_made_of() {
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        for n in [1, 2, 5, 40] {
            let mut random = |scale: f64| scale * rng.random_range(-1.0..1.0);
            let mut matrix: Vec<Vec<f64>> = (0..n)
                .map(|_| (0..n).map(|_| random(0.5 / n as f64)).collect())
                .collect();
            for (i, row) in matrix.iter_mut().enumerate() {
                row[i] += 1.0;
            }
            let expected: Vec<f64> = (0..n).map(|_| random(10.0)).collect();
            let b = times(&matrix, &expected);
            let found = gmres(|x| times(&matrix, x), &b).unwrap();
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found - expected).abs() < 1e-11, "{n}: {found} {expected}");
            }
        }
    }

    #[test]
    fn what_is_singular_has_no_solution() {
        let matrix = vec![vec![0.0, 1.0], vec![0.0, 0.0]];
        assert_eq!(gmres(|x| times(&matrix, x), &[1.0, 0.0]), None);
        assert_eq!(gmres(|_| vec![f64::NAN; 2], &[1.0, 0.0]), None);
        assert_eq!(
            gmres(|x| times(&matrix, x), &[0.0, 0.0]),
            Some(vec![0.0; 2])
        );
    }
}

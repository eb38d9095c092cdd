use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use super::*;
use crate::wire::sparse::Triplets;

/// A quasi-definite matrix in a random order of its rows: entries, and which pivots are positive.
#[derive(Clone, Debug)]
struct System {
    n: usize,
    entries: Vec<(usize, usize, f64)>,
    positive: Vec<bool>,
}

fn system() -> impl Strategy<Value = System> {
    let size = 1_usize..40;
    size.prop_flat_map(|n| {
        let entry = (0..n, 0..n, -1.0..1.0_f64);
        let scale = -6.0..6.0_f64;
        (
            Just(n),
            prop::collection::vec(entry, 0..4 * n),
            prop::collection::vec(scale, n),
            prop::collection::vec(any::<bool>(), n),
        )
    })
    .prop_map(|(n, mut entries, scales, positive)| {
        // Off the diagonal, entries couple rows of different kinds only, as constraints do; within
        // a kind the diagonal dominates.
        entries.retain(|(i, j, _)| i != j);
        let mut diagonal: Vec<f64> = scales.iter().map(|&scale| 10_f64.powf(scale)).collect();
        for &(i, j, value) in &entries {
            if positive[i] == positive[j] {
                diagonal[i] += value.abs();
                diagonal[j] += value.abs();
            }
        }
        for i in 0..n {
            let sign = if positive[i] { 1.0 } else { -1.0 };
            entries.push((i, i, sign * diagonal[i]));
        }
        System {
            n,
            entries,
            positive,
        }
    })
}

impl System {
    fn sparse(&self) -> Symmetric {
        let mut triplets = Triplets::default();
        for &(i, j, value) in &self.entries {
            triplets.add(i, j, value);
        }
        let mut matrix = Symmetric::new(self.n, &triplets.index);
        matrix.fill(&triplets.value);
        matrix
    }

    fn dense(&self) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.n, self.n);
        for &(i, j, value) in &self.entries {
            matrix[(i, j)] += value;
            if i != j {
                matrix[(j, i)] += value;
            }
        }
        matrix
    }
}

fn factored(system: &System) -> (Symmetric, Ldl) {
    let matrix = system.sparse();
    let mut ldl = Ldl::analyse(&matrix);
    ldl.factor(&matrix, &system.positive).unwrap();
    (matrix, ldl)
}

/// `|L| |D| |L^T| |x|`.
fn grown(ldl: &Ldl, x: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; x.len()];
    for k in 0..x.len() {
        let column = ldl.column(k).map(|(row, l)| l.abs() * x[row].abs());
        let weight = (x[k].abs() + column.sum::<f64>()) * ldl.pivots()[k].abs();
        sums[k] += weight;
        for (row, l) in ldl.column(k) {
            sums[row] += l.abs() * weight;
        }
    }
    sums
}

proptest! {
    #[test]
    fn ldl_solves_as_a_dense_library_does(system in system(), seed in any::<u64>()) {
        let (matrix, ldl) = factored(&system);
        let b: Vec<f64> = (0..system.n).map(|i| ((seed >> (i % 60)) % 97) as f64 - 48.0).collect();
        let mut x = b.clone();
        ldl.solve(&mut x);
        let dense = system.dense().full_piv_lu().solve(&DVector::from_vec(b.clone())).unwrap();
        let scale = dense.amax().max(1e-300);
        let difference = x.iter().zip(dense.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        prop_assert!(difference <= 1e-6 * scale, "{difference} of {scale}");
        // Higham, Accuracy and Stability of Numerical Algorithms, theorem 10.4 for L D L^T: the
        // residual is at most a small multiple of n units of rounding of |L| |D| |L^T| |x|.
        let sums = matrix.residual_and_magnitude(&b, &x);
        let grown = grown(&ldl, &x);
        let units = 8.0 * system.n as f64 * f64::EPSILON;
        for ([r, m], g) in sums.iter().zip(&grown) {
            prop_assert!(r.abs() <= units * (m + g), "{r:e} of {m:e} and {g:e}");
        }
    }

    #[test]
    fn sparse_columns_are_those_of_a_dense_forward_solve(
        system in system(),
        at in any::<[u8; 3]>(),
    ) {
        let (_, ldl) = factored(&system);
        let columns: Vec<(usize, [f64; 3])> = at
            .iter()
            .map(|&i| (usize::from(i) % system.n, [1.0, f64::from(i), -0.5]))
            .collect();
        let sparse = ldl.forward(&columns);
        for c in 0..3 {
            // L^-T D^-1 Y is A^-1 C.
            let mut b = vec![0.0; system.n];
            let mut z = vec![0.0; system.n];
            for &(row, three) in &columns {
                b[row] += three[c];
            }
            for (row, three) in sparse.rows.iter().zip(&sparse.values) {
                z[*row as usize] = three[c];
            }
            ldl.solve(&mut b);
            ldl.finish(&mut z);
            let scale = b.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            for (a, b) in z.iter().zip(&b) {
                prop_assert!((a - b).abs() <= 1e-12 * scale);
            }
        }
    }
}

#[test]
fn ldl_names_the_pivot_that_is_not_quasi_definite() {
    let positive = vec![true, true, false];
    let system = |value| System {
        n: 3,
        entries: vec![
            (0, 0, 2.0),
            (0, 1, 2.0),
            (1, 1, value),
            (1, 2, 1.0),
            (2, 2, -1.0),
        ],
        positive: positive.clone(),
    };
    let try_factor = |value| {
        let matrix = system(value).sparse();
        Ldl::analyse(&matrix).factor(&matrix, &positive)
    };
    assert_eq!(try_factor(3.0), Ok(()));
    // No more than rounding is wrong.
    assert_eq!(try_factor(2.0), Ok(()));
    assert_eq!(try_factor(2.0 - 1e-13), Ok(()));
    assert_eq!(try_factor(2.0 - 1e-11), Err(1));
    assert_eq!(try_factor(1.0), Err(1));
    assert_eq!(try_factor(f64::NAN), Err(1));
}

/// Two masses of 1 and a stiff spring between them, so stiff that the sum loses the masses.
#[test]
fn ldl_solves_where_a_pivot_is_lost_in_rounding() {
    for stiffness in [1e15, 1e17, 1e20] {
        let entries = [
            (0, 0, 1.0),
            (0, 1, 0.0),
            (1, 1, 1.0),
            (0, 2, 1.0),
            (1, 2, -1.0),
        ];
        let mut system = System {
            n: 3,
            entries: entries.to_vec(),
            positive: vec![true, true, false],
        };
        // As a sum in both rows, in place of a multiplier.
        for (row, column, sign) in [(0, 0, 1.0), (0, 1, -1.0), (1, 1, 1.0)] {
            system.entries.push((row, column, sign * stiffness));
        }
        system.entries.push((2, 2, -1.0));
        let (matrix, ldl) = factored(&system);
        let right = vec![1.0, 3.0, 0.5];
        let mut x = right.clone();
        ldl.solve(&mut x);
        for _ in 0..2 {
            let mut correction = matrix.residual(&right, &x);
            ldl.solve(&mut correction);
            x.iter_mut().zip(&correction).for_each(|(x, by)| *x += by);
        }
        let sums = matrix.residual_and_magnitude(&right, &x);
        for [residual, magnitude] in &sums {
            assert!(
                residual.abs() <= 1e-12 * magnitude,
                "{stiffness} {residual} {magnitude}"
            );
        }
    }
}

#[test]
fn ldl_takes_new_values_in_the_same_structure() {
    let mut system = System {
        n: 2,
        entries: vec![(0, 0, 4.0), (0, 1, 1.0), (1, 1, -2.0)],
        positive: vec![true, false],
    };
    let (mut matrix, mut ldl) = factored(&system);
    system.entries[0].2 = 1.0;
    let values: Vec<f64> = system.entries.iter().map(|entry| entry.2).collect();
    matrix.fill(&values);
    ldl.factor(&matrix, &system.positive).unwrap();
    let mut x = vec![3.0, -1.0];
    ldl.solve(&mut x);
    assert!((x[0] - 5.0 / 3.0).abs() < 1e-15 && (x[1] - 4.0 / 3.0).abs() < 1e-15);
}

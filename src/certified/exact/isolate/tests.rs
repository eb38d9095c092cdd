use proptest::prelude::*;

use super::*;

/// The roots of a polynomial.
pub(in super::super) fn isolated(poly: Poly) -> Isolated {
    let mut roots = Isolated::none();
    roots.find(poly);
    roots
}

/// `d t - n` for each of the roots `n / d`, multiplied, as `i64` coefficients.
fn with_roots(roots: &[(i64, i64)], factor: i64) -> Vec<i64> {
    let mut product = vec![factor];
    for &(n, d) in roots {
        let mut next = vec![0; product.len() + 1];
        for (i, c) in product.iter().enumerate() {
            next[i] -= n * c;
            next[i + 1] += d * c;
        }
        product = next;
    }
    product
}

pub(in super::super) fn poly(coefficients: &[i64]) -> Poly {
    let coefficients: Vec<Integer> = coefficients.iter().map(|&c| i128::from(c).into()).collect();
    Poly::new(&coefficients)
}

fn dyadic_exceeds(at: &Dyadic, (n, d): (i64, i64)) -> Ordering {
    // at - n / d
    let own = at.numerator.times(d);
    own.cmp(&Integer::from(i128::from(n)).shifted(at.exponent))
}

/// Whether a cell holds the root `n / d`.
fn holds(cell: &Cell, root: (i64, i64)) -> bool {
    match &cell.place {
        Place::At(at) => dyadic_exceeds(at, root).is_eq(),
        Place::Between { low, high, .. } => {
            dyadic_exceeds(low, root).is_lt() && dyadic_exceeds(high, root).is_gt()
        }
    }
}

/// Fractions in and around `[0, 1]`, some of them very near each other.
fn root() -> impl Strategy<Value = (i64, i64)> {
    prop_oneof![
        (-2i64..=8, 1i64..=6),
        prop::sample::select(vec![(0, 1), (1, 1), (1, 2), (1, 3)]),
        (100_000i64..=100_003, Just(200_003i64)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn isolated_roots_are_those_of_the_factors(
        roots in prop::collection::vec(root(), 1..=3),
        factor in prop_oneof![-3i64..=-1, 1i64..=3],
    ) {
        let isolated = isolated(poly(&with_roots(&roots, factor)));
        let mut expected: Vec<(i64, i64, bool)> = Vec::new();
        for &(n, d) in &roots {
            match expected.iter_mut().find(|(m, e, _)| m * d == n * *e) {
                Some((_, _, is_odd)) => *is_odd = !*is_odd,
                None => expected.push((n, d, true)),
            }
        }
        expected.retain(|&(n, d, _)| (0..=d).contains(&n));
        expected.sort_by(|a, b| (a.0 * b.1).cmp(&(b.0 * a.1)));
        prop_assert_eq!(isolated.cells().len(), expected.len());
        for (i, (cell, &(n, d, is_odd))) in isolated.cells().iter().zip(&expected).enumerate() {
            prop_assert!(holds(cell, (n, d)), "{cell:?} does not hold {n} / {d}");
            // The interval of a linear factor may hold roots of another one.
            let is_factor = matches!(&cell.place, Place::Between { poly: 1.., .. });
            let mut others = expected.iter().enumerate().filter(|(j, _)| *j != i);
            prop_assert!(is_factor || !others.any(|(_, &(m, e, _))| holds(cell, (m, e))));
            if n > 0 && n < d {
                prop_assert_eq!(cell.before != cell.after, is_odd);
            }
            // The sign just before is that of the factors.
            let before = roots.iter().fold(factor.signum(), |sign, &(m, e)| {
                if n * e > m * d { sign } else { -sign }
            });
            prop_assert!(n == 0 || cell.before == before.cmp(&0));
        }
    }

    #[test]
    fn isolated_roots_leave_out_complex_ones(
        (n, d) in root(), b in -8i64..=8, c in 1i64..=8, up in 1i64..=40,
    ) {
        // (d t - n) (a t^2 + b t + c) with b^2 < 4ac
        let a = b * b / (4 * c) + up;
        prop_assume!(a * c * 4 > b * b && a > 0);
        let cubic = [-n * c, d * c - n * b, d * b - n * a, d * a];
        let isolated = isolated(poly(&cubic));
        let is_inside = (0..=d).contains(&n);
        prop_assert_eq!(isolated.cells().len(), usize::from(is_inside));
        prop_assert!(isolated.cells().iter().all(|cell| holds(cell, (n, d))));
    }
}

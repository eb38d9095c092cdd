use proptest::prelude::*;

use super::super::remainders::Remainders;
use super::*;

/// A polynomial without coefficients in place.
pub(in super::super) fn poly(coefficients: &[i64]) -> Poly<0> {
    let coefficients: Vec<_> = coefficients
        .iter()
        .map(|&c| Integer::from(i128::from(c)))
        .collect();
    Poly::new(&coefficients)
}

proptest! {
    #[test]
    fn coprime_polynomials_are_those_without_a_common_factor(
        a in prop::collection::vec(-5i64..=5, 1..=4),
        b in prop::collection::vec(-5i64..=5, 1..=4),
        c in prop::collection::vec(-5i64..=5, 1..=3),
    ) {
        let [a, b, c] = [&a, &b, &c].map(|p| poly(p));
        prop_assume!([&a, &b, &c].iter().all(|p| !p.is_zero()));
        let (p, q) = (Poly::product(&a, &c), Poly::product(&b, &c));
        let (p, q) = if p.degree() < q.degree() { (q, p) } else { (p, q) };
        let common = Remainders::new(p.clone(), q.clone()).last();
        // Small coefficients: the resultant is far below the prime, so that it tells.
        prop_assert_eq!(are_coprime(&p, &q), common.is_some_and(|common| common.degree() == 0));
    }
}

#[test]
fn coprime_is_not_said_where_the_prime_divides_a_leading_coefficient() {
    let prime = i64::try_from(Modulus::MERSENNE.get()).expect("61 bits");
    // (t - 1) (prime t + 1) and (t - 1): modulo the prime the first has a root less.
    assert!(!are_coprime(
        &poly(&[-1, 1 - prime, prime]),
        &poly(&[-1, 1])
    ));
    assert!(!are_coprime(&poly(&[2, prime]), &poly(&[-1, 1])));
}

/// All vectors of this length with components from -2 to 2, but those with a 0 at the end.
fn all(length: u32) -> impl Iterator<Item = Vec<i64>> {
    let vector = move |code: i64| {
        (0..length)
            .map(move |i| code / 5i64.pow(i) % 5 - 2)
            .collect()
    };
    (0..5i64.pow(length))
        .map(vector)
        .filter(|vector: &Vec<i64>| vector.last() != Some(&0))
}

/// The determinant of Sylvester's matrix, by minors.
fn resultant(p: &[i64], q: &[i64]) -> i64 {
    fn determinant(rows: &[Vec<i64>]) -> i64 {
        let Some((first, rest)) = rows.split_first() else {
            return 1;
        };
        let minor = |at: usize| {
            let without = |row: &Vec<i64>| [&row[..at], &row[at + 1..]].concat();
            determinant(&rest.iter().map(without).collect::<Vec<_>>())
        };
        let terms = first.iter().enumerate().filter(|(_, entry)| **entry != 0);
        terms
            .map(|(at, entry)| [1, -1][at % 2] * entry * minor(at))
            .sum()
    }
    let (m, n) = (p.len() - 1, q.len() - 1);
    let shifted = |own: &[i64], at: usize| {
        let mut row = vec![0; m + n];
        row[at..at + own.len()].copy_from_slice(own);
        row
    };
    let rows = (0..n)
        .map(|at| shifted(p, at))
        .chain((0..m).map(|at| shifted(q, at)));
    determinant(&rows.collect::<Vec<_>>())
}

/// Exhaustive, with primes so small that they often do not tell: coprime is said of just those
/// whose leading coefficients and whose resultant the prime does not divide. A common factor makes
/// the resultant 0, so it is never said where there is one.
#[test]
fn coprime_by_a_small_prime_is_said_where_it_does_not_divide_the_resultant() {
    fn check(prime: u64, p: &[i64], q: &[i64]) -> bool {
        let tells = |c: i64| !c.unsigned_abs().is_multiple_of(prime);
        let leading = [p, q].map(|p| p.last().is_some_and(|&c| tells(c)));
        let expected = leading == [true; 2] && tells(resultant(p, q));
        assert_eq!(
            are_coprime_modulo(Modulus::new(prime), &poly(p), &poly(q)),
            expected,
            "{prime} {p:?} {q:?}"
        );
        expected
    }
    let (mut said, mut not_said) = (0, 0);
    for [m, n] in [[2, 1], [2, 2], [3, 2], [3, 3], [4, 2]] {
        for p in all(m) {
            for q in all(n) {
                for coprime in [2, 3, 7].map(|prime| check(prime, &p, &q)) {
                    *(if coprime { &mut said } else { &mut not_said }) += 1;
                }
            }
        }
    }
    assert!(said > 20_000 && not_said > 20_000, "{said} {not_said}");
}

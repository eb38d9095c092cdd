use proptest::prelude::*;

use super::super::remainders::Remainders;
use super::*;

fn poly(coefficients: &[i64]) -> Poly<0> {
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
    let prime = i64::try_from(PRIME).expect("61 bits");
    // (t - 1) (prime t + 1) and (t - 1): modulo the prime the first has a root less.
    assert!(!are_coprime(
        &poly(&[-1, 1 - prime, prime]),
        &poly(&[-1, 1])
    ));
    assert!(!are_coprime(&poly(&[2, prime]), &poly(&[-1, 1])));
}

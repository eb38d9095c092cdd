use num_bigint::BigInt;
use proptest::prelude::*;

use super::super::modular::tests::poly;
use super::*;

fn times(a: &[i64], b: &[i64]) -> Vec<i64> {
    let mut product = vec![0; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            product[i + j] += x * y;
        }
    }
    product
}

/// A rational value of which only the sign matters: the polynomial at `n / d`, times `d^6 > 0`.
fn value(p: &Poly<0>, n: i64, d: i64) -> BigInt {
    let big = |integer: &Integer| {
        let limbs = (0..64).map(|i| BigInt::from(integer.window(64 * i).0) << (64 * i));
        let magnitude: BigInt = limbs.sum();
        if integer.sign().is_lt() {
            -magnitude
        } else {
            magnitude
        }
    };
    let power = |x: i64, e: usize| BigInt::from(x).pow(e as u32);
    let terms = p.coefficients().iter().enumerate();
    terms
        .map(|(i, c)| big(c) * power(n, i) * power(d, 6 - i))
        .sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// At a root of a polynomial the neighbours in the sequence have opposite signs or are both 0:
    /// that is what the theorem of Sturm needs, and a wrong factor or division breaks it.
    #[test]
    fn remainders_have_opposite_signs_around_a_common_factor_and_roots(
        a in prop::collection::vec(-1000i64..=1000, 0..=4),
        b in prop::collection::vec(-1000i64..=1000, 0..=3),
        c in prop::collection::vec(-20i64..=20, 0..=2),
    ) {
        let with_degree = |mut p: Vec<i64>| {
            p.push(1);
            p
        };
        let [a, b, c] = [a, b, c].map(with_degree);
        let (a, b) = if a.len() < b.len() { (b, a) } else { (a, b) };
        let (p, q) = (poly(&times(&a, &c)), poly(&times(&b, &c)));
        let all: Vec<_> = [p.clone()].into_iter().chain(Remainders::new(p, q)).collect();
        // Each is a positive multiple of minus a remainder: at rational points by which the one
        // between is 0.
        for three in all.windows(3) {
            let [first, middle, last] = three else { unreachable!() };
            if let [c0, c1] = middle.coefficients() {
                let ((n, n_whole), (d, d_whole)) = (c0.window(0), c1.window(0));
                if c0.bits() < 60 && c1.bits() < 60 && n_whole && d_whole {
                    let n = if c0.sign() == c1.sign() { -(n as i64) } else { n as i64 };
                    let (before, after) = (value(first, n, d as i64), value(last, n, d as i64));
                    prop_assert_eq!(before.sign(), -after.sign());
                }
            }
        }
        // The last one is a multiple of the common factor, and divides both.
        let last = all.last().expect("q is not 0");
        prop_assert!(last.clone().remainder(&poly(&c)).is_zero());
        for of in [&all[0], &all[1]] {
            prop_assert!(of.clone().remainder(last).is_zero());
        }
    }
}

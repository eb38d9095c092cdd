use num_bigint::BigInt;
use proptest::prelude::*;

use super::super::isolate::tests::poly;
use super::*;

fn coefficients() -> impl Strategy<Value = Vec<i64>> {
    prop::collection::vec(
        prop_oneof![-3i64..=3, any::<i32>().prop_map(i64::from)],
        0..=4,
    )
}

/// `2^(exponent degree)` times the value.
fn expected(c: &[i64], degree: usize, numerator: i64, exponent: u64) -> BigInt {
    let term = |(i, &c): (usize, &i64)| {
        let power = BigInt::from(numerator).pow(i as u32);
        (c * power) << (exponent * (degree - i) as u64)
    };
    c.iter().take(degree + 1).enumerate().map(term).sum()
}

proptest! {
    #[test]
    fn poly_evaluate_is_the_scaled_value(
        c in coefficients(), (exponent, numerator) in (0u64..40).prop_flat_map(|e| (Just(e), 0..=1i64 << e)),
    ) {
        let p = poly(&c);
        let at = Dyadic::new(Integer::from(i128::from(numerator)), exponent);
        let decimal = |integer: &Integer| {
            let (low, _) = integer.window(0);
            let (middle, _) = integer.window(64);
            let (high, _) = integer.window(128);
            let magnitude: BigInt = (BigInt::from(high) << 128) + (BigInt::from(middle) << 64) + low;
            if integer.sign().is_lt() { -magnitude } else { magnitude }
        };
        prop_assert_eq!(decimal(&p.evaluate(&at)), expected(&c, p.degree(), numerator, exponent));
        prop_assert_eq!(decimal(&p.evaluate_as(3, &at)), expected(&c, 3, numerator, exponent));
    }

    #[test]
    fn poly_remainder_differs_by_a_multiple_and_is_smaller(a in coefficients(), b in coefficients()) {
        let (a, b) = (poly(&a), poly(&b));
        prop_assume!(!b.is_zero());
        let remainder = a.clone().remainder(&b);
        prop_assert!(remainder.is_zero() || remainder.degree() < b.degree());
        // At a root of b, where that is linear, the signs of both are the same.
        if let [c0, c1] = b.coefficients() {
            // a(-c0 / c1) c1^3, up to the sign of c1
            let mut value = Integer::default();
            for (i, c) in a.coefficients().iter().enumerate() {
                let mut term = c.clone();
                for j in 0..3 {
                    let mut factor = if j < i { c0.clone() } else { c1.clone() };
                    if j < i {
                        factor.negate();
                    }
                    term.mul_assign(&factor);
                }
                value.add_shifted(&term, 0);
            }
            let sign = if c1.sign().is_lt() { value.sign().reverse() } else { value.sign() };
            prop_assert_eq!(remainder.coefficient(0).sign(), sign);
        }
    }
}

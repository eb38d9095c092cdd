use num_bigint::BigInt;
use num_rational::BigRational;
use proptest::prelude::*;

use super::*;
use crate::field::OrderedField;

type P = Poly<BigInt>;

fn poly(coefficients: &[i64]) -> P {
    Poly::new(coefficients.iter().map(|&c| BigInt::from(c)).collect())
}

/// The value in rational arithmetic by powers: slow and plain.
fn value(p: &P, t: &BigRational) -> BigRational {
    let mut sum = BigRational::from_i64(0);
    let mut power = BigRational::from_i64(1);
    for c in p.coefficients() {
        sum += BigRational::from_integer(c.clone()) * &power;
        power *= t;
    }
    sum
}

fn any_poly(degree: usize) -> impl Strategy<Value = P> {
    prop::collection::vec(-40i64..40, 0..=degree + 1).prop_map(|c| poly(&c))
}

#[test]
fn poly_new_drops_leading_zeros() {
    assert_eq!(poly(&[1, 2, 0, 0]), poly(&[1, 2]));
    assert!(poly(&[0, 0]).is_zero());
    assert_eq!(poly(&[]).degree(), 0);
}

#[test]
fn poly_gcd_known_products() {
    let (a, b, c) = (poly(&[-1, 2]), poly(&[3, 0, 5]), poly(&[7, 1, 1]));
    assert_eq!(a.mul(&b).gcd(&a.mul(&c)), a);
    assert_eq!(
        a.mul(&b)
            .scale(&BigInt::from(-6))
            .gcd(&b.scale(&BigInt::from(4))),
        b
    );
    assert_eq!(b.gcd(&c), poly(&[1]));
    assert_eq!(b.gcd(&Poly::zero()), b);
    assert_eq!(Poly::zero().gcd(&b.neg()), b);
    assert!(P::zero().gcd(&Poly::zero()).is_zero());
    // Degrees that differ by more than one, the case in which h is a quotient.
    let high = poly(&[1, 0, 0, 0, 3, 0, 2]).mul(&a);
    assert_eq!(high.gcd(&a.mul(&poly(&[5, 1]))), a);
}

#[test]
fn poly_square_free_part_keeps_each_root_once() {
    let (a, b) = (poly(&[-1, 2]), poly(&[3, 0, 5]));
    let repeated = a.mul(&a).mul(&a).mul(&b).mul(&b).scale(&BigInt::from(-12));
    assert_eq!(repeated.square_free_part(), a.mul(&b));
}

proptest! {
    #[test]
    fn poly_arithmetic_agrees_with_values(
        a in any_poly(5), b in any_poly(5), n in -9i64..9, k in 0u64..5,
    ) {
        let t = BigRational::new(BigInt::from(n), BigInt::from(1) << k);
        prop_assert_eq!(value(&a.add(&b), &t), value(&a, &t) + value(&b, &t));
        prop_assert_eq!(value(&a.sub(&b), &t), value(&a, &t) - value(&b, &t));
        prop_assert_eq!(value(&a.mul(&b), &t), value(&a, &t) * value(&b, &t));
        let mut sum = a.clone();
        sum.sub_product(&a, &b);
        prop_assert_eq!(value(&sum, &t), value(&a, &t) - value(&a, &t) * value(&b, &t));
        prop_assert_eq!(value(&a.shift_by_one(), &t), value(&a, &(&t + BigRational::from_i64(1))));
        let scale = BigInt::from(1) << a.degree();
        let half = &t / BigRational::from_i64(2);
        prop_assert_eq!(
            value(&a.stretch_lower_half(), &t),
            value(&a, &half) * BigRational::from_integer(scale)
        );
        let sign = value(&a, &t).sign();
        prop_assert_eq!(Integer::sign(&a.evaluate_dyadic(&BigInt::from(n), k)), sign);
        let denominator: BigInt = BigInt::from(3) << k;
        let third = BigRational::new(BigInt::from(n), denominator.clone());
        let at_third = a.evaluate(&BigInt::from(n), &denominator);
        prop_assert_eq!(Integer::sign(&at_third), value(&a, &third).sign());
    }

    #[test]
    fn poly_scaled_bernstein_is_the_same_polynomial(a in any_poly(6), n in 0i64..=8) {
        // sum of scaled_i t^i (1 - t)^(n - i)
        let t = BigRational::new(BigInt::from(n), BigInt::from(8));
        let rest = BigRational::from_i64(1) - &t;
        let degree = a.degree();
        let sum = a.scaled_bernstein().into_iter().enumerate().fold(
            BigRational::from_i64(0),
            |sum, (i, c)| {
                let term = t.pow(i as i32) * rest.pow((degree - i) as i32);
                sum + BigRational::from_integer(c) * term
            },
        );
        prop_assert_eq!(sum, value(&a, &t));
    }

    #[test]
    fn poly_gcd_divides_both_and_is_the_greatest(
        a in any_poly(3), b in any_poly(3), c in any_poly(3),
    ) {
        let (x, y) = (a.mul(&c), b.mul(&c));
        let g = x.gcd(&y);
        if x.is_zero() && y.is_zero() {
            prop_assert!(g.is_zero());
        } else {
            prop_assert_eq!(g.mul(&x.primitive_part().div_exact(&g)), x.primitive_part());
            prop_assert_eq!(g.mul(&y.primitive_part().div_exact(&g)), y.primitive_part());
            if !c.is_zero() {
                // c divides it, so the division leaves no remainder and multiplies back.
                let c = c.primitive_part();
                prop_assert_eq!(c.mul(&g.div_exact(&c)), g);
            }
        }
    }
}

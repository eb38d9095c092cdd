use num_bigint::{BigInt, Sign};
use proptest::prelude::*;

use super::*;

/// Limbs at the edges of carries and borrows as often as not, and lengths beyond the inline buffer.
fn limbs() -> impl Strategy<Value = Vec<u64>> {
    let limb = prop_oneof![
        Just(0),
        Just(1),
        Just(u64::MAX),
        Just(1 << 63),
        any::<u64>(),
        any::<u64>(),
    ];
    prop_oneof![
        prop::collection::vec(limb.clone(), 0..4),
        prop::collection::vec(limb, 0..40),
    ]
}

fn integer() -> impl Strategy<Value = Integer> {
    (any::<bool>(), limbs()).prop_map(|(negative, limbs)| Integer::from_magnitude(negative, &limbs))
}

fn big(integer: &Integer) -> BigInt {
    let digits = integer.limbs.iter();
    let digits: Vec<u32> = digits.flat_map(|&l| [l as u32, (l >> 32) as u32]).collect();
    let sign = match integer.sign() {
        Ordering::Less => Sign::Minus,
        Ordering::Equal => Sign::NoSign,
        Ordering::Greater => Sign::Plus,
    };
    BigInt::from_slice(sign, &digits)
}

/// The value, and that it is written the one way it has to be.
fn checked(integer: &Integer) -> BigInt {
    assert_ne!(integer.limbs.last(), Some(&0));
    assert!(!(integer.negative && integer.limbs.is_empty()));
    big(integer)
}

/// Long enough for halves of halves, and as often all ones or sparse.
fn long() -> impl Strategy<Value = Integer> {
    let limb = prop_oneof![Just(0), Just(u64::MAX), any::<u64>()];
    let limbs = prop_oneof![
        prop::collection::vec(limb, 0..300),
        (0..300usize).prop_map(|length| vec![u64::MAX; length]),
    ];
    (any::<bool>(), limbs).prop_map(|(negative, limbs)| Integer::from_magnitude(negative, &limbs))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn integer_products_of_long_numbers_agree_with_num_bigint(a in long(), b in long()) {
        prop_assert_eq!(checked(&Integer::product(&a, &b)), big(&a) * big(&b));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(5000))]

    #[test]
    fn integer_operations_agree_with_num_bigint(a in integer(), b in integer(), shift in 0u64..300) {
        let (x, y) = (big(&a), big(&b));
        prop_assert_eq!(checked(&Integer::sum(&a, &b)), &x + &y);
        prop_assert_eq!(checked(&Integer::difference(&a, &b)), &x - &y);
        prop_assert_eq!(checked(&Integer::difference(&a, &a)), BigInt::ZERO);
        prop_assert_eq!(checked(&Integer::product(&a, &b)), &x * &y);
        if !b.is_zero() {
            let mut quotient = Integer::product(&a, &b.magnitude()).shifted(shift);
            quotient.divide_exactly(&b.magnitude().shifted(shift / 2));
            prop_assert_eq!(checked(&quotient), &x << (shift - shift / 2));
        }
        let limbs = a.limbs().iter().rev();
        let magnitude = limbs.fold(BigInt::ZERO, |above, &limb| (above << 64) + limb);
        prop_assert_eq!(magnitude, BigInt::from(x.magnitude().clone()));
        prop_assert_eq!(checked(&a.shifted(shift)), &x << shift);
        prop_assert_eq!(checked(&a.times(-3)), &x * -3);
        prop_assert_eq!(checked(&a.magnitude()), BigInt::from(x.magnitude().clone()));
        prop_assert_eq!(a.cmp(&b), x.cmp(&y));
        prop_assert_eq!(a.exceeds(&b), x.magnitude() > y.magnitude());
        prop_assert_eq!(a.bits(), x.bits());
        let mut c = a.clone();
        c.mul_assign(&b);
        prop_assert_eq!(checked(&c), &x * &y);
        let mut c = a.clone();
        c.add_shifted(&b, shift);
        prop_assert_eq!(checked(&c), &x + (&y << shift));
        let mut c = a.clone();
        c.sub_shifted(&b, shift);
        prop_assert_eq!(checked(&c), &x - (&y << shift));
        let mut c = a.clone();
        c.negate();
        prop_assert_eq!(checked(&c), -x);
    }

    #[test]
    fn integer_of_i128_is_the_same_number(value: i128) {
        for value in [value, value >> 64, 0, -1, i128::MIN, i128::MAX] {
            prop_assert_eq!(checked(&Integer::from(value)), BigInt::from(value));
        }
    }

    #[test]
    fn integer_window_is_64_bits_and_whether_all_below_are_0(a in integer(), from in 0u64..2600) {
        let magnitude = big(&a).magnitude().clone();
        let (bits, is_exact) = a.window(from);
        let shifted = &magnitude >> from;
        let low = shifted.iter_u64_digits().next().unwrap_or(0);
        prop_assert_eq!(bits, low);
        prop_assert_eq!(is_exact, shifted << from == magnitude);
    }

    #[test]
    fn integer_approximate_is_within_its_error_bound(a in integer()) {
        let (value, exponent) = a.approximate();
        let (mantissa, own) = crate::certified::exact::dyadic::decompose(value);
        let shift = own as i64 + exponent;
        prop_assert!(shift >= 0);
        let error: BigInt = (BigInt::from(mantissa) << shift) - big(&a);
        // |error| <= size (2^-53 + 2^-63)
        let size = BigInt::from(big(&a).magnitude().clone());
        let error = BigInt::from(error.magnitude().clone());
        prop_assert!(error << 63 <= size * ((1 << 10) + 1));
    }

    #[test]
    fn integer_ratio_is_within_its_error_bound(a in integer(), b in integer()) {
        let (mut n, mut d) = (a.magnitude(), b.magnitude());
        if n > d {
            std::mem::swap(&mut n, &mut d);
        }
        prop_assume!(!d.is_zero());
        let value = ratio(&n, &d);
        prop_assert!((0.0..=1.0).contains(&value));
        if value > 1e-290 {
            // |value d - n| <= n 2^-51 in units of 2^-1100
            let (mantissa, exponent) = crate::certified::exact::dyadic::decompose(value);
            let product = (big(&d) * mantissa) << (1100 + exponent);
            let error: BigInt = product - (big(&n) << 1100);
            prop_assert!(BigInt::from(error.magnitude().clone()) <= big(&n) << (1100 - 51));
        }
    }
}

#[test]
fn scale_reaches_both_ends_of_f64() {
    assert_eq!(scale(1.0, 1023), 2f64.powi(1023));
    assert_eq!(scale(1.0, -1074), f64::from_bits(1));
    assert_eq!(scale(f64::from_bits(1), 2097), 2f64.powi(1023));
    assert_eq!(scale(1.0, 1024), f64::INFINITY);
    assert_eq!(scale(1.0, -3000), 0.0);
    assert_eq!(scale(0.0, 5000), 0.0);
    assert_eq!(scale(3.0, -1), 1.5);
}

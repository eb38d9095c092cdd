use proptest::prelude::*;

use super::*;
use crate::certified::exact::integer::scale;

/// An `f64` in `[0, 1]` of any exponent.
fn unit_f64() -> impl Strategy<Value = f64> {
    let ends = prop::sample::select(vec![0.0, 1.0, f64::from_bits(1), f64::MIN_POSITIVE, 0.5]);
    prop_oneof![
        (0u64..=1f64.to_bits()).prop_map(f64::from_bits),
        0.0..1.0,
        ends
    ]
}

/// The number in the middle of two.
pub(in super::super) fn middle(a: &Dyadic, b: &Dyadic) -> Dyadic {
    let exponent = a.exponent.max(b.exponent);
    let mut sum = a.numerator.shifted(exponent - a.exponent);
    sum.add_shifted(&b.numerator, exponent - b.exponent);
    Dyadic::new(sum, exponent + 1)
}

proptest! {
    #[test]
    fn dyadic_of_f64_is_that_f64(value in unit_f64()) {
        let dyadic = Dyadic::from_f64(value);
        prop_assert_eq!((dyadic.below(), dyadic.above()), (value, value));
    }

    #[test]
    fn dyadic_between_neighbours_is_between_them(value in unit_f64(), halvings in 1u32..200) {
        prop_assume!(value < 1.0);
        let (low, high) = (Dyadic::from_f64(value), Dyadic::from_f64(value.next_up()));
        let mut at = high.clone();
        for _ in 0..halvings {
            at = middle(&low, &at);
            prop_assert!(low.compare(&at).is_lt() && at.compare(&high).is_lt());
        }
        prop_assert_eq!((at.below(), at.above()), (value, value.next_up()));
    }

    #[test]
    fn dyadic_compare_is_that_of_f64(a in unit_f64(), b in unit_f64()) {
        let order = Dyadic::from_f64(a).compare(&Dyadic::from_f64(b));
        prop_assert_eq!(Some(order), a.partial_cmp(&b));
    }

    #[test]
    fn decompose_gives_an_odd_mantissa_and_the_same_value(bits: u64) {
        let value = f64::from_bits(bits);
        prop_assume!(value.is_finite());
        for (mantissa, exponent) in [decompose(value), parts(value)] {
            prop_assert!(mantissa.unsigned_abs() < 1 << 53);
            prop_assert_eq!(scale(mantissa as f64, exponent.into()), value);
        }
        prop_assert!(value == 0.0 || decompose(value).0 % 2 != 0);
    }
}

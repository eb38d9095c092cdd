use proptest::prelude::*;

use super::*;

/// Coefficients of very different lengths, and many that nearly cancel at the time.
fn case() -> impl Strategy<Value = (Poly<0>, Dyadic)> {
    let limbs = |most| prop::collection::vec(prop_oneof![Just(0), any::<u64>()], 0..most);
    let integer = (any::<bool>(), limbs(20usize))
        .prop_map(|(negative, limbs)| Integer::from_magnitude(negative, &limbs));
    let coefficients = prop::collection::vec(integer, 1..8);
    let at = (limbs(16), 0u64..700).prop_map(|(limbs, more)| {
        let numerator = Integer::from_magnitude(false, &limbs);
        let exponent = numerator.bits() + more;
        Dyadic::new(numerator, exponent)
    });
    (coefficients, at, 0u8..3).prop_map(|(coefficients, at, roots)| {
        let mut poly = Poly::new(&coefficients);
        // The time itself, or one so near that only the last bits differ, as a root.
        let mut near = at.numerator.clone();
        near.negate();
        near.add_shifted(&Integer::from(i128::from(roots == 1)), 0);
        if roots > 0 {
            let line = Poly::new(&[near, Integer::from(1).shifted(at.exponent)]);
            poly = Poly::product(&poly, &line);
        }
        (poly, at)
    })
}

proptest! {
    #[test]
    fn enclosure_holds_the_exact_value((poly, at) in case(), bits in 1u64..600) {
        prop_assume!(!at.numerator.is_zero());
        let enclosure = poly.enclose(&at, bits);
        // Both in multiples of the smaller unit.
        let exact_unit = -(poly.degree() as i64 * at.exponent as i64);
        let unit = exact_unit.min(enclosure.unit);
        let [low, high] = enclosure.bounds(unit).expect("whole");
        let exact = poly.evaluate(&at).shifted((exact_unit - unit).unsigned_abs());
        prop_assert!(low <= exact && exact <= high);
    }

    #[test]
    fn enclosure_tells_the_sign_and_the_approximation_of_the_exact_value((poly, at) in case()) {
        let exact = poly.evaluate(&at);
        prop_assert_eq!(poly.sign_at(&at), exact.sign());
        prop_assert_eq!(poly.approximate_at(&at, &Cell::new(FIRST)), (exact.sign(), exact.approximate()));
    }

    #[test]
    fn enclosure_leads_with_as_many_bits_as_are_asked_for(
        (poly, at) in case(),
        bits in 1u64..400,
        expected in 0u64..3000,
    ) {
        let exact = poly.evaluate(&at);
        let mut lost = expected;
        let (value, unit) = poly.leading_at(&at, &mut lost, bits);
        prop_assert_eq!(value.sign(), exact.sign());
        // Both in multiples of the smaller unit.
        let exact_unit = -(poly.degree() as i64 * at.exponent as i64);
        let least = exact_unit.min(unit);
        let exact = exact.shifted((exact_unit - least).unsigned_abs());
        let value = value.shifted((unit - least).unsigned_abs());
        let error = Integer::difference(&value, &exact);
        prop_assert!(error.is_zero() || error.bits() + bits <= exact.bits() + 1);
        // What is lost is the same whatever was expected.
        let mut again = 0;
        poly.leading_at(&at, &mut again, bits);
        prop_assert!(lost.abs_diff(again) <= 1);
    }

    #[test]
    fn enclosure_tells_the_sign_beyond_a_power_of_two((poly, at) in case(), from in -700i64..1500) {
        // |p| > 2^from, in multiples of 2^-(degree exponent)
        let exact = poly.evaluate(&at);
        let scale = poly.degree() as i64 * at.exponent as i64;
        let bits = exact.bits() as i64;
        match poly.sign_beyond(&at, from) {
            Some(sign) => prop_assert!(sign == exact.sign() && bits > from + scale),
            // At most 4 times that.
            None => prop_assert!(exact.is_zero() || bits <= from + scale + 2),
        }
    }
}

/// At a root, nothing is beyond anything, however little that is.
#[test]
fn enclosure_of_zero_is_beyond_nothing() {
    let poly = Poly::<4>::new(&[Integer::ZERO, Integer::from(1)]);
    assert_eq!(poly.sign_beyond(&Dyadic::zero(), -1000), None);
}

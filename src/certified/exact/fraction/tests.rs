use proptest::prelude::*;

use super::super::dyadic::Dyadic;
use super::super::integer::Integer;
use super::*;

/// A value in `[0, 1]` compared with a fraction.
fn compare_value(value: f64, (n, d): (u64, u64)) -> Ordering {
    let at = Dyadic::from_f64(value);
    let own = at.numerator.times(d as i64);
    own.cmp(&Integer::from(i128::from(n)).shifted(at.exponent))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn fraction_near_a_rounded_fraction_is_that_one(
        d in prop_oneof![2..Fraction::LIMIT, 2u64..20],
        n: prop::sample::Index,
        ulps in -2i64..=2,
    ) {
        let n = 1 + n.index(d as usize - 1) as u64;
        let value = n as f64 / d as f64 * (1.0 + ulps as f64 * f64::EPSILON);
        let found = Fraction::near(value).unwrap();
        prop_assert_eq!(found.numerator * d, n * found.denominator);
        let (below, above) = found.neighbours();
        prop_assert!(compare_value(below, (n, d)).is_le() && compare_value(above, (n, d)).is_ge());
        let is_exact = compare_value(below, (n, d)).is_eq();
        prop_assert_eq!(above, if is_exact { below } else { below.next_up() });
    }

    #[test]
    fn fractions_compare_as_their_values(a in 1u64..1000, b in 1u64..1000, d in 1000u64..1010) {
        let [p, q] = [(a, d), (b, 1003)].map(|(numerator, denominator)| Fraction {
            numerator,
            denominator,
        });
        let exact = (a * 1003).cmp(&(b * d));
        prop_assert_eq!(p.compare(q), exact);
    }

    #[test]
    fn fraction_compares_with_ticks(
        (n, d) in (2u64..Fraction::LIMIT).prop_flat_map(|d| (1..d, Just(d))),
        step in -1i128..=1,
        other: u128,
    ) {
        let fraction = Fraction { numerator: n, denominator: d };
        let below = Integer::from(i128::from(n)).shifted(128);
        // The grid time at the fraction or below it, its neighbours, and any other.
        let at = (0..128).fold((u128::from(n), 0u128), |(rest, at), _| {
            let rest = 2 * rest;
            let bit = u128::from(rest >= u128::from(d));
            (rest - bit * u128::from(d), 2 * at + bit)
        });
        for grid_time in [at.1.wrapping_add_signed(step), other] {
            let limbs = [grid_time as u64, (grid_time >> 64) as u64];
            let own = Integer::from_magnitude(false, &limbs).times(d as i64);
            prop_assert_eq!(fraction.compare_grid_time(GridTime(grid_time)), below.cmp(&own));
        }
    }
}

#[test]
fn fraction_near_refuses_other_times() {
    for time in [0.0, 1.0, f64::NAN, 1e-300, 1e-6, 0.1 + 1e-9, 0.5f64.sqrt()] {
        assert!(Fraction::near(time).is_none(), "{time}");
    }
}

/// Exhaustive: every fraction below the limit, in lowest terms or not.
#[test]
fn fractions_are_all_found_and_between_their_neighbours() {
    for denominator in 2..Fraction::LIMIT {
        for numerator in 1..denominator {
            let value = numerator as f64 / denominator as f64;
            let found = Fraction::near(value).unwrap();
            assert_eq!(
                found.numerator * denominator,
                numerator * found.denominator,
                "{numerator} / {denominator}"
            );
            let fraction = Fraction {
                numerator,
                denominator,
            };
            let (below, above) = fraction.neighbours();
            // Values are multiples of 2^-66, numerators and denominators below 2^12.
            let scaled = |value: f64| (value * 2f64.powi(66)) as u128 * u128::from(denominator);
            let exact = u128::from(numerator) << 66;
            let is_exact = scaled(below) == exact;
            assert!(
                scaled(below) <= exact && exact <= scaled(above),
                "{fraction:?}"
            );
            assert_eq!(
                above,
                if is_exact { below } else { below.next_up() },
                "{fraction:?}"
            );
        }
    }
}

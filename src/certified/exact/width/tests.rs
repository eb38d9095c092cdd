use proptest::prelude::*;

use super::*;

/// A number of at most `bits` bits, often at the end of that range.
fn below(bits: u32) -> impl Strategy<Value = i128> {
    let limit = (1i128 << bits) - 1;
    prop_oneof![
        -limit..=limit,
        Just(limit),
        Just(-limit),
        Just(0),
        -2i128..=2,
        (0..bits).prop_map(|bit| 1i128 << bit),
        (0..bits).prop_map(|bit| -(1i128 << bit)),
    ]
}

fn same<const N: usize>(wide: &Wide<N>, integer: &Integer) -> Result<(), TestCaseError> {
    prop_assert_eq!(&wide.to_integer(), integer);
    prop_assert_eq!(wide.sign(), integer.sign());
    let (value, exact) = (wide.to_f64(), integer.to_f64());
    prop_assert!((value - exact).abs() <= exact.abs() * f64::EPSILON * 2.0);
    Ok(())
}

fn grid_time() -> impl Strategy<Value = u128> {
    prop_oneof![any::<u128>(), Just(u128::MAX), Just(1), Just(1 << 127)]
}

/// Sums, products and values of the largest numbers that a width takes.
fn check<const L: usize, const Q: usize, const C: usize, const QV: usize, const CV: usize>(
    [a, b, c]: [i128; 3],
    grid_time: u128,
) -> Result<(), TestCaseError> {
    let at = Fraction {
        numerator: grid_time as u64 % Fraction::LIMIT,
        denominator: Fraction::LIMIT - 1,
    };
    let [x, y, z] = [a, b, c].map(Wide::<L>::from);
    let [i, j, k] = [a, b, c].map(Integer::from);
    same(&x, &i)?;
    let (xy, ij) = (
        Fixed::<L, Q, C, QV, CV>::times(&x, &y),
        Integer::product(&i, &j),
    );
    same(&xy, &ij)?;
    // As many terms as the docs of the module count.
    let (mut quadratic, mut reversed) = (xy, Fixed::<L, Q, C, QV, CV>::times(&y, &z));
    let (mut sum, mut difference) = (ij.clone(), Integer::product(&j, &k));
    for _ in 1..18 {
        (quadratic, sum) = (quadratic.add(&xy), Integer::sum(&sum, &ij));
        (reversed, difference) = (reversed.sub(&xy), Integer::difference(&difference, &ij));
    }
    same(&quadratic, &sum)?;
    same(&reversed, &difference)?;
    let (twice, double) = (quadratic.add(&quadratic), Integer::sum(&sum, &sum));
    let value = Fixed::<L, Q, C, QV, CV>::quadratic_at(&[quadratic, twice, quadratic], grid_time);
    same(
        &value,
        &Unlimited::quadratic_at(&[sum.clone(), double, sum], grid_time),
    )?;
    let wide = [reversed, quadratic, reversed];
    let exact = [difference.clone(), sum_of(&ij, 18), difference];
    let value = Fixed::<L, Q, C, QV, CV>::quadratic_at(&wide, grid_time);
    same(&value, &Unlimited::quadratic_at(&exact, grid_time))?;
    let value = Fixed::<L, Q, C, QV, CV>::quadratic_at_fraction(&wide, at);
    same(&value, &Unlimited::quadratic_at_fraction(&exact, at))?;
    let (xyz, ijk) = (
        Fixed::<L, Q, C, QV, CV>::times_quadratic(&xy, &z),
        Integer::product(&ij, &k),
    );
    same(&xyz, &ijk)?;
    let (mut cubic, mut sum) = (xyz, ijk.clone());
    for _ in 1..18 {
        (cubic, sum) = (cubic.add(&xyz), Integer::sum(&sum, &ijk));
    }
    same(&cubic, &sum)?;
    let (wide, exact) = (
        [xyz, cubic, cubic, xyz],
        [ijk.clone(), sum.clone(), sum.clone(), ijk],
    );
    let value = Fixed::<L, Q, C, QV, CV>::cubic_at(&wide, grid_time);
    same(&value, &Unlimited::cubic_at(&exact, grid_time))?;
    let value = Fixed::<L, Q, C, QV, CV>::cubic_at_fraction(&wide, at);
    same(&value, &Unlimited::cubic_at_fraction(&exact, at))?;
    for _ in 1..8 {
        (cubic, sum) = (
            cubic.add(&sum_wide(&xyz, 18)),
            Integer::sum(&sum, &sum_of(&xyz.to_integer(), 18)),
        );
    }
    same(&cubic, &sum)
}

fn sum_of(number: &Integer, count: i64) -> Integer {
    number.times(count)
}

fn sum_wide<const N: usize>(number: &Wide<N>, count: usize) -> Wide<N> {
    (1..count).fold(*number, |sum, _| sum.add(number))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(5000))]

    #[test]
    fn lane_of_1_1_2_limbs_takes_all_numbers_of_its_width(
        abc in prop::array::uniform3(below(Fixed::<1, 1, 2, 5, 8>::BITS)),
        grid_time in grid_time(),
    ) {
        check::<1, 1, 2, 5, 8>(abc, grid_time)?;
    }

    #[test]
    fn lane_of_1_2_2_limbs_takes_all_numbers_of_its_width(
        abc in prop::array::uniform3(below(Fixed::<1, 2, 2, 6, 8>::BITS)),
        grid_time in grid_time(),
    ) {
        check::<1, 2, 2, 6, 8>(abc, grid_time)?;
    }

    #[test]
    fn lane_of_1_2_3_limbs_takes_all_numbers_of_its_width(
        abc in prop::array::uniform3(below(Fixed::<1, 2, 3, 6, 9>::BITS)),
        grid_time in grid_time(),
    ) {
        check::<1, 2, 3, 6, 9>(abc, grid_time)?;
    }

    #[test]
    fn lane_of_2_3_5_limbs_takes_all_numbers_of_its_width(
        abc in prop::array::uniform3(below(Fixed::<2, 3, 5, 7, 11>::BITS)),
        grid_time in grid_time(),
    ) {
        check::<2, 3, 5, 7, 11>(abc, grid_time)?;
    }

    #[test]
    fn lane_of_2_4_6_limbs_takes_all_numbers_of_its_width(
        abc in prop::array::uniform3(below(Fixed::<2, 4, 6, 8, 12>::BITS)),
        grid_time in grid_time(),
    ) {
        check::<2, 4, 6, 8, 12>(abc, grid_time)?;
    }
}

#[test]
fn lane_widths_are_those_of_their_limbs() {
    let bits = [
        Fixed::<1, 1, 2, 5, 8>::BITS,
        Fixed::<1, 2, 2, 6, 8>::BITS,
        Fixed::<1, 2, 3, 6, 9>::BITS,
        Fixed::<2, 3, 5, 7, 11>::BITS,
        Fixed::<2, 4, 6, 8, 12>::BITS,
    ];
    assert_eq!(bits, [28, 39, 60, 92, 124]);
}

#[test]
fn lane_values_at_a_fraction_are_those_of_the_polynomial() {
    let at = Fraction {
        numerator: 2,
        denominator: 3,
    };
    let c = [5, -7, 11, -13].map(Integer::from);
    let value = Unlimited::cubic_at_fraction(&c, at);
    assert_eq!(
        value,
        Integer::from(5 * 27 - 7 * 2 * 9 + 11 * 4 * 3 - 13 * 8)
    );
    let [c0, c1, c2, _] = c;
    let value = Unlimited::quadratic_at_fraction(&[c0, c1, c2], at);
    assert_eq!(value, Integer::from(5 * 9 - 7 * 2 * 3 + 11 * 4));
}

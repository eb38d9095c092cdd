use proptest::prelude::*;

use super::super::unlimited::{Boxed, Unlimited};
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
    let product = Fixed::<L, Q, C, QV, CV>::times_quadratics(&reversed, &quadratic);
    same(&product, &Integer::product(&difference, &sum))?;
    let (twice, double) = (quadratic.add(&quadratic), Integer::sum(&sum, &sum));
    let value = Fixed::<L, Q, C, QV, CV>::quadratic_at(&[quadratic, twice, quadratic], grid_time);
    let exact = [sum.clone(), double, sum].map(Boxed::from);
    same(
        &value,
        &Unlimited::quadratic_at(&exact, grid_time).to_integer(),
    )?;
    let wide = [reversed, quadratic, reversed];
    let exact = [difference.clone(), sum_of(&ij, 18), difference].map(Boxed::from);
    let value = Fixed::<L, Q, C, QV, CV>::quadratic_at(&wide, grid_time);
    same(
        &value,
        &Unlimited::quadratic_at(&exact, grid_time).to_integer(),
    )?;
    let value = Fixed::<L, Q, C, QV, CV>::quadratic_at_fraction(&wide, at);
    same(
        &value,
        &Unlimited::quadratic_at_fraction(&exact, at).to_integer(),
    )?;
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
        [ijk.clone(), sum.clone(), sum.clone(), ijk].map(Boxed::from),
    );
    let value = Fixed::<L, Q, C, QV, CV>::cubic_at(&wide, grid_time);
    same(&value, &Unlimited::cubic_at(&exact, grid_time).to_integer())?;
    let value = Fixed::<L, Q, C, QV, CV>::cubic_at_fraction(&wide, at);
    same(
        &value,
        &Unlimited::cubic_at_fraction(&exact, at).to_integer(),
    )?;
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
    let c = [5, -7, 11, -13].map(|c| Boxed::from(Integer::from(c)));
    let value = Unlimited::cubic_at_fraction(&c, at);
    assert_eq!(
        value.to_integer(),
        Integer::from(5 * 27 - 7 * 2 * 9 + 11 * 4 * 3 - 13 * 8)
    );
    let [c0, c1, c2, _] = c;
    let value = Unlimited::quadratic_at_fraction(&[c0, c1, c2], at);
    assert_eq!(
        value.to_integer(),
        Integer::from(5 * 9 - 7 * 2 * 3 + 11 * 4)
    );
}

/// Limbs at which carries and borrows begin and end.
const LIMBS: [u64; 7] = [0, 1, 2, (1 << 63) - 1, 1 << 63, u64::MAX - 1, u64::MAX];

/// `a + b`, `a - b` and `a b` of all numbers of two limbs of these, where they fit, against `i128`
/// and integers of any size.
#[test]
fn wide_numbers_of_all_edge_limbs_are_computed_exactly() {
    let pairs = LIMBS.iter().flat_map(|&low| LIMBS.map(|high| [low, high]));
    let numbers: Vec<Wide<2>> = pairs.map(Wide).collect();
    let value = |x: &Wide<2>| (u128::from(x.0[1]) << 64 | u128::from(x.0[0])) as i128;
    let mut count = 0;
    for a in &numbers {
        for b in &numbers {
            let (x, y) = (value(a), value(b));
            if let Some(sum) = x.checked_add(y) {
                assert_eq!(value(&a.add(b)), sum);
                count += 1;
            }
            if let Some(difference) = x.checked_sub(y) {
                assert_eq!(value(&a.sub(b)), difference);
            }
            let product: Wide<4> = product(a, b);
            let exact = Integer::product(&Integer::from(x), &Integer::from(y));
            assert_eq!(product.to_integer(), exact);
            assert_eq!(product.sign(), exact.sign());
        }
    }
    assert!(count > 1000);
}

/// Every number of 8 bits in place of a limb's: carry and borrow of all sums and differences.
#[test]
fn limbs_carry_and_borrow_as_the_integers_do() {
    for a in 0..=255u64 {
        for b in 0..=255u64 {
            // At the top of the limb, where it overflows.
            let [a, b] = [a, b].map(|x| x << 56);
            for carry in [false, true] {
                let (sum, over) = add_limbs(a, b, carry);
                let exact = u128::from(a) + u128::from(b) + u128::from(carry);
                assert_eq!(u128::from(over) << 64 | u128::from(sum), exact);
                let (difference, under) = subtract_limbs(a, b, carry);
                let exact = i128::from(a) - i128::from(b) - i128::from(carry);
                assert_eq!(i128::from(difference) - (i128::from(under) << 64), exact);
            }
        }
    }
    for [a, b, c, d] in edge_limbs() {
        let (low, high) = multiply_add(a, b, c, d);
        let exact = Integer::product(&i128::from(a).into(), &i128::from(b).into());
        let exact = Integer::sum(&exact, &(i128::from(c) + i128::from(d)).into());
        assert_eq!(Integer::from_magnitude(false, &[low, high]), exact);
    }
}

fn edge_limbs() -> impl Iterator<Item = [u64; 4]> {
    let four = |i: usize| [0, 1, 2, 3].map(|place| LIMBS[i / 7usize.pow(place) % 7]);
    (0..7usize.pow(4)).map(four)
}

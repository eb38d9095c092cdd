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

/// Sums and products of the largest numbers that a lane takes.
fn check<const L: usize, const Q: usize, const C: usize>(
    [a, b, c]: [i128; 3],
) -> Result<(), TestCaseError> {
    let [x, y, z] = [a, b, c].map(Wide::<L>::from);
    let [i, j, k] = [a, b, c].map(Integer::from);
    same(&x, &i)?;
    let (xy, ij) = (Fixed::<L, Q, C>::times(&x, &y), Integer::product(&i, &j));
    same(&xy, &ij)?;
    // As many terms as the docs of the module count.
    let (mut quadratic, mut reversed) = (xy, Fixed::<L, Q, C>::times(&y, &z));
    let (mut sum, mut difference) = (ij.clone(), Integer::product(&j, &k));
    for _ in 1..36 {
        (quadratic, sum) = (quadratic.add(&xy), Integer::sum(&sum, &ij));
        (reversed, difference) = (reversed.sub(&xy), Integer::difference(&difference, &ij));
    }
    same(&quadratic, &sum)?;
    same(&reversed, &difference)?;
    let (xyz, ijk) = (
        Fixed::<L, Q, C>::times_quadratic(&xy, &z),
        Integer::product(&ij, &k),
    );
    same(&xyz, &ijk)?;
    let (mut cubic, mut sum) = (xyz, ijk.clone());
    for _ in 1..6 * 18 {
        (cubic, sum) = (cubic.add(&xyz), Integer::sum(&sum, &ijk));
    }
    same(&cubic, &sum)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(5000))]

    #[test]
    fn lane_of_1_2_2_limbs_takes_all_numbers_of_its_width(
        abc in prop::array::uniform3(below(Fixed::<1, 2, 2>::BITS)),
    ) {
        check::<1, 2, 2>(abc)?;
    }

    #[test]
    fn lane_of_1_2_3_limbs_takes_all_numbers_of_its_width(
        abc in prop::array::uniform3(below(Fixed::<1, 2, 3>::BITS)),
    ) {
        check::<1, 2, 3>(abc)?;
    }

    #[test]
    fn lane_of_2_3_5_limbs_takes_all_numbers_of_its_width(
        abc in prop::array::uniform3(below(Fixed::<2, 3, 5>::BITS)),
    ) {
        check::<2, 3, 5>(abc)?;
    }

    #[test]
    fn lane_of_2_4_6_limbs_takes_all_numbers_of_its_width(
        abc in prop::array::uniform3(below(Fixed::<2, 4, 6>::BITS)),
    ) {
        check::<2, 4, 6>(abc)?;
    }
}

#[test]
fn lane_widths_are_those_of_their_limbs() {
    let bits = [
        Fixed::<1, 2, 2>::BITS,
        Fixed::<1, 2, 3>::BITS,
        Fixed::<2, 3, 5>::BITS,
        Fixed::<2, 4, 6>::BITS,
    ];
    assert_eq!(bits, [39, 60, 92, 124]);
}

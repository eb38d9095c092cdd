use num_bigint::BigUint;
use proptest::prelude::*;

use super::*;

/// Moduli of all sizes that are permitted: the smallest, and those with the smallest and the largest
/// `2^64` modulo them.
fn modulus() -> impl Strategy<Value = u64> {
    let largest = (1 << 62) - (1u64 << 30) + 1;
    prop_oneof![
        2u64..1 << 20,
        largest..1 << 62,
        Just(largest),
        Just((1 << 61) - 1),
        Just((1 << 62) - 1),
    ]
}

/// Limbs, many of them without a bit or with all of them.
fn limb() -> impl Strategy<Value = u64> {
    prop_oneof![Just(0), Just(u64::MAX), any::<u64>()]
}

proptest! {
    #[test]
    fn residues_are_those_of_integers_of_any_size(
        modulus in modulus(),
        limbs in prop::collection::vec(limb(), 0..6),
        a in limb(),
        b in limb(),
    ) {
        let by = Modulus::new(modulus);
        let big = |n: u64| BigUint::from(n);
        let number = limbs.iter().rev().fold(big(0), |above, &limb| (above << 64) + limb);
        prop_assert_eq!(big(by.residue(&limbs)), number % modulus);
        let (a, b) = (a % modulus, b % modulus);
        prop_assert_eq!(big(by.times(a, b)), big(a) * b % modulus);
        prop_assert_eq!(big(by.minus(a, b)), (big(a) + modulus - b) % modulus);
        prop_assert_eq!(by.inverse(a).map(big), big(a).modinv(&big(modulus)));
    }
}

#[test]
fn numbers_have_an_inverse_unless_they_have_a_factor_of_the_modulus() {
    for n in 2..200 {
        let by = Modulus::new(n);
        for a in 0..n {
            let found = by.inverse(a);
            let expected = (0..n).find(|x| a * x % n == 1);
            assert_eq!(found, expected, "{a} modulo {n}");
        }
    }
}

#[test]
fn moduli_below_2_62_have_no_small_factor() {
    let moduli: Vec<_> = Modulus::below_2_62().take(5000).map(Modulus::get).collect();
    assert!(moduli.windows(2).all(|pair| pair[0] > pair[1]));
    for &n in &moduli {
        assert!((2..41).all(|d| !n.is_multiple_of(d)), "{n}");
    }
    // None is left out, the largest prime among them.
    let has_none = |n: &u64| (2..41).all(|d| !n.is_multiple_of(d));
    let all = (moduli[4999]..1 << 62).rev().filter(has_none);
    assert!(moduli.iter().copied().eq(all));
    assert!(moduli.contains(&((1 << 62) - 57)));
}

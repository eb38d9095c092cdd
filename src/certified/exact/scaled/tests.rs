use num_bigint::BigInt;
use proptest::prelude::*;

use super::*;
use crate::query::{EdgeEdge, Point};

/// The coordinate differences times 2^1074.
fn exactly(query: &EdgeEdge) -> Vec<BigInt> {
    let integer = |value: f64| {
        let (mantissa, exponent) = decompose(value);
        BigInt::from(mantissa) << if mantissa == 0 { 0 } else { exponent + 1074 }
    };
    let at = |points: &[Point; 4], to: usize, from: usize, axis: usize| {
        integer(points[to][axis]) - integer(points[from][axis])
    };
    let mut all = Vec::new();
    for (to, from) in [(1, 0), (3, 2), (2, 0)] {
        let start: Vec<_> = (0..3)
            .map(|axis| at(query.start(), to, from, axis))
            .collect();
        let end = (0..3).map(|axis| at(query.end(), to, from, axis));
        let change: Vec<_> = end.zip(&start).map(|(end, start)| end - start).collect();
        all.extend(start);
        all.extend(change);
    }
    all
}

fn big(integer: &Integer) -> BigInt {
    let windows = (0..80).rev().map(|i| integer.window(64 * i).0);
    let magnitude = windows.fold(BigInt::ZERO, |sum, limb| (sum << 64) + limb);
    if integer.sign().is_lt() {
        -magnitude
    } else {
        magnitude
    }
}

/// Whether one is the other times one power of two.
fn are_scaled(scaled: &[BigInt], exact: &[BigInt]) -> bool {
    let Some(at) = exact.iter().position(|x| *x != BigInt::ZERO) else {
        return scaled.iter().all(|x| *x == BigInt::ZERO);
    };
    let shift = exact[at].bits() as i64 - scaled[at].bits() as i64;
    shift >= 0 && scaled.iter().zip(exact).all(|(s, e)| s << shift == *e)
}

fn check(values: [f64; 24]) -> Result<(), TestCaseError> {
    let point = |i: usize| Point::new(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    let query = EdgeEdge::new([0, 1, 2, 3].map(point), [4, 5, 6, 7].map(point), 0.0).unwrap();
    let exact = exactly(&query);
    match Scaled::new(&Positions::of(query.start(), query.end())) {
        Scaled::Short { values, bits } => {
            let scaled: Vec<BigInt> = values.iter().map(|&v| BigInt::from(v)).collect();
            prop_assert!(are_scaled(&scaled, &exact));
            prop_assert_eq!(scaled.iter().map(BigInt::bits).max(), Some(u64::from(bits)));
        }
        Scaled::Narrow { values, bits } => {
            let scaled: Vec<BigInt> = values.iter().map(|&v| BigInt::from(v)).collect();
            prop_assert!(are_scaled(&scaled, &exact));
            prop_assert_eq!(scaled.iter().map(BigInt::bits).max(), Some(u64::from(bits)));
        }
        Scaled::Broad(values) => {
            let scaled: Vec<BigInt> = values.iter().map(big).collect();
            prop_assert!(are_scaled(&scaled, &exact));
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn scaled_motion_is_that_of_the_query_in_every_exponent(bits in prop::array::uniform24(any::<u64>())) {
        check(bits.map(|b| Some(f64::from_bits(b)).filter(|v| v.is_finite()).unwrap_or(0.0)))?;
    }

    #[test]
    fn scaled_motion_is_that_of_the_query_in_narrow_ranges(
        values in prop::array::uniform24(-1.0..1.0f64),
        exponents in prop::array::uniform24(0i32..=75),
        zero in 0usize..24,
    ) {
        let mut scaled = [0.0; 24];
        for ((scaled, value), exponent) in scaled.iter_mut().zip(values).zip(exponents) {
            *scaled = value * 2f64.powi(exponent);
        }
        scaled[zero] = 0.0;
        check(scaled)?;
        check(values)?;
    }

    #[test]
    fn scaled_motion_is_narrow_for_short_mantissas_far_apart(
        mantissas in prop::array::uniform24(-4i8..=4), shift in 0i32..=100,
    ) {
        let mut values = mantissas.map(f64::from);
        values[3] *= 2f64.powi(shift);
        check(values)?;
    }
}

use proptest::prelude::*;

use super::super::isolate::tests::isolated;
use super::super::isolate::tests::poly;
use super::super::poly::Poly;
use super::*;

/// Whether the polynomial has other signs at the ends of an interval.
fn changes_sign(p: &Poly, (low, high): Interval) -> bool {
    use super::super::dyadic::Dyadic;
    let low = low.map_or(Dyadic::zero(), GridTime::to_dyadic);
    let high = high.map_or(Dyadic::one(), GridTime::to_dyadic);
    let (low, high) = (p.sign_at(&low), p.sign_at(&high));
    low.is_ne() && low == high.reverse()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(50_000))]

    #[test]
    fn part_finds_the_roots_that_exact_isolation_finds(
        c in prop::array::uniform4(-50i64..=50), scale in prop::sample::select(vec![1i64, 1 << 40]),
    ) {
        let c = c.map(|c| c * scale);
        let p = poly(&c);
        prop_assume!(!p.is_zero());
        if let Some(intervals) = isolate_f64(&c.map(|c| c as f64)) {
            let isolated = isolated(p.clone());
            prop_assert_eq!(intervals.len(), isolated.cells().len());
            for &interval in &intervals {
                prop_assert!(changes_sign(&p, interval), "{interval:?}");
            }
            let is_ascending = intervals.windows(2).all(|pair| pair[0].1 <= pair[1].0);
            prop_assert!(is_ascending);
        }
    }
}

#[test]
fn part_separates_three_roots_and_leaves_near_ones() {
    // (4t - 1)(2t - 1)(4t - 3)
    let three = [-3.0, 22.0, -48.0, 32.0];
    assert_eq!(
        isolate_f64(&three).map(|found| found.len()),
        None,
        "1/4 is an end of a piece"
    );
    // (5t - 1)(5t - 2)(5t - 4)
    let three = [-8.0, 70.0, -175.0, 125.0];
    assert_eq!(isolate_f64(&three).map(|found| found.len()), Some(3));
    // (3t - 1)^2
    assert_eq!(isolate_f64(&[1.0, -6.0, 9.0, 0.0]), None);
    assert_eq!(isolate_f64(&[f64::NAN, 1.0, 1.0, 1.0]), None);
    assert_eq!(isolate_f64(&[f64::INFINITY, 1.0, 1.0, 1.0]), None);
}

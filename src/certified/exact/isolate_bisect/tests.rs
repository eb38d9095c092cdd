use proptest::prelude::*;

use super::super::curve::Curve;
use super::super::grid_time::GridTime;
use super::super::integer::Integer;
use super::super::isolate::tests::isolated as isolate;
use super::super::unlimited::{Boxed, Unlimited};
use super::super::width::Wide;
use super::*;
use crate::certified::exact::Medium;

/// The product of `d t - n` over three fractions `n / d` near each other, changed a little.
fn cubic() -> impl Strategy<Value = [i128; 4]> {
    let root = (0i128..=3000, Just(3000i128 - 1));
    let near = (0i128..3000, 0i128..=2, 0i128..=2, 2990i128..3010);
    let roots = prop_oneof![
        prop::array::uniform3(root),
        near.prop_map(|(n, a, b, d)| [(n, d), (n + a, d), (n + b, d + 1)]),
    ];
    (roots, -3i128..=3).prop_map(|([(n, d), (m, e), (o, g)], change)| {
        [
            -n * m * o + change,
            d * m * o + n * e * o + n * m * g,
            -d * e * o - d * m * g - n * e * g,
            d * e * g,
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn halved_intervals_hold_the_isolated_roots(c in cubic()) {
        let exact = c.map(|c| Boxed::from(Integer::from(c)));
        let isolated = isolate(Curve::<Unlimited>::Cubic(exact.clone()).to_poly());
        let halved = isolate_bisect::<Unlimited>(&exact);
        prop_assert_eq!(&halved, &isolate_bisect::<Medium>(&c.map(Wide::from)));
        let Some(halved) = halved else {
            return Ok(());
        };
        let inside = isolated.cells().iter().filter(|cell| cell.before.is_ne() && cell.after.is_ne());
        let inside: Vec<_> = inside.collect();
        prop_assert_eq!(halved.len(), inside.len());
        let curve = Curve::<Unlimited>::Cubic(exact);
        let mut end = None;
        for ((low, high), cell) in halved.into_iter().zip(inside) {
            prop_assert!(low >= end);
            let sign = |at: Option<GridTime>| at.map(|at| curve.sample(at).0);
            prop_assert!(sign(low).is_none_or(|sign| sign == cell.before));
            prop_assert!(sign(high).is_none_or(|sign| sign == cell.after));
            end = high;
        }
    }
}

/// `(d t - k) (d t - k - 1) (t + 1)`, halved: how many roots are found.
fn count_of_near_roots(d: i128, k: i128) -> Option<usize> {
    let (a, b, c) = (d * d, -d * (2 * k + 1), k * (k + 1));
    let cubic = [c, b + c, a + b, a].map(|c| Boxed::from(Integer::from(c)));
    isolate_bisect::<Unlimited>(&cubic).map(|found| found.len())
}

#[test]
fn halve_parts_roots_that_are_near_each_other() {
    let d = 3i128.pow(25);
    assert_eq!(count_of_near_roots(d, d / 3 + 1), Some(2));
    // These are where the interval is halved.
    assert_eq!(count_of_near_roots(1 << 40, (1 << 39) - 1), None);
}

use proptest::prelude::*;

use super::*;

/// The product of the `d t - n` for these roots `n / d`, and of `t^2 + 1`, which has none.
fn with_roots(roots: &[(i64, i64)]) -> Poly {
    let poly = |c: &[i64]| {
        let c: Vec<_> = c.iter().map(|&c| Integer::from(i128::from(c))).collect();
        Poly::new(&c)
    };
    let start = if roots.len() < 5 {
        poly(&[1, 0, 1])
    } else {
        poly(&[-3])
    };
    roots.iter().fold(start, |product, (n, d)| {
        Poly::product(&product, &poly(&[-n, *d]))
    })
}

proptest! {
    #[test]
    fn roots_are_those_in_the_step_each_once(
        roots in prop::collection::vec((-4i64..=12, 1i64..=8), 0..=6),
        again in prop::collection::vec(any::<prop::sample::Index>(), 0..=3),
    ) {
        // Some of them several times.
        let mut all = roots.clone();
        all.extend(again.iter().filter(|_| !roots.is_empty()).map(|index| *index.get(&roots)));
        all.truncate(6);
        let mut expected: Vec<f64> = all
            .iter()
            .map(|(n, d)| *n as f64 / *d as f64)
            .filter(|t| *t > 0.0 && *t <= 1.0)
            .collect();
        expected.sort_by(f64::total_cmp);
        expected.dedup();
        let found = Roots::new(with_roots(&all));
        let found: Vec<_> = found.times().map(|(_, neighbours)| neighbours).collect();
        prop_assert_eq!(found.len(), expected.len());
        for ([below, above], expected) in found.into_iter().zip(expected) {
            prop_assert!(below <= expected && expected <= above && above <= below.next_up());
        }
    }
}

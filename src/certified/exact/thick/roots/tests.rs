use proptest::prelude::*;

use super::*;

fn poly(c: &[i64]) -> Poly {
    let c: Vec<_> = c.iter().map(|&c| Integer::from(i128::from(c))).collect();
    Poly::new(&c)
}

/// `d t - n`.
fn linear(n: i64, d: i64) -> Poly {
    poly(&[-n, d])
}

/// The product of the `d t - n` for these roots `n / d`, and of `t^2 + 1`, which has none.
fn with_roots(roots: &[(i64, i64)]) -> Poly {
    let start = if roots.len() < 5 {
        poly(&[1, 0, 1])
    } else {
        poly(&[-3])
    };
    roots.iter().fold(start, |product, (n, d)| {
        Poly::product(&product, &linear(*n, *d))
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

    /// A double root moved up or down by less and less, so that it becomes none or two, up to
    /// 2^-600 from each other.
    #[test]
    fn roots_that_nearly_meet_are_two_or_none(
        n in 1i64..=10,
        exponent in 30u64..=1200,
        other in prop::option::of((-4i64..=12, 1i64..=8)),
    ) {
        prop_assume!(other.is_none_or(|(m, d)| 11 * m != n * d));
        let double = with_roots(&[(n, 11), (n, 11)]).shifted(exponent);
        let one = poly(&[1]);
        let times_other = |p: &Poly| match other {
            Some((m, d)) => Poly::product(p, &linear(m, d)),
            None => p.clone(),
        };
        let count = |p: &Poly| Roots::new(times_other(p)).times().count();
        let others = usize::from(other.is_some_and(|(m, d)| m > 0 && m <= d));
        prop_assert_eq!(count(&Poly::sum(&double, &one)), others);
        let two = Poly::difference(&double, &one);
        prop_assert_eq!(count(&two), others + 2);
        // On both sides of where they would meet.
        let near: Vec<_> = Roots::new(two).times().map(|(_, neighbours)| neighbours).collect();
        let middle = n as f64 / 11.0;
        prop_assert!(near[0][0] <= middle && middle <= near[1][1]);
        prop_assert!(near.iter().all(|[below, _]| (below - middle).abs() < 1e-4));
    }

    /// The same, where the two roots are numbers of few bits.
    #[test]
    fn roots_that_nearly_meet_are_found_as_numbers(n in 1i64..=7, half in 15u64..=500) {
        let square = Poly::product(&linear(n, 8), &linear(n, 8)).shifted(2 * half);
        let roots = Roots::new(Poly::difference(&square, &poly(&[1])));
        let roots: Vec<_> = roots.times().collect();
        prop_assert_eq!(roots.len(), 2);
        let numerator = |sign: i128| {
            let mut numerator = Integer::from(i128::from(n)).shifted(half);
            numerator.add_shifted(&Integer::from(sign), 0);
            Dyadic::new(numerator, half + 3)
        };
        for ((time, _), sign) in roots.iter().zip([-1, 1]) {
            prop_assert!(time.compare(&Time::At(numerator(sign))).is_eq());
        }
    }
}

use std::cell::OnceCell;

use proptest::prelude::*;

use super::super::roots::Roots;
use super::super::unlimited::{Boxed, Unlimited};
use super::super::width::{Fixed, Wide};
use super::*;
use crate::certified::exact::integer::Integer;

type Narrow = Fixed<1, 2, 3, 6, 9>;

/// Coefficients of a quadratic, large or small.
fn quadratic() -> impl Strategy<Value = [i128; 3]> {
    let wide = -(1i128 << 110)..=1i128 << 110;
    let small = -3i128..=3;
    prop_oneof![
        [wide.clone(), wide.clone(), wide.clone()],
        [small.clone(), small.clone(), small.clone()],
        [small, wide.clone(), wide],
    ]
}

/// The quadratic whose constant coefficient is made such that the value at `t` is about that.
fn nearly_cancelled([c0, c1, c2]: [i128; 3], t: f64) -> [i128; 3] {
    // With 60 bits of t.
    let t = (t * 2f64.powi(60)) as i128;
    let times_t = |x: i128| ((x >> 60) * t) + (((x & ((1 << 60) - 1)) * t) >> 60);
    [c0 - times_t(times_t(c2) + c1), c1, c2]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// The lane of fixed width against integers of any size; the latter without floating point.
    #[test]
    fn time_signs_and_quotients_agree_with_exact_ones(
        f in [-5i64..=5, -5i64..=5, -5i64..=5, -5i64..=5],
        scale in prop::sample::select(vec![1i128, (1 << 50) + 1]),
        draws in [quadratic(), quadratic()],
        cancels in any::<[bool; 2]>(),
    ) {
        let coefficients = f.map(|c| i128::from(c) * scale);
        prop_assume!(f != [0; 4]);
        let mut roots = Roots::<Narrow>::none();
        roots.find(Curve::Cubic(coefficients.map(Wide::from)));
        for (time, _, _) in roots.iter() {
            let [n, d] = [0, 1].map(|i| {
                if cancels[i] { nearly_cancelled(draws[i], time.below) } else { draws[i] }
            });
            let exact_sign = |q: [i128; 3]| {
                let poly = Poly::new(&q.map(Integer::from));
                match time.moment() {
                    AlgebraicTime::At(at) => poly.sign_at(&at),
                    AlgebraicTime::Between(bracket) => bracket.sturm_sign_of(poly),
                }
            };
            for q in [n, d] {
                let wide = q.map(Wide::from);
                prop_assert_eq!(time.sign_of(&wide), exact_sign(q));
                if let Some(value) = time.quick_value_of(&wide) {
                    prop_assert_eq!(sign(value), Some(exact_sign(q)));
                }
            }
            // The quotient against the sign of n - value d at its error bound.
            let difference = [0, 1, 2].map(|i| n[i] - d[i]);
            let (up, down) = (exact_sign(d), exact_sign(d).reverse());
            if up.is_ne() && exact_sign(n) == up && exact_sign(difference) == down {
                let value = time.quotient(&n.map(Wide::from), &d.map(Wide::from));
                for (bound, side) in [(-1.0, up), (1.0, down)] {
                    let other = value + bound * super::super::PLACE_ERROR;
                    // n - other d, times 2^54: other is a multiple of 2^-54 up to rounding to it.
                    let other = (other * 2f64.powi(54)) as i128;
                    let terms = [0, 1, 2].map(|i| {
                        let product = Integer::product(&d[i].into(), &other.into());
                        Integer::difference(&Integer::from(n[i]).shifted(54), &product)
                    });
                    let sign = match time.moment() {
                        AlgebraicTime::At(at) => Poly::<4>::new(&terms).sign_at(&at),
                        AlgebraicTime::Between(bracket) => bracket.sturm_sign_of(Poly::new(&terms)),
                    };
                    prop_assert!(sign == side || sign.is_eq(), "{n:?} / {d:?}: {value}");
                }
            }
        }
    }

    #[test]
    fn time_compare_is_that_of_the_roots(
        p in [-6i64..=6, -6i64..=6, -6i64..=6], q in [-6i64..=6, -6i64..=6, -6i64..=6],
    ) {
        prop_assume!(p != [0; 3] && q != [0; 3]);
        let (mut narrow, mut wide) = (Roots::<Narrow>::none(), Roots::<Narrow>::none());
        narrow.find(Curve::Quadratic(p.map(|c| Wide::from(i128::from(c)))));
        wide.find(Curve::Quadratic(q.map(|c| Wide::from(i128::from(c)))));
        for (a, _, _) in narrow.iter() {
            for (b, _, _) in wide.iter() {
                let order = a.compare(&b);
                prop_assert_eq!(b.compare(&a), order.reverse());
                let is_common = a.sign_of(&q.map(|c| Wide::from(i128::from(c)))).is_eq();
                match order {
                    Ordering::Equal => prop_assert!(is_common && a.below == b.below),
                    Ordering::Less => prop_assert!(a.below <= b.below),
                    Ordering::Greater => prop_assert!(a.below >= b.below),
                }
            }
        }
    }
}

#[test]
fn time_of_a_root_that_fixed_widths_do_not_reach_is_found() {
    // 2^200 t - 1: below the grid of 2^-128.
    let one = Integer::from(1);
    let mut minus_one = one.clone();
    minus_one.negate();
    let curve = [minus_one, one.shifted(200), Integer::default()].map(Boxed::from);
    let curve = Curve::<Unlimited>::Quadratic(curve);
    let poly = OnceCell::new();
    let time = Time::of_root(Source::new(&curve, &poly), Ordering::Less, None, None);
    assert_eq!((time.below, time.above), (2f64.powi(-200), 2f64.powi(-200)));
    // 3 2^200 t - 1
    let three = one.times(3).shifted(200);
    let mut minus_one = one.clone();
    minus_one.negate();
    let curve = [minus_one, three, Integer::default()].map(Boxed::from);
    let curve = Curve::<Unlimited>::Quadratic(curve);
    let poly = OnceCell::new();
    let time = Time::of_root(Source::new(&curve, &poly), Ordering::Less, None, None);
    let below = 2f64.powi(-200) / 3.0;
    assert!([below, below.next_down()].contains(&time.below));
    assert_eq!(time.above, time.below.next_up());
}

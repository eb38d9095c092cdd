use proptest::prelude::*;

use super::super::modular::tests::poly;
use super::*;

/// Whether they are multiples of each other.
fn are_multiples(p: &Poly<0>, q: &Poly<0>) -> bool {
    let times_leading = |p: &Poly<0>, of: &Poly<0>| {
        let leading = of.coefficients().last().cloned();
        Poly::product(p, &Poly::new(&[leading.unwrap_or_default()]))
    };
    times_leading(p, q) == times_leading(q, p)
}

/// Small numbers, which often share a factor with a leading coefficient or with each other, or give
/// a divisor of a degree that is too large.
fn small_moduli() -> impl Iterator<Item = Modulus> {
    (2..3000).map(Modulus::new)
}

/// A polynomial without its multiple roots, by some moduli.
fn quotient_by(
    poly: &Poly<0>,
    derivative: &Poly<0>,
    moduli: impl Iterator<Item = Modulus>,
) -> Option<Poly<0>> {
    by_moduli(poly, derivative, moduli).map(|common| common.quotient)
}

/// A product of factors with small coefficients, of degree 6 at most.
fn with_multiple_roots() -> impl Strategy<Value = Poly<0>> {
    let factor = prop::collection::vec(-9i64..=9, 2..=3);
    let factors = prop::collection::vec((factor, 1usize..=4), 1..=3);
    factors.prop_filter_map("degree 1 to 6", |factors| {
        let mut product = poly(&[1]);
        for (factor, times) in factors {
            for _ in 0..times {
                product = Poly::product(&product, &poly(&factor));
            }
        }
        (1..=6).contains(&product.degree()).then_some(product)
    })
}

proptest! {
    #[test]
    fn moduli_and_remainders_agree(
        poly in with_multiple_roots(),
        shifts in prop::collection::vec(0u64..3000, 2),
    ) {
        // Long coefficients: times a number, and with the roots divided by a power of two.
        let terms = poly.coefficients().iter().zip(0..);
        let long: Vec<_> = terms.map(|(c, i)| c.shifted(i * shifts[0])).collect();
        let factor = Integer::sum(&Integer::from(1).shifted(shifts[1]), &Integer::from(2));
        let long = Poly::product(&Poly::<0>::new(&long), &Poly::new(&[factor]));
        for poly in [poly, long] {
            let derivative = poly.derivative();
            let expected = by_remainders(poly.clone(), derivative.clone());
            let large = quotient_by(&poly, &derivative, Modulus::below_2_62());
            prop_assert!(large.is_some_and(|p| are_multiples(&p, &expected)));
            // They may be too few.
            if let Some(small) = quotient_by(&poly, &derivative, small_moduli()) {
                prop_assert!(are_multiples(&small, &expected));
            }
            prop_assert!(are_multiples(&square_free(poly), &expected));
        }
    }
}

#[test]
fn moduli_that_mislead_are_passed_over() {
    // (t - 1)^2 (t - 3) (t - 9) (5 t - 2): more roots are double modulo 2, 3, 13 and 43; 5 divides the
    // leading coefficient.
    let p = [[-1, 1], [-1, 1], [-3, 1], [-9, 1], [-2, 5]]
        .map(|factor| poly(&factor))
        .iter()
        .fold(poly(&[1]), |product, factor| {
            Poly::product(&product, factor)
        });
    let derivative = p.derivative();
    let expected = by_remainders(p.clone(), derivative.clone());
    assert_eq!(expected.degree(), 4);
    for first in [2, 3, 5, 13, 43] {
        let misleading = std::iter::repeat_n(Modulus::new(first), 3);
        assert!(
            quotient_by(&p, &derivative, misleading.clone()).is_none(),
            "{first}"
        );
        // Before and after others.
        let others = || small_moduli().filter(|modulus| modulus.get() > 43);
        let before = misleading.clone().chain(others());
        let after = others().take(2).chain(misleading).chain(others().skip(2));
        for square_free in [
            quotient_by(&p, &derivative, before),
            quotient_by(&p, &derivative, after),
        ] {
            let square_free = square_free.unwrap_or_default();
            assert!(are_multiples(&square_free, &expected), "{first}");
        }
    }
}

#[test]
fn common_factor_of_long_polynomials_is_what_they_share() {
    let [a, b, c] = [[-3, 7, 2], [5, -1, 4], [11, 0, -9]].map(|p| poly(&p));
    let long = Poly::new(&[Integer::sum(
        &Integer::from(1).shifted(5000),
        &Integer::from(3),
    )]);
    let [p, q] = [&a, &c].map(|other| {
        let shared = Poly::product(&b, other);
        Poly::product(&shared, &long)
    });
    for (p, q) in [(&p, &q), (&q, &p)] {
        let common = common_factor(p, q).map(|common| common.divisor);
        assert!(are_multiples(&common.unwrap_or_default(), &b));
    }
    let none = common_factor(&Poly::product(&a, &long), &b).map(|common| common.divisor);
    assert_eq!(none.map(|divisor| divisor.degree()), Some(0));
    // Short ones are left to remainders, as is 0.
    assert!(common_factor(&p, &Poly::default()).is_none());
    assert!(common_factor(&Poly::product(&a, &b), &b).is_none());
}

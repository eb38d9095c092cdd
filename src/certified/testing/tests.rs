use std::cmp::Ordering;

use super::*;

#[test]
fn testing_numbers_are_exact() {
    let least = Number::from(f64::from_bits(1));
    assert!(least == Number::power(-1074) && least > Number::zero());
    assert!(Number::from(-1.5).times(-2) == Number::from(3.0));
    assert!(Number::from(-f64::MIN_POSITIVE) == -&Number::power(-1022));
    // What f64 loses.
    let sum = &Number::from(f64::MAX) + &least;
    assert!(sum > Number::from(f64::MAX) && &sum - &least == Number::from(f64::MAX));
    let third = Number::from(1.0 / 3.0);
    assert!((&third.times(3) - &Number::from(1.0)) == -&Number::power(-54));
    assert_eq!(Number::from(3.0).ratio(&Number::from(-4.0).abs()), 0.75);
    assert!(Number::from(1.0).middle(&Number::from(2.0)) == Number::from(1.5));
    assert_eq!(Number::from(-0.0).sign(), Ordering::Equal);
}

/// The product of `t - r` over the roots.
fn of_roots(roots: &[f64]) -> Polynomial {
    let factor = |r: &f64| {
        let [r, one] = [*r, 1.0].map(Number::from);
        Polynomial::line(&-&r, &(&one - &r))
    };
    let factors: Vec<_> = roots.iter().map(factor).collect();
    factors[1..]
        .iter()
        .fold(factors[0].clone(), |product, next| &product * next)
}

#[test]
fn testing_roots_are_counted() {
    let [zero, half, one] = [0.0, 0.5, 1.0].map(Number::from);
    for (roots, open, closed) in [
        ([0.25, 0.5, 0.75], 3, 3),
        ([0.0, 0.5, 1.0], 2, 3),
        ([0.5, 0.5, 0.75], 2, 2),
        ([0.5, 0.5, 0.5], 1, 1),
        ([-1.0, 0.25f64.next_up(), 0.25], 2, 2),
        ([-1.0, 2.0, 1.0f64.next_up()], 0, 0),
    ] {
        let p = of_roots(&roots);
        assert_eq!(
            (p.roots(&zero, &one), p.roots_in_closed(&zero, &one)),
            (open, closed)
        );
    }
    let never = &of_roots(&[0.5, 0.5]) + &of_roots(&[-1.0]);
    assert_eq!(never.roots_in_closed(&zero, &one), 0);
    assert_eq!(of_roots(&[0.25, 0.5, 0.75]).roots(&zero, &half), 2);
}

#[test]
fn testing_polynomials_agree_with_their_bernstein_form() {
    let p = of_roots(&[0.1, -3.0, 0.7]);
    let thrice = p.thrice_bernstein();
    let again = Polynomial::of_bernstein(&thrice);
    for t in [0.0, 1.0, 0.3, -2.0] {
        let t = Number::from(t);
        assert!(again.at(&t) == p.at(&t).times(3));
    }
    let [low, high] = [0.0, 0.5].map(Number::from);
    let (low, high) = p.enclose(&low, &high, 100);
    assert!(low <= Number::from(0.1) && Number::from(0.1) <= high);
    assert!(&high - &low == Number::power(-101));
}

#[test]
fn testing_least_magnitude_is_at_a_root_an_end_or_the_vertex() {
    let [low, high, end] = [0.0, 1.0, 0.25].map(Number::from);
    let least = |p: &Polynomial| p.least_magnitude(&low, &high);
    assert!(least(&of_roots(&[0.5, 3.0])) == Number::zero());
    assert!(least(&of_roots(&[2.0, 3.0])) == Number::from(2.0));
    // (t - 1/2)^2 + (t + 1 - t)
    let constant = &of_roots(&[-1.0]) - &of_roots(&[0.0]);
    let parabola = &of_roots(&[0.5, 0.5]) + &constant;
    assert!(&least(&parabola) - &high < Number::power(-100));
    assert!(parabola.least_magnitude(&low, &end) == Number::from(1.0625));
}

/// The error of a rounded sum, and a share of what it is at most.
fn largest_error_of_a_sum(share: f64) -> f64 {
    let search = Search {
        seed: 15,
        climbs: 2,
        starts: 100,
        steps: 500,
    };
    let start = |random: &mut Random| [random.unit(), random.unit()];
    let claims = |&[a, b]: &[f64; 2]| {
        let exact = &Number::from(a) + &Number::from(b);
        let bound = &(&exact.abs() * &Number::power(-53)) * &Number::from(share);
        (a + b)
            .is_finite()
            .then(|| [Claim::within(a + b, &exact, bound)])
    };
    let [worst] = search.worst(start, claims);
    worst
}

#[test]
fn testing_search_finds_the_largest_rounding_error() {
    assert!(largest_error_of_a_sum(1.0) > 0.99);
}

#[test]
#[should_panic(expected = "does not hold")]
fn testing_search_refutes_a_bound_that_is_too_small() {
    largest_error_of_a_sum(0.9);
}

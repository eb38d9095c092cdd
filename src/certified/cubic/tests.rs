use std::cell::Cell;

use wide::f64x2;

use super::super::testing::{Claim, Exact, Number, Random, Search, layout, points};
use super::*;

fn motion(x: &[f64]) -> Motion<f64x2> {
    Motion::new(&layout(x).points())
}

/// The error of each Bernstein coefficient, three times.
fn coefficient_claims(x: &[f64; 24], cubic: &Cubic, exact: &[Number; 4]) -> [Claim; 4] {
    [0, 1, 2, 3].map(|i| {
        let found = Number::from(cubic.bernstein[i]).times(3);
        let error = (&found - &exact[i]).abs();
        let bound = Number::from(cubic.error).times(3);
        let has_sign = |sign| exact[i].sign() == sign;
        if have_one_sign(&cubic.bernstein, cubic.error) {
            assert!(
                has_sign(exact[0].sign()) && exact[i].sign().is_ne(),
                "{x:?}"
            );
        }
        Claim { error, bound }
    })
}

#[test]
fn cubic_coefficients_are_within_their_bound() {
    let (largest, least, signs) = (Cell::new(0.0f64), Cell::new(1.0f64), Cell::new([0; 2]));
    let claims = |x: &[f64; 24]| {
        let cubic = Cubic::new(&motion(x))?;
        let size = cubic.reach.iter().map(super::largest).fold(0.0, f64::max);
        largest.set(size.max(largest.get()));
        least.set(cubic.error.min(least.get()));
        let mut counts = signs.get();
        counts[usize::from(cubic.has_no_root())] += 1;
        signs.set(counts);
        let exact = Exact::new(&layout(x)).f.thrice_bernstein();
        Some(coefficient_claims(x, &cubic, &exact))
    };
    let start = |random: &mut Random| points(random, (-222, 184));
    let search = Search {
        seed: 4,
        climbs: 8,
        starts: 200,
        steps: 2500,
    };
    let worst = search.worst(start, claims);
    println!(
        "cubic: {worst:?}, sizes up to 2^{}, errors down to 2^{}, without and with one sign {:?}",
        largest.get().log2(),
        least.get().log2(),
        signs.get()
    );
    assert!(worst.iter().all(|&ratio| ratio > 0.1));
    assert!(largest.get() > LARGEST / 4.0 && least.get() < 16.0 * SMALLEST);
    assert!(signs.get().iter().all(|&count| count > 1_000));
}

/// Edges on a sphere of this size that are never coplanar.
fn skew(size: f64) -> [f64; 24] {
    let points = [0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 1., 1.];
    let mut x = [0.0; 24];
    for (x, point) in x.iter_mut().zip(points.iter().cycle()) {
        *x = size * point;
    }
    x
}

#[test]
fn cubic_is_none_outside_of_its_range() {
    // f = size^3, P = size^3.
    for (power, is_valid) in [
        (0, true),
        (179, true),
        (180, false),
        (500, false),
        (1023, false),
    ] {
        assert_eq!(
            Cubic::new(&motion(&skew(2f64.powi(power)))).is_some(),
            is_valid
        );
    }
    // 2^-600 and below is too small.
    for (power, is_valid) in [(-199, true), (-200, false), (-201, false), (-1000, false)] {
        assert_eq!(
            Cubic::new(&motion(&skew(2f64.powi(power)))).is_some(),
            is_valid
        );
    }
    assert!(Cubic::new(&motion(&skew(f64::MAX))).is_none());
    assert!(Cubic::new(&motion(&[0.0; 24])).is_none());
    let mut x = skew(1.0);
    (x[0], x[3]) = (-f64::MAX, f64::MAX);
    assert!(Cubic::new(&motion(&x)).is_none());
}

#[test]
fn cubic_signs_are_certain_from_the_error_on() {
    let error = 0.25;
    for i in 0..4 {
        for sign in [1.0, -1.0] {
            let mut b = [sign; 4];
            assert!(have_one_sign(&b, error));
            b[i] = sign * error;
            assert!(!have_one_sign(&b, error));
            b[i] = sign * error.next_up();
            assert!(have_one_sign(&b, error));
            b[i] = -sign;
            assert!(!have_one_sign(&b, error));
        }
    }
}

use super::*;
use crate::certified::testing::{Claim, Number, Random, Search};

/// `start + (end - start) step` exactly, against what is stored.
fn error_of(start: f64, end: f64, step: f64, precision: Precision) -> Number {
    let [a, b, s] = [start, end, step].map(Number::from);
    let exact = &a + &(&(&b - &a) * &s);
    (&Number::from(coordinate_in(start, end, step, precision)) - &exact).abs()
}

fn claims(&[start, end, step]: &[f64; 3], precision: Precision) -> Option<[Claim; 1]> {
    let is_step = (0.0..=1.0).contains(&step);
    let is_finite = start.is_finite() && end.is_finite();
    (is_step && is_finite).then(|| {
        [Claim {
            error: error_of(start, end, step, precision),
            bound: rounding_in(start, end, precision).into(),
        }]
    })
}

/// How near the error of a stored coordinate comes to its bound, of the coordinates that `applies`.
fn worst(applies: fn(f64, f64) -> bool, start: impl Fn(&mut Random) -> [f64; 3]) -> f64 {
    worst_in(Precision::F64, applies, start)
}

fn worst_in(
    precision: Precision,
    applies: fn(f64, f64) -> bool,
    start: impl Fn(&mut Random) -> [f64; 3],
) -> f64 {
    let search = Search {
        seed: 5,
        climbs: if cfg!(debug_assertions) { 4 } else { 12 },
        starts: 500,
        steps: 5_000,
    };
    let [worst] = search.worst(start, |at| {
        applies(at[0], at[1]).then(|| claims(at, precision))?
    });
    worst
}

/// A step, now and then one of few bits or next to an end.
fn step(random: &mut Random) -> f64 {
    match random.below(4) {
        0 => random.small().abs().min(1.0),
        1 => 1.0 - random.unit() * 2f64.powi(-random.whole(0, 53)),
        2 => random.unit() * 2f64.powi(-random.whole(0, 1074)),
        _ => random.unit(),
    }
}

/// A number of about a size.
fn sized(random: &mut Random, exponent: i32) -> f64 {
    let near_power = 1.0 + f64::from(random.whole(-4, 4)) * f64::EPSILON;
    let digits = match random.below(3) {
        0 => near_power,
        1 => -near_power,
        _ => random.signed() * 2.0,
    };
    digits * 2f64.powi(exponent)
}

/// The search comes so near to the bounds that it refutes any that is a millionth smaller.
#[test]
fn step_stored_coordinates_are_within_their_bound() {
    let worst = worst(
        |_, _| true,
        |random| {
            let exponent = random.whole(-30, 30);
            let other = exponent - random.whole(0, 60);
            let [a, b] = [sized(random, exponent), sized(random, other)];
            // Near each other, or not.
            [a, if random.coin() { b } else { a + b }, step(random)]
        },
    );
    println!("worst {worst}");
    assert!(worst > 0.999_999, "{worst}");
}

/// Where the two ends are far apart, most of the bound is about their difference.
#[test]
fn step_stored_coordinates_of_opposite_signs_are_within_their_bound() {
    let worst = worst(
        |a, b| a * b < 0.0 && (0.5..2.0).contains(&(-a / b)),
        |random| {
            let exponent = random.whole(-30, 30);
            let [a, b] = [(); 2].map(|()| sized(random, exponent));
            [a, -a.signum() * b.abs(), step(random)]
        },
    );
    println!("worst {worst}");
    assert!(worst > 0.3, "{worst}");
}

#[test]
fn step_stored_coordinates_are_within_their_bound_where_they_underflow() {
    let worst = worst(
        |a, b| a.abs().max(b.abs()) < 1e-300,
        |random| {
            let [a, b] = [(); 2].map(|()| {
                let exponent = random.whole(-1074, -1000);
                sized(random, exponent)
            });
            [a, b, step(random)]
        },
    );
    println!("worst {worst}");
    assert!(worst > 0.999, "{worst}");
}

#[test]
fn step_stored_coordinates_are_within_their_bound_where_differences_overflow() {
    let worst = worst(
        |a, b| !(b - a).is_finite(),
        |random| {
            let [a, b] = [(); 2].map(|()| sized(random, 1022));
            [a, -a.signum() * b.abs(), step(random)]
        },
    );
    println!("worst {worst}");
    assert!(worst > 0.15, "{worst}");
}

#[test]
fn step_stored_coordinates_are_the_ends_at_its_ends_and_stay_between() {
    let random = &mut Random::new(9);
    for _ in 0..20_000 {
        let exponents = [random.whole(-1074, 1022), random.whole(-1074, 1022)];
        let [a, b] = exponents.map(|exponent| sized(random, exponent));
        assert_eq!(coordinate(a, b, 0.0), a);
        assert_eq!(coordinate(a, b, 1.0), b);
        assert_eq!(coordinate(a, a, random.unit()), a);
        let between = coordinate(a, b, step(random));
        assert!(
            a.min(b) <= between && between <= a.max(b),
            "{a} {b} {between}"
        );
    }
}

/// The number as an `f32`.
fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

/// Coordinates that are stored as `f32`.
fn are_single(a: f64, b: f64) -> bool {
    [a, b].iter().all(|x| single(*x) == *x)
}

#[test]
fn step_stored_coordinates_in_f32_are_within_their_bound() {
    let worst = worst_in(Precision::F32, are_single, |random| {
        let exponent = random.whole(-30, 30);
        let other = exponent - random.whole(0, 60);
        let [a, b] = [sized(random, exponent), sized(random, other)];
        let b = if random.coin() { b } else { a + b };
        [single(a), single(b), step(random)]
    });
    println!("worst {worst}");
    assert!(worst > 0.999, "{worst}");
}

#[test]
fn step_stored_coordinates_in_f32_are_within_their_bound_at_the_ends_of_the_range() {
    for exponents in [[-149, -120], [120, 127]] {
        let worst = worst_in(Precision::F32, are_single, |random| {
            let [a, b] = [(); 2].map(|()| {
                let exponent = random.whole(exponents[0], exponents[1]);
                single(sized(random, exponent)).clamp(f32::MIN.into(), f32::MAX.into())
            });
            [a, b, step(random)]
        });
        println!("worst {worst}");
        // Below the least normal number the error is at most half of the bound's last term.
        assert!(worst > 0.3, "{exponents:?} {worst}");
    }
}

/// What is no `f32` at an end is stored as an `f64`, also beyond the largest `f32`.
#[test]
fn step_stored_coordinates_in_f32_are_f32_where_their_ends_are() {
    let random = &mut Random::new(11);
    let (mut singles, mut others) = (0, 0);
    for _ in 0..20_000 {
        let [a, b] = [(); 2].map(|()| {
            let exponent = random.whole(-1074, 1022);
            let is_far = random.coin();
            let x = sized(random, if is_far { exponent } else { exponent % 120 });
            if random.coin() { single(x) } else { x }
        });
        if ![a, b].iter().all(|x| x.is_finite()) {
            continue;
        }
        let step = step(random);
        let stored = coordinate_in(a, b, step, Precision::F32);
        assert!(a.min(b) <= stored && stored <= a.max(b), "{a} {b} {stored}");
        if are_single(a, b) {
            singles += 1;
            assert_eq!(stored, single(coordinate(a, b, step)));
        } else {
            others += 1;
            assert_eq!(stored, coordinate(a, b, step));
        }
        assert_eq!(coordinate_in(a, b, 1.0, Precision::F32), b);
        assert_eq!(coordinate_in(a, b, 0.0, Precision::F32), a);
    }
    assert!(singles > 2000 && others > 2000, "{singles} {others}");
}

/// Neither an error nor a panic: positions that are no numbers stay none.
#[test]
fn step_stored_coordinates_of_nan_are_nan() {
    let values = [f64::NAN, 1.0, f64::INFINITY];
    for precision in [Precision::F64, Precision::F32] {
        for step in [0.3, 5e-324, f64::NAN] {
            for (start, end) in values.into_iter().flat_map(|a| values.map(|b| (a, b))) {
                let stored = coordinate_in(start, end, step, precision);
                let is_nan = start.is_nan() || end.is_nan() || step.is_nan() && start != end;
                assert!(stored.is_nan() || !is_nan, "{start} {end} {step}: {stored}");
            }
        }
    }
}

use super::super::rough::Rough;
use super::*;
use crate::certified::testing::{Number, Random};

/// A number, and the error that another one has that stands for it.
struct Known {
    exact: Number,
    ball: Ball,
    rough: Rough,
}

/// A number of any size, now and then one at which products underflow, with no error, or as far off
/// what stands for it as that says, above or below.
fn known(random: &mut Random, size: i32) -> Known {
    let power = |exponent: i32| 2f64.powi(exponent);
    let high = random.signed() * power(random.whole(-size, size));
    let low = match random.below(3) {
        0 => 0.0,
        1 => high * power(-54) * random.signed(),
        // A whole half of an ulp.
        _ => 0.25 * (high.abs().next_up() - high.abs()),
    };
    let error = match random.below(3) {
        0 => 0.0,
        1 => high.abs() * power(-90) * random.unit(),
        _ => high.abs() * power(random.whole(-20, 1)),
    };
    let ball = Ball {
        middle: Double { high, low },
        error,
    };
    let off = match random.below(3) {
        0 => -error,
        1 => error,
        _ => 0.5 * error,
    };
    let exact = &middle(&ball) + &Number::from(off);
    Known {
        exact,
        ball,
        rough: Rough::of(ball),
    }
}

fn middle(ball: &Ball) -> Number {
    &Number::from(ball.middle.high) + &Number::from(ball.middle.low)
}

/// Whether what is found holds the exact number, and its sign and bounds are right.
fn holds(exact: &Number, ball: Ball, rough: Rough) -> bool {
    let is_within = |middle: Number, error: f64| (exact - &middle).abs() <= Number::from(error);
    let is_sign = |sign: Option<Ordering>| sign.is_none_or(|sign| sign == exact.sign());
    let is_bounded = |least: f64, most: f64| {
        let size = exact.abs();
        (least <= 0.0 || Number::from(least) <= size) && size <= Number::from(most)
    };
    is_within(middle(&ball), ball.error)
        && is_within(Number::from(rough.value()), rough.error())
        && is_sign(ball.sign())
        && is_sign(rough.sign())
        && is_bounded(ball.least(), ball.most())
        && is_bounded(rough.least(), rough.most())
}

#[test]
fn numbers_with_errors_hold_the_exact_results() {
    let mut random = Random::new(29);
    let (mut signs, mut all) = (0, 0);
    for round in 0..60_000 {
        let size = if round % 3 == 0 { 500 } else { 30 };
        let (x, y) = (known(&mut random, size), known(&mut random, size));
        let (m, n) = (&x.exact, &y.exact);
        let results = [
            (m + n, x.ball.add(y.ball), x.rough.add(y.rough)),
            (m - n, x.ball.sub(y.ball), x.rough.sub(y.rough)),
            (m * n, x.ball.mul(y.ball), x.rough.mul(y.rough)),
            (m.times(2), x.ball.twice(), x.rough.twice()),
            (-m, x.ball.neg(), x.rough.neg()),
            (m.times(1), Ball::widened(x.ball, 0.25), Rough::of(x.ball)),
        ];
        for (exact, ball, rough) in results {
            assert!(
                holds(&exact, ball, rough),
                "{:?} {:?}",
                ball.rounded(),
                (rough.value(), rough.error())
            );
            signs += u32::from(ball.sign().is_some() && rough.sign().is_some());
            all += 1;
        }
    }
    assert!(2 * signs > all, "{signs} of {all}");
}

#[test]
fn differences_and_sums_have_no_error() {
    let mut random = Random::new(30);
    for _ in 0..20_000 {
        let [a, b] = [0; 2].map(|_| random.signed() * 2f64.powi(random.whole(-300, 300)));
        let (x, y) = (Number::from(a), Number::from(b));
        let (difference, sum) = (Ball::difference(a, b), Ball::sum([a, b]));
        assert!(middle(&difference) == &x - &y && difference.error == 0.0);
        assert!(middle(&sum) == &x + &y && sum.error == 0.0);
    }
}

#[test]
fn what_overflows_has_no_sign() {
    for huge in [Ball::new(f64::MAX), Ball::new(1e308).mul(Ball::new(1e300))] {
        let square = huge.mul(huge);
        assert!(square.sign().is_none() && square.sub(huge).sign().is_none());
        assert!(Rough::of(square).sign().is_none());
    }
    assert!(Ball::UNKNOWN.sign().is_none());
    let rough = Rough::of(Ball::new(f64::MAX));
    assert!(rough.mul(rough).sign().is_none() && rough.add(rough).sign().is_none());
}

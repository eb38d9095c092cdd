//! Where a polynomial passes 0, to the last bit of `f64`.

use std::cmp::Ordering;

use super::ball::{Ball, UP};
use super::rough::Rough;
use super::series::Series;
use crate::certified::separate::U;

/// A time at which a polynomial passes 0, the only one from some time on.
pub(super) struct Root {
    /// The neighbours in `f64`, strictly below and above it.
    pub(super) bracket: [f64; 2],
    /// The time, with an error that is much smaller than what is between both.
    pub(super) time: Ball,
    /// The sign before.
    pub(super) before: Ordering,
}

/// Steps of Newton's method from a guess, in `f64` and then with precise values.
const STEPS: usize = 3;
const PRECISE_STEPS: usize = 3;

/// The root of a series around `middle` that is near a guess, if it is certain that there is none
/// from `from` to there, and that it is not a number in `f64`. `precise` is the value of the
/// polynomial at a time.
///
/// # Proof
///
/// The slope has one sign from `from` to past the root. With the value `w` at a time `t` and `s` a
/// bound for all slopes within `h` of it, `|w| < |s| h`: there is a root within `h`, and by the mean
/// value theorem it is at `t - w / s'` with a slope `s'` from there.
pub(super) fn root_after<const N: usize>(
    series: &Series<N>,
    middle: f64,
    from: f64,
    guess: f64,
    precise: impl Fn(Ball) -> Ball,
) -> Option<Root> {
    let mut time = guess - middle;
    for _ in 0..STEPS {
        let [value, slope] = series.about(time);
        time -= value / slope;
    }
    let mut t = middle + time;
    for _ in 0..PRECISE_STEPS {
        if !(from..=1.0).contains(&t) {
            return None;
        }
        let value = precise(Ball::new(t));
        let [_, about] = series.about(t - middle);
        let near = (2.0 * (value.value() / about).abs() + f64::EPSILON * t) * UP;
        // The middle is subtracted with an error.
        let slope = series.slope_at(Rough::new(t - middle, (near + U * (t + middle)) * UP));
        let after = step(value, slope)?;
        let time = Ball::new(t)
            .add(Ball::new(after.value()))
            .widened(after.error());
        if after.most() < near
            && let Some(bracket) = bracket(time)
        {
            return is_only(series, middle, from, bracket).then_some(Root {
                bracket,
                time,
                before: slope.sign()?.reverse(),
            });
        }
        t = time.value();
    }
    None
}

/// The quotient of a value and all slopes with the opposite sign: how far the root is.
fn step(value: Ball, slope: Rough) -> Option<Rough> {
    slope.sign()?;
    let (value, error) = value.rounded();
    let about = -value / slope.value();
    // |w / s' - about| |s'| = |w - about s'|
    let product = Rough::new(about, 0.0).mul(slope);
    let rest = Rough::new(value, error).add(product);
    let error = rest.most() / slope.least() * UP;
    error.is_finite().then_some(Rough::new(about, error))
}

/// The neighbours of a time, if it is certain that they are, and that it is not one of them.
fn bracket(time: Ball) -> Option<[f64; 2]> {
    let nearest = time.value();
    let bracket = match time.sub(Ball::new(nearest)).sign()? {
        Ordering::Less => [nearest.next_down(), nearest],
        _ => [nearest, nearest.next_up()],
    };
    let [below, above] = bracket.map(|end| time.sub(Ball::new(end)).sign());
    let is_between = below == Some(Ordering::Greater) && above == Some(Ordering::Less);
    (is_between && bracket[0] >= 0.0 && bracket[1] <= 1.0).then_some(bracket)
}

/// Whether the slope certainly has one sign from a time to the end of the bracket.
fn is_only<const N: usize>(
    series: &Series<N>,
    middle: f64,
    from: f64,
    [lower, upper]: [f64; 2],
) -> bool {
    let reach = (middle - from).abs().max((upper - middle).abs()) * UP;
    from <= lower && series.slope_sign_within(reach).is_some()
}

//! Small changes of a query, so that others of its kind are near it.

use rand::{Rng, RngExt};

use crate::shape::Shape;

/// The exponents of finite numbers, those below the least normal one included.
const EXPONENTS: std::ops::RangeInclusive<i32> = -1074..=1023;

/// Changes a number, a position, or a radius that is not 0; the numbers may become such as no query has.
pub(super) fn change(shape: &mut Shape, rng: &mut dyn Rng) {
    match rng.random_range(0..8) {
        // Coincidences of positions.
        0 => {
            let from = shape.position(rng.random_range(0..8));
            shape.set_position(rng.random_range(0..8), from);
        }
        // Parallel edges, and points that move alike.
        1 => {
            let [a, b, c] = [(); 3].map(|()| shape.position(rng.random_range(0..8)));
            let position = [0, 1, 2].map(|axis| a[axis] + b[axis] - c[axis]);
            shape.set_position(rng.random_range(0..8), position);
        }
        // Of a size of its own.
        2 => {
            let factor = power(rng.random_range(-64..=64));
            let at = rng.random_range(0..8);
            let position = shape.position(at).map(|x| x * factor);
            shape.set_position(at, position);
        }
        3 if shape.radii[0] > 0.0 => {
            shape.radii[0] = number(rng, shape.radii[0], &shape.numbers).abs();
        }
        _ => {
            let at = rng.random_range(0..shape.numbers.len());
            // Adding 0 turns -0 into 0.
            shape.numbers[at] = number(rng, shape.numbers[at], &shape.numbers) + 0.0;
        }
    }
}

/// A number in place of another one.
fn number(rng: &mut dyn Rng, own: f64, others: &[f64]) -> f64 {
    let other = others[rng.random_range(0..others.len())];
    match rng.random_range(0..9) {
        0 => 0.0,
        1 => other,
        2 => -other,
        3 => own + other,
        4 => own * power(rng.random_range(-64..=64)),
        5 => significand(rng, own) * power(rng.random_range(EXPONENTS)),
        6 => own.next_up(),
        7 => own.next_down(),
        // Other bits from one on.
        _ => {
            let kept = rng.random_range(0..52);
            f64::from_bits(own.to_bits() ^ rng.random_range(0..1u64 << kept))
        }
    }
}

/// From 1 to 2 and of either sign: that of a number, or some bits.
fn significand(rng: &mut dyn Rng, number: f64) -> f64 {
    match rng.random_range(0..3) {
        0 => 1.0,
        1 => f64::from_bits(number.to_bits() & !(0x7ff << 52) | 1023 << 52),
        _ => f64::from_bits(rng.random_range(0..1u64 << 52) | 1023 << 52),
    }
}

/// `2^exponent`, for the exponents of finite numbers.
fn power(exponent: i32) -> f64 {
    let half = exponent / 2;
    2f64.powi(half) * 2f64.powi(exponent - half)
}

//! Coordinates as integers: multiples of one power of two, and vectors of them.

use super::dyadic::decompose;
use super::integer::Integer;
use crate::certified::motion::Vector;

pub(super) type Point = [Integer; 3];

/// The exponent of the largest power of two of which all these numbers are multiples; 0 if all are
/// 0.
pub(super) fn unit<'a>(numbers: impl Iterator<Item = &'a f64>) -> i32 {
    let parts = numbers.map(|x| decompose(*x));
    let used = parts.filter(|(mantissa, _)| *mantissa != 0);
    used.map(|(_, exponent)| exponent).min().unwrap_or(0)
}

/// The points in multiples of `2^unit`.
pub(super) fn in_unit<const N: usize>(points: &[Vector; N], unit: i32) -> [Point; N] {
    points.map(|point| point.map(|x| integer(x, unit)))
}

/// The sum of the radii in multiples of `2^unit`.
pub(super) fn radius_in_unit(radii: [f64; 2], unit: i32) -> Integer {
    let [first, second] = radii.map(|x| integer(x, unit));
    Integer::sum(&first, &second)
}

/// A number in multiples of `2^unit`.
pub(super) fn integer(x: f64, unit: i32) -> Integer {
    match decompose(x) {
        (0, _) => Integer::default(),
        (mantissa, exponent) => {
            let shift = exponent.abs_diff(unit);
            Integer::from(i128::from(mantissa)).shifted(shift.into())
        }
    }
}

pub(super) fn sub(x: &Point, y: &Point) -> Point {
    [0, 1, 2].map(|i| Integer::difference(&x[i], &y[i]))
}

pub(super) fn dot(x: &Point, y: &Point) -> Integer {
    let [a, b, c] = [0, 1, 2].map(|i| Integer::product(&x[i], &y[i]));
    Integer::sum(&Integer::sum(&a, &b), &c)
}

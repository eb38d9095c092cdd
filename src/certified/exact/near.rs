//! Whether two segments come within a radius of each other at one instant, in integers.
//!
//! With `K = B - A`, `L = D - C`, `M = C - A`, `N = K x L`, `n2 = N . N`, `f = M . N`,
//! `U = (M x L) . N` and `W = (M x K) . N`: where `n2 > 0`, the lines are `|f| / |N|` apart, in the
//! points `U / n2` and `W / n2`. So the segments are within `R` if
//!
//! ```text
//! n2 > 0 and f^2 <= R^2 n2 and 0 <= U <= n2 and 0 <= W <= n2
//! ```
//!
//! or an end `X` of one is within `R` of the other one, `YZ`: with `E = Z - Y` and `w = X - Y`,
//!
//! ```text
//! |X - Y|^2 <= R^2  or  |X - Z|^2 <= R^2  or  0 <= w . E <= E . E and |w x E|^2 <= R^2 E . E
//! ```
//!
//! where the last one may have `E = 0`: then it is the first one or says nothing. The nearest
//! points of two segments are inner points of both or one of them is an end.

use super::dyadic::decompose;
use super::integer::Integer;
use crate::certified::motion::Vector;

pub(super) type Point = [Integer; 3];

/// Whether the segments AB and CD are within the sum of two radii of each other.
pub(in crate::certified) fn are_near(points: &[Vector; 4], radii: [f64; 2]) -> bool {
    let ([a, b, c, d], radius) = scaled(points, radii);
    let square = Integer::product(&radius, &radius);
    let is_within = |squared: &Integer, unit: &Integer| *squared <= Integer::product(&square, unit);
    let is_end_near = |x: &Point, y: &Point, z: &Point| {
        let (w, e) = (sub(x, y), sub(z, y));
        let (s, e2, turn) = (dot(&w, &e), dot(&e, &e), cross(&w, &e));
        let one = Integer::from(1);
        let to_z = sub(x, z);
        is_within(&dot(&w, &w), &one)
            || is_within(&dot(&to_z, &to_z), &one)
            || !e2.is_zero() && is_fraction(&s, &e2) && is_within(&dot(&turn, &turn), &e2)
    };
    let (k, l, m) = (sub(&b, &a), sub(&d, &c), sub(&c, &a));
    let n = cross(&k, &l);
    let (n2, f) = (dot(&n, &n), dot(&m, &n));
    let are_inner_points_near = || {
        let (u, v) = (dot(&cross(&m, &l), &n), dot(&cross(&m, &k), &n));
        !n2.is_zero()
            && is_within(&Integer::product(&f, &f), &n2)
            && is_fraction(&u, &n2)
            && is_fraction(&v, &n2)
    };
    are_inner_points_near()
        || is_end_near(&a, &c, &d)
        || is_end_near(&b, &c, &d)
        || is_end_near(&c, &a, &b)
        || is_end_near(&d, &a, &b)
}

/// Whether `0 <= n <= d`.
fn is_fraction(n: &Integer, d: &Integer) -> bool {
    n.sign().is_ge() && n <= d
}

/// The points and the sum of the radii times one power of two.
fn scaled(points: &[Vector; 4], radii: [f64; 2]) -> ([Point; 4], Integer) {
    let unit = unit(points.iter().flatten().chain(&radii));
    (in_unit(points, unit), radius_in_unit(radii, unit))
}

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

fn cross(x: &Point, y: &Point) -> Point {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        Integer::difference(
            &Integer::product(&x[i], &y[j]),
            &Integer::product(&x[j], &y[i]),
        )
    })
}

pub(super) fn dot(x: &Point, y: &Point) -> Integer {
    let [a, b, c] = [0, 1, 2].map(|i| Integer::product(&x[i], &y[i]));
    Integer::sum(&Integer::sum(&a, &b), &c)
}

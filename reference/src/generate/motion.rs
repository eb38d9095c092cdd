//! What exact families have in common: a motion in integers, seen from anywhere, in metres.
//!
//! Contact, its time and its parameters stay the same under affine maps of space, under a
//! translation that changes steadily during the step, and under renaming of edges and ends. So a
//! family builds its motion where that is simple and has it moved about here. All of it is exact.

use nalgebra::{Matrix3, Vector3};
use rand::{Rng, RngExt};

/// The positions of the points at the start and at the end of the step: four are A, B, C and D.
pub(super) type Motion<T, const N: usize = 4> = [[Vector3<T>; N]; 2];

/// A vector with coordinates from `-reach` to `reach`.
pub(crate) fn vector(rng: &mut dyn Rng, reach: i32) -> Vector3<i32> {
    Vector3::from_fn(|_, _| rng.random_range(-reach..=reach))
}

/// A vector with coordinates from `[-reach, reach)`.
pub(super) fn real_vector(rng: &mut dyn Rng, reach: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| rng.random_range(-reach..reach))
}

/// A number from 1 to `reach`, of either sign.
pub(super) fn not_zero(rng: &mut dyn Rng, reach: i32) -> i32 {
    let number = rng.random_range(1..=reach);
    if rng.random() { number } else { -number }
}

/// A power of two, its exponent drawn evenly from the range.
pub(super) fn power_of_two(rng: &mut dyn Rng, exponents: std::ops::RangeInclusive<u32>) -> i32 {
    1 << rng.random_range(exponents)
}

/// The motion in a space [`mapped`] at random, carried along by a translation.
pub(super) fn placed<const N: usize>(rng: &mut dyn Rng, motion: Motion<i32, N>) -> Motion<i32, N> {
    let reach = largest(&motion);
    mapped(rng, motion).map(|points| {
        let origin = vector(rng, reach);
        points.map(|point| point + origin)
    })
}

/// The motion in a space mapped by a random matrix of determinant 1, with entries from -3 to 3.
pub(super) fn mapped<const N: usize>(rng: &mut dyn Rng, motion: Motion<i32, N>) -> Motion<i32, N> {
    let [a, b, c, d, e, f] = [(); 6].map(|()| rng.random_range(-1..=1));
    let map = Matrix3::new(1, 0, 0, a, 1, 0, b, c, 1) * Matrix3::new(1, d, e, 0, 1, f, 0, 0, 1);
    motion.map(|points| points.map(|point| map * point))
}

/// How much of a step is before a time and how much after it, in eighths or so: inside the step, and
/// of 4 at its start in 1 and at its end in 1.
pub(super) fn end_of_step_or_inside(rng: &mut dyn Rng) -> [i32; 2] {
    let [before, after] = [(); 2].map(|()| rng.random_range(1..=8));
    match rng.random_range(0..4) {
        0 => [0, after],
        1 => [before, 0],
        _ => [before, after],
    }
}

fn largest<const N: usize>(motion: &Motion<i32, N>) -> i32 {
    let points = motion.as_flattened().iter();
    points.map(Vector3::amax).max().unwrap_or(0)
}

/// The same edges under other names: the two exchanged or not, each reversed or not.
pub(super) fn renamed<T: Copy>(rng: &mut dyn Rng, motion: Motion<T>) -> Motion<T> {
    let [is_swapped, is_first_reversed, is_second_reversed] = [(); 3].map(|()| rng.random());
    motion.map(|[a, b, c, d]| {
        let (a, b) = if is_first_reversed { (b, a) } else { (a, b) };
        let (c, d) = if is_second_reversed { (d, c) } else { (c, d) };
        if is_swapped {
            [c, d, a, b]
        } else {
            [a, b, c, d]
        }
    })
}

/// The motion in metres, its largest coordinate between 1/4 m and 32 m.
pub(super) fn metres<const N: usize>(rng: &mut dyn Rng, motion: Motion<i32, N>) -> Motion<f64, N> {
    let bits = largest(&motion).max(1).ilog2() as i32;
    let unit = 2f64.powi(rng.random_range(-2..=4) - bits);
    in_units(motion, unit)
}

/// The motion with this unit for 1.
pub(super) fn in_units<const N: usize>(motion: Motion<i32, N>, unit: f64) -> Motion<f64, N> {
    motion.map(|points| points.map(|point| point.map(f64::from) * unit))
}

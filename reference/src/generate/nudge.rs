//! Motion off an exact one by a few units in the last place.

use nalgebra::Vector3;
use rand::{Rng, RngExt};

use super::motion::Motion;

/// The binary logarithm of the largest number of ulp.
const OCTAVES: u32 = 20;

/// A number of ulp from 0 to `2^20`, of either sign: 0 and each power of two with the numbers up to
/// the next are equally frequent.
pub(super) fn ulps(rng: &mut dyn Rng) -> i32 {
    let magnitude = match rng.random_range(0..=OCTAVES + 1) {
        0 => 0,
        octave => {
            let low = 1 << (octave - 1);
            (low + rng.random_range(0..low)).min(1 << OCTAVES)
        }
    };
    if rng.random() { magnitude } else { -magnitude }
}

/// The motion with some of its coordinates off by [`ulps`] each: one coordinate, the three of one
/// point at one end of the step, those of one point at both ends, or all.
pub(super) fn nudged<const N: usize>(rng: &mut dyn Rng, motion: Motion<f64, N>) -> Motion<f64, N> {
    let end = rng.random_range(0..2);
    let point = rng.random_range(0..N);
    let axis = rng.random_range(0..3);
    let chosen: fn([bool; 3]) -> bool = match rng.random_range(0..4) {
        0 => |[end, point, axis]| end && point && axis,
        1 => |[end, point, _]| end && point,
        2 => |[_, point, _]| point,
        _ => |_| true,
    };
    off_by(motion, |at| {
        let is_same = [at[0] == end, at[1] == point, at[2] == axis];
        if chosen(is_same) { ulps(rng) } else { 0 }
    })
}

/// The motion with the coordinate at `[end, point, axis]` off by so many ulp. An ulp is that of the
/// coordinate, and for 0 that of the largest coordinate.
pub(super) fn off_by<const N: usize>(
    mut motion: Motion<f64, N>,
    mut ulps: impl FnMut([usize; 3]) -> i32,
) -> Motion<f64, N> {
    let points = motion.as_flattened().iter();
    let largest = points.map(Vector3::amax).fold(0.0, f64::max);
    for (end, points) in motion.iter_mut().enumerate() {
        for (index, point) in points.iter_mut().enumerate() {
            for (axis, x) in point.iter_mut().enumerate() {
                let unit = ulp(if *x == 0.0 { largest } else { *x });
                *x += f64::from(ulps([end, index, axis])) * unit;
            }
        }
    }
    motion
}

/// The distance of a number to its neighbour away from 0.
fn ulp(number: f64) -> f64 {
    number.abs().next_up() - number.abs()
}

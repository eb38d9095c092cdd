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

/// The motion, [`nudged`] if so chosen.
pub(super) fn nudged_if(is_nudged: bool, rng: &mut dyn Rng, motion: Motion<f64>) -> Motion<f64> {
    if is_nudged {
        nudged(rng, motion)
    } else {
        motion
    }
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;

    #[test]
    fn ulps_are_of_every_magnitude_and_of_both_signs() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut counts: BTreeMap<(i32, u32), u32> = BTreeMap::new();
        let count = 44_000;
        for _ in 0..count {
            let k = ulps(&mut rng);
            assert!(k.unsigned_abs() <= 1 << OCTAVES);
            let octave = u32::BITS - k.unsigned_abs().leading_zeros();
            *counts.entry((k.signum(), octave)).or_default() += 1;
        }
        assert_eq!(counts.len() as u32, 1 + 2 * (OCTAVES + 1));
        assert!(counts.values().all(|n| *n > count / 50), "{counts:?}");
    }

    #[test]
    fn nudged_moves_one_coordinate_or_several_by_whole_ulps() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let exact: Motion<f64> = [[Vector3::new(1.0, -1.5, 0.0); 4]; 2];
        let mut counts: BTreeMap<usize, u32> = BTreeMap::new();
        for _ in 0..4000 {
            let pairs = nudged(&mut rng, exact);
            let pairs = pairs.as_flattened().iter().zip(exact.as_flattened());
            let moved: Vec<_> = pairs.flat_map(|(x, y)| <[f64; 3]>::from(x - y)).collect();
            // All three coordinates have the ulp of 1.
            let ulps = moved.iter().map(|by| by / f64::EPSILON);
            for k in ulps {
                assert!(k.fract() == 0.0 && k.abs() <= f64::from(1 << OCTAVES) * 2.0);
            }
            let number = moved.iter().filter(|by| **by != 0.0).count();
            *counts.entry(number).or_default() += 1;
        }
        for number in [0, 1, 3, 6, 24] {
            assert!(counts[&number] > 25, "{counts:?}");
        }
    }

    #[test]
    fn off_by_takes_the_ulp_of_the_coordinate_or_of_the_largest() {
        let exact: Motion<f64, 1> = [[Vector3::new(4.0, 1e-9, 0.0)]; 2];
        let [_, [x]] = off_by(exact, |[end, ..]| end as i32);
        let expected = [4f64.next_up(), 1e-9f64.next_up(), 4f64.next_up() - 4.0];
        assert_eq!(x.as_slice(), expected);
    }
}

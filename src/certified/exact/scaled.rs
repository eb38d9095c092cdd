//! The motion of a query as integers.
//!
//! All coordinates times one power of two are integers, and every predicate of contact is
//! homogeneous in the coordinate differences: scaling them does not change its sign, nor the time
//! and the parameters of the contact.

use crate::certified::motion::Positions;

use super::dyadic::{decompose, parts};
use super::integer::Integer;

/// How many numbers describe the motion: three vectors, each at the start and its change.
pub(super) const COUNT: usize = 18;

/// `K = B - A`, `L = D - C` and `M = C - A`, each as the three components at `t = 0` and then the
/// three components of the change from `t = 0` to `t = 1`.
pub(super) enum Scaled {
    /// All of them below `2^bits` in magnitude, in one word each.
    Short {
        /// The components.
        values: [i64; COUNT],
        /// The number of bits, at most 63.
        bits: u32,
    },
    /// All of them below `2^bits` in magnitude.
    Narrow {
        /// The components.
        values: [i128; COUNT],
        /// The number of bits.
        bits: u32,
    },
    /// Of any size.
    Broad(Box<[Integer; COUNT]>),
}

/// The widest range of coordinates in bits for which differences of differences fit into `i64`.
const SHORT: i32 = 61;

/// The same for `i128`.
const NARROW: i32 = 125;

impl Scaled {
    /// The motion of four points, exactly.
    pub(super) fn new(positions: &Positions) -> Self {
        let coordinates = coordinates(positions);
        let (lowest, width) = span(&coordinates);
        if width <= SHORT && (-1023..=0).contains(&lowest) {
            Scaled::short(&coordinates, lowest)
        } else if width <= NARROW {
            let integer = |(mantissa, exponent): (i64, i32)| {
                // 0 has an exponent of its own.
                i128::from(mantissa) << (exponent - lowest).max(0)
            };
            Scaled::narrow(&coordinates.map(|value| integer(parts(value))))
        } else {
            Scaled::reduced(&coordinates)
        }
    }

    /// From coordinates below `2^61` after division by `2^lowest`, which is exact: their
    /// differences are below `2^62` and the changes of those below `2^63`.
    fn short(coordinates: &[f64; 24], lowest: i32) -> Self {
        let factor = f64::from_bits(((1023 - lowest) as u64) << 52);
        let integers = coordinates.map(|value| (value * factor) as i64);
        let values = differences(&integers, |a, b| a - b);
        let ones = values.iter().fold(0, |all, value| all | value);
        let values = values.map(|value| value >> (ones.trailing_zeros() & 63));
        let magnitudes = values
            .iter()
            .fold(0, |all, value| all | value.unsigned_abs());
        let bits = u64::BITS - magnitudes.leading_zeros();
        Scaled::Short { values, bits }
    }

    /// From coordinates below `2^125`: as [`short`](Self::short).
    fn narrow(coordinates: &[i128; 24]) -> Self {
        let values = differences(coordinates, |a, b| a - b);
        let ones = values.iter().fold(0, |all, value| all | value);
        let values = values.map(|value| value >> (ones.trailing_zeros() & 127));
        let magnitudes = values
            .iter()
            .fold(0, |all, value| all | value.unsigned_abs());
        let bits = u128::BITS - magnitudes.leading_zeros();
        Scaled::Narrow { values, bits }
    }

    /// From the odd parts of the mantissas.
    fn reduced(coordinates: &[f64; 24]) -> Self {
        let parts = coordinates.map(decompose);
        let used = parts.iter().filter(|(mantissa, _)| *mantissa != 0);
        let lengths = used.clone().map(|(mantissa, exponent)| {
            exponent + 64 - mantissa.unsigned_abs().leading_zeros() as i32
        });
        let lowest = used.map(|(_, exponent)| *exponent).min().unwrap_or(0);
        if lengths.max().unwrap_or(0) - lowest <= NARROW {
            let integer = |(mantissa, exponent): (i64, i32)| match mantissa {
                0 => 0,
                _ => i128::from(mantissa) << (exponent - lowest),
            };
            Scaled::narrow(&parts.map(integer))
        } else {
            Scaled::broad(&parts, lowest)
        }
    }

    #[inline(never)]
    fn broad(parts: &[(i64, i32); 24], lowest: i32) -> Self {
        let coordinates = parts.map(|(mantissa, exponent)| {
            let shift = if mantissa == 0 {
                0
            } else {
                exponent.abs_diff(lowest)
            };
            Integer::from(i128::from(mantissa)).shifted(shift.into())
        });
        Scaled::Broad(Box::new(differences(&coordinates, Integer::difference)))
    }
}

/// The least exponent of the coordinates' mantissas as integers of 53 bits, and the number of bits
/// from there to the highest one.
fn span(coordinates: &[f64; 24]) -> (i32, i32) {
    let magnitudes = coordinates.map(f64::abs);
    let largest = magnitudes
        .iter()
        .fold(0.0, |a, &b| if b > a { b } else { a });
    // 0 has the least exponent of all, which does not count.
    let least = magnitudes.iter().fold(largest, |a, &b| {
        let counts = if b == 0.0 { largest } else { b };
        if counts < a { counts } else { a }
    });
    let ((_, lowest), (_, highest)) = (parts(least), parts(largest));
    (lowest, highest + 53 - lowest)
}

/// The coordinates of the points at `t = 0` and then at `t = 1`.
fn coordinates(positions: &Positions) -> [f64; 24] {
    let mut coordinates = [0.0; 24];
    let points = positions.start.iter().chain(&positions.end);
    for (own, point) in coordinates.chunks_exact_mut(3).zip(points) {
        own.copy_from_slice(point);
    }
    coordinates
}

/// The components of `K`, `L` and `M` at the start and their changes, from the coordinates of the
/// points at `t = 0` and `t = 1`.
#[inline]
fn differences<Z: Default>(coordinates: &[Z; 24], difference: impl Fn(&Z, &Z) -> Z) -> [Z; COUNT] {
    const ENDS: [(usize, usize); 3] = [(1, 0), (3, 2), (2, 0)];
    let mut components: [Z; COUNT] = Default::default();
    for (six, (to, from)) in components.chunks_exact_mut(6).zip(ENDS) {
        for axis in 0..3 {
            let at = |time: usize| {
                let point = |point: usize| &coordinates[12 * time + 3 * point + axis];
                difference(point(to), point(from))
            };
            let start = at(0);
            six[3 + axis] = difference(&at(1), &start);
            six[axis] = start;
        }
    }
    components
}

#[cfg(test)]
mod tests;

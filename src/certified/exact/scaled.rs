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
    /// All of them below `2^bits` in magnitude.
    Narrow {
        /// The components.
        values: [i128; COUNT],
        /// The number of bits.
        bits: u32,
    },
    /// Of any size.
    Broad([Integer; COUNT]),
}

/// The widest range of coordinates in bits for which differences of differences fit into `i128`.
const NARROW: i32 = 125;

impl Scaled {
    /// The motion of four points, exactly.
    pub(super) fn new(positions: &Positions) -> Self {
        let coordinates = coordinates(positions);
        // 0 has the least exponent of all, which does not count.
        let (mut lowest, mut highest) = (i32::MAX, i32::MIN);
        for &value in &coordinates {
            let (_, exponent) = parts(value);
            lowest = lowest.min(if value == 0.0 { i32::MAX } else { exponent });
            highest = highest.max(exponent);
        }
        let lowest = lowest.min(highest);
        if highest + 53 - lowest <= NARROW {
            let mut integers = [0; 24];
            for (integer, &value) in integers.iter_mut().zip(&coordinates) {
                let (mantissa, exponent) = parts(value);
                // 0 has an exponent of its own.
                *integer = i128::from(mantissa) << (exponent - lowest).max(0);
            }
            return Scaled::narrow(&integers);
        }
        Scaled::reduced(&coordinates)
    }

    /// The same without the zeros at the ends of the mantissas.
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

    /// From coordinates below `2^125`: their differences are below `2^126` and the changes of those
    /// below `2^127`.
    fn narrow(coordinates: &[i128; 24]) -> Self {
        let mut values = differences(coordinates, |a, b| a - b);
        let all = values.iter().fold(0, |all, value| all | value);
        if all != 0 {
            let zeros = all.trailing_zeros();
            values = values.map(|value| value >> zeros);
        }
        let magnitudes = values
            .iter()
            .fold(0, |all, value| all | value.unsigned_abs());
        let bits = 128 - magnitudes.leading_zeros();
        Scaled::Narrow { values, bits }
    }

    fn broad(parts: &[(i64, i32); 24], lowest: i32) -> Self {
        let coordinates = parts.map(|(mantissa, exponent)| {
            let shift = if mantissa == 0 {
                0
            } else {
                exponent.abs_diff(lowest)
            };
            Integer::from(i128::from(mantissa)).shifted(shift.into())
        });
        Scaled::Broad(differences(&coordinates, Integer::difference))
    }
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

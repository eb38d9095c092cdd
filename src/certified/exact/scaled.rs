//! The motion of a query as integers.
//!
//! All coordinates times one power of two are integers, and every predicate of contact is
//! homogeneous in the coordinate differences: scaling them does not change its sign, nor the time
//! and the parameters of the contact.

use crate::certified::motion::Positions;

use super::dyadic::decompose;
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
        let mut parts = [(0, 0); 24];
        let (mut lowest, mut highest) = (i32::MAX, i32::MIN);
        let values = positions.start.iter().chain(&positions.end).flatten();
        for (part, &value) in parts.iter_mut().zip(values) {
            *part = decompose(value);
            let (mantissa, exponent) = *part;
            if mantissa != 0 {
                let length = 64 - mantissa.unsigned_abs().leading_zeros() as i32;
                lowest = lowest.min(exponent);
                highest = highest.max(exponent + length);
            }
        }
        if highest.saturating_sub(lowest) > NARROW {
            return Scaled::broad(&parts, lowest);
        }
        let integer = |(mantissa, exponent): (i64, i32)| match mantissa {
            0 => 0,
            _ => i128::from(mantissa) << (exponent - lowest),
        };
        Scaled::narrow(&parts.map(integer))
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

/// The components of `K`, `L` and `M` at the start and their changes, from the coordinates of the
/// points at `t = 0` and `t = 1`.
fn differences<Z>(coordinates: &[Z; 24], difference: impl Fn(&Z, &Z) -> Z) -> [Z; COUNT] {
    const ENDS: [(usize, usize); 3] = [(1, 0), (3, 2), (2, 0)];
    std::array::from_fn(|i| {
        let (to, from) = ENDS[i / 6];
        let axis = i % 3;
        let at = |time: usize| {
            let point = |point: usize| &coordinates[12 * time + 3 * point + axis];
            difference(point(to), point(from))
        };
        if i % 6 < 3 {
            at(0)
        } else {
            difference(&at(1), &at(0))
        }
    })
}

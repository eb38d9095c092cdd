//! The distance at which two wires count as touching.

use std::fmt;

use super::shown::Short;

/// The sum of two radii in metres, as of two wires. The sum is meant exactly: it is never rounded.
///
/// A query is refused unless both are finite and not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Radius {
    parts: [f64; 2],
}

impl Radius {
    /// The midlines themselves.
    pub const ZERO: Radius = Radius { parts: [0.0; 2] };

    /// The two numbers whose exact sum it is.
    pub fn parts(&self) -> [f64; 2] {
        self.parts
    }

    /// Whether it is 0.
    #[inline]
    pub fn is_zero(&self) -> bool {
        self.parts == [0.0; 2]
    }

    /// The sum, rounded to the nearest `f64`; infinite if it is beyond the largest.
    pub fn rounded(&self) -> f64 {
        self.parts[0] + self.parts[1]
    }

    /// At least this and a distance.
    #[inline]
    pub(crate) fn beyond(&self, distance: f64) -> Self {
        let [first, second] = self.parts;
        let sum = if first == 0.0 || second == 0.0 {
            first + second
        } else {
            (first + second).next_up()
        };
        [sum, distance].into()
    }

    /// Whether both radii are finite and not negative.
    pub(crate) fn is_valid(&self) -> bool {
        self.parts
            .iter()
            .all(|part| part.is_finite() && *part >= 0.0)
    }
}

impl From<f64> for Radius {
    fn from(radius: f64) -> Self {
        [radius, 0.0].into()
    }
}

impl From<[f64; 2]> for Radius {
    fn from(parts: [f64; 2]) -> Self {
        Radius { parts }
    }
}

impl fmt::Display for Radius {
    /// The number, or the two whose sum it is.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.parts {
            [radius, 0.0] => Short(radius).fmt(f),
            [first, second] => write!(f, "{} + {}", Short(first), Short(second)),
        }
    }
}

//! The distance at which two wires count as touching.

use std::fmt;

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
    pub fn is_zero(&self) -> bool {
        self.parts == [0.0; 2]
    }

    /// The sum, rounded to the nearest `f64`; infinite if it is beyond the largest.
    pub fn rounded(&self) -> f64 {
        self.parts[0] + self.parts[1]
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

/// A number in an error or a table: with an exponent where it would have many digits.
pub(crate) struct Short(pub(crate) f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Short(value) = *self;
        let is_ordinary = (1e-6..1e16).contains(&value.abs()) || !value.is_finite();
        match value {
            // Of either sign.
            0.0 => f.write_str("0"),
            _ if is_ordinary => write!(f, "{value}"),
            _ => write!(f, "{value:e}"),
        }
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

//! Numbers as errors show them.

use std::fmt;

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

/// How many there are of something.
pub(crate) struct Counted(
    pub(crate) usize,
    pub(crate) &'static str,
    pub(crate) &'static str,
);

impl Counted {
    pub(crate) fn verb(&self) -> &'static str {
        if self.0 == 1 { "is" } else { "are" }
    }
}

impl fmt::Display for Counted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Counted(count, one, many) = *self;
        write!(f, "{count} {}", if count == 1 { one } else { many })
    }
}

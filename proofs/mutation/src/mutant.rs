//! Changes of the sources.

use serde::{Deserialize, Serialize};

/// A change of the sources.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Mutant {
    pub id: u32,
    /// The place that has it, which may have others.
    pub site: u32,
    pub file: String,
    pub line: usize,
    pub column: usize,
    pub function: String,
    pub kind: Kind,
    /// What it does, as `a + b -> a - b`.
    pub what: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A number in floating point is 0, half of what it is, or twice that.
    Constant,
    /// Another operation of two values.
    Operator,
    /// `-` or `!` is left out.
    Unary,
    /// A function returns a constant at once.
    Body,
    /// An arm of a match is left out, or its condition is always met or never.
    Arm,
}

impl Kind {
    pub const ALL: [Self; 5] = [
        Self::Constant,
        Self::Operator,
        Self::Unary,
        Self::Body,
        Self::Arm,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Operator => "operator",
            Self::Unary => "unary",
            Self::Body => "body",
            Self::Arm => "arm",
        }
    }
}

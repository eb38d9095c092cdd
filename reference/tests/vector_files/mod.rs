//! What the tests of the vectors know of them, from the JSON alone.

pub(crate) mod rational;
pub(crate) mod reader;

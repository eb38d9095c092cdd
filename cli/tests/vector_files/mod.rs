//! What the tests of the vectors know of them, from the JSON alone.

pub(crate) mod rational;
pub(crate) mod reader;

/// That something is so, or else what is wrong.
pub(crate) fn says(what: &str, is_so: bool) -> Result<(), String> {
    is_so.then_some(()).ok_or_else(|| what.to_owned())
}

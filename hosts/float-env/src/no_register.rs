//! Targets whose register is not known, or that have none.

/// Nothing.
pub(crate) type Word = u8;

pub(crate) const CONTROL: Word = 0;

pub(crate) const DEFAULT: Word = 0;

/// Always the default.
pub(crate) fn read() -> Word {
    DEFAULT
}

/// Does nothing.
///
/// # Safety
///
/// As of the other targets.
pub(crate) unsafe fn write(_: Word) {}

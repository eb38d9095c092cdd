//! The numbers of the layout.

use crate::wire::file::Format;

/// The version of the layout that is written, and the only one that is read.
pub const VERSION: u32 = 10;

/// The most bytes that a header or step may unpack to: half a million nodes.
pub const MOST_BYTES: u32 = 1 << 25;

pub(super) const FORMAT: Format = Format {
    name: *b"tpsteps\0",
    what: "recording of steps",
    version: VERSION,
    most_bytes: MOST_BYTES,
};

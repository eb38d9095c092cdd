//! Files of parts, each with a length and a checksum: what recordings and states are made of.
//!
//! Such a file is a series of zstd frames, so `zstd -t` checks it and `zstd -dc` unpacks it:
//!
//! | part | bytes |
//! | --- | --- |
//! | opening, a skippable frame | `5e 2a 4d 18`, `0c 00 00 00`, the name of the format in 8 bytes, version |
//! | label, a skippable frame | `5d 2a 4d 18`, `0c 00 00 00`, packed length, length, checksum |
//! | zstd frame of the packed length | a part as [postcard](https://postcard.jamesmunns.com/wire-format) |
//!
//! Numbers of the labels and the version are 32 bits, little-endian. The checksum is the CRC-32
//! (IEEE) of the unpacked bytes, so it also finds faults of packing and unpacking.
//!
//! Reading never panics, whatever the bytes are. It takes memory in proportion to the bytes that
//! are there, and for packed bytes that were made up, at most in proportion to the most bytes that
//! the format lets a part have.

mod error;
mod format;
mod frame;
#[cfg(test)]
pub(super) mod testing;

pub use error::{Fault, ReadError, WriteError};
pub(super) use format::Format;
#[cfg(test)]
pub(super) use frame::LABEL;

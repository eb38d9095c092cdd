//! Steps in a file: what a [`Recorder`] writes, a [`Recording`] reads back bit for bit.
//!
//! A recording is a series of zstd frames, so `zstd -t` checks it and `zstd -dc` unpacks it:
//!
//! | part | bytes |
//! | --- | --- |
//! | opening, a skippable frame | `5e 2a 4d 18`, `0c 00 00 00`, `tpsteps` and a 0, version |
//! | label, a skippable frame | `5d 2a 4d 18`, `0c 00 00 00`, packed length, length, checksum |
//! | zstd frame of the packed length | the [`Header`] as [postcard](https://postcard.jamesmunns.com/wire-format) |
//! | label and zstd frame, for every step | its `StepRecord` as postcard |
//!
//! Numbers of the labels and the version are 32 bits, little-endian. The checksum is the CRC-32
//! (IEEE) of the unpacked bytes, so it also finds faults of packing and unpacking.
//!
//! Each step is written by one call and stands by itself. After a crash, in the middle of a write
//! too, everything up to the last whole step reads back; then comes a [`ReadError`], which tells
//! where the rest starts and what is wrong with it. Reading never panics, whatever the bytes are.
//! It takes memory in proportion to the bytes that are there, and for packed bytes that were made
//! up, at most in proportion to [`MOST_BYTES`].
//!
//! ```
//! use tunnelproof::wire::recording::{Recorder, Recording};
//! use tunnelproof::wire::{Settings, World};
//!
//! let mut world = World::new(Settings::default())?;
//! let mut recorder = Recorder::new(Vec::new(), &world)?;
//! let record = world.step(&[])?;
//! recorder.record(&record)?;
//! let file = recorder.into_inner();
//!
//! let mut recording = Recording::open(file.as_slice())?;
//! assert_eq!(&recording.header().settings, world.settings());
//! assert_eq!(recording.next(), Some(Ok(record)));
//! assert_eq!(recording.next(), None);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod header;
mod layout;
mod reader;
mod writer;

pub use super::file::{Fault, ReadError, WriteError};
pub use header::{BodySummary, Header, WireSummary};
pub use layout::{MOST_BYTES, VERSION};
pub use reader::Recording;
pub use writer::Recorder;

#[cfg(test)]
mod tests;

//! What goes wrong with recordings.

use std::{fmt, io};

use super::layout::MOST_BYTES;
use super::layout::VERSION;

/// A recording that cannot be read on.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// The byte of the file at which the part starts that is not sound. All before it was read; a
    /// file cut here is sound.
    pub offset: u64,
    /// What is wrong with it.
    pub fault: Fault,
}

/// What is wrong with a part of a recording.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// The source failed.
    Io(io::ErrorKind),
    /// The file ends within the part.
    Cut,
    /// The file does not start like a recording.
    Opening,
    /// A layout that is not known.
    Version(u32),
    /// What stands here is not the label of a header or step.
    Label,
    /// The label tells of more bytes than a step may have.
    TooLong(u32),
    /// It does not unpack.
    Packing(String),
    /// It unpacks to another number of bytes than the label says.
    Length {
        /// By the label.
        expected: u32,
        /// Unpacked; no more than one above is counted.
        found: usize,
    },
    /// Its checksum is not that of the label.
    Checksum {
        /// By the label.
        expected: u32,
        /// Of the bytes that are there.
        found: u32,
    },
    /// It is sound, but not a header or step as this version knows them.
    Content(String),
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: ", self.offset)?;
        match &self.fault {
            Fault::Io(kind) => write!(f, "cannot be read: {kind}"),
            Fault::Cut => write!(f, "the file ends within what starts here"),
            Fault::Opening => write!(f, "not a recording of steps"),
            Fault::Version(found) => {
                write!(f, "version {found} of the layout; only {VERSION} is known")
            }
            Fault::Label => write!(f, "no step starts here"),
            Fault::TooLong(length) => {
                write!(f, "a step of {length} bytes; at most {MOST_BYTES} are read")
            }
            Fault::Packing(reason) => write!(f, "does not unpack: {reason}"),
            Fault::Length { expected, found } => {
                write!(f, "unpacks to {found} bytes or more instead of {expected}")
            }
            Fault::Checksum { expected, found } => {
                write!(
                    f,
                    "its checksum is {found:#010x} instead of {expected:#010x}"
                )
            }
            Fault::Content(reason) => write!(f, "is sound but no header or step: {reason}"),
        }
    }
}

impl std::error::Error for ReadError {}

/// A step that was not written.
#[derive(Debug)]
#[non_exhaustive]
pub enum WriteError {
    /// The sink failed. What it took of the step, if anything, will be the unsound end of the
    /// recording.
    Io(io::Error),
    /// The step has more than [`MOST_BYTES`](super::MOST_BYTES) bytes; nothing was written.
    TooLong(usize),
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            WriteError::Io(error) => write!(f, "the recording cannot be written: {error}"),
            WriteError::TooLong(length) => {
                write!(
                    f,
                    "a step of {length} bytes; at most {MOST_BYTES} are recorded"
                )
            }
        }
    }
}

impl std::error::Error for WriteError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            WriteError::Io(error) => Some(error),
            WriteError::TooLong(_) => None,
        }
    }
}

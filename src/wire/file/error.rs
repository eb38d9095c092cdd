//! What goes wrong with files.

use std::{fmt, io};

use crate::wire::model::ModelError;

/// A file that cannot be read, or not farther.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadError {
    /// The byte of the file at which the part starts that is not sound. All before it was read; a
    /// file cut here is sound.
    pub offset: u64,
    /// What is wrong with it.
    pub fault: Fault,
}

/// What is wrong with a part of a file.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// The source failed.
    Io(io::ErrorKind),
    /// The file ends within the part.
    Cut,
    /// The file does not start like what it was opened as.
    Opening(&'static str),
    /// A layout that is not known.
    Version {
        /// By the file.
        found: u32,
        /// The only one that is.
        known: u32,
    },
    /// What stands here is not the label of a part.
    Label,
    /// The label tells of more bytes than a part may have.
    TooLong {
        /// By the label.
        length: u32,
        /// How many it may have.
        most_bytes: u32,
    },
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
    /// It is sound, but not what belongs here as this version knows it.
    Content(String),
    /// It is what belongs here, but with a value that no world has.
    Value {
        /// Where: `wires[0].nodes[3]`.
        path: String,
        /// What is wrong there.
        error: ModelError,
    },
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: ", self.offset)?;
        match &self.fault {
            Fault::Io(kind) => write!(f, "cannot be read: {kind}"),
            Fault::Cut => write!(f, "the file ends within what starts here"),
            Fault::Opening(what) => write!(f, "this is no {what}"),
            Fault::Version { found, known } => {
                write!(f, "version {found} of the layout; only {known} is known")
            }
            Fault::Label => write!(f, "no part of the file starts here"),
            Fault::TooLong { length, most_bytes } => {
                write!(f, "a part of {length} bytes; at most {most_bytes} are read")
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
            Fault::Content(reason) => write!(f, "is sound but not what belongs here: {reason}"),
            Fault::Value { path, error } if path.is_empty() => error.fmt(f),
            Fault::Value { path, error } => write!(f, "{path}: {error}"),
        }
    }
}

impl std::error::Error for ReadError {}

/// A part that was not written.
#[derive(Debug)]
#[non_exhaustive]
pub enum WriteError {
    /// The sink failed. What it took of the part, if anything, will be the unsound end of the
    /// file.
    Io(io::Error),
    /// The part has more bytes than it may; nothing of it was written.
    TooLong {
        /// How many it has.
        length: usize,
        /// How many it may have.
        most_bytes: u32,
    },
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            WriteError::Io(error) => write!(f, "cannot be written: {error}"),
            WriteError::TooLong { length, most_bytes } => {
                write!(
                    f,
                    "a part of {length} bytes; at most {most_bytes} are written"
                )
            }
        }
    }
}

impl std::error::Error for WriteError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            WriteError::Io(error) => Some(error),
            WriteError::TooLong { .. } => None,
        }
    }
}

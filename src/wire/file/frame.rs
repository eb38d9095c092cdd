//! One part as bytes: a label and a zstd frame.

use std::io::Read;

use ruzstd::decoding::StreamingDecoder;
use ruzstd::encoding::{CompressionLevel, compress_to_vec};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::error::{Fault, WriteError};

/// The largest window of a zstd frame that is read; those that are written have 128 KiB.
const LARGEST_WINDOW: u64 = 1 << 20;

/// Length of a label and of the opening of a file.
pub(in crate::wire) const LABEL: usize = 20;

/// How a label starts: the magic number of a skippable zstd frame, and the length of the rest.
const START: [u8; 8] = [0x5d, 0x2a, 0x4d, 0x18, 12, 0, 0, 0];

/// What stands before a zstd frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Label {
    /// Bytes of the zstd frame.
    pub(super) packed: u32,
    /// Bytes that it unpacks to.
    length: u32,
    /// CRC-32 of these.
    checksum: u32,
}

impl Label {
    /// Refuses what has more bytes than a part may.
    pub(super) fn read(bytes: &[u8; LABEL], most_bytes: u32) -> Result<Self, Fault> {
        if bytes[..START.len()] != START {
            return Err(Fault::Label);
        }
        let number = |at: usize| {
            let four = [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
            u32::from_le_bytes(four)
        };
        let label = Label {
            packed: number(8),
            length: number(12),
            checksum: number(16),
        };
        match label.packed.max(label.length) {
            length if length > most_bytes => Err(Fault::TooLong { length, most_bytes }),
            _ => Ok(label),
        }
    }

    fn write(&self, bytes: &mut Vec<u8>) {
        bytes.extend(START);
        for number in [self.packed, self.length, self.checksum] {
            bytes.extend(number.to_le_bytes());
        }
    }
}

/// Label and zstd frame of a part.
pub(super) fn pack(content: &impl Serialize, most_bytes: u32) -> Result<Vec<u8>, WriteError> {
    let too_long = |length: usize| WriteError::TooLong { length, most_bytes };
    // Postcard fails on sequences of unknown length only, which no part has.
    let plain = postcard::to_stdvec(content)
        .map_err(|error| WriteError::Io(std::io::Error::other(error)))?;
    let packed = compress_to_vec(plain.as_slice(), CompressionLevel::Fastest);
    let within = |length: usize| {
        let length = u32::try_from(length).ok();
        length.filter(|length| *length <= most_bytes)
    };
    let label = Label {
        packed: within(packed.len()).ok_or(too_long(packed.len()))?,
        length: within(plain.len()).ok_or(too_long(plain.len()))?,
        checksum: crc32fast::hash(&plain),
    };
    let mut bytes = Vec::with_capacity(LABEL + packed.len());
    label.write(&mut bytes);
    bytes.extend(packed);
    Ok(bytes)
}

/// The part in a zstd frame.
pub(super) fn unpack<T: DeserializeOwned>(label: &Label, packed: &[u8]) -> Result<T, Fault> {
    let plain = plain_bytes(label.length, packed)?;
    let found = crc32fast::hash(&plain);
    if found != label.checksum {
        let expected = label.checksum;
        return Err(Fault::Checksum { expected, found });
    }
    match postcard::take_from_bytes(&plain) {
        Ok((content, [])) => Ok(content),
        Ok((_, rest)) => Err(Fault::Content(format!("{} bytes are left", rest.len()))),
        Err(error) => Err(Fault::Content(error.to_string())),
    }
}

fn plain_bytes(length: u32, packed: &[u8]) -> Result<Vec<u8>, Fault> {
    let mut rest = packed;
    let mut decoder = StreamingDecoder::new_with_max_window_size(&mut rest, LARGEST_WINDOW)
        .map_err(|error| Fault::Packing(error.to_string()))?;
    let mut plain = Vec::new();
    decoder
        .by_ref()
        .take(u64::from(length) + 1)
        .read_to_end(&mut plain)
        .map_err(|error| Fault::Packing(error.to_string()))?;
    if plain.len() != length as usize {
        let found = plain.len();
        return Err(Fault::Length {
            expected: length,
            found,
        });
    }
    if !rest.is_empty() {
        let reason = format!("{} bytes after its end", rest.len());
        return Err(Fault::Packing(reason));
    }
    Ok(plain)
}

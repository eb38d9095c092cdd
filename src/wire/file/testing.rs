//! Files that are changed by hand.

use proptest::prelude::*;
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

/// Label and packed bytes, with the length and the checksum that they should have.
pub(in crate::wire) fn forged(plain: &[u8]) -> Vec<u8> {
    let packed = compress_to_vec(plain, CompressionLevel::Fastest);
    labelled(&packed, plain.len() as u32, crc32fast::hash(plain))
}

pub(in crate::wire) fn labelled(packed: &[u8], length: u32, checksum: u32) -> Vec<u8> {
    let mut bytes = b"\x5d\x2a\x4d\x18\x0c\0\0\0".to_vec();
    for number in [packed.len() as u32, length, checksum] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(packed);
    bytes
}

/// Changes to a file: at a place, so many bytes are replaced by others.
pub(in crate::wire) type Edits = Vec<(usize, usize, Vec<u8>)>;

pub(in crate::wire) fn edits() -> impl Strategy<Value = Edits> {
    let edit = (
        any::<usize>(),
        0..40_usize,
        prop::collection::vec(any::<u8>(), 0..40),
    );
    prop::collection::vec(edit, 1..4)
}

pub(in crate::wire) fn edited(mut bytes: Vec<u8>, edits: Edits) -> Vec<u8> {
    for (at, count, new) in edits {
        let at = at % (bytes.len() + 1);
        let end = bytes.len().min(at + count);
        bytes.splice(at..end, new);
    }
    bytes
}

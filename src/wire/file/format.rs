//! A format, and the files that are of it.

use std::io::Read;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::error::{Fault, WriteError};
use super::frame::{LABEL, Label, pack, unpack};

/// How a file starts: the magic number of a skippable zstd frame, and the length of the rest.
const START: [u8; 8] = [0x5e, 0x2a, 0x4d, 0x18, 12, 0, 0, 0];

/// What files of one kind have in common.
pub(in crate::wire) struct Format {
    /// In the opening.
    pub(in crate::wire) name: [u8; 8],
    /// In words.
    pub(in crate::wire) what: &'static str,
    /// The version of the layout that is written, and the only one that is read.
    pub(in crate::wire) version: u32,
    /// The most bytes that a part may unpack to.
    pub(in crate::wire) most_bytes: u32,
}

impl Format {
    /// Length of the opening.
    pub(in crate::wire) const OPENING: u64 = LABEL as u64;

    /// How a file starts.
    pub(in crate::wire) fn opening(&self) -> Vec<u8> {
        [&START[..], &self.name, &self.version.to_le_bytes()].concat()
    }

    /// Reads how a file starts.
    pub(in crate::wire) fn read_opening(&self, source: &mut impl Read) -> Result<(), Fault> {
        let bytes = read(source, LABEL)?;
        let expected = self.opening();
        let (start, version) = bytes.split_at(bytes.len().min(LABEL - 4));
        if !expected.starts_with(start) {
            return Err(Fault::Opening(self.what));
        }
        let version = version.try_into().map_err(|_| Fault::Cut)?;
        match u32::from_le_bytes(version) {
            version if version == self.version => Ok(()),
            found => Err(Fault::Version {
                found,
                known: self.version,
            }),
        }
    }

    /// A part as it stands in a file.
    pub(in crate::wire) fn pack(&self, content: &impl Serialize) -> Result<Vec<u8>, WriteError> {
        pack(content, self.most_bytes)
    }

    /// The next part of a file, and how many bytes it takes; `None` at the end of the file.
    pub(in crate::wire) fn part<T: DeserializeOwned>(
        &self,
        source: &mut impl Read,
    ) -> Result<Option<(T, u64)>, Fault> {
        let label = read(source, LABEL)?;
        if label.is_empty() {
            return Ok(None);
        }
        let label = label.as_slice().try_into().map_err(|_| Fault::Cut)?;
        let label = Label::read(label, self.most_bytes)?;
        let packed = read(source, label.packed as usize)?;
        if packed.len() < label.packed as usize {
            return Err(Fault::Cut);
        }
        let length = (LABEL + packed.len()) as u64;
        Ok(Some((unpack(&label, &packed)?, length)))
    }

    /// Sees to it that the file ends here.
    pub(in crate::wire) fn read_end(&self, source: &mut impl Read) -> Result<(), Fault> {
        let rest = read(source, 1)?;
        if !rest.is_empty() {
            let reason = format!("more bytes after the {}", self.what);
            return Err(Fault::Content(reason));
        }
        Ok(())
    }
}

/// So many bytes, or as many as there are.
fn read(source: &mut impl Read, count: usize) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    source
        .take(count as u64)
        .read_to_end(&mut bytes)
        .map_err(|error| Fault::Io(error.kind()))?;
    Ok(bytes)
}

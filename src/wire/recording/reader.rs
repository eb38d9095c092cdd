//! Reading a recording.

use std::io::Read;

use serde::de::DeserializeOwned;

use super::error::{Fault, ReadError};
use super::frame::{LABEL, Label, unpack};
use super::header::Header;
use super::layout::VERSION;
use super::writer::OPENING;
use crate::wire::StepRecord;

/// A recording that is read step by step. After an error there are no more steps.
#[derive(Debug)]
pub struct Recording<R> {
    source: R,
    header: Header,
    /// Where the next part starts.
    offset: u64,
    ended: bool,
}

impl<R: Read> Recording<R> {
    /// Reads the header.
    ///
    /// # Errors
    ///
    /// The file is not a recording, is of another version, or its header is not sound.
    pub fn open(mut source: R) -> Result<Self, ReadError> {
        let at = |offset: u64| move |fault: Fault| ReadError { offset, fault };
        opening(&mut source).map_err(at(0))?;
        let start = LABEL as u64;
        let (header, length) = part(&mut source)
            .and_then(|part| part.ok_or(Fault::Cut))
            .map_err(at(start))?;
        Ok(Recording {
            source,
            header,
            offset: start + length,
            ended: false,
        })
    }

    /// What the recording is of.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// How many bytes of the file are read and sound. A file cut there is sound as a whole.
    pub fn offset(&self) -> u64 {
        self.offset
    }
}

impl<R: Read> Iterator for Recording<R> {
    type Item = Result<StepRecord, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let part = part(&mut self.source);
        self.ended = !matches!(part, Ok(Some(_)));
        let offset = self.offset;
        match part {
            Ok(Some((step, length))) => {
                self.offset += length;
                Some(Ok(step))
            }
            Ok(None) => None,
            Err(fault) => Some(Err(ReadError { offset, fault })),
        }
    }
}

fn opening(source: &mut impl Read) -> Result<(), Fault> {
    let bytes = read(source, LABEL)?;
    let (start, version) = bytes.split_at(OPENING.len().min(bytes.len()));
    if !OPENING.starts_with(start) {
        return Err(Fault::Opening);
    }
    let version = version.try_into().map_err(|_| Fault::Cut)?;
    match u32::from_le_bytes(version) {
        VERSION => Ok(()),
        other => Err(Fault::Version(other)),
    }
}

/// A label and what it stands before, and the length of both; `None` at the end of the file.
fn part<T: DeserializeOwned>(source: &mut impl Read) -> Result<Option<(T, u64)>, Fault> {
    let label = read(source, LABEL)?;
    if label.is_empty() {
        return Ok(None);
    }
    let label = label.as_slice().try_into().map_err(|_| Fault::Cut)?;
    let label = Label::read(label)?;
    let packed = read(source, label.packed as usize)?;
    if packed.len() < label.packed as usize {
        return Err(Fault::Cut);
    }
    let length = (LABEL + packed.len()) as u64;
    Ok(Some((unpack(&label, &packed)?, length)))
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

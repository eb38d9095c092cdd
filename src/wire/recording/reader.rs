//! Reading a recording.

use std::io::Read;

use super::header::Header;
use super::layout::FORMAT;
use crate::wire::StepRecord;
use crate::wire::file::{Fault, Format, ReadError};

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
        FORMAT.read_opening(&mut source).map_err(at(0))?;
        let start = Format::OPENING;
        let (header, length) = FORMAT
            .part(&mut source)
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
        let part = FORMAT.part(&mut self.source);
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

//! Writing a recording.

use std::io::Write;

use super::error::WriteError;
use super::frame::{LABEL, pack};
use super::header::Header;
use super::layout::VERSION;
use crate::wire::{StepRecord, World};

/// How a recording starts: the magic number of a skippable zstd frame, the length of the rest, a
/// name.
pub(super) const OPENING: [u8; 16] = *b"\x5e\x2a\x4d\x18\x0c\0\0\0tpsteps\0";

/// Writes steps to a file, each by one call of `write_all`. A sink that keeps bytes back (a
/// `BufWriter`) loses them in a crash; a plain file does not.
#[derive(Debug)]
pub struct Recorder<W> {
    sink: W,
}

impl<W: Write> Recorder<W> {
    /// Starts a recording of the steps of a world.
    ///
    /// # Errors
    ///
    /// The sink fails, or the shapes of the bodies need more than
    /// [`MOST_BYTES`](super::MOST_BYTES).
    pub fn new(sink: W, world: &World) -> Result<Self, WriteError> {
        let mut recorder = Recorder { sink };
        let mut bytes = Vec::with_capacity(LABEL);
        bytes.extend(OPENING);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend(pack(&Header::from(world))?);
        recorder.write(&bytes)?;
        Ok(recorder)
    }

    /// Adds a step.
    ///
    /// # Errors
    ///
    /// The sink fails, or the step needs more than [`MOST_BYTES`](super::MOST_BYTES).
    pub fn record(&mut self, step: &StepRecord) -> Result<(), WriteError> {
        let bytes = pack(step)?;
        self.write(&bytes)
    }

    /// Gives the sink back.
    pub fn into_inner(self) -> W {
        self.sink
    }

    fn write(&mut self, bytes: &[u8]) -> Result<(), WriteError> {
        self.sink.write_all(bytes).map_err(WriteError::Io)
    }
}

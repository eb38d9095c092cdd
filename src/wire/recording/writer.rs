//! Writing a recording.

use std::io::Write;

use super::header::Header;
use super::layout::FORMAT;
use crate::wire::file::WriteError;
use crate::wire::{StepRecord, World};

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
        let mut bytes = FORMAT.opening();
        bytes.extend(FORMAT.pack(&Header::from(world))?);
        recorder.write(&bytes)?;
        Ok(recorder)
    }

    /// Adds a step.
    ///
    /// # Errors
    ///
    /// The sink fails, or the step needs more than [`MOST_BYTES`](super::MOST_BYTES).
    pub fn record(&mut self, step: &StepRecord) -> Result<(), WriteError> {
        let bytes = FORMAT.pack(step)?;
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

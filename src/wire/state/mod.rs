//! A world in a file: what [`State::save`] writes, [`State::load`] reads back bit for bit, and a
//! run that goes on from there gives the same bits as one that was never stopped.
//!
//! ```
//! use tunnelproof::broad::Method;
//! use tunnelproof::certified::Certified;
//! use tunnelproof::query::Point;
//! use tunnelproof::wire::state::State;
//! use tunnelproof::wire::{Collisions, Material, Settings, Stop, WirePlan, World};
//!
//! let mut world = World::new(Settings::default())?;
//! let ends = [0.0, 2.0].map(|x| Stop::Pinned(Point::new(x, 0.0, 0.0)));
//! world.add_wire(&WirePlan::new(Material::steel(0.02), 0.25, ends.to_vec()))?;
//! let mut collisions = Collisions::default();
//! world.step_colliding(&mut collisions, &[])?;
//!
//! let mut file = Vec::new();
//! State::of(&world, &collisions).save(&mut file)?;
//! world.step_colliding(&mut collisions, &[])?;
//!
//! // On another day, on another machine:
//! let state = State::load(file.as_slice())?;
//! let mut collisions = state.collisions(Method::default(), &Certified);
//! let mut again = state.world;
//! again.step_colliding(&mut collisions, &[])?;
//! assert_eq!(again.wires(), world.wires());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What is in it
//!
//! All that later steps depend on: settings, bodies with their scripts and meshes, wires with nodes
//! and what segments remember, steps and time, the contact impulses from which the solver starts,
//! and of [`Collisions`] the settings and the [memory](CollisionMemory). Left out is what is made
//! anew with the same bits: the structure of the solver's matrix, boxes, shapes, cores.
//!
//! Left out, too, is what is code: the narrow phase, of which only the name is kept, a filter of
//! pairs, contacts that are given to each step, and a guard of changes of resolution. Who used them
//! gives them again.
//!
//! # Other settings
//!
//! A state can be stepped with other settings than it was: [`World::set_settings`],
//! [`World::set_resolution`], and the builders of [`Collisions`] after
//! [`collisions`](State::collisions) (`with_mode`, `with_friction`, ...).
//!
//! # The file
//!
//! | part | bytes |
//! | --- | --- |
//! | opening, a skippable zstd frame | `5e 2a 4d 18`, `0c 00 00 00`, `tpstate` and a 0, version |
//! | label, a skippable zstd frame | `5d 2a 4d 18`, `0c 00 00 00`, packed length, length, checksum |
//! | zstd frame of the packed length | the state as [postcard](https://postcard.jamesmunns.com/wire-format) |
//!
//! It is a file of parts like a [recording](super::recording), with one part. What is read is
//! checked as the builders of a world check it, and pairs that the next step would not test are
//! shown to be apart. A [`ReadError`] names what is wrong, and where: `wires[0].nodes[3]: velocity
//! is NaN, it must be finite`. Reading never panics, whatever the bytes are, and takes memory in
//! proportion to the bytes that are there, at most in proportion to [`MOST_BYTES`].

mod build;
mod content;

use std::io::{Read, Write};

use super::file::Format;
pub use super::file::{Fault, ReadError, WriteError};
use super::{CollisionMemory, CollisionSettings, Collisions, World};
use crate::broad::Method;
use crate::narrow::NarrowPhase;
use content::Content;

/// The version of the layout that is written, and the only one that is read.
pub const VERSION: u32 = 5;

/// The most bytes that a state may have before it is packed: more than half a million segments.
pub const MOST_BYTES: u32 = 1 << 28;

const FORMAT: Format = Format {
    name: *b"tpstate\0",
    what: "state of a world",
    version: VERSION,
    most_bytes: MOST_BYTES,
};

/// A world between two steps, with all that its later steps depend on.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct State {
    /// The world.
    pub world: World,
    /// The name of the narrow phase with which it was stepped.
    pub narrow: String,
    /// What its collisions do.
    pub settings: CollisionSettings,
    /// What is known of its collisions.
    pub memory: CollisionMemory,
}

impl State {
    /// The state of a world at present. One that is not stepped with [`Collisions`] has those of
    /// the default.
    pub fn of(world: &World, collisions: &Collisions<'_>) -> Self {
        State {
            world: world.clone(),
            narrow: collisions.narrow_name().to_owned(),
            settings: collisions.settings(),
            memory: collisions.memory(),
        }
    }

    /// Collisions that go on as they were. To give the same bits they need the same narrow phase,
    /// and the same filter, if there was one; any method will do.
    pub fn collisions<'n>(&self, method: Method, narrow: &'n dyn NarrowPhase) -> Collisions<'n> {
        Collisions::new(self.settings.mode, method, narrow)
            .with_settings(self.settings)
            .with_memory(self.memory.clone())
    }

    /// Writes it, by one call of `write_all`.
    ///
    /// # Errors
    ///
    /// The sink fails, or the state has more than [`MOST_BYTES`].
    pub fn save(&self, mut sink: impl Write) -> Result<(), WriteError> {
        let mut bytes = FORMAT.opening();
        bytes.extend(FORMAT.pack(&Content::from(self))?);
        sink.write_all(&bytes).map_err(WriteError::Io)
    }

    /// Reads a whole file.
    ///
    /// # Errors
    ///
    /// The file is no state or of another version, or it is not sound, or a value in it is one that
    /// no world has.
    pub fn load(mut source: impl Read) -> Result<Self, ReadError> {
        let wrong = |offset: u64| move |fault: Fault| ReadError { offset, fault };
        FORMAT.read_opening(&mut source).map_err(wrong(0))?;
        let start = Format::OPENING;
        let part = FORMAT.part::<Content>(&mut source);
        let (content, length) = part
            .and_then(|part| part.ok_or(Fault::Cut))
            .map_err(wrong(start))?;
        let state = content.build().map_err(wrong(start))?;
        FORMAT
            .read_end(&mut source)
            .map_err(wrong(start + length))?;
        Ok(state)
    }
}

#[cfg(test)]
mod tests;

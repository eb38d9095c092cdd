//! `simulate --save`: the state of a run, kept in a file.

use std::path::{Path, PathBuf};

use clap::{Args, value_parser};
use tunnelproof::wire::state::State;
use tunnelproof::wire::{Collisions, World};
use tunnelproof_cli::simulate::Narrow;

use crate::command::Failure;
use crate::command::output::OutputFile;

/// Where the state of a run goes, and how often.
#[derive(Args)]
pub(super) struct Saving {
    /// Write the state at the end to this file, or at Ctrl-C, for --from; after a step that cannot be
    /// done, the state before it
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    /// Write it after every N steps as well, over the one before
    #[arg(long, value_name = "N", requires = "save", value_parser = value_parser!(u64).range(1..))]
    save_every: Option<u64>,
}

impl Saving {
    /// Whether anything is saved.
    pub(super) fn is_asked(&self) -> bool {
        self.save.is_some()
    }

    /// Where the state goes.
    pub(super) fn file(&self) -> Option<&Path> {
        self.save.as_deref()
    }

    /// Sees to it that the file can be made.
    pub(super) fn check(&self) -> Result<(), Failure> {
        self.save
            .as_deref()
            .map_or(Ok(()), |path| OutputFile::create(path).map(drop))
    }

    /// After a step.
    pub(super) fn step(
        &self,
        world: &World,
        collisions: &Collisions<'_>,
        narrow: Narrow,
    ) -> Result<(), Failure> {
        let is_due = |every: u64| world.steps().is_multiple_of(every);
        match self.save_every.is_some_and(is_due) {
            true => self.end(State::of(world, collisions), narrow),
            false => Ok(()),
        }
    }

    /// At the end.
    pub(super) fn end(&self, mut state: State, narrow: Narrow) -> Result<(), Failure> {
        // By its name on the command line, since two of them are one method.
        narrow.name().clone_into(&mut state.narrow);
        self.save
            .as_deref()
            .map_or(Ok(()), |path| save(path, &state))
    }
}

/// The file is whole at every time: the state before, or this one.
fn save(path: &Path, state: &State) -> Result<(), Failure> {
    let file = OutputFile::create(path)?;
    let mut bytes = Vec::new();
    let saved = state.save(&mut bytes);
    saved.map_err(|error| Failure::file(path, error))?;
    file.write_bytes(&bytes)
}

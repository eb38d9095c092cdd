//! `certify --resume`: what is judged so far, kept beside the result.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tunnelproof_reference::certify::block::Block;
use tunnelproof_reference::certify::findings::{Findings, Settings};
use tunnelproof_reference::certify::run::Panel;
use tunnelproof_reference::certify::source::AnySource;
use tunnelproof_reference::report::merge::{Kept, MergeError};
use tunnelproof_reference::report::results::Results;

use super::output::{OutputFile, is_standard_output, unwritable};
use super::{Failure, merge};

/// Where the result goes, and where what is judged before it is whole.
pub(super) struct Resumed<'a> {
    /// None if nothing is kept.
    paths: Option<Paths>,
    settings: &'a Settings,
}

struct Paths {
    whole: PathBuf,
    part: PathBuf,
}

impl<'a> Resumed<'a> {
    /// Of a command with `--resume` or without, and the file of its `--json`.
    ///
    /// # Errors
    ///
    /// There is no such file.
    pub(super) fn new(
        resume: bool,
        json: Option<&Path>,
        settings: &'a Settings,
    ) -> Result<Self, Failure> {
        let whole = json.filter(|_| resume);
        if whole.is_some_and(is_standard_output) {
            let problem = "needs a file of --json, not the standard output";
            return Err(Failure::file("--resume", problem));
        }
        let paths = whole.map(|whole| {
            let mut part = whole.as_os_str().to_owned();
            part.push(".part");
            Paths {
                whole: whole.to_owned(),
                part: part.into(),
            }
        });
        Ok(Resumed { paths, settings })
    }

    /// The whole result of this command, if it is there already.
    pub(super) fn whole(&self) -> Result<Option<Kept>, Failure> {
        match &self.paths {
            Some(paths) => {
                let kept = self.read(&paths.whole)?;
                Ok(kept.map(|kept| kept.with_settings(self.settings.clone())))
            }
            None => Ok(None),
        }
    }

    /// What is judged already, of the first of these sources.
    pub(super) fn blocks(&self, sources: &[AnySource]) -> Result<Vec<Block>, Failure> {
        let Some(paths) = &self.paths else {
            return Ok(Vec::new());
        };
        let Some(kept) = self.read(&paths.part)? else {
            return Ok(Vec::new());
        };
        let names = sources
            .iter()
            .map(AnySource::name)
            .take(kept.blocks().len());
        let blocks = kept.blocks().to_vec();
        match blocks.iter().map(|block| block.name.clone()).eq(names) {
            true => Ok(blocks),
            false => Err(other(&paths.part, "list of sources")),
        }
    }

    /// Keeps what is judged so far.
    pub(super) fn keep(&self, panel: &Panel, blocks: &[Block]) -> Result<(), Failure> {
        let Some(paths) = &self.paths else {
            return Ok(());
        };
        let settings = self.settings.clone();
        let findings = Findings::new(panel.clone(), settings, blocks.to_vec(), Vec::new());
        OutputFile::create(&paths.part)?.write(&Results::new(&findings).text())
    }

    /// Removes what was kept, now that the result is whole.
    pub(super) fn finish(&self) -> Result<(), Failure> {
        let Some(paths) = &self.paths else {
            return Ok(());
        };
        match fs::remove_file(&paths.part) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(unwritable(&paths.part, error))
            }
            _ => Ok(()),
        }
    }

    /// Whether these are the settings of this command.
    fn is_of(&self, kept: &Settings) -> bool {
        kept.shard == self.settings.shard && self.settings.are_of_same_certification(kept)
    }

    /// A result of this command in a file, if there is one.
    fn read(&self, path: &Path) -> Result<Option<Kept>, Failure> {
        match merge::read_if_there(path)? {
            Some(kept) if !self.is_of(kept.settings()) => Err(other(path, "command")),
            kept => Ok(kept),
        }
    }
}

/// That a result is of another certification.
fn other(path: &Path, what: &'static str) -> Failure {
    Failure::merge(&path.display().to_string(), MergeError::Other(what))
}

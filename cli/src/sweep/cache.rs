//! What was found out about a sample, kept between runs.

use std::io;
use std::path::{Path, PathBuf};

use super::container::{self, Damage, Key};
use super::run::Evaluated;
use super::sample::Sample;

/// The files of one sample in a folder: what is known of its queries, and the settings that were
/// judged on it.
///
/// The names and the keys of the files are a hash of the sample, so that nothing is taken for what
/// it is not; a file that is damaged is noticed.
#[derive(Debug)]
pub struct Cache {
    truths: PathBuf,
    settings: PathBuf,
    key: Key,
}

impl Cache {
    /// The files of this sample in a folder, which need not be there yet.
    pub fn new(folder: &Path, sample: &Sample) -> Self {
        let key = sample.key();
        let name: String = key[..8].iter().map(|byte| format!("{byte:02x}")).collect();
        Cache {
            truths: folder.join(format!("{name}.truths")),
            settings: folder.join(format!("{name}.settings")),
            key,
        }
    }

    /// The file of what is known of the queries.
    pub fn truths(&self) -> &Path {
        &self.truths
    }

    /// The file of the settings that were judged.
    pub fn settings(&self) -> &Path {
        &self.settings
    }

    /// Takes over what is known of the queries, if anything is.
    ///
    /// # Errors
    ///
    /// [`Damage`] if there is a file that does not hold it; then nothing is taken over.
    pub fn load_truths(&self, sample: &mut Sample) -> Result<(), Damage> {
        let Some(records) = container::read(&self.truths, &self.key)? else {
            return Ok(());
        };
        let other = || Damage::Payload("records that are none".to_owned());
        sample.take_records(&records).ok_or_else(other)
    }

    /// Keeps what is known of the queries.
    ///
    /// # Errors
    ///
    /// If the file cannot be written; one that was there then stays.
    pub fn save_truths(&self, sample: &Sample) -> io::Result<()> {
        container::write(&self.truths, &self.key, &sample.records())
    }

    /// The settings that were judged; none if there is no file.
    ///
    /// # Errors
    ///
    /// [`Damage`] if there is a file that does not hold them.
    pub fn load_settings(&self) -> Result<Vec<Evaluated>, Damage> {
        let Some(json) = container::read(&self.settings, &self.key)? else {
            return Ok(Vec::new());
        };
        serde_json::from_slice(&json).map_err(|error| Damage::Payload(error.to_string()))
    }

    /// Keeps the settings that were judged.
    ///
    /// # Errors
    ///
    /// As [`save_truths`](Self::save_truths).
    pub fn save_settings(&self, evaluated: &[Evaluated]) -> io::Result<()> {
        let json = serde_json::to_vec(evaluated)?;
        container::write(&self.settings, &self.key, &json)
    }
}

//! Results as files: JSON, a page, and the charts of the page.

use std::fs;
use std::path::PathBuf;

use clap::Args;
use tunnelproof_cli::report::page::Figure;

use super::Failure;
use super::output::{OutputFile, unwritable};

/// Where results are written.
#[derive(Args)]
pub(super) struct Pages {
    /// Write the whole result to this file, as JSON
    #[arg(long, value_name = "OUT")]
    json: Option<PathBuf>,
    /// Write a page with charts to this file; it needs no network
    #[arg(long, value_name = "OUT")]
    html: Option<PathBuf>,
    /// Write each chart of the page to this folder, as SVG
    #[arg(long, value_name = "FOLDER")]
    figures: Option<PathBuf>,
}

/// The files, seen to be writable.
pub(super) struct Prepared {
    json: Option<OutputFile>,
    html: Option<OutputFile>,
    figures: Option<PathBuf>,
}

impl Pages {
    /// Sees to it that the files can be made.
    pub(super) fn prepare(&self) -> Result<Prepared, Failure> {
        if let Some(folder) = &self.figures {
            fs::create_dir_all(folder).map_err(|error| unwritable(folder, error))?;
        }
        Ok(Prepared {
            json: self.json.as_deref().map(OutputFile::create).transpose()?,
            html: self.html.as_deref().map(OutputFile::create).transpose()?,
            figures: self.figures.clone(),
        })
    }
}

impl Prepared {
    /// Writes the files that are asked for.
    pub(super) fn write(
        self,
        json: impl FnOnce() -> String,
        figures: impl FnOnce() -> Vec<Figure>,
        html: impl FnOnce(&[Figure]) -> String,
    ) -> Result<(), Failure> {
        if let Some(file) = self.json {
            file.write(&json())?;
        }
        if self.html.is_none() && self.figures.is_none() {
            return Ok(());
        }
        let drawn = figures();
        if let Some(folder) = self.figures {
            for figure in &drawn {
                let path = folder.join(format!("{}.svg", figure.name));
                OutputFile::create(&path)?.write(&figure.svg)?;
            }
        }
        if let Some(file) = self.html {
            file.write(&html(&drawn))?;
        }
        Ok(())
    }
}

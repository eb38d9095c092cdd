//! Results as files: JSON, a page, and the charts of the page.

use std::fs;
use std::path::PathBuf;

use clap::Args;
use tunnelproof_cli::report::page::Figure;

use super::Failure;
use super::output::{JsonOutput, OutputFile, unwritable};

/// Where results are written.
#[derive(Args)]
pub(super) struct Pages {
    /// Write the whole result to this file, as JSON; - is the standard output, in place of the tables
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
    json: JsonOutput,
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
            json: JsonOutput::create(self.json.as_deref())?,
            html: self.html.as_deref().map(OutputFile::create).transpose()?,
            figures: self.figures.clone(),
        })
    }
}

impl Prepared {
    /// Writes the text and the files that are asked for.
    pub(super) fn write(
        self,
        text: impl FnOnce() -> String,
        json: impl FnOnce() -> String,
        figures: impl FnOnce() -> Vec<Figure>,
        html: impl FnOnce(&[Figure]) -> String,
    ) -> Result<(), Failure> {
        let is_drawn = self.html.is_some() || self.figures.is_some();
        let drawn = if is_drawn { figures() } else { Vec::new() };
        if let Some(folder) = self.figures {
            for figure in &drawn {
                let path = folder.join(format!("{}.svg", figure.name));
                OutputFile::create(&path)?.write(&figure.svg)?;
            }
        }
        if let Some(file) = self.html {
            file.write(&html(&drawn))?;
        }
        self.json.write(|| Ok(json()), text)
    }
}

//! `vectors`: test vectors for every implementation of continuous collision detection.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use tunnelproof_cli::vectors::{self, VectorFile, package};
use tunnelproof_reference::corpus::{CorpusError, Problem};

use super::Failure;
use super::output::{OutputFile, print, unwritable};

/// What is in the folder besides vectors.
const SCHEMA: &str = "schema.json";

/// What says what is in it.
const README: &str = "README.md";

/// Write test vectors: queries with their exact answers, as JSON
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof vectors
  tunnelproof vectors --out /tmp/vectors
  tunnelproof vectors --check
  tunnelproof vectors --package target/vectors

One file for each source: figures, errata, reports, and a selection of each family. The files are the
same on every machine; vectors/README.md says what is in them. With --check nothing is written: each
difference between the folder and what would be written is a line on the standard error, and the exit
code is 1 if there is any.

With --package the files of the folder as they are become packages of data in another folder: an archive
tunnelproof-vectors-VERSION.tar.gz with its checksum, a crate in crate/, and a package for Python in
python/.")]
pub(super) struct Vectors {
    /// The folder of the files
    #[arg(long, value_name = "FOLDER", default_value = "vectors")]
    out: PathBuf,
    /// Compare the files with what would be written
    #[arg(long)]
    check: bool,
    /// Make packages of the files in this folder: an archive, a crate and a package for Python
    #[arg(long, value_name = "FOLDER", conflicts_with = "check")]
    package: Option<PathBuf>,
}

impl Vectors {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        if let Some(to) = &self.package {
            return self.package(to);
        }
        // The folder first: making the vectors takes a while.
        if self.check {
            fs::read_dir(&self.out).map_err(|error| unreadable(&self.out, error))?;
            return self.check(&vectors::files());
        }
        let folder = self.out.join(vectors::TURNING);
        let made = fs::create_dir_all(&self.out).and_then(|()| fs::create_dir_all(&folder));
        made.map_err(|error| unwritable(&self.out, error))?;
        let files = vectors::files();
        for file in &files {
            OutputFile::create(&self.out.join(&file.name))?.write(&file.text)?;
        }
        print(&summary(&files))?;
        Ok(ExitCode::SUCCESS)
    }

    /// Writes the packages of the files that are there.
    fn package(&self, to: &Path) -> Result<ExitCode, Failure> {
        let mut folder = Vec::new();
        for (path, name) in self.names()? {
            if name.ends_with(".json") || name == README {
                let bytes = fs::read(&path).map_err(|error| unreadable(&path, error))?;
                folder.push(package::File { path: name, bytes });
            }
        }
        folder.sort_by(|a, b| a.path.cmp(&b.path));
        if folder.is_empty() {
            return Err(CorpusError::new(&self.out.display().to_string(), Problem::NoFile).into());
        }
        let packages = package::packages(&folder).map_err(|error| unwritable(to, error))?;
        for file in &packages {
            let path = to.join(&file.path);
            let parent = path.parent().unwrap_or(to);
            fs::create_dir_all(parent).map_err(|error| unwritable(parent, error))?;
            OutputFile::create(&path)?.write_bytes(&file.bytes)?;
        }
        let archive = packages.first().map_or("", |file| &file.path);
        print(&format!(
            "{} files as {archive}, crate/ and python/\n",
            folder.len()
        ))?;
        Ok(ExitCode::SUCCESS)
    }

    fn check(&self, files: &[VectorFile]) -> Result<ExitCode, Failure> {
        let mut differences = Vec::new();
        for file in files {
            match fs::read(self.out.join(&file.name)) {
                Ok(bytes) if bytes == file.text.as_bytes() => {}
                Ok(_) => differences.push((&file.name, "is not what would be written")),
                Err(error) if error.kind() == io::ErrorKind::NotFound => {
                    differences.push((&file.name, "is missing"));
                }
                Err(error) => return Err(unreadable(&self.out.join(&file.name), error)),
            }
        }
        let surplus = self.surplus(files)?;
        differences.extend(surplus.iter().map(|name| (name, "would not be written")));
        for (name, what) in &differences {
            eprintln!("{}: {what}", self.out.join(name).display());
        }
        if !differences.is_empty() {
            return Ok(ExitCode::FAILURE);
        }
        print(&summary(files))?;
        Ok(ExitCode::SUCCESS)
    }

    /// The names of `.json` files in the folders that are neither vectors nor their schema.
    fn surplus(&self, files: &[VectorFile]) -> Result<BTreeSet<String>, Failure> {
        let schemas = [SCHEMA.to_owned(), format!("{}/{SCHEMA}", vectors::TURNING)];
        let is_known =
            |name: &String| schemas.contains(name) || files.iter().any(|file| file.name == *name);
        let names = self.names()?.into_iter().map(|(_, name)| name);
        Ok(names
            .filter(|name| name.ends_with(".json") && !is_known(name))
            .collect())
    }

    /// What is in the folder, and in that of bodies that turn if there is one: paths, and names as
    /// seen from the folder.
    fn names(&self) -> Result<Vec<(PathBuf, String)>, Failure> {
        let mut names = Vec::new();
        let turning = self.out.join(vectors::TURNING);
        let folders = [
            (&self.out, String::new()),
            (&turning, format!("{}/", vectors::TURNING)),
        ];
        for (folder, within) in folders {
            let entries = match fs::read_dir(folder) {
                Err(error) if !within.is_empty() && error.kind() == io::ErrorKind::NotFound => {
                    continue;
                }
                entries => entries.map_err(|error| unreadable(folder, error))?,
            };
            for entry in entries {
                let path = entry.map_err(|error| unreadable(folder, error))?.path();
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                let name = format!("{within}{name}");
                names.push((path, name));
            }
        }
        Ok(names)
    }
}

fn summary(files: &[VectorFile]) -> String {
    let vectors: usize = files.iter().map(|file| file.vectors).sum();
    format!("{vectors} vectors in {} files\n", files.len())
}

fn unreadable(path: &Path, error: io::Error) -> Failure {
    CorpusError::new(&path.display().to_string(), Problem::Io(error)).into()
}

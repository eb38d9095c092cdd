//! Where results go.

use std::fs::{self, File, Permissions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};
use tempfile::NamedTempFile;
use tunnelproof_reference::certify::caller::{self, Caller};
use tunnelproof_reference::certify::table::{Paint, Shown, Tone};

use super::Failure;

/// Writes to the standard output, at once.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut output = io::stdout().lock();
    output
        .write_all(text.as_bytes())
        .and_then(|()| output.flush())
        .map_err(standard_output)
}

/// What commands to paste begin with: as this one was started, by Cargo in a checkout or installed.
pub(super) fn program() -> &'static str {
    match std::env::var_os("CARGO") {
        Some(_) => caller::CHECKOUT,
        None => caller::INSTALLED,
    }
}

/// Who asked on the command line, for commands to paste.
pub(super) fn shell() -> Caller {
    Caller::Shell {
        program: program().to_owned(),
        options: String::new(),
    }
}

/// How words on the standard output are coloured: not where it is no terminal, or `NO_COLOR` is set.
pub(super) fn paint() -> Paint {
    match AutoStream::choice(&io::stdout()) {
        ColorChoice::Never => Shown::SUMMARY.paint,
        _ => coloured,
    }
}

fn coloured(tone: Tone, text: &str) -> String {
    let style = match tone {
        Tone::Good => AnsiColor::Green.on_default().bold(),
        Tone::Bad => AnsiColor::Red.on_default().bold(),
        Tone::Heading => Style::new().bold(),
        _ => Style::new().dimmed(),
    };
    format!("{style}{text}{style:#}")
}

/// That the standard output cannot be written.
pub(super) fn standard_output(error: io::Error) -> Failure {
    Failure::Output {
        name: "standard output".to_owned(),
        error,
    }
}

/// A file to be written, whole or not at all.
///
/// It takes its name once it is complete. A name that stands for something else than a file, such
/// as a device, is written to directly.
pub(super) struct OutputFile {
    path: PathBuf,
    target: Target,
}

enum Target {
    New(NamedTempFile),
    Device(File),
}

impl OutputFile {
    /// Sees to it that the file can be made.
    pub(super) fn create(path: &Path) -> Result<Self, Failure> {
        // A link stays one: what it stands for is written.
        let path = match path.is_symlink() {
            true => fs::canonicalize(path).unwrap_or_else(|_| path.to_owned()),
            false => path.to_owned(),
        };
        let target = Target::create(&path).map_err(|error| unwritable(&path, error))?;
        Ok(OutputFile { path, target })
    }

    /// Writes the file, with a line end after the last line.
    pub(super) fn write(self, text: &str) -> Result<(), Failure> {
        self.write_bytes(text.as_bytes())
    }

    /// Writes a file that is no text.
    pub(super) fn write_bytes(self, bytes: &[u8]) -> Result<(), Failure> {
        self.target
            .write(&self.path, bytes)
            .map_err(|error| unwritable(&self.path, error))
    }
}

/// Where a result goes: to the standard output as text, and to a file as JSON if `--json` names one.
/// JSON on the standard output, `-`, takes the place of the text.
pub(super) enum JsonOutput {
    /// Nowhere.
    None,
    File(OutputFile),
    StandardOutput,
}

impl JsonOutput {
    /// Sees to it that the file can be made.
    pub(super) fn create(path: Option<&Path>) -> Result<Self, Failure> {
        Ok(match path {
            None => JsonOutput::None,
            Some(path) if is_standard_output(path) => JsonOutput::StandardOutput,
            Some(path) => JsonOutput::File(OutputFile::create(path)?),
        })
    }

    /// Writes the result.
    pub(super) fn write(
        self,
        json: impl FnOnce() -> Result<String, Failure>,
        text: impl FnOnce() -> String,
    ) -> Result<(), Failure> {
        match self {
            JsonOutput::StandardOutput => return print(&with_line_end(json()?)),
            JsonOutput::File(file) => file.write(&json()?)?,
            JsonOutput::None => {}
        }
        print(&text())
    }
}

/// Whether the value of `--json` stands for the standard output.
pub(super) fn is_standard_output(path: &Path) -> bool {
    path == Path::new("-")
}

fn with_line_end(mut text: String) -> String {
    if !text.ends_with('\n') {
        text.push('\n');
    }
    text
}

impl Target {
    fn create(path: &Path) -> io::Result<Self> {
        if fs::metadata(path).is_ok_and(|metadata| !metadata.is_file()) {
            return File::options().write(true).open(path).map(Target::Device);
        }
        let folder = match path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        if let Some(permissions) = permissions() {
            builder.permissions(permissions);
        }
        fs::metadata(folder)?;
        // Its error would name the temporary file.
        let file = builder.tempfile_in(folder);
        file.map(Target::New).map_err(|error| error.kind().into())
    }

    fn write(self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        match self {
            Target::Device(mut file) => file.write_all(bytes),
            Target::New(mut file) => {
                file.write_all(bytes)?;
                file.persist(path).map_err(|error| error.error)?;
                Ok(())
            }
        }
    }
}

/// Those of any new file.
#[cfg(unix)]
fn permissions() -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(0o666))
}

/// Those of any new file.
#[cfg(not(unix))]
fn permissions() -> Option<Permissions> {
    None
}

/// That this file or folder cannot be written.
pub(super) fn unwritable(path: &Path, error: io::Error) -> Failure {
    Failure::Output {
        name: path.display().to_string(),
        error,
    }
}

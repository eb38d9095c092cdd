//! `completions` and `man`: what shells and manuals know of the commands.

use std::fs;
use std::io::Cursor;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::output::{print, unwritable};
use super::{Cli, Failure};

/// Print the completions of a shell
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof completions bash > ~/.local/share/bash-completion/completions/tunnelproof
  tunnelproof completions zsh > ~/.zfunc/_tunnelproof
  tunnelproof completions fish > ~/.config/fish/completions/tunnelproof.fish")]
pub(super) struct Completions {
    /// The shell
    shell: Shell,
}

/// Write the pages of the manual to a folder
#[derive(Args)]
#[command(after_help = "\
Example:
  tunnelproof man ~/.local/share/man/man1 && man tunnelproof-certify")]
pub(super) struct Man {
    /// The folder
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
}

impl Completions {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let mut text = Cursor::new(Vec::new());
        clap_complete::generate(self.shell, &mut Cli::command(), "tunnelproof", &mut text);
        print(&String::from_utf8_lossy(text.get_ref()))?;
        Ok(ExitCode::SUCCESS)
    }
}

impl Man {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        fs::create_dir_all(&self.folder).map_err(|error| unwritable(&self.folder, error))?;
        clap_mangen::generate_to(Cli::command(), &self.folder)
            .map_err(|error| unwritable(&self.folder, error))?;
        Ok(ExitCode::SUCCESS)
    }
}

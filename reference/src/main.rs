//! The command line: `eval`, `certify`, `explain`, `shrink` and `replay`.

use std::process::ExitCode;

use clap::Parser;

mod command;

fn main() -> ExitCode {
    command::Cli::parse().run()
}

//! The command line: `eval`, `certify`, `explain` and `shrink`.

use std::process::ExitCode;

use clap::Parser;

mod command;

fn main() -> ExitCode {
    command::Cli::parse().run()
}

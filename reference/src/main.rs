//! The command line: `eval`, `certify` and `explain`.

use std::process::ExitCode;

use clap::Parser;

mod command;

fn main() -> ExitCode {
    command::Cli::parse().run()
}

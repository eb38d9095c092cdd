//! The command line `tunnelproof`.

use std::process::ExitCode;

use clap::Parser;

mod command;

fn main() -> ExitCode {
    command::Cli::parse().run()
}

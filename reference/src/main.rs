//! The command line: `eval`, `certify`, `explain`, `shrink`, `replay` and `vectors`.

use std::process::ExitCode;

use clap::Parser;

mod command;

fn main() -> ExitCode {
    command::Cli::parse().run()
}

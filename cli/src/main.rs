//! The command line: `eval`, `certify`, `merge`, `explain`, `shrink`, `replay`, `vectors`, `sweep`
//! and `tune`.

use std::process::ExitCode;

use clap::Parser;

mod command;

fn main() -> ExitCode {
    command::Cli::parse().run()
}

//! `lib-host`: a shared library that answers queries, in this process. `certify` starts it for
//! `lib:`.

use std::process::ExitCode;

use clap::Args;
use tunnelproof_lib_host::Host;

use super::Failure;
use super::output::standard_output;

/// Answer framed queries by a shared library
#[derive(Args)]
pub(super) struct LibHost {
    /// The library
    path: String,
    /// See whether the library can answer, and do no more
    #[arg(long)]
    check: bool,
}

impl LibHost {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let mut host = Host::load(&self.path).map_err(|error| Failure::Program {
            name: self.path.clone(),
            reason: error.to_string(),
        })?;
        if !self.check {
            host.serve().map_err(standard_output)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

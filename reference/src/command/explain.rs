//! `explain`: one query, its exact answer, and what everyone says.

use std::process::ExitCode;

use clap::Args;

use super::Failure;

/// Explain one query
#[derive(Args)]
pub(super) struct Explain {
    /// The query
    query: String,
}

impl Explain {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let _ = self.query;
        Ok(ExitCode::SUCCESS)
    }
}

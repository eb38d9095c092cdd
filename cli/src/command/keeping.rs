//! What is kept between runs of a command, and ending it early.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use directories::ProjectDirs;
use tunnelproof_cli::sweep::{Cache, Domain, Interrupted, Sample, Watch};
use tunnelproof_reference::certify::run::RunError;
use tunnelproof_reference::certify::source::Source;

use super::{Failure, progress};

/// Where exact answers are kept.
#[derive(Args)]
pub(super) struct Keeping {
    /// Keep exact answers in this folder; by default the user's cache folder
    #[arg(long, value_name = "FOLDER")]
    cache: Option<PathBuf>,
    /// Keep nothing
    #[arg(long, conflicts_with = "cache")]
    no_cache: bool,
}

/// Why there is no sample.
pub(super) enum NoSample {
    /// The queries cannot be read.
    Unreadable(RunError),
    /// Ctrl-C came first.
    Interrupted(Interrupted),
}

impl Keeping {
    /// Reads queries and finds the truth of each, as far as it is not kept.
    pub(super) fn sample(
        &self,
        domain: Domain,
        sources: &[Source],
        stop: &AtomicBool,
    ) -> Result<(Sample, Option<Cache>), NoSample> {
        let sample = progress::reading(sources, |bar| Sample::read(domain, sources, bar));
        let mut sample = sample.map_err(NoSample::Unreadable)?;
        let cache = self.cache(&sample);
        if let Some(cache) = &cache
            && let Err(damage) = cache.load_truths(&mut sample)
        {
            eprintln!("{}: {damage}; made anew", cache.truths().display());
        }
        let found = progress::working(sample.queries().len(), "exact answers", |progress| {
            sample.find_truths(&Watch { stop, progress })
        });
        save_truths(cache.as_ref(), &sample);
        found.map_err(NoSample::Interrupted)?;
        Ok((sample, cache))
    }

    /// The files of this sample, if any are kept.
    fn cache(&self, sample: &Sample) -> Option<Cache> {
        if self.no_cache {
            return None;
        }
        let usual = || {
            Some(
                ProjectDirs::from("", "", "tunnelproof")?
                    .cache_dir()
                    .to_owned(),
            )
        };
        let folder = self.cache.clone().or_else(usual)?;
        Some(Cache::new(&folder, sample))
    }
}

/// Keeps what is known of the queries; says so if that cannot be.
pub(super) fn save_truths(cache: Option<&Cache>, sample: &Sample) {
    if let Some(cache) = cache
        && let Err(error) = cache.save_truths(sample)
    {
        eprintln!("{}: cannot be written: {error}", cache.truths().display());
    }
}

/// Set by Ctrl-C, of which the first one ends work in order and the second one at once.
pub(super) fn interruption() -> Result<&'static AtomicBool, Failure> {
    static STOP: AtomicBool = AtomicBool::new(false);
    ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(i32::from(INTERRUPTED));
        }
    })
    .map_err(Failure::Interruption)?;
    Ok(&STOP)
}

/// As a shell states the end by Ctrl-C.
const INTERRUPTED: u8 = 130;

/// The end of a command that was interrupted.
pub(super) fn interrupted() -> ExitCode {
    ExitCode::from(INTERRUPTED)
}

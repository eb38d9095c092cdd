//! `sweep`: what the thesis' thresholds cost, over a grid of their values.

use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Args;
use tunnelproof_cli::report::page;
use tunnelproof_cli::report::prices::Prices;
use tunnelproof_cli::sweep::{Cache, Evaluated, Interrupted, Setting, Watch, run};

use super::axes::Axes;
use super::keeping::{Keeping, NoSample, interrupted, interruption, save_truths};
use super::pages::Pages;
use super::sources::{Scene, Sources};
use super::{Failure, progress, whole};

/// Judge the thesis path over a grid of its thresholds
///
/// The exact answers are found once. Each setting is then judged on every query.
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof sweep
  tunnelproof sweep --scale 0.001 --count 10000 --json prices.json --html prices.html
  tunnelproof sweep --threshold dist --from 1e-9 --to 1e-3 --steps 13 --family near_coplanar
  tunnelproof sweep --threshold dist --steps 12 --threshold coefficients_cubic --steps 12

Thresholds: dist, dist_1d, t, coefficients_quadratic, coefficients_cubic. Without --threshold each is
swept alone, 30 values each, the others as in table 3.1 of the thesis. --from, --to and --steps belong
to the --threshold before them; values grow by one factor. By default they span half decades from
1e-15 (coefficients: 1e-18) times the scale, the scale squared or cubed, as the unit of the threshold asks.

Columns: crossings that are missed (tunnels of edges, and of wires at a node); other contacts that are
missed; hits without contact, and the least distance of the edges in the middle and in the worst of them,
in metres; cases told wrong; times of impact late or early by more than 1e-9 of the step.

Ctrl-C ends the sweep: what was judged is printed, written and kept, and --resume goes on from there.
The exit code is then 130.")]
pub(super) struct Sweep {
    #[command(flatten)]
    axes: Axes,
    #[command(flatten)]
    sources: Sources,
    #[command(flatten)]
    scene: Scene,
    /// How many queries of each family
    #[arg(long, value_name = "N", default_value_t = 66_667, value_parser = whole, allow_negative_numbers = true)]
    count: u64,
    /// The seed of the families
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = whole, allow_negative_numbers = true)]
    seed: u64,
    /// Go on with a sweep that was interrupted
    #[arg(long, conflicts_with = "no_cache")]
    resume: bool,
    #[command(flatten)]
    keeping: Keeping,
    #[command(flatten)]
    pages: Pages,
}

/// How often what was judged is kept.
const KEEP_EVERY: Duration = Duration::from_secs(5);

impl Sweep {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let domain = self.scene.domain()?;
        let grid = self.axes.grid(&domain)?;
        let sources = self.sources.sources(self.seed, self.count)?;
        if sources.is_empty() {
            return Err(Failure::Nothing);
        }
        let files = self.pages.prepare()?;
        let stop = interruption()?;
        let (sample, cache) = match self.keeping.sample(domain, &sources, stop) {
            Ok(found) => found,
            Err(NoSample::Unreadable(error)) => return Err(error.into()),
            Err(NoSample::Interrupted(_)) => {
                eprintln!("interrupted: not all exact answers were found; --resume goes on");
                return Ok(interrupted());
            }
        };
        let settings: Vec<_> = [Setting::published()]
            .into_iter()
            .chain(grid.settings())
            .collect();
        let known = cache
            .as_ref()
            .filter(|_| self.resume)
            .map(load_settings)
            .unwrap_or_default();
        let work = sample.queries().len() * settings.len();
        let evaluated = progress::working(work, "settings", |progress| {
            let mut kept = Instant::now();
            run(
                &sample,
                &settings,
                &known,
                &Watch { stop, progress },
                |evaluated| {
                    if kept.elapsed() >= KEEP_EVERY {
                        save_settings(cache.as_ref(), evaluated);
                        kept = Instant::now();
                    }
                },
            )
        });
        let (evaluated, is_complete) = match evaluated {
            Ok(evaluated) => (evaluated, true),
            Err((Interrupted, evaluated)) => (evaluated, false),
        };
        save_settings(cache.as_ref(), &evaluated);
        save_truths(cache.as_ref(), &sample);
        let prices = Prices::new(&sample, &grid, &evaluated);
        files.write(
            || prices.text(),
            || prices.json(),
            || page::of_sweep(&prices),
            |figures| page::sweep_page(&prices, figures, &sample),
        )?;
        if !is_complete {
            let (done, all) = (evaluated.len(), settings.len());
            eprintln!("interrupted: {done} of {all} settings were judged; --resume goes on");
            return Ok(interrupted());
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// The settings that were judged; says so if they are damaged.
fn load_settings(cache: &Cache) -> Vec<Evaluated> {
    cache.load_settings().unwrap_or_else(|damage| {
        eprintln!("{}: {damage}; made anew", cache.settings().display());
        Vec::new()
    })
}

/// Keeps the settings that were judged; says so if that cannot be.
fn save_settings(cache: Option<&Cache>, evaluated: &[Evaluated]) {
    if let Some(cache) = cache
        && let Err(error) = cache.save_settings(evaluated)
    {
        eprintln!("{}: cannot be written: {error}", cache.settings().display());
    }
}

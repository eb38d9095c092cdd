//! `tune`: the best thresholds, and what they are worth.

use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

use clap::Args;
use tunnelproof_cli::report::page;
use tunnelproof_cli::report::tuning::{Tuning, Validation};
use tunnelproof_cli::sweep::{Domain, Interrupted, Sample, Setting, Watch};
use tunnelproof_cli::tune::{Advice, Cost, Judge, Lattice, Penalty, advise, validate};
use tunnelproof_reference::generate::{FAMILIES, Family};

use super::keeping::{Keeping, NoSample, interrupted, interruption};
use super::pages::Pages;
use super::sources::{Scene, family, has_a_scale, of_families};
use super::{Failure, progress, whole};

/// Find the best thresholds of the thesis path, and what they are worth
///
/// Few crossings that get through and few false hits are wanted at once: the settings of which none
/// is better in both are searched, and one of them is recommended.
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof tune
  tunnelproof tune --scale 0.001 --precision f32
  tunnelproof tune --penalty 100 --html tuning.html

The settings have each threshold at 0 or from 1e-18 to 0.1 times the scale (squared or cubed, as its unit
asks), one value a decade. The search is a Pareto local search: it ends when no change of one threshold
of any setting found leads to one that is not worse. It has no random numbers, so that the same arguments give
the same result.

What is found is judged again on the same families with another seed, and on families that were held out.")]
pub(super) struct Tune {
    #[command(flatten)]
    scene: Scene,
    /// Families to search on; by default all but scales and those held out
    #[arg(long, value_delimiter = ',', value_parser = family())]
    family: Vec<&'static Family>,
    /// Families to validate on alone
    #[arg(long, value_delimiter = ',', value_parser = family(), default_value = HELD_OUT)]
    held_out: Vec<&'static Family>,
    /// How many queries of each family to search on
    #[arg(long, value_name = "N", default_value_t = 400, value_parser = whole, allow_negative_numbers = true)]
    count: u64,
    /// The seed of the families to search on
    #[arg(long, value_name = "S", default_value_t = 1, value_parser = whole, allow_negative_numbers = true)]
    seed: u64,
    /// How many queries of each family to validate on
    #[arg(long, value_name = "N", default_value_t = 4000, value_parser = whole, allow_negative_numbers = true)]
    unseen_count: u64,
    /// The seed of the families to validate on
    #[arg(long, value_name = "S", default_value_t = 2, value_parser = whole, allow_negative_numbers = true)]
    unseen_seed: u64,
    /// How many false hits a missed crossing is as bad as
    #[arg(
        long,
        value_name = "HITS",
        default_value_t = 10.0,
        allow_negative_numbers = true
    )]
    penalty: f64,
    #[command(flatten)]
    keeping: Keeping,
    #[command(flatten)]
    pages: Pages,
}

const HELD_OUT: &str = "near_parallel,temporarily_point,grazing,long_thin,joint";

/// Why a search ends early.
enum End {
    Failure(Failure),
    Interrupted,
}

impl From<Interrupted> for End {
    fn from(_: Interrupted) -> Self {
        End::Interrupted
    }
}

impl From<NoSample> for End {
    fn from(reason: NoSample) -> Self {
        match reason {
            NoSample::Unreadable(error) => End::Failure(error.into()),
            NoSample::Interrupted(_) => End::Interrupted,
        }
    }
}

impl Tune {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        let domain = self.scene.domain()?;
        if !(self.penalty > 0.0 && self.penalty.is_finite()) {
            return Err(Failure::Penalty(self.penalty));
        }
        if self.count == 0 || self.unseen_count == 0 {
            return Err(Failure::Nothing);
        }
        let files = self.pages.prepare()?;
        let stop = interruption()?;
        let tuning = match self.tuning(domain, stop) {
            Ok(tuning) => tuning,
            Err(End::Failure(failure)) => return Err(failure),
            Err(End::Interrupted) => {
                eprintln!("interrupted: nothing was found yet");
                return Ok(interrupted());
            }
        };
        files.write(
            || tuning.text(),
            || tuning.json(),
            || page::of_search(&tuning),
            |figures| page::search_page(&tuning, figures),
        )?;
        Ok(ExitCode::SUCCESS)
    }

    fn tuning(&self, domain: Domain, stop: &AtomicBool) -> Result<Tuning, End> {
        let families = self.families();
        let sample = self.sample(domain, &families, [self.seed, self.count], stop)?;
        let lattice = Lattice {
            length: domain.metres(),
        };
        let penalty = Penalty {
            false_hits: self.penalty,
        };
        let published = |query: &_| Setting::published().answer(query);
        let watch = Watch {
            stop,
            progress: &|_| {},
        };
        let published = sample.judge(&published, sample.parts(), &watch)?;
        let published = Cost::new(&published, &sample);
        let advice: Advice = progress::searching(sample.queries().len(), |progress| {
            let watch = Watch { stop, progress };
            advise(
                &mut Judge::new(lattice, &sample, sample.parts(), watch),
                penalty,
            )
        })?;
        let mut validation = Vec::new();
        for (name, families) in [
            ("queries searched on", None),
            ("the same families with another seed", Some(&families)),
            ("families held out", Some(&self.held_out)),
        ] {
            let unseen = match families {
                Some(families) if families.is_empty() => continue,
                Some(families) => {
                    let which = [self.unseen_seed, self.unseen_count];
                    Some(self.sample(domain, families, which, stop)?)
                }
                None => None,
            };
            let seed = if unseen.is_some() {
                self.unseen_seed
            } else {
                self.seed
            };
            let judged_on = unseen.as_ref().unwrap_or(&sample);
            let candidates = validate(&lattice, &advice, judged_on, &watch)?;
            validation.push(Validation::new(name, seed, judged_on, candidates));
        }
        Ok(Tuning::new(
            &sample, &lattice, penalty, published, &advice, validation,
        ))
    }

    /// The families to search on.
    fn families(&self) -> Vec<&'static Family> {
        if !self.family.is_empty() {
            return self.family.clone();
        }
        let is_held_out = |family: &Family| {
            self.held_out
                .iter()
                .any(|other| other.name() == family.name())
        };
        let families = FAMILIES.iter();
        families
            .filter(|family| has_a_scale(family) && !is_held_out(family))
            .collect()
    }

    /// The first queries of families, with the truth of each.
    fn sample(
        &self,
        domain: Domain,
        families: &[&'static Family],
        [seed, count]: [u64; 2],
        stop: &AtomicBool,
    ) -> Result<Sample, End> {
        let sources = of_families(families, seed, count);
        let (sample, _) = self.keeping.sample(domain, &sources, stop)?;
        Ok(sample)
    }
}

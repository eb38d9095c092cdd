//! Settings judged one after the other.

use std::sync::atomic::{AtomicBool, Ordering};

use serde::{Deserialize, Serialize};

use super::price::Price;
use super::sample::Sample;
use super::setting::Setting;

/// A setting and what it costs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evaluated {
    /// The thresholds.
    pub setting: Setting,
    /// What they cost on the sample.
    pub price: Price,
}

/// That work was ended before its time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interrupted;

/// Who is told how work goes on, and who can end it.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Set to end.
    pub stop: &'a AtomicBool,
    /// Told how many queries were worked on since it was told before.
    pub progress: &'a (dyn Fn(u64) + Sync),
}

impl Watch<'_> {
    /// Whether to go on.
    pub(super) fn check(&self) -> Result<(), Interrupted> {
        match self.stop.load(Ordering::Relaxed) {
            true => Err(Interrupted),
            false => Ok(()),
        }
    }

    pub(super) fn progress(&self, queries: u64) {
        (self.progress)(queries);
    }
}

/// Judges the settings on the whole sample, in their order; those that are `known` are not judged
/// again. `save` is called after each with all that was judged so far.
///
/// The result does not depend on what was known, nor on the number of threads.
///
/// # Errors
///
/// [`Interrupted`] with all that was judged, if the watch says so.
pub fn run(
    sample: &Sample,
    settings: &[Setting],
    known: &[Evaluated],
    watch: &Watch,
    mut save: impl FnMut(&[Evaluated]),
) -> Result<Vec<Evaluated>, (Interrupted, Vec<Evaluated>)> {
    let mut evaluated = Vec::with_capacity(settings.len());
    for &setting in settings {
        let before = known.iter().chain(&evaluated);
        let mut same = before.filter(|known| known.setting.bits() == setting.bits());
        if let Some(same) = same.next() {
            let same = same.clone();
            watch.progress(sample.queries().len() as u64);
            evaluated.push(same);
            continue;
        }
        match sample.judge(&|query| setting.answer(query), sample.parts(), watch) {
            Ok(counts) => {
                let price = counts.price(sample);
                evaluated.push(Evaluated { setting, price });
            }
            Err(interrupted) => return Err((interrupted, evaluated)),
        }
        save(&evaluated);
    }
    Ok(evaluated)
}

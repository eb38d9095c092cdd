//! What settings are worth on queries that the search has not seen.

use serde::Serialize;
use tunnelproof::certified::decide;
use tunnelproof::query::EdgeEdge;

use crate::sweep::{Interrupted, Sample, Setting, Watch};
use tunnelproof_reference::answer::Enclosure;
use tunnelproof_reference::subject::Said;

use super::advise::Advice;
use super::lattice::Lattice;
use super::search::Cost;

/// What a candidate costs on a sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Validated {
    /// Which candidate, of [`CANDIDATES`].
    pub name: &'static str,
    /// Its thresholds; `None` for the certified path, which has none.
    pub setting: Option<Setting>,
    /// What it costs.
    pub cost: Cost,
}

/// Who is validated, in the order of tables.
pub const CANDIDATES: [&str; 6] = [
    "table 3.1",
    "recommended",
    "recommended, reduced",
    "one relative threshold",
    "every threshold 0",
    "certified path",
];

/// Judges table 3.1, what is advised, and the certified path on a sample.
///
/// # Errors
///
/// [`Interrupted`] if the watch says so.
pub fn validate(
    lattice: &Lattice,
    advice: &Advice,
    sample: &Sample,
    watch: &Watch,
) -> Result<Vec<Validated>, Interrupted> {
    let at = |place| Some(lattice.setting(place));
    let settings = [
        Some(Setting::published()),
        at(advice.best.place),
        at(advice.reduced.place),
        at(advice.relative.place),
        Some(Setting::ZERO),
        None,
    ];
    let candidates = CANDIDATES.into_iter().zip(settings);
    let judged = candidates.map(|(name, setting)| {
        let counts = match setting {
            Some(setting) => sample.judge(&|query| setting.answer(query), sample.parts(), watch),
            None => sample.judge(&certified, sample.parts(), watch),
        }?;
        let cost = Cost::new(&counts, sample);
        Ok(Validated {
            name,
            setting,
            cost,
        })
    });
    judged.collect()
}

/// What the certified path says of a query.
pub fn certified(query: &EdgeEdge) -> Said {
    let hit = decide(query);
    Said {
        toi: hit.map(|hit| Enclosure {
            below: hit.toi,
            above: hit.toi_above,
        }),
        case: hit.map(|hit| hit.case),
    }
}

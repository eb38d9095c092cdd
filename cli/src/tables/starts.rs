//! The scenes in guard mode from perturbed starts, by the audit.

use crate::scenes::{Scene, SceneError};
use rayon::prelude::*;
use tunnelproof::wire::Mode;

use super::{Audited, OfThesis, audited, row};
use crate::perturb::perturbed;
use crate::simulate::Narrow;
use tunnelproof_reference::certify::table::grouped;

/// A scene as it is for seed 0, else moved by up to `most` metres.
pub(super) fn start(scene: &Scene, seed: u64, most: f64) -> Scene {
    match seed {
        0 => scene.clone(),
        seed => perturbed(scene, seed, most),
    }
}

/// The scenes as they are and at so many starts moved by up to `most` metres ([`perturbed`], seeds
/// from 1), in guard mode by the certified path: what was prevented, what passed unnoticed, what
/// was reported and is not exact, and what stands on the wrong side at the end.
///
/// # Errors
///
/// A scene cannot be built.
pub fn starts(scenes: &[OfThesis], count: u64, most: f64) -> Result<String, SceneError> {
    let mut text = format!(
        "Guard mode, certified path, by the audit; starts moved by up to {most} m along each axis\n"
    );
    let names = [
        "steps",
        "prevented",
        "missed",
        "not exact",
        "standing",
        "ambiguous",
    ];
    for OfThesis { scene, .. } in scenes {
        let runs = (0..=count)
            .into_par_iter()
            .map(|seed| audited(&start(scene, seed, most), Narrow::Certified, Mode::Guard));
        let runs = runs.collect::<Result<Vec<_>, _>>()?;
        text += "\n";
        text += &row(&scene.title, names.map(str::to_owned));
        for (seed, Audited { summary, report }) in runs.iter().enumerate() {
            let name = match seed {
                0 => "as it is".to_owned(),
                seed => format!("seed {seed}"),
            };
            let standing = report.standing.len() as u64;
            let (missed, inexact) = (report.unnoticed(), report.inexact());
            let ambiguous = report.ambiguous.len() as u64;
            let cells = [
                summary.steps,
                report.prevented,
                missed,
                inexact,
                standing,
                ambiguous,
            ];
            text += &row(&name, cells.map(grouped));
        }
        text += &super::stopped(&runs);
    }
    Ok(text)
}

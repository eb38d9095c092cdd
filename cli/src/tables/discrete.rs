//! At which steps discrete detection lets wires through. Changes of resolution are tested as in the
//! continuous run: in thesis mode they would go through wires at any step, which says nothing about
//! detection.

use crate::scenes::{Scene, SceneError};
use rayon::prelude::*;
use tunnelproof::wire::Mode;

use super::starts::start;
use super::{Audited, OfThesis, audited, heading, row};
use crate::simulate::Narrow;
use tunnelproof_reference::certify::table::grouped;

/// The shortest step of discrete detection that is looked at, in s.
pub(super) const SHORTEST: f64 = 0.001;

/// The longest step of discrete detection that is looked at, in ms: the longest whole number below
/// the scenes' step.
const LONGEST: u32 = 16;

/// The largest step in whole milliseconds, at most 16, up to which no wires pass through each other
/// with discrete detection. A larger one may do by luck: where a step ends with the wires
/// overlapping.
///
/// # Errors
///
/// The scene cannot be built.
pub fn largest_discrete_step(scene: &Scene) -> Result<Option<f64>, SceneError> {
    let mut largest = None;
    for milliseconds in 1..=LONGEST {
        let step = seconds(milliseconds);
        if !run(scene, 0, 0.0, step)?.holds() {
            break;
        }
        largest = Some(step);
    }
    Ok(largest)
}

/// The largest step in whole milliseconds, at most so many seconds, at which no wires pass through
/// each other with discrete detection, neither from the scene as it is nor from so many starts
/// moved by up to `most` metres ([`perturbed`](crate::perturb::perturbed), seeds from 1). What
/// holds from one start may hold by luck.
///
/// # Errors
///
/// The scene cannot be built.
pub fn safe_discrete_step(
    scene: &Scene,
    longest: f64,
    count: u64,
    most: f64,
) -> Result<Option<f64>, SceneError> {
    let longest = (longest * 1000.0).round() as u32;
    for milliseconds in (1..=longest).rev() {
        let step = seconds(milliseconds);
        let found = (0..=count).into_par_iter().try_for_each(|seed| {
            match run(scene, seed, most, step).map(|run| run.holds()) {
                Ok(true) => Ok(()),
                Ok(false) => Err(None),
                Err(error) => Err(Some(error)),
            }
        });
        match found {
            Ok(()) => return Ok(Some(step)),
            Err(None) => {}
            Err(Some(error)) => return Err(error),
        }
    }
    Ok(None)
}

fn seconds(milliseconds: u32) -> f64 {
    f64::from(milliseconds) / 1000.0
}

/// A run with discrete detection at a step in s, from the start of a seed.
pub(super) fn run(scene: &Scene, seed: u64, most: f64, step: f64) -> Result<Audited, SceneError> {
    let mut start = start(scene, seed, most);
    start.settings.step = step;
    audited(&start, Narrow::Discrete, Mode::Guard)
}

/// Of each scene as it is and so many starts, moved by up to the radius of the thinnest wire: from
/// how many discrete detection lets a wire through, at steps of whole milliseconds.
///
/// # Errors
///
/// A scene cannot be built.
pub fn chances(scenes: &[OfThesis], count: u64) -> Result<String, SceneError> {
    let mut text = format!(
        "Starts of {} from which discrete detection lets a wire through (by the audit)\n",
        count + 1
    ) + &heading(scenes);
    for milliseconds in 1..=LONGEST {
        let step = seconds(milliseconds);
        let cell = |of: &OfThesis| {
            let passes = |seed| -> Result<u64, SceneError> {
                let run = run(&of.scene, seed, thinnest(&of.scene), step)?;
                Ok(u64::from(!run.holds()))
            };
            let starts = (0..=count).into_par_iter().map(passes);
            Ok(grouped(starts.try_reduce(|| 0, |a, b| Ok(a + b))?))
        };
        let cells = scenes.iter().map(cell);
        let cells = cells.collect::<Result<Vec<_>, SceneError>>()?;
        text += &row(&format!("{milliseconds} ms"), cells);
    }
    Ok(text)
}

/// The radius of the thinnest wire of a scene in m: by so much a start may differ and be the same
/// scene to the eye, while every step falls elsewhere on the way of a wire.
pub(super) fn thinnest(scene: &Scene) -> f64 {
    let radii = scene.wires.iter().map(|wire| wire.material.radius);
    radii.fold(f64::INFINITY, f64::min)
}

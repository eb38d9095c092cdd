//! Table 4.2: what continuous detection costs, and what it saves.

use tunnelproof::scenario::scenes::{Scene, SceneError};
use tunnelproof::wire::{Mode, StepRecord, World};

use super::discrete::{SHORTEST, largest_discrete_step, safe_discrete_step, thinnest};
use super::{OfThesis, beside, heading, row};
use crate::simulate::{Narrow, Run, Summary};

/// How often a run is repeated where its time is measured.
const REPETITIONS: usize = 3;

/// The run time in s of the fastest of several runs of a scene, and the share of it that collisions take. What else the machine does
/// only makes a run longer.
fn fastest(scene: &Scene, narrow: Narrow, mode: Mode) -> Result<[f64; 2], SceneError> {
    let narrow = &*narrow.phase();
    let run = Run {
        scene,
        narrow,
        mode,
    };
    let unseen = |_: &World, _: &StepRecord| Ok::<(), SceneError>(());
    let mut fastest = [f64::INFINITY; 2];
    for _ in 0..REPETITIONS {
        let Summary {
            wall,
            wall_collision,
            ..
        } = run.go(unseen)?;
        if wall < fastest[0] {
            fastest = [wall, wall_collision / wall];
        }
    }
    Ok(fastest)
}

/// What the thesis has for a scene.
struct Published {
    /// Run time at 1/60 s with continuous detection, and with discrete at its step, in s.
    wall: [f64; 2],
    /// That step in s.
    step: f64,
    /// The change in percent.
    change: f64,
}

/// Table 4.2 of the thesis.
const PUBLISHED: [Published; 4] = [
    Published {
        wall: [0.118, 0.489],
        step: 0.004,
        change: -75.87,
    },
    Published {
        wall: [2.236, 3.649],
        step: 0.010,
        change: -38.72,
    },
    Published {
        wall: [4.269, 4.574],
        step: 0.010,
        change: -6.67,
    },
    Published {
        wall: [2.850, 6.822],
        step: 0.006,
        change: -58.22,
    },
];

/// Table 4.2: what continuous detection costs at 1/60 s, in guard mode by the certified path, against discrete detection
/// at the largest step that does not tunnel: from the scene as it is, as in the thesis, and from so many other starts as well, moved by
/// up to the radius of the thinnest wire ([`safe_discrete_step`]). Run times are those of this machine, without the audit, the least of
/// three. Where no step of a millisecond or more holds, the change is below that against a millisecond.
///
/// # Errors
///
/// A scene cannot be built.
pub fn times(scenes: &[OfThesis], count: u64) -> Result<String, SceneError> {
    let names = [
        "Run time (CCD at 1/60 s), s",
        "Time step (discrete), s",
        "Run time (discrete), s",
        "Total run time change",
        &format!("Time step, {} starts, s", count + 1),
        "Run time (discrete), s",
        "Total run time change",
        "Collisions of run time (ours)",
    ];
    let columns = scenes.iter().map(|of| column(of, count));
    let columns = columns.collect::<Result<Vec<_>, _>>()?;
    let mut text = String::from("Table 4.2: thesis / ours\n") + &heading(scenes);
    for (at, name) in names.into_iter().enumerate() {
        text += &row(name, columns.iter().map(|column| column[at].clone()));
    }
    Ok(text)
}

/// The cells of a scene.
fn column(of: &OfThesis, count: u64) -> Result<[String; 8], SceneError> {
    let (scene, published) = (&of.scene, &PUBLISHED[of.index]);
    let largest = largest_discrete_step(scene)?.map(|(step, _)| step);
    let safe = match largest {
        Some(largest) => safe_discrete_step(scene, largest, count, thinnest(scene))?,
        None => None,
    };
    let [ours, collisions] = fastest(scene, Narrow::Certified, Mode::Guard)?;
    let once = discrete(scene, published, ours, largest)?;
    let safely = if safe == largest {
        once.clone()
    } else {
        discrete(scene, published, ours, safe)?
    };
    let [step, wall, change] = once;
    let [safe_step, safe_wall, safe_change] = safely;
    Ok([
        beside(published.wall[0], format!("{ours:.3}")),
        step,
        wall,
        change,
        safe_step,
        safe_wall,
        safe_change,
        format!("{:.2} %", 100.0 * collisions),
    ])
}

/// Step and run time of discrete detection, and the change from it to `ours` in s. If no step holds, the bounds that the shortest one
/// that was looked at gives.
fn discrete(
    scene: &Scene,
    published: &Published,
    ours: f64,
    step: Option<f64>,
) -> Result<[String; 3], SceneError> {
    let (below, above) = match step {
        Some(_) => ("", ""),
        None => ("below ", "above "),
    };
    let step = step.unwrap_or(SHORTEST);
    let mut slower = scene.clone();
    slower.settings.step = step;
    let [wall, _] = fastest(&slower, Narrow::Discrete, Mode::Thesis)?;
    let change = 100.0 * (ours / wall - 1.0);
    Ok([
        beside(published.step, format!("{below}{step}")),
        beside(published.wall[1], format!("{above}{wall:.3}")),
        beside(
            format!("{} %", published.change),
            format!("{below}{change:.2} %"),
        ),
    ])
}

//! The thesis' tables 4.1 and 4.2 beside what this stepper makes of the same scenes, and tables that it could not have.

use rayon::prelude::*;
use tunnelproof::contact::Case;
use tunnelproof::scenario::scenes::{EMBEDDED, Scene, SceneError};
use tunnelproof::wire::{Mode, StepRecord, World};

use crate::audit::{Audit, Report};
use crate::certify::table::grouped;
use crate::simulate::{Narrow, Run, Summary};

mod rows;
mod starts;

pub use rows::rows;
pub use starts::starts;

#[cfg(test)]
mod tests;

/// The width of the names of rows.
const NAME: usize = 34;

/// The width of a column.
const CELL: usize = 26;

/// A run and what the audit found in it.
pub struct Audited {
    /// What was counted.
    pub summary: Summary,
    /// What was found.
    pub report: Report,
}

impl Audited {
    /// Whether it came to its end and nothing passed.
    fn holds(&self) -> bool {
        self.report.is_clean() && self.summary.stopped.is_none()
    }
}

/// Runs a scene and audits it.
///
/// # Errors
///
/// The scene cannot be built.
pub fn audited(scene: &Scene, narrow: Narrow, mode: Mode) -> Result<Audited, SceneError> {
    let radii = scene.wires.iter().map(|wire| wire.material.radius);
    let mut audit = Audit::new(radii.collect());
    let narrow = &*narrow.phase();
    let run = Run {
        scene,
        narrow,
        mode,
    };
    let summary = run.go(|_, record| {
        audit.step(record);
        Ok::<(), SceneError>(())
    })?;
    let report = audit.finish();
    Ok(Audited { summary, report })
}

/// The scenes of the thesis, none longer than so many seconds.
///
/// # Errors
///
/// None: they build.
pub fn scenes(longest: f64) -> Result<Vec<Scene>, SceneError> {
    let shortened = |(name, _): &(&str, &str)| {
        let mut scene = Scene::embedded(name)?;
        scene.duration = scene.duration.min(longest);
        Ok(scene)
    };
    EMBEDDED.iter().map(shortened).collect()
}

/// A row: a name and a cell for each scene.
fn row(name: &str, cells: impl IntoIterator<Item = String>) -> String {
    let cells = cells.into_iter().map(|cell| format!("{cell:>CELL$}"));
    format!("{name:<NAME$}{}\n", cells.collect::<String>())
}

fn heading(scenes: &[Scene]) -> String {
    row("", scenes.iter().map(|scene| scene.title.clone()))
}

/// `thesis / ours`.
fn beside(thesis: impl ToString, ours: impl ToString) -> String {
    format!("{} / {}", thesis.to_string(), ours.to_string())
}

/// Table 4.1: which cases occur. Thesis mode and thesis path at the scenes' steps.
///
/// # Errors
///
/// A scene cannot be built.
pub fn cases(scenes: &[Scene]) -> Result<String, SceneError> {
    type Ours = fn(&Summary) -> usize;
    let rows: [(&str, [u64; 4], Ours); 7] = [
        ("Number of time steps", [300, 1920, 300, 540], |s| {
            s.steps as usize
        }),
        ("Total tests", [5366, 9919, 154_416, 26_958], |s| s.tested),
        ("Tunneled", [2, 7, 12, 22], |s| s.tunnelled),
        ("Non-degenerate case", [5366, 9919, 154_416, 24_877], |s| {
            s.of_case(&[Case::General])
        }),
        ("Case 3", [0, 0, 0, 0], |s| {
            s.of_case(&[Case::Parallel, Case::Collinear])
        }),
        ("Case 4", [0, 0, 0, 2081], |s| s.of_case(&[Case::Coplanar])),
        ("Temporarily parallel", [0, 0, 0, 7], |s| {
            s.temporarily_parallel
        }),
    ];
    let runs = scenes
        .iter()
        .map(|scene| audited(scene, Narrow::Thesis, Mode::Thesis));
    let runs = runs.collect::<Result<Vec<_>, _>>()?;
    let mut text = String::from("Table 4.1: thesis / ours\n") + &heading(scenes);
    for (name, thesis, ours) in rows {
        let cells = thesis.iter().zip(&runs);
        text += &row(
            name,
            cells.map(|(thesis, run)| beside(grouped(*thesis), grouped(ours(&run.summary) as u64))),
        );
    }
    Ok(text + &stopped(&runs))
}

/// The runs that ended before their time.
fn stopped<'a>(runs: impl IntoIterator<Item = &'a Audited>) -> String {
    let stopped = runs.into_iter().filter_map(|run| {
        let reason = run.summary.stopped.as_ref()?;
        Some(format!("stopped: {}: {reason}\n", run.summary.title))
    });
    stopped.collect()
}

/// Tunnels missed: discrete at the scenes' step, the thesis path, additive CCD, the certified path, each in thesis mode,
/// by the audit.
///
/// # Errors
///
/// A scene cannot be built.
pub fn missed(scenes: &[Scene]) -> Result<String, SceneError> {
    let mut text = String::from(
        "Contacts missed, of them crossings / contacts made; standing at the end (thesis mode, by the audit)\n",
    ) + &heading(scenes);
    let order = [
        Narrow::Discrete,
        Narrow::Thesis,
        Narrow::Additive,
        Narrow::Certified,
    ];
    let mut ended = String::new();
    for narrow in order {
        let runs = scenes
            .iter()
            .map(|scene| audited(scene, narrow, Mode::Thesis));
        let runs = runs.collect::<Result<Vec<_>, _>>()?;
        let cell = |Audited { report, .. }: &Audited| {
            let missed = report.missed.iter().sum::<u64>();
            let (crossings, standing) = (report.missed_crossings, report.standing.len());
            format!("{missed}, {crossings} / {}; {standing}", report.contacts)
        };
        text += &row(narrow.name(), runs.iter().map(cell));
        ended += &stopped(&runs);
    }
    Ok(text + &ended)
}

/// Scene 1 at speeds from 1 to 200 m/s: what discrete detection lets through, and guard mode.
///
/// # Errors
///
/// None: the scene builds.
pub fn speeds(duration: f64) -> Result<String, SceneError> {
    let mut text = String::from("Basic collision at other speeds\n");
    let names = [
        "discrete: standing",
        "guard: prevented",
        "guard: missed",
        "guard: standing",
    ];
    text += &row("speed, m/s", names.map(str::to_owned));
    for speed in [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0] {
        let mut scene = Scene::embedded("basic-collision")?;
        scene.duration = scene.duration.min(duration);
        for wire in &mut scene.wires {
            wire.velocity[2] *= speed / 10.0;
        }
        let discrete = audited(&scene, Narrow::Discrete, Mode::Thesis)?.report;
        let guard = audited(&scene, Narrow::Certified, Mode::Guard)?.report;
        let missed = guard.missed.iter().sum::<u64>();
        let (lost, standing) = (discrete.standing.len() as u64, guard.standing.len() as u64);
        let cells = [lost, guard.prevented, missed, standing].map(grouped);
        text += &row(&speed.to_string(), cells);
    }
    Ok(text)
}

/// The largest step in whole milliseconds, at most 16, up to which no wires pass through each other with discrete
/// detection. A larger one may do by luck: where a step ends with the wires overlapping.
///
/// # Errors
///
/// The scene cannot be built.
pub fn largest_discrete_step(scene: &Scene) -> Result<Option<(f64, Audited)>, SceneError> {
    let mut largest = None;
    for milliseconds in 1..=16 {
        let mut scene = scene.clone();
        scene.settings.step = f64::from(milliseconds) / 1000.0;
        let run = audited(&scene, Narrow::Discrete, Mode::Thesis)?;
        if !run.holds() {
            break;
        }
        largest = Some((scene.settings.step, run));
    }
    Ok(largest)
}

/// The largest step in whole milliseconds, at most so many seconds, at which no wires pass through each other with discrete detection,
/// neither from the scene as it is nor from so many starts moved by up to `most` metres
/// ([`perturbed`](crate::perturb::perturbed), seeds from 1). What holds from one start may hold by luck.
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
    let tunnels = |seed: u64, step: f64| {
        let mut start = starts::start(scene, seed, most);
        start.settings.step = step;
        Ok(!audited(&start, Narrow::Discrete, Mode::Thesis)?.holds())
    };
    let longest = (longest * 1000.0).round() as u32;
    for milliseconds in (1..=longest).rev() {
        let step = f64::from(milliseconds) / 1000.0;
        let found = (0..=count)
            .into_par_iter()
            .try_for_each(|seed| match tunnels(seed, step) {
                Ok(false) => Ok(()),
                Ok(true) => Err(None),
                Err(error) => Err(Some(error)),
            });
        match found {
            Ok(()) => return Ok(Some(step)),
            Err(None) => {}
            Err(Some(error)) => return Err(error),
        }
    }
    Ok(None)
}

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

/// Table 4.2: what continuous detection costs at 1/60 s, in guard mode by the certified path, against discrete detection
/// at the largest step that does not tunnel: from the scene as it is, as in the thesis, and from so many other starts as well
/// ([`safe_discrete_step`]). Run times are those of this machine, without the audit, the least of three.
///
/// # Errors
///
/// A scene cannot be built.
pub fn times(scenes: &[Scene], count: u64, most: f64) -> Result<String, SceneError> {
    let thesis = [
        (0.004, [0.118, 0.489], -75.87),
        (0.010, [2.236, 3.649], -38.72),
        (0.010, [4.269, 4.574], -6.67),
        (0.006, [2.850, 6.822], -58.22),
    ];
    let mut rows = vec![Vec::new(); 8];
    for (scene, (step, [continuous, discrete], change)) in scenes.iter().zip(thesis) {
        let largest = largest_discrete_step(scene)?.map(|(step, _)| step);
        let safe = match largest {
            Some(largest) => safe_discrete_step(scene, largest, count, most)?,
            None => None,
        };
        let [ours, collisions] = fastest(scene, Narrow::Certified, Mode::Guard)?;
        let at = |step| {
            let mut scene = scene.clone();
            scene.settings.step = step;
            fastest(&scene, Narrow::Discrete, Mode::Thesis).map(|[wall, _]| wall)
        };
        let other = largest.map(at).transpose()?;
        let safely = if safe == largest {
            other
        } else {
            safe.map(at).transpose()?
        };
        let written = |number: Option<String>| number.unwrap_or_else(|| "none".to_owned());
        let length = |step: Option<f64>| written(step.map(|step| step.to_string()));
        let time = |wall: Option<f64>| written(wall.map(|wall| format!("{wall:.3}")));
        let against = |wall: Option<f64>| {
            let ratio = wall.map(|wall| 100.0 * (ours / wall - 1.0));
            let ratio = written(ratio.map(|ratio| format!("{ratio:.2} %")));
            beside(format!("{change} %"), ratio)
        };
        let cells = [
            beside(continuous, format!("{ours:.3}")),
            beside(step, length(largest)),
            beside(discrete, time(other)),
            against(other),
            beside(step, length(safe)),
            beside(discrete, time(safely)),
            against(safely),
            format!("{:.2} %", 100.0 * collisions),
        ];
        for (row, cell) in rows.iter_mut().zip(cells) {
            row.push(cell);
        }
    }
    let names = [
        "Run time (CCD at 1/60 s), s".to_owned(),
        "Time step (discrete), s".to_owned(),
        "Run time (discrete), s".to_owned(),
        "Total run time change".to_owned(),
        format!("Time step, {} starts, s", count + 1),
        "Run time (discrete), s".to_owned(),
        "Total run time change".to_owned(),
        "Collisions of run time (ours)".to_owned(),
    ];
    let mut text = String::from("Table 4.2: thesis / ours\n") + &heading(scenes);
    for (name, cells) in names.into_iter().zip(rows) {
        text += &row(&name, cells);
    }
    Ok(text)
}

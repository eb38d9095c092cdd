//! The thesis' tables 4.1 and 4.2 beside what this stepper makes of the same scenes, and tables that it could not have.

use crate::scenes::{EMBEDDED, Scene, SceneError};
use tunnelproof::contact::Case;
use tunnelproof::wire::Mode;

use crate::audit::{Audit, Report};
use crate::simulate::{Narrow, Run, Summary};
use tunnelproof_reference::certify::table::grouped;

mod discrete;
mod rows;
mod starts;
mod times;

pub use discrete::{chances, largest_discrete_step, safe_discrete_step};
pub use rows::rows;
pub use starts::starts;
pub use times::times;

#[cfg(test)]
mod tests;

/// The width of the names of rows.
const NAME: usize = 40;

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
    let mut audit = Audit::of_world(&scene.world()?);
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

/// A scene of the thesis.
#[derive(Clone, Debug)]
pub struct OfThesis {
    /// Where it is in [`EMBEDDED`].
    pub index: usize,
    /// The scene.
    pub scene: Scene,
}

/// The scenes of the thesis, or the one of a name, none longer than so many seconds.
///
/// # Errors
///
/// No scene has the name.
pub fn scenes(longest: f64, name: Option<&str>) -> Result<Vec<OfThesis>, SceneError> {
    if let Some(name) = name {
        Scene::embedded(name)?;
    }
    let shortened = |(index, (name, _)): (usize, &(&str, &str))| {
        let mut scene = Scene::embedded(name)?;
        scene.duration = scene.duration.min(longest);
        Ok(OfThesis { index, scene })
    };
    let all = EMBEDDED.iter().enumerate();
    all.filter(|(_, (known, _))| name.is_none_or(|name| name == *known))
        .map(shortened)
        .collect()
}

/// A row: a name and a cell for each scene.
fn row(name: &str, cells: impl IntoIterator<Item = String>) -> String {
    let cells = cells.into_iter().map(|cell| format!("{cell:>CELL$}"));
    format!("{name:<NAME$}{}\n", cells.collect::<String>())
}

fn heading(scenes: &[OfThesis]) -> String {
    row("", scenes.iter().map(|of| of.scene.title.clone()))
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
pub fn cases(scenes: &[OfThesis]) -> Result<String, SceneError> {
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
        .map(|of| audited(&of.scene, Narrow::Thesis, Mode::Thesis));
    let runs = runs.collect::<Result<Vec<_>, _>>()?;
    let mut text = String::from("Table 4.1: thesis / ours\n") + &heading(scenes);
    for (name, thesis, ours) in rows {
        let cells = scenes.iter().zip(&runs).map(|(of, run)| {
            let ours = ours(&run.summary) as u64;
            beside(grouped(thesis[of.index]), grouped(ours))
        });
        text += &row(name, cells);
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

/// Tunnels missed: discrete at the scenes' step, the thesis path with the thresholds of table 3.1 and with those that `tune` recommends,
/// additive CCD, the certified path, each in thesis mode, by the audit.
///
/// # Errors
///
/// A scene cannot be built.
pub fn missed(scenes: &[OfThesis]) -> Result<String, SceneError> {
    let mut text = String::from(
        "Contacts missed, of them crossings / contacts made; standing at the end + ambiguous (thesis mode, by the audit)\n",
    ) + &heading(scenes);
    let order = [
        Narrow::Discrete,
        Narrow::Thesis,
        Narrow::Tuned,
        Narrow::Additive,
        Narrow::Certified,
    ];
    let mut ended = String::new();
    for narrow in order {
        let runs = scenes
            .iter()
            .map(|of| audited(&of.scene, narrow, Mode::Thesis));
        let runs = runs.collect::<Result<Vec<_>, _>>()?;
        let cell = |Audited { report, .. }: &Audited| {
            let missed = report.missed.iter().sum::<u64>();
            let (crossings, standing) = (report.missed_crossings, report.standing.len());
            let standing = match report.ambiguous.len() {
                0 => standing.to_string(),
                ambiguous => format!("{standing} + {ambiguous}"),
            };
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
        "ambiguous",
        "guard: prevented",
        "guard: missed",
        "guard: standing",
        "ambiguous",
    ];
    text += &row("speed, m/s", names.map(str::to_owned));
    for speed in [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0] {
        let mut scene = Scene::embedded("basic-collision")?;
        scene.duration = scene.duration.min(duration);
        for wire in &mut scene.wires {
            wire.velocity[2] *= speed / 10.0;
        }
        let discrete = audited(&scene, Narrow::Discrete, Mode::Guard)?.report;
        let guard = audited(&scene, Narrow::Certified, Mode::Guard)?.report;
        let missed = guard.missed.iter().sum::<u64>();
        let [lost, held] = [&discrete, &guard]
            .map(|report| [report.standing.len() as u64, report.ambiguous.len() as u64]);
        let cells = [lost[0], lost[1], guard.prevented, missed, held[0], held[1]].map(grouped);
        text += &row(&speed.to_string(), cells);
    }
    Ok(text)
}

//! Table 4.2: what continuous detection costs, and what it saves.

use crate::scenes::{Scene, SceneError};
use tunnelproof::wire::{Mode, StepRecord, World};

use super::discrete::{SHORTEST, largest_discrete_step, safe_discrete_step, thinnest};
use super::{OfThesis, beside, heading, row};
use crate::simulate::{Narrow, Run};
use tunnelproof_reference::certify::table::grouped;

/// How often a run is repeated where its time is measured.
const REPETITIONS: usize = 3;

/// The fastest of several runs of a scene. What else the machine does only makes a run longer.
fn fastest(scene: &Scene, narrow: Narrow, mode: Mode) -> Result<Timed, SceneError> {
    let narrow = &*narrow.phase();
    let run = Run {
        scene,
        narrow,
        mode,
    };
    let unseen = |_: &World, _: &StepRecord| Ok::<(), SceneError>(());
    let mut fastest = run.go(unseen)?;
    for _ in 1..REPETITIONS {
        let other = run.go(unseen)?;
        if other.wall < fastest.wall {
            fastest = other;
        }
    }
    Ok(Timed {
        steps: fastest.steps,
        wall: fastest.wall,
        narrow: fastest.wall_narrow,
        tests: fastest.tested + fastest.tested_bodies,
    })
}

/// What a run took.
struct Timed {
    /// Steps.
    steps: u64,
    /// Run time in s.
    wall: f64,
    /// Of this, the narrow phase.
    narrow: f64,
    /// How many pairs that tested, those with bodies too.
    tests: usize,
}

impl Timed {
    /// Time per test in ns.
    fn per_test(&self) -> f64 {
        1e9 * self.narrow / self.tests as f64
    }
}

/// Table 4.2 of the thesis, for a scene: its continuous and its discrete run. Narrow-phase tests
/// are those of bodies too.
struct Published {
    /// The step of the discrete run in s.
    step: f64,
    runs: [Timed; 2],
    /// Time per test in ns: its own figures, from times that it does not round.
    per_test: [f64; 2],
}

impl Published {
    const fn new(
        step: f64,
        steps: [u64; 2],
        wall: [f64; 2],
        narrow: [f64; 2],
        tests: [usize; 2],
        per_test: [f64; 2],
    ) -> Self {
        let [continuous, discrete] = [
            Timed {
                steps: steps[0],
                wall: wall[0],
                narrow: narrow[0],
                tests: tests[0],
            },
            Timed {
                steps: steps[1],
                wall: wall[1],
                narrow: narrow[1],
                tests: tests[1],
            },
        ];
        Published {
            step,
            runs: [continuous, discrete],
            per_test,
        }
    }
}

const PUBLISHED: [Published; 4] = [
    Published::new(
        0.004,
        [300, 1250],
        [0.118, 0.489],
        [0.004, 0.012],
        [5384, 22_169],
        [743.0, 541.0],
    ),
    Published::new(
        0.010,
        [1920, 3200],
        [2.236, 3.649],
        [0.040, 0.051],
        [15_159, 22_454],
        [2640.0, 2270.0],
    ),
    Published::new(
        0.010,
        [300, 500],
        [4.269, 4.574],
        [0.069, 0.061],
        [154_416, 230_959],
        [444.0, 264.0],
    ),
    Published::new(
        0.006,
        [540, 1500],
        [2.850, 6.822],
        [0.100, 0.254],
        [147_173, 594_294],
        [679.0, 427.0],
    ),
];

/// Table 4.2: what continuous detection costs at 1/60 s, in guard mode by the certified path,
/// against discrete detection at the largest step that does not tunnel: from the scene as it is, as
/// in the thesis, and from so many other starts as well, moved by up to the radius of the thinnest
/// wire ([`safe_discrete_step`]). Run times are those of this machine, without the audit, the least
/// of three. Where no step of a millisecond or more holds, the run is one of a millisecond, and the
/// change is below that against it.
///
/// # Errors
///
/// A scene cannot be built.
pub fn times(scenes: &[OfThesis], count: u64) -> Result<String, SceneError> {
    let columns = scenes.iter().map(|of| column(of, count));
    let columns = columns.collect::<Result<Vec<_>, _>>()?;
    let mut text = String::from("Table 4.2: thesis / ours\n") + &heading(scenes);
    for (at, (name, _)) in columns.first().into_iter().flatten().enumerate() {
        text += &row(name, columns.iter().map(|column| column[at].1.clone()));
    }
    Ok(text)
}

/// Names of rows, and the cells of a scene.
type Cells = Vec<(String, String)>;

fn column(of: &OfThesis, count: u64) -> Result<Cells, SceneError> {
    let (scene, published) = (&of.scene, &PUBLISHED[of.index]);
    let largest = largest_discrete_step(scene)?;
    let safe = match largest {
        Some(largest) => safe_discrete_step(scene, largest, count, thinnest(scene))?,
        None => None,
    };
    let at = |step: f64| {
        let mut scene = scene.clone();
        scene.settings.step = step;
        fastest(&scene, Narrow::Discrete, Mode::Guard)
    };
    let ours = fastest(scene, Narrow::Certified, Mode::Guard)?;
    let step = largest.unwrap_or(SHORTEST);
    let discrete = at(step)?;
    let mut cells = vec![(
        "Run time, s (CCD at 1/60 s)".to_owned(),
        beside(published.runs[0].wall, format!("{:.3}", ours.wall)),
    )];
    cells.extend(narrow("CCD at 1/60 s", 0, published, &ours));
    cells.extend(against("discrete", published, &ours, largest, &discrete));
    cells.extend(narrow("discrete", 1, published, &discrete));
    let share = |per_test: [f64; 2]| format!("{:.2} %", 100.0 * per_test[1] / per_test[0]);
    cells.push((
        "Time per test (discrete / CCD)".to_owned(),
        beside(
            share(published.per_test),
            share([&ours, &discrete].map(Timed::per_test)),
        ),
    ));
    let name = match count {
        0 => "1 start".to_owned(),
        others => format!("{} starts", others + 1),
    };
    let safe_step = safe.unwrap_or(SHORTEST);
    let safely = if safe_step == step {
        discrete
    } else {
        at(safe_step)?
    };
    cells.extend(against(&name, published, &ours, safe, &safely));
    Ok(cells)
}

/// A discrete run at a step that holds, against the continuous one. If no step holds, that at the
/// shortest one bounds it.
fn against(
    name: &str,
    published: &Published,
    ours: &Timed,
    step: Option<f64>,
    discrete: &Timed,
) -> Cells {
    let (below, above) = match step {
        Some(_) => ("", ""),
        None => ("below ", "above "),
    };
    let [theirs, at_theirs] = &published.runs;
    let change = |a: f64, b: f64| format!("{:.2} %", 100.0 * (a / b - 1.0));
    let steps =
        |slow: &Timed, fast: &Timed| format!("{:.3}", slow.steps as f64 / fast.steps as f64);
    let time = |slow: &Timed, fast: &Timed| format!("{:.3}", slow.wall / fast.wall);
    let step = step.unwrap_or(SHORTEST);
    vec![
        (
            format!("Time step, s ({name})"),
            beside(published.step, format!("{below}{step}")),
        ),
        (
            format!("Run time, s ({name})"),
            beside(at_theirs.wall, format!("{above}{:.3}", discrete.wall)),
        ),
        (
            format!("Factor time steps ({name} / CCD)"),
            beside(
                steps(at_theirs, theirs),
                above.to_owned() + &steps(discrete, ours),
            ),
        ),
        (
            format!("Factor run time ({name} / CCD)"),
            beside(
                time(at_theirs, theirs),
                above.to_owned() + &time(discrete, ours),
            ),
        ),
        (
            "Total run time change".to_owned(),
            beside(
                change(theirs.wall, at_theirs.wall),
                below.to_owned() + &change(ours.wall, discrete.wall),
            ),
        ),
    ]
}

/// The narrow phase of a run.
fn narrow(name: &str, which: usize, published: &Published, ours: &Timed) -> Cells {
    let theirs = &published.runs[which];
    let share = |run: &Timed| format!("{:.2} %", 100.0 * run.narrow / run.wall);
    vec![
        (
            format!("Narrow phase, s ({name})"),
            beside(theirs.narrow, format!("{:.4}", ours.narrow)),
        ),
        (
            format!("  of run time ({name})"),
            beside(share(theirs), share(ours)),
        ),
        (
            format!("  tests ({name})"),
            beside(grouped(theirs.tests as u64), grouped(ours.tests as u64)),
        ),
        (
            format!("  per test, ns ({name})"),
            beside(published.per_test[which], format!("{:.0}", ours.per_test())),
        ),
    ]
}

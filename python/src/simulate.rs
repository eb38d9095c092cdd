//! Scenes of wires from start to end.

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use tunnelproof::wire::recording::Header;
use tunnelproof::wire::{Mode, StepRecord};
use tunnelproof_cli::audit::{self, Audit};
use tunnelproof_cli::replay::{self, Drawing, Replay};
use tunnelproof_cli::report;
use tunnelproof_cli::scenes::{EMBEDDED, Scene, SceneError};
use tunnelproof_cli::simulate::{Narrow, Run, Summary};
use tunnelproof_float_env::with_default;
use tunnelproof_reference::certify::caller::Caller;

/// The names of the scenes that are built in.
#[pyfunction]
pub(crate) fn scenes() -> Vec<&'static str> {
    EMBEDDED.iter().map(|(name, _)| *name).collect()
}

/// What there is to see of a run, or of two on one clock.
#[pyclass(frozen)]
pub(crate) struct Seen(Vec<Replay>);

#[pymethods]
impl Seen {
    /// The page to watch it.
    fn page(&self, py: Python<'_>) -> PyResult<String> {
        let page = py.detach(|| with_default(|| replay::page(&self.0)));
        page.map_err(refused)
    }

    /// How many frames there are.
    fn frames(&self) -> usize {
        with_default(|| Drawing::new(&self.0).frames())
    }

    /// A frame as an SVG document.
    fn frame(&self, py: Python<'_>, index: usize) -> PyResult<String> {
        let drawn = || {
            let drawing = Drawing::new(&self.0);
            (index < drawing.frames()).then(|| drawing.frame(index))
        };
        let frame = py.detach(|| with_default(drawn));
        frame.ok_or_else(|| PyIndexError::new_err(format!("there is no frame {index}")))
    }
}

fn refused(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Why there is no run: a scene that is none, or an interrupt.
struct NoRun(PyErr);

impl From<SceneError> for NoRun {
    fn from(error: SceneError) -> Self {
        NoRun(refused(error))
    }
}

/// One run: what happened, as it is shown, and the nodes of every wire after every step.
struct Done {
    summary: Summary,
    replay: Replay,
    audit: Option<audit::Report>,
    times: Vec<f64>,
    wires: Vec<Vec<Vec<f64>>>,
}

/// What is run, and how.
struct Plan {
    scene: Scene,
    mode: (&'static str, Mode),
    is_audited: bool,
}

impl Plan {
    fn run(&self, narrow: Narrow) -> Result<Done, NoRun> {
        let world = self.scene.world()?;
        let replay = Replay::new(&self.scene.title, Header::from(&world), self.scene.steps());
        let (mode_name, mode) = self.mode;
        let how = format!("{}, {mode_name} mode", narrow.name());
        let mut replay = replay.named_as_in(&self.scene).called(&how);
        let mut audit = self.is_audited.then(|| Audit::of_world(&world));
        let (mut times, mut wires) = (Vec::new(), Vec::new());
        let run = Run {
            scene: &self.scene,
            narrow: &*narrow.phase(),
            mode,
        };
        let summary = run.go(|_, record| {
            replay.step(record);
            if let Some(audit) = &mut audit {
                audit.step(record);
            }
            times.push(record.time);
            wires.push(nodes(record));
            Python::attach(|py| py.check_signals()).map_err(NoRun)
        })?;
        let replay = replay.ended(&world, &summary);
        let audit = audit.map(Audit::finish);
        Ok(Done {
            summary,
            replay: match &audit {
                Some(report) => replay.audited(report),
                None => replay,
            },
            audit,
            times,
            wires,
        })
    }
}

/// The coordinates of the nodes of each wire, one after the other.
fn nodes(record: &StepRecord) -> Vec<Vec<f64>> {
    let wires = record.wires.iter();
    wires
        .map(|wire| {
            wire.after
                .iter()
                .flat_map(|at| [at.x, at.y, at.z])
                .collect()
        })
        .collect()
}

fn narrow(name: &str) -> PyResult<Narrow> {
    let mut all = Narrow::ALL.into_iter();
    all.find(|narrow| narrow.name() == name).ok_or_else(|| {
        let names = Narrow::ALL.map(Narrow::name).join(", ");
        refused(format!("narrow is {name:?}, none of {names}"))
    })
}

fn mode(name: &str) -> PyResult<(&'static str, Mode)> {
    match name {
        "guard" => Ok(("guard", Mode::Guard)),
        "thesis" => Ok(("thesis", Mode::Thesis)),
        _ => Err(refused(format!(
            "mode is {name:?}, neither \"guard\" nor \"thesis\""
        ))),
    }
}

/// The fields of `Simulation`. The scene is the name of one that is built in, or the text of a scene file.
#[pyfunction]
#[pyo3(signature = (scene, narrow, mode, step, duration, audit, beside))]
#[allow(
    clippy::too_many_arguments,
    reason = "called from one place, which names them"
)]
pub(crate) fn simulate<'py>(
    py: Python<'py>,
    scene: &str,
    narrow: &str,
    mode: &str,
    step: Option<f64>,
    duration: Option<f64>,
    audit: bool,
    beside: Option<&str>,
) -> PyResult<Bound<'py, PyDict>> {
    let narrow = self::narrow(narrow)?;
    let beside = beside.map(self::narrow).transpose()?;
    let mode = self::mode(mode)?;
    let run = || {
        let mut read = match EMBEDDED.iter().any(|(name, _)| *name == scene) {
            true => Scene::embedded(scene),
            false => Scene::from_toml(scene),
        }?;
        read.settings.step = step.unwrap_or(read.settings.step);
        read.duration = duration.unwrap_or(read.duration);
        let plan = Plan {
            scene: read,
            mode,
            is_audited: audit,
        };
        let first = plan.run(narrow)?;
        let second = beside.map(|beside| plan.run(beside)).transpose()?;
        Ok((first, second))
    };
    let runs: Result<_, NoRun> = py.detach(|| with_default(run));
    let (first, second) = runs.map_err(|NoRun(error)| error)?;
    written(py, narrow.name(), mode.0, first, second)
}

fn written<'py>(
    py: Python<'py>,
    narrow: &str,
    mode: &str,
    first: Done,
    second: Option<Done>,
) -> PyResult<Bound<'py, PyDict>> {
    let fields = PyDict::new(py);
    let report = |audit| report::audit::text(audit, &Caller::Python);
    let audited = first.audit.as_ref().map(report);
    let text = format!("{}{}", first.summary, audited.unwrap_or_default());
    fields.set_item("text", text)?;
    let json = serde_json::json!({
        "narrow": narrow,
        "mode": mode,
        "summary": first.summary,
        "audit": first.audit,
    });
    fields.set_item("json", json.to_string())?;
    let is_clean = first.audit.as_ref().map(audit::Report::is_clean);
    fields.set_item("is_clean", is_clean)?;
    fields.set_item("times", PyArray1::from_vec(py, first.times))?;
    let wires = first.wires.into_iter().map(|wires| {
        let arrays = wires.into_iter().map(|flat| points(py, flat));
        arrays.collect::<PyResult<Vec<_>>>()
    });
    fields.set_item("wires", wires.collect::<PyResult<Vec<_>>>()?)?;
    let replays = std::iter::once(first.replay).chain(second.map(|second| second.replay));
    fields.set_item("_seen", Seen(replays.collect()))?;
    Ok(fields)
}

fn points(py: Python<'_>, flat: Vec<f64>) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let count = flat.len() / 3;
    PyArray1::from_vec(py, flat).reshape([count, 3])
}

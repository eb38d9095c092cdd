//! `simulate`: a scene from start to end, recorded and audited.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use serde::Serialize;
use tunnelproof::wire;
use tunnelproof_cli::audit::{self, Audit};
use tunnelproof_cli::replay::{self, Drawing, Replay};
use tunnelproof_cli::report;
use tunnelproof_cli::scenes::{Difference, Scene};
use tunnelproof_cli::simulate::{Narrow, Summary};

mod plan;
mod saving;
mod watch;

use self::plan::Plan;
use self::saving::Saving;
use self::watch::Watch;
use super::keeping::{interrupted, interruption};
use super::output::{JsonOutput, OutputFile, print, shell, unwritable};
use super::{Failure, progress, share};

/// Run a scene, and check every step of it for missed tunnels
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof simulate basic-collision --audit
  tunnelproof simulate basic-collision --mode thesis --narrow thesis --record run.tps
  tunnelproof simulate twisting-under-load --audit --replay run.html
  tunnelproof simulate basic-collision --beside discrete --replay both.html --frames pictures
  tunnelproof simulate my-scene.toml --step 0.01 --duration 2 --json -
  tunnelproof simulate my-scene.toml --duration 3600 --save hour.tpstate --save-every 1000
  tunnelproof simulate my-scene.toml --duration 3600 --from hour.tpstate
  tunnelproof simulate --schema > scene.schema.json

Scenes of your own: docs/recipes.md has some to start from, docs/scenes.md all that they may have. docs/simulate.md
says what is printed and written. The hang of a route knows no bodies: free stops lay a wire on a floor.

Scenes of the thesis (4.2): basic-collision, pulling-anchor, twisting-under-load, chains-on-deck. Exit code 1 if
a step cannot be done, or the audit finds that something passed unnoticed, or stands or may stand on the wrong side.
What thesis mode lets pass and reports, as through bodies, is no fault of the run; 130 if Ctrl-C ended a run that is saved.")]
pub(super) struct Simulate {
    /// The name of a scene of the thesis, or the path of a scene file
    #[arg(required_unless_present = "schema")]
    scene: Option<String>,
    /// Print the JSON schema of scene files, and do no more
    #[arg(long)]
    schema: bool,
    /// How pairs of segments are tested: certified if left out, or as until the state of --from
    #[arg(long, value_parser = narrow())]
    narrow: Option<Narrow>,
    /// What becomes of a crossing: prevented, or pushed back in the next steps; guard if left out, or
    /// as until the state of --from
    #[arg(long, value_enum)]
    mode: Option<Mode>,
    /// The time step in s, in place of the scene's
    #[arg(long, value_name = "S")]
    step: Option<f64>,
    /// The share of the thickness of wires that guard mode keeps, from 0 and below 1, in place of the
    /// scene's
    #[arg(long, value_name = "SHARE", value_parser = share)]
    guarded_thickness: Option<f64>,
    /// The duration in s, in place of the scene's; with --from too it counts from the start of the
    /// scene
    #[arg(long, value_name = "S")]
    duration: Option<f64>,
    /// Start elsewhere: every body and point moved along each axis by up to a millimetre, at random
    #[arg(long, value_name = "SEED")]
    perturb: Option<u64>,
    /// Go on from a state that --save has written, of the same scene. All is set as the scene and the
    /// options say; what was set otherwise until then is told
    #[arg(long, value_name = "FILE")]
    from: Option<PathBuf>,
    #[command(flatten)]
    saving: Saving,
    /// Write every step to this file, for `audit`
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Check every step by the exact oracle
    #[arg(long)]
    audit: bool,
    /// Write a page to watch the run to this file
    #[arg(long, value_name = "OUT")]
    replay: Option<PathBuf>,
    /// Run the scene once more, with this narrow phase, and show both runs beside each other
    #[arg(long, value_name = "NARROW", value_parser = narrow())]
    beside: Option<Narrow>,
    /// Write a picture of every step to this folder, frame-000000.svg and so on, to make a video of
    #[arg(long, value_name = "FOLDER")]
    frames: Option<PathBuf>,
    /// Write every step to this folder for ParaView: steps.pvd, and for each step a .vtp and one of
    /// the bodies
    #[arg(long, value_name = "FOLDER")]
    vtk: Option<PathBuf>,
    /// Write a line for each step to this file, for spreadsheets: energies, tension, contacts, what was
    /// prevented, how the step was solved
    #[arg(long, value_name = "OUT")]
    csv: Option<PathBuf>,
    /// Write the summary, and the audit, to this file, as JSON; - is the standard output, in place
    /// of the text
    #[arg(long, value_name = "OUT")]
    json: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Mode {
    Guard,
    Thesis,
}

/// What `--json` writes.
#[derive(Serialize)]
struct Document<'a> {
    /// How pairs were tested.
    narrow: &'static str,
    /// `guard` or `thesis`.
    mode: &'static str,
    /// What is set otherwise than it was until the state that the run goes on from.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    differences: &'a Vec<Difference>,
    /// What happened.
    summary: &'a Summary,
    /// What the audit came to.
    audit: Option<&'a audit::Report>,
}

impl Simulate {
    pub(super) fn run(self) -> Result<ExitCode, Failure> {
        if self.schema {
            print(&format!("{:#}\n", Scene::schema()))?;
            return Ok(ExitCode::SUCCESS);
        }
        let plan = self.plan()?;
        self.check_outputs()?;
        let json = JsonOutput::create(self.json.as_deref())?;
        let page = self.replay.as_deref().map(OutputFile::create).transpose()?;
        self.saving.check()?;
        let unstopped = AtomicBool::new(false);
        let stop = match self.saving.is_asked() {
            true => interruption()?,
            false => &unstopped,
        };
        let narrow = plan.narrow.phase();
        let mut watch = Watch::new(&self, &plan)?;
        let run = plan.run(&*narrow);
        let (summary, state) = progress::working(plan.steps() as usize, "steps", |done| {
            run.go_from(&plan.start, stop, |world, collisions, record| {
                done(1);
                watch.step(record)?;
                self.saving.step(world, collisions, plan.narrow)
            })
        })?;
        let steps = state.world.steps();
        self.saving.end(state, plan.narrow)?;
        let is_stopped = summary.steps < plan.steps() && summary.stopped.is_none();
        watch.finish()?;
        let audit = watch.audit.map(Audit::finish);
        if let Some(replay) = watch.replay {
            let replay = replay.ended(&plan.start.world, &summary);
            let runs = self.shown(replay, audit.as_ref(), &plan)?;
            if let Some(page) = page {
                page.write(&replay::page(&runs).map_err(super::audit::no_json)?)?;
            }
            if let Some(folder) = &self.frames {
                draw(&runs, folder)?;
            }
        }
        let document = Document {
            narrow: plan.narrow.name(),
            mode: plan.mode.name(),
            differences: &plan.differences,
            summary: &summary,
            audit: audit.as_ref(),
        };
        let text = |audit| report::audit::text(audit, &shell());
        let audited = || audit.as_ref().map_or(String::new(), text);
        json.write(
            || super::audit::as_json(&document),
            || format!("{summary}{}", audited()),
        )?;
        if is_stopped {
            eprintln!("interrupted after {steps} steps; --from goes on");
            return Ok(interrupted());
        }
        let clean = audit.is_none_or(|audit| audit.is_clean());
        Ok(match clean && summary.stopped.is_none() {
            true => ExitCode::SUCCESS,
            false => ExitCode::FAILURE,
        })
    }

    /// Whether every output has a place of its own.
    fn check_outputs(&self) -> Result<(), Failure> {
        let save = self.saving.file();
        let json = self.json.as_deref().filter(|path| *path != Path::new("-"));
        let outputs = [
            ("--record", self.record.as_deref()),
            ("--replay", self.replay.as_deref()),
            ("--frames", self.frames.as_deref()),
            ("--vtk", self.vtk.as_deref()),
            ("--csv", self.csv.as_deref()),
            ("--save", save),
            ("--json", json),
        ];
        for (at, (option, path)) in outputs.iter().enumerate() {
            let Some(path) = path else { continue };
            if let Some((other, _)) = outputs[..at].iter().find(|(_, known)| *known == Some(path)) {
                let problem = format!("{other} and {option} would both be written there");
                return Err(Failure::file(path, problem));
            }
        }
        Ok(())
    }

    /// The run, and the one beside it.
    fn shown(
        &self,
        replay: Replay,
        audit: Option<&audit::Report>,
        plan: &Plan,
    ) -> Result<Vec<Replay>, Failure> {
        let first = match audit {
            Some(report) => replay.audited(report),
            None => replay,
        };
        let second = self.beside.map(|narrow| self.run_beside(narrow, plan));
        Ok(std::iter::once(first).chain(second.transpose()?).collect())
    }

    /// The same with another narrow phase, audited if the first run is.
    fn run_beside(&self, narrow: Narrow, plan: &Plan) -> Result<Replay, Failure> {
        let world = &plan.start.world;
        let mut replay = plan.empty_replay(narrow);
        let mut audit = self.audit.then(|| Audit::of_world(world));
        let phase = narrow.phase();
        let unstopped = AtomicBool::new(false);
        let run = plan.run(&*phase);
        let (summary, _) = progress::working(plan.steps() as usize, "steps beside", |done| {
            run.go_from(&plan.start, &unstopped, |_, _, record| {
                done(1);
                replay.step(record);
                if let Some(audit) = &mut audit {
                    audit.step(record);
                }
                Ok::<(), Failure>(())
            })
        })?;
        let replay = replay.ended(world, &summary);
        Ok(match audit.map(Audit::finish) {
            Some(report) => replay.audited(&report),
            None => replay,
        })
    }

    fn wrong(&self, error: impl ToString) -> Failure {
        Failure::file(self.scene.as_deref().unwrap_or_default(), error)
    }
}

/// Every frame as a picture.
fn draw(runs: &[Replay], folder: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(|error| unwritable(folder, error))?;
    let drawing = Drawing::new(runs);
    for frame in 0..drawing.frames() {
        let path = folder.join(format!("frame-{frame:06}.svg"));
        fs::write(&path, drawing.frame(frame)).map_err(|error| unwritable(&path, error))?;
    }
    Ok(())
}

fn narrow() -> impl TypedValueParser<Value = Narrow> {
    let parser = PossibleValuesParser::new(Narrow::ALL.map(Narrow::name));
    parser.try_map(|name| Narrow::by_name(&name).ok_or("unknown narrow phase"))
}

impl Mode {
    fn name(self) -> &'static str {
        match self {
            Mode::Guard => "guard",
            Mode::Thesis => "thesis",
        }
    }
}

impl From<wire::Mode> for Mode {
    fn from(mode: wire::Mode) -> Self {
        match mode {
            wire::Mode::Guard => Mode::Guard,
            wire::Mode::Thesis => Mode::Thesis,
        }
    }
}

impl From<Mode> for wire::Mode {
    fn from(mode: Mode) -> Self {
        match mode {
            Mode::Guard => wire::Mode::Guard,
            Mode::Thesis => wire::Mode::Thesis,
        }
    }
}

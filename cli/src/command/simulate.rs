//! `simulate`: a scene from start to end, recorded and audited.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use serde::Serialize;
use tunnelproof::wire::recording::{Header, Recorder};
use tunnelproof::wire::{self, StepRecord, World};
use tunnelproof_cli::audit::{self, Audit};
use tunnelproof_cli::perturb;
use tunnelproof_cli::replay::{self, Drawing, Replay};
use tunnelproof_cli::report;
use tunnelproof_cli::scenes::{EMBEDDED, Scene};
use tunnelproof_cli::simulate::{Narrow, Run, Summary};

use super::output::{JsonOutput, OutputFile, print, shell, unwritable};
use super::polygons::Polygons;
use super::{Failure, progress};

/// Run a scene, and check every step of it for missed tunnels
#[derive(Args)]
#[command(after_help = "\
Examples:
  tunnelproof simulate basic-collision --audit
  tunnelproof simulate basic-collision --mode thesis --narrow thesis --record run.tps
  tunnelproof simulate twisting-under-load --audit --replay run.html
  tunnelproof simulate basic-collision --beside discrete --replay both.html --frames pictures
  tunnelproof simulate my-scene.toml --step 0.01 --duration 2 --json -
  tunnelproof simulate --schema > scene.schema.json

Scenes of the thesis (4.2): basic-collision, pulling-anchor, twisting-under-load, chains-on-deck. Exit code 1 if
a step cannot be done, or the audit finds that something passed unnoticed, or stands or may stand on the wrong side.")]
pub(super) struct Simulate {
    /// The name of a scene of the thesis, or the path of a scene file
    #[arg(required_unless_present = "schema")]
    scene: Option<String>,
    /// Print the JSON schema of scene files, and do no more
    #[arg(long)]
    schema: bool,
    /// How pairs of segments are tested
    #[arg(long, default_value = "certified", value_parser = narrow())]
    narrow: Narrow,
    /// What becomes of a crossing: prevented, or pushed back in the next steps
    #[arg(long, value_enum, default_value = "guard")]
    mode: Mode,
    /// The time step in s, in place of the scene's
    #[arg(long, value_name = "S")]
    step: Option<f64>,
    /// The share of the thickness of wires that guard mode keeps, in place of the scene's
    #[arg(long, value_name = "SHARE")]
    guarded_thickness: Option<f64>,
    /// The duration in s, in place of the scene's
    #[arg(long, value_name = "S")]
    duration: Option<f64>,
    /// Start elsewhere: every body and point moved along each axis by up to a millimetre, at random
    #[arg(long, value_name = "SEED")]
    perturb: Option<u64>,
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
        let scene = self.scene()?;
        let world = scene.world().map_err(|error| self.wrong(error))?;
        let json = JsonOutput::create(self.json.as_deref())?;
        let page = self.replay.as_deref().map(OutputFile::create).transpose()?;
        let narrow = self.narrow.phase();
        let mut watch = Watch::new(&self, &scene, &world)?;
        let run = Run {
            scene: &scene,
            narrow: &*narrow,
            mode: self.mode.into(),
        };
        let summary = progress::working(scene.steps() as usize, "steps", |done| {
            run.go(|_, record| {
                done(1);
                watch.step(record)
            })
        })?;
        if let Some(polygons) = &watch.vtk {
            polygons.finish()?;
        }
        let audit = watch.audit.map(Audit::finish);
        if let Some(replay) = watch.replay {
            let replay = replay.ended(&world, &summary);
            let runs = self.shown(replay, audit.as_ref(), &scene)?;
            if let Some(page) = page {
                page.write(&replay::page(&runs).map_err(super::audit::no_json)?)?;
            }
            if let Some(folder) = &self.frames {
                draw(&runs, folder)?;
            }
        }
        let document = Document {
            narrow: self.narrow.name(),
            mode: self.mode.name(),
            summary: &summary,
            audit: audit.as_ref(),
        };
        let text = |audit| report::audit::text(audit, &shell());
        let audited = || audit.as_ref().map_or(String::new(), text);
        json.write(
            || super::audit::as_json(&document),
            || format!("{summary}{}", audited()),
        )?;
        let clean = audit.is_none_or(|audit| audit.is_clean());
        Ok(match clean && summary.stopped.is_none() {
            true => ExitCode::SUCCESS,
            false => ExitCode::FAILURE,
        })
    }

    /// The run, and the one beside it.
    fn shown(
        &self,
        replay: Replay,
        audit: Option<&audit::Report>,
        scene: &Scene,
    ) -> Result<Vec<Replay>, Failure> {
        let first = match audit {
            Some(report) => replay.audited(report),
            None => replay,
        };
        let second = self.beside.map(|narrow| self.run_beside(narrow, scene));
        Ok(std::iter::once(first).chain(second.transpose()?).collect())
    }

    /// The same scene with another narrow phase, audited if the first run is.
    fn run_beside(&self, narrow: Narrow, scene: &Scene) -> Result<Replay, Failure> {
        let world = scene.world().map_err(|error| self.wrong(error))?;
        let mut replay = self.empty_replay(narrow, scene, &world);
        let mut audit = self.audit.then(|| Audit::of_world(&world));
        let run = Run {
            scene,
            narrow: &*narrow.phase(),
            mode: self.mode.into(),
        };
        let summary = progress::working(scene.steps() as usize, "steps beside", |done| {
            run.go(|_, record| {
                done(1);
                replay.step(record);
                if let Some(audit) = &mut audit {
                    audit.step(record);
                }
                Ok::<(), Failure>(())
            })
        })?;
        let replay = replay.ended(&world, &summary);
        Ok(match audit.map(Audit::finish) {
            Some(report) => replay.audited(&report),
            None => replay,
        })
    }

    /// A run that is to come, called after how it is made.
    fn empty_replay(&self, narrow: Narrow, scene: &Scene, world: &World) -> Replay {
        let replay = Replay::new(&scene.title, Header::from(world), scene.steps());
        let how = format!("{}, {} mode", narrow.name(), self.mode.name());
        replay.named_as_in(scene).called(&how)
    }

    fn scene(&self) -> Result<Scene, Failure> {
        let name = self.scene.as_deref().unwrap_or_default();
        let mut scene = match EMBEDDED.iter().any(|(known, _)| *known == name) {
            true => Scene::embedded(name),
            false => Scene::from_toml(&read(name)?),
        }
        .map_err(|error| self.wrong(error))?;
        if let Some(seed) = self.perturb {
            scene = perturb::perturbed(&scene, seed, perturb::USUAL);
        }
        scene.settings.step = self.step.unwrap_or(scene.settings.step);
        scene.duration = self.duration.unwrap_or(scene.duration);
        let guarded = self.guarded_thickness;
        scene.guarded_thickness = guarded.unwrap_or(scene.guarded_thickness);
        Ok(scene)
    }

    fn wrong(&self, error: impl ToString) -> Failure {
        Failure::File {
            path: self.scene.clone().unwrap_or_default(),
            problem: error.to_string(),
        }
    }
}

fn read(path: &str) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|error| {
        let names = EMBEDDED.map(|(name, _)| name).join(", ");
        let problem = format!("{error} (and it is none of the scenes {names})");
        let path = path.to_owned();
        Failure::File { path, problem }
    })
}

/// Who looks at every step.
struct Watch<'a> {
    recorder: Option<(Recorder<File>, &'a Path)>,
    audit: Option<Audit>,
    replay: Option<Replay>,
    vtk: Option<Polygons<'a>>,
}

impl<'a> Watch<'a> {
    fn new(options: &'a Simulate, scene: &Scene, world: &World) -> Result<Self, Failure> {
        let record = |path: &'a Path| -> Result<_, Failure> {
            let file = File::create(path).map_err(|error| unwritable(path, error))?;
            let recorder = Recorder::new(file, world).map_err(|error| refused(path, error))?;
            Ok((recorder, path))
        };
        let is_shown = options.replay.is_some() || options.frames.is_some();
        Ok(Watch {
            vtk: (options.vtk.as_deref())
                .map(|folder| Polygons::new(folder, world))
                .transpose()?,
            recorder: options.record.as_deref().map(record).transpose()?,
            audit: options.audit.then(|| Audit::of_world(world)),
            replay: is_shown.then(|| options.empty_replay(options.narrow, scene, world)),
        })
    }

    fn step(&mut self, record: &StepRecord) -> Result<(), Failure> {
        if let Some((recorder, path)) = &mut self.recorder {
            recorder
                .record(record)
                .map_err(|error| refused(path, error))?;
        }
        if let Some(audit) = &mut self.audit {
            audit.step(record);
        }
        if let Some(replay) = &mut self.replay {
            replay.step(record);
        }
        if let Some(polygons) = &mut self.vtk {
            polygons.step(record)?;
        }
        Ok(())
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

fn refused(path: &Path, error: impl ToString) -> Failure {
    Failure::File {
        path: path.display().to_string(),
        problem: error.to_string(),
    }
}

fn narrow() -> impl TypedValueParser<Value = Narrow> {
    PossibleValuesParser::new(Narrow::ALL.map(Narrow::name)).try_map(|name| {
        let mut all = Narrow::ALL.into_iter();
        all.find(|narrow| narrow.name() == name)
            .ok_or("unknown narrow phase")
    })
}

impl Mode {
    fn name(self) -> &'static str {
        match self {
            Mode::Guard => "guard",
            Mode::Thesis => "thesis",
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

//! What `simulate` runs, and from where.

use std::fs::File;
use std::io::BufReader;

use tunnelproof::narrow::NarrowPhase;
use tunnelproof::wire::recording::Header;
use tunnelproof::wire::state::State;
use tunnelproof_cli::perturb;
use tunnelproof_cli::replay::Replay;
use tunnelproof_cli::scenes::{Difference, EMBEDDED, Scene};
use tunnelproof_cli::simulate::{Narrow, Run, Start};

use super::{Mode, Simulate};
use crate::command::Failure;

/// A run that is about to be made.
pub(super) struct Plan {
    pub(super) scene: Scene,
    pub(super) narrow: Narrow,
    pub(super) mode: Mode,
    pub(super) start: Start,
    /// From the state that it goes on from.
    pub(super) differences: Vec<Difference>,
}

impl Simulate {
    /// What is run, from where. Says what is set otherwise than until the state.
    pub(super) fn plan(&self) -> Result<Plan, Failure> {
        let plan = self.unchecked_plan()?;
        if matches!(plan.mode, Mode::Thesis)
            && self.guarded_thickness.is_some_and(|share| share > 0.0)
        {
            let problem = "thesis mode guards no thickness";
            return Err(Failure::file("--guarded-thickness", problem));
        }
        Ok(plan)
    }

    fn unchecked_plan(&self) -> Result<Plan, Failure> {
        let scene = self.scene()?;
        let wrong = |error| self.wrong(error);
        let Some(path) = &self.from else {
            if scene.steps() == 0 {
                let (duration, step) = (scene.duration, scene.settings.step);
                let problem =
                    format!("the run takes {duration} s and a step {step} s: there is no step");
                return Err(Failure::file(
                    self.scene.as_deref().unwrap_or_default(),
                    problem,
                ));
            }
            let start = Start::of(&scene).map_err(wrong)?;
            return Ok(Plan {
                scene,
                narrow: self.narrow.unwrap_or(Narrow::Certified),
                mode: self.mode.unwrap_or(Mode::Guard),
                start,
                differences: Vec::new(),
            });
        };
        let state = File::open(path).map_err(|error| Failure::file(path, error))?;
        let state =
            State::load(BufReader::new(state)).map_err(|error| Failure::file(path, error))?;
        let (world, mut differences) = scene.continued(&state).map_err(wrong)?;
        let narrow = match self.narrow {
            Some(narrow) => narrow,
            None => Narrow::by_name(&state.narrow).ok_or_else(|| {
                let problem = format!(
                    "stepped with the narrow phase {:?}: --narrow says with which to go on",
                    state.narrow
                );
                Failure::file(path, problem)
            })?,
        };
        let mode = self.mode.unwrap_or(state.settings.mode.into());
        let phase = narrow.phase();
        let collisions = scene.collisions(mode.into(), &*phase).map_err(wrong)?;
        differences.extend(Difference::of_collisions(
            &state,
            &collisions,
            narrow.name(),
        ));
        for difference in &differences {
            eprintln!("{}: {difference}", path.display());
        }
        let plan = Plan {
            narrow,
            mode,
            start: Start {
                world,
                memory: state.memory,
            },
            differences,
            scene,
        };
        if plan.steps() == 0 {
            let [at, end] = [plan.start.world.time(), plan.scene.duration];
            let problem = format!(
                "the state is at {at} s and the run ends at {end} s: there is no step left, unless --duration is longer"
            );
            return Err(Failure::file(path, problem));
        }
        Ok(plan)
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
}

impl Plan {
    pub(super) fn run<'a>(&'a self, narrow: &'a dyn NarrowPhase) -> Run<'a> {
        Run {
            scene: &self.scene,
            narrow,
            mode: self.mode.into(),
        }
    }

    /// How many steps there are to do.
    pub(super) fn steps(&self) -> u64 {
        self.scene.steps_from(&self.start.world)
    }

    /// A run that is to come, called after how it is made.
    pub(super) fn empty_replay(&self, narrow: Narrow) -> Replay {
        let header = Header::from(&self.start.world);
        let replay = Replay::new(&self.scene.title, header, self.steps());
        let how = format!("{}, {} mode", narrow.name(), self.mode.name());
        replay.named_as_in(&self.scene).called(&how)
    }
}

fn read(path: &str) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|error| {
        let names = EMBEDDED.map(|(name, _)| name).join(", ");
        let is_path = path.ends_with(".toml");
        let of_file = match is_path {
            true => String::new(),
            false => format!("; scenes of your own are files, such as {path}.toml"),
        };
        let problem = format!("{error} (and it is none of the scenes {names}{of_file})");
        Failure::file(path, problem)
    })
}

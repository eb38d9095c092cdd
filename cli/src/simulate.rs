//! Scenes run from start to end, and what is counted on the way.

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use crate::scenes::{Scene, SceneError};
use serde::Serialize;
use tunnelproof::additive::Additive;
use tunnelproof::certified::Certified;
use tunnelproof::contact::{Case, Flags, Verdict};
use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
use tunnelproof::query::EdgeEdge;
use tunnelproof::thesis::Thesis;
use tunnelproof::wire::state::State;
use tunnelproof::wire::{
    BodyCrossingOutcome, CollisionMemory, Collisions, CrossingOutcome, Mode, StepRecord, World,
};

use crate::sweep::Setting;
use tunnelproof_reference::certify::table::grouped;

mod balance;
mod behind;
mod notices;
mod overlaps;
mod stopped;
mod table;

pub use balance::EnergyBalance;
pub use behind::Behind;
pub use notices::{Far, HeldSlides, Left, Stretched};
pub use overlaps::Overlap;
pub use table::StepTable;

/// No continuous detection at all: wires get contacts where they overlap at the end of a step. In
/// guard mode changes of resolution are tested still: no time passes in them.
pub struct Discrete;

impl NarrowPhase for Discrete {
    fn name(&self) -> &str {
        "discrete"
    }

    fn edge_edge(&self, _query: &EdgeEdge) -> Result<Report, Unsupported> {
        Ok(Report {
            verdict: Verdict::Miss,
            case: None,
            flags: Flags::default(),
        })
    }
}

/// The thresholds that `tune` recommends for metres in `f64` (docs/thresholds.md).
const TUNED: Setting = Setting([1e-4, 1e-4, 1e-15, 1e-5, 1e-12]);

/// A narrow phase that a simulation can use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Narrow {
    /// The certified path.
    Certified,
    /// The thesis path with the thresholds of table 3.1.
    Thesis,
    /// The thesis path with the thresholds that `tune` recommends for metres in `f64`.
    Tuned,
    /// Additive CCD.
    Additive,
    /// [`Discrete`].
    Discrete,
}

impl Narrow {
    /// All of them.
    pub const ALL: [Narrow; 5] = [
        Narrow::Certified,
        Narrow::Thesis,
        Narrow::Tuned,
        Narrow::Additive,
        Narrow::Discrete,
    ];

    /// Its name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Narrow::Certified => "certified",
            Narrow::Thesis => "thesis",
            Narrow::Tuned => "tuned",
            Narrow::Additive => "additive",
            Narrow::Discrete => "discrete",
        }
    }

    /// The one of a name.
    pub fn by_name(name: &str) -> Option<Self> {
        let mut all = Narrow::ALL.into_iter();
        all.find(|narrow| narrow.name() == name)
    }

    /// Who answers.
    pub fn phase(self) -> Box<dyn NarrowPhase> {
        match self {
            Narrow::Certified => Box::new(Certified),
            Narrow::Thesis => Box::new(Thesis::default()),
            Narrow::Tuned => Box::new(Thesis {
                options: TUNED.options(),
            }),
            Narrow::Additive => Box::new(Additive::default()),
            Narrow::Discrete => Box::new(Discrete),
        }
    }
}

/// What is run.
pub struct Run<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// How pairs are tested.
    pub narrow: &'a dyn NarrowPhase,
    /// What becomes of crossings.
    pub mode: Mode,
}

/// So many overlaps are shown.
const OVERLAPS: usize = 5;

/// What happened in a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    /// The title of the scene.
    pub title: String,
    /// Steps that were done before the run.
    pub from_step: u64,
    /// Steps done.
    pub steps: u64,
    /// Simulated time in s.
    pub time: f64,
    /// Wall-clock time in s.
    pub wall: f64,
    /// Of this, collision detection.
    pub wall_collision: f64,
    /// Of this, the narrow phase: tests of pairs, and the contacts that come of them.
    pub wall_narrow: f64,
    /// What stands in each other at the start of the scene, the deepest first.
    pub overlaps: Vec<Overlap>,
    /// Eyes and contact nodes that are far from their bodies.
    pub far: Vec<Far>,
    /// Wires that are far longer at the start of the scene than they are unstretched.
    pub stretched: Vec<Stretched>,
    /// Pairs that the broad phase named.
    pub named: usize,
    /// Of these, excluded as too slow.
    pub excluded: usize,
    /// Of these, tested.
    pub tested: usize,
    /// Pairs with a body that were tested.
    pub tested_bodies: usize,
    /// Tests by case, in the order of [`Case::ALL`].
    pub cases: [usize; Case::ALL.len()],
    /// Contacts at which the segments are parallel for an instant.
    pub temporarily_parallel: usize,
    /// Guard mode: crossings prevented.
    pub prevented: usize,
    /// Guard mode: touches of bodies prevented.
    pub prevented_bodies: usize,
    /// Thesis mode: midlines that touched the core of a body.
    pub passed_bodies: usize,
    /// Guard mode: touches of two bodies prevented.
    pub prevented_cores: usize,
    /// Thesis mode: bodies whose cores touched.
    pub passed_cores: usize,
    /// Thesis mode: wires that passed through.
    pub tunnelled: usize,
    /// Thesis mode: wires that came back.
    pub returned: usize,
    /// Contacts without passage.
    pub grazed: usize,
    /// Motions shortened.
    pub held: usize,
    /// Scripted bodies that made less of their way than their script says, in the order of the scene.
    pub behind: Vec<Behind>,
    /// Wires that lost the last contact node that they had on a body at the start, in order.
    pub left: Vec<Left>,
    /// Steps in which sliding went as far as it may.
    pub held_slides: HeldSlides,
    /// Changes of resolution.
    pub remeshes: usize,
    /// Changes of resolution refused.
    pub refused: usize,
    /// The energy of wires and of bodies that forces move.
    pub energy: EnergyBalance,
    /// The largest tension in N.
    pub tension: f64,
    /// The time at the end of the step that had it, in s.
    pub tension_at: Option<f64>,
    /// The largest number of contacts in a step.
    pub contacts: usize,
    /// How deep the surfaces of a contact were in each other at most where a step started, in m.
    pub depth: f64,
    /// The time at the end of that step, in s; none if nothing was.
    pub depth_at: Option<f64>,
    /// Steps that ended because they had spent what a step may
    /// ([`SolverRecord::cut_short`](tunnelproof::wire::SolverRecord)).
    pub cut_short: u64,
    /// Steps whose motion was slowed, as it had more energy than there was
    /// ([`SolverRecord::slowed`](tunnelproof::wire::SolverRecord)).
    pub slowed: u64,
    /// The largest error of a contact's velocity that a step ended with, in m/s.
    pub contact_residual: f64,
    /// The largest error of a bound of friction at a contact node that a step ended with, as a fraction.
    pub slide_residual: f64,
    /// Why the run ended before its time.
    pub stopped: Option<String>,
}

/// Where a run starts.
#[derive(Clone, Debug)]
pub struct Start {
    /// The world.
    pub world: World,
    /// What is known of its collisions.
    pub memory: CollisionMemory,
}

impl Start {
    /// Where a scene starts.
    ///
    /// # Errors
    ///
    /// The scene cannot be built.
    pub fn of(scene: &Scene) -> Result<Self, SceneError> {
        Ok(Start {
            world: scene.world()?,
            memory: CollisionMemory::default(),
        })
    }
}

impl Run<'_> {
    /// Runs the scene to its end, and shows every step to `observe`. A step that cannot be done
    /// ends the run.
    ///
    /// # Errors
    ///
    /// The scene cannot be built, or what `observe` returns.
    pub fn go<E: From<SceneError>>(
        &self,
        mut observe: impl FnMut(&World, &StepRecord) -> Result<(), E>,
    ) -> Result<Summary, E> {
        let unstopped = AtomicBool::new(false);
        let observe =
            |world: &World, _: &Collisions<'_>, record: &StepRecord| observe(world, record);
        let (summary, _) = self.go_from(&Start::of(self.scene)?, &unstopped, observe)?;
        Ok(summary)
    }

    /// The same from a start on, until it is told to stop; and in which state it ends. After a step
    /// that could not be done that is the state before it.
    ///
    /// # Errors
    ///
    /// The settings of the scene are refused, or what `observe` returns.
    pub fn go_from<E: From<SceneError>>(
        &self,
        start: &Start,
        stop: &AtomicBool,
        mut observe: impl FnMut(&World, &Collisions<'_>, &StepRecord) -> Result<(), E>,
    ) -> Result<(Summary, State), E> {
        let mut world = start.world.clone();
        let collisions = self.scene.collisions(self.mode, self.narrow)?;
        let mut collisions = collisions.with_memory(start.memory.clone());
        let mut summary = Summary {
            title: self.scene.title.clone(),
            from_step: world.steps(),
            time: world.time(),
            energy: EnergyBalance::of(&world),
            ..Summary::default()
        };
        let mut watch = notices::Watch::of(&world);
        if world.steps() == 0 {
            summary.far = notices::far(&world, self.scene);
            summary.stretched = notices::stretched(&world, self.scene);
            overlaps::add_wires(&mut summary.overlaps, &world, self.scene);
        }
        for _ in 0..self.scene.steps_from(&world) {
            if stop.load(Ordering::Relaxed) {
                break;
            }
            let started = Instant::now();
            let record = world.step_colliding(&mut collisions, &[]);
            summary.wall += started.elapsed().as_secs_f64();
            match record {
                Ok(record) => {
                    overlaps::add(&mut summary.overlaps, &record, &world, self.scene);
                    summary.add(&record);
                    summary.held_slides.add(&record);
                    let left = watch.left(&record, &world, self.scene);
                    summary.left.extend(left);
                    behind::add(&mut summary.behind, &record, &world, self.scene);
                    observe(&world, &collisions, &record)?;
                }
                Err(error) => {
                    summary.stopped = Some(stopped::said(&error, self.scene));
                    break;
                }
            }
        }
        Ok((summary, State::of(&world, &collisions)))
    }
}

impl Summary {
    /// That of a run in guard mode with the certified path.
    ///
    /// # Errors
    ///
    /// As [`Run::go`].
    pub fn of_guarded(scene: &Scene) -> Result<Self, SceneError> {
        let narrow = Narrow::Certified.phase();
        let run = Run {
            scene,
            narrow: &*narrow,
            mode: Mode::Guard,
        };
        run.go(|_, _| Ok(()))
    }

    /// Tests of these cases.
    pub fn of_case(&self, cases: &[Case]) -> usize {
        let all = Case::ALL.iter().zip(self.cases);
        all.filter(|(case, _)| cases.contains(case))
            .map(|(_, count)| count)
            .sum()
    }

    fn add(&mut self, record: &StepRecord) {
        self.steps += 1;
        self.time = record.time;
        self.wall_collision += record.phases.broad + record.phases.narrow;
        self.wall_narrow += record.phases.narrow;
        let found = &record.collisions;
        self.named += found.broad_pairs;
        self.excluded += found.excluded;
        self.tested += found.tested;
        self.tested_bodies += found.tested_bodies;
        for (sum, count) in self.cases.iter_mut().zip(found.cases) {
            *sum += count;
        }
        self.temporarily_parallel += found.temporarily_parallel;
        for crossing in &found.crossings {
            *match crossing.outcome {
                CrossingOutcome::Prevented => &mut self.prevented,
                CrossingOutcome::Tunnelled => &mut self.tunnelled,
                CrossingOutcome::Returned => &mut self.returned,
                CrossingOutcome::Grazed => &mut self.grazed,
            } += 1;
        }
        for crossing in &found.body_crossings {
            *match crossing.outcome {
                BodyCrossingOutcome::Prevented => &mut self.prevented_bodies,
                BodyCrossingOutcome::Passed => &mut self.passed_bodies,
            } += 1;
        }
        for crossing in &found.core_crossings {
            *match crossing.outcome {
                BodyCrossingOutcome::Prevented => &mut self.prevented_cores,
                BodyCrossingOutcome::Passed => &mut self.passed_cores,
            } += 1;
        }
        self.held += found.scaled_islands.len();
        self.remeshes += record.remeshes.len();
        self.refused += found.refused_remeshes;
        self.energy.add(record);
        let tension = largest_tension(record);
        if tension > self.tension {
            self.tension = tension;
            self.tension_at = Some(record.time);
        }
        let solver = &record.solver;
        self.cut_short += u64::from(solver.cut_short);
        self.slowed += u64::from(solver.slowed);
        self.contact_residual = self.contact_residual.max(solver.contact_residual);
        self.slide_residual = self.slide_residual.max(solver.slide_residual);
        self.contacts = self.contacts.max(record.contacts.len());
        let depth = deepest(record);
        if depth > self.depth {
            self.depth = depth;
            self.depth_at = Some(record.time);
        }
    }
}

/// The largest tension of a step in N, 0 if nothing pulls.
fn largest_tension(record: &StepRecord) -> f64 {
    let tensions = record.wires.iter().flat_map(|wire| &wire.tensions);
    tensions.fold(0.0, |a: f64, &b| a.max(b))
}

/// How deep the surfaces of a contact were in each other at most where a step started, in m.
fn deepest(record: &StepRecord) -> f64 {
    let depths = record.contacts.iter().map(|contact| -contact.contact.gap);
    depths.fold(0.0, f64::max)
}

/// " at 1.234 s", or nothing.
fn at(time: Option<f64>) -> String {
    time.map_or_else(String::new, |time| format!(" at {time:.3} s"))
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let count = |number: usize| grouped(number as u64);
        let rows = [
            (
                "steps",
                format!("{} ({:.3} s)", grouped(self.steps), self.time),
            ),
            (
                "run time",
                format!(
                    "{:.3} s, of it collisions {:.3} s",
                    self.wall, self.wall_collision
                ),
            ),
            ("pairs named", count(self.named)),
            ("excluded", count(self.excluded)),
            ("tested", count(self.tested)),
            (
                "cases",
                format!(
                    "{} general, {} parallel, {} coplanar",
                    count(self.of_case(&[Case::General])),
                    count(self.of_case(&[Case::Parallel, Case::Collinear])),
                    count(self.of_case(&[Case::Coplanar]))
                ),
            ),
            ("temporarily parallel", count(self.temporarily_parallel)),
            ("crossings prevented", count(self.prevented)),
            (
                "into bodies",
                format!(
                    "prevented {}, passed {}",
                    count(self.prevented_bodies),
                    count(self.passed_bodies)
                ),
            ),
            (
                "bodies into bodies",
                format!(
                    "prevented {}, passed {}",
                    count(self.prevented_cores),
                    count(self.passed_cores)
                ),
            ),
            (
                "tunnelled, returned",
                format!("{}, {}", count(self.tunnelled), count(self.returned)),
            ),
            ("grazed", count(self.grazed)),
            ("motions held", count(self.held)),
            (
                "resolution changed",
                format!("{}, refused {}", count(self.remeshes), count(self.refused)),
            ),
            (
                "largest tension",
                format!("{:.0} N{}", self.tension, at(self.tension_at)),
            ),
            ("most contacts", count(self.contacts)),
            (
                "deepest contact",
                format!("{:.3} mm{}", self.depth * 1e3, at(self.depth_at)),
            ),
            ("energy", self.energy.to_string()),
            (
                "energy from nothing",
                format!(
                    "at most {} in a step{}",
                    balance::joules(self.energy.largest_gain),
                    at(self.energy.gained_at)
                ),
            ),
            (
                "solver",
                format!(
                    "{} steps cut short, {} slowed, contacts within {:.1e} m/s, friction within {:.1e}",
                    grouped(self.cut_short),
                    grouped(self.slowed),
                    self.contact_residual,
                    self.slide_residual
                ),
            ),
        ];
        writeln!(f, "{}", self.title)?;
        if self.from_step > 0 {
            let from = format!("step {}", grouped(self.from_step));
            writeln!(f, "  {:<22}{from}", "continued from")?;
        }
        for (name, value) in rows {
            writeln!(f, "  {name:<22}{value}")?;
        }
        for far in &self.far {
            writeln!(f, "  {:<22}{far}", "far from its body")?;
        }
        for stretched in &self.stretched {
            writeln!(f, "  {:<22}{stretched}", "stretched at start")?;
        }
        for overlap in self.overlaps.iter().take(OVERLAPS) {
            writeln!(f, "  {:<22}{overlap}", "overlap at the start")?;
        }
        if let more @ 1.. = self.overlaps.len().saturating_sub(OVERLAPS) {
            writeln!(f, "  {:<22}and {more} more", "")?;
        }
        for behind in &self.behind {
            writeln!(f, "  {:<22}{behind}", "behind its script")?;
        }
        for left in &self.left {
            writeln!(f, "  {:<22}{left}", "off a body")?;
        }
        if self.held_slides.steps > 0 {
            writeln!(f, "  {:<22}{}", "slid", self.held_slides)?;
        }
        match &self.stopped {
            Some(error) => writeln!(f, "  {:<22}{error}", "stopped"),
            None => Ok(()),
        }
    }
}

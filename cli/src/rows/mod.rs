//! What the thesis says of its scenes (4.2), and what comes out of them here.
//!
//! `tunnelproof table rows` prints them; `cli/tests/scene_rows.rs` holds each to what is accepted.
//! Nothing is random.

mod anchor;
mod basic;
mod chains;
mod twist;

use std::error::Error;

use crate::perturb::{USUAL, perturbed};
use crate::scenes::Scene;
use tunnelproof::certified::Certified;
use tunnelproof::wire::{ContactRecord, ContactSite, CrossingOutcome, Mode, StepRecord, World};

/// What is looked at in one scene.
#[derive(Clone, Copy, Debug)]
pub struct SceneRows {
    /// The name of the scene.
    pub scene: &'static str,
    /// Runs it to its end.
    pub run: fn() -> Rows,
}

/// The rows of a scene, or why it does not run to its end.
pub type Rows = Result<Vec<Row>, Box<dyn Error>>;

/// What the thesis says and the number that came out.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What the number is, with its unit.
    pub what: &'static str,
    /// As the thesis has it.
    pub thesis: String,
    /// By the stepper; NaN for what never happened.
    pub ours: f64,
    /// The least and the largest number that are accepted.
    pub accepted: [f64; 2],
}

impl Row {
    /// A number that has to be this, as far as `within`.
    fn near(what: &'static str, thesis: f64, ours: f64, within: f64) -> Self {
        let accepted = [thesis - within, thesis + within];
        Row::between(what, thesis.to_string(), ours, accepted)
    }

    /// A number for which the thesis has words.
    fn between(
        what: &'static str,
        thesis: impl Into<String>,
        ours: f64,
        accepted: [f64; 2],
    ) -> Self {
        Row {
            what,
            thesis: thesis.into(),
            ours,
            accepted,
        }
    }

    /// Whether the number is accepted; not if it is NaN.
    pub fn holds(&self) -> bool {
        let [least, largest] = self.accepted;
        self.ours >= least && self.ours <= largest
    }
}

/// All scenes, in the thesis' order.
pub const SCENES: [SceneRows; 4] = [basic::ROWS, anchor::ROWS, twist::ROWS, chains::ROWS];

/// Runs a scene with the certified path and shows every step.
fn run(
    scene: &Scene,
    mode: Mode,
    mut look: impl FnMut(&World, &StepRecord),
) -> Result<(), Box<dyn Error>> {
    let mut world = scene.world()?;
    let mut collisions = scene.collisions(mode, &Certified)?;
    for _ in 0..scene.steps() {
        let record = world.step_colliding(&mut collisions, &[])?;
        look(&world, &record);
    }
    Ok(())
}

/// [`run`] in guard mode. The row that it returns counts the crossings in motions that were made.
fn run_guarded(
    scene: &Scene,
    mut look: impl FnMut(&World, &StepRecord),
) -> Result<Row, Box<dyn Error>> {
    let mut crossed = 0;
    run(scene, Mode::Guard, |world, record| {
        let made = |outcome: &CrossingOutcome| *outcome != CrossingOutcome::Prevented;
        crossed += outcomes(record).filter(made).count();
        look(world, record);
    })?;
    let what = "midlines that meet in motions that are made";
    Ok(Row::near(what, 0.0, crossed as f64, 0.0))
}

/// [`run_guarded`] by `of`, from so many starts: that of the scene, and others that are moved at random by up to [`USUAL`]. The row
/// is that of all.
fn from_starts<T>(
    scene: &Scene,
    starts: u64,
    of: impl Fn(&Scene) -> Result<(Row, T), Box<dyn Error>>,
) -> Result<(Row, Vec<T>), Box<dyn Error>> {
    let (mut crossed, first) = of(scene)?;
    let mut all = vec![first];
    for seed in 1..starts {
        let (row, other) = of(&perturbed(scene, seed, USUAL))?;
        crossed.ours += row.ours;
        all.push(other);
    }
    Ok((crossed, all))
}

/// The upper median; NaN of none.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn outcomes(record: &StepRecord) -> impl Iterator<Item = CrossingOutcome> {
    let crossings = record.collisions.crossings.iter();
    crossings.map(|crossing| crossing.outcome)
}

/// Contacts that push, by what they are between.
fn pushing<T>(
    record: &StepRecord,
    between: impl Fn(&ContactSite, &ContactSite) -> Option<T>,
) -> Vec<T> {
    let pushing = |contact: &&ContactRecord| contact.normal_force() > 0.0;
    let contacts = record.contacts.iter().filter(pushing);
    contacts
        .filter_map(|record| between(&record.contact.a, &record.contact.b))
        .collect()
}

/// The arc lengths at which two wires push on each other.
fn between_wires(a: &ContactSite, b: &ContactSite) -> Option<[f64; 2]> {
    match (*a, *b) {
        (ContactSite::Wire { arc, .. }, ContactSite::Wire { arc: other, .. }) => Some([arc, other]),
        _ => None,
    }
}

/// When something happened for the first time.
struct First(f64);

impl First {
    fn never() -> Self {
        First(f64::NAN)
    }

    fn note(&mut self, record: &StepRecord) {
        if self.0.is_nan() {
            self.0 = record.time;
        }
    }
}

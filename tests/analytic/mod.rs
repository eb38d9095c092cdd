//! Wires whose motion or rest is known in closed form, and what the stepper makes of them.
//!
//! `cargo run --release --example wire_table` prints them; `tests/wire_table.rs` holds each to its
//! tolerance.

mod cable;
mod contact;
mod drum;
pub(crate) mod elastica;
pub(crate) mod falling;
mod knot;
mod motion;
mod statics;
mod swing;
mod torsion;
mod winch;

use std::error::Error;

use tunnelproof::query::Point;
use tunnelproof::wire::{ContactConstraint, Settings, World};

/// A case with a known answer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Case {
    /// What is looked at.
    pub(crate) name: &'static str,
    /// The formula of what is expected.
    pub(crate) formula: &'static str,
    /// Runs the case.
    pub(crate) run: fn() -> Result<Vec<Comparison>, Box<dyn Error>>,
}

/// A number that is expected and the one that came out.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Comparison {
    /// What the number is, with its unit.
    pub(crate) what: String,
    /// By the formula.
    pub(crate) expected: f64,
    /// By the stepper.
    pub(crate) measured: f64,
    /// The relative deviation that is permitted.
    pub(crate) tolerance: f64,
}

impl Comparison {
    fn new(what: impl Into<String>, expected: f64, measured: f64, tolerance: f64) -> Self {
        Comparison {
            what: what.into(),
            expected,
            measured,
            tolerance,
        }
    }

    /// The relative deviation.
    pub(crate) fn deviation(&self) -> f64 {
        ((self.measured - self.expected) / self.expected).abs()
    }

    /// Whether the deviation is permitted; not if it is NaN.
    pub(crate) fn holds(&self) -> bool {
        self.deviation() <= self.tolerance
    }
}

/// All cases.
pub(crate) const CASES: [Case; 33] = [
    motion::FREE_FALL,
    statics::STRETCH,
    motion::PENDULUM,
    motion::STRING,
    swing::SWAY,
    swing::LIGHT_PENDULUM,
    swing::TAUT_STRING,
    statics::CATENARY,
    statics::CANTILEVER,
    drum::CAPSTAN,
    drum::HOIST,
    drum::ATWOOD,
    drum::BLOCK,
    winch::WINCH,
    winch::HAULED_PENDULUM,
    contact::INCLINE,
    contact::CROSSING,
    motion::TWIST,
    motion::MOMENTUM,
    motion::ANGULAR_MOMENTUM,
    motion::ENERGY,
    elastica::BENT_CANTILEVER,
    elastica::COLUMN,
    elastica::TALLEST,
    elastica::ELASTIC_CATENARY,
    falling::FOLDED,
    cable::HANGING,
    cable::SAGGING,
    torsion::PENDULUM,
    torsion::TORQUE,
    torsion::GREENHILL,
    torsion::MICHELL,
    knot::OVERHAND,
];

/// What contacts a world has at present.
type Contacts<'a> = &'a dyn Fn(&World) -> Vec<ContactConstraint>;

/// A world without gravity and with the given step in s.
fn weightless(step: f64) -> Settings {
    Settings::default()
        .with_step(step)
        .with_gravity(tunnelproof::wire::Vector::zeros())
}

/// Steps a world to rest by kinetic damping: all velocity is taken whenever kinetic energy starts
/// to fall. Returns once its peaks are below `least` in J, or after a number of steps.
fn settle(
    world: &mut World,
    contacts: Contacts<'_>,
    least: f64,
    steps: usize,
) -> Result<(), Box<dyn Error>> {
    let mut last = 0.0;
    for _ in 0..steps {
        let list = contacts(world);
        let kinetic = world.step(&list)?.energy.kinetic;
        if kinetic < last {
            if last < least {
                return Ok(());
            }
            world.halt();
            last = 0.0;
        } else {
            last = kinetic;
        }
    }
    Err(format!("not at rest after {steps} steps").into())
}

/// The period in s of a quantity sampled every `step` seconds: mean distance of its rises through
/// 0, each interpolated.
fn period(samples: &[f64], step: f64) -> f64 {
    let rises: Vec<f64> = samples
        .windows(2)
        .enumerate()
        .filter(|(_, two)| two[0] < 0.0 && two[1] >= 0.0)
        .map(|(i, two)| i as f64 - two[0] / (two[1] - two[0]))
        .collect();
    match rises.as_slice() {
        [first, .., last] => (last - first) / (rises.len() - 1) as f64 * step,
        _ => f64::NAN,
    }
}

fn at(x: f64, y: f64, z: f64) -> Point {
    Point::new(x, y, z)
}

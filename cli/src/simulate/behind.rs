//! Scripted bodies that are held and fall behind their script.

use std::fmt;

use serde::Serialize;
use tunnelproof::wire::{BodyId, StepRecord, Vector, World};
use tunnelproof_reference::certify::table::grouped;

use crate::scenes::Scene;

/// A scripted body that was held, as it would have forced a crossing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Behind {
    /// Its number in the scene.
    pub body: usize,
    /// Its name in the scene.
    pub name: String,
    /// The first step in which it was held.
    pub first_step: u64,
    /// In how many steps it was held.
    pub steps: u64,
    /// How far its centre is from where these steps would have brought it, in m.
    pub distance: f64,
    /// By how much it has turned less than these steps say, in degrees.
    pub degrees: f64,
    /// The way that it has not made, in m.
    #[serde(skip)]
    way: Vector,
}

/// Adds what scripted bodies did not do of their script in a step that a world has made.
pub(super) fn add(list: &mut Vec<Behind>, record: &StepRecord, world: &World, scene: &Scene) {
    let step = world.settings().step;
    let islands = &record.collisions.scaled_islands;
    for body in islands.iter().flat_map(|island| &island.behind) {
        let BodyId(index) = *body;
        let moved = &world.bodies()[index];
        // As a phase counts from the step whose middle it has begun in.
        let mut phases = moved.phases().iter().rev();
        let phase = phases.find(|phase| phase.from <= record.time - 0.5 * step);
        let scripted = phase.map(|phase| [phase.velocity, phase.angular_velocity]);
        let scripted = scripted.unwrap_or_default();
        let at = match list.iter().position(|one| one.body >= index) {
            Some(at) if list[at].body == index => at,
            at => {
                let at = at.unwrap_or(list.len());
                let one = Behind {
                    body: index,
                    name: scene.bodies[index].name.clone(),
                    first_step: record.step,
                    steps: 0,
                    distance: 0.0,
                    degrees: 0.0,
                    way: Vector::zeros(),
                };
                list.insert(at, one);
                at
            }
        };
        let one = &mut list[at];
        one.steps += 1;
        one.way += (scripted[0] - moved.velocity()) * step;
        one.distance = one.way.norm();
        let turned = (scripted[1] - moved.angular_velocity()) * step;
        one.degrees += turned.norm().to_degrees();
    }
}

impl fmt::Display for Behind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Behind { name, steps, .. } = self;
        let times = if *steps == 1 { "step" } else { "steps" };
        write!(
            f,
            "{name} by {:.3} mm and {:.2} degrees, held in {} {times} from step {}",
            1e3 * self.distance,
            self.degrees,
            grouped(*steps),
            self.first_step
        )
    }
}

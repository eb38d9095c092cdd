//! Into how many stages the motion of each body is divided.
//!
//! In a stage no body turns by more than [`TURN`]. Two bodies that may come near each other have the
//! same stages, so that each stage of the two is a motion of both. What stays where it is, or apart
//! from all others, has its own.

use crate::query::Point;
use crate::wire::Vector;
use crate::wire::world::World;

/// The largest turn in a stage, in radians: 45 degrees.
const TURN: f64 = std::f64::consts::FRAC_PI_4;

/// The most stages of a motion. A dynamic body is not let spin faster, as a thin one may
/// that rolls on what is fast; its way could not be tested.
const MOST_STAGES: u32 = 512;

/// How often a body may turn in a step.
pub(in crate::wire) const MOST_TURNS: f64 = MOST_STAGES as f64 * TURN / std::f64::consts::TAU;

/// A body that moves in a step.
pub(super) struct Mover {
    pub(super) body: usize,
    pub(super) end: Point,
    pub(super) angular_velocity: Vector,
}

/// Where a body may be during a step: in a ball whose centre goes straight.
struct Ball {
    ends: [Point; 2],
    radius: f64,
}

/// The number of stages of each mover. A way that turns too much to be followed counts as one stage.
pub(super) fn stages(world: &World, movers: &[Mover]) -> Vec<u32> {
    let step = world.settings.step;
    let own = movers.iter().map(|mover| &mover.angular_velocity);
    let own = own.map(|spin| match is_followed(spin, step) {
        true => (turns(spin, step) as u32).max(1),
        false => 1,
    });
    let mut stages: Vec<u32> = own.collect();
    if stages.iter().all(|&count| count == stages[0]) {
        return stages;
    }
    let near = near(world, movers);
    // The largest number spreads to all that are near, and to what is near those.
    let mut is_settled = false;
    while !is_settled {
        is_settled = true;
        for &[a, b] in &near {
            let most = stages[a].max(stages[b]);
            is_settled &= [stages[a], stages[b]] == [most; 2];
            (stages[a], stages[b]) = (most, most);
        }
    }
    stages
}

/// Two movers, of which forces move one, that may come near each other.
fn near(world: &World, movers: &[Mover]) -> Vec<[usize; 2]> {
    let ball = |mover: &Mover| {
        let body = &world.bodies[mover.body];
        Ball {
            ends: [body.position, mover.end],
            radius: body.shape.reach(),
        }
    };
    let balls: Vec<Ball> = movers.iter().map(ball).collect();
    let is_dynamic = |mover: usize| world.bodies[movers[mover].body].dynamic;
    let pairs = (0..balls.len()).flat_map(|a| (a + 1..balls.len()).map(move |b| [a, b]));
    let may_touch = |[a, b]: &[usize; 2]| {
        (is_dynamic(*a) || is_dynamic(*b)) && !balls[*a].stays_apart(&balls[*b])
    };
    pairs.filter(may_touch).collect()
}

impl Ball {
    /// Whether two do not come near each other, by more than all that is rounded on the way.
    fn stays_apart(&self, other: &Ball) -> bool {
        /// As parts of both radii, and of the largest coordinate.
        const SLACK: [f64; 2] = [1e-3, 1e-9];
        let [from, to] = [0, 1].map(|end| self.ends[end] - other.ends[end]);
        let way = to - from;
        let nearest = (-from.dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
        let nearest = if nearest.is_nan() { 0.0 } else { nearest };
        let distance = (from + way * nearest).norm();
        let ends = self.ends.iter().chain(&other.ends);
        let far = ends.fold(0.0, |far: f64, end| far.max(end.coords.amax()));
        let radii = self.radius + other.radius;
        distance > radii + radii * SLACK[0] + far * SLACK[1]
    }
}

/// Whether a body turns so little that stages follow its way.
pub(super) fn is_followed(angular_velocity: &Vector, step: f64) -> bool {
    turns(angular_velocity, step) <= f64::from(MOST_STAGES)
}

/// How often a body turns by [`TURN`] in a step, rounded up.
fn turns(angular_velocity: &Vector, step: f64) -> f64 {
    (angular_velocity.norm() * step / TURN).ceil()
}

/// The angular velocity of a dynamic body, made so slow that its way can be followed. One whose
/// length is not finite stays, and the step is refused.
pub(super) fn slowed(angular_velocity: Vector, step: f64) -> Vector {
    let most = f64::from(MOST_STAGES) * TURN / step;
    let length = angular_velocity.norm();
    if length > most && length.is_finite() {
        angular_velocity * (most / length) * (1.0 - 1e-9)
    } else {
        angular_velocity
    }
}

#[cfg(test)]
mod tests;

//! Reels: what they let out of wires, and the work that they do.

use super::motion::SlideRate;
use crate::wire::model::Wire;
use crate::wire::world::World;

/// Lets out of wires what a motion says. Returns what the reels do beside what they pull with, in J:
/// wire that is let out has height and speed, and it is unstretched on the reel.
pub(super) fn let_out(world: &mut World, slid: &[SlideRate]) -> f64 {
    let reels = slid.iter().filter(|slid| slid.is_reel(world));
    let reels: Vec<&SlideRate> = reels.collect();
    if reels.is_empty() {
        return 0.0;
    }
    let energy = |world: &World| world.kinetic_energy() + world.potential_halfway();
    let before = energy(world);
    let mut work = 0.0;
    for slid in reels {
        let length = slid.speed * world.settings.step;
        work += stretch(&world.wires[slid.wire]) * length;
        slid.apply(world);
    }
    work + energy(world) - before
}

/// With a tension `T` a reel pulls with `T`, but the energy of the last segment changes by `-T - T^2 /
/// (2 E A)` for each length that is let out: what it has more than `-T`, in N.
fn stretch(wire: &Wire) -> f64 {
    let tension = wire.segments.last().map_or(0.0, |last| last.tension);
    -tension * tension / (2.0 * wire.material.stretch_stiffness())
}

#[cfg(test)]
mod tests;

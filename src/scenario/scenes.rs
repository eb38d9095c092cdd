//! The scenes of the thesis (4.2).

use crate::query::Point;
use crate::wire::{Material, ModelError, Settings, Stop, Vector, WirePlan, World};

/// Scene 1, basic collision: two steel wires of 2 m with fixed ends along y at x = -0.5 m and 0.5 m (wires 0 and
/// 1), and one along x that falls on them from 0.1 m at 10 m/s (wire 2). The radius of all is 0.02 m.
///
/// # Errors
///
/// None: the numbers are accepted.
pub fn basic_collision() -> Result<World, ModelError> {
    let mut world = World::new(Settings::default())?;
    let resolution = 0.25;
    let wire = |route: [Stop; 2]| {
        WirePlan::new(Material::steel(0.02), resolution, route.to_vec()).adaptive()
    };
    for x in [-0.5, 0.5] {
        world.add_wire(&wire(
            [-1.0, 1.0].map(|y| Stop::Pinned(Point::new(x, y, 0.0))),
        ))?;
    }
    let mut falling = wire([-1.0, 1.0].map(|x| Stop::Free(Point::new(x, 0.0, 0.1))));
    falling.velocity = Vector::new(0.0, 0.0, -10.0);
    world.add_wire(&falling)?;
    Ok(world)
}

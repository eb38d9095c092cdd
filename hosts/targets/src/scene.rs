//! A scene of the wire stepper that has something of everything.

use std::error::Error;

use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyPlan, Collisions, Drive, Material, Settings, Shape, Stop, Vector, WirePlan, World,
};

use super::Digest;

/// The digest of all positions after so many steps.
pub(crate) fn digest(steps: u64) -> u64 {
    let mut digest = Digest::new();
    match run(steps, &mut digest) {
        Ok(()) => {}
        Err(error) => digest.add(&error.to_string()),
    }
    digest.value()
}

fn run(steps: u64, digest: &mut Digest) -> Result<(), Box<dyn Error>> {
    let mut world = world()?;
    let mut collisions = Collisions::default();
    for _ in 0..steps {
        let record = world.step_colliding(&mut collisions, &[])?;
        digest.add(&(
            record.contacts.len(),
            record.remeshes.len(),
            record.collisions.crossings.len(),
        ));
    }
    let nodes = world.wires().iter().flat_map(|wire| wire.nodes());
    nodes.for_each(|node| digest.add(&node.position));
    let bodies = world.bodies().iter();
    bodies.for_each(|body| digest.add(&body.position()));
    Ok(())
}

/// A tumbling box between an adaptive steel wire and a chain, and a wire across them.
fn world() -> Result<World, Box<dyn Error>> {
    let mut world = World::new(Settings::default())?;
    let half = Vector::new(0.3, 0.4, 0.5);
    let plan = BodyPlan {
        drive: Drive::Dynamic {
            density: 2000.0,
            velocity: Vector::new(1.0, 2.0, 3.0),
            angular_velocity: Vector::new(4.0, 5.0, -6.0),
        },
        ..BodyPlan::dynamic(Shape::Box { half }, 2000.0, Point::new(0.0, 0.0, 0.7))
    };
    let body = world.add_body(plan)?;
    let local = Vector::new(0.3, 0.4, 0.5);
    let steel = Material::steel(0.01);
    let top = Stop::Pinned(Point::new(0.0, 1.0, 5.0));
    let plan = WirePlan::new(steel, 0.25, vec![top, Stop::Eye { body, local }]);
    world.add_wire(&plan.adaptive())?;
    let side = Stop::Free(Point::new(4.0, 1.0, 3.0));
    let local = -local;
    let plan = WirePlan::new(steel.chain(), 0.25, vec![side, Stop::Eye { body, local }]);
    world.add_wire(&plan)?;
    let [left, right] = [-1.0, 1.0].map(|x| Stop::Free(Point::new(x, 0.6, 6.0)));
    world.add_wire(&WirePlan::new(steel, 0.25, vec![left, right]))?;
    Ok(world)
}

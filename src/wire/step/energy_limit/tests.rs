use super::*;
use crate::query::Point;
use crate::wire::record::SolverRecord;
use crate::wire::step::contact_blocks::Swept;
use crate::wire::step::linearisation::Linearisation;
use crate::wire::step::order::by_wires;
use crate::wire::{BodyPlan, Material, Settings, Shape, Stop, WirePlan};

/// A ball of 1 kg on a rope that hangs slack from a pin, at 2 m/s.
fn world() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let shape = Shape::Sphere { radius: 0.1 };
    let density = 750.0 / std::f64::consts::PI;
    let plan = BodyPlan::dynamic(shape, density, Point::new(0.0, 0.0, -0.5));
    let body = world.add_body(plan).unwrap();
    world.bodies[0].velocity = Vector::new(2.0, 0.0, 0.0);
    let local = Vector::zeros();
    let route = vec![Stop::Pinned(Point::origin()), Stop::Eye { body, local }];
    let plan = WirePlan::new(Material::steel(1e-6).chain(), 1.0, route);
    world.add_wire(&plan).unwrap();
    world
}

/// A solution that moves the ball at so many m/s, straight down.
fn solution(layout: &Layout, speed: f64, contact_residual: f64) -> Candidate {
    let mut x = vec![0.0; layout.size];
    x[layout.bodies[0].unwrap() + 2] = -speed;
    Candidate {
        x,
        swept: Swept::default(),
        solver: SolverRecord {
            contact_residual,
            ..SolverRecord::default()
        },
    }
}

fn slowed(speed: f64, residual: f64, work: f64) -> (f64, bool) {
    let world = world();
    let layout = Layout::new(
        &world,
        &Linearisation::at_start(&world),
        &by_wires(&world),
        &[],
    );
    let mut candidate = solution(&layout, speed, residual);
    slow(&world, &layout, &[], &mut candidate, |_| work);
    let down = -candidate.x[layout.bodies[0].unwrap() + 2];
    (down, candidate.solver.slowed)
}

#[test]
fn motion_that_was_not_solved_has_no_more_energy_than_there_was() {
    // A speed of 2 m/s, and what gravity does in a step at 0 m/s before and 50 m/s after, all down.
    let by_gravity = 9.80665 / 60.0 * 50.0 / 2.0;
    let most = f64::sqrt(4.0 + 2.0 * by_gravity);
    let (speed, is_slowed) = slowed(50.0, 10.0, 0.0);
    assert!(
        is_slowed && (speed - most).abs() < 1e-3 * most,
        "{speed} {most}"
    );
    let (speed, _) = slowed(50.0, 10.0, 100.0);
    let most = f64::sqrt(4.0 + 2.0 * (by_gravity + 100.0));
    assert!((speed - most).abs() < 1e-3 * most, "{speed} {most}");
}

#[test]
fn motion_that_was_solved_is_as_it_is() {
    assert_eq!(slowed(50.0, 0.9, 0.0), (50.0, false));
    assert_eq!(slowed(2.0, 10.0, 0.0), (2.0, false));
}

use super::*;
use crate::query::Point;
use crate::wire::step::active_set::find_active_set;
use crate::wire::step::budget::Budget;
use crate::wire::step::linearisation::Linearisation;
use crate::wire::step::order::by_wires;
use crate::wire::world::World;
use crate::wire::{BodyPlan, Material, Settings, Shape, Stop, Vector, WirePlan};

/// A chain that turns over so many nodes of a fixed drum, 20 degrees at each, from straight up to
/// straight up or down, with a load at each end.
fn over_a_drum(nodes: u32, friction: f64, masses: [f64; 2]) -> World {
    const RADIUS: f64 = 0.5;
    let mut world = World::new(Settings::default()).unwrap();
    let shape = Shape::Sphere { radius: RADIUS };
    let drum = world
        .add_body(BodyPlan::fixed(shape, Point::origin()))
        .unwrap();
    let stops = (0..nodes).map(|i| {
        let angle = (f64::from(i) + 0.5) * 20.0_f64.to_radians();
        let normal = Vector::new(-libm::cos(angle), 0.0, libm::sin(angle));
        Stop::Contact {
            body: drum,
            local: normal * RADIUS,
            normal,
            friction,
        }
    });
    let mut route: Vec<Stop> = stops.collect();
    for (mass, x) in masses.into_iter().zip([-0.49, 0.49]) {
        let shape = Shape::Box {
            half: Vector::repeat(0.5),
        };
        let plan = BodyPlan::dynamic(shape, mass, Point::new(x, 0.0, -3.0));
        let body = world.add_body(plan).unwrap();
        let local = Vector::zeros();
        let at = if x < 0.0 { 0 } else { route.len() };
        route.insert(at, Stop::Eye { body, local });
    }
    let plan = WirePlan::new(Material::steel(0.005).chain(), 10.0, route);
    world.add_wire(&plan).unwrap();
    world
}

/// The bounds of friction after the first steps, found by `update` for given bounds.
fn bounds(world: &World, mut update: impl FnMut(&mut System, &[f64])) -> (Vec<f64>, usize) {
    let mut system = System::new(
        world,
        &Linearisation::at_start(world),
        &by_wires(world),
        None,
    );
    system.factor().unwrap();
    let mut x = system.start(world);
    for updates in 0..2000 {
        x = find_active_set(&mut system, &[], x, &mut Budget::new(usize::MAX))
            .unwrap()
            .x;
        if !capstan::bounds_differ(&system.rows, &x) {
            let found = system.rows.iter().filter_map(|row| row.law.bounds(&x));
            return (found.map(|[bound, _]| bound).collect(), updates);
        }
        update(&mut system, &x);
    }
    panic!("{}", capstan::bound_residual(&system.rows, &x));
}

/// Bounds that go a tenth of the way to those that follow, again and again.
fn follow(system: &mut System, x: &[f64]) {
    let bounds = system.rows.iter().filter_map(|row| row.law.bounds(x));
    let next: Vec<f64> = bounds.map(|[bound, due]| 0.9 * bound + 0.1 * due).collect();
    capstan::set_bounds(&mut system.rows, &next);
}

#[test]
fn bounds_are_those_that_follow_from_tensions_again_and_again() {
    // Half a turn and one and a half, with loads below and above the limit; from rest, where none
    // of the tensions is known, and later.
    for (nodes, friction, heavy) in [
        (9, 0.1, 1.2),
        (9, 0.5, 1.2),
        (27, 0.5, 0.99),
        (27, 0.5, 1.2),
    ] {
        let limit = libm::exp(friction * f64::from(nodes) * 20.0_f64.to_radians());
        let mut world = over_a_drum(nodes, friction, [1.0, heavy * limit]);
        for steps in [0, 1, 20] {
            for _ in 0..steps {
                world.step(&[]).unwrap();
            }
            let mut search = BoundSearch::new();
            let (found, updates) = bounds(&world, |system, x| {
                search.update(system, x, &mut Budget::new(usize::MAX));
            });
            let (expected, _) = bounds(&world, follow);
            assert!(found.len() == nodes as usize && found.iter().all(|&bound| bound > 0.0));
            assert!(updates < 30, "{updates}");
            let largest = expected.iter().fold(0.0, |a: f64, b| a.max(*b));
            for (found, expected) in found.iter().zip(&expected) {
                assert!(
                    (found - expected).abs() < 1e-7 * largest,
                    "{found} {expected}"
                );
            }
        }
    }
}

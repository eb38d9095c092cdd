//! Wires over the edges of a box.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::query::Point;
use crate::wire::{
    BodyPlan, Collisions, Material, NodeKind, Settings, Shape, StepRecord, Stop, Vector, WirePlan,
    World,
};

const RADIUS: f64 = 0.005;
const DENSITY: f64 = 1000.0;

/// A fixed cube of 1 m whose top is at height 0.
fn cube() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let half = Vector::repeat(0.5);
    let plan = BodyPlan::fixed(Shape::Box { half }, Point::new(0.0, 0.0, -0.5));
    world.add_body(plan).unwrap();
    world
}

/// An adaptive chain along a route.
fn lay(world: &mut World, route: Vec<Stop>) {
    let plan = WirePlan::new(Material::steel(RADIUS).chain(), 0.25, route);
    world.add_wire(&plan.adaptive()).unwrap();
}

/// A chain over the cube with balls of these masses at its ends, below the cube.
fn balls(masses: [f64; 2]) -> World {
    let mut world = cube();
    let across = 0.5 + 2.0 * RADIUS;
    let [left, right] = [(-across, masses[0]), (across, masses[1])].map(|(x, mass)| {
        let volume = mass / DENSITY;
        let radius = (volume * 3.0 / (4.0 * std::f64::consts::PI)).cbrt();
        let plan = BodyPlan::dynamic(Shape::Sphere { radius }, DENSITY, Point::new(x, 0.0, -1.6));
        let body = world.add_body(plan).unwrap();
        let local = Vector::zeros();
        let corner = Stop::Free(Point::new(x, 0.0, 2.0 * RADIUS));
        (Stop::Eye { body, local }, corner)
    });
    lay(&mut world, vec![left.0, left.1, right.1, right.0]);
    world
}

/// Steps a world with contact nodes, and shows every step.
fn run(world: &mut World, friction: f64, time: f64, mut look: impl FnMut(&World, &StepRecord)) {
    let collisions = Collisions::default().with_contact_nodes();
    let mut collisions = collisions.with_friction(friction).unwrap();
    for _ in 0..(time / world.settings().step) as usize {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        look(world, &record);
    }
}

/// The nodes of the wire that ride a body.
fn contact_nodes(world: &World) -> Vec<usize> {
    let nodes = world.wires()[0].nodes().iter().enumerate();
    let riding = nodes.filter(|(_, node)| matches!(node.kind, NodeKind::Contact { .. }));
    riding.map(|(at, _)| at).collect()
}

#[test]
fn wire_bends_over_edges_and_sticks_within_the_capstan_bound() {
    const FRICTION: f64 = 0.5;
    let mut world = balls([20.0, 40.0]);
    run(&mut world, FRICTION, 5.0, |_, _| {});
    let nodes = contact_nodes(&world);
    let wire = &world.wires()[0];
    assert_eq!(nodes.len(), 2, "{nodes:?}");
    for (node, side) in nodes.into_iter().zip([-1.0, 1.0]) {
        let edge = Point::new(side * 0.5, 0.0, 0.0);
        let apart = (wire.nodes()[node].position - edge).norm();
        assert!(apart < 3.0 * RADIUS, "{apart}");
        let [before, after] = [node - 1, node].map(|beside| wire.segments()[beside].tension);
        let bound = libm::tanh(FRICTION * FRAC_PI_4) * (before + after);
        assert!((after - before).abs() < 1.02 * bound, "{before} {after}");
    }
    for body in &world.bodies()[1..] {
        let weight = body.mass() * 9.80665;
        assert!(body.velocity().norm() < 1e-3);
        let tensions = wire.segments().iter().map(|segment| segment.tension);
        let nearest = tensions.map(|tension| (tension / weight - 1.0).abs());
        assert!(nearest.fold(1.0, f64::min) < 0.02);
    }
}

#[test]
fn wire_slides_over_edges_by_the_capstan_bound() {
    const FRICTION: f64 = 0.1;
    let mut world = balls([20.0, 60.0]);
    let mut speeds = Vec::new();
    // Until the lighter ball comes to the cube.
    run(&mut world, FRICTION, 0.45, |world, _| {
        speeds.push(-world.bodies()[2].velocity().z);
    });
    assert_eq!(contact_nodes(&world).len(), 2);
    // Atwood's machine, with the ratio of tensions of a right angle at each edge, and the chain's
    // mass.
    let ratio = libm::exp(FRICTION * FRAC_PI_2);
    let line = Material::steel(RADIUS).mass_per_length();
    let [left, right] =
        [(1, 1.4), (2, 1.8)].map(|(k, hangs)| world.bodies()[k].mass() + hangs * line);
    let carried = right + ratio * (line + ratio * left);
    let expected = 9.80665 * (right - ratio * ratio * left) / carried;
    let acceleration = (speeds[26] - speeds[17]) / (9.0 * world.settings().step);
    assert!(
        (acceleration / expected - 1.0).abs() < 0.01,
        "{acceleration} {expected}"
    );
}

/// A chain of which half a metre lies on the cube, and two hang over its edge.
fn over_an_edge() -> World {
    let mut world = cube();
    let on = Stop::Free(Point::new(0.0, 0.0, RADIUS));
    let corner = Stop::Free(Point::new(0.5 + RADIUS, 0.0, RADIUS));
    let end = Stop::Free(Point::new(0.5 + RADIUS, 0.0, -2.0));
    lay(&mut world, vec![on, corner, end]);
    world
}

#[test]
fn wire_slides_off_an_edge() {
    const FRICTION: f64 = 0.1;
    let mut world = over_an_edge();
    let (mut rode, mut left) = (0, 0);
    run(&mut world, FRICTION, 1.0, |world, record| {
        rode += contact_nodes(world).len();
        left += record.slides.iter().filter(|slide| slide.left).count();
    });
    assert!(rode > 10 && left == 1, "{rode} {left}");
    assert!(contact_nodes(&world).is_empty());
    let heights = |world: &World| {
        let nodes = world.wires()[0].nodes().iter();
        nodes
            .map(|node| node.position.z)
            .fold(f64::NEG_INFINITY, f64::max)
    };
    assert!(heights(&world) < -1.5);
    // Without contact nodes one that is free hooks on the edge.
    let mut world = over_an_edge();
    let mut collisions = Collisions::default().with_friction(FRICTION).unwrap();
    for _ in 0..60 {
        world.step_colliding(&mut collisions, &[]).unwrap();
    }
    assert!(contact_nodes(&world).is_empty() && heights(&world) > 0.0);
}

#[test]
fn wires_thrown_at_a_cube_are_stepped() {
    let rng = &mut ChaCha8Rng::seed_from_u64(1);
    // A fifth where Rust checks its arithmetic.
    let count = if cfg!(debug_assertions) { 60 } else { 300 };
    let (mut rode, mut left) = (0, 0);
    for k in 0..count {
        let mut world = cube();
        let mut somewhere = |from: f64, to: f64| Vector::from_fn(|_, _| rng.random_range(from..to));
        let middle = Point::from(somewhere(-0.3, 0.3) + Vector::z() * 0.4);
        let half = somewhere(-1.5, 1.5).xy().push(0.0);
        let ends = [middle - half, middle + half].map(Stop::Free);
        let material = Material::steel(RADIUS);
        let material = if k % 2 == 0 {
            material.chain()
        } else {
            material
        };
        let mut plan = WirePlan::new(material, 0.2, ends.to_vec()).adaptive();
        plan.velocity = somewhere(-3.0, 3.0);
        world.add_wire(&plan).unwrap();
        run(&mut world, [0.0, 0.2, 1.0][k % 3], 1.5, |world, record| {
            rode += contact_nodes(world).len();
            left += record.slides.iter().filter(|slide| slide.left).count();
            let nodes = world.wires()[0].nodes();
            assert!(nodes.iter().all(|node| node.velocity.norm() < 30.0), "{k}");
        });
    }
    assert!(rode > 3 * count && left > count / 30, "{rode} {left}");
}

//! Wires over the edges of a box.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::query::Point;
use crate::wire::{
    BodyId, BodyPlan, Collisions, Drive, Material, NodeKind, Phase, Settings, Shape, StepRecord,
    Stop, Vector, WirePlan, World,
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
    let collisions = Collisions::default();
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
        for slide in record.slides.iter().filter(|slide| slide.left) {
            left += 1;
            // Its last three centimetres, which may come to ride once more.
            let on = world.wires()[0].nodes()[slide.node].arc;
            assert!(on < 0.03, "{on} m were left");
        }
    });
    assert!(rode > 10 && (1..=2).contains(&left), "{rode} {left}");
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
    let collisions = Collisions::default().without_contact_nodes();
    let mut collisions = collisions.with_friction(FRICTION).unwrap();
    for _ in 0..60 {
        world.step_colliding(&mut collisions, &[]).unwrap();
    }
    assert!(contact_nodes(&world).is_empty() && heights(&world) > 0.0);
}

/// A chain over an edge of the cube, whose ends move along the edge; over a contact node of its route or not.
fn drawn_along_an_edge(guided: bool) -> World {
    let mut world = cube();
    let mut end = |place: Point| {
        let phase = |from: f64, speed: f64| Phase {
            from,
            velocity: Vector::y() * speed,
            angular_velocity: Vector::zeros(),
        };
        let drive = Drive::Kinematic(vec![phase(0.5, 0.1), phase(4.5, 0.0)]);
        let shape = Shape::Sphere { radius: 0.01 };
        let plan = BodyPlan {
            drive,
            ..BodyPlan::fixed(shape, place)
        };
        let body = world.add_body(plan).unwrap();
        let local = Vector::zeros();
        Stop::Eye { body, local }
    };
    // Symmetric about the plane that halves the edge.
    let [from, to] = [Point::new(0.1, -0.2, 0.1), Point::new(0.6, -0.2, -0.4)].map(&mut end);
    let out = Vector::new(1.0, 0.0, 1.0).normalize();
    let corner = Point::new(0.5, -0.2, 0.0) + corner_of_edge();
    let over = if guided {
        Stop::Contact {
            body: BodyId(0),
            local: corner - Point::new(0.0, 0.0, -0.5),
            normal: out,
            friction: FRICTION_OF_EDGE,
        }
    } else {
        Stop::Free(corner)
    };
    let material = Material {
        density: 500.0,
        stretch_modulus: 1e7,
        ..Material::steel(RADIUS).chain()
    };
    let mut plan = WirePlan::new(material, 0.2, vec![from, over, to]).adaptive();
    plan.length = Some(0.78);
    world.add_wire(&plan).unwrap();
    world
}

const FRICTION_OF_EDGE: f64 = 0.5;

/// Where the wire turns, from the edge.
fn corner_of_edge() -> Vector {
    Vector::new(1.0, 0.0, 1.0).normalize() * RADIUS
}

#[test]
fn wire_slips_along_an_edge_where_friction_holds_it_no_more() {
    // With `phi` the angle by which both parts of the wire are off the plane across the edge, they pull along it with
    // 2 T sin(phi), and into it with T cos(phi) times the sum of their directions across. A curve of this turn `D` is
    // pressed by (D/2) / sin(D/2) of that.
    let across = [(-0.4, 0.1), (0.1, -0.4)];
    let across = across.map(|(x, z)| Vector::new(x, 0.0, z) - corner_of_edge());
    let length = across[0].norm();
    let sum = (across[0] + across[1]).norm() / length;
    let half = libm::acos(sum / 2.0);
    let half = std::f64::consts::FRAC_PI_2 - half;
    let slope = FRICTION_OF_EDGE * sum / 2.0 * half / libm::sin(half);
    for guided in [false, true] {
        let mut world = drawn_along_an_edge(guided);
        let (mut lags, mut attached) = (Vec::new(), Vec::new());
        // The ends rest for half a second, and move for four.
        run(&mut world, FRICTION_OF_EDGE, 4.5, |world, _| {
            let end = world.bodies()[1].position().y;
            let apart = |place: &Point| (place.x - 0.5).hypot(place.z);
            let nodes = world.wires()[0].nodes().iter().map(|node| node.position);
            let nearest = nodes.min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap();
            lags.push((end - nearest.y) / length);
            attached.push(contact_nodes(world).len());
        });
        assert_eq!(attached[25], 1);
        let last = lags[lags.len() - 1];
        if guided {
            assert!(attached.iter().all(|&count| count == 1));
            assert!((last * length - 0.4).abs() < 2e-3, "{last}");
            continue;
        }
        // It sticks as far as that and then slips: with a free node, which contacts of both segments hold, whose
        // normals together are 1.17 times as long as their sum.
        let slips = attached.iter().skip(25).position(|&count| count == 0);
        let slips = 25 + slips.unwrap();
        assert!(
            lags[slips] > slope && lags[slips] < 1.1 * slope,
            "{} {slope}",
            lags[slips]
        );
        let steady = &lags[lags.len() - 120..];
        assert!(steady.iter().all(|lag| (lag / last - 1.0).abs() < 0.01));
        assert!(last > slope && last < 1.25 * slope, "{last} {slope}");
    }
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

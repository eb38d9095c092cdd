use super::*;
use crate::query::Point;
use crate::wire::step::transverse::transverse_inertias;
use crate::wire::{BodyPlan, Material, Settings, Shape, Stop, WirePlan};

/// A ball that hangs on a bent wire by an eye beside its middle.
fn hanging(tension: f64) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let ball = Shape::Sphere { radius: 0.05 };
    let plan = BodyPlan::dynamic(ball, 7850.0, Point::new(0.0, 0.0, 1.0));
    let body = world.add_body(plan).unwrap();
    let route = vec![
        Stop::Pinned(Point::new(0.3, 0.1, 3.0)),
        Stop::Free(Point::new(0.1, 0.2, 1.5)),
        Stop::Eye {
            body,
            local: Vector::new(0.02, -0.01, 0.03),
        },
        Stop::Free(Point::new(0.2, -0.4, 0.9)),
        Stop::Pinned(Point::new(0.1, -0.7, 0.0)),
    ];
    let plan = WirePlan::new(Material::steel(0.005).chain(), 5.0, route);
    world.add_wire(&plan).unwrap();
    for segment in &mut world.wires[0].segments {
        segment.tension_history[0] = tension;
    }
    world.wires[0].segments[2].tension_history[0] = tension / 3.0;
    world
}

fn levers(world: &World) -> Vec<TransverseInertia> {
    let all = transverse_inertias(world, &Linearisation::at_start(world));
    let levers = all.short.into_iter();
    levers.filter(|inertia| inertia.spin.is_some()).collect()
}

/// Sets velocities of all nodes; those that a body carries have the body's.
fn set(world: &mut World, velocity: impl Fn(usize) -> Vector) {
    for node in 0..world.wires[0].nodes.len() {
        let carrier = world.wires[0].nodes[node].kind.carrier();
        world.wires[0].nodes[node].velocity = match carrier {
            Some((body, local)) => world.bodies[body.0].velocity_at(&local),
            None => velocity(node),
        };
    }
}

fn velocity(world: &World, lever: &TransverseInertia) -> Vector {
    lever.velocity(&world.wires[0], |body| world.bodies[body].angular_velocity)
}

#[test]
fn what_swings_as_one_is_not_held() {
    let mut world = hanging(1e4);
    let (shift, spin) = (Vector::new(0.3, -0.2, 0.5), Vector::new(2.0, -1.0, 3.0));
    let places: Vec<Vector> = (world.wires[0].nodes.iter())
        .map(|node| node.position.coords)
        .collect();
    let middle = world.bodies[0].position.coords;
    world.bodies[0].velocity = shift + spin.cross(&middle);
    world.bodies[0].angular_velocity = spin;
    set(&mut world, |node| shift + spin.cross(&places[node]));
    let [lever] = &levers(&world)[..] else {
        panic!("one eye")
    };
    assert!(velocity(&world, lever).norm() < 1e-12);
    // Another spin does turn the arm against the pull.
    world.bodies[0].angular_velocity = -spin;
    assert!(velocity(&world, lever).norm() > 0.1);
}

#[test]
fn what_is_held_is_the_angle_between_arm_and_pull() {
    const DT: f64 = 1e-7;
    let mut world = hanging(1e4);
    world.bodies[0].velocity = Vector::new(0.4, 0.1, -0.6);
    world.bodies[0].angular_velocity = Vector::new(-3.0, 5.0, 2.0);
    set(&mut world, |node| {
        let node = node as f64;
        Vector::new(0.3 * node, 0.5 - node, 0.2 * node * node)
    });
    let directions = |world: &World| {
        let nodes = &world.wires[0].nodes;
        let pull = |from: usize, to: usize| unit(&(nodes[to].position - nodes[from].position)).0;
        let pulled = pull(2, 1) * 1e4 + pull(2, 3) * (1e4 / 3.0);
        let body = &world.bodies[0];
        let arm = nodes[2].position - body.position;
        (unit(&arm).0, unit(&pulled).0)
    };
    let [lever] = &levers(&world)[..] else {
        panic!("one eye")
    };
    let u = velocity(&world, lever);
    let (r, f) = directions(&world);
    let mut later = world.clone();
    for node in &mut later.wires[0].nodes {
        node.position += node.velocity * DT;
    }
    later.bodies[0].position += world.bodies[0].velocity * DT;
    let (r_later, f_later) = directions(&later);
    let rate = (r_later.dot(&f_later) - r.dot(&f)) / DT;
    assert!((f.dot(&u) + rate).abs() < 1e-5, "{} {rate}", f.dot(&u));
}

#[test]
fn what_a_step_follows_is_left_as_it_is() {
    // k = h^2 |F| |r| / s^2, i = 2 m R^2 / 5.
    let (arm, ball) = (Vector::new(0.02, -0.01, 0.03).norm(), 0.4 * 4.11 * 0.0025);
    let reach = 1.0 / 60.0 / 0.8;
    let pull = ball / (reach * reach * arm);
    assert_eq!(levers(&hanging(0.6 * pull)).len(), 0);
    assert_eq!(levers(&hanging(1.5 * pull)).len(), 1);
}

/// A ring under a hook, from which 480 kg hang, starts aslant. The most energy in J that comes from nothing in a step, the
/// largest tension in N, and how fast the ring spins after a second, in rad/s.
fn ring(rate: f64, degrees: f64) -> [f64; 3] {
    let mut world = World::new(Settings::default().with_step(1.0 / rate)).unwrap();
    let ball = Shape::Sphere { radius: 0.05 };
    let mut plan = BodyPlan::dynamic(ball, 7850.0, Point::new(0.0, 0.0, 4.0));
    plan.orientation = nalgebra::UnitQuaternion::from_axis_angle(
        &nalgebra::Unit::new_normalize(Vector::new(1.0, 0.3, 0.0)),
        degrees.to_radians(),
    );
    let ring = world.add_body(plan).unwrap();
    let half = Vector::repeat(0.2);
    let load = BodyPlan::dynamic(Shape::Box { half }, 7500.0, Point::new(0.0, 0.0, 2.5));
    let load = world.add_body(load).unwrap();
    let eye = |body, z: f64| Stop::Eye {
        body,
        local: Vector::new(0.0, 0.0, z),
    };
    let rope = Material::steel(0.01).chain();
    let hoist = vec![Stop::Pinned(Point::new(0.0, 0.0, 7.0)), eye(ring, 0.05)];
    let sling = vec![eye(ring, -0.05), eye(load, 0.2)];
    for route in [hoist, sling] {
        world
            .add_wire(&WirePlan::new(rope.clone(), 0.5, route))
            .unwrap();
    }
    let mut largest = [0.0_f64; 3];
    let mut before = None;
    for step in 0..(2.0 * rate) as usize {
        let record = world.step(&[]).unwrap();
        let energy = record.energy.total();
        let gain = before.map_or(0.0, |before| energy - before - record.work);
        before = Some(energy);
        let tension = world.wires.iter().flat_map(|wire| &wire.segments);
        let tension = tension.map(|segment| segment.tension).fold(0.0, f64::max);
        let spin = world.bodies[0].angular_velocity.norm();
        let late = if step as f64 > rate { spin } else { 0.0 };
        largest = [
            largest[0].max(gain),
            largest[1].max(tension),
            largest[2].max(late),
        ];
    }
    largest
}

/// Without what keeps it, 13 kJ come from nothing in a step.
#[test]
fn ring_under_a_hook_comes_to_rest_at_any_step() {
    for rate in [30.0, 60.0, 120.0, 240.0, 1000.0] {
        for degrees in [0.0, 5.0, 40.0, 90.0] {
            let [gain, tension, spin] = ring(rate, degrees);
            let text = format!("{rate} {degrees}: {gain} J, {tension} N, {spin} rad/s");
            assert!(gain < 50.0 && tension < 2e5 && spin < 4.0, "{text}");
            if degrees == 0.0 {
                assert!(gain < 0.5 && tension < 5e3 && spin == 0.0, "{text}");
            }
        }
    }
}

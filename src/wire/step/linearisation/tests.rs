use nalgebra::UnitQuaternion;

use super::*;
use crate::query::Point;
use crate::wire::model::{BodyPlan, Drive, Material, Phase, RopePlan, Shape, Stop, WirePlan};
use crate::wire::settings::Settings;
use crate::wire::step::spin::turn as turn_by;

/// A load under a slack chain between a pin and the load, which falls until the chain catches it.
fn caught(mass: f64, rate: f64, adaptive: bool) -> World {
    const REACH: f64 = 0.6;
    let mut world = World::new(Settings::default().with_step(1.0 / rate)).unwrap();
    let shape = Shape::Sphere { radius: 0.1 };
    let density = mass / (4.0 / 3.0 * std::f64::consts::PI * 1e-3);
    let load = BodyPlan::dynamic(shape, density, Point::new(REACH, 0.0, 0.0));
    let body = world.add_body(load).unwrap();
    let area = std::f64::consts::PI * 1e-4;
    let material = Material {
        density: 0.4 / area,
        stretch_modulus: 1e6 / area,
        ..Material::steel(0.01).chain()
    };
    let between = (1..20).map(|node| {
        let part = f64::from(node) / 20.0;
        Stop::Free(Point::new(REACH * part, 0.0, -3.6 * part * (1.0 - part)))
    });
    let mut route = vec![Stop::Pinned(Point::origin())];
    route.extend(between);
    let local = Vector::zeros();
    route.push(Stop::Eye { body, local });
    let mut plan = WirePlan::new(material, 0.1, route);
    plan.resolution.adaptive = adaptive;
    world.add_wire(&plan).unwrap();
    world
}

#[test]
fn load_that_a_slack_chain_catches_is_thrown_no_higher_than_it_was() {
    for (mass, rate, adaptive) in [
        (33.0, 60.0, false),
        (33.0, 60.0, true),
        (33.0, 30.0, false),
        (33.0, 240.0, false),
        (330.0, 60.0, false),
        (4.2, 60.0, true),
    ] {
        let mut world = caught(mass, rate, adaptive);
        let start = world.kinetic_energy() + world.potential_energy();
        // What the load falls by.
        let fall = mass * 9.81 * 1.8;
        let mut pulled = 0.0f64;
        for _ in 0..(3.0 * rate) as usize {
            let record = world.step(&[]).unwrap();
            pulled = record.wires[0]
                .tensions
                .iter()
                .fold(pulled, |a, b| a.max(*b));
            // Changes of resolution cut corners, which moves them by a hair.
            let now = record.energy.kinetic + record.energy.potential;
            assert!(
                now < start + 1e-3 * fall,
                "{mass} kg, 1/{rate} s, {adaptive}: {now} J of {start} J"
            );
        }
        // It was caught, and hangs.
        let z = world.bodies()[0].position().z;
        assert!(
            pulled > 5.0 * mass * 9.81 && (-2.2..-1.4).contains(&z),
            "{pulled} N, {z} m"
        );
    }
}

#[test]
fn mean_arm_moves_a_point_as_far_as_the_body_turns() {
    let arm = Vector::new(0.3, -0.7, 1.1);
    for angle in [1e-9, 0.9e-2, 1.1e-2, 0.3, 2.0, 6.0] {
        let turn = Vector::new(2.0, -1.0, 2.0) / 3.0 * angle;
        let moved = turn.cross(&(mean_turn(&turn) * arm));
        let body = turn_by(&UnitQuaternion::identity(), &turn, 1.0);
        let due = body * arm - arm;
        assert!((moved - due).norm() < 1e-14 * angle.max(1.0), "{angle}");
    }
}

/// A ball of 5 kg that is thrown and turns, and that a rope holds by a point of its surface, slack at first.
fn thrown(rate: f64, spin: f64) -> World {
    let mut world = World::new(Settings::default().with_step(1.0 / rate)).unwrap();
    let ball = BodyPlan {
        drive: Drive::Dynamic {
            density: 700.0,
            velocity: Vector::new(4.0, 1.0, 3.0),
            angular_velocity: Vector::new(0.0, spin, 5.0),
        },
        ..BodyPlan::dynamic(Shape::Sphere { radius: 0.12 }, 700.0, Point::origin())
    };
    let body = world.add_body(ball).unwrap();
    let material = Material {
        density: 1200.0,
        stretch_modulus: 1e9,
        bend_modulus: 1e6,
        ..Material::steel(0.004)
    };
    let between = (1..20).map(|node| {
        let part = f64::from(node) / 20.0;
        let down = -3.0 * part * (1.0 - part);
        Stop::Free(Point::new(
            -1.0 + 0.876 * part,
            0.0,
            0.3 - 0.3 * part + down,
        ))
    });
    let mut route = vec![Stop::Pinned(Point::new(-1.0, 0.0, 0.3))];
    route.extend(between);
    let local = Vector::new(-0.124, 0.0, 0.0);
    route.push(Stop::Eye { body, local });
    world
        .add_wire(&WirePlan::new(material, 0.08, route))
        .unwrap();
    world
}

#[test]
fn body_that_turns_is_caught_with_no_more_energy_than_there_was() {
    for (rate, spin) in [30.0, 60.0, 240.0].into_iter().flat_map(|rate| {
        let spins = [0.0, 8.0, 20.0];
        spins.map(|spin| (rate, spin))
    }) {
        let mut world = thrown(rate, spin);
        let start = world.kinetic_energy() + world.potential_energy();
        let thrown = world.kinetic_energy();
        let (mut pulled, mut most) = (0.0f64, start);
        for _ in 0..(3.0 * rate) as usize {
            let record = world.step(&[]).unwrap();
            let tensions = &record.wires[0].tensions;
            pulled = tensions.iter().fold(pulled, |a, b| a.max(*b));
            most = most.max(record.energy.kinetic + record.energy.potential);
        }
        assert!(
            most < start + 2e-2 * thrown,
            "1/{rate} s, {spin} rad/s: {most} J of {start} J, {thrown} J thrown"
        );
        assert!(pulled > 100.0, "1/{rate} s, {spin} rad/s: {pulled} N");
    }
}

#[test]
fn length_of_a_segment_on_one_body_does_not_change_as_it_turns() {
    let mut world = World::new(Settings::default()).unwrap();
    let spin = Vector::new(9.0, -12.0, 6.0);
    let drum = BodyPlan {
        drive: Drive::Kinematic(vec![Phase {
            from: 0.0,
            velocity: Vector::new(0.1, 0.2, 0.3),
            angular_velocity: spin,
        }]),
        ..BodyPlan::fixed(Shape::Sphere { radius: 1.0 }, Point::origin())
    };
    let body = world.add_body(drum).unwrap();
    let eye = |local| Stop::Eye { body, local };
    let route = vec![
        eye(Vector::new(1.0, 0.0, 0.0)),
        eye(Vector::new(0.0, 1.0, 0.0)),
        Stop::Free(Point::new(0.0, 2.0, 0.0)),
    ];
    let mut plan = WirePlan::new(Material::steel(0.01), 10.0, route);
    plan.resolution.adaptive = false;
    world.add_wire(&plan).unwrap();
    for _ in 0..20 {
        let record = world.step(&[]).unwrap();
        // A chord of the start seems to be 3.5% shorter after it.
        let strain = record.wires[0].tensions[0] / world.wires[0].material.stretch_stiffness();
        assert!(strain.abs() < 1e-5, "{strain:e}");
    }
}

/// A body that spins on a steel wire of 10 mm and 2 m, thrown upwards, without contacts between them.
fn spun(rate: f64, shape: Shape, spin: Vector, local: Vector, chain: bool) -> World {
    let mut world = World::new(Settings::default().with_step(1.0 / rate)).unwrap();
    let plan = BodyPlan {
        drive: Drive::Dynamic {
            density: 1000.0,
            velocity: Vector::z() * 2.0,
            angular_velocity: spin,
        },
        ..BodyPlan::dynamic(shape, 1000.0, Point::new(0.0, 0.0, -2.5))
    };
    let body = world.add_body(plan).unwrap();
    let steel = Material::steel(0.005);
    let material = if chain { steel.chain() } else { steel };
    let route = vec![Stop::Pinned(Point::origin()), Stop::Eye { body, local }];
    world
        .add_wire(&WirePlan::new(material, 0.1, route))
        .unwrap();
    world
}

#[test]
fn body_that_spins_on_a_stiff_wire_gains_no_energy() {
    let ball = Shape::Sphere { radius: 0.3 };
    let half = Vector::from_element(0.5);
    for rate in [60.0, 120.0, 240.0] {
        for (shape, spin, local, chain) in [
            (
                ball.clone(),
                Vector::new(6.0, 3.0, 1.0),
                Vector::zeros(),
                true,
            ),
            (
                Shape::Box { half },
                Vector::new(-6.46, -5.27, -6.02),
                Vector::z() * 0.5,
                false,
            ),
        ] {
            let mut world = spun(rate, shape, spin, local, chain);
            let kinetic = world.kinetic_energy();
            let mut before = world.energy_halfway().total();
            for _ in 0..(2.0 * rate) as usize {
                let now = world.step(&[]).unwrap().energy.total();
                let gain = now - before;
                assert!(gain < 1e-2 * kinetic, "1/{rate} s: {gain} J of {kinetic} J");
                before = now;
            }
        }
    }
}

#[test]
fn rope_catches_a_load_with_no_more_force_than_without_damping() {
    // A person of 50 kg falls by 2 m onto 3 m of rope that lies in a slack bend.
    for (rate, adaptive) in [
        (30.0, true),
        (45.0, true),
        (60.0, true),
        (60.0, false),
        (240.0, false),
    ] {
        let mut world = World::new(Settings::default().with_step(1.0 / rate)).unwrap();
        let half = Vector::from_element(0.2);
        let (mass, stiffness, length) = (50.0, 6e4, 3.0);
        let load = BodyPlan::dynamic(
            Shape::Box { half },
            mass / 0.064,
            Point::new(0.0, 0.0, -1.2),
        );
        let body = world.add_body(load).unwrap();
        let material = Material::rope(RopePlan {
            radius: 0.0055,
            mass_per_length: 0.08,
            stretch_stiffness: stiffness,
            bend_stiffness: 0.0,
            twist_stiffness: 0.0,
        })
        .unwrap();
        let route = vec![
            Stop::Pinned(Point::origin()),
            Stop::Free(Point::new(1.0, 0.0, -0.7)),
            Stop::Eye {
                body,
                local: Vector::z() * 0.2,
            },
        ];
        let mut plan = WirePlan::new(material, 0.3, route);
        plan.length = Some(length);
        plan.resolution.adaptive = adaptive;
        world.add_wire(&plan).unwrap();
        let mut pulled = 0.0f64;
        for _ in 0..(2.0 * rate) as usize {
            let record = world.step(&[]).unwrap();
            let tensions = &record.wires[0].tensions;
            pulled = tensions.iter().fold(pulled, |a, b| a.max(*b));
        }
        // m g (1 + sqrt(1 + 2 k H / m g)) of a spring k and the height H.
        let weight = mass * 9.80665;
        let most = weight * (1.0 + (1.0 + 2.0 * stiffness / length * 2.0 / weight).sqrt());
        assert!(
            pulled < most && pulled > 0.5 * most,
            "1/{rate} s, {adaptive}: {pulled} N of {most} N"
        );
    }
}

/// A load of 1.7 t pulls a steel wire of 6 mm taut within a step of 1/30 s, which carries its nodes a metre and more.
#[test]
fn wire_that_becomes_taut_within_a_step_is_followed_to_the_end_and_takes_energy() {
    let (length, aside, down) = (5.6, 1.6, 2.4);
    for (segments, reach) in [(20, 0.98), (40, 0.98), (20, 0.9)] {
        let mut world = World::new(Settings::default().with_step(1.0 / 30.0)).unwrap();
        let shape = Shape::Sphere { radius: 0.3 };
        let (mass, volume) = (1700.0, 4.0 / 3.0 * std::f64::consts::PI * 0.027);
        let start = Point::new(aside, 0.0, -down);
        let body = world
            .add_body(BodyPlan::dynamic(shape, mass / volume, start))
            .unwrap();
        // A bend in the plane of the fall.
        let between = (1..segments).map(|node| {
            let part = f64::from(node) / f64::from(segments);
            let bend = 4.0 * reach * part * (1.0 - part);
            Stop::Free(Point::new(aside * part - bend, 0.0, -down * part - bend))
        });
        let mut route = vec![Stop::Pinned(Point::origin())];
        route.extend(between);
        let local = Vector::zeros();
        route.push(Stop::Eye { body, local });
        let mut plan = WirePlan::new(Material::steel(0.003).chain(), 0.1, route);
        plan.resolution.adaptive = false;
        plan.length = Some(length);
        world.add_wire(&plan).unwrap();
        let start = world.kinetic_energy() + world.potential_energy();
        let (mut damped, mut largest) = (0.0f64, start);
        for _ in 0..60 {
            let record = world.step(&[]).unwrap();
            assert!(record.numerical_damping >= 0.0, "{record:?}");
            damped += record.numerical_damping;
            largest = largest.max(record.energy.total());
        }
        // What the load falls by until the wire is straight.
        let fall = mass * 9.81 * 3.0;
        let gained = largest - start;
        assert!(
            gained < 1e-6 * fall && (0.0..0.1 * fall).contains(&damped) && damped > 0.01 * fall,
            "{segments}, {reach}: gained {gained} J, damped {damped} J of {fall} J"
        );
    }
}

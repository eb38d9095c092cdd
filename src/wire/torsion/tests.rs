use nalgebra::UnitQuaternion;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::{FRAC_PI_2, PI};

use super::*;
use crate::query::Point;
use crate::wire::{BodyId, BodyPlan, Drive, Material, Phase, Settings, Shape, Stop, WirePlan};

fn twistable() -> Material {
    Material {
        twist_modulus: 7.9e10,
        ..Material::steel(0.005)
    }
}

fn vector(rng: &mut impl Rng, size: f64) -> Vector {
    Vector::from_fn(|_, _| rng.random_range(-size..size))
}

/// A wire that zigzags at random from a body to another, or from the world to itself, with no bend that
/// is too sharp.
fn zigzag(rng: &mut impl Rng, on_bodies: bool) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let mut route = Vec::new();
    for end in [0.0, 6.0] {
        let at = Point::new(end, 0.0, 0.0) + vector(rng, 0.3);
        let local = vector(rng, 0.2);
        let locals = [local, local + Vector::x() * 0.3 + vector(rng, 0.2)];
        let plan = BodyPlan::dynamic(Shape::Sphere { radius: 0.1 }, 1000.0, at);
        let body = world.add_body(plan).unwrap();
        route.extend(locals.map(|local| match on_bodies {
            true => Stop::Eye { body, local },
            false => Stop::Pinned(at + local),
        }));
        if end == 0.0 {
            let inner = (1..6).map(|x| Point::new(f64::from(x), 0.0, 0.0) + vector(rng, 0.4));
            route.extend(inner.map(Stop::Free));
        }
    }
    world
        .add_wire(&WirePlan::new(twistable(), 10.0, route))
        .unwrap();
    world
}

fn torsion(world: &World) -> Torsion {
    Torsion::of(&world.wires[0], &world.bodies).unwrap()
}

/// Moves everything by the velocities that it has, for a short time.
fn moved(world: &World, time: f64) -> World {
    let mut world = world.clone();
    for body in &mut world.bodies {
        body.position += body.velocity * time;
        let turn = UnitQuaternion::from_scaled_axis(body.angular_velocity * time);
        body.orientation = turn * body.orientation;
    }
    for node in &mut world.wires[0].nodes {
        match node.kind {
            NodeKind::Eye { body, local } => node.position = world.bodies[body.0].point(&local),
            _ => node.position += node.velocity * time,
        }
    }
    world
}

/// Velocities at random; nodes on bodies have those of their points.
fn set_moving(world: &mut World, rng: &mut impl Rng) {
    for body in &mut world.bodies {
        body.velocity = vector(rng, 1.0);
        body.angular_velocity = vector(rng, 1.0);
    }
    for node in &mut world.wires[0].nodes {
        node.velocity = match node.kind {
            NodeKind::Eye { body, local } => world.bodies[body.0].velocity_at(&local),
            NodeKind::Free => vector(rng, 1.0),
            _ => Vector::zeros(),
        };
    }
}

#[test]
fn rate_is_the_difference_of_the_angles_a_moment_later_and_before() {
    let rng = &mut ChaCha8Rng::seed_from_u64(1);
    for round in 0..400 {
        let mut world = zigzag(rng, round % 2 == 0);
        set_moving(&mut world, rng);
        let time = 1e-6;
        let [before, after] = [-time, time].map(|time| torsion(&moved(&world, time)).angle);
        let difference = less_turns(after - before) / (2.0 * time);
        let rate = torsion(&world).rate(&world.wires[0], &world.bodies);
        assert!((rate - difference).abs() < 1e-7, "{rate} {difference}");
        assert!(rate.abs() > 1e-3);
    }
}

#[test]
fn what_moves_as_one_keeps_its_twist_so_forces_and_moments_add_up_to_nothing() {
    let rng = &mut ChaCha8Rng::seed_from_u64(2);
    for _ in 0..200 {
        let mut world = zigzag(rng, true);
        let [velocity, spin] = [(); 2].map(|()| vector(rng, 1.0));
        for body in &mut world.bodies {
            body.velocity = velocity + spin.cross(&body.position.coords);
            body.angular_velocity = spin;
        }
        for node in &mut world.wires[0].nodes {
            node.velocity = velocity + spin.cross(&node.position.coords);
        }
        let now = torsion(&world);
        let rate = now.rate(&world.wires[0], &world.bodies);
        assert!(rate.abs() < 1e-13, "{rate}");
        let turned = torsion(&moved(&world, 0.7)).angle;
        // The nodes have gone straight, so take them to where a rotation has them.
        let mut as_one = moved(&world, 0.7);
        let turn = UnitQuaternion::from_scaled_axis(spin * 0.7);
        for (body, from) in as_one.bodies.iter_mut().zip(&world.bodies) {
            body.position = turn * from.position;
        }
        for (node, from) in as_one.wires[0].nodes.iter_mut().zip(&world.wires[0].nodes) {
            node.position = turn * from.position;
        }
        let as_one = torsion(&as_one).angle;
        assert!(less_turns(as_one - now.angle).abs() < 1e-13);
        assert!(less_turns(turned - now.angle).abs() > 1e-6);
        let force: Vector = now.gradient.iter().sum();
        assert!(force.norm() < 1e-13, "{force}");
        let nodes = now.gradient.iter().zip(&world.wires[0].nodes);
        let moment: Vector = nodes.map(|(by, node)| node.position.coords.cross(by)).sum();
        let of_ends: Vector = now.ends.iter().map(|(_, by)| by).sum();
        assert!((moment + of_ends).norm() < 1e-13, "{}", moment + of_ends);
    }
}

/// The world with the nodes of its wire a part of the way to those of another one.
fn between(from: &World, to: &World, part: f64) -> World {
    let mut world = from.clone();
    let nodes = world.wires[0].nodes.iter_mut().zip(&to.wires[0].nodes);
    for (node, to) in nodes {
        node.position += (to.position - node.position) * part;
    }
    world
}

/// How far the twist goes in a part of a motion, by its angle at so many instants that it goes by a
/// tenth of a radian at most from each to the next.
fn by_instants(from: &World, to: &World, part: [f64; 2]) -> f64 {
    let at = |part| torsion(&between(from, to, part)).angle;
    let way = less_turns(at(part[1]) - at(part[0]));
    let halfway = (part[0] + part[1]) / 2.0;
    if part[1] - part[0] < 1e-3 && way.abs() < 0.1 || halfway == part[0] {
        return way;
    }
    by_instants(from, to, [part[0], halfway]) + by_instants(from, to, [halfway, part[1]])
}

#[test]
fn twist_through_a_far_motion_is_that_of_many_instants_on_its_way() {
    let rng = &mut ChaCha8Rng::seed_from_u64(3);
    let (mut largest, mut by_rate): (f64, usize) = (0.0, 0);
    for _ in 0..40 {
        let from = zigzag(rng, false);
        let mut to = from.clone();
        for node in &mut to.wires[0].nodes {
            if node.kind == NodeKind::Free {
                // Farther than segments are long: they turn by any angle.
                node.velocity = vector(rng, 4.0);
                node.position += node.velocity;
            }
        }
        let due = by_instants(&from, &to, [0.0, 1.0]);
        let [before, after] = [torsion(&from), torsion(&to)];
        let swept = before.swept(&after);
        assert!((swept - due).abs() < 1e-9, "{swept} {due}");
        largest = largest.max(due.abs());
        by_rate += usize::from((before.rate(&to.wires[0], &to.bodies) - due).abs() > PI);
    }
    // Their rates at the start would not tell the turns.
    assert!(largest > TAU && by_rate > 5, "{largest} {by_rate}");
}

/// A wire along these directions, clamped to the world at both ends.
fn along(directions: &[Vector]) -> World {
    let mut at = Point::origin();
    let mut stops = vec![at];
    for direction in directions {
        at += direction;
        stops.push(at);
    }
    let count = stops.len();
    let route = stops.into_iter().enumerate();
    let route = route.map(|(k, at)| match k < 2 || k + 2 >= count {
        true => Stop::Pinned(at),
        false => Stop::Free(at),
    });
    let mut world = World::new(Settings::default()).unwrap();
    let plan = WirePlan::new(twistable(), 10.0, route.collect());
    world.add_wire(&plan).unwrap();
    world
}

#[test]
fn wire_that_ends_in_the_direction_in_which_it_starts_turns_by_the_area_of_its_directions() {
    // Gauss and Bonnet: what is carried around a triangle of great circles turns by its area.
    let (x, y, z) = (Vector::x(), Vector::y(), Vector::z());
    // So what is held is behind by as much.
    let octant = torsion(&along(&[x, y, z, x])).angle;
    assert!((octant + FRAC_PI_2).abs() < 1e-15, "{octant}");
    let back = torsion(&along(&[x, z, y, x])).angle;
    assert!((back - FRAC_PI_2).abs() < 1e-15, "{back}");
    // There and back on the same way there is no area, and in a plane neither.
    let flat = torsion(&along(&[x, y, x + y, y, x])).angle;
    assert!(flat.abs() < 1e-15, "{flat}");
    // A cone with the half angle `a` cuts `2 pi (1 - cos a)` from the sphere; of n directions,
    // n spherical triangles with two sides `a` and the angle `2 pi/n` between them.
    let (a, n) = (0.4_f64, 12);
    let cone = (0..=n).map(|k| {
        let around = TAU * f64::from(k) / f64::from(n);
        let (sine, cosine) = (libm::sin(a), libm::cos(a));
        Vector::new(sine * libm::cos(around), sine * libm::sin(around), cosine)
    });
    let tan = libm::tan(a / 2.0).powi(2);
    let corner = TAU / f64::from(n);
    let triangle = 2.0 * libm::atan2(tan * libm::sin(corner), 1.0 + tan * libm::cos(corner));
    let cone = torsion(&along(&cone.collect::<Vec<_>>())).angle;
    let due = less_turns(-f64::from(n) * triangle);
    assert!((cone - due).abs() < 1e-14, "{cone} {due}");
}

#[test]
fn wire_that_folds_onto_itself_or_has_no_length_has_a_bounded_gradient() {
    let (x, y) = (Vector::x(), Vector::y());
    for fold in [
        -x,
        -x + y * 1e-300,
        -x + y * 1e-12,
        -x + y * 1e-3,
        -x + y * 0.1,
    ] {
        let mut world = along(&[x, x, fold, y, y]);
        for collapsed in [false, true] {
            if collapsed {
                world.wires[0].nodes[3].position = world.wires[0].nodes[2].position;
            }
            let torsion = torsion(&world);
            assert!(torsion.angle.is_finite());
            let largest = torsion.gradient.iter().map(|by| by.norm());
            let largest = largest.fold(0.0, f64::max);
            assert!(largest < 30.0, "{largest}");
        }
        world.wires[0].twist = 100.0;
        for _ in 0..100 {
            world.step(&[]).unwrap();
            assert!(world.wires[0].twist.is_finite());
        }
    }
}

/// A body that turns about a straight wire as prescribed, in rad/s, and what holds the other end.
fn turned(speed: f64) -> World {
    let settings = Settings::default().with_gravity(Vector::zeros());
    let mut world = World::new(settings).unwrap();
    let drive = Drive::Kinematic(vec![Phase {
        from: 0.0,
        velocity: Vector::zeros(),
        angular_velocity: Vector::x() * speed,
    }]);
    let fixed = BodyPlan::fixed(Shape::Sphere { radius: 0.05 }, Point::new(1.0, 0.0, 0.0));
    let body = world.add_body(BodyPlan { drive, ..fixed }).unwrap();
    let eye = |x: f64| Stop::Eye {
        body,
        local: Vector::x() * x,
    };
    let pin = |x: f64| Stop::Pinned(Point::new(x, 0.0, 0.0));
    let route = vec![pin(-0.01), pin(0.0), eye(0.0), eye(0.01)];
    world
        .add_wire(&WirePlan::new(twistable(), 0.125, route))
        .unwrap();
    world
}

#[test]
fn twist_counts_turns_of_any_number_also_several_in_a_step() {
    for turns_in_a_step in [0.01, 0.4, 0.5, 0.6, 1.0, 7.3, 50.25, -0.7, -20.5] {
        let speed = turns_in_a_step * TAU * 60.0;
        let mut world = turned(speed);
        for step in 1..=50 {
            let record = world.step(&[]).unwrap();
            let due = turns_in_a_step * TAU * f64::from(step);
            let twist = world.wires[0].twist();
            assert!(
                (twist - due).abs() < 1e-12 * due.abs().max(1.0),
                "{twist} {due}"
            );
            assert_eq!(record.wires[0].twist, twist);
        }
    }
}

#[test]
fn change_of_resolution_and_back_leaves_the_twist_as_it_was() {
    // A helix, so that every node that is taken out turns what is carried.
    let helix = (0..40).map(|k| {
        let turn = f64::from(k) * 0.5;
        Vector::new(0.1, 0.05 * libm::cos(turn), 0.05 * libm::sin(turn))
    });
    let mut world = along(&helix.collect::<Vec<_>>());
    let at_first = torsion(&world).angle;
    let nodes = world.wires[0].nodes.clone();
    let mut largest: f64 = 0.0;
    for node in (2..38).step_by(3) {
        let before = torsions(&world);
        let wire = &mut world.wires[0];
        let taken = wire.nodes.remove(node);
        let segment = wire.segments.remove(node);
        follow_changes(&mut world, &before);
        largest = largest.max(world.wires[0].twist().abs());
        let before = torsions(&world);
        let wire = &mut world.wires[0];
        let middle = nalgebra::center(&wire.nodes[node - 1].position, &wire.nodes[node].position);
        wire.nodes.insert(
            node,
            Node {
                position: middle,
                ..taken
            },
        );
        wire.segments.insert(node, segment);
        follow_changes(&mut world, &before);
        // As a motion takes it back to where it was.
        let before = torsions(&world);
        world.wires[0].nodes[node].position = taken.position;
        follow_changes(&mut world, &before);
    }
    assert_eq!(world.wires[0].nodes, nodes);
    assert_eq!(torsion(&world).angle, at_first);
    let twist = world.wires[0].twist();
    assert!(twist.abs() < 1e-13, "{twist}");
    assert!(largest > 1e-4, "{largest}");
}

#[test]
fn ends_are_clamped_by_two_points_of_one_thing_and_wires_hold_twist_between() {
    let mut world = World::new(Settings::default()).unwrap();
    let ball = |x: f64| BodyPlan::fixed(Shape::Sphere { radius: 0.1 }, Point::new(x, 0.0, 0.0));
    let [a, b] = [0.0, 5.0].map(|x| world.add_body(ball(x)).unwrap());
    let pin = |x: f64| Stop::Pinned(Point::new(x, 0.0, 0.0));
    let free = |x: f64| Stop::Free(Point::new(x, 0.0, 0.0));
    let eye = |body: BodyId, x: f64| Stop::Eye {
        body,
        local: Vector::x() * x,
    };
    let cases = [
        (vec![pin(0.0), pin(1.0), pin(4.0), pin(5.0)], true),
        (vec![eye(a, 0.0), eye(a, 0.1), pin(4.0), pin(5.0)], true),
        (
            vec![eye(a, 0.0), eye(a, 0.1), eye(b, -0.1), eye(b, 0.0)],
            true,
        ),
        (vec![pin(0.0), pin(1.0), eye(b, 0.0)], false),
        (vec![pin(0.0), pin(1.0), eye(a, 2.0), eye(b, 0.0)], false),
        (vec![pin(0.0), eye(a, 1.0), pin(4.0), pin(5.0)], false),
        (vec![pin(0.0), pin(1.0), pin(5.0)], false),
        (vec![pin(0.0), pin(5.0)], false),
        (
            vec![pin(0.0), free(0.5), pin(1.0), pin(4.0), pin(5.0)],
            false,
        ),
    ];
    for (route, holds) in cases {
        for (modulus, resists) in [(0.0, false), (7.9e10, true)] {
            let material = Material {
                twist_modulus: modulus,
                ..Material::steel(0.01)
            };
            // Much finer than the clamps.
            let plan = WirePlan::new(material, 0.03, route.clone());
            let id = world.add_wire(&plan).unwrap();
            assert_eq!(
                world.wires[id.0].holds_twist(),
                holds && resists,
                "{route:?}"
            );
            let wires = world.wires.len();
            let twisted = world.add_wire(&plan.clone().twisted(-50.0));
            assert_eq!(twisted.is_ok(), holds && resists);
            if let Err(error) = twisted {
                let accepted =
                    "0 unless the material has a twist_modulus and both ends are clamped";
                assert_eq!(
                    error.to_string(),
                    format!("twist is -50, it must be {accepted}")
                );
                assert_eq!(world.wires.len(), wires);
            }
            for twist in [f64::NAN, f64::INFINITY] {
                let error = world.add_wire(&plan.clone().twisted(twist)).unwrap_err();
                assert_eq!(
                    error.to_string(),
                    format!("twist is {twist}, it must be finite")
                );
            }
        }
    }
}

#[test]
fn clamp_stays_as_the_route_has_it_whatever_the_resolution() {
    // Free nodes beside the ends, which tension would take out, and clamps that are long.
    let pin = |x: f64| Stop::Pinned(Point::new(x, 0.0, 0.0));
    let free = |x: f64| Stop::Free(Point::new(x, 0.0, 0.0));
    for (route, holds) in [
        (
            vec![pin(0.0), free(0.01), pin(0.02), pin(3.0), pin(4.0)],
            false,
        ),
        (vec![pin(0.0), pin(1.0), pin(3.0), pin(4.0)], true),
    ] {
        let mut world = World::new(Settings::default()).unwrap();
        let mut plan = WirePlan::new(twistable(), 0.1, route).adaptive();
        plan.length = Some(3.99);
        let id = world.add_wire(&plan).unwrap();
        for _ in 0..60 {
            world.step(&[]).unwrap();
        }
        assert_eq!(world.wires[id.0].holds_twist(), holds);
    }
}

#[test]
fn torque_on_bodies_keeps_angular_momentum() {
    // Two bodies at the ends of a straight wire that is twisted by ten turns.
    let settings = Settings::default().with_gravity(Vector::zeros());
    let mut world = World::new(settings).unwrap();
    let half = Vector::new(0.1, 0.05, 0.2);
    let ids = [0.0, 1.0].map(|x| {
        let plan = BodyPlan::dynamic(
            Shape::Box { half },
            1000.0 + 500.0 * x,
            Point::new(x, 0.0, 0.0),
        );
        world.add_body(plan).unwrap()
    });
    let eye = |end: usize, x: f64| Stop::Eye {
        body: ids[end],
        local: Vector::x() * x,
    };
    let route = vec![eye(0, -0.01), eye(0, 0.0), eye(1, 0.0), eye(1, 0.01)];
    let plan = WirePlan::new(twistable(), 0.25, route).twisted(20.0 * PI);
    world.add_wire(&plan).unwrap();
    let mut largest: f64 = 0.0;
    for _ in 0..200 {
        world.step(&[]).unwrap();
        let [a, b] = [0, 1].map(|body| {
            let body = &world.bodies[body];
            (body.world_inertia() * body.angular_velocity).x
        });
        largest = largest.max(a);
        assert!((a + b).abs() < 1e-9 * largest, "{a} {b}");
        assert!(world.angular_momentum().norm() < 1e-9 * largest);
    }
    assert!(largest > 1.0, "{largest}");
}

#[test]
fn rod_far_beyond_its_threshold_writhes_and_gains_no_energy() {
    // A slack rod under ten times the torque at which it buckles, on meshes and with steps of all sorts.
    for (segments, step, damping) in [
        (20, 1.0 / 60.0, 0.075),
        (60, 1.0 / 60.0, 0.02),
        (40, 1.0 / 240.0, 0.02),
    ] {
        let settings = Settings::default()
            .with_step(step)
            .with_gravity(Vector::zeros());
        let mut world = World::new(settings).unwrap();
        let pin = |x: f64| Stop::Pinned(Point::new(x, 0.0, 0.0));
        let bent = Stop::Free(Point::new(0.5, 0.01, 0.002));
        let route = vec![pin(-0.01), pin(0.0), bent, pin(1.0), pin(1.01)];
        let material = Material {
            bend_damping: damping,
            ..twistable()
        };
        let twist = 90.0 * material.bend_stiffness() / material.twist_stiffness();
        let mut plan = WirePlan::new(material, 1.0 / f64::from(segments), route).twisted(twist);
        plan.length = Some(1.1);
        world.add_wire(&plan).unwrap();
        let start = world.energy().total();
        let mut aside: f64 = 0.0;
        for _ in 0..(3.0 / step) as usize {
            let record = world.step(&[]).unwrap();
            let energy = record.energy.total();
            assert!(energy < 1.01 * start, "{segments} {step}: {energy} {start}");
            let nodes = world.wires[0].nodes.iter();
            aside = nodes.fold(aside, |aside, node| {
                aside.max(node.position.coords.yz().norm())
            });
        }
        // It has bent, and that took energy out of the twist.
        let end = world.energy().total();
        assert!(end < 0.99 * start && aside > 0.05, "{end} {start} {aside}");
    }
}

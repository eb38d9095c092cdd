//! Wires that wind up on drums, and off.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::UnitQuaternion;

use crate::query::Point;
use crate::wire::model::Mesh;
use crate::wire::{
    BodyPlan, Collisions, Drive, Material, NodeKind, Phase, Settings, Shape, Stop, Vector,
    WirePlan, World,
};

const RADIUS: f64 = 0.3;
const WIRE: f64 = 0.01;
const LOAD: f64 = 100.0;

/// A prism of so many sides around a cylinder of the radius, along z.
fn prism(sides: usize) -> Shape {
    let out = RADIUS / (TAU / (2.0 * sides as f64)).cos();
    let corner = |k: usize, z: f64| {
        let angle = TAU * (k as f64 + 0.5) / sides as f64;
        Point::new(out * angle.cos(), out * angle.sin(), z)
    };
    let mut vertices: Vec<Point> = (0..sides)
        .flat_map(|k| [corner(k, -0.5), corner(k, 0.5)])
        .collect();
    let [bottom, top] = [vertices.len(), vertices.len() + 1];
    vertices.extend([-0.5, 0.5].map(|z| Point::new(0.0, 0.0, z)));
    let triangles = (0..sides).flat_map(|k| {
        let [a, b] = [2 * k, 2 * ((k + 1) % sides)];
        [
            [a, b, b + 1],
            [a, b + 1, a + 1],
            [b, a, bottom],
            [a + 1, b + 1, top],
        ]
    });
    Shape::Mesh(Mesh::new(vertices, triangles.collect()).unwrap())
}

/// A drum around y that turns at this speed from 1 s to 5 s and back from 5 s to 9 s, with a load of 100 kg on 8 m of wire
/// that hangs off its side and ends on the drum, this far from its axis.
fn drum(shape: Shape, material: Material, speed: f64, eye: f64, step: f64) -> World {
    drum_of(shape, material, 0.1, eye, step, |phase| {
        vec![phase(1.0, speed), phase(5.0, -speed), phase(9.0, 0.0)]
    })
}

/// The same with wire of a resolution, and phases of the drum made of times and speeds.
fn drum_of(
    shape: Shape,
    material: Material,
    resolution: f64,
    eye: f64,
    step: f64,
    phases: impl FnOnce(&dyn Fn(f64, f64) -> Phase) -> Vec<Phase>,
) -> World {
    let mut world = World::new(Settings {
        step,
        ..Settings::default()
    })
    .unwrap();
    let phase = |from: f64, speed: f64| Phase {
        from,
        velocity: Vector::zeros(),
        angular_velocity: Vector::y() * speed,
    };
    let plan = BodyPlan {
        orientation: UnitQuaternion::from_axis_angle(&Vector::x_axis(), FRAC_PI_2),
        drive: Drive::Kinematic(phases(&phase)),
        ..BodyPlan::fixed(shape, Point::origin())
    };
    let drum = world.add_body(plan).unwrap();
    let radius = 0.15;
    let density = LOAD / (2.0 / 3.0 * TAU * radius * radius * radius);
    let below = Point::new(eye, 0.0, -8.0 - radius);
    let load = world
        .add_body(BodyPlan::dynamic(Shape::Sphere { radius }, density, below))
        .unwrap();
    let ends = [(drum, Vector::x() * eye), (load, Vector::z() * radius)];
    let route = ends.map(|(body, local)| Stop::Eye { body, local }).to_vec();
    world
        .add_wire(&WirePlan::new(material, resolution, route).adaptive())
        .unwrap();
    world
}

fn contact_nodes(world: &World) -> usize {
    let nodes = world.wires()[0].nodes().iter();
    nodes
        .filter(|node| matches!(node.kind, NodeKind::Contact { .. }))
        .count()
}

/// Steps until a time, and says by how much energy grew in a step at most beyond the work of the drum, in J.
fn run(world: &mut World, collisions: &mut Collisions<'_>, until: f64) -> f64 {
    let mut energy = world.energy_halfway().total();
    let mut gain = 0.0_f64;
    while world.time() < until - 1e-9 {
        let record = world.step_colliding(collisions, &[]).unwrap();
        let now = record.energy.total();
        gain = gain.max(now - energy - record.work);
        energy = now;
    }
    gain
}

#[test]
fn wire_winds_up_on_a_drum_and_off() {
    let cylinder = Shape::Cylinder {
        radius: RADIUS,
        half_height: 0.5,
    };
    let capsule = Shape::Capsule {
        radius: RADIUS,
        half_height: 0.5,
    };
    let steel = Material {
        bend_modulus: 3e8,
        ..Material::steel(WIRE)
    };
    let thin = Material::steel(WIRE / 5.0).chain();
    let cases = [
        (cylinder.clone(), steel, 1.0 / 60.0),
        (cylinder.clone(), steel, 1.0 / 240.0),
        (cylinder.clone(), steel.chain(), 1.0 / 30.0),
        (cylinder, thin, 1.0 / 60.0),
        (capsule, steel, 1.0 / 60.0),
        (prism(48), steel, 1.0 / 60.0),
    ];
    for (shape, material, step) in cases {
        for speed in [-1.0, 1.0] {
            let case = format!("{shape:?} {material:?} {step} {speed}");
            let out = RADIUS + material.radius;
            let mut world = drum(shape.clone(), material, speed, out, step);
            let mut collisions = Collisions::default();
            run(&mut world, &mut collisions, 1.0);
            let start = world.bodies()[1].position();
            let mut gain = run(&mut world, &mut collisions, 5.0);
            // Four radians; what comes from the other side winds up half a turn later, and the load is below that side then.
            let turned = if speed < 0.0 { 4.0 } else { 4.0 - TAU / 2.0 };
            let lifted = world.bodies()[1].position().z - start.z;
            assert!((lifted - turned * out).abs() < 0.02, "{case}: {lifted}");
            let nodes = world.wires()[0].nodes().iter();
            let carried: Vec<_> = nodes
                .filter(|node| matches!(node.kind, NodeKind::Contact { .. }))
                .collect();
            // At most a quarter of a radian apart; the prism has its edges every 0.13 rad.
            assert!(
                carried.len() >= (4.0 * turned) as usize,
                "{case}: {}",
                carried.len()
            );
            assert!(
                carried.len() <= (8.0 * turned) as usize + 4,
                "{case}: {}",
                carried.len()
            );
            for node in carried {
                let from_axis = node.position.x.hypot(node.position.z);
                assert!((from_axis - out).abs() < 2e-3, "{case}: {from_axis}");
            }
            gain = gain.max(run(&mut world, &mut collisions, 10.0));
            let back = world.bodies()[1].position().z - start.z;
            // From the other side it swings.
            let still = if speed < 0.0 { 2e-3 } else { 0.02 };
            assert!(back.abs() < still, "{case}: {back}");
            assert!(gain < 2.0, "{case}: {gain} J");
        }
    }
}

/// At up to a third of a radian in a step, on thin drums and with coarse segments.
#[test]
fn fast_drums_and_thin_ones_wind_wire_up_at_their_surface() {
    for (radius, wire, resolution, speed, step) in [
        (0.3, 0.01, 0.1, -8.0, 1.0 / 60.0),
        (0.3, 0.01, 0.2, -10.0, 1.0 / 30.0),
        (1.0, 0.02, 0.2, -4.0, 1.0 / 60.0),
        (0.03, 0.01, 0.1, -1.0, 1.0 / 60.0),
        (0.06, 0.008, 0.1, -2.0, 1.0 / 240.0),
        (0.3, 0.01, 1.0, -1.0, 1.0 / 60.0),
    ] {
        let case = format!("{radius} {wire} {resolution} {speed} {step}");
        let half_height = 0.5;
        let shape = Shape::Cylinder {
            radius,
            half_height,
        };
        let out = radius + wire;
        let material = Material::steel(wire).chain();
        let mut world = drum_of(shape, material, resolution, out, step, |phase| {
            // Five radians, at half of the speed at first and at last.
            let time = 5.0 / -speed;
            let last = 1.0 + 1.5 * time;
            vec![
                phase(1.0, speed / 2.0),
                phase(1.0 + time / 2.0, speed),
                phase(last - time / 2.0, speed / 2.0),
                phase(last, 0.0),
            ]
        });
        let mut collisions = Collisions::default();
        run(&mut world, &mut collisions, 1.0);
        let start = world.bodies()[1].position();
        let until = world.time() + 1.5 * 5.0 / -speed + 1.0;
        let gain = run(&mut world, &mut collisions, until);
        let lifted = world.bodies()[1].position().z - start.z;
        assert!(
            (lifted - 5.0 * out).abs() < 0.03 * 5.0 * out,
            "{case}: {lifted}"
        );
        assert!(gain < 10.0, "{case}: {gain} J");
    }
}

#[test]
fn wire_that_ends_inside_of_a_drum_is_one_with_it() {
    let shape = Shape::Cylinder {
        radius: RADIUS,
        half_height: 0.5,
    };
    let mut world = drum(
        shape,
        Material::steel(WIRE),
        -1.0,
        RADIUS - 0.05,
        1.0 / 60.0,
    );
    run(&mut world, &mut Collisions::default(), 5.0);
    assert_eq!(contact_nodes(&world), 0);
}

//! Wires and bodies on bodies: what rests, slides, is stopped, and what is left out.

use super::super::{Collisions, StepRecord};
use crate::query::Point;
use crate::wire::model::box_mesh;
use crate::wire::{
    BodyPlan, ContactConstraint, ContactRecord, ContactSite, Drive, Material, Phase, Settings,
    Shape, Stop, Vector, WirePlan, World,
};
use nalgebra::UnitQuaternion;

fn world() -> World {
    World::new(Settings::default()).unwrap()
}

/// Adds a wire along x, its middle at a height.
fn lay(world: &mut World, material: Material, height: f64, velocity: Vector) {
    let route = [-1.0, 1.0].map(|x| Stop::Free(Point::new(x, 0.0, height)));
    let mut plan = WirePlan::new(material, 0.25, route.to_vec());
    plan.velocity = velocity;
    world.add_wire(&plan).unwrap();
}

fn step(world: &mut World, collisions: &mut Collisions<'_>, steps: usize) -> StepRecord {
    let records = (0..steps).map(|_| world.step_colliding(collisions, &[]).unwrap());
    records.last().unwrap()
}

fn force(record: &StepRecord) -> Vector {
    record.contacts.iter().map(|contact| contact.force).sum()
}

fn lowest(world: &World) -> f64 {
    let nodes = world.wires()[0].nodes();
    nodes
        .iter()
        .map(|node| node.position.z)
        .fold(f64::MAX, f64::min)
}

/// Every shape with its top at z = 0.
fn grounds() -> Vec<BodyPlan> {
    let lying = UnitQuaternion::from_axis_angle(&Vector::y_axis(), std::f64::consts::FRAC_PI_2);
    let half = Vector::new(2.0, 1.0, 0.5);
    let (radius, half_height) = (0.5, 2.0);
    let below = |shape: Shape, depth: f64| BodyPlan::fixed(shape, Point::new(0.0, 0.0, -depth));
    let upright = Shape::Cylinder {
        radius: 2.0,
        half_height: 0.5,
    };
    let cylinder = Shape::Cylinder {
        radius,
        half_height,
    };
    let capsule = Shape::Capsule {
        radius,
        half_height,
    };
    let lie = |plan: BodyPlan| BodyPlan {
        orientation: lying,
        ..plan
    };
    vec![
        below(Shape::Plane, 0.0),
        below(Shape::Box { half }, 0.5),
        below(Shape::Mesh(box_mesh(half, Vector::zeros())), 0.5),
        below(upright, 0.5),
        lie(below(cylinder, 0.5)),
        lie(below(capsule, 0.5)),
        // So large that it is nearly flat.
        below(Shape::Sphere { radius: 1000.0 }, 1000.0),
    ]
}

#[test]
fn wire_that_falls_on_a_body_of_any_shape_rests_on_it_with_its_weight() {
    for ground in grounds() {
        let mut world = world();
        world.add_body(ground.clone()).unwrap();
        let material = Material::steel(0.02);
        lay(&mut world, material, 0.5, Vector::z() * -20.0);
        let mut collisions = Collisions::default();
        for _ in 0..120 {
            world.step_colliding(&mut collisions, &[]).unwrap();
            assert!(lowest(&world) > 0.0, "{ground:?}");
        }
        let record = step(&mut world, &mut collisions, 1);
        let weight = material.mass_per_length() * 2.0 * 9.80665;
        let carried = force(&record);
        assert!(
            (carried.z / weight - 1.0).abs() < 0.01,
            "{ground:?} {carried}"
        );
        assert!((lowest(&world) - 0.02).abs() < 1e-3, "{ground:?}");
    }
}

#[test]
fn bodies_that_nobody_looks_for_stop_no_wire() {
    let mut world = world();
    world.add_body(grounds()[0].clone()).unwrap();
    lay(&mut world, Material::steel(0.02), 0.5, Vector::zeros());
    step(&mut world, &mut Collisions::default().without_bodies(), 60);
    assert!(lowest(&world) < -1.0);
}

#[test]
fn contacts_of_a_chain_at_rest_are_one_at_each_node_and_keep_their_keys() {
    let mut world = world();
    world.add_body(grounds()[0].clone()).unwrap();
    lay(
        &mut world,
        Material::steel(0.02).chain(),
        0.02,
        Vector::zeros(),
    );
    let mut collisions = Collisions::default();
    let keys = |record: &StepRecord| -> Vec<u64> {
        record.contacts.iter().map(|c| c.contact.key).collect()
    };
    let first = keys(&step(&mut world, &mut collisions, 1));
    assert_eq!(first.len(), 9);
    assert_eq!(keys(&step(&mut world, &mut collisions, 30)), first);
}

/// The surface below its upper end is beside no place of such a segment.
#[test]
fn segment_shorter_than_it_is_thick_is_held_at_both_ends_however_it_is_tilted() {
    const LENGTH: f64 = 0.004;
    const RADIUS: f64 = 0.01;
    let flat = grounds().into_iter().take(4);
    for (ground, tilt) in flat.flat_map(|ground| [0.1, 0.5].map(|tilt| (ground.clone(), tilt))) {
        let mut world = world();
        world.add_body(ground.clone()).unwrap();
        let lower = Point::new(0.0, 0.0, RADIUS);
        let upper = lower + Vector::new(f64::cos(tilt), 0.0, f64::sin(tilt)) * LENGTH;
        let route = [lower, upper].map(Stop::Free).to_vec();
        let plan = WirePlan::new(Material::steel(RADIUS).chain(), 1.0, route);
        world.add_wire(&plan).unwrap();
        let mut collisions = Collisions::default();
        let arc = |contact: &ContactRecord| match contact.contact.a {
            ContactSite::Wire { arc, .. } => arc,
            _ => f64::NAN,
        };
        let record = step(&mut world, &mut collisions, 1);
        let mut arcs: Vec<f64> = record.contacts.iter().map(arc).collect();
        arcs.sort_by(f64::total_cmp);
        assert!(
            arcs.len() == 2 && arcs[0] == 0.0 && (arcs[1] / LENGTH - 1.0).abs() < 1e-6,
            "{ground:?} {tilt} {arcs:?}"
        );
        step(&mut world, &mut collisions, 10);
        assert!(
            lowest(&world) > RADIUS - 1e-4,
            "{ground:?} {tilt} {}",
            lowest(&world)
        );
    }
}

#[test]
fn bodies_rest_on_each_other_and_stick_up_to_the_coefficient_of_friction() {
    for (slope, sticks) in [(0.45, true), (0.55, false)] {
        let tilt = Vector::new(slope, 0.0, -1.0).normalize() * 9.80665;
        let mut world = World::new(Settings {
            gravity: tilt,
            ..Settings::default()
        })
        .unwrap();
        world
            .add_body(BodyPlan::fixed(Shape::Plane, Point::origin()))
            .unwrap();
        let (radius, half_height) = (0.25, 0.25);
        let half = Vector::new(0.5, 0.5, 0.25);
        let cylinder = Shape::Cylinder {
            radius,
            half_height,
        };
        for (y, shape) in [(0.0, Shape::Box { half }), (3.0, cylinder)] {
            let plan = BodyPlan::dynamic(shape, 1000.0, Point::new(0.0, y, 0.25));
            world.add_body(plan).unwrap();
        }
        let record = step(&mut world, &mut Collisions::default(), 60);
        let weight: f64 = world.bodies().iter().map(|body| body.mass()).sum();
        let normal = record
            .contacts
            .iter()
            .map(|c| c.normal_force())
            .sum::<f64>();
        assert!((normal / (-tilt.z * weight) - 1.0).abs() < 0.01, "{normal}");
        for body in &world.bodies()[1..] {
            let way = body.position().x;
            // SlideRate: g cos (tan - f) t^2 / 2.
            let expected = if sticks {
                0.0
            } else {
                9.80665 * 0.876 * 0.05 / 2.0
            };
            assert!((way - expected).abs() < 0.02, "{slope} {way} {expected}");
            assert!((body.position().z - 0.25).abs() < 1e-3);
        }
    }
}

#[test]
fn scripted_body_carries_a_wire_along() {
    let mut world = world();
    let half = Vector::new(2.0, 1.0, 0.5);
    let drive = Drive::Kinematic(vec![Phase {
        from: 0.0,
        velocity: Vector::new(0.0, 0.5, 0.0),
        angular_velocity: Vector::zeros(),
    }]);
    let plan = BodyPlan::fixed(Shape::Box { half }, Point::new(0.0, 0.0, -0.5));
    world.add_body(BodyPlan { drive, ..plan }).unwrap();
    lay(&mut world, Material::steel(0.02), 0.02, Vector::zeros());
    step(&mut world, &mut Collisions::default(), 60);
    // Slips until it is as fast, after 0.1 s and 0.026 m.
    let way = world.wires()[0].nodes()[4].position.y;
    assert!((way - (0.5 - 0.0255)).abs() < 0.01, "{way}");
}

#[test]
fn wire_from_inside_of_a_body_is_not_pushed_by_it() {
    let mut world = world();
    let half = Vector::repeat(0.6);
    let body = BodyPlan::fixed(Shape::Box { half }, Point::origin());
    let body = world.add_body(body).unwrap();
    let local = Vector::zeros();
    let route = vec![
        Stop::Eye { body, local },
        Stop::Free(Point::new(0.0, 0.0, -3.0)),
    ];
    world
        .add_wire(&WirePlan::new(Material::steel(0.02), 0.25, route))
        .unwrap();
    let record = step(&mut world, &mut Collisions::default(), 10);
    let pushing = record.contacts.iter().filter(|c| c.normal_force() > 0.0);
    assert_eq!(pushing.count(), 0);
}

#[test]
fn node_that_keeps_a_wire_around_a_corner_is_not_taken_out_and_one_beside_a_body_is() {
    let taken_out = |apart: f64| {
        let mut world = World::new(Settings {
            gravity: Vector::zeros(),
            ..Settings::default()
        })
        .unwrap();
        let half = Vector::repeat(0.5);
        let body = BodyPlan::fixed(Shape::Box { half }, Point::new(-apart, 0.0, -0.5 - apart));
        world.add_body(body).unwrap();
        let route = [[0.0, 0.0, 0.1], [0.6, 0.0, 0.1], [0.6, 0.0, -0.5]];
        let ends = [0, 2].map(|end| Stop::Pinned(route[end].into()));
        let route = vec![ends[0], Stop::Free(route[1].into()), ends[1]];
        let plan = WirePlan::new(Material::steel(0.02).chain(), 0.6, route).adaptive();
        let wire = world.add_wire(&plan).unwrap();
        // Now it should be one segment.
        world.wires[wire.0].resolution.length = 2.0;
        let record = step(&mut world, &mut Collisions::default(), 1);
        assert_eq!(
            record.collisions.refused_remeshes,
            1 - record.remeshes.len()
        );
        !record.remeshes.is_empty()
    };
    assert!(taken_out(1.0) && !taken_out(0.0));
}

#[test]
fn contact_names_wire_and_body_with_its_normal_to_the_wire() {
    let mut world = world();
    world.add_body(grounds()[1].clone()).unwrap();
    lay(&mut world, Material::steel(0.02), 0.02, Vector::zeros());
    let record = step(&mut world, &mut Collisions::default(), 1);
    for contact in &record.contacts {
        let ContactConstraint { a, b, normal, .. } = contact.contact;
        assert!(matches!(
            (a, b),
            (ContactSite::Wire { .. }, ContactSite::Body { .. })
        ));
        assert!((normal - Vector::z()).norm() < 1e-9);
    }
}

use super::*;
use crate::wire::{BodyPlan, Material, Settings, Shape, Stop, Vector, WirePlan};

/// A free chain of 8 segments of 1 m whose nodes all move differently.
fn chain() -> World {
    let settings = Settings {
        gravity: Vector::zeros(),
        ..Settings::default()
    };
    let mut world = World::new(settings).unwrap();
    let stop = |i: i32| Stop::Free(Point::new(f64::from(i), f64::from(i % 2) * 0.1, 0.0));
    let route = (0..=8).map(stop).collect();
    let plan = WirePlan::new(Material::steel(0.02).chain(), 0.9, route).adaptive();
    world.add_wire(&plan).unwrap();
    for (i, node) in world.wires[0].nodes.iter_mut().enumerate() {
        node.velocity = Vector::new(i as f64, -2.0, (i * i) as f64);
    }
    world
}

fn tense(world: &mut World, tension: f64) {
    for segment in &mut world.wires[0].segments {
        segment.tension_history[0] = tension;
    }
}

fn rest_lengths(world: &World) -> Vec<f64> {
    let wire = &world.wires[0];
    (0..wire.segments.len())
        .map(|i| wire.rest_length(i))
        .collect()
}

/// The tension under which segments of a length are just stable.
fn tension_for(world: &World, length: f64) -> f64 {
    let speed = length * world.settings.stability_margin / world.settings.step;
    world.wires[0].material.mass_per_length() * speed * speed
}

#[test]
fn tension_merges_short_segments_and_keeps_momentum() {
    let mut world = chain();
    assert!(adapt(&mut world, &mut Permit).is_empty());
    let before = world.momentum();
    let tension = tension_for(&world, 1.5);
    tense(&mut world, tension);
    let changes = adapt(&mut world, &mut Permit);
    assert_eq!(changes.len(), 4);
    assert!(
        changes
            .iter()
            .all(|change| change.kind == RemeshKind::Merge)
    );
    assert_eq!(changes[0].triangle.map(|p| p.x), [0.0, 1.0, 2.0]);
    assert!(rest_lengths(&world).iter().all(|&l| l > 2.0 && l < 2.02));
    assert!((world.momentum() - before).norm() < 1e-13 * before.norm());
}

#[test]
fn slackening_splits_long_segments_and_keeps_momentum() {
    let mut world = chain();
    let tension = tension_for(&world, 1.5);
    tense(&mut world, tension);
    adapt(&mut world, &mut Permit);
    tense(&mut world, 0.0);
    world.wires[0].resolution.length = 0.5;
    let before = world.momentum();
    // Not within ten steps of the change before.
    world.steps += TENSION_HISTORY as u64 - 1;
    assert!(adapt(&mut world, &mut Permit).is_empty());
    world.steps += 1;
    let changes = adapt(&mut world, &mut Permit);
    // The four segments touch: two can be split now, the others ten steps later.
    assert_eq!(changes.len(), 2);
    assert!(
        changes
            .iter()
            .all(|change| change.kind == RemeshKind::Split)
    );
    assert_eq!(rest_lengths(&world).len(), 6);
    assert!((world.momentum() - before).norm() < 1e-13 * before.norm());
}

#[test]
fn change_that_is_refused_is_not_made_and_asked_for_again() {
    let mut world = chain();
    let tension = tension_for(&world, 1.5);
    tense(&mut world, tension);
    let mut asked = Vec::new();
    let mut refuse = |_: &World, change: &Remesh| {
        asked.push(change.arcs[1]);
        false
    };
    assert!(adapt(&mut world, &mut refuse).is_empty());
    world.steps += 1;
    assert!(adapt(&mut world, &mut refuse).is_empty());
    assert_eq!(rest_lengths(&world).len(), 8);
    assert!(asked.len() == 14 && asked[0] == asked[7]);
}

#[test]
fn fixed_nodes_and_fixed_resolutions_stay() {
    let mut world = chain();
    for node in &mut world.wires[0].nodes {
        node.kind = NodeKind::Pinned;
    }
    let tension = tension_for(&world, 1.5);
    tense(&mut world, tension);
    assert!(adapt(&mut world, &mut Permit).is_empty());
    let mut world = chain();
    world.wires[0].resolution.adaptive = false;
    tense(&mut world, tension);
    assert!(adapt(&mut world, &mut Permit).is_empty());
}

/// A wire that has to bend before an arc length.
struct BendsBefore(f64);

impl RemeshGuard for BendsBefore {
    fn permits(&mut self, _: &World, _: &Remesh) -> bool {
        true
    }

    fn needs_fine_resolution(&self, _: WireId, from: f64, _: f64) -> bool {
        from < self.0
    }
}

#[test]
fn tension_leaves_short_segments_where_a_wire_has_to_bend() {
    let mut world = chain();
    let tension = tension_for(&world, 1.5);
    tense(&mut world, tension);
    adapt(&mut world, &mut BendsBefore(3.5));
    let lengths = rest_lengths(&world);
    let (short, long) = lengths.split_at(4);
    assert!(short.iter().all(|l| *l < 1.02), "{lengths:?}");
    assert!(long.iter().all(|l| *l > 2.0), "{lengths:?}");
    // Where it has to bend later, both long segments are divided under the same tension, one after
    // the other.
    world.wires[0].resolution.length = 0.75;
    for divided in [7, 8] {
        world.steps += TENSION_HISTORY as u64;
        adapt(&mut world, &mut BendsBefore(9.0));
        assert_eq!(rest_lengths(&world).len(), divided);
    }
}

#[test]
fn a_wire_that_does_not_adapt_keeps_its_resolution_as_it_slides() {
    // A chain over the top of a ball, to a load that draws it down.
    const LENGTH: f64 = 0.25;
    let mut world = World::new(Settings::default()).unwrap();
    let ball = BodyPlan::fixed(Shape::Sphere { radius: 1.0 }, Point::new(0.0, 0.0, -1.0));
    let top = Stop::Contact {
        body: world.add_body(ball).unwrap(),
        local: Vector::z(),
        normal: Vector::z(),
        friction: 0.1,
    };
    let load = BodyPlan::dynamic(
        Shape::Sphere { radius: 0.05 },
        2e5,
        Point::new(0.5, 0.0, -2.0),
    );
    let load = Stop::Eye {
        body: world.add_body(load).unwrap(),
        local: Vector::zeros(),
    };
    let route = vec![Stop::Free(Point::new(-3.1, 0.0, -0.5)), top, load];
    let plan = WirePlan::new(Material::steel(0.01).chain(), LENGTH, route);
    world.add_wire(&plan).unwrap();
    let mut slid = 0.0;
    while slid < 2.0 {
        let record = world.step(&[]).unwrap();
        slid += record
            .slides
            .iter()
            .map(|slide| slide.distance.abs())
            .sum::<f64>();
        let wire = &world.wires[0];
        let is_contact = |node: usize| matches!(wire.nodes[node].kind, NodeKind::Contact { .. });
        for segment in 0..wire.segments.len() {
            let length = wire.rest_length(segment) / LENGTH;
            let is_beside = is_contact(segment) || is_contact(segment + 1);
            let range = if is_beside { 0.25..3.0 } else { 0.9..1.6 };
            assert!(range.contains(&length), "{segment}: {length}");
        }
    }
    assert!(world.time() < 1.0, "{}", world.time());
}

/// A chain on a body that turns, and one from a point of the world; every node moves in its own way.
#[test]
fn what_carries_a_node_takes_up_the_momentum_of_its_neighbour() {
    const LOCAL: Vector = Vector::new(0.3, 0.1, -0.2);
    let mut world = World::new(Settings::default()).unwrap();
    let shape = Shape::Capsule {
        radius: 0.1,
        half_height: 0.4,
    };
    let body = world
        .add_body(BodyPlan::dynamic(shape, 800.0, Point::origin()))
        .unwrap();
    let end = Point::new(8.3, 0.1, -0.2);
    let eye = Stop::Eye { body, local: LOCAL };
    for first in [eye, Stop::Pinned(Point::origin())] {
        let plan = WirePlan::new(
            Material::steel(0.02).chain(),
            1.0,
            vec![first, Stop::Free(end)],
        );
        world.add_wire(&plan).unwrap();
    }
    let body = &mut world.bodies[body.0];
    body.velocity = Vector::new(1.0, -2.0, 3.0);
    body.angular_velocity = Vector::new(-3.0, 1.0, 2.0);
    let at_eye = body.velocity_at(&LOCAL);
    for wire in &mut world.wires {
        for (i, node) in wire.nodes.iter_mut().enumerate() {
            node.velocity = Vector::new(i as f64, 2.0 - i as f64, 1.0);
        }
    }
    world.wires[0].nodes[0].velocity = at_eye;
    world.wires[1].nodes[0].velocity = Vector::zeros();
    let momenta = |world: &World| [world.momentum(), world.angular_momentum()];
    let before = momenta(&world);
    take_out(&mut world, 0, 1, 10);
    take_out(&mut world, 1, 1, 10);
    // The point of the world, at the origin, takes its half away.
    let given = Vector::new(1.0, 1.0, 1.0) * world.wires[1].node_mass(0) / 2.0;
    let left = [before[0] - given, before[1]];
    for (after, left) in momenta(&world).into_iter().zip(left) {
        assert!((after - left).norm() < 1e-13 * left.norm(), "{after}");
    }
    let eye = &world.wires[0].nodes[0];
    let carried = world.bodies[0].velocity_at(&LOCAL);
    assert!((eye.velocity - carried).norm() < 1e-14 * carried.norm());
    assert!((carried - at_eye).norm() > 1e-3, "{carried}");
    assert_eq!(world.wires[1].nodes[0].velocity, Vector::zeros());
}

#[test]
fn wire_that_slides_over_a_node_keeps_its_speed_as_nodes_come_and_go() {
    // A straight chain that is drawn over a contact node of a fixed body at 3 m/s.
    const SPEED: f64 = 3.0;
    let mut world = World::new(Settings::default()).unwrap();
    let plane = BodyPlan::fixed(Shape::Plane, Point::origin());
    let contact = Stop::Contact {
        body: world.add_body(plane).unwrap(),
        local: Vector::zeros(),
        normal: Vector::z(),
        friction: 0.0,
    };
    let ends = [-2.0, 2.0].map(|x| Stop::Free(Point::new(x, 0.0, 0.0)));
    let plan = WirePlan::new(
        Material::steel(0.02).chain(),
        1.0,
        vec![ends[0], contact, ends[1]],
    );
    world.add_wire(&plan).unwrap();
    for (i, node) in world.wires[0].nodes.iter_mut().enumerate() {
        match i {
            2 => node.slide = -SPEED,
            _ => node.velocity = Vector::x() * SPEED,
        }
    }
    let energy = world.kinetic_energy();
    for segment in [2, 1] {
        let middle = halfway(&world.wires[0], segment, 0);
        assert_eq!(middle.velocity, Vector::x() * SPEED);
        put_in(&mut world.wires[0], segment, middle);
    }
    assert!((world.kinetic_energy() / energy - 1.0).abs() < 1e-14);
    for node in [2, 3] {
        take_out(&mut world, 0, node, 0);
    }
    let nodes = world.wires[0].nodes();
    assert_eq!(
        (nodes[2].velocity, nodes[2].slide),
        (Vector::zeros(), -SPEED)
    );
    // A node that is slower slows the sliding down, by the momentum it lacks.
    let (mass, added) = (
        world.wires[0].node_mass(2),
        world.wires[0].node_mass(3) / 2.0,
    );
    world.wires[0].nodes[3].velocity = Vector::x();
    take_out(&mut world, 0, 3, 0);
    let slide = (mass * -SPEED - added) / (mass + added);
    assert!((world.wires[0].nodes[2].slide - slide).abs() < 1e-14);
}

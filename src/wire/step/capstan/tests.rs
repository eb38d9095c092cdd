use super::*;
use crate::query::Point;
use crate::wire::step::contact_nodes::detach;
use crate::wire::step::islands::Island;
use crate::wire::step::linearisation::Linearisation;
use crate::wire::step::motion::{MotionScales, Velocities};
use crate::wire::step::order::by_wires;
use crate::wire::{BodyId, BodyPlan, Drive, Material, Phase, Settings, Shape, Stop, WirePlan};

const FRICTION: f64 = 0.3;

/// A fixed ball with its top in the origin, and a contact node there.
fn ball(world: &mut World, friction: f64) -> Stop {
    let plan = BodyPlan::fixed(Shape::Sphere { radius: 1.0 }, Point::new(0.0, 0.0, -1.0));
    Stop::Contact {
        body: world.add_body(plan).unwrap(),
        local: Vector::z(),
        normal: Vector::z(),
        friction,
    }
}

/// A chain without weight over a node, its ends `down` below it at both sides; one end is drawn at
/// a speed, and after 5 s back.
fn over_a_node(friction: f64, down: f64, speed: f64) -> World {
    let mut world = World::new(Settings {
        gravity: Vector::zeros(),
        ..Settings::default()
    })
    .unwrap();
    let node = ball(&mut world, friction);
    let end = Point::new(2.0, 0.0, -down);
    let along = end.coords.normalize() * speed;
    let puller = drawn(&mut world, end, &[(0.0, along), (5.0, -along)]);
    let route = vec![Stop::Pinned(Point::new(-2.0, 0.0, -down)), node, puller];
    let plan = WirePlan::new(Material::steel(0.02).chain(), 10.0, route);
    world.add_wire(&plan).unwrap();
    world
}

/// An eye on a body that is drawn at velocities, each from a time on.
fn drawn(world: &mut World, at: Point, velocities: &[(f64, Vector)]) -> Stop {
    let phases = velocities.iter().map(|&(from, velocity)| Phase {
        from,
        velocity,
        angular_velocity: Vector::zeros(),
    });
    let plan = BodyPlan {
        drive: Drive::Kinematic(phases.collect()),
        ..BodyPlan::fixed(Shape::Sphere { radius: 0.1 }, at)
    };
    eye(world.add_body(plan).unwrap())
}

fn eye(body: BodyId) -> Stop {
    let local = Vector::zeros();
    Stop::Eye { body, local }
}

#[test]
fn bound_of_a_node_is_the_capstans_ratio_of_its_turn() {
    for degrees in [1.0_f64, 15.0, 90.0, 170.0] {
        let angle = degrees.to_radians();
        let (sin, cos) = (libm::sin(angle / 2.0), libm::cos(angle / 2.0));
        let world = over_a_node(FRICTION, 2.0 * sin / cos, 0.0);
        let wire = &world.wires[0];
        let share = capstan_factor(wire, contact_nodes(wire)[0]);
        let bound = (1.0 + share) / (1.0 - share);
        let deviation = (bound / libm::exp(FRICTION * angle) - 1.0).abs();
        assert!(deviation < 1e-13, "{degrees}: {deviation:e}");
    }
}

#[test]
fn weight_that_presses_has_the_friction_of_an_even_load_along_the_turn() {
    const TENSION: f64 = 7.0;
    const PRESSES: f64 = 3.0;
    const STEPS: u32 = 20_000;
    for degrees in [0.0_f64, 1e-7, 1.0, 40.0, 150.0] {
        let angle = degrees.to_radians();
        let down = 2.0 * libm::tan(angle / 2.0);
        let world = over_a_node(FRICTION, down, 0.0);
        let wire = &world.wires[0];
        let [factor, share] = [capstan_factor(wire, 1), pressing_share(wire, 1)];
        // Where the tension is `(1 + factor) / (1 - factor)` of it, and the pressing force beside.
        let bound = (TENSION * (1.0 + factor) + share * PRESSES) / (1.0 - factor);
        // dT/dx = f (T + P/D), by the midpoint rule.
        let part = 1.0 / f64::from(STEPS);
        let slope = |tension: f64| FRICTION * (tension * angle + PRESSES);
        let tension = (0..STEPS).fold(TENSION, |tension, _| {
            tension + part * slope(tension + part / 2.0 * slope(tension))
        });
        assert!(
            (bound / tension - 1.0).abs() < 1e-8,
            "{degrees}: {bound} {tension}"
        );
    }
}

#[test]
fn mass_of_a_contact_node_falls_as_its_potential_energy_does() {
    let mut world = over_a_node(FRICTION, 1.0, 0.0);
    // Free ends at different heights.
    for end in [0, 2] {
        world.wires[0].nodes[end].kind = NodeKind::Free;
    }
    world.wires[0].nodes[0].position.z -= 0.5;
    world.settings.gravity = Vector::new(0.3, 0.2, -9.0);
    // Not stretched, so that the middle of each segment is where its mass is.
    let spans = [0, 1].map(|segment| world.wires[0].span(segment).norm());
    let slid = |by: f64| {
        let mut world = world.clone();
        let arcs = [0.0, spans[0] + by, spans[0] + spans[1]];
        for (node, arc) in world.wires[0].nodes.iter_mut().zip(arcs) {
            node.arc = arc;
        }
        world
    };
    let expected = fall(&slid(0.0).wires[0], 1).dot(&world.settings.gravity);
    let energies = [1e-3, -1e-3].map(|by| slid(by).potential_energy());
    // It falls by what gravity does along the way.
    let measured = (energies[1] - energies[0]) / 2e-3;
    assert!(
        (measured / expected - 1.0).abs() < 1e-9,
        "{measured} {expected}"
    );
}

/// What friction takes from the pull of the segment before a contact node, from the balance of its
/// mass, and its bound, both in N. `before` is the wire before the step.
fn friction_bound_of(wire: &Wire, before: &Wire, node: usize, step: f64) -> [f64; 2] {
    let [first, second] = [node - 1, node].map(|i| wire.segments[i].tension);
    let gained = before.node_mass(node) * (wire.nodes[node].slide - before.nodes[node].slide);
    let bound = capstan_factor(before, node) * (first + second);
    [first - second - gained / step, bound]
}

/// Checks Coulomb's law at a node after a step: within the bound where it sticks, all of it against
/// the sliding elsewhere.
fn check_law(wire: &Wire, before: &Wire, node: usize, step: f64) {
    let [friction, bound] = friction_bound_of(wire, before, node, step);
    let rounding = 1e-8 * bound + 1e-9;
    let slide = wire.nodes[node].slide;
    if slide == 0.0 {
        assert!(friction.abs() <= bound + rounding, "{friction} {bound}");
    } else {
        let against = friction * slide.signum();
        assert!((against - bound).abs() <= rounding, "{friction} {bound}");
    }
}

#[test]
fn wire_sticks_within_its_friction_and_slides_against_all_of_it() {
    let mut world = over_a_node(FRICTION, 1.0, 1e-4);
    let mut seen = [0; 3];
    for _ in 0..600 {
        let before = world.wires[0].clone();
        let record = world.step(&[]).unwrap();
        let wire = &world.wires[0];
        check_law(wire, &before, 1, world.settings.step);
        let distance = match record.slides.as_slice() {
            [] => 0.0,
            [slide] => slide.distance,
            _ => panic!("{:?}", record.slides),
        };
        let arcs = [0.0, distance, 0.0];
        for ((node, before), slid) in wire.nodes.iter().zip(&before.nodes).zip(arcs) {
            assert_eq!(node.arc, before.arc + slid);
        }
        let kind = [distance < 0.0, distance == 0.0, distance > 0.0];
        seen[kind.iter().position(|is| *is).unwrap()] += 1;
    }
    println!("{seen:?}");
    assert!(seen.iter().all(|&count| count > 50), "{seen:?}");
}

#[test]
fn wire_that_may_not_slide_sticks_and_one_step_takes_at_most_half_of_a_segment() {
    let mut sticky = over_a_node(1e6, 1.0, 1e-4);
    for _ in 0..10 {
        assert!(sticky.step(&[]).unwrap().slides.is_empty());
    }
    let mut slow = over_a_node(0.0, 1.0, 1e-2);
    assert!(!slow.step(&[]).unwrap().slides[0].held);
    let mut fast = over_a_node(0.0, 1.0, 300.0);
    let before = fast.wires[0].rest_length(0);
    let slides = fast.step(&[]).unwrap().slides;
    // What is beyond gives way by as little as what sticks.
    assert!(
        (slides[0].distance + before / 2.0).abs() < 1e-5 * before,
        "{slides:?} {before}"
    );
    assert!(slides[0].held);
}

#[test]
fn free_end_is_drawn_over_a_node_until_little_is_left_and_then_goes_on_without_it() {
    let mut world = over_a_node(FRICTION, 1.0, 1.0);
    // The end at the other side lets go.
    world.wires[0].nodes[0].kind = NodeKind::Free;
    let is_held = |world: &World| world.wires[0].nodes[1].kind != NodeKind::Free;
    while is_held(&world) {
        assert!(world.time() < 5.0);
        world.step(&[]).unwrap();
    }
    let left = world.wires[0].rest_length(0) / world.wires[0].resolution.length;
    assert!(left < 2.0 * LEAST && left > LEAST, "{left}");
}

#[test]
fn contact_node_leaves_where_the_wire_turns_away_from_the_body_and_goes_on_with_its_wire() {
    let mut world = over_a_node(FRICTION, -1.0, 0.0);
    let slides = world.step(&[]).unwrap().slides;
    assert!(slides.len() == 1 && slides[0].left);
    assert_eq!(world.wires[0].nodes[1].kind, NodeKind::Free);
    let mut stays = over_a_node(FRICTION, 1.0, 0.0);
    assert!(stays.step(&[]).unwrap().slides.is_empty());
    let wire = &mut world.wires[0];
    wire.nodes[1].slide = -2.0;
    let [before, after] = directions(wire, 1);
    detach(wire, 1);
    assert_eq!(
        (wire.nodes[1].slide, wire.nodes[1].velocity),
        (0.0, before + after)
    );
}

#[test]
fn segments_keep_a_sixteenth_of_their_wire_however_fast_it_slides() {
    let world = over_a_node(FRICTION, 1.0, 0.0);
    let rest = world.wires[0].rest_length(0);
    let farthest = rest * 15.0 / 16.0 / world.settings.step;
    let layout = Layout::new(
        &world,
        &Linearisation::at_start(&world),
        &by_wires(&world),
        &[],
    );
    let mut velocities = Velocities::prescribed(&world);
    let island = Island::whole(&world, &[]);
    velocities.take(&world, &island, &layout, &vec![0.0; layout.size]);
    for (speed, expected) in [
        (0.5 * farthest, 0.5 * farthest),
        (-0.5 * farthest, -0.5 * farthest),
        (3.0 * farthest, farthest),
        (-1e9, -farthest),
    ] {
        let mut motion = world.motion(&velocities, &MotionScales::all(&world));
        motion.slides[0].speed = speed;
        shorten(&world, &mut motion);
        let slid = motion.slides[0].speed;
        assert!((slid / expected - 1.0).abs() < 1e-12, "{speed} {slid}");
    }
}

use nalgebra::{DMatrix, DVector};

use super::super::added_inertia::{AddedInertias, added_inertias};
use super::*;
use crate::query::Point;
use crate::wire::{BodyPlan, Material, Settings, Shape, Stop, WirePlan};

/// A wire of 8 segments of 0.25 m with a bend between them, under a tension.
fn taut(tension: f64, start: Stop, end: Stop) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let shape = Shape::Box {
        half: Vector::new(0.1, 0.2, 0.3),
    };
    for x in [0.0, 2.0] {
        let plan = BodyPlan::dynamic(shape.clone(), 800.0, Point::new(x, 0.0, 0.0));
        world.add_body(plan).unwrap();
    }
    let between = (1..8).map(|i| {
        let x = f64::from(i) / 4.0;
        Stop::Free(Point::new(x, 0.1 * (x * 7.0).sin(), 0.05 * x * x))
    });
    let route = std::iter::once(start).chain(between).chain([end]).collect();
    let plan = WirePlan::new(Material::steel(0.002).chain(), 5.0, route);
    world.add_wire(&plan).unwrap();
    for segment in &mut world.wires[0].segments {
        segment.tension_history[0] = tension;
    }
    world
}

fn eye(body: usize) -> Stop {
    Stop::Eye {
        body: BodyId(body),
        local: Vector::new(0.05, -0.2, 0.1),
    }
}

fn pin(x: f64) -> Stop {
    Stop::Pinned(Point::new(x, 0.0, 0.0))
}

/// Random velocities of everything that can move.
fn shake(world: &mut World, next: &mut impl FnMut() -> f64) {
    let mut draw = || Vector::new(next(), next(), next());
    for body in &mut world.bodies {
        (body.velocity, body.angular_velocity) = (draw(), draw());
    }
    for node in 0..world.wires[0].nodes.len() {
        let kind = world.wires[0].nodes[node].kind;
        world.wires[0].nodes[node].velocity = match (kind, kind.carrier()) {
            (NodeKind::Free, _) => draw(),
            (_, Some((body, local))) => world.bodies[body.0].velocity_at(&local),
            _ => Vector::zeros(),
        };
    }
}

/// `K_s`, and `K_s v`.
fn steep_pushes(world: &World, inertias: &AddedInertias) -> (DMatrix<f64>, DVector<f64>) {
    let nodes = &world.wires[0].nodes;
    let mut stiffness = DMatrix::zeros(3 * nodes.len(), 3 * nodes.len());
    for steep in &inertias.steep {
        let first = 3 * steep.segment;
        for (p, q, sign) in [(0, 0, 1.0), (3, 3, 1.0), (0, 3, -1.0), (3, 0, -1.0)] {
            let mut block = stiffness.fixed_view_mut::<3, 3>(first + p, first + q);
            block += steep.stiffness * sign;
        }
    }
    let velocities = nodes.iter().flat_map(|node| node.velocity.iter().copied());
    let pushed = &stiffness * DVector::from_iterator(3 * nodes.len(), velocities);
    (stiffness, pushed)
}

/// `v . W v` of steep segments, from dense matrices.
fn steep_form(world: &World, inertias: &AddedInertias) -> f64 {
    if inertias.nodes.is_empty() {
        return 0.0;
    }
    let (stiffness, pushed) = steep_pushes(world, inertias);
    // Nodes that cannot move have no unknown.
    let moving = inertias
        .nodes
        .iter()
        .flat_map(|at| (0..3).map(|axis| 3 * at.node + axis));
    let moving: Vec<usize> = moving.collect();
    let mut whole = stiffness.select_rows(&moving).select_columns(&moving);
    for (at, node) in inertias.nodes.iter().enumerate() {
        for axis in 0..3 {
            whole[(3 * at + axis, 3 * at + axis)] += node.followed;
        }
    }
    let pushed = pushed.select_rows(&moving);
    let solved = whole.lu().solve(&pushed).expect("a positive matrix");
    pushed.dot(&solved)
}

fn inertias_of(world: &World) -> AddedInertias {
    added_inertias(world, &Linearisation::at_start(world))
}

/// `4 v M v`, what is added to it for a step to be stable, and `h^2 v K v` of tensions `factor` times
/// as large.
fn forms(world: &World, factor: f64) -> [f64; 3] {
    let inertias = inertias_of(world);
    let short = inertias
        .terms
        .iter()
        .map(|inertia| inertia.energy(|at| &world.wires[at], |at| &world.bodies[at]));
    let added = 2.0 * (short.sum::<f64>() + steep_form(world, &inertias));
    let wire = &world.wires[0];
    let step = world.settings.step;
    let stiffness = (0..wire.segments.len()).map(|segment| {
        let (t, length) = unit(&wire.span(segment));
        let velocity = wire.nodes[segment + 1].velocity - wire.nodes[segment].velocity;
        let across = velocity - t * t.dot(&velocity);
        let tension = factor * wire.segments[segment].largest_tension();
        step * step * tension / length * across.norm_squared()
    });
    [8.0 * world.kinetic_energy(), added, stiffness.sum()]
}

/// Numbers from -1 to 1 that differ from run to run of the generator alone.
fn numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

#[test]
fn every_step_is_stable_up_to_the_margin() {
    let mut next = numbers(1);
    for tension in [10.0, 1e3, 1e5, 1e7, 1e9] {
        for [start, end] in [
            [pin(0.0), pin(2.0)],
            [pin(0.0), eye(1)],
            [eye(0), eye(1)],
            [eye(1), eye(1)],
        ] {
            let mut world = taut(tension, start, end);
            let factor = 1.0 / world.settings.stability_margin.powi(2);
            for _ in 0..1000 {
                shake(&mut world, &mut next);
                let [kinetic, added, stiffness] = forms(&world, factor);
                let most = stiffness / (kinetic + added);
                assert!(most <= 1.0 + 1e-12, "{tension} {most}");
            }
        }
    }
    // Without inertia it is not.
    let mut world = taut(1e8, pin(0.0), pin(2.0));
    shake(&mut world, &mut next);
    let [kinetic, _, stiffness] = forms(&world, 1.0);
    assert!(stiffness > 10.0 * kinetic);
}

#[test]
fn inertia_is_no_larger_than_stability_asks_for() {
    // The third mode of a string of 8 segments, over tensions: at one of them it is at the bound.
    let mut nearest: f64 = 0.0;
    for tension in (0..400).map(|i| 10.0 * 1.02f64.powi(i)) {
        let mut world = World::new(Settings::default()).unwrap();
        let point = |i: usize| Point::new(i as f64 / 4.0, 0.0, 0.0);
        let mut route: Vec<Stop> = (0..=8).map(|i| Stop::Free(point(i))).collect();
        (route[0], route[8]) = (Stop::Pinned(point(0)), Stop::Pinned(point(8)));
        let plan = WirePlan::new(Material::steel(0.002).chain(), 5.0, route);
        world.add_wire(&plan).unwrap();
        for segment in &mut world.wires[0].segments {
            segment.tension_history[0] = tension;
        }
        for (i, node) in world.wires[0].nodes.iter_mut().enumerate().take(8).skip(1) {
            node.velocity = Vector::y() * (3.0 * i as f64 * std::f64::consts::PI / 8.0).sin();
        }
        let factor = 1.0 / world.settings.stability_margin.powi(2);
        let [kinetic, added, stiffness] = forms(&world, factor);
        if added > 0.0 {
            let part = stiffness / (kinetic + added);
            assert!(part <= 1.0 + 1e-12);
            nearest = nearest.max(part);
        }
    }
    assert!(nearest > 0.999, "{nearest}");
}

/// A free wire that moves and turns as one line, under a tension.
fn line(tension: f64) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let route = (0..=8).map(|i| Point::new(f64::from(i) / 4.0, 0.0, 0.0));
    let plan = WirePlan::new(Material::steel(0.002), 5.0, route.map(Stop::Free).collect());
    world.add_wire(&plan).unwrap();
    for segment in &mut world.wires[0].segments {
        segment.tension_history[3] = tension;
    }
    for node in &mut world.wires[0].nodes {
        node.velocity = Vector::new(7.0, 2.0 - node.position.x, 3.0 * node.position.x);
    }
    world
}

#[test]
fn what_moves_as_one_line_has_none_of_it() {
    let world = line(3e3);
    let inertias = inertias_of(&world);
    assert_eq!([inertias.terms.len(), inertias.steep.len()], [9, 0]);
    for inertia in &inertias.terms[1..8] {
        let largest = inertia.nodes.iter().map(|(_, _, part)| part.amax());
        let largest = largest.fold(0.0, f64::max);
        assert!(
            inertia
                .velocity(|at| &world.wires[at], |at| &world.bodies[at])
                .norm()
                < 1e-12 * largest
        );
    }
    // `W v` of steep segments is 0 where `K_s v` is.
    let world = line(3e6);
    let inertias = inertias_of(&world);
    assert_eq!([inertias.terms.len(), inertias.steep.len()], [0, 8]);
    let (stiffness, pushed) = steep_pushes(&world, &inertias);
    let inner = pushed.rows(3, 3 * 7);
    assert!(inner.amax() < 1e-12 * stiffness.amax());
    assert!(pushed.amax() > stiffness.amax() / 10.0);
}

#[test]
fn segments_that_are_long_enough_have_none() {
    // Waves travel 0.24 m in a step over the margin at 11.9 N.
    let world = |tension| taut(tension, pin(0.0), pin(2.0));
    let material = Material::steel(0.002);
    let longest = (0..8).map(|segment| world(1.0).wires[0].rest_length(segment));
    let longest = longest.fold(0.0, f64::max);
    let speed = longest * 0.8 * 60.0;
    let most = speed * speed * material.mass_per_length();
    let counts = |tension| {
        let inertias = inertias_of(&world(tension));
        [
            inertias.terms.len(),
            inertias.steep.len(),
            inertias.nodes.len(),
        ]
    };
    assert_eq!(counts(0.5 * most), [0, 0, 0]);
    assert_eq!(counts(1.01 * most), [7, 0, 0]);
    assert_eq!(counts(0.0), [0, 0, 0]);
    assert_eq!(counts(1e9 * most), [0, 8, 7]);
}

#[test]
fn a_place_of_a_body_has_at_most_the_mass_that_motion_feels_there() {
    let world = taut(1.0, pin(0.0), eye(1));
    let mut body = world.bodies[1].clone();
    let local = Vector::new(0.1, -0.3, 0.2);
    let mass = mass_at(&body, &local);
    let mut next = numbers(3);
    for _ in 0..1000 {
        let mut draw = || Vector::new(next(), next(), next());
        (body.velocity, body.angular_velocity) = (draw(), draw());
        let spin = body.angular_velocity;
        let twice =
            body.mass * body.velocity.norm_squared() + spin.dot(&(body.world_inertia() * spin));
        assert!(mass * body.velocity_at(&local).norm_squared() <= twice);
    }
    assert!(mass > 0.05 * body.mass);
}

//! What wires push with when they are pressed together, and what that stores.

use super::*;
use crate::query::Point;
use crate::wire::model::{Material, Stop, WirePlan};
use crate::wire::{Settings, World};

/// A straight wire of 2 m in pieces of 0.25 m between pinned points, without weight, at 1/30 s.
fn straight(material: Material) -> World {
    let settings = Settings {
        step: 1.0 / 30.0,
        gravity: Vector::zeros(),
        ..Settings::default()
    };
    let mut world = World::new(settings).unwrap();
    let ends = [0.0, 2.0].map(|x| Stop::Pinned(Point::new(x, 0.0, 0.0)));
    world
        .add_wire(&WirePlan::new(material, 0.25, ends.to_vec()))
        .unwrap();
    world
}

/// Presses it together by a part of its length.
fn press(world: &mut World, part: f64) {
    for node in &mut world.wires[0].nodes {
        node.position.x *= 1.0 - part;
    }
}

#[test]
fn wire_pushes_with_what_buckles_it_and_a_chain_not_at_all() {
    let near = |is: f64, due: f64| assert!((is - due).abs() < 1e-9 * due, "{is} {due}");
    let rod = Material::steel(0.006);
    let wire = &straight(rod).wires[0];
    let (bend, mass) = (rod.bend_stiffness(), rod.mass_per_length());
    let pi2 = std::f64::consts::PI.powi(2);
    // By the step, by the resolution, and by the whole length.
    near(wire.largest_push(1.0 / 60.0), 240.0 * (bend * mass).sqrt());
    near(wire.largest_push(1e-6), pi2 * bend / 0.0625);
    near(wire.largest_push(1e6), pi2 * bend);
    assert_eq!(straight(rod.chain()).wires[0].largest_push(1e-3), 0.0);
}

#[test]
fn pressed_wire_stores_the_work_of_its_push() {
    let step = 1.0 / 30.0;
    for material in [Material::steel(0.006), Material::steel(0.006).chain()] {
        let energy = |part: f64| {
            let mut world = straight(material);
            press(&mut world, part);
            world.energy().elastic
        };
        let push = straight(material).wires[0].largest_push(step);
        let strain = push / material.stretch_stiffness();
        for part in [0.5 * strain + 1e-9, 2.0 * strain + 1e-9, 0.01, 0.2] {
            let by = 0.1 * part;
            let force = (energy(part + by) - energy(part - by)) / (4.0 * by);
            let due = push.min(material.stretch_stiffness() * part);
            assert!(
                (force - due).abs() <= 1e-6 * due,
                "{part}: {force} N, {due} N"
            );
        }
    }
}

/// Under damping, too, and what the forces store is what the wire has as it lies.
#[test]
fn pressed_wire_gives_way_at_its_largest_push() {
    for damping in [0.0, 2.0 / 60.0] {
        let material = Material {
            stretch_damping: damping,
            ..Material::steel(0.006)
        };
        let mut world = straight(material);
        press(&mut world, 0.05);
        let lies = world.energy().elastic;
        let push = world.wires[0].largest_push(world.settings.step);
        let record = world.step(&[]).unwrap();
        for segment in &world.wires[0].segments {
            let off = (segment.tension + push).abs();
            assert!(off < 1e-9 * push, "{} N, {push} N", segment.tension);
        }
        let elastic = record.energy.elastic;
        assert!((elastic - lies).abs() < 1e-6 * lies, "{elastic} {lies}");
        let of_forces = world.energy_of_forces();
        assert!((of_forces - lies).abs() < 1e-6 * lies, "{of_forces} {lies}");
    }
}

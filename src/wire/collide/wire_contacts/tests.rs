//! Wires that lie along each other, or beside themselves.

use super::*;
use crate::query::Point;
use crate::wire::{Collisions, Material, Settings, StepRecord, Stop, WireId, WirePlan};

const RADIUS: f64 = 0.01;

/// Half of the distance of the two wires below, in m.
const HALF: f64 = 0.012;

/// Two fixed wires side by side, with a node at each of these places along x, and a bar of one segment that lies on
/// both, between them.
fn bar_in_a_groove(fixed: &[f64], bar: [f64; 2], speed: f64) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let material = Material::steel(RADIUS);
    for side in [-HALF, HALF] {
        let stop = |&x: &f64| Stop::Pinned(Point::new(x, side, 0.0));
        let plan = WirePlan::new(material, 10.0, fixed.iter().map(stop).collect());
        world.add_wire(&plan).unwrap();
    }
    let stop = |x: f64| Stop::Free(Point::new(x, 0.0, height() + 1e-4));
    let mut plan = WirePlan::new(material, 10.0, bar.map(stop).to_vec());
    plan.velocity = Vector::x() * speed;
    world.add_wire(&plan).unwrap();
    world
}

/// Of the bar's midline over those below, where they touch.
fn height() -> f64 {
    libm::sqrt(4.0 * RADIUS * RADIUS - HALF * HALF)
}

/// How far the ends of the bar have sunk in, in m.
fn sunk(world: &World) -> [f64; 2] {
    let nodes = world.wires()[2].nodes();
    [0, 1].map(|end| height() - nodes[end].position.z)
}

fn run(world: &mut World, friction: f64, steps: usize, mut look: impl FnMut(&World, &StepRecord)) {
    let mut collisions = Collisions::default().with_friction(friction).unwrap();
    for _ in 0..steps {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        look(world, &record);
    }
}

#[test]
fn bar_along_two_wires_rests_on_both_of_its_ends() {
    let mut world = bar_in_a_groove(&[0.0, 1.0], [0.1, 0.7], 0.0);
    let mut last = None;
    run(&mut world, 0.5, 300, |_, record| {
        last = Some(record.clone())
    });
    let [a, b] = sunk(&world);
    assert!(a.abs() < 1e-6 && b.abs() < 1e-6, "{a} {b}");
    let speeds = world.wires()[2].nodes().iter();
    assert!(speeds.map(|node| node.velocity.norm()).fold(0.0, f64::max) < 1e-9);
    let contacts = last.unwrap().contacts;
    let up: f64 = contacts.iter().map(|contact| contact.force.z).sum();
    let weight = 0.6 * Material::steel(RADIUS).mass_per_length() * 9.80665;
    assert!((up.abs() / weight - 1.0).abs() < 1e-9, "{up} {weight}");
}

#[test]
fn bar_slides_over_the_nodes_of_the_wires_it_lies_along() {
    let fixed: Vec<f64> = (0..=12).map(|k| 0.25 * f64::from(k)).collect();
    let mut world = bar_in_a_groove(&fixed, [0.1, 0.7], 0.6);
    let mut steps = 0;
    run(&mut world, 0.0, 300, |world, _| {
        steps += 1;
        let nodes = world.wires()[2].nodes();
        // It falls onto them first, and tips over beyond their ends.
        if steps > 30 && nodes[1].position.x < 2.9 {
            let [a, b] = sunk(world);
            assert!(a.abs() < 1e-6 && b.abs() < 1e-6, "{a} {b}");
            let slowed = nodes[0].velocity.x - 0.6;
            assert!(slowed.abs() < 1e-6, "{slowed}");
        }
    });
    assert!(world.wires()[2].nodes()[1].position.z < 0.0);
}

/// A wire of 10 mm with nodes at these places.
fn of_stops(count: u32, at: impl Fn(u32) -> Point) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let route = (0..count).map(|k| Stop::Free(at(k))).collect();
    world
        .add_wire(&WirePlan::new(Material::steel(0.005), 1.0, route))
        .unwrap();
    world
}

#[test]
fn contact_of_a_wire_with_itself_ends_where_its_places_come_close_along_it() {
    // A hairpin 9 mm wide of a wire of 10 mm, and the same wire straight.
    let hairpin = of_stops(122, |k| match k < 61 {
        true => Point::new(0.0, 0.0, 0.005 * f64::from(k)),
        false => Point::new(0.009, 0.0, 0.005 * f64::from(121 - k)),
    });
    let straight = of_stops(122, |k| Point::new(0.0, 0.0, 0.005 * f64::from(k)));
    let wire = WireId(0);
    let length = hairpin.wires()[0].length();
    let mut contacts = WireContacts::default();
    let sites = [0.1, length - 0.1].map(|arc| WireSite { wire, arc });
    let touch = contacts.make(sites, Vector::x());
    contacts.add(&hairpin, Thickness::default(), [touch]);
    contacts.refresh(&hairpin, Thickness::default());
    let [touch] = &contacts.list[..] else {
        panic!("one contact");
    };
    assert!((touch.gap + 1e-3).abs() < 1e-12, "{}", touch.gap);
    let near = [0.3, 0.315].map(|arc| WireSite { wire, arc });
    for wrong in [false, true] {
        let mut contacts = WireContacts::default();
        let touch = WireContact {
            wrong,
            ..contacts.make(near, Vector::x())
        };
        contacts.list.push(touch);
        contacts.refresh(&straight, Thickness::default());
        // What has passed through comes back.
        assert_eq!(contacts.list.len(), usize::from(wrong));
    }
}

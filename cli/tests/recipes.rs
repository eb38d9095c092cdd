//! The scenes of docs/recipes.md: each runs at two steps without a finding of the audit, and comes to what
//! the page says.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use tunnelproof::certified::Certified;
use tunnelproof::wire::{Mode, Node, NodeKind, StepRecord, World};
use tunnelproof_cli::audit::Audit;
use tunnelproof_cli::scenes::Scene;

const PAGE: &str = include_str!("../../docs/recipes.md");

const G: f64 = 9.80665;

/// The scene file of the page that has a title.
fn recipe(title: &str) -> &'static str {
    let mut files = PAGE.split("```toml\n").skip(1);
    let file = files.find(|file| file.starts_with(&format!("title = \"{title}\"\n")));
    file.unwrap().split("```").next().unwrap()
}

/// Runs a scene at a number of steps for each second, and looks at each step.
fn run(text: &str, rate: f64, mut look: impl FnMut(&World, &StepRecord)) -> World {
    let mut scene = Scene::from_toml(text).unwrap();
    scene.settings.step = 1.0 / rate;
    let mut world = scene.world().unwrap();
    let mut collisions = scene.collisions(Mode::Guard, &Certified).unwrap();
    let mut audit = Audit::of_world(&world);
    for _ in 0..scene.steps() {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        audit.step(&record);
        look(&world, &record);
    }
    let report = audit.finish();
    assert!(report.is_clean(), "{}: {report:?}", scene.title);
    world
}

fn near(value: f64, expected: f64, part: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(error <= part, "{value} in place of {expected}");
}

const RATES: [f64; 2] = [60.0, 240.0];

#[test]
fn page_has_no_scene_that_is_not_run() {
    let titles = ["Sheave", "Bridle", "Drum", "Mooring line", "Swinging load"];
    assert_eq!(PAGE.matches("```toml\n").count(), titles.len());
    for title in titles {
        assert!(Scene::from_toml(recipe(title)).is_ok(), "{title}");
    }
}

/// The tensions before and after all contact nodes of the only wire.
fn beside_contacts(world: &World) -> [f64; 2] {
    let wire = &world.wires()[0];
    let over = |node: &Node| matches!(node.kind, NodeKind::Contact { .. });
    let first = wire.nodes().iter().position(over).unwrap();
    let last = wire.nodes().iter().rposition(over).unwrap();
    [first - 1, last].map(|segment| wire.segments()[segment].tension)
}

#[test]
fn sheave_carries_the_weight_in_both_legs_and_a_bollard_more_in_one() {
    for rate in RATES {
        let world = run(recipe("Sheave"), rate, |_, _| {});
        let hangs = 10.0 - world.bodies()[1].position().z - 0.2;
        near(hangs, 4.08, 0.005);
        let weight = (100.0 + 0.3 * hangs) * G;
        for tension in beside_contacts(&world) {
            near(tension, weight, 0.01);
        }
        let bollard = recipe("Sheave").replace("friction = 0 }", "friction = 0.2 }");
        let [load, haul] = beside_contacts(&run(&bollard, rate, |_, _| {}));
        near(haul / load, (0.2 * std::f64::consts::PI).exp(), 0.01);
    }
}

#[test]
fn legs_of_a_bridle_share_the_weight_by_their_angle() {
    for rate in RATES {
        let world = run(recipe("Bridle"), rate, |_, _| {});
        let [ring, beam] = [0, 1].map(|body| world.bodies()[body].mass());
        let [hoist, left, right] = [0, 1, 2].map(|wire| world.wires()[wire].segments());
        let leg = beam * G / (2.0 * 45_f64.to_radians().cos());
        for segments in [left, right] {
            near(segments.last().unwrap().tension, leg, 0.002);
        }
        near(hoist.last().unwrap().tension, (ring + beam) * G, 0.003);
    }
}

#[test]
fn drum_lifts_by_its_radius_times_the_angle_with_a_torque_of_tension_times_radius() {
    for rate in RATES {
        let (mut start, mut work) = (None, 0.0);
        let world = run(recipe("Drum"), rate, |world, record| {
            start.get_or_insert(world.bodies()[1].position().z);
            if record.time > 3.0 + 0.5 / rate && record.time < 4.0 + 0.5 / rate {
                work += record.work;
            }
        });
        near(world.bodies()[1].position().z - start.unwrap(), 2.5, 0.005);
        // In this second the drum turns by 1 rad.
        near(work, (100.0 + 0.3 * 6.4) * G * 0.5, 0.005);
    }
}

#[test]
fn mooring_line_is_a_catenary_that_touches_down() {
    let weight = 20.0 * G;
    for rate in RATES {
        let world = run(recipe("Mooring line"), rate, |_, _| {});
        let wire = &world.wires()[0];
        for (segment, ends) in wire.segments().iter().zip(wire.nodes().windows(2)) {
            let height = (ends[0].position.z + ends[1].position.z) / 2.0 - 0.03;
            near(segment.tension, weight * (20.0 + height), 0.01);
        }
    }
}

#[test]
fn load_swings_with_the_period_and_the_tension_of_a_pendulum() {
    let angle = 30_f64.to_radians();
    for rate in RATES {
        let (mut most, mut turns, mut last) = (0.0_f64, Vec::new(), 0.0);
        let world = run(recipe("Swinging load"), rate, |world, record| {
            most = record.wires[0]
                .tensions
                .iter()
                .copied()
                .fold(most, f64::max);
            let x = world.bodies()[0].position().x;
            if (x > 0.0) != (last > 0.0) && last != 0.0 {
                turns.push(record.time - x / (x - last) / rate);
            }
            last = x;
        });
        let swings = (turns.len() - 1) as f64 / 2.0;
        let period = (turns.last().unwrap() - turns[0]) / swings;
        let expected = std::f64::consts::TAU * (10.0 / G).sqrt();
        near(period, expected * (1.0 + angle * angle / 16.0), 0.002);
        let weight = world.bodies()[0].mass() * G;
        near(most, weight * (3.0 - 2.0 * angle.cos()), 0.005);
    }
}

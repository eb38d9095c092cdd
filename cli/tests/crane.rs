//! The scene of a crane, whose reel hauls a rope in and lets it out, and that of a winch with a drum.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use tunnelproof::certified::Certified;
use tunnelproof::wire::state::State;
use tunnelproof::wire::{Collisions, Mode, World};
use tunnelproof_cli::scenes::Scene;

const CRANE: &str = include_str!("../scenes/crane.toml");
const WINCH: &str = include_str!("../scenes/winch.toml");

fn start(text: &str) -> (Scene, World, Collisions<'static>) {
    let scene = Scene::from_toml(text).unwrap();
    let world = scene.world().unwrap();
    let collisions = scene.collisions(Mode::Guard, &Certified).unwrap();
    (scene, world, collisions)
}

/// Energy comes from nothing in no step, and the crate goes over the wall and comes to hang above
/// the ground behind it.
#[test]
fn crane_lifts_a_crate_over_the_wall_and_sets_it_down() {
    let (scene, mut world, mut collisions) = start(CRANE);
    let [crate_, wall] = [1, 2];
    let mut energy = world.energy_halfway().total();
    let (mut most, mut highest, mut work) = (0.0f64, 0.0f64, 0.0);
    let first = energy;
    for _ in 0..scene.steps() {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        let now = record.energy.total();
        most = most.max(now - energy - record.work);
        work += record.work;
        energy = now;
        let bodies = world.bodies();
        let (place, over) = (bodies[crate_].position(), bodies[wall].position());
        highest = highest.max(place.z);
        if (place.x - over.x).abs() < 0.8 {
            assert!(place.z - 0.5 > 3.0, "{place}");
        }
    }
    let place = world.bodies()[crate_].position();
    // 4 m up, 3.5 m down.
    assert!((highest - 4.7).abs() < 0.05, "{highest}");
    assert!(
        (place.z - 1.2).abs() < 0.05 && (place.x - 4.5).abs() < 0.6,
        "{place}"
    );
    let length = world.wires()[0].length();
    assert!((length - 8.3).abs() < 1e-3, "{length}");
    // A step in which the winch changes its speed by 0.5 m/s moves 300 kg at once.
    assert!(most < 1.0, "{most} J from nothing");
    assert!(
        energy - first < work && energy - first > work - 600.0,
        "{energy} {first} {work}"
    );
}

/// The drum turns by 10.5 rad with wire of 10 mm on 300 mm, and back, whatever the step.
#[test]
fn winch_lifts_a_crate_and_lowers_it_again() {
    for rate in [30.0, 60.0, 240.0] {
        let step = format!("[settings]\nstep = {}\n\n[[bodies]]", 1.0 / rate);
        let (scene, mut world, mut collisions) = start(&WINCH.replacen("[[bodies]]", &step, 1));
        let mut energy = world.energy_halfway().total();
        let (mut most, mut places) = (0.0f64, Vec::new());
        for _ in 0..scene.steps() {
            let record = world.step_colliding(&mut collisions, &[]).unwrap();
            let now = record.energy.total();
            most = most.max(now - energy - record.work);
            energy = now;
            places.push(world.bodies()[2].position());
        }
        let at = |time: f64| places[(time * rate) as usize - 1];
        let [hangs, lifted, lowered] = [2.5, 14.5, 27.0].map(at);
        let lift = lifted.z - hangs.z;
        assert!((lift - 10.5 * 0.31).abs() < 0.02, "{rate}: {lift}");
        assert!((lowered.z - hangs.z).abs() < 0.015, "{rate}: {lowered}");
        assert!(most < 2.0, "{rate}: {most} J from nothing");
    }
}

/// A state in the middle of a lift goes on to the bit, and with another reel it says so.
#[test]
fn crane_goes_on_from_a_state() {
    let (scene, mut world, mut collisions) = start(CRANE);
    for _ in 0..150 {
        world.step_colliding(&mut collisions, &[]).unwrap();
    }
    let mut file = Vec::new();
    State::of(&world, &collisions).save(&mut file).unwrap();
    let state = State::load(file.as_slice()).unwrap();
    let (mut again, differences) = scene.continued(&state).unwrap();
    assert!(differences.is_empty(), "{differences:?}");
    let mut others = state.collisions(Default::default(), &Certified);
    for _ in 0..150 {
        world.step_colliding(&mut collisions, &[]).unwrap();
        again.step_colliding(&mut others, &[]).unwrap();
    }
    assert_eq!(world.wires(), again.wires());
    assert_eq!(world.bodies(), again.bodies());

    let slower = CRANE.replacen("speed = -1 ", "speed = -0.75 ", 1);
    assert_ne!(slower, CRANE);
    let (other, differences) = Scene::from_toml(&slower)
        .unwrap()
        .continued(&state)
        .unwrap();
    let said: Vec<String> = differences.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 1);
    let start = "wires[0].reel is -0.5 m/s from 0.5 s, -0.75 m/s from 1 s, -0.5 m/s from 4.5 s";
    assert!(said[0].starts_with(start), "{said:?}");
    assert_eq!(other.wires()[0].reel()[1].speed, -0.75);
}

#[test]
fn reels_of_scene_files_are_checked() {
    let refused = |from: &str, to: &str| {
        assert!(CRANE.contains(from), "{from}");
        let scene = Scene::from_toml(&CRANE.replacen(from, to, 1));
        scene
            .and_then(|scene| scene.world())
            .unwrap_err()
            .to_string()
    };
    let order = refused("from = 4.5, speed", "from = 0.75, speed");
    assert!(
        order.ends_with(
            "wires[0].reel: phase 3 of the reel starts at 0.75 s, it must start after phase 2, which \
             starts at 1 s"
        ),
        "{order}"
    );
    let free = refused(
        r#"{ eye = { body = "trolley", local = [0, 0, -0.2] } }"#,
        "{ free = [0, 0, 10] }",
    );
    assert!(
        free.ends_with("the wire ends free, a reel must be at a fixed point or an eye"),
        "{free}"
    );
    let unknown = refused("speed = -1 ", "sped = -1 ");
    assert!(
        unknown.contains("reel[1].sped: there is no such field; the fields are from, speed"),
        "{unknown}"
    );
}

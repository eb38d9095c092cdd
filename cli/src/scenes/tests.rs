//! Scene files: what they build, and what is said of wrong ones.

use super::*;
use tunnelproof::certified::Certified;
use tunnelproof::wire::{self, Mode, NodeKind, Vector, World};

const FILE: &str = r#"
title = "All that there is"
duration = 1.5

[settings]
step = 0.01
gravity = [0, 0, -1]

[[bodies]]
name = "deck"
shape = "plane"
position = [0, 0, 0]
turn = { axis = [0, 0, 2], degrees = 90 }

[[bodies]]
name = "cart"
shape = { mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] } }
position = [1, 2, 3]
drive = { kinematic = [{ from = 1, velocity = [1, 0, 0] }, { from = 2 }] }

[[bodies]]
name = "load"
shape = { capsule = { radius = 0.5, half_height = 0.25 } }
position = [0, 0, -5]
drive = { dynamic = { density = 10, velocity = [0, 1, 0], angular_velocity = [0, 0, 3] } }

[[wires]]
name = "rope"
material = { radius = 0.01, bend_modulus = 0, density = 1000 }
resolution = 0.5
adaptive = false
length = 9
velocity = [1, 0, 0]
route = [
  { pinned = [0, 0, 0] },
  { hang = 5 },
  { contact = { body = "cart", local = [0, 0, 0], normal = [0, 0, 2], friction = 0.25 } },
  { free = [0, 2, 0] },
  { eye = { body = "load", local = [0, 0, 0.75] } },
]
"#;

fn refused(from: &str, to: &str) -> String {
    assert!(FILE.contains(from), "{from}");
    let error = Scene::from_toml(&FILE.replacen(from, to, 1)).unwrap_err();
    error.to_string()
}

#[test]
fn chain_of_the_example_scene_slides_over_both_edges() {
    let scene = include_str!("../../scenes/over-the-edge.toml");
    let scene = Scene::from_toml(scene).unwrap();
    let mut world = scene.world().unwrap();
    let mut collisions = scene.collisions(Mode::Guard, &Certified).unwrap();
    let heights = |world: &World| [1, 2].map(|ball| world.bodies()[ball].position().z);
    let start = heights(&world);
    for _ in 0..scene.steps() / 4 {
        world.step_colliding(&mut collisions, &[]).unwrap();
    }
    let slid = heights(&world);
    let over = |node: &&wire::Node| matches!(node.kind, NodeKind::Contact { .. });
    assert_eq!(world.wires()[0].nodes().iter().filter(over).count(), 2);
    assert!(
        slid[0] - start[0] > 0.2 && start[1] - slid[1] > 0.2,
        "{start:?} {slid:?}"
    );
}

#[test]
fn scene_file_builds_all_that_the_model_has() {
    let scene = Scene::from_toml(FILE).unwrap();
    assert_eq!((scene.steps(), scene.friction), (150, 0.5));
    let more = FILE.replacen("duration", "contact_nodes = false\nduration", 1);
    let without = Scene::from_toml(&more).unwrap();
    assert!(!without.contact_nodes && scene.contact_nodes);
    let world = scene.world().unwrap();
    assert_eq!(world.settings().step, 0.01);
    assert_eq!(world.settings().sweeps, 200);
    let [deck, cart, load] = [0, 1, 2].map(|k| &world.bodies()[k]);
    let ahead = deck.orientation() * Vector::x();
    assert!((ahead - Vector::y()).norm() < 1e-15);
    assert!(!cart.is_dynamic() && load.is_dynamic());
    assert_eq!(cart.position(), [1.0, 2.0, 3.0].into());
    assert_eq!(load.angular_velocity(), Vector::new(0.0, 0.0, 3.0));
    let wire = &world.wires()[0];
    assert!(wire.material().is_chain());
    assert_eq!(wire.material().density, 1000.0);
    let last = wire.nodes().last().unwrap();
    assert!((last.arc - 9.0).abs() < 1e-12);
    assert_eq!(last.position, load.point(&Vector::new(0.0, 0.0, 0.75)));
    // The catenary hangs below both its ends.
    let over = |node: &&wire::Node| matches!(node.kind, NodeKind::Contact { .. });
    let turn = wire.nodes().iter().position(|node| over(&node)).unwrap();
    assert_eq!(turn, 10);
    assert!(
        wire.nodes()[..turn]
            .iter()
            .any(|node| node.position.z < -0.01)
    );
}

#[test]
fn scene_file_written_reads_back() {
    for (_, text) in EMBEDDED {
        let scene = Scene::from_toml(text).unwrap();
        let json = serde_json::to_string(&scene).unwrap();
        assert_eq!(scene, serde_json::from_str(&json).unwrap());
    }
}

#[test]
fn scene_file_errors_name_line_and_field() {
    let cases = [
        (
            "duration = 1.5",
            "duration = 0",
            "line 3: duration: duration is 0, it must be finite and above 0",
        ),
        (
            "step = 0.01",
            "step = -1",
            "line 6: settings.step: step is -1, it must be finite and above 0",
        ),
        (
            "density = 10,",
            "density = nan,",
            "line 25: bodies[2].drive.dynamic.density: density is NaN, it must be finite and above 0",
        ),
        (
            "[0, 0, 2], degrees",
            "[0, 0, 0], degrees",
            "line 13: bodies[0].turn.axis: axis is 0, it must be a vector longer than 0",
        ),
        (
            "[1, 2, 3]]",
            "[1, 2, 7]]",
            "line 17: bodies[1].shape.mesh.triangles: triangle 3 has corner 7: vertices are 0 to 4 (excluded)",
        ),
        (
            "from = 2",
            "from = 1",
            "line 19: bodies[1].drive.kinematic: phase 2 of the kinematic body starts at 1 s, it must \
            start after phase 1, which starts at 1 s",
        ),
        (
            "radius = 0.01",
            "radius = 0",
            "line 29: wires[0].material.radius: radius is 0, it must be finite and above 0",
        ),
        (
            "resolution = 0.5",
            "resolution = 1e-9",
            "line 30: wires[0].resolution: resolution is 1e-9, it must be at least a \
            millionth of the wire's length",
        ),
        (
            "\"load\", local",
            "\"ghost\", local",
            "line 39: wires[0].route[4].eye.body: there is no body \"ghost\"; bodies are deck, cart, load",
        ),
        (
            "\"cart\"",
            "\"deck\"",
            "line 16: bodies[1].name: the name \"deck\" is there twice",
        ),
        (
            "hang = 5 ",
            "hang = 1 ",
            "line 36: wires[0].route[1].hang: hang is 1, it must be above 3.7416573867739413, the way \
            between the stops before and after it",
        ),
        (
            "{ pinned = [0, 0, 0] },",
            "{ pinned = [0, 0, 0] }, { free = [0, 0, 0] },",
            "line 35: wires[0].route[0]: stops 0 and 1 of the route are at the same place, their \
            distance must be above 0",
        ),
    ];
    for (from, to, message) in cases {
        assert_eq!(refused(from, to), message);
    }
}

/// A rope between two clamps.
const ROPE: &str = r#"
title = "rope"
duration = 1

[[wires]]
name = "rope"
twist = 12.5
resolution = 0.5
route = [{ pinned = [0, 0, 0] }, { pinned = [0.1, 0, 0] }, { pinned = [3, 0, 0] }, { pinned = [3.1, 0, 0] }]
material = { radius = 0.01, mass_per_length = 0.4, stretch_stiffness = 1e6, bend_stiffness = 0.5, twist_stiffness = 0.25, twist_damping = 0.5 }
"#;

#[test]
fn rope_has_the_stiffness_that_its_scene_file_says() {
    let world = Scene::from_toml(ROPE).unwrap().world().unwrap();
    let wire = &world.wires()[0];
    let material = wire.material();
    let plan = wire::RopePlan {
        radius: 0.01,
        mass_per_length: 0.4,
        stretch_stiffness: 1e6,
        bend_stiffness: 0.5,
        twist_stiffness: 0.25,
    };
    let twist_damping = 0.5;
    let rope = wire::Material::rope(plan).unwrap();
    assert_eq!(
        *material,
        wire::Material {
            twist_damping,
            ..rope
        }
    );
    assert!(wire.holds_twist());
    assert_eq!(wire.twist(), 12.5);
}

#[test]
fn scene_file_says_a_stiffness_once() {
    let refused = |from: &str, to: &str| {
        assert!(ROPE.contains(from), "{from}");
        let error = Scene::from_toml(&ROPE.replacen(from, to, 1)).unwrap_err();
        error.to_string()
    };
    for (both, message) in [
        (
            "density = 1, mass_per_length",
            "mass_per_length: density is given as well",
        ),
        (
            "stretch_modulus = 1, stretch_stiffness",
            "stretch_stiffness: stretch_modulus is given as well",
        ),
        (
            "bend_modulus = 1, bend_stiffness",
            "bend_stiffness: bend_modulus is given as well",
        ),
        (
            "twist_modulus = 1, twist_stiffness",
            "twist_stiffness: twist_modulus is given as well",
        ),
    ] {
        let from = both.split(", ").last().unwrap();
        let message = format!("line 10: wires[0].material.{message}; give one of the two");
        assert_eq!(refused(from, both), message);
    }
    let cases = [
        (
            "bend_stiffness = 0.5",
            "bend_stiffness = -1",
            "line 10: wires[0].material.bend_stiffness: bend_stiffness is -1, it must be finite and at least 0",
        ),
        (
            "bend_stiffness = 0.5",
            "bend_stiffness = 0",
            "line 10: wires[0].material.twist_stiffness: twist_stiffness is 0.25, it must be 0 for a chain",
        ),
        (
            "mass_per_length = 0.4",
            "mass_per_length = 0",
            "line 10: wires[0].material.mass_per_length: mass_per_length is 0, it must be finite and above 0",
        ),
        (
            "mass_per_length = 0.4",
            "density = 0",
            "line 10: wires[0].material.density: density is 0, it must be finite and above 0",
        ),
        (
            "radius = 0.01",
            "radius = 0",
            "line 10: wires[0].material.radius: radius is 0, it must be finite and above 0",
        ),
        (
            "twist_stiffness = 0.25",
            "twist_modulus = -1",
            "line 10: wires[0].material.twist_modulus: twist_modulus is -1, it must be finite and at least 0",
        ),
        (
            "twist_stiffness = 0.25",
            "twist_stiffness = 0",
            "line 7: wires[0].twist: twist is 12.5, it must be 0 unless the material has a \
            twist_modulus and both ends are clamped",
        ),
        (
            "{ pinned = [0.1, 0, 0] }, ",
            "",
            "line 7: wires[0].twist: twist is 12.5, it must be 0 unless the material has a \
            twist_modulus and both ends are clamped",
        ),
    ];
    for (from, to, message) in cases {
        assert_eq!(refused(from, to), message);
    }
}

#[test]
fn scene_of_an_unknown_name_is_refused_with_those_there_are() {
    assert_eq!(
        Scene::embedded("moon").unwrap_err().to_string(),
        "there is no scene \"moon\"; there are basic-collision, pulling-anchor, \
        twisting-under-load, chains-on-deck"
    );
}

/// The numbers of the thesis, where the file gives others from which they follow.
#[test]
fn scenes_of_the_thesis_have_its_numbers() {
    let world = |k: usize| -> (u64, World) {
        let scene = Scene::from_toml(EMBEDDED[k].1).unwrap();
        (scene.steps(), scene.world().unwrap())
    };
    let length = |world: &World, wire: usize| world.wires()[wire].nodes().last().unwrap().arc;
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-3, "{a} {b}");

    let (steps, basic) = world(0);
    assert_eq!(steps, 300);
    (0..3).for_each(|wire| near(length(&basic, wire), 2.0));

    let (steps, anchor) = world(1);
    assert_eq!(steps, 1920);
    near(anchor.bodies()[0].mass(), 1570.796);
    near(length(&anchor, 0), 25.0);
    near(length(&anchor, 1), 50.0);
    near(-anchor.bodies()[1].position().x / 2.0, 8.85);
    // At the end the pulled wire still reaches the end of the hanging one where that is straight
    // towards it.
    let boxes = anchor.bodies()[1].position() + Vector::x() * 2.0 * 32.0;
    assert!((boxes.coords - Vector::x() * 25.0).norm() < 25.0);

    let (steps, twisting) = world(2);
    assert_eq!(steps, 300);
    near(twisting.bodies()[1].mass(), 8000.0);
    let weight = 8000.0 * 9.80665 / 4.0;
    for wire in twisting.wires() {
        let strain = weight / wire.material().stretch_stiffness();
        near(
            wire.nodes()[0].position.z - wire.nodes().last().unwrap().position.z,
            12.0,
        );
        assert!((wire.nodes().last().unwrap().arc * (1.0 + strain) - 12.0).abs() < 1e-9);
    }

    let (steps, chains) = world(3);
    assert_eq!(steps, 540);
    near(chains.bodies()[3].mass(), 200.0);
    near(chains.bodies()[1].position().z, 0.8);
    for wire in chains.wires() {
        assert!(wire.material().is_chain());
        assert!(wire.nodes().iter().all(|node| node.position.z >= 0.01));
    }
    // The brown box passes the blue one after the chains have met and before they meet near both.
    let passes = 0.5 - chains.bodies()[2].position().x / 0.6;
    assert!((2.1..3.083).contains(&passes), "{passes}");
}

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use tunnelproof::certified::Certified;
use tunnelproof::wire::{Mesh, Mode, Shape};

use super::*;
use crate::audit::{Audit, Report};
use crate::scenes::Scene;

/// 2^30 m.
const FAR: f64 = 1_073_741_824.0;

/// A prism over a cross, with its corners at 1 and 3 and its ends at 1, on both sides of the origin.
fn cross() -> Core {
    let around = [
        [3, -1],
        [3, 1],
        [1, 1],
        [1, 3],
        [-1, 3],
        [-1, 1],
        [-3, 1],
        [-3, -1],
        [-1, -1],
        [-1, -3],
        [1, -3],
        [1, -1],
    ];
    let at = |z: f64| around.map(|[x, y]| Point::new(f64::from(x), f64::from(y), z));
    let vertices = [at(-1.0), at(1.0)].concat();
    let sides = (0..12).map(|k| [k, (k + 1) % 12, (k + 1) % 12 + 12, k + 12]);
    let arms = [0, 3, 6, 9].map(|k: usize| [(k + 11) % 12, k, k + 1, k + 2]);
    let caps = arms.into_iter().chain([[2, 5, 8, 11]]);
    let caps = caps.flat_map(|[a, b, c, d]| [[d, c, b, a], [a + 12, b + 12, c + 12, d + 12]]);
    let fan = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
    let mesh = Mesh::new(vertices, sides.chain(caps).flat_map(fan).collect()).unwrap();
    assert_eq!(mesh.vertices()[0], Point::new(3.0, -1.0, -1.0));
    Core::of(&Shape::Mesh(mesh))
}

/// A cube, with its core from -7 to 7.
fn cube() -> Core {
    Core::of(&Shape::Box {
        half: Vector::repeat(8.0),
    })
}

#[test]
fn nodes_next_to_a_surface_are_inside_to_the_bit() {
    for offset in [0.0, 1e6, FAR] {
        let centre = Point::new(offset, -offset, offset);
        // Of any length.
        let pose = Pose::new(centre, Quaternion::new(2.0, 0.0, 0.0, 0.0));
        for (core, height) in [(&Core::Plane, 0.0), (&cube(), 7.0), (&cross(), 1.0)] {
            let at = offset + height;
            let is_in = |z: f64| {
                let node = Point::new(centre.x + 0.5, centre.y - 2.0, z);
                is_node_inside(core, &pose, &node)
            };
            let around = [at.next_down(), at, at.next_up()].map(is_in);
            assert_eq!(around, [true, false, false], "{offset} {height}");
        }
    }
}

/// Places in the planes of faces, next to these, and elsewhere, in the frame of the body.
#[test]
fn places_around_a_surface_are_inside_to_the_bit() {
    let beside = |x: f64| [x.next_down(), x, x.next_up()];
    let corners = [-3.0, -1.0, 1.0, 3.0].map(beside);
    let across = [corners.as_flattened(), &[-3.5, -2.0, 0.0, 0.5, 2.5, 4.0]].concat();
    let along = [-1.5, -1.0, -0.5, 0.0, 1f64.next_down(), 1.0, 1.5];
    let pose = Pose::new(
        Point::new(FAR, 5.0, -FAR),
        Quaternion::new(1.0, 1.0, 0.0, 0.0),
    );
    let core = cross();
    let Core::Surface(surface) = &core else {
        unreachable!("a surface");
    };
    for &x in &across {
        for &y in &across {
            for z in along {
                let place = Point::new(x, y, z);
                let arm = |a: f64, b: f64| a.abs() < 3.0 && b.abs() < 1.0;
                let inside = (arm(x, y) || arm(y, x)) && z.abs() < 1.0;
                let exact = is_within(surface, &pose, &place, &pose);
                assert_eq!(exact, Some(inside), "{place:?}");
                assert_eq!(is_inside(&core, &pose, &place, &pose), inside, "{place:?}");
            }
        }
    }
}

/// A wire that flies up from below a floor, which is so high above the centre of its body.
fn audited(shape: &str, height: f64, offset: [f64; 3], depth: f64, mode: Mode) -> Report {
    let [x, y, z] = offset;
    let centre = z - height;
    let end = |side: f64| format!("{{ free = [{:?}, {y:?}, {:?}] }}", x + side, z - depth);
    let text = format!(
        r#"
title = "below a floor"
duration = 0.2
settings = {{ gravity = [0, 0, 0] }}
[[bodies]]
name = "floor"
shape = {shape}
position = [{x:?}, {y:?}, {centre:?}]
[[wires]]
name = "wire"
material = {{ radius = 0.001, bend_modulus = 0 }}
resolution = 0.5
velocity = [0.3, 0.2, 5]
route = [{}, {}]
"#,
        end(-1.5),
        end(1.5)
    );
    let scene = Scene::from_toml(&text).unwrap();
    let mut collisions = scene.collisions(mode, &Certified).unwrap();
    let mut world = scene.world().unwrap();
    let mut audit = Audit::of_world(&world);
    for _ in 0..scene.steps() {
        audit.step(&world.step_colliding(&mut collisions, &[]).unwrap());
    }
    let lowest = |world: &tunnelproof::wire::World| {
        let nodes = world.wires()[0].nodes().iter();
        nodes.fold(f64::MAX, |low, node| low.min(node.position.z))
    };
    assert!(lowest(&world) > z + 0.1, "held at {:?}", lowest(&world) - z);
    audit.finish()
}

/// What starts below a floor by a little comes out, and that is not a missed touch.
#[test]
fn wire_that_starts_below_a_floor_comes_out_and_nothing_is_missed() {
    let slab = "{ mesh = { vertices = [[-2, -2, -1], [2, -2, -1], [-2, 2, -1], [2, 2, -1], \
                [-2, -2, 1], [2, -2, 1], [-2, 2, 1], [2, 2, 1]], triangles = [[0, 2, 3], [0, 3, 1], \
                [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6], \
                [0, 6, 2], [1, 3, 7], [1, 7, 5]] } }";
    for far in [0.0, 1e6, 1e8_f64] {
        for offset in [[far, 0.0, 0.0], [0.0, far, 0.0], [0.0, 0.0, far], [far; 3]] {
            let high: f64 = offset[2];
            let next = high - high.next_down();
            let next = next.max(1e-12);
            // As parts of a metre, and of the coordinates.
            let parts = [1.2, 1.8, 2.5, 3.5, 4.5].map(|part| 1e-9 * part);
            let of_far = parts.map(|part| part * far);
            let depths = [&[next, 2.0 * next][..], &parts, &of_far].concat();
            for mode in [Mode::Guard, Mode::Thesis] {
                for depth in &depths {
                    let report = audited("\"plane\"", 0.0, offset, *depth, mode);
                    assert!(report.is_exact(), "{offset:?} {depth} {report:?}");
                }
                for depth in &depths[..7] {
                    let report = audited(slab, 1.0, offset, *depth, mode);
                    assert!(report.is_exact(), "slab {offset:?} {depth} {report:?}");
                }
            }
        }
    }
}

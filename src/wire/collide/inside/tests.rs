#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use nalgebra::{Quaternion, UnitQuaternion};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::wire::Shape;
use crate::wire::model::box_mesh;

/// Places are multiples of this, so that they are representable [`FAR`] from the origin, too.
const GRID: f64 = 1.0 / 4096.0;

/// 2^40 m.
const FAR: f64 = 1_099_511_627_776.0;

fn cores() -> [Core; 4] {
    let half = Vector::new(1.0, 0.5, 0.25);
    let shapes = [
        Shape::Plane,
        Shape::Box { half },
        Shape::Sphere { radius: 0.5 },
        Shape::Mesh(box_mesh(half, Vector::zeros())),
    ];
    shapes.each_ref().map(Core::of)
}

fn on_grid(rng: &mut ChaCha8Rng, size: f64) -> Vector {
    Vector::from_fn(|_, _| (rng.random_range(-size..=size) / GRID).round() * GRID)
}

fn at_rest(centre: Vector) -> Pose {
    Pose::new(centre.into(), Quaternion::identity())
}

/// The same places, moved by what rounds none of them.
#[test]
fn what_is_inside_is_so_wherever_it_is() {
    let rng = &mut ChaCha8Rng::seed_from_u64(41);
    for (k, core) in cores().iter().enumerate() {
        let mut inside = 0;
        for _ in 0..1500 {
            let turn = UnitQuaternion::from_scaled_axis(on_grid(rng, 2.0));
            let (centre, node) = (on_grid(rng, 1.0), on_grid(rng, 1.0));
            let is_in_at = |offset: Vector| {
                let pose = Pose::new((centre + offset).into(), *turn.quaternion());
                let node = Point::from(centre + node + offset);
                is_in(core, &pose, &[node, node]).unwrap()
            };
            let near = is_in_at(Vector::zeros());
            inside += u32::from(near);
            for axis in 0..3 {
                assert_eq!(is_in_at(Vector::ith(axis, FAR)), near, "{k}: {node:?}");
            }
        }
        assert!((30..1470).contains(&inside), "{k}: {inside}");
    }
}

/// Nodes on a surface and the nearest numbers on both sides of it.
#[test]
fn nodes_next_to_a_surface_are_inside_to_the_bit() {
    let plane = Core::Plane;
    let cube = Core::of(&Shape::Box {
        half: Vector::repeat(8.0),
    });
    for far in [0.0, 1e6, 1e8, FAR] {
        // The core of the cube goes to 7.
        for (core, height) in [(&plane, 0.0), (&cube, 7.0)] {
            for centre in [[0.0, 0.0, far], [far, 0.0, 0.0], [far, far, far]] {
                let pose = at_rest(centre.into());
                let is_in_at = |z: f64| {
                    let node = Point::new(centre[0] + 1.0, centre[1], z);
                    is_in(core, &pose, &[node, node]).unwrap()
                };
                let z = centre[2] + height;
                let around = [z.next_down(), z, z.next_up()].map(is_in_at);
                assert_eq!(around, [true, true, false], "{height} {centre:?}");
            }
        }
    }
}

/// A plane whose centre is far from the node.
#[test]
fn plane_has_what_is_below_however_far_its_centre_is() {
    let pose = at_rest(Vector::zeros());
    for (z, below) in [(-1e-3, true), (-1e-12, true), (1e-12, false), (1e-3, false)] {
        let node = Point::new(FAR, -FAR, z);
        assert_eq!(is_in(&Core::Plane, &pose, &[node, node]).unwrap(), below);
    }
}

/// Beside a vertex more than one face is near.
#[test]
fn nodes_next_to_an_edge_or_a_vertex_are_inside_to_the_bit() {
    let cube = Core::of(&Shape::Box {
        half: Vector::repeat(8.0),
    });
    let pose = at_rest(Vector::repeat(1e6));
    let seven: f64 = 1e6 + 7.0;
    let is_in_at = |x: f64, y: f64, z: f64| {
        let node = Point::new(x, y, z);
        is_in(&cube, &pose, &[node, node]).unwrap()
    };
    let (inside, outside) = (seven.next_down(), seven.next_up());
    assert!(is_in_at(inside, inside, inside) && is_in_at(inside, inside, 1e6));
    assert!(!is_in_at(inside, inside, outside) && !is_in_at(outside, inside, 1e6));
}

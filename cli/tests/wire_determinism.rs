//! The same world gives the same bits in every build: hashes of all positions after some steps.
//!
//! It runs optimised (`cargo test`, `cargo test --release`) and not
//! (`CARGO_PROFILE_DEV_OPT_LEVEL=0 cargo test --test wire_determinism`): a transformation that
//! changed floating-point results would show here. A change of the stepper that changes results on
//! purpose changes the hash.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use tunnelproof::certified::Certified;
use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyPlan, Collisions, ContactConstraint, ContactSite, Drive, Material, Mesh, Mode, Settings,
    Shape, Stop, Vector, WirePlan, World,
};
use tunnelproof_cli::scenes::Scene;

/// A tumbling box between an adaptive steel wire and a chain, which hits the ground.
fn world() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let half = Vector::new(0.3, 0.4, 0.5);
    let plan = BodyPlan {
        drive: Drive::Dynamic {
            density: 2000.0,
            velocity: Vector::new(1.0, 2.0, 3.0),
            angular_velocity: Vector::new(4.0, 5.0, -6.0),
        },
        ..BodyPlan::dynamic(Shape::Box { half }, 2000.0, Point::new(0.0, 0.0, 0.7))
    };
    let body = world.add_body(plan).unwrap();
    let local = Vector::new(0.3, 0.4, 0.5);
    let top = Stop::Pinned(Point::new(0.0, 1.0, 5.0));
    let steel = Material::steel(0.01);
    let plan = WirePlan::new(steel, 0.25, vec![top, Stop::Eye { body, local }]);
    world.add_wire(&plan.adaptive()).unwrap();
    let local = -local;
    let side = Stop::Free(Point::new(4.0, 1.0, 3.0));
    let plan = WirePlan::new(steel.chain(), 0.25, vec![side, Stop::Eye { body, local }]);
    world.add_wire(&plan).unwrap();
    world
}

/// Every corner of the box against the ground.
fn contacts(world: &World) -> Vec<ContactConstraint> {
    let corner = |key: u64| {
        let sign = |bit: u64| if key >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let local = Vector::new(0.3 * sign(0), 0.4 * sign(1), 0.5 * sign(2));
        let body = tunnelproof::wire::BodyId(0);
        ContactConstraint {
            key,
            a: ContactSite::Body { body, local },
            b: ContactSite::World,
            normal: Vector::z(),
            gap: world.bodies()[0].point(&local).z,
            friction: 0.5,
        }
    };
    (0..8).map(corner).collect()
}

/// FNV-1a over the bits of every coordinate.
fn hash(world: &World) -> u64 {
    let nodes = world.wires().iter().flat_map(|wire| wire.nodes());
    let points = nodes.map(|node| node.position);
    let points = points.chain(world.bodies().iter().map(|body| body.position()));
    let bytes = points.flat_map(|p| [p.x, p.y, p.z].map(f64::to_bits));
    let bytes = bytes.flat_map(u64::to_le_bytes);
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

#[test]
fn steps_give_the_same_bits_in_every_build() {
    let mut world = world();
    let mut touched = false;
    let mut remeshed = 0;
    for _ in 0..300 {
        let list = contacts(&world);
        let record = world.step(&list).unwrap();
        touched |= record.contacts.iter().any(|c| c.normal_force() > 0.0);
        remeshed += record.remeshes.len();
    }
    // All parts of a step took part.
    assert!(touched && remeshed > 0, "{touched} {remeshed}");
    assert_eq!(hash(&world), 0xbfd4_1cc0_3dee_ee9d, "{:#x}", hash(&world));
}

#[test]
fn steps_with_collisions_give_the_same_bits_in_every_build() {
    let scene = Scene::embedded("basic-collision").unwrap();
    let mut world = scene.world().unwrap();
    let mut collisions = Collisions::default();
    let (mut prevented, mut contacts) = (0, 0);
    for _ in 0..300 {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        prevented += record.collisions.crossings.len();
        contacts += record.contacts.len();
    }
    assert!(prevented > 0 && contacts > 300, "{prevented} {contacts}");
    assert_eq!(hash(&world), 0xcf14_b14d_0bd8_0129, "{:#x}", hash(&world));
}

/// Bodies of every shape that fall on each other and on a plane, and a wire and a chain on top.
fn heap() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let (radius, half_height) = (0.2, 0.3);
    let half = Vector::new(0.3, 0.2, 0.25);
    let corners = [
        [0.0, 0.0, 0.0],
        [0.9, 0.0, 0.0],
        [0.0, 0.8, 0.0],
        [0.0, 0.0, 0.7],
    ];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mesh = Mesh::new(corners.map(Point::from).to_vec(), triangles).unwrap();
    let shapes = [
        Shape::Box { half },
        Shape::Cylinder {
            radius,
            half_height,
        },
        Shape::Sphere { radius },
        Shape::Capsule {
            radius,
            half_height,
        },
        Shape::Mesh(mesh),
    ];
    let ground = BodyPlan::fixed(Shape::Plane, Point::origin());
    world.add_body(ground).unwrap();
    for (k, shape) in shapes.into_iter().enumerate() {
        let k = k as f64;
        let drive = Drive::Dynamic {
            density: 500.0 + 100.0 * k,
            velocity: Vector::new(0.5 - 0.2 * k, 0.1 * k, -1.0),
            angular_velocity: Vector::new(1.0, k - 2.0, 0.5),
        };
        let position = Point::new(0.4 * k - 0.8, 0.0, 0.6 + 0.1 * k);
        let plan = BodyPlan::fixed(shape, position);
        world.add_body(BodyPlan { drive, ..plan }).unwrap();
    }
    for (y, material) in [
        (-0.1, Material::steel(0.01)),
        (0.1, Material::steel(0.01).chain()),
    ] {
        let route = [-1.5, 1.5].map(|x| Stop::Free(Point::new(x, y, 1.6)));
        let plan = WirePlan::new(material, 0.15, route.to_vec());
        world.add_wire(&plan.adaptive()).unwrap();
    }
    world
}

#[test]
fn steps_with_bodies_give_the_same_bits_in_every_build() {
    let mut world = heap();
    let mut collisions = Collisions::default();
    let (mut on_wires, mut on_bodies) = (0, 0);
    for _ in 0..200 {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        for contact in &record.contacts {
            match (contact.contact.a, contact.contact.b) {
                (ContactSite::Wire { .. }, ContactSite::Body { .. }) => on_wires += 1,
                (ContactSite::Body { .. }, ContactSite::Body { .. }) => on_bodies += 1,
                _ => {}
            }
        }
    }
    assert!(on_wires > 100 && on_bodies > 100, "{on_wires} {on_bodies}");
    // Nothing fell through the plane.
    let heights = world.bodies()[1..].iter().map(|body| body.position().z);
    assert!(heights.fold(f64::INFINITY, f64::min) > 0.0);
    assert_eq!(hash(&world), 0x425b_9aba_ff56_3ec9, "{:#x}", hash(&world));
}

/// A chain over three nodes of a ball, between two loads of which one is heavier.
fn hoist() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let radius = 0.5;
    let ball = BodyPlan::fixed(Shape::Sphere { radius }, Point::origin());
    let ball = world.add_body(ball).unwrap();
    let mut load = |density, x| {
        let plan = BodyPlan::dynamic(
            Shape::Sphere { radius: 0.2 },
            density,
            Point::new(x, 0.0, -4.0),
        );
        let body = world.add_body(plan).unwrap();
        let local = Vector::zeros();
        Stop::Eye { body, local }
    };
    let ends = [load(1000.0, -0.5), load(6000.0, 0.5)];
    let normals = [[-1.0, 0.25], [0.0, 1.0], [1.0, 0.25]];
    let over = normals.map(|[x, z]| {
        let normal = Vector::new(x, 0.0, z);
        Stop::Contact {
            body: ball,
            local: normal.normalize() * radius,
            normal,
            friction: 0.2,
        }
    });
    let route = [&ends[..1], &over, &ends[1..]].concat();
    let plan = WirePlan::new(Material::steel(0.01).chain(), 0.25, route);
    world.add_wire(&plan.adaptive()).unwrap();
    world
}

#[test]
fn steps_of_a_wire_that_slides_give_the_same_bits_in_every_build() {
    let mut world = hoist();
    let (mut slid, mut remeshed) = (0, 0);
    for _ in 0..60 {
        let record = world.step(&[]).unwrap();
        slid += usize::from(!record.slides.is_empty());
        remeshed += record.remeshes.len();
    }
    assert!(slid > 50 && remeshed > 5, "{slid} {remeshed}");
    assert_eq!(hash(&world), 0x3840_ceb2_c0ed_3eac, "{:#x}", hash(&world));
}

/// A chain that slides off the edge of a cube, and one that is thrown over it.
fn edge() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let half = Vector::repeat(0.5);
    let cube = BodyPlan::fixed(Shape::Box { half }, Point::new(0.0, 0.0, -0.5));
    world.add_body(cube).unwrap();
    let chain = Material::steel(0.005).chain();
    let route = [[0.0, 0.0, 0.005], [0.505, 0.0, 0.005], [0.505, 0.0, -2.0]];
    let route = route.map(|point| Stop::Free(point.into()));
    let plan = WirePlan::new(chain, 0.25, route.to_vec());
    world.add_wire(&plan.adaptive()).unwrap();
    let route = [[-1.0, 0.2, 0.1], [1.0, 0.3, 0.1]].map(|point| Stop::Free(point.into()));
    let mut plan = WirePlan::new(chain, 0.25, route.to_vec());
    plan.velocity = Vector::new(0.5, 0.0, -3.0);
    world.add_wire(&plan.adaptive()).unwrap();
    world
}

#[test]
fn steps_with_contact_nodes_that_come_and_go_give_the_same_bits_in_every_build() {
    let mut world = edge();
    let collisions = Collisions::default().with_contact_nodes();
    let mut collisions = collisions.with_friction(0.1).unwrap();
    let mut left = 0;
    for _ in 0..60 {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        left += record.slides.iter().filter(|slide| slide.left).count();
    }
    assert!(left > 0);
    assert_eq!(hash(&world), 0xc3c0_994f_8dc0_aeb4, "{:#x}", hash(&world));
}

/// Basic collision is above.
#[test]
fn other_scenes_of_the_thesis_give_the_same_bits_in_every_build() {
    // So many steps reach contacts in each.
    for (name, steps, expected) in [
        ("pulling-anchor", 600, 0x5a82_b9aa_1c0a_c6f4),
        ("twisting-under-load", 60, 0x3808_d005_5259_fe54),
        ("chains-on-deck", 60, 0x777f_fe24_e9ae_196b),
    ] {
        let scene = Scene::embedded(name).unwrap();
        let mut world = scene.world().unwrap();
        let mut collisions = scene.collisions(Mode::Guard, &Certified).unwrap();
        let mut contacts = 0;
        for _ in 0..steps {
            let record = world.step_colliding(&mut collisions, &[]).unwrap();
            contacts += record.contacts.len();
        }
        assert!(contacts > 0, "{name}");
        assert_eq!(hash(&world), expected, "{name} {:#x}", hash(&world));
    }
}

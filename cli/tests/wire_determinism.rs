//! The same world gives the same bits in every build: hashes of all positions after some steps.
//!
//! It runs optimised (`cargo test`, `cargo test --release`) and not
//! (`cargo test --config profile.dev.package.tunnelproof.opt-level=0 --test wire_determinism`): a
//! transformation that changed floating-point results would show here. A change of the stepper that
//! changes results on purpose changes the hash.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use tunnelproof::certified::Certified;
use tunnelproof::wire::{Collisions, ContactSite, Mode, World};
use tunnelproof_cli::scenes::Scene;

mod worlds;

use worlds::{contacts, edge, heap, hoist, tumbling_box, twisted};

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
    let mut world = tumbling_box();
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
    assert_eq!(hash(&world), 0xfb01_3ad7_df75_6aa4, "{:#x}", hash(&world));
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
    assert_eq!(hash(&world), 0x87ca_0c72_0fc3_f158, "{:#x}", hash(&world));
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
    assert_eq!(hash(&world), 0x26dd_711a_860f_64ab, "{:#x}", hash(&world));
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
    assert_eq!(hash(&world), 0x7005_3efe_eba0_2581, "{:#x}", hash(&world));
}

#[test]
fn steps_with_contact_nodes_that_come_and_go_give_the_same_bits_in_every_build() {
    let mut world = edge();
    let collisions = Collisions::default();
    let mut collisions = collisions.with_friction(0.1).unwrap();
    let mut left = 0;
    for _ in 0..60 {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        left += record.slides.iter().filter(|slide| slide.left).count();
    }
    assert!(left > 0);
    assert_eq!(hash(&world), 0xc193_fa58_d541_0d7c, "{:#x}", hash(&world));
}

#[test]
fn steps_of_twisted_wires_give_the_same_bits_in_every_build() {
    let mut world = twisted();
    let mut collisions = Collisions::default();
    let mut remeshed = 0;
    for _ in 0..90 {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        remeshed += record.remeshes.len();
    }
    assert!(remeshed > 0);
    let twists = [0, 1].map(|wire: usize| world.wires()[wire].twist());
    let bits = twists.map(f64::to_bits);
    let expected = [0x4025_2d4b_caf3_1090, 0x402d_ca5e_0c62_6b80];
    assert_eq!(bits, expected, "{bits:#x?} {twists:?}");
    assert_eq!(hash(&world), 0x8cbe_5173_b210_be9b, "{:#x}", hash(&world));
}

/// The same records on any number of threads, but for how long they took.
#[test]
fn records_of_islands_do_not_depend_on_the_number_of_threads() {
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let run = || {
            let scene = Scene::embedded("chains-on-deck").unwrap();
            let mut world = scene.world().unwrap();
            let mut collisions = scene.collisions(Mode::Guard, &Certified).unwrap();
            let records = (0..150).map(|_| {
                let mut record = world.step_colliding(&mut collisions, &[]).unwrap();
                record.phases = Default::default();
                record
            });
            records.collect::<Vec<_>>()
        };
        pool.build().unwrap().install(run)
    };
    let one = of(1);
    assert!(one.iter().any(|record| record.contacts.len() > 20));
    assert_eq!(one, of(3));
}

/// Basic collision is above.
#[test]
fn other_scenes_of_the_thesis_give_the_same_bits_in_every_build() {
    // So many steps reach contacts in each.
    for (name, steps, expected) in [
        ("pulling-anchor", 600, 0x078e_dac1_df43_8c95),
        ("twisting-under-load", 60, 0x47f2_2df9_d89b_0b7c),
        ("chains-on-deck", 60, 0x3265_c5fa_89bf_69b3),
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

//! The segments that pull, against every guess of all, and chains that are too long to guess.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::query::Point;
use crate::wire::step::constitutive::Branch;
use crate::wire::step::linearisation::Linearisation;
use crate::wire::step::order::by_wires;
use crate::wire::{Material, Settings, Stop, Vector, WirePlan, World};

fn vector(rng: &mut ChaCha8Rng, size: f64) -> Vector {
    Vector::from_fn(|_, _| rng.random_range(-size..=size))
}

/// A chain of a few segments, some longer and some shorter than unstretched, with velocities of
/// their own.
fn chain(rng: &mut ChaCha8Rng) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let mut point = Point::origin();
    let mut route = vec![Stop::Pinned(point)];
    for _ in 0..8 {
        point += vector(rng, 1.0);
        route.push(Stop::Free(point));
    }
    let material = Material::steel(0.01).chain();
    let mut plan = WirePlan::new(material, 10.0, route);
    plan.length = Some(6.0);
    world.add_wire(&plan).unwrap();
    let wire = &mut world.wires[0];
    let lengths: Vec<f64> = (0..8).map(|segment| wire.span(segment).norm()).collect();
    for (segment, length) in lengths.into_iter().enumerate() {
        let rest = length * rng.random_range(0.9..1.1);
        wire.nodes[segment + 1].arc = wire.nodes[segment].arc + rest;
        wire.nodes[segment + 1].velocity = vector(rng, 50.0);
    }
    world
}

/// The solution for the one guess of which segments pull that it does not contradict, of all
/// there are.
fn by_guessing(system: &mut System) -> Vec<f64> {
    let mut found = Vec::new();
    for guess in 0..1_u32 << system.rows.len() {
        for (bit, row) in system.rows.iter_mut().enumerate() {
            row.branch = [Branch::INACTIVE, Branch::ACTIVE][guess as usize >> bit & 1];
        }
        system.factor().unwrap();
        let (x, _) = system.solve(&[]).unwrap();
        if !violates_branches(&system.rows, &x) {
            found.push(x);
        }
    }
    assert_eq!(found.len(), 1);
    found.swap_remove(0)
}

#[test]
fn pulling_segments_are_those_of_the_only_guess_that_holds() {
    let rng = &mut ChaCha8Rng::seed_from_u64(1);
    let mut more_than_one = 0;
    for _ in 0..20 {
        let world = chain(rng);
        let mut system = System::new(
            &world,
            &Linearisation::at_start(&world),
            &by_wires(&world),
            None,
        );
        let expected = by_guessing(&mut system);
        // From whatever velocities the search starts.
        for speed in [0.0, 1.0, 1000.0] {
            let start = expected.iter().map(|_| rng.random_range(-1.0..1.0) * speed);
            let pulled = find_active_set(
                &mut system,
                &[],
                start.collect(),
                &mut Budget::new(usize::MAX),
            )
            .unwrap();
            assert!(pulled.is_found);
            more_than_one += usize::from(pulled.factorisations > 1);
            let difference = pulled.x.iter().zip(&expected).map(|(a, b)| (a - b).abs());
            assert!(difference.fold(0.0, f64::max) < 1e-9);
        }
    }
    assert!(more_than_one > 20, "{more_than_one}");
}

/// What is not found in time still has the momentum of the impulses.
#[test]
fn search_that_is_cut_short_says_so_and_keeps_momentum() {
    let rng = &mut ChaCha8Rng::seed_from_u64(4);
    let mut cut = 0;
    for _ in 0..20 {
        let world = chain(rng);
        let mut system = System::new(
            &world,
            &Linearisation::at_start(&world),
            &by_wires(&world),
            None,
        );
        let start = vec![0.0; system.layout.size];
        let found = find_active_set(&mut system, &[], start, &mut Budget::new(0)).unwrap();
        cut += usize::from(!found.is_found);
        assert_eq!(found.is_found, !violates_branches(&system.rows, &found.x));
        let (x, _) = system.solve(&[]).unwrap();
        assert_eq!(found.x, x);
    }
    assert!(cut > 3, "{cut}");
}

#[test]
fn slack_chains_of_thousands_of_segments_are_stepped_until_they_are_taut() {
    let mut world = World::new(Settings::default()).unwrap();
    let length = 1000.0;
    let route = [0.0, 0.9 * length].map(|x| Stop::Pinned(Point::new(x, 0.0, 0.0)));
    let material = Material::steel(0.02).chain();
    let mut plan = WirePlan::new(material, 0.25, route.to_vec());
    plan.length = Some(length);
    world.add_wire(&plan).unwrap();
    let rng = &mut ChaCha8Rng::seed_from_u64(2);
    for node in &mut world.wires[0].nodes {
        node.velocity = vector(rng, 10.0);
    }
    let mut most = 0;
    for _ in 0..60 {
        most = most.max(world.step(&[]).unwrap().solver.factorisations);
    }
    let pulling = world.wires()[0]
        .segments()
        .iter()
        .filter(|s| s.tension > 0.0);
    assert!(pulling.count() > 500);
    assert!((4..40).contains(&most), "{most}");
}

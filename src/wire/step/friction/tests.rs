use super::super::{anderson, delassus::Delassus};
use super::*;
use crate::query::Point;
use crate::wire::contact::ContactSite;
use crate::wire::step::contact_blocks::Block;
use crate::wire::step::linearisation::Linearisation;
use crate::wire::step::order::by_wires;
use crate::wire::{Material, Stop, WirePlan};

/// A steel wire that lies over the upper half of a drum of radius 1, a contact at each of its
/// nodes.
fn over_a_drum() -> (World, Vec<ContactConstraint>) {
    let mut world = World::new(Settings::default()).unwrap();
    let around = (0..=18).map(|k| (f64::from(k) * 10.0).to_radians());
    let normals: Vec<Vector> = around
        .map(|a| Vector::new(-a.cos(), 0.0, a.sin()))
        .collect();
    let mut route: Vec<Stop> = normals
        .iter()
        .map(|n| Stop::Free(Point::from(*n)))
        .collect();
    route[0] = Stop::Pinned(Point::from(normals[0]));
    route[18] = Stop::Pinned(Point::from(normals[18]));
    let mut plan = WirePlan::new(Material::steel(0.01), 10.0, route);
    plan.velocity = Vector::new(0.5, 0.2, -1.0);
    let wire = world.add_wire(&plan).unwrap();
    let nodes = world.wires[wire.0].nodes.iter().zip(&normals).enumerate();
    let contacts = nodes.map(|(k, (node, &normal))| ContactConstraint {
        key: k as u64,
        a: ContactSite::Wire {
            wire,
            arc: node.arc,
        },
        b: ContactSite::World,
        normal,
        gap: 0.0,
        friction: if k % 3 == 0 { 0.6 } else { 0.2 },
    });
    let contacts = contacts.skip(1).take(17).collect();
    (world, contacts)
}

fn solved(world: &World) -> (System, Vec<f64>) {
    let mut system = System::new(
        world,
        &Linearisation::at_start(world),
        &by_wires(world),
        None,
    );
    system.factor().unwrap();
    let (free, _) = system.solve(&[]).unwrap();
    (system, free)
}

#[test]
fn delassus_velocities_are_those_along_the_paths() {
    let (world, contacts) = over_a_drum();
    let (system, free) = solved(&world);
    let impulses: Vec<Vector> = (0..contacts.len())
        .map(|k| Vector::new(k as f64 - 3.0, 0.5, (k % 5) as f64))
        .collect();
    let mut blocks = Blocks::new(&world, &system, &contacts, &free, &impulses);
    let mut delassus = Delassus::new(&blocks);
    let agree = |blocks: &Blocks, delassus: &Delassus| {
        for (at, block) in blocks.list.iter().enumerate() {
            let velocity = Vector::from_column_slice(&delassus.excess[3 * at..3 * at + 3]);
            let difference = (velocity - block.excess(&blocks.paths)).amax();
            assert!(difference < 1e-10, "{at}: {difference}");
        }
    };
    agree(&blocks, &delassus);
    let change = Vector::new(0.3, -0.2, 0.1);
    let block = &mut blocks.list[5];
    block.impulse += change;
    blocks.paths.push(&block.path, &change);
    delassus.push(5, &change);
    agree(&blocks, &delassus);
}

/// At a solution with friction the best multiple is 1; impulses that are too large are taken back to
/// where they do the least, and those that do no good to nothing.
#[test]
fn impulses_are_scaled_back_to_where_they_take_energy() {
    let (mut world, contacts) = over_a_drum();
    (world.settings.sweeps, world.settings.contact_tolerance) = (100_000, 1e-11);
    let (system, free) = solved(&world);
    let start = vec![Vector::zeros(); contacts.len()];
    let mut blocks = Blocks::new(&world, &system, &contacts, &free, &start);
    Swept::default().repeat(&world.settings, usize::MAX, || blocks.relax());
    let solution: Vec<Vector> = blocks
        .list
        .iter()
        .map(|block| block.frame.tr_mul(&block.impulse))
        .collect();
    let scaled = |factor: f64| {
        let start: Vec<Vector> = solution.iter().map(|impulse| impulse * factor).collect();
        let mut blocks = Blocks::new(&world, &system, &contacts, &free, &start);
        blocks.scale_to_best();
        let excess = blocks.list.iter().map(|block| block.excess(&blocks.paths));
        let excess: Vec<f64> = excess.flat_map(|e| [e.x, e.y, e.z]).collect();
        let gained: f64 = blocks
            .list
            .iter()
            .zip(excess.chunks_exact(3))
            .map(|(block, e)| {
                let mean = (Vector::from_column_slice(e) + block.bias) / 2.0;
                block.impulse.dot(&mean)
            })
            .sum();
        let impulse = blocks.list[3].frame.tr_mul(&blocks.list[3].impulse);
        (impulse.norm() / solution[3].norm(), gained)
    };
    let (kept, gained) = scaled(1.0);
    assert!(
        (kept - 1.0).abs() < 1e-12 && gained < 0.0,
        "{kept} {gained}"
    );
    let (kept, of_large) = scaled(100.0);
    assert!((1.0..2.0).contains(&kept), "{kept}");
    assert!(of_large <= gained, "{of_large} {gained}");
    let (kept, gained) = scaled(-1.0);
    assert_eq!([kept, gained], [0.0, 0.0]);
}

#[test]
fn foretold_sweeps_reach_the_impulses_of_plain_ones_sooner() {
    let (mut world, contacts) = over_a_drum();
    (world.settings.sweeps, world.settings.contact_tolerance) = (100_000, 1e-11);
    let (system, free) = solved(&world);
    let start = vec![Vector::zeros(); contacts.len()];
    let mut plain = Blocks::new(&world, &system, &contacts, &free, &start);
    let mut expected = Swept::default();
    expected.repeat(&world.settings, usize::MAX, || plain.relax());
    let mut blocks = Blocks::new(&world, &system, &contacts, &free, &start);
    let mut swept = Swept::default();
    let mut delassus = Delassus::new(&blocks);
    anderson::sweep(&mut delassus, &mut blocks.list, &world.settings, &mut swept);
    for found in [&expected, &swept] {
        assert!(found.is_converged(&world.settings), "{found:?}");
    }
    let largest = plain
        .list
        .iter()
        .fold(0.0, |a: f64, b| a.max(b.impulse.amax()));
    for (block, expected) in blocks.list.iter().zip(&plain.list) {
        let difference = (block.impulse - expected.impulse).amax();
        assert!(difference < 1e-8 * largest, "{difference} of {largest}");
    }
    // Some stick, some slide: else this shows nothing.
    let pushing = |b: &&Block| b.impulse.x > 0.0;
    let slides = |b: &&Block| b.impulse.yz().norm() > b.friction * b.impulse.x * (1.0 - 1e-9);
    let pushing: Vec<&Block> = plain.list.iter().filter(pushing).collect();
    let sliding = pushing.iter().copied().filter(slides).count();
    println!(
        "{} of 17 push, {sliding} slide; {} sweeps, plain {}",
        pushing.len(),
        swept.sweeps,
        expected.sweeps
    );
    assert!(sliding > 0 && sliding < pushing.len());
    assert!(
        3 * swept.sweeps < expected.sweeps,
        "{} of {}",
        swept.sweeps,
        expected.sweeps
    );
}

//! Contacts in the system, against Coulomb's law itself, and against sweeps.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::query::Point;
use crate::wire::contact::{ContactConstraint, ContactSite};
use crate::wire::step::carrier::Columns;
use crate::wire::step::friction::sweep;
use crate::wire::step::linearisation::Linearisation;
use crate::wire::step::order::{by_least_degree, by_wires};
use crate::wire::step::rows::normal_row;
use crate::wire::step::start::Start;
use crate::wire::{Material, Settings, Stop, Vector, WireId, WirePlan, World};

/// A wire on a floor, dragged and thrown, with a contact at every node; some are loose.
pub(in crate::wire::step) fn dragged(
    rng: &mut ChaCha8Rng,
    material: Material,
    speed: f64,
) -> (World, Vec<ContactConstraint>) {
    let mut world = World::new(Settings::default()).unwrap();
    let mut point = Point::origin();
    let mut route = vec![Stop::Pinned(point)];
    for _ in 0..15 {
        let turn = Vector::from_fn(|_, _| rng.random_range(-0.3..0.3));
        point += Vector::new(0.5, turn.y, 0.0);
        route.push(Stop::Free(point));
    }
    let wire = world
        .add_wire(&WirePlan::new(material, 0.6, route))
        .unwrap();
    let nodes = &mut world.wires[wire.0].nodes;
    for node in &mut nodes[1..] {
        node.velocity = Vector::from_fn(|_, _| rng.random_range(-1.0..1.0) * speed);
    }
    let contacts = nodes[1..]
        .iter()
        .enumerate()
        .map(|(key, node)| ContactConstraint {
            key: key as u64,
            a: ContactSite::Wire {
                wire,
                arc: node.arc,
            },
            b: ContactSite::World,
            normal: Vector::new(0.2 * rng.random_range(-1.0..1.0), 0.0, 1.0).normalize(),
            gap: rng.random_range(-1e-4..1e-3),
            friction: rng.random_range(0.0..1.0),
        });
    let contacts = contacts.collect();
    (world, contacts)
}

/// The same with short wires across, which lie on every other node, and on the floor with both
/// ends.
pub(in crate::wire::step) fn laid_across(
    rng: &mut ChaCha8Rng,
    material: Material,
    speed: f64,
) -> (World, Vec<ContactConstraint>) {
    let (mut world, mut contacts) = dragged(rng, material, speed);
    for at in (1..15).step_by(2) {
        let under = world.wires[0].nodes[at];
        let route = [-1.0, 0.0, 1.0].map(|y| {
            let off = Vector::new(rng.random_range(-0.1..0.1), y, 0.02);
            Stop::Free(under.position + off)
        });
        let plan = WirePlan::new(material, 0.5, route.to_vec());
        let wire = world.add_wire(&plan).unwrap();
        let nodes = &mut world.wires[wire.0].nodes;
        for node in nodes.iter_mut() {
            node.velocity = Vector::from_fn(|_, _| rng.random_range(-1.0..1.0) * speed);
        }
        let arcs: Vec<f64> = nodes.iter().map(|node| node.arc).collect();
        let below = ContactSite::Wire {
            wire: WireId(0),
            arc: under.arc,
        };
        let last = arcs.len() - 1;
        let b = [ContactSite::World, below, ContactSite::World];
        for (arc, b) in [arcs[0], 0.5 * arcs[last], arcs[last]].into_iter().zip(b) {
            contacts.push(ContactConstraint {
                key: contacts.len() as u64,
                a: ContactSite::Wire { wire, arc },
                b,
                normal: Vector::z(),
                gap: rng.random_range(-1e-4..1e-3),
                friction: 0.5,
            });
        }
    }
    (world, contacts)
}

/// What is found from impulses of 0 within a budget.
fn found_with(
    world: &World,
    contacts: &[ContactConstraint],
    budget: &mut Budget,
) -> (System, Option<Solution>) {
    let (order, _) = by_least_degree(world, contacts, usize::MAX).unwrap();
    let mut system = System::new(world, &Linearisation::at_start(world), &order, None);
    let start = Start::of_step(world, contacts);
    system.take(world, contacts, &start, ContactMethod::InMatrix);
    let start = system.start(world);
    let found = solve(&mut system, start, world.settings.contact_tolerance, budget).unwrap();
    (system, found)
}

/// What is found from impulses of 0, and the impulses.
fn found(world: &World, contacts: &[ContactConstraint]) -> (System, Solution, Vec<Vector>) {
    let (system, found) = found_with(world, contacts, &mut Budget::new(usize::MAX));
    let found = found.unwrap();
    assert!(found.is_settled);
    let impulses = found.impulses.clone();
    (system, found, impulses)
}

/// The velocity of place A; B never moves.
fn velocity(world: &World, system: &System, contact: &ContactConstraint, x: &[f64]) -> Vector {
    let carriers = system.layout.place(world, &contact.a).into_iter();
    carriers
        .map(|(carrier, share)| carrier.velocity(x) * share)
        .sum()
}

/// What the impulses alone do to the system without contacts, with the same segments pulling.
fn moved_by(
    system: &mut System,
    world: &World,
    contacts: &[ContactConstraint],
    impulses: &[Vector],
) -> Vec<f64> {
    let mut columns = Vec::new();
    for (contact, impulse) in contacts.iter().zip(impulses) {
        for (carrier, share) in system.layout.place(world, &contact.a) {
            let mut own = Columns::new();
            carrier.columns(&(impulse * share), &mut own);
            columns.extend(own);
        }
    }
    system.release_contacts();
    system.factor().unwrap();
    system.solve(&columns).unwrap().0
}

/// A budget may end the search anywhere: what it has found by then moves as its impulses say, within
/// the residual, these push and take energy, and more of it is never further off.
#[test]
fn solution_of_any_budget_is_one_for_its_prediction() {
    let rng = &mut ChaCha8Rng::seed_from_u64(3);
    let [mut cut, mut nothing] = [0; 2];
    for k in 0..10 {
        let (world, contacts) = dragged(rng, Material::steel(0.01), 1.0);
        let mut last = f64::INFINITY;
        for steps in 0..50 {
            // Up to three million.
            let mut budget = Budget::new(10_000 + 1250 * steps * steps);
            let (mut system, found) = found_with(&world, &contacts, &mut budget);
            let Some(found) = found else {
                assert_eq!(last, f64::INFINITY, "{k}: more found less");
                nothing += 1;
                continue;
            };
            cut += usize::from(!found.is_settled);
            assert!(found.contact_residual <= last, "{k} {steps}");
            last = found.contact_residual;
            let energy = |impulse: &Vector, contact: &ContactConstraint| {
                let push = impulse.dot(&contact.normal);
                let slip = velocity(&world, &system, contact, &found.x);
                (impulse - contact.normal * push).dot(&slip)
            };
            for (contact, impulse) in contacts.iter().zip(&found.impulses) {
                assert!(impulse.dot(&contact.normal) >= -1e-12);
                assert!(energy(impulse, contact) < 1e-2, "{k} {steps}");
            }
            let impulses = found.impulses.clone();
            let moved = moved_by(&mut system, &world, &contacts, &impulses);
            for contact in &contacts {
                let [u, expected] =
                    [&found.x, &moved].map(|x| velocity(&world, &system, contact, x));
                let most = 1e-6 + found.contact_residual;
                assert!((u - expected).amax() < most, "{k} {steps}: {u} {expected}");
            }
        }
        assert!(last <= 1e-8, "{k}: {last}");
    }
    assert!(cut.min(nothing) > 10, "{cut} {nothing}");
}

#[test]
fn contacts_keep_to_coulombs_law_and_their_impulses_are_what_moves_the_wire() {
    let rng = &mut ChaCha8Rng::seed_from_u64(1);
    let [mut apart, mut sticking, mut sliding, mut pushed] = [0; 4];
    for k in 0..200 {
        let material = Material::steel(0.01);
        // A rope pushes with some 20 N at most.
        let rope = Material {
            bend_modulus: 2e5,
            ..material
        };
        let material = [material, material.chain(), rope][k % 3];
        let speed = [1.0, 0.02][k / 3 % 2];
        let (world, contacts) = dragged(rng, material, speed);
        let (mut system, found, impulses) = found(&world, &contacts);
        let buckled = system.rows.iter().filter(|row| row.branch.offset < 0.0);
        pushed += buckled.count();
        assert!(
            found.contact_residual <= 1e-8,
            "{k}: {}",
            found.contact_residual
        );
        for (contact, impulse) in contacts.iter().zip(&impulses) {
            let before = world.wires[0].nodes[contact.key as usize + 1].velocity;
            let speed = before.dot(&contact.normal);
            let [target, sigma] = normal_row(&world.settings, contact, speed);
            let u = velocity(&world, &system, contact, &found.x);
            let (push, excess) = (
                impulse.dot(&contact.normal),
                u.dot(&contact.normal) - target,
            );
            let friction = impulse - contact.normal * push;
            let slip = u - contact.normal * u.dot(&contact.normal);
            let most = contact.friction * push;
            if push == 0.0 {
                assert!(excess > -1e-7, "{k}: {excess}");
                apart += 1;
                continue;
            }
            assert!((excess + sigma * push).abs() < 1e-7, "{k}: {excess}");
            assert!(friction.norm() < most + 1e-7);
            if slip.norm() > 1e-6 {
                assert!((friction + slip.normalize() * most).norm() < 1e-6 * (1.0 + push));
                sliding += 1;
            } else {
                sticking += 1;
            }
        }
        let moved = moved_by(&mut system, &world, &contacts, &impulses);
        for contact in &contacts {
            let [u, expected] = [&found.x, &moved].map(|x| velocity(&world, &system, contact, x));
            assert!((u - expected).amax() < 1e-7, "{k}: {u} {expected}");
        }
    }
    assert!(
        apart.min(sticking).min(sliding).min(pushed) > 100,
        "{apart} {sticking} {sliding} {pushed}"
    );
}

#[test]
fn impulses_are_those_that_sweeps_come_to() {
    let rng = &mut ChaCha8Rng::seed_from_u64(2);
    for k in 0..20 {
        let scene = [dragged, laid_across][k % 2];
        let (mut world, contacts) = scene(rng, Material::steel(0.01), 0.3);
        let (_, _, impulses) = found(&world, &contacts);
        (world.settings.sweeps, world.settings.contact_tolerance) = (100_000, 1e-12);
        let mut system = System::new(
            &world,
            &Linearisation::at_start(&world),
            &by_wires(&world),
            None,
        );
        system.factor().unwrap();
        let (free, _) = system.solve(&[]).unwrap();
        let start = vec![Vector::zeros(); contacts.len()];
        let mut budget = Budget::new(usize::MAX);
        let swept = sweep(&world, &system, &contacts, &free, &start, &mut budget);
        assert!(swept.residual <= 1e-12, "{k}: {}", swept.residual);
        for (impulse, expected) in impulses.iter().zip(&swept.impulses) {
            let difference = (impulse - expected).amax();
            assert!(
                difference < 1e-6 * (1.0 + expected.amax()),
                "{k}: {impulse} {expected}"
            );
        }
    }
}

/// What steps do that go on from each other: each predicts what the last one came to.
#[test]
fn gradients_come_to_the_solution_of_the_matrix() {
    let rng = &mut ChaCha8Rng::seed_from_u64(4);
    let mut solves = Vec::new();
    for k in 0..20 {
        let scene = [dragged, laid_across][k % 2];
        let (world, contacts) = scene(rng, Material::steel(0.01), 0.3);
        let (system, expected, _) = found(&world, &contacts);
        let velocities = |system: &System, x: &[f64]| -> Vec<Vector> {
            let contacts = contacts.iter();
            contacts
                .map(|contact| velocity(&world, system, contact, x))
                .collect()
        };
        let expected = velocities(&system, &expected.x);
        let mut start = Start::of_step(&world, &contacts);
        let tolerance = world.settings.contact_tolerance;
        let mut done = false;
        for solve_number in 1..=20 {
            let mut system = System::new(
                &world,
                &Linearisation::at_start(&world),
                &by_wires(&world),
                None,
            );
            system.take(&world, &contacts, &start, ContactMethod::ByGradients);
            let x = system.start(&world);
            let budget = &mut Budget::new(usize::MAX);
            let found = solve(&mut system, x, tolerance, budget).unwrap().unwrap();
            assert!(found.is_settled && found.factorisations >= 1);
            let off = velocities(&system, &found.x);
            let off = off.iter().zip(&expected).map(|(u, due)| (u - due).amax());
            let off = off.fold(0.0, f64::max);
            if found.contact_residual <= 1e-7 {
                assert!(off < 1e-5, "{k}: {off}");
                solves.push(solve_number);
                done = true;
                break;
            }
            start.impulses = found.impulses;
        }
        assert!(done, "{k}");
    }
    solves.sort_unstable();
    assert!(solves[solves.len() / 2] <= 3, "{solves:?}");
}

/// With too little to spend for one prediction, there is a motion all the same.
#[test]
fn gradients_that_are_cut_short_move_as_their_impulses_say() {
    let rng = &mut ChaCha8Rng::seed_from_u64(5);
    let mut cut = 0;
    for k in 0..20 {
        let (world, contacts) = dragged(rng, Material::steel(0.01), 1.0);
        let mut system = System::new(
            &world,
            &Linearisation::at_start(&world),
            &by_wires(&world),
            None,
        );
        let start = Start::of_step(&world, &contacts);
        system.take(&world, &contacts, &start, ContactMethod::ByGradients);
        let x = system.start(&world);
        let budget = &mut Budget::new(10_000 * k);
        let found = solve(&mut system, x, 1e-8, budget).unwrap();
        let found = found.expect("some motion");
        cut += usize::from(!found.is_settled);
        let laws = contacts.iter().zip(&system.implicit);
        for ((contact, law), impulse) in laws.zip(&found.impulses) {
            let push = impulse.dot(&contact.normal);
            let friction = (impulse - contact.normal * push).norm();
            // As a velocity, which the residual is, but for how far gradients go.
            let over = (friction - contact.friction * push) * law.mobility();
            assert!(
                push >= -1e-12 && over < 1e-9 + (1.0 + 1e-6) * found.contact_residual,
                "{k}: {push} {over} {}",
                found.contact_residual
            );
        }
        let impulses = found.impulses.clone();
        let moved = moved_by(&mut system, &world, &contacts, &impulses);
        for contact in &contacts {
            let [u, expected] = [&found.x, &moved].map(|x| velocity(&world, &system, contact, x));
            let most = 1e-6 + found.contact_residual;
            assert!((u - expected).amax() < most, "{k}: {u} {expected}");
        }
    }
    assert!(cut > 10, "{cut}");
}

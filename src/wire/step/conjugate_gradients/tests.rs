use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::wire::contact::ContactConstraint;
use crate::wire::step::linearisation::Linearisation;
use crate::wire::step::multipliers::tests::{dragged, laid_across};
use crate::wire::step::order::by_wires;
use crate::wire::step::start::Start;
use crate::wire::step::system::ContactMethod;
use crate::wire::{Material, World};

/// The system of a scene with laws linearised at predicted impulses of up to a size, factored.
fn linearised(
    world: &World,
    contacts: &[ContactConstraint],
    impulses: &[Vector],
    method: ContactMethod,
) -> System {
    let mut start = Start::of_step(world, contacts);
    start.impulses = impulses.to_vec();
    let mut system = System::new(
        world,
        &Linearisation::at_start(world),
        &by_wires(world),
        None,
    );
    system.take(world, contacts, &start, method);
    let x = system.start(world);
    for contact in &mut system.implicit {
        contact.linearise(&x, false);
    }
    system.factor().unwrap();
    system
}

fn scenes(mut check: impl FnMut(&World, &[ContactConstraint], &[Vector])) {
    let rng = &mut ChaCha8Rng::seed_from_u64(1);
    for k in 0..40 {
        let scene = [dragged, laid_across][k % 2];
        let material = Material::steel(0.01);
        let material = [material, material.chain()][k / 2 % 2];
        let (world, contacts) = scene(rng, material, 0.3);
        let impulse = |contact: &ContactConstraint| {
            let across = Vector::from_fn(|_, _| rng.random_range(-0.1..0.1));
            contact.normal * rng.random_range(0.0..0.3) + across
        };
        let impulses: Vec<Vector> = contacts.iter().map(impulse).collect();
        check(&world, &contacts, &impulses);
    }
}

#[test]
fn newton_step_is_that_of_the_matrix_with_contacts() {
    let mut reached = 0;
    scenes(|world, contacts, impulses| {
        let direct = linearised(world, contacts, impulses, ContactMethod::InMatrix);
        let expected = direct.estimate();
        let mut system = linearised(world, contacts, impulses, ContactMethod::ByGradients);
        let budget = &mut Budget::new(usize::MAX);
        let x = solve_to(&mut system, 1e-13, 0.0, budget);
        for (contact, other) in system.implicit.iter().zip(&direct.implicit) {
            let [u, due] = [contact.velocity_of(&x), other.velocity_of(&expected)];
            assert!((u - due).amax() < 1e-8, "{u} {due}");
            // The impulse is that of the linearised law, which a velocity determines.
            let law = contact.linearised() + contact.slope() * contact.velocity_missing(&x);
            let off = (contact.solved() - law).amax() * contact.mobility();
            assert!(off < 1e-7, "{off}");
            reached += 1;
        }
        let alike = x
            .iter()
            .zip(&system.estimate())
            .all(|(x, y)| (x - y).abs() < 1e-6 * (1.0 + y.abs()));
        assert!(alike);
    });
    assert!(reached > 500, "{reached}");
}

#[test]
fn what_is_cut_short_ends_within_the_cones_with_no_more_energy_than_without_contacts() {
    let [mut scaled, mut pushing] = [0; 2];
    scenes(|world, contacts, impulses| {
        for iterations in 0..4 {
            let mut system = linearised(world, contacts, impulses, ContactMethod::ByGradients);
            let each = system.multiplications_of_response();
            let budget = &mut Budget::new(each * iterations + 1);
            solve(&mut system, 0.0, budget);
            let x = end_within_cones(&mut system);
            let ended: Vec<Vector> = system.implicit.iter().map(Implicit::solved).collect();
            // Twice the energy that impulses add: their work on what was and on what is.
            let mut work = 0.0;
            let free = under(&mut system, &ended, 0.0);
            for (contact, impulse) in system.implicit.iter().zip(&ended) {
                work += impulse.dot(&contact.excess(impulse, &x));
                work += impulse.dot(&contact.excess(&Vector::zeros(), &free));
            }
            assert!(work < 1e-9, "{work}");
            under(&mut system, &ended, 1.0);
            for (contact, impulse) in system.implicit.iter().zip(&ended) {
                assert!(impulse.x >= 0.0);
                assert!((contact.solved_in_cone() - impulse).amax() < 1e-12);
                pushing += usize::from(impulse.x > 0.0);
            }
            let again = end_within_cones(&mut system);
            let moved = x.iter().zip(&again).any(|(x, y)| (x - y).abs() > 1e-9);
            scaled += usize::from(moved);
        }
    });
    assert!(pushing > 500, "{pushing}");
    assert_eq!(scaled, 0);
}

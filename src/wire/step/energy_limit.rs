//! Keeps a motion whose contacts were not solved from having more energy than there is.
//!
//! Where a search for the impulses of contacts ends far from a solution, nothing bounds the velocities that come of
//! them. So the motion of such an island is slowed until its kinetic energy is at most what there was: kinetic
//! and elastic energy before the step, that of the velocities at which contacts that penetrate are to part, and what
//! gravity and scripted bodies do in it.

use super::carrier::{Carrier, Layout, velocity_of};
use super::rows::normal_row;
use super::solve_step::Candidate;
use crate::wire::world::World;
use crate::wire::{ContactConstraint, Vector};

/// How far from a solution contacts have to be, in impact speeds: a jam in which a search ends nearer is at rest.
const FAR: f64 = 100.0;

/// Slows the motion of an island, given as a world of its own, if contacts' velocities are off by more than [`FAR`] of
/// [`impact_speed`](crate::wire::Settings::impact_speed). `work` is what scripted bodies do, in J.
pub(super) fn slow(
    world: &World,
    layout: &Layout,
    contacts: &[ContactConstraint],
    candidate: &mut Candidate,
    work: impl FnOnce(&Candidate) -> f64,
) {
    let settings = &world.settings;
    if candidate.solver.contact_residual <= FAR * settings.impact_speed {
        return;
    }
    let (kinetic, momentum) = moved(world, layout, &candidate.x);
    let fall = settings.gravity * settings.step;
    let by_gravity = fall.dot(&(world.momentum() + momentum)) / 2.0;
    let before = world.kinetic_energy() + world.energy_of_forces();
    let most = before + parting(world, layout, contacts) + by_gravity + work(candidate);
    let most = most.max(0.0);
    if kinetic > most {
        let scale = (most / kinetic).sqrt();
        candidate.scale(scale);
        candidate.solver.slowed = true;
    }
}

/// The kinetic energy in J of contacts that part as they are asked to, each alone.
fn parting(world: &World, layout: &Layout, contacts: &[ContactConstraint]) -> f64 {
    let masses = masses(world, layout);
    let energies = contacts.iter().map(|contact| {
        let speed = velocity_of(world, &contact.a) - velocity_of(world, &contact.b);
        let [asked, _] = normal_row(&world.settings, contact, speed.dot(&contact.normal));
        let carriers = layout.contact(world, contact).into_iter();
        let mobilities = carriers.map(|(carrier, weight)| match carrier {
            Carrier::Free(first) | Carrier::Body(first, _) => weight * weight / masses[first],
            Carrier::Prescribed(_) => 0.0,
        });
        let mobility: f64 = mobilities.sum();
        if asked > 0.0 && mobility > 0.0 {
            asked * asked / (2.0 * mobility)
        } else {
            0.0
        }
    });
    energies.sum()
}

/// The mass of each unknown that is the first of a velocity, in kg.
fn masses(world: &World, layout: &Layout) -> Vec<f64> {
    let mut masses = vec![0.0; layout.size];
    for (body, first) in world.bodies.iter().zip(&layout.bodies) {
        if let Some(first) = *first {
            masses[first] += body.mass;
        }
    }
    for (wire, &first) in world.wires.iter().zip(&layout.first_node) {
        for node in 0..wire.nodes.len() {
            if let Carrier::Free(at) | Carrier::Body(at, _) = layout.nodes[first + node] {
                masses[at] += wire.node_mass(node);
            }
        }
    }
    masses
}

/// Kinetic energy and momentum of a solution.
fn moved(world: &World, layout: &Layout, x: &[f64]) -> (f64, Vector) {
    let (mut energy, mut momentum) = (0.0, Vector::zeros());
    for (body, first) in world.bodies.iter().zip(&layout.bodies) {
        let Some(first) = *first else { continue };
        let [velocity, spin] = [first, first + 3].map(|at| Carrier::Free(at).velocity(x));
        energy += body.mass * velocity.norm_squared() / 2.0;
        energy += spin.dot(&(body.world_inertia() * spin)) / 2.0;
        momentum += velocity * body.mass;
    }
    for (wire, &first) in world.wires.iter().zip(&layout.first_node) {
        for node in 0..wire.nodes.len() {
            let (mass, velocity) = (wire.node_mass(node), layout.nodes[first + node].velocity(x));
            let slide = layout.slides[first + node].map_or(0.0, |column| x[column]);
            energy += mass * (velocity.norm_squared() + slide * slide) / 2.0;
            momentum += velocity * mass;
        }
    }
    (energy, momentum)
}

#[cfg(test)]
mod tests;

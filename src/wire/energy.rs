//! Energy and momentum of a world.

use super::Vector;
use super::model::{Node, NodeKind, Wire};
use super::vector::unit;
use super::world::World;

/// Energies in J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Energy {
    /// Of motion and rotation.
    pub kinetic: f64,
    /// Of height, against the origin.
    pub potential: f64,
    /// Of stretch, bending and twist.
    pub elastic: f64,
}

impl Energy {
    /// The sum.
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential + self.elastic
    }
}

impl World {
    /// The energies of wires and of bodies that forces move, as everything lies and moves at present. Wire that
    /// is fixed or on scripted bodies counts, too, as sliding and changes of resolution bring it there and away.
    ///
    /// A step moves with the velocity at its end, and a step that ends with a stiff wire stretched
    /// by a hair shows elastic energy that no force has ever given it. What a step came to is in
    /// [`StepRecord::energy`](super::StepRecord::energy).
    pub fn energy(&self) -> Energy {
        Energy {
            kinetic: self.kinetic_energy(),
            potential: self.potential_energy(),
            elastic: self
                .wires
                .iter()
                .map(|wire| elastic(wire, self.settings.step))
                .sum(),
        }
    }

    /// The same halfway through the motion that led here, as [`StepRecord::energy`](super::StepRecord::energy) has it: what
    /// the next record is to be compared with.
    pub fn energy_halfway(&self) -> Energy {
        Energy {
            potential: self.potential_halfway(),
            ..self.energy()
        }
    }

    pub(in crate::wire) fn kinetic_energy(&self) -> f64 {
        let mut energy = 0.0;
        for body in self.bodies.iter().filter(|body| body.dynamic) {
            let spin = body
                .angular_velocity
                .dot(&(body.world_inertia() * body.angular_velocity));
            energy += body.mass * body.velocity.norm_squared() / 2.0 + spin / 2.0;
        }
        for (mass, node) in self.nodes() {
            energy += mass * node.velocity.norm_squared() / 2.0;
        }
        energy + self.wires.iter().map(sliding).sum::<f64>()
    }

    /// The mass in kg of bodies that forces move.
    pub(in crate::wire) fn mass_of_bodies(&self) -> f64 {
        let bodies = self.bodies.iter().filter(|body| body.dynamic);
        bodies.map(|body| body.mass).sum()
    }

    pub(in crate::wire) fn potential_energy(&self) -> f64 {
        let gravity = &self.settings.gravity;
        let bodies = self.bodies.iter().filter(|body| body.dynamic);
        let bodies = bodies.map(|body| body.mass * body.position.coords.dot(gravity));
        let nodes = self.nodes();
        let nodes = nodes.map(|(mass, node)| mass * node.position.coords.dot(gravity));
        -bodies.chain(nodes).sum::<f64>()
    }

    /// The energy in J of the forces that wires have.
    pub(in crate::wire) fn energy_of_forces(&self) -> f64 {
        self.wires
            .iter()
            .map(|wire| of_forces(wire, self.settings.step))
            .sum()
    }

    /// Linear momentum of all that forces move, in N s.
    pub fn momentum(&self) -> Vector {
        let bodies = self.bodies.iter().filter(|body| body.dynamic);
        let of_bodies: Vector = bodies.map(|body| body.velocity * body.mass).sum();
        let nodes = self.moving_nodes();
        of_bodies
            + nodes
                .map(|(mass, node)| node.velocity * mass)
                .sum::<Vector>()
    }

    /// Angular momentum about the origin of all that forces move, in N m s.
    pub fn angular_momentum(&self) -> Vector {
        let bodies = self.bodies.iter().filter(|body| body.dynamic);
        let of_bodies: Vector = bodies
            .map(|body| {
                let orbit = body.position.coords.cross(&body.velocity) * body.mass;
                orbit + body.world_inertia() * body.angular_velocity
            })
            .sum();
        let nodes = self.moving_nodes();
        of_bodies
            + nodes
                .map(|(mass, node)| node.position.coords.cross(&node.velocity) * mass)
                .sum::<Vector>()
    }

    /// Mass and state of every node that forces move: free ones and those on dynamic bodies.
    fn moving_nodes(&self) -> impl Iterator<Item = (f64, &Node)> {
        let moves = |node: &Node| match node.kind.carrier() {
            Some((body, _)) => self.bodies[body.0].dynamic,
            None => node.kind == NodeKind::Free,
        };
        self.nodes().filter(move |(_, node)| moves(node))
    }

    /// Mass and state of every node.
    fn nodes(&self) -> impl Iterator<Item = (f64, &Node)> {
        self.wires.iter().flat_map(|wire| {
            let nodes = wire.nodes.iter().enumerate();
            nodes.map(|(i, node)| (wire.node_mass(i), node))
        })
    }

    /// The potential energy in J halfway through the motion that led here.
    pub(in crate::wire) fn potential_halfway(&self) -> f64 {
        let prescribed = self.carried().map(|(mass, node)| node.velocity * mass);
        let momentum = self.momentum() + prescribed.sum::<Vector>();
        let settings = &self.settings;
        self.potential_energy() + settings.step / 2.0 * settings.gravity.dot(&momentum)
    }

    /// What scripted bodies did in the last step on the wire that they carry, in J: to bring it from the velocities
    /// `before` to its present ones, and against gravity from the middle of the step before to that of the last.
    pub(in crate::wire) fn work_of_carrying(&self, before: &[Vector]) -> f64 {
        let settings = &self.settings;
        let works = self.carried().zip(before).map(|((mass, node), before)| {
            let faster = node.velocity.norm_squared() - before.norm_squared();
            let way = (node.velocity + before) * (settings.step / 2.0);
            mass * (faster / 2.0 - settings.gravity.dot(&way))
        });
        works.sum()
    }

    /// The velocities of the nodes on scripted bodies.
    pub(in crate::wire) fn carried_velocities(&self) -> Vec<Vector> {
        self.carried().map(|(_, node)| node.velocity).collect()
    }

    /// Mass and state of every node on a scripted body.
    fn carried(&self) -> impl Iterator<Item = (f64, &Node)> {
        let is_carried = |node: &Node| match node.kind.carrier() {
            Some((body, _)) => !self.bodies[body.0].dynamic,
            None => false,
        };
        self.nodes().filter(move |(_, node)| is_carried(node))
    }
}

/// Of the wire that slides over contact nodes, beside what it has by their motion.
fn sliding(wire: &Wire) -> f64 {
    let nodes = wire.nodes.iter().enumerate();
    let slides = nodes.filter(|(_, node)| node.slide != 0.0);
    slides
        .map(|(i, node)| wire.node_mass(i) * node.slide * node.slide / 2.0)
        .sum()
}

/// Of every segment the lesser of `T^2 / (2 k)` with the tension of the last step and `k g^2 / 2` as it lies: what damping
/// added to a force is no energy, nor is a hair of which there was no force. Bending and twist are as the wire lies.
fn of_forces(wire: &Wire, step: f64) -> f64 {
    let push = wire.largest_push(step);
    let segments = wire.segments.iter().enumerate();
    let stretch = segments.map(|(at, segment)| {
        let rest = wire.rest_length(at);
        let stiffness = wire.material.stretch_stiffness() / rest;
        let longer = wire.span(at).norm() - rest;
        let beyond = buckled(wire, at, longer, push);
        let elastic = stiffness * (longer.abs() - beyond);
        let force = segment.tension.abs().min(elastic);
        force * force / (2.0 * stiffness) + push * beyond
    });
    let bends = (1..wire.segments.len()).map(|node| bending(wire, node));
    stretch.sum::<f64>() + bends.sum::<f64>() + wire.twist_energy()
}

/// `g^2 / (2 eps)` of every row of stretch, bend and twist. What a segment that has buckled is shorter than that it is at
/// the force at which it buckles, none for a chain.
fn elastic(wire: &Wire, step: f64) -> f64 {
    let material = &wire.material;
    let push = wire.largest_push(step);
    let mut energy = 0.0;
    for segment in 0..wire.segments.len() {
        let rest = wire.rest_length(segment);
        let longer = wire.span(segment).norm() - rest;
        let beyond = buckled(wire, segment, longer, push);
        let elastic = longer.abs() - beyond;
        energy += elastic * elastic * material.stretch_stiffness() / (2.0 * rest);
        energy += push * beyond;
        if segment > 0 {
            energy += bending(wire, segment);
        }
    }
    energy + wire.twist_energy()
}

/// By how much a segment that is `longer` than unstretched, or shorter where that is negative, is shorter than where it
/// buckles under its largest push, in m.
fn buckled(wire: &Wire, segment: usize, longer: f64, push: f64) -> f64 {
    let rest = wire.rest_length(segment);
    let strain = push / wire.material.stretch_stiffness();
    (-longer - strain * rest).max(0.0)
}

/// Of bending at a node, 0 for a chain.
fn bending(wire: &Wire, node: usize) -> f64 {
    let [(before, _), (after, _)] = [node - 1, node].map(|segment| unit(&wire.span(segment)));
    let mean = (wire.rest_length(node - 1) + wire.rest_length(node)) / 2.0;
    (after - before).norm_squared() * wire.material.bend_stiffness() / (2.0 * mean)
}

#[cfg(test)]
mod tests;

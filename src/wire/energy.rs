//! Energy and momentum of a world.

use super::Vector;
use super::model::{Node, NodeKind, Wire};
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
    /// The energies of all that forces move, as everything lies and moves at present. Nodes that are
    /// fixed do not count, those on dynamic bodies do, and so does what slides over contact nodes.
    ///
    /// A step moves with the velocity at its end, and a step that ends with a stiff wire stretched
    /// by a hair shows elastic energy that no force has ever given it. What a step came to is in
    /// [`StepRecord::energy`](super::StepRecord::energy).
    pub fn energy(&self) -> Energy {
        Energy {
            kinetic: self.kinetic_energy(),
            potential: self.potential_energy(),
            elastic: self.wires.iter().map(elastic).sum(),
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
        for (mass, node) in self.moving_nodes() {
            energy += mass * node.velocity.norm_squared() / 2.0;
        }
        energy + self.wires.iter().map(sliding).sum::<f64>()
    }

    pub(in crate::wire) fn potential_energy(&self) -> f64 {
        let gravity = &self.settings.gravity;
        let bodies = self.bodies.iter().filter(|body| body.dynamic);
        let bodies = bodies.map(|body| body.mass * body.position.coords.dot(gravity));
        let nodes = self.moving_nodes();
        let nodes = nodes.map(|(mass, node)| mass * node.position.coords.dot(gravity));
        -bodies.chain(nodes).sum::<f64>()
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
        let nodes = self.wires.iter().flat_map(|wire| {
            let nodes = wire.nodes.iter().enumerate();
            nodes.map(|(i, node)| (wire.node_mass(i), node))
        });
        nodes.filter(move |(_, node)| moves(node))
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

/// `g^2 / (2 eps)` of every row: stretch, which a chain has only where it is longer than
/// unstretched, bend and twist.
fn elastic(wire: &Wire) -> f64 {
    let material = &wire.material;
    let direction = |segment: usize| {
        let span = wire.span(segment);
        span / span.norm().max(f64::MIN_POSITIVE)
    };
    let mut energy = 0.0;
    for segment in 0..wire.segments.len() {
        let rest = wire.rest_length(segment);
        let longer = wire.span(segment).norm() - rest;
        if longer > 0.0 || !material.is_chain() {
            energy += longer * longer * material.stretch_stiffness() / (2.0 * rest);
        }
        if segment > 0 && !material.is_chain() {
            let mean = (wire.rest_length(segment - 1) + rest) / 2.0;
            let turn = direction(segment) - direction(segment - 1);
            energy += turn.norm_squared() * material.bend_stiffness() / (2.0 * mean);
        }
    }
    energy + wire.twist_energy()
}

//! Twist of a wire as a whole.
//!
//! Waves of twist run at `sqrt(G / rho)`, 3 km/s in steel, so a step finds them gone: twist is spread
//! evenly, and a wire has one torque, `G J Theta / l`. `Theta` is the angle between two directions
//! across the wire: that which the last clamp holds, and that which the first clamp holds, carried
//! along the wire from segment to segment by the least rotations (Bergou et al., "Discrete elastic
//! rods", ACM Transactions on Graphics 27, 2008). It is measured up to whole turns. These are counted
//! by following it from step to step.

use std::f64::consts::TAU;

use super::model::wire::Clamp;
use super::model::{Body, Node, NodeKind, Wire};
use super::vector::{Vector, frame, unit};
use super::world::World;

/// `1 + cos` of the sharpest bend, 172 degrees, whose torque is that of the twist. At sharper ones it
/// is less, and 0 for a wire that is folded flat onto itself.
const SHARPEST: f64 = 1e-2;

/// The twist of a wire where it lies at present, and what changes it.
#[derive(Clone, Debug)]
pub(in crate::wire) struct Torsion {
    /// Up to whole turns, in rad.
    pub(in crate::wire) angle: f64,
    /// By the position of each node, in rad/m.
    pub(in crate::wire) gradient: Vec<Vector>,
    /// Of both ends: what clamps it, and by which part of its angular velocity the twist changes.
    pub(in crate::wire) ends: [(Clamp, Vector); 2],
}

impl Torsion {
    /// Of a wire beside these bodies, if it holds twist.
    pub(in crate::wire) fn of(wire: &Wire, bodies: &[Body]) -> Option<Self> {
        let clamps = wire.clamps()?;
        let spans = (0..wire.segments.len()).map(|segment| unit(&wire.span(segment)));
        let spans: Vec<(Vector, f64)> = spans.collect();
        let last = spans.len() - 1;
        let ends = [(clamps[0], -spans[0].0), (clamps[1], spans[last].0)];
        let carried = carried(&held(clamps[0], bodies, &wire.nodes[..2]), &spans);
        let due = held(clamps[1], bodies, &wire.nodes[last..]);
        let sine = spans[last].0.dot(&carried.cross(&due));
        Some(Torsion {
            angle: libm::atan2(sine, carried.dot(&due)),
            gradient: gradient(&spans),
            ends,
        })
    }

    /// How fast the twist of a wire changes that moves at the velocities that it has, in rad/s.
    pub(in crate::wire) fn rate(&self, wire: &Wire, bodies: &[Body]) -> f64 {
        let nodes = self.gradient.iter().zip(&wire.nodes);
        let of_nodes = nodes.fold(0.0, |sum, (by, node)| sum + by.dot(&node.velocity));
        self.ends.iter().fold(of_nodes, |sum, (clamp, by)| {
            sum + match *clamp {
                Clamp::World => 0.0,
                Clamp::Body(body) => by.dot(&bodies[body.0].angular_velocity),
            }
        })
    }
}

/// A direction across a clamped segment, given by its two nodes, that stays as it is in what clamps it.
fn held(clamp: Clamp, bodies: &[Body], nodes: &[Node]) -> Vector {
    let local = |node: &Node| match node.kind {
        NodeKind::Eye { local, .. } => local,
        _ => node.position.coords,
    };
    let (along, _) = unit(&(local(&nodes[1]) - local(&nodes[0])));
    let across = frame(&along).row(1).transpose();
    match clamp {
        Clamp::World => across,
        Clamp::Body(body) => bodies[body.0].arm(&across),
    }
}

/// A direction across the first segment, carried to the last one. Segments without length are passed
/// over.
fn carried(first: &Vector, spans: &[(Vector, f64)]) -> Vector {
    let (mut direction, mut before) = (*first, spans[0].0);
    for (along, _) in spans.iter().filter(|(_, length)| *length > 0.0) {
        // Of what is across one segment, the least rotation to the next is a reflection.
        let (halfway, _) = unit(&(before + along));
        direction -= halfway * (2.0 * halfway.dot(&direction));
        before = *along;
    }
    direction
}

/// How the twist changes with the position of each node: by half of the curvature binormal `2 t1 x t2 /
/// (1 + t1 . t2)` for each turn of a segment beside it.
fn gradient(spans: &[(Vector, f64)]) -> Vec<Vector> {
    let mut gradient = vec![Vector::zeros(); spans.len() + 1];
    for (at, two) in spans.windows(2).enumerate() {
        let [(t1, l1), (t2, l2)] = [two[0], two[1]];
        if l1 > 0.0 && l2 > 0.0 {
            let half = t1.cross(&t2) / (1.0 + t1.dot(&t2)).max(SHARPEST);
            let [before, after] = [half / l1, half / l2];
            gradient[at] -= before;
            gradient[at + 1] += before - after;
            gradient[at + 2] += after;
        }
    }
    gradient
}

/// An angle less whole turns, as near to 0 as may be.
fn less_turns(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// The twist of every wire of a world; none of those that hold none.
pub(in crate::wire) fn torsions(world: &World) -> Vec<Option<Torsion>> {
    let wires = world.wires.iter();
    wires.map(|wire| Torsion::of(wire, &world.bodies)).collect()
}

/// Follows the twist of every wire through the motion of a step, which has been made with the
/// velocities that all have now. How far the twist went is known up to whole turns, and by its rate
/// roughly, so bodies may turn more than once in a step.
pub(in crate::wire) fn follow_motion(world: &mut World, before: &[Option<Torsion>]) {
    for (wire, before) in world.wires.iter_mut().zip(before) {
        let after = Torsion::of(wire, &world.bodies);
        if let (Some(before), Some(after)) = (before, after) {
            let about = before.rate(wire, &world.bodies) * world.settings.step;
            wire.twist += about + less_turns(after.angle - before.angle - about);
        }
    }
}

/// Follows it through changes of resolution: they bend the wire as a motion does.
pub(in crate::wire) fn follow_changes(world: &mut World, before: &[Option<Torsion>]) {
    for (wire, before) in world.wires.iter_mut().zip(before) {
        let after = Torsion::of(wire, &world.bodies);
        if let (Some(before), Some(after)) = (before, after) {
            wire.twist += less_turns(after.angle - before.angle);
        }
    }
}

#[cfg(test)]
mod tests;

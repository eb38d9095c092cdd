//! Twist of a wire as a whole.
//!
//! Waves of twist run at `sqrt(G / rho)`, 3 km/s in steel, so a step finds them gone: twist is spread
//! evenly, and a wire has one torque, `G J Theta / l`. `Theta` is the angle between two directions
//! across the wire: that which the last clamp holds, and that which the first clamp holds, carried
//! along the wire from segment to segment by the least rotations (Bergou et al., "Discrete elastic
//! rods", ACM Transactions on Graphics 27, 2008). It is measured up to whole turns. These are counted
//! by following it from step to step.
//!
//! How far it goes in a motion is the sum of areas on the sphere of directions: each two segments in a
//! row have two directions there, and the shortest way between them sweeps an area as both turn. That
//! is how far what is carried from one to the other falls behind (Gauss and Bonnet), whole turns
//! included.

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
    /// The direction and the length in m of each segment.
    spans: Vec<(Vector, f64)>,
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
            spans,
        })
    }

    /// How fast the twist of a wire changes that moves at the velocities that it has, in rad/s.
    pub(in crate::wire) fn rate(&self, wire: &Wire, bodies: &[Body]) -> f64 {
        let nodes = self.gradient.iter().zip(&wire.nodes);
        let of_nodes = nodes.fold(0.0, |sum, (by, node)| sum + by.dot(&node.velocity));
        of_nodes + self.rate_of_ends(bodies)
    }

    /// The part of the rate that is of what clamps the ends, in rad/s.
    fn rate_of_ends(&self, bodies: &[Body]) -> f64 {
        let of_ends = self.ends.iter().map(|(clamp, by)| match *clamp {
            Clamp::World => 0.0,
            Clamp::Body(body) => by.dot(&bodies[body.0].angular_velocity),
        });
        of_ends.sum()
    }

    /// How far the twist goes as all nodes go straight to where another one is of, but for what clamps
    /// the ends, in rad.
    fn swept(&self, to: &Torsion) -> f64 {
        let spans = self.spans.iter().zip(&to.spans);
        let mut paths = spans.filter(|(from, to)| from.1 > 0.0 && to.1 > 0.0);
        let Some(mut last) = paths.next() else {
            return 0.0;
        };
        let mut sum = 0.0;
        for path in paths {
            let at = |(direction, length): &(Vector, f64)| direction * *length;
            sum += swept(
                [at(last.0), at(path.0)],
                [at(last.1), at(path.1)],
                MOST_HALVINGS,
            );
            last = path;
        }
        sum
    }
}

/// The area that the shortest way from one direction to another one sweeps on the sphere as both spans
/// go straight from one pair to the next.
///
/// Ends: each call halves the motion, and has one halving less.
fn swept(from: [Vector; 2], to: [Vector; 2], halvings: u32) -> f64 {
    let directions = [from[0], from[1], to[1], to[0]].map(|span| unit(&span).0);
    let [a, b, c, d] = directions;
    if halvings > 0 && (d - a).norm().max((c - b).norm()) > FAR {
        let halfway = [0, 1].map(|i| (from[i] + to[i]) / 2.0);
        return swept(from, halfway, halvings - 1) + swept(halfway, to, halvings - 1);
    }
    triangle(&a, &b, &c) + triangle(&a, &c, &d)
}

/// The area of a triangle on the sphere, above 0 if its corners come counterclockwise, seen from outside
/// (A. van Oosterom and J. Strackee, "The solid angle of a plane triangle", IEEE Transactions on
/// Biomedical Engineering 30, 1983).
fn triangle(a: &Vector, b: &Vector, c: &Vector) -> f64 {
    let above = 1.0 + a.dot(b) + b.dot(c) + c.dot(a);
    2.0 * libm::atan2(a.dot(&b.cross(c)), above)
}

/// Motions in which a direction goes farther are halved: the length of the chord.
const FAR: f64 = 0.25;

/// How often a motion is halved at most.
const MOST_HALVINGS: u32 = 10;

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
/// velocities that all have now. How far the twist went is known up to whole turns. The areas that are
/// swept and the rate of what clamps the ends tell these, so bodies may turn more than once in a step.
pub(in crate::wire) fn follow_motion(world: &mut World, before: &[Option<Torsion>]) {
    for (wire, before) in world.wires.iter_mut().zip(before) {
        let after = Torsion::of(wire, &world.bodies);
        if let (Some(before), Some(after)) = (before, after) {
            let of_ends = before.rate_of_ends(&world.bodies) * world.settings.step;
            let about = before.swept(&after) + of_ends;
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

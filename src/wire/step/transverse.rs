//! What keeps a step stable beside segments that are too short for their tension.
//!
//! A row of stretch pulls along the segment as it lies where the step starts. Across the segment
//! its tension `T` is therefore an explicit force. Moved by `d`, the ends of a segment of length
//! `l` push back with `T/l P d`, where `P` takes the part across the segment. Let `K` be the sum of
//! these stiffnesses. A step that moves with the velocities of its end is stable as long as `h^2 K <
//! 4 M`. It is enough that this holds for each segment by itself (Irons and Treharne 1971), and a
//! segment with half of its mass `m` at each end has `h^2 T/l < m`: no wave crosses it in a step.
//!
//! Beside segments for which that does not hold with a margin `s`, a step is
//!
//! ```text
//! (M + W) v+ = M v + h f,   W = h^4 / (32 s^4) K M^-1 K
//! ```
//!
//! where `K` and `M` are those of these segments alone. Such a step is stable where `h^2 K < 4 M + 2
//! W`. With `A = h^2 M^-1/2 K M^-1/2` that holds for every tension up to `T / s^2`, since `4 + A^2 /
//! 16 s^4 - A / s^2 = (2 - A / 4 s^2)^2` is nowhere below 0. `W` is a sum over nodes of `m |u|^2` with
//!
//! ```text
//! u = h^2 / (sqrt(32) s^2 m) (K v)_node
//! ```
//!
//! so it is zero for whatever swings as one line: a straight wire, and a load at its end. A mode of
//! the wire itself loses the part `(omega h)^4 / (64 s^4)` of its amplitude in a step: nothing of what
//! a step follows well, and quickly what it cannot follow. (Implicit Euler, with `h^2 K` in place
//! of `W`, takes `(omega h)^2 / 2`, from a load that swings as well.) With `W v` on the right side,
//! too, nothing would be damped, but a chain that whirls faster than a step can follow gains energy.
//!
//! A node on a body counts with the mass that the body has there, at least: what its mobility at the
//! place leaves, shared by all nodes on it; one that wires pull on more than a step can follow has [inertias of its
//! own](super::body_inertia). A segment between two bodies that are heavy enough for it needs nothing, whatever it weighs
//! itself. A node whose motion is prescribed needs nothing. Nor does a
//! segment between two places of one body: it turns with the body, on which it pulls along one line,
//! so that there is nothing to push back. (With it, a block over which a rope is hauled turned
//! against a torque that grew with the step, and the rope slid over it instead.)
//!
//! `W` grows with the square of `K`, and so does what it adds to a mode far beyond what a step can
//! follow: that comes to rest by the part `32 s^4 / A` in a step, which is slow. Segments for which `h^2
//! T / (l s^2)` is more than [`STEEPEST`] times the mass at an end are *steep*. With `K_s = h^2 K / s^2` of
//! these alone they have
//!
//! ```text
//! W = K_s (c M + K_s)^-1 K_s,   c = 12 + 8 sqrt(2)
//! ```
//!
//! It is zero for what swings as one line, too. It takes the part `B^2 / 2 c` of what a step follows
//! well, where `B = M^-1/2 K_s M^-1/2`. What is far beyond goes by the part `s^2` of its way to rest in
//! each step. That is stable as well: `4 + 2 B^2 / (c + B) >= B` is `B^2 + (4 - c) B + 4 c >= 0`, and `c`
//! is the largest number with that. No inverse is put into a matrix: `W v = K_s z` with three more
//! unknowns `z` for each node, for which `K_s v = (c M + K_s) z`. They are scaled so that an unknown is
//! an impulse and its row a velocity.
//!
//! `T` is the largest tension of the last steps, by which resolution is chosen too. The margin is the
//! room for what it grows to in this one; where that is not enough, `T` is what it grows to
//! ([`linearisation`](super::linearisation)).

use nalgebra::Matrix3;
use smallvec::SmallVec;

use super::inertia_term::{FOLLOWED, InertiaTerm};
use super::linearisation::Linearisation;
use crate::wire::model::{Body, BodyId, NodeKind, Wire};
use crate::wire::vector::{Vector, unit};
use crate::wire::world::World;

/// The largest `h^2 T / (l s^2)` over the mass of an end of a segment that is not steep.
const STEEPEST: f64 = 500.0;

/// What there is at segments that are too short.
#[derive(Default)]
pub(super) struct TransverseInertias {
    /// At nodes beside those that are not steep.
    pub(super) short: Vec<InertiaTerm>,
    /// Segments that are steep.
    pub(super) steep: Vec<SteepSegment>,
    /// Ends of these that can move.
    pub(super) nodes: Vec<SteepNode>,
}

/// What a steep segment gives to `K_s`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SteepSegment {
    /// The wire.
    pub(super) wire: usize,
    /// Which of its segments.
    pub(super) segment: usize,
    /// `h^2 T / (l s^2) P` in kg.
    pub(super) stiffness: Matrix3<f64>,
}

/// A node with a mass beside steep segments.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct SteepNode {
    /// The wire.
    pub(super) wire: usize,
    /// Which of its nodes.
    pub(super) node: usize,
    /// `c` times its mass, in kg.
    pub(super) followed: f64,
    /// The sum of `h^2 T / (l s^2)` of these segments, in kg.
    pub(super) needed: f64,
}

/// The inertias of a world in its next step. `is_held` says of each body whether it has [inertias of its own](super::body_inertia), so
/// that nodes on it need none.
pub(super) fn transverse_inertias(
    world: &World,
    linearisation: &Linearisation,
    is_held: &[bool],
) -> TransverseInertias {
    let mut all = TransverseInertias::default();
    let masses = Masses {
        world,
        counts: nodes_on_bodies(world),
        is_held,
    };
    for (at, wire) in world.wires.iter().enumerate() {
        // That of the segment before the node.
        let mut before: Option<Short> = None;
        for node in 0..wire.nodes.len() {
            let short = (node < wire.segments.len()).then(|| {
                let tension = linearisation.of(at, node).tension;
                Short::new(world, wire, node, tension)
            });
            let short = short.flatten();
            let mut after = short.filter(|short| !masses.are_enough(at, node, short));
            if let Some(short) = &mut after {
                let ends = [node, node + 1].map(|node| masses.of(at, node, short.half));
                short.is_steep = short.needed > STEEPEST * ends[0].min(ends[1]);
                if short.is_steep {
                    all.steep.push(SteepSegment {
                        wire: at,
                        segment: node,
                        stiffness: short.across * short.needed,
                    });
                }
            }
            all.add_node(&masses, at, node, [before, after]);
            before = after;
        }
    }
    all
}

impl TransverseInertias {
    /// Adds what acts at a node with these segments before and after it.
    fn add_node(&mut self, masses: &Masses, wire: usize, node: usize, sides: [Option<Short>; 2]) {
        let of_kind =
            |is_steep: bool| sides.map(|side| side.filter(|short| short.is_steep == is_steep));
        let [short, steep] = [false, true].map(of_kind);
        let is_there = |sides: &[Option<Short>; 2]| sides.iter().any(Option::is_some);
        let is_free = masses.world.wires[wire].nodes[node].kind == NodeKind::Free;
        // What a body has there is shared by both kinds.
        let is_shared = !is_free && is_there(&short) && is_there(&steep);
        let mass = |sides: &[Option<Short>; 2]| {
            let half = sides.iter().flatten().map(|short| short.half).sum();
            let mass = masses.of(wire, node, half);
            if is_shared { mass / 2.0 } else { mass }
        };
        let moves = |sides: &[Option<Short>; 2]| is_there(sides) && mass(sides).is_finite();
        if moves(&short) {
            self.short.push(of_node(wire, node, mass(&short), short));
        }
        if moves(&steep) {
            self.nodes.push(SteepNode {
                wire,
                node,
                followed: FOLLOWED * mass(&steep),
                needed: steep.iter().flatten().map(|short| short.needed).sum(),
            });
        }
    }
}

/// A segment that is too short for its tension.
#[derive(Clone, Copy, Debug)]
struct Short {
    /// `P`.
    across: Matrix3<f64>,
    /// `h^2 T / (l s^2)` in kg.
    needed: f64,
    /// Half of its mass in kg.
    half: f64,
    is_steep: bool,
}

impl Short {
    /// None if the segment is long enough, or has no direction, or is between two places of one body.
    fn new(world: &World, wire: &Wire, segment: usize, tension: f64) -> Option<Short> {
        let (t, length) = unit(&wire.span(segment));
        let bodies = [segment, segment + 1].map(|node| wire.nodes[node].kind.carrier());
        let is_on_one = matches!(bodies, [Some((one, _)), Some((other, _))] if one == other);
        if length <= 0.0 || is_on_one {
            return None;
        }
        let reach = world.settings.step / world.settings.stability_margin;
        let short = Short {
            across: Matrix3::identity() - t * t.transpose(),
            needed: reach * reach * tension / length,
            half: wire.material.mass_per_length() * wire.rest_length(segment) / 2.0,
            is_steep: false,
        };
        (short.needed > 2.0 * short.half).then_some(short)
    }
}

/// Whether a segment is too short for a tension in N.
pub(super) fn is_short(world: &World, wire: usize, segment: usize, tension: f64) -> bool {
    Short::new(world, &world.wires[wire], segment, tension).is_some()
}

/// `u = h^2 / (sqrt(32) s^2 m) (K v)_node`.
fn of_node(
    wire: usize,
    node: usize,
    mass: f64,
    [before, after]: [Option<Short>; 2],
) -> InertiaTerm {
    let mut nodes = SmallVec::new();
    let mut own = Matrix3::zeros();
    let before = before.map(|short| (node - 1, short));
    for (neighbour, short) in before
        .into_iter()
        .chain(after.map(|short| (node + 1, short)))
    {
        let part = short.across * (short.needed / (32f64.sqrt() * mass));
        own += part;
        nodes.push((wire, neighbour, -part));
    }
    nodes.push((wire, node, own));
    InertiaTerm {
        mass,
        nodes,
        body: None,
    }
}

/// What there is at nodes against what pushes them back across segments.
struct Masses<'a> {
    world: &'a World,
    /// How many nodes there are on each body.
    counts: Vec<f64>,
    /// By bodies: whether nodes on it need nothing.
    is_held: &'a [bool],
}

impl Masses<'_> {
    /// Whether a segment that is too short for what it has itself is between bodies, or a body and a place whose
    /// motion is prescribed, that have enough: `h^2 T/l (1/m + 1/m') < 4` with the margin.
    fn are_enough(&self, wire: usize, segment: usize, short: &Short) -> bool {
        let ends = [segment, segment + 1];
        let is_free = |node: &usize| self.world.wires[wire].nodes[*node].kind == NodeKind::Free;
        let mobilities = ends.map(|node| 1.0 / self.of(wire, node, short.half));
        !ends.iter().any(is_free) && short.needed * (mobilities[0] + mobilities[1]) < 4.0
    }

    /// The mass in kg of a node of which `half` is on segments that are too short; infinite if it needs
    /// nothing, or its motion is prescribed.
    fn of(&self, wire: usize, node: usize, half: f64) -> f64 {
        let kind = self.world.wires[wire].nodes[node].kind;
        match kind.carrier() {
            _ if kind == NodeKind::Free => half,
            Some((body, local)) if self.world.bodies[body.0].dynamic && !self.is_held[body.0] => {
                mass_at(&self.world.bodies[body.0], &local) / self.counts[body.0]
            }
            _ => f64::INFINITY,
        }
    }
}

/// How many nodes there are on each body.
fn nodes_on_bodies(world: &World) -> Vec<f64> {
    let mut counts = vec![0.0; world.bodies.len()];
    let nodes = world.wires.iter().flat_map(|wire| &wire.nodes);
    for (BodyId(body), _) in nodes.filter_map(|node| node.kind.carrier()) {
        counts[body] += 1.0;
    }
    counts
}

/// A mass in kg, so that `mass v^2 <= V^T M V` for every motion `V` of a body and the velocity `v`
/// of its place.
fn mass_at(body: &Body, local: &Vector) -> f64 {
    // The trace of a positive matrix is at least its largest eigenvalue.
    let turning = body
        .inertia
        .try_inverse()
        .map_or(f64::INFINITY, |m| m.trace());
    1.0 / (1.0 / body.mass + local.norm_squared() * turning)
}

#[cfg(test)]
mod tests;

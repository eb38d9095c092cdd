//! Resolution that follows tension.
//!
//! Waves across a wire under tension `T` run at `sqrt(T/mu)`; the step is stable as long as they do
//! not cross a segment in less than `h`. So nodes are taken out where segments are shorter than
//! `l_min = max(l_user, h sqrt(T/mu) / margin)` with the largest `T` of the last
//! [`TENSION_HISTORY`] steps, and put in where they are longer than a multiple of it. At one node
//! at least [`TENSION_HISTORY`] steps lie between two changes.
//!
//! A node stays at which a wire is folded that resists being pressed together.
//!
//! Where wires push on each other they have to bend: there tension does not count, `l_min =
//! l_user`. The step keeps segments stable that are too short for their tension
//! (`step/transverse.rs`).

use super::model::wire::{Clamp, TENSION_HISTORY};
use super::model::{Body, BodyId, Node, NodeKind, Segment, Wire, WireId};
use super::vector::{Vector, unit};
use super::world::World;
use crate::query::Point;

/// A change of resolution, as the motion that it is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Remesh {
    /// The wire.
    pub wire: WireId,
    /// Whether the node in the middle is taken out or put in.
    pub kind: RemeshKind,
    /// The nodes before, in and after the middle. The wire sweeps this triangle. For a node put in
    /// it is as flat as rounding allows, but for a contact node that is put onto the surface of its body.
    pub triangle: [Point; 3],
    /// Their arc lengths in m.
    pub arcs: [f64; 3],
}

/// What happens to a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum RemeshKind {
    /// It is taken out.
    Merge,
    /// It is put in.
    Split,
}

/// May refuse a change of resolution, for example because its motion meets something.
pub trait RemeshGuard {
    /// Whether the change may be made now. One that is refused is tried again in the next step.
    fn permits(&mut self, world: &World, change: &Remesh) -> bool;

    /// Whether a wire has to bend between two of its arc lengths in m, so that tension must not
    /// make its segments long there. Usually not.
    fn needs_fine_resolution(&self, _wire: WireId, _from: f64, _to: f64) -> bool {
        false
    }
}

impl<F: FnMut(&World, &Remesh) -> bool> RemeshGuard for F {
    fn permits(&mut self, world: &World, change: &Remesh) -> bool {
        self(world, change)
    }
}

/// Permits every change.
pub(super) struct Permit;

impl RemeshGuard for Permit {
    fn permits(&mut self, _world: &World, _change: &Remesh) -> bool {
        true
    }
}

/// Changes the resolution of every adaptive wire where its tension asks for it and `guard` permits
/// it. A wire that does not adapt keeps its resolution as it slides: nodes that come to a contact
/// node are taken out, and nodes are put in on the other side.
pub(super) fn adapt(world: &mut World, guard: &mut dyn RemeshGuard) -> Vec<Remesh> {
    let mut changes = Vec::new();
    for wire in 0..world.wires.len() {
        if world.wires[wire].resolution.adaptive || slides(&world.wires[wire]) {
            merge(world, wire, guard, &mut changes);
            split(world, wire, guard, &mut changes);
        }
    }
    changes
}

/// The shortest segment wanted on a stretch of segments, in m: under the largest tension that the
/// first and the last remember, unless the wire has to bend there.
fn wanted(world: &World, at: usize, [first, last]: [usize; 2], guard: &dyn RemeshGuard) -> f64 {
    let wire = &world.wires[at];
    if !wire.resolution.adaptive {
        return wire.resolution.length;
    }
    let tension = [first, last].map(|segment| wire.segments[segment].largest_tension());
    let stable = world
        .settings
        .shortest_stable(tension[0].max(tension[1]), wire.material.mass_per_length());
    let (from, to) = (wire.nodes[first].arc, wire.nodes[last + 1].arc);
    // Contacts are looked through only where tension asks for more.
    if stable > wire.resolution.length && !guard.needs_fine_resolution(WireId(at), from, to) {
        stable
    } else {
        wire.resolution.length
    }
}

fn merge(world: &mut World, at: usize, guard: &mut dyn RemeshGuard, changes: &mut Vec<Remesh>) {
    // A segment as long as wanted may be shorter by the rounding of arc lengths.
    const ROUNDING: f64 = 1e-9;
    let mut node = 1;
    while node + 1 < world.wires[at].nodes.len() {
        let wire = &world.wires[at];
        let this = &wire.nodes[node];
        let length = wire.rest_length(node - 1).min(wire.rest_length(node));
        let wanted = wanted(world, at, [node - 1, node], guard);
        let short = length < wanted * (1.0 - ROUNDING);
        let may_change =
            wire.resolution.adaptive && this.remesh_from <= world.steps && !is_folded(wire, node);
        let is_used_up = is_used_up(world, at, node, wanted);
        let is_asked = is_used_up || may_change && short;
        if this.kind == NodeKind::Free
            && is_asked
            && let Some(change) = try_take_out(world, at, node, guard)
        {
            changes.push(change);
            if is_used_up {
                // The next node may have to follow, on either side.
                node = (node - 1).max(1);
                continue;
            }
        }
        node += 1;
    }
}

/// Whether the wire is folded at a node, by more than a right angle. Without the node it would be pressed together to
/// less than 0.71 of its length, and fly apart if it resists that; a chain does not.
fn is_folded(wire: &Wire, node: usize) -> bool {
    let [before, after] = [node - 1, node].map(|segment| wire.span(segment));
    !wire.material.is_chain() && before.dot(&after) < 0.0
}

/// Whether an end of a wire that resists twist would be clamped without a node: what clamps it is its
/// route alone.
fn joins_a_clamp(wire: &Wire, node: usize) -> bool {
    let is_beside_end = node == 1 || node + 2 == wire.nodes.len();
    is_beside_end
        && wire.material.twist_modulus > 0.0
        && Clamp::of([&wire.nodes[node - 1], &wire.nodes[node + 1]]).is_some()
}

/// Whether a wire slides over a contact node.
fn slides(wire: &Wire) -> bool {
    wire.nodes.iter().any(|node| node.slide != 0.0)
}

/// Whether wire slides over a neighbour of a node, towards it, and the segment between the two is
/// used up so far that the node cannot wait: shorter than wanted, or than half of the resolution
/// where it stays, or than four times of what slides in a step.
fn is_used_up(world: &World, at: usize, node: usize, wanted: f64) -> bool {
    let wire = &world.wires[at];
    let least = if wire.resolution.adaptive {
        wanted
    } else {
        wanted / 2.0
    };
    let sides = [
        (node - 1, wire.nodes[node - 1].slide),
        (node, -wire.nodes[node + 1].slide),
    ];
    sides.into_iter().any(|(segment, speed)| {
        let slid = speed * world.settings.step;
        slid > 0.0 && wire.rest_length(segment) < least.max(4.0 * slid)
    })
}

fn split(world: &mut World, at: usize, guard: &mut dyn RemeshGuard, changes: &mut Vec<Remesh>) {
    let mut segment = 0;
    while segment < world.wires[at].segments.len() {
        let wire = &world.wires[at];
        let long = wanted(world, at, [segment; 2], guard) * world.settings.split_ratio;
        let ends = [wire.nodes[segment], wire.nodes[segment + 1]];
        let may_change = if wire.resolution.adaptive {
            ends.iter().all(|node| node.remesh_from <= world.steps)
        } else {
            ends.iter().any(|node| node.slide != 0.0)
        };
        if may_change && wire.rest_length(segment) > long && !wire.is_clamp(segment) {
            let until = world.steps + TENSION_HISTORY as u64;
            let middle = halfway(wire, segment, until);
            let change = remesh(at, RemeshKind::Split, &[ends[0], middle, ends[1]]);
            if guard.permits(world, &change) {
                put_in(&mut world.wires[at], segment, middle);
                changes.push(change);
                segment += 1;
            }
        }
        segment += 1;
    }
}

pub(super) fn remesh(wire: usize, kind: RemeshKind, nodes: &[Node; 3]) -> Remesh {
    Remesh {
        wire: WireId(wire),
        kind,
        triangle: nodes.map(|node| node.position),
        arcs: nodes.map(|node| node.arc),
    }
}

/// Takes a node out, unless an end would be clamped without it, if `guard` permits it.
pub(super) fn try_take_out(
    world: &mut World,
    at: usize,
    node: usize,
    guard: &mut dyn RemeshGuard,
) -> Option<Remesh> {
    let wire = &world.wires[at];
    if joins_a_clamp(wire, node) {
        return None;
    }
    let nodes = [node - 1, node, node + 1].map(|node| wire.nodes[node]);
    let change = remesh(at, RemeshKind::Merge, &nodes);
    guard.permits(world, &change).then(|| {
        let remesh_from = world.steps + TENSION_HISTORY as u64;
        take_out(world, at, node, remesh_from);
        change
    })
}

/// Takes a node out. Each neighbour takes over the mass of the segment beyond the node, half of it,
/// and the momentum that comes with it, so linear momentum stays. Where a dynamic body carries a
/// neighbour, it takes that; what moves as it is prescribed takes none. Along a wire that slides
/// over a neighbour momentum stays in the wire. The end at a reel takes none: the wire moves on over
/// it.
fn take_out(world: &mut World, at: usize, node: usize, remesh_from: u64) {
    let wire = &mut world.wires[at];
    let half = wire.material.mass_per_length() / 2.0;
    let sides = [(node - 1, node - 1, node), (node + 1, node, node - 1)].map(
        |(neighbour, segment, beyond)| Joined {
            mass: wire.node_mass(neighbour),
            added: half * wire.rest_length(beyond),
            relative: wire.nodes[node].velocity - wire.velocity_at(neighbour, segment),
            along: unit(&wire.span(segment)).0,
        },
    );
    wire.nodes.remove(node);
    let after = wire.segments.remove(node);
    wire.segments[node - 1] = Segment::larger(&wire.segments[node - 1], &after);
    let reel = (!wire.reel.is_empty()).then_some(wire.nodes.len() - 1);
    for (neighbour, joined) in [node - 1, node].into_iter().zip(sides) {
        let is_reel = Some(neighbour) == reel;
        let neighbour = &mut wire.nodes[neighbour];
        neighbour.remesh_from = remesh_from;
        if !is_reel {
            joined.bring_momentum(neighbour, &mut world.bodies);
        }
    }
}

/// What comes to a node from beside it.
struct Joined {
    /// The mass of the node before, in kg.
    mass: f64,
    /// The mass that comes, in kg.
    added: f64,
    /// Its velocity against that of the wire at the node, in m/s.
    relative: Vector,
    /// Unit vector along the wire.
    along: Vector,
}

impl Joined {
    fn bring_momentum(&self, node: &mut Node, bodies: &mut [Body]) {
        let mass = self.mass + self.added;
        let mut brought = self.relative * self.added;
        if node.slide != 0.0 {
            let along = brought.dot(&self.along);
            node.slide -= along / mass;
            brought -= self.along * along;
        }
        if let Some((BodyId(body), local)) = node.kind.carrier()
            && bodies[body].dynamic
        {
            let momentum = node.velocity * mass + brought;
            node.velocity = bodies[body].take_up(&local, mass, &momentum);
        } else if node.kind == NodeKind::Free {
            node.velocity += brought / mass;
        }
    }
}

/// The node halfway between the ends of a segment. Its velocity is the mean of those that the wire
/// has there, so linear momentum stays: it takes a quarter of the segment's mass from each.
fn halfway(wire: &Wire, segment: usize, remesh_from: u64) -> Node {
    let ends = [segment, segment + 1];
    let [first, last] = ends.map(|node| wire.velocity_at(node, segment));
    let ends = ends.map(|node| wire.nodes[node]);
    Node {
        position: nalgebra::center(&ends[0].position, &ends[1].position),
        velocity: (first + last) / 2.0,
        arc: (ends[0].arc + ends[1].arc) / 2.0,
        kind: NodeKind::Free,
        slide: 0.0,
        remesh_from,
    }
}

pub(super) fn put_in(wire: &mut Wire, segment: usize, middle: Node) {
    for end in [segment, segment + 1] {
        wire.nodes[end].remesh_from = middle.remesh_from;
    }
    wire.nodes.insert(segment + 1, middle);
    wire.segments.insert(segment + 1, wire.segments[segment]);
}

#[cfg(test)]
mod tests;

//! Attaches nodes to bodies as contact nodes, and releases them.

use super::capstan::{contact_nodes, directions, half_turn_between};
use crate::query::Point;
use crate::wire::model::wire::LEAST;
use crate::wire::model::wire::TENSION_HISTORY;
use crate::wire::model::{BodyId, Node, NodeKind, Wire, WireId};
use crate::wire::record::Slide;
use crate::wire::resolution::{Remesh, RemeshGuard, RemeshKind, put_in, remesh, try_take_out};
use crate::wire::vector::{Vector, unit};
use crate::wire::world::World;

/// A place where a body bends a wire, which needs a contact node there.
#[derive(Clone, Copy, Debug)]
pub(in crate::wire) struct ContactNodeInsertion {
    pub(in crate::wire) wire: WireId,
    /// The place on the wire, in m.
    pub(in crate::wire) arc: f64,
    pub(in crate::wire) body: BodyId,
    /// Where a new node is put in.
    pub(in crate::wire) place: Point,
    /// Unit normal out of the body.
    pub(in crate::wire) normal: Vector,
    pub(in crate::wire) friction: f64,
    /// Unit vector along the surface and across the wire.
    pub(in crate::wire) aside: Vector,
}

/// Nodes that a body carries, of other wire or of other turns, have to be as far apart as this, in the sum of both radii.
const APART: f64 = 0.75;

impl ContactNodeInsertion {
    /// Whether the body has a node of other wire, or of another turn of the same wire, in whose thickness it would be: it
    /// would carry both, and what pushes them apart would push without end.
    fn is_taken(&self, world: &World) -> bool {
        let own = &world.wires[self.wire.0];
        let mut wires = world.wires.iter().enumerate();
        wires.any(|(at, wire)| {
            let radii = own.material.radius + wire.material.radius;
            let is_other =
                |node: &Node| at != self.wire.0 || (node.arc - self.arc).abs() > 2.0 * radii;
            let is_in = |node: &Node| (node.position - self.place).norm() < APART * radii;
            let mut nodes = wire.nodes.iter();
            nodes.any(|node| node.kind.is_on(self.body) && is_other(node) && is_in(node))
        })
    }
}

/// Between two contact nodes whose normals are at no larger angle than this, in rad, wire that comes onto a body needs no
/// other one.
const NEAR: f64 = 0.25;

/// Gives wires contact nodes where bodies bend them. A free node that is near is attached to the
/// body; elsewhere a new node is put in, if `guard` permits it.
pub(super) fn insert(
    world: &mut World,
    insertions: &[ContactNodeInsertion],
    guard: &mut dyn RemeshGuard,
) -> Vec<Remesh> {
    let mut changes = Vec::new();
    for insertion in insertions {
        let wire = &world.wires[insertion.wire.0];
        let near = node_near(wire, insertion.arc);
        let last = wire.nodes.len() - 1;
        let is_free =
            |node: usize| wire.nodes[node].kind == NodeKind::Free && node > 0 && node < last;
        if near.is_some_and(|node| !is_free(node)) || insertion.is_taken(world) {
            continue;
        }
        if let Some(node) = near {
            let along = wire.span(node - 1) + wire.span(node);
            if let Some(attached) = attached(world, insertion, wire.nodes[node], &along) {
                world.wires[insertion.wire.0].nodes[node] = attached;
            }
            continue;
        }
        let (segment, parameter) = wire.at(insertion.arc);
        if wire.is_clamp(segment) {
            continue;
        }
        let ends = [segment, segment + 1];
        let [first, last] = ends.map(|node| wire.velocity_at(node, segment));
        let [start, end] = ends.map(|node| wire.nodes[node]);
        let node = Node {
            position: insertion.place,
            velocity: first.lerp(&last, parameter),
            arc: insertion.arc,
            kind: NodeKind::Free,
            slide: 0.0,
            remesh_from: world.steps + TENSION_HISTORY as u64,
        };
        let Some(node) = attached(world, insertion, node, &wire.span(segment)) else {
            continue;
        };
        let change = remesh(insertion.wire.0, RemeshKind::Split, &[start, node, end]);
        if guard.permits(world, &change) {
            put_in(&mut world.wires[insertion.wire.0], segment, node);
            changes.push(change);
            changes.extend(thin_out(world, insertion.wire, segment + 1, guard));
        }
    }
    changes
}

/// Takes out the contact node beside one that was put in, if the next one on the same body is near enough without it: the
/// node at which wire comes onto a body moves on with the wire.
fn thin_out(
    world: &mut World,
    id: WireId,
    new: usize,
    guard: &mut dyn RemeshGuard,
) -> Option<Remesh> {
    let wire = &world.wires[id.0];
    let normal = |node: usize| match wire.nodes.get(node)?.kind {
        NodeKind::Contact {
            body,
            normal,
            aside: Some(_),
            ..
        } => Some((body, normal)),
        _ => None,
    };
    let is_near = |node: usize| {
        let (Some((body, here)), Some((other, there))) = (normal(new), normal(node)) else {
            return false;
        };
        body == other && here.angle(&there) <= NEAR
    };
    let before = new
        .checked_sub(2)
        .filter(|&node| is_near(node) && is_near(node + 1))
        .map(|node| node + 1);
    let after = (is_near(new + 1) && is_near(new + 2)).then_some(new + 1);
    let node = before.or(after)?;
    try_take_out(world, id.0, node, guard)
}

/// The node that is too near to a place of a wire for another one there.
pub(in crate::wire) fn node_near(wire: &Wire, arc: f64) -> Option<usize> {
    let node = wire.nearest_node(arc);
    let near = (wire.nodes[node].arc - arc).abs() < LEAST * wire.resolution.length;
    near.then_some(node)
}

/// Attaches a free node to a body, where the wire runs along a vector: the inverse of [`detach`].
/// None if the wire slides faster than it may at a contact node.
fn attached(
    world: &World,
    insertion: &ContactNodeInsertion,
    node: Node,
    along: &Vector,
) -> Option<Node> {
    let body = &world.bodies[insertion.body.0];
    let into = |vector: &Vector| body.orientation.inverse_transform_vector(vector);
    let local = into(&(node.position - body.position));
    let (along, _) = unit(along);
    let slide = (body.velocity_at(&local) - node.velocity).dot(&along);
    let length = world.wires[insertion.wire.0].resolution.length;
    (slide.abs() * world.settings.step <= length / 4.0).then(|| Node {
        velocity: node.velocity + along * slide,
        kind: NodeKind::Contact {
            body: insertion.body,
            local,
            normal: into(&insertion.normal),
            friction: insertion.friction,
            aside: Some(into(&insertion.aside)),
        },
        slide,
        ..node
    })
}

/// Frees the nodes that leave: where the wire turns away from the body or slips off sideways, near a
/// free end, and where nodes crowd. An adaptive wire that leaves a body from one of its contact nodes to the next one loses
/// the node, if `guard` permits it: as a free node it would hold the wire on the curve between the two.
pub(super) fn release(
    world: &mut World,
    guard: &mut dyn RemeshGuard,
    changes: &mut Vec<Remesh>,
) -> Vec<Slide> {
    let mut slides = Vec::new();
    let mut unwound = Vec::new();
    for at in 0..world.wires.len() {
        for node in contact_nodes(&world.wires[at]) {
            let wire = &world.wires[at];
            let is_off = is_pulled_off(world, at, node);
            let is_pulled = is_off || is_pulled_aside(world, at, node);
            if is_pulled || runs_out(wire, node) || is_crowded(wire, node) {
                if is_off && wire.resolution.adaptive && is_last_of_row(wire, node) {
                    unwound.push((at, node));
                }
                detach(&mut world.wires[at], node);
                slides.push(Slide {
                    wire: WireId(at),
                    node,
                    distance: 0.0,
                    held: false,
                    left: true,
                });
            }
        }
    }
    for (at, node) in unwound.into_iter().rev() {
        changes.extend(try_take_out(world, at, node, guard));
    }
    slides
}

/// Whether the body carries the node on just one side of a contact node.
fn is_last_of_row(wire: &Wire, node: usize) -> bool {
    let NodeKind::Contact { body, .. } = wire.nodes[node].kind else {
        return false;
    };
    let [before, after] = [node - 1, node + 1].map(|beside| wire.nodes[beside].kind.is_on(body));
    before != after
}

/// The wire turns away from the body: its pull on the node has a component out of it.
fn is_pulled_off(world: &World, wire: usize, node: usize) -> bool {
    let wire = &world.wires[wire];
    let NodeKind::Contact { body, normal, .. } = wire.nodes[node].kind else {
        return false;
    };
    let [before, after] = directions(wire, node);
    (after - before).dot(&world.bodies[body.0].arm(&normal)) > 0.0
}

/// The wire pulls the node sideways with more than the friction of its pull into the body.
fn is_pulled_aside(world: &World, wire: usize, node: usize) -> bool {
    let wire = &world.wires[wire];
    let NodeKind::Contact {
        body,
        normal,
        friction,
        aside: Some(aside),
        ..
    } = wire.nodes[node].kind
    else {
        return false;
    };
    let body = &world.bodies[body.0];
    let [before, after] = directions(wire, node);
    let [from, to] = [node - 1, node].map(|segment| wire.segments[segment].tension);
    let pull = after * to - before * from;
    let (normal, aside) = (body.arm(&normal), body.arm(&aside));
    let pressing = pull.dot(&normal).abs() * pressing_by_pull(&[before, after]);
    pull.dot(&aside).abs() > friction * pressing
}

/// By how much the wire presses on a convex curve, for its pull into it. The curve turns it by `D` from one direction
/// to another: `(D/2) / sin(D/2)`.
pub(in crate::wire) fn pressing_by_pull(directions: &[Vector; 2]) -> f64 {
    let half = half_turn_between(directions);
    if half > 0.0 {
        half / libm::sin(half)
    } else {
        1.0
    }
}

/// A free end of the wire has come as near as it may.
fn runs_out(wire: &Wire, node: usize) -> bool {
    let last = wire.nodes.len() - 1;
    let ends = [(0, node - 1), (last, node)];
    ends.into_iter().any(|(end, segment)| {
        let is_beside = segment == end.min(last - 1);
        let free = wire.nodes[end].kind == NodeKind::Free;
        is_beside && free && wire.rest_length(segment) < 2.0 * LEAST * wire.resolution.length
    })
}

/// Hardly any wire is left before the contact node in front of it, for how far apart the two are:
/// contact nodes of a route may be much nearer than the resolution, and stay.
fn is_crowded(wire: &Wire, node: usize) -> bool {
    let before = matches!(wire.nodes[node - 1].kind, NodeKind::Contact { .. });
    let apart = wire.span(node - 1).norm().max(wire.material.radius);
    let usual = apart.min(LEAST * wire.resolution.length);
    before && wire.rest_length(node - 1) < LEAST * usual
}

/// Frees a node. It goes on with its wire, which slides against the direction in which arc length
/// grows.
pub(super) fn detach(wire: &mut Wire, node: usize) {
    let [before, after] = directions(wire, node);
    let node = &mut wire.nodes[node];
    node.kind = NodeKind::Free;
    node.velocity -= (before + after) / 2.0 * std::mem::take(&mut node.slide);
}

#[cfg(test)]
mod tests;

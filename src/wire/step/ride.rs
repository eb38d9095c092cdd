//! How nodes come to ride bodies, and how they leave.

use super::capstan::{LEAST, contact_nodes, directions};
use super::rows::unit;
use crate::wire::Vector;
use crate::wire::model::wire::MEMORY;
use crate::wire::model::{BodyId, Node, NodeKind, Wire, WireId};
use crate::wire::record::Slide;
use crate::wire::resolution::{Remesh, RemeshGuard, RemeshKind, put_in, remesh};
use crate::wire::world::World;

/// Where a body bends a wire.
#[derive(Clone, Copy, Debug)]
pub(in crate::wire) struct Bend {
    pub(in crate::wire) wire: WireId,
    /// The place on the wire, in m.
    pub(in crate::wire) arc: f64,
    pub(in crate::wire) body: BodyId,
    /// Unit normal out of the body.
    pub(in crate::wire) normal: Vector,
    pub(in crate::wire) friction: f64,
}

/// Gives wires contact nodes where bodies bend them: free nodes that are near come to ride the body, and elsewhere nodes are put in,
/// as far as `guard` permits it.
pub(super) fn arrive(
    world: &mut World,
    bends: &[Bend],
    guard: &mut dyn RemeshGuard,
) -> Vec<Remesh> {
    let mut changes = Vec::new();
    for bend in bends {
        let wire = &world.wires[bend.wire.0];
        if let Some(node) = node_near(wire, bend.arc) {
            let last = wire.nodes.len() - 1;
            if wire.nodes[node].kind == NodeKind::Free && node > 0 && node < last {
                let along = wire.span(node - 1) + wire.span(node);
                if let Some(arrived) = arrived(world, bend, wire.nodes[node], &along) {
                    world.wires[bend.wire.0].nodes[node] = arrived;
                }
            }
            continue;
        }
        let (segment, share) = wire.at(bend.arc);
        let [start, end] = [wire.nodes[segment], wire.nodes[segment + 1]];
        let node = Node {
            position: start.position + wire.span(segment) * share,
            velocity: start.velocity.lerp(&end.velocity, share),
            arc: bend.arc,
            kind: NodeKind::Free,
            slide: 0.0,
            settled: world.steps + MEMORY as u64,
        };
        let Some(node) = arrived(world, bend, node, &wire.span(segment)) else {
            continue;
        };
        let change = remesh(bend.wire.0, RemeshKind::Split, &[start, node, end]);
        if guard.permits(world, &change) {
            put_in(&mut world.wires[bend.wire.0], segment, node);
            changes.push(change);
        }
    }
    changes
}

/// The node that is too near to a place of a wire for another one there.
pub(in crate::wire) fn node_near(wire: &Wire, arc: f64) -> Option<usize> {
    let node = wire.nearest_node(arc);
    let near = (wire.nodes[node].arc - arc).abs() < LEAST * wire.resolution.length;
    near.then_some(node)
}

/// A free node that comes to ride a body, where the wire runs along a vector: the inverse of [`free`]. None if the wire slides faster
/// than it may at a contact node.
fn arrived(world: &World, bend: &Bend, node: Node, along: &Vector) -> Option<Node> {
    let body = &world.bodies[bend.body.0];
    let into = |vector: &Vector| body.orientation.inverse_transform_vector(vector);
    let local = into(&(node.position - body.position));
    let (along, _) = unit(along);
    let slide = (body.velocity_at(&local) - node.velocity).dot(&along);
    let length = world.wires[bend.wire.0].resolution.length;
    let farthest = world.settings.slide_limit.min(length / 4.0);
    (slide.abs() * world.settings.step <= farthest).then(|| Node {
        velocity: node.velocity + along * slide,
        kind: NodeKind::Contact {
            body: bend.body,
            local,
            normal: into(&bend.normal),
            friction: bend.friction,
        },
        slide,
        ..node
    })
}

/// Frees the nodes that leave: where the wire turns away from the body, near a free end, and where nodes crowd.
pub(super) fn leave(world: &mut World) -> Vec<Slide> {
    let mut slides = Vec::new();
    for at in 0..world.wires.len() {
        for node in contact_nodes(&world.wires[at]) {
            let wire = &world.wires[at];
            if is_pulled_off(world, at, node) || runs_out(wire, node) || is_crowded(wire, node) {
                free(&mut world.wires[at], node);
                slides.push(Slide {
                    wire: WireId(at),
                    node,
                    distance: 0.0,
                    left: true,
                });
            }
        }
    }
    slides
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

/// Hardly any wire is left before the contact node in front of it.
fn is_crowded(wire: &Wire, node: usize) -> bool {
    let before = matches!(wire.nodes[node - 1].kind, NodeKind::Contact { .. });
    before && wire.rest_length(node - 1) < LEAST * LEAST * wire.resolution.length
}

/// Frees a node. It goes on with its wire, which slides against the direction in which arc length grows.
pub(super) fn free(wire: &mut Wire, node: usize) {
    let [before, after] = directions(wire, node);
    let node = &mut wire.nodes[node];
    node.kind = NodeKind::Free;
    node.velocity -= (before + after) / 2.0 * std::mem::take(&mut node.slide);
}

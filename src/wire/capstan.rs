//! Contact nodes: where a wire turns over a body, and sticks, slides or leaves.
//!
//! A contact node rides a point of a body. The wire slides over it when the ratio of the tensions on both
//! sides exceeds the capstan bound of a node that turns the wire by an angle `D`:
//! `T2/T1 <= (1 + f tan(D/2)) / (1 - f tan(D/2))`, which tends to `e^(f D)` for small `D`. Sliding is taken
//! as quasi-static: the arc length of the node moves until the elastic tensions hold the bound. Inertia
//! of the sliding stretch is neglected.

use super::Vector;
use super::model::{NodeKind, Wire, WireId, World};
use super::solve::bisect;

/// A wire that slid over a contact node.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Slide {
    /// The wire.
    pub wire: WireId,
    /// The node's number after the motion.
    pub node: usize,
    /// How far the node's arc length went, in m; 0 for a node that left its body.
    pub distance: f64,
    /// Whether the node left its body and is free now.
    pub left: bool,
}

/// Sweeps over the contact nodes of one wire at most: each changes the tension of its neighbours.
const SWEEPS: usize = 200;

/// Slides every wire over its contact nodes, and frees the nodes that are pulled off.
pub(super) fn slide(world: &mut World) -> Vec<Slide> {
    let mut slides = Vec::new();
    for at in 0..world.wires.len() {
        let before: Vec<f64> = world.wires[at].nodes.iter().map(|node| node.arc).collect();
        let contacts = contact_nodes(&world.wires[at]);
        for &node in &contacts {
            if is_pulled_off(world, at, node) {
                world.wires[at].nodes[node].kind = NodeKind::Free;
                slides.push(Slide {
                    wire: WireId(at),
                    node,
                    distance: 0.0,
                    left: true,
                });
            }
        }
        let (wire, limit) = (&mut world.wires[at], world.settings.slide_limit);
        let contacts = contact_nodes(wire);
        relax(wire, &contacts, &before, limit);
        for &node in &contacts {
            let distance = wire.nodes[node].arc - before[node];
            if distance != 0.0 {
                slides.push(Slide {
                    wire: WireId(at),
                    node,
                    distance,
                    left: false,
                });
            }
        }
    }
    slides
}

fn contact_nodes(wire: &Wire) -> Vec<usize> {
    let is_contact = |&node: &usize| matches!(wire.nodes[node].kind, NodeKind::Contact { .. });
    (0..wire.nodes.len()).filter(is_contact).collect()
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

fn directions(wire: &Wire, node: usize) -> [Vector; 2] {
    [node - 1, node].map(|segment| {
        let span = wire.span(segment);
        span / span.norm().max(f64::MIN_POSITIVE)
    })
}

/// Slides node after node until none moves.
fn relax(wire: &mut Wire, contacts: &[usize], before: &[f64], limit: f64) {
    const STILL: f64 = 1e-15;
    for _ in 0..SWEEPS {
        let mut moved = false;
        for &node in contacts {
            let wanted = slide_of_node(wire, node);
            let from = wire.nodes[node].arc - before[node];
            let slide = (from + wanted).clamp(-limit, limit) - from;
            wire.nodes[node].arc += slide;
            moved |= slide.abs() > STILL * before[node];
        }
        if !moved {
            return;
        }
    }
}

/// The largest ratio of tensions that a node holds; infinite if it never slides.
pub(super) fn capstan_bound(before: &Vector, after: &Vector, friction: f64) -> f64 {
    // tan(D/2) = sin D / (1 + cos D)
    let half = before.cross(after).norm() / (1.0 + before.dot(after));
    let pull = friction * half;
    if pull < 1.0 {
        (1.0 + pull) / (1.0 - pull)
    } else {
        f64::INFINITY
    }
}

/// By how much the arc length of a node has to move so that the elastic tensions on both sides hold the
/// bound, at most by half of the segment that gets shorter.
fn slide_of_node(wire: &Wire, node: usize) -> f64 {
    let NodeKind::Contact { friction, .. } = wire.nodes[node].kind else {
        return 0.0;
    };
    let [before, after] = directions(wire, node);
    let bound = capstan_bound(&before, &after, friction);
    let rest = [node - 1, node].map(|segment| wire.rest_length(segment));
    let length = [node - 1, node].map(|segment| wire.span(segment).norm());
    // Strains after the node's arc length moves by `slide`; a wire does not push along a body.
    let strain = |slide: f64| {
        let first = length[0] / (rest[0] + slide) - 1.0;
        let second = length[1] / (rest[1] - slide) - 1.0;
        [first.max(0.0), second.max(0.0)]
    };
    let [first, second] = strain(0.0);
    if first > bound * second {
        bisect(rest[1] / 2.0, |slide| {
            let [first, second] = strain(slide);
            first > bound * second
        })
    } else if second > bound * first {
        -bisect(rest[0] / 2.0, |slide| {
            let [first, second] = strain(-slide);
            second > bound * first
        })
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests;

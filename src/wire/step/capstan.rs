//! Contact nodes: where a wire turns over a body, and sticks or slides.
//!
//! A contact node is attached to a point of a body until it is released
//! ([`contact_nodes`](super::contact_nodes)). Wire slides over it at a speed that is an unknown of
//! the step like any velocity: arc length moves from the segment on one side to that on the other,
//! and what moves is the node's mass. Friction takes up any sliding, as far as the capstan bound of
//! a node that turns the wire by an angle `D` goes: `T2/T1 <= e^(f D)`, which is `|T2 - T1| <=
//! tanh(f D/2) (T1 + T2)`.
//!
//! That is Coulomb's law of a wire which turns by `D` along any convex curve, however short
//! (Euler 1769, Eytelwein 1808). The node stands for this curve, and the bounds of nodes that
//! turn a wire one after the other multiply to that of the whole turn, whatever their number. `T1`
//! and `T2` are the tensions at the node itself: those of the segments, which are those of their
//! middles, and the weight of half a segment along it. What of the node's weight presses on the body,
//! `P`, counts as friction of `P` does along the same curve: `tanh(f D/2) 2 P/D` more.
//!
//! With one force on a sharp corner instead, halfway between both directions, the bound would be `f
//! tan(D/2) (T1 + T2)`: larger, by 5% in the exponent at 45 degrees, and without an end where
//! `f tan(D/2) >= 1`.

use smallvec::{SmallVec, smallvec};

use super::carrier::Layout;
use super::constitutive::{ConstitutiveLaw, friction_bound};
use super::motion::{ProposedMotion, SlideRate};
use super::rows::Row;
use crate::wire::model::wire::LEAST;
use crate::wire::model::{NodeKind, Wire, WireId};
use crate::wire::record::Slide;
use crate::wire::vector::{Vector, unit};
use crate::wire::world::World;

/// Slip of a wire that sticks, which the regularisation allows, as a fraction of the speed that its
/// friction could take from the node in one step. The motion leaves it out.
const SLIP: f64 = 1e-9;

/// The rows of friction of all contact nodes: `w = 0` for the speed of sliding `w`, as far as
/// friction goes.
pub(super) fn friction_rows(world: &World, layout: &Layout) -> Vec<Row> {
    let mut rows = Vec::new();
    for (at, wire) in world.wires.iter().enumerate() {
        let first = layout.first_node[at];
        for node in contact_nodes(wire) {
            let Some(column) = layout.slides[first + node] else {
                continue;
            };
            let segment = first - at + node;
            let factor = capstan_factor(wire, node);
            let fall = world.settings.gravity * world.settings.step;
            let [before, after] = halves(wire, node).map(|half| half.dot(&fall));
            let weights = [-before, after];
            let pressing = pressing_share(wire, node) * -wire.node_mass(node);
            let pressed = pressing * outward(world, wire, node).dot(&fall);
            let tensions = [node - 1, node].map(|beside| wire.segments[beside].tension);
            let pulls = [0, 1].map(|side| tensions[side] * world.settings.step + weights[side]);
            let law = ConstitutiveLaw::Friction {
                factor,
                tensions: [segment - 1, segment].map(|beside| layout.stretch[beside]),
                weights,
                pressed,
                bound: friction_bound(factor, pulls, pressed),
                reach: reach(wire, node, world),
            };
            let sigma = SLIP / wire.node_mass(node);
            rows.push(Row {
                multiplier: column + 1,
                terms: SmallVec::new(),
                slides: smallvec![(column, 1.0)],
                fed: 0.0,
                lead: 0.0,
                compliance: 0.0,
                damping: 0.0,
                sigma,
                target: 0.0,
                branch: law.branch(wire.nodes[node].slide, sigma),
                law,
                softened: None,
            });
        }
    }
    rows
}

/// `tanh(f D/2)`.
fn capstan_factor(wire: &Wire, node: usize) -> f64 {
    libm::tanh(friction(wire, node) * half_turn(wire, node))
}

/// The friction that a force has which presses the wire against the body, evenly along the turn, as
/// a part of this force: `tanh(f D/2) / (D/2)`, which is `f` where the wire does not turn.
fn pressing_share(wire: &Wire, node: usize) -> f64 {
    let (friction, half) = (friction(wire, node), half_turn(wire, node));
    // Below this the quotient is `f` to rounding.
    if friction * half < 1e-8 {
        friction
    } else {
        libm::tanh(friction * half) / half
    }
}

fn friction(wire: &Wire, node: usize) -> f64 {
    match wire.nodes[node].kind {
        NodeKind::Contact { friction, .. } => friction,
        _ => 0.0,
    }
}

/// `D/2`.
fn half_turn(wire: &Wire, node: usize) -> f64 {
    half_turn_between(&directions(wire, node))
}

/// `D/2` of two directions with the angle `D` between them.
pub(super) fn half_turn_between([before, after]: &[Vector; 2]) -> f64 {
    // tan(D/2) = sin D / (1 + cos D)
    libm::atan2(before.cross(after).norm(), 1.0 + before.dot(after))
}

/// The unit normal of the body at a contact node.
fn outward(world: &World, wire: &Wire, node: usize) -> Vector {
    match wire.nodes[node].kind {
        NodeKind::Contact { body, normal, .. } => world.bodies[body.0].arm(&normal),
        _ => Vector::zeros(),
    }
}

/// How the mass of a contact node, half of each segment beside it, moves as its arc length grows, in
/// kg: against the directions of both segments. The node's potential energy as wire slides over
/// it changes by this.
pub(super) fn fall(wire: &Wire, node: usize) -> Vector {
    let [before, after] = halves(wire, node);
    -(before + after)
}

/// The mass of half of each segment beside a node, in kg, along the segment.
fn halves(wire: &Wire, node: usize) -> [Vector; 2] {
    let masses = [node - 1, node]
        .map(|segment| wire.rest_length(segment) / 2.0 * wire.material.mass_per_length());
    let [before, after] = directions(wire, node);
    [before * masses[0], after * masses[1]]
}

/// How fast a node's arc length may fall and grow: to half of the segment that gets shorter, of which
/// something has to be left. Between two contact nodes of one body a segment cannot get much shorter
/// than it is long, and the wire slides as fast as it likes.
fn reach(wire: &Wire, node: usize, world: &World) -> [f64; 2] {
    let body = |node: usize| match wire.nodes[node].kind {
        NodeKind::Contact { body, .. } => Some(body),
        _ => None,
    };
    let sides = [(node - 1, node - 1), (node + 1, node)];
    sides.map(|(neighbour, segment)| {
        let rest = wire.rest_length(segment);
        let most = if body(neighbour) == body(node) {
            wire.length()
        } else {
            (rest / 2.0).min(rest - LEAST * wire.resolution.length)
        };
        most.max(0.0) / world.settings.step
    })
}

/// Whether a wire slides over a node at a speed at which half of a segment holds it. What is left of a
/// segment that is used up holds it, too, as a stop does; that is not meant.
pub(super) fn is_held(world: &World, at: usize, node: usize, speed: f64) -> bool {
    // What is beyond gives way by as little as what sticks.
    const NEARLY: f64 = 1.0 - 1e-6;
    let wire = &world.wires[at];
    let side = usize::from(speed > 0.0);
    let segment = node - 1 + side;
    let used_up = wire.rest_length(segment) < 2.0 * LEAST * wire.resolution.length;
    !used_up && speed.abs() >= reach(wire, node, world)[side] * NEARLY
}

/// The bounds of friction that follow from a solution.
pub(super) fn due_bounds(rows: &[Row], x: &[f64]) -> Vec<f64> {
    let bounds = rows.iter().filter_map(|row| row.law.bounds(x));
    bounds.map(|[_, due]| due).collect()
}

/// The bounds of friction halfway to those that follow from a solution.
pub(super) fn halfway_bounds(rows: &[Row], x: &[f64]) -> Vec<f64> {
    let bounds = rows.iter().filter_map(|row| row.law.bounds(x));
    bounds
        .map(|[bound, due]| f64::midpoint(bound, due))
        .collect()
}

/// Sets the bounds of friction, in the order of their rows.
pub(super) fn set_bounds(rows: &mut [Row], bounds: &[f64]) {
    let laws = rows.iter_mut().filter_map(|row| row.law.bound_mut());
    for (bound, due) in laws.zip(bounds) {
        *bound = *due;
    }
}

/// Whether a bound of friction is not that which follows from a solution.
pub(super) fn bounds_differ(rows: &[Row], x: &[f64]) -> bool {
    const TOLERANCE: f64 = 1e-9;
    bound_residual(rows, x) > TOLERANCE
}

/// The largest difference between a bound of friction and the one that follows from a solution, as
/// a fraction of the largest bound.
pub(super) fn bound_residual(rows: &[Row], x: &[f64]) -> f64 {
    let bounds = rows.iter().filter_map(|row| row.law.bounds(x));
    let finite = bounds.filter(|[_, due]| due.is_finite());
    let (residual, largest) =
        finite.fold((0.0_f64, 0.0_f64), |(residual, largest), [bound, due]| {
            (
                residual.max((bound - due).abs()),
                largest.max(due).max(bound),
            )
        });
    if residual > 0.0 {
        residual / largest
    } else {
        0.0
    }
}

/// A wire that sticks does not creep: where a solution slips, its speed is 0.
pub(super) fn stop_slip(rows: &[Row], x: &mut [f64]) {
    for row in rows.iter().filter(|row| row.sticks()) {
        for &(column, _) in &row.slides {
            x[column] = 0.0;
        }
    }
}

/// Leaves every segment at least a sixteenth of its length: the slides of a wire that would go
/// farther are scaled down, at all its contact nodes, and are held. What they did not slide is stretch, and drawn
/// over the nodes in the next steps.
pub(super) fn shorten(world: &World, motion: &mut ProposedMotion) {
    let mut scales = vec![1.0_f64; world.wires.len()];
    for slid in &motion.slides {
        let wire = &world.wires[slid.wire];
        let both = [slid.node - 1, slid.node];
        // Beside a reel there is only the one before.
        for segment in both.into_iter().filter(|&at| at < wire.segments.len()) {
            let rest = wire.rest_length(segment);
            let speeds = [segment, segment + 1].map(|node| motion.speed(slid.wire, node));
            let taken = (speeds[0] - speeds[1]) * world.settings.step;
            let most = rest * (1.0 - LEAST);
            if taken > most {
                scales[slid.wire] = scales[slid.wire].min(most / taken);
            }
        }
    }
    for slid in &mut motion.slides {
        slid.speed *= scales[slid.wire];
        slid.held |= scales[slid.wire] < 1.0;
    }
}

/// The slides of a motion that was made.
pub(super) fn slides(world: &World, slid: &[SlideRate]) -> Vec<Slide> {
    let moved = slid.iter().filter(|sliding| sliding.speed != 0.0);
    let slides = moved.map(|sliding| Slide {
        wire: WireId(sliding.wire),
        node: sliding.node,
        distance: sliding.speed * world.settings.step,
        held: sliding.held,
        left: false,
    });
    slides.collect()
}

pub(super) fn contact_nodes(wire: &Wire) -> Vec<usize> {
    let is_contact = |&node: &usize| matches!(wire.nodes[node].kind, NodeKind::Contact { .. });
    (0..wire.nodes.len()).filter(is_contact).collect()
}

pub(super) fn directions(wire: &Wire, node: usize) -> [Vector; 2] {
    [node - 1, node].map(|segment| unit(&wire.span(segment)).0)
}

#[cfg(test)]
mod tests;

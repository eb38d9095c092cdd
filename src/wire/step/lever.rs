//! What keeps a step stable where a body is pulled beside its centre of mass.
//!
//! A wire that pulls with `F` at an eye, at `r` from the centre of mass, turns the body until `r` points along
//! `F`. Its energy is `-F . r`, so the body swings about itself with `omega = sqrt(|F| |r| / i)`, where `i` is its
//! moment of inertia. In a step the torque is taken as it is where the step starts, or along its mean: it is
//! an explicit force, like [the tension of a short segment](super::transverse), and stable as long as `h omega < 2`.
//! A ring of 4 kg on which a load of half a ton hangs has `h omega = 4` with steps of 1/60 s, and was thrown about.
//!
//! Where `k = h^2 |F| |r| / s^2` is larger than `i`, the step has beside the masses
//!
//! ```text
//! w |u|^2,   w = k^2 / (c i + k),   c = 12 + 8 sqrt(2)
//! ```
//!
//! as a steep segment has. The velocity `u` is how the arm turns against the pull,
//!
//! ```text
//! u = r/|r| x (P omega - f x f'),   f = F / |F|
//! ```
//!
//! where `P` takes the part across `F`, and `f'` is how the direction of the pull changes as the nodes beside the eye
//! move. It is zero where body and wires swing as one, and where the body spins about the pull. `w |u|^2` depends on
//! differences of velocities only: linear and angular momentum stay. What is far beyond what a step can follow goes by the
//! part `s^2` of its way to rest in each step.
//!
//! `i` is the smallest moment of inertia of the body about an axis across the arm, shared by all nodes on it.

use nalgebra::Matrix3;
use smallvec::SmallVec;

use super::linearisation::Linearisation;
use super::transverse::{FOLLOWED, TransverseInertia};
use crate::wire::model::{Body, BodyId, NodeKind, Wire};
use crate::wire::vector::{Vector, frame, unit};
use crate::wire::world::World;

/// What there is at an eye.
pub(super) struct Lever {
    /// The wire, and which of its nodes the eye is.
    pub(super) at: (usize, usize),
    pub(super) inertia: TransverseInertia,
}

/// All that a step needs, in order; `counts` are the nodes on each body.
pub(super) fn levers(world: &World, linearisation: &Linearisation, counts: &[f64]) -> Vec<Lever> {
    let mut levers = Vec::new();
    for (at, wire) in world.wires.iter().enumerate() {
        for node in 0..wire.nodes.len() {
            let tension = |segment: usize| linearisation.of(at, segment).tension;
            levers.extend(lever(world, at, node, counts, tension));
        }
    }
    levers
}

/// Whether a body turns so fast at an end of a segment, with this tension in N, that a step cannot follow.
pub(super) fn is_lever(world: &World, wire: &Wire, segment: usize, tension: f64) -> bool {
    [segment, segment + 1].into_iter().any(|node| {
        let Some((body, local)) = eye(world, wire, node) else {
            return false;
        };
        needed(world, tension * local.norm()) > least_inertia(body, &local)
    })
}

/// A dynamic body and the place of an eye on it, beside its centre of mass.
fn eye<'a>(world: &'a World, wire: &Wire, node: usize) -> Option<(&'a Body, Vector)> {
    match wire.nodes[node].kind {
        NodeKind::Eye { body, local }
            if world.bodies[body.0].dynamic && local != Vector::zeros() =>
        {
            Some((&world.bodies[body.0], local))
        }
        _ => None,
    }
}

/// `h^2 M / s^2` in kg m^2 of a moment in N m.
fn needed(world: &World, moment: f64) -> f64 {
    let reach = world.settings.step / world.settings.stability_margin;
    reach * reach * moment
}

/// The smallest moment of inertia in kg m^2 about an axis across an arm, of a body that is free to turn about others.
fn least_inertia(body: &Body, local: &Vector) -> f64 {
    let Some(mobility) = body.inertia.try_inverse() else {
        return 0.0;
    };
    let frame = frame(&unit(local).0);
    let across = [1, 2].map(|row| frame.row(row).transpose());
    let mobility = |a: usize, b: usize| across[a].dot(&(mobility * across[b]));
    let (first, both, second) = (mobility(0, 0), mobility(0, 1), mobility(1, 1));
    // The larger eigenvalue.
    let half = (first - second) / 2.0;
    1.0 / ((first + second) / 2.0 + (half * half + both * both).sqrt())
}

/// What there is at a node; none if it is no eye of a dynamic body, or a step follows what the wire does there.
fn lever(
    world: &World,
    at: usize,
    node: usize,
    counts: &[f64],
    tension: impl Fn(usize) -> f64,
) -> Option<Lever> {
    let wire = &world.wires[at];
    let (body, local) = eye(world, wire, node)?;
    let id = wire.nodes[node].kind.carrier().map(|(BodyId(id), _)| id)?;
    // Neighbours, the pull of each, and how it changes with their velocity.
    let before = node.checked_sub(1).map(|segment| (segment, segment));
    let after = (node + 1 < wire.nodes.len()).then_some((node, node + 1));
    let mut pull = Vector::zeros();
    let mut changes: SmallVec<[(usize, Matrix3<f64>); 2]> = SmallVec::new();
    for (segment, neighbour) in before.into_iter().chain(after) {
        let is_on_same = wire.nodes[neighbour].kind.is_on(BodyId(id));
        let tension = tension(segment).max(0.0);
        let (t, length) = unit(&(wire.nodes[neighbour].position - wire.nodes[node].position));
        if is_on_same || length <= 0.0 || tension <= 0.0 {
            continue;
        }
        pull += t * tension;
        let across = Matrix3::identity() - t * t.transpose();
        changes.push((neighbour, across * (tension / length)));
    }
    let arm = body.arm(&local);
    let ((r, long), (f, strong)) = (unit(&arm), unit(&pull));
    let (needed, inertia) = (
        needed(world, long * strong),
        least_inertia(body, &local) / counts[id],
    );
    if needed <= inertia {
        return None;
    }
    let r = r.cross_matrix();
    let mut own = Matrix3::zeros();
    let mut terms = SmallVec::new();
    for (neighbour, change) in changes {
        let part = -(r * f.cross_matrix() * change) / strong;
        own -= part;
        terms.push((neighbour, part));
    }
    terms.push((node, own));
    let inertia = TransverseInertia {
        wire: at,
        mass: needed * needed / (FOLLOWED * inertia + needed),
        terms,
        spin: Some((id, r * (Matrix3::identity() - f * f.transpose()))),
    };
    Some(Lever {
        at: (at, node),
        inertia,
    })
}

#[cfg(test)]
mod tests;

//! What keeps a step stable at bodies that wires pull on.
//!
//! A wire that pulls with `F` on a place of a body, at `r` from its centre of mass, turns the body until `r` points along
//! `F`, and draws it across when its own other end moves. In a step these forces are taken as they are where the step
//! starts: they are explicit, like [the tension of a short segment](super::transverse). Rings, shackles and hooks are
//! small: one of 4 kg on which half a ton hangs swings about itself with `h omega = 4` at 1/60 s, where a step follows
//! less than 2.
//!
//! Let `K v` be how fast force and moment of all wires on the body change, six numbers that are linear in the velocities of the
//! body and of the nodes next to it,
//!
//! ```text
//! F' = sum T/l P (v - v_place),   M' = sum r x F' + (omega x r) x F
//! ```
//!
//! with the tension `T`, the length `l` and the direction of each segment, across which `P` takes a part. The last part is of
//! eyes alone: at contact nodes wire slides, and a block that turns under its rope is not held. Let `K_b` be the
//! part of `K` that the body's own velocities have, and `M` its masses. Where the trace of `h^2 / s^2 K_b M^-1` is above 1 the
//! step has beside the masses
//!
//! ```text
//! W = k^T (c M + 2 k_b)^-1 k,   k = h^2 / s^2 K,   c = 12 + 8 sqrt(2)
//! ```
//!
//! as [steep segments](super::transverse) have; twice `k_b` stands for what the other nodes add. It is zero for what
//! moves as one under forces that balance at the body: a ring in a crane's rope leaves the swing and the spin of its load
//! as they are, however light it is. What a step follows well loses the part `(omega h)^4 / 2 c` of its amplitude, and what is
//! far beyond goes to rest in some steps.
//!
//! A body that lies far aside of its pulls is turned by their moment `N` itself, or is at its top, where `K_b` is below 0 by
//! `b`. Where `4 h^2 (|N| + b) / s^2 = k` is above eight times its least moment of inertia `i`, so that the moment would turn it by
//! more than a radian in a step, each axis has `k^2 / (c i + k)` more: it turns by some 9 degrees. That is not zero for what moves as
//! one; it ends as the body comes into line.

use nalgebra::{Matrix3, Matrix6, SMatrix};
use smallvec::SmallVec;

use super::inertia_term::{FOLLOWED, InertiaTerm};
use super::linearisation::Linearisation;
use crate::wire::model::{Body, NodeKind, Wire};
use crate::wire::vector::{Vector, unit};
use crate::wire::world::World;

/// A moment turns a body by at most `s^2` over this in a step, in rad: by so much that mean arms follow.
const TURNS: f64 = 4.0;

/// How many times its least moment of inertia what acts against a moment has to be.
const AT_ONCE: f64 = 8.0;

/// What there is at the bodies of a world.
pub(super) struct BodyInertias {
    pub(super) terms: Vec<InertiaTerm>,
    /// By bodies: whether nodes on it need nothing else.
    pub(super) is_held: Vec<bool>,
}

/// A segment that pulls on a place of a body.
struct Pull {
    /// Which body.
    body: usize,
    /// The wire, and which of its nodes is at the other end.
    neighbour: (usize, usize),
    /// From the centre of mass to the place, in m.
    arm: Vector,
    /// In N; 0 at a contact node, over which wire slides as the body turns.
    force: Vector,
    /// `T/l P` in N/m.
    stiffness: Matrix3<f64>,
}

/// Those of all bodies that a step cannot follow.
pub(super) fn body_inertias(world: &World, linearisation: &Linearisation) -> BodyInertias {
    let mut pulls = Vec::new();
    for (at, wire) in world.wires.iter().enumerate() {
        let nodes = wire.nodes.iter().enumerate();
        for (node, _) in nodes.filter(|(_, node)| node.kind.carrier().is_some()) {
            let before = node.checked_sub(1).map(|other| (other, other));
            let after = (node + 1 < wire.nodes.len()).then_some((node, node + 1));
            for (segment, neighbour) in before.into_iter().chain(after) {
                let tension = linearisation.of(at, segment).tension;
                pulls.extend(pull(world, at, node, neighbour, tension));
            }
        }
    }
    let mut inertias = BodyInertias {
        terms: Vec::new(),
        is_held: vec![false; world.bodies.len()],
    };
    let reach = world.settings.step / world.settings.stability_margin;
    pulls.sort_by_key(|pull| pull.body);
    for pulls in pulls.chunk_by(|one, other| one.body == other.body) {
        let at = pulls[0].body;
        let body = &world.bodies[at];
        if are_weak(body, pulls, reach * reach) {
            continue;
        }
        let own = OwnStiffness::new(pulls);
        if reach * reach * own.strength(body) > 1.0
            && let Some(parts) = against_forces(body, pulls, &own, reach * reach)
        {
            inertias.terms.extend(parts);
            inertias.is_held[at] = true;
        }
        let against_moment = against_moment(body, pulls, &own, reach * reach);
        inertias.terms.extend(against_moment);
    }
    inertias
}

/// Whether a bound says that pulls need nothing: `K_b` and a moment are no larger than with arms across.
fn are_weak(body: &Body, pulls: &[Pull], reach: f64) -> bool {
    // Of the trace of `K_b M^-1`, and of what a moment has to be: `4 (1 + 4) |r| |F| <= 8 i` at most.
    const WEAK: f64 = 0.8;
    let turning = body
        .inertia
        .try_inverse()
        .map_or(f64::INFINITY, |m| m.trace());
    let strengths = pulls.iter().map(|pull| {
        let across = pull.stiffness.trace();
        let arm = pull.arm.norm();
        let turned = across * arm * arm + 2.0 * arm * pull.force.norm();
        across / body.mass + turning * turned
    });
    reach * strengths.sum::<f64>() <= WEAK
}

/// Whether a step cannot follow what a segment with this tension in N does to a body at one of its ends.
pub(super) fn is_strong(world: &World, wire: usize, segment: usize, tension: f64) -> bool {
    let reach = world.settings.step / world.settings.stability_margin;
    [(segment, segment + 1), (segment + 1, segment)]
        .into_iter()
        .filter_map(|(node, neighbour)| pull(world, wire, node, neighbour, tension))
        .any(|pull| {
            let body = &world.bodies[pull.body];
            reach * reach * OwnStiffness::new(&[pull]).strength(body) > 1.0
        })
}

/// What a segment does to a dynamic body at one of its nodes; none if its other end is on the same body.
fn pull(world: &World, at: usize, node: usize, neighbour: usize, tension: f64) -> Option<Pull> {
    let wire: &Wire = &world.wires[at];
    let (id, local) = wire.nodes[node].kind.carrier()?;
    let body = &world.bodies[id.0];
    let is_eye = matches!(wire.nodes[node].kind, NodeKind::Eye { .. });
    let is_on_same = wire.nodes[neighbour].kind.is_on(id);
    let (t, length) = unit(&(wire.nodes[neighbour].position - wire.nodes[node].position));
    if !body.dynamic || is_on_same || length <= 0.0 || tension <= 0.0 {
        return None;
    }
    Some(Pull {
        body: id.0,
        neighbour: (at, neighbour),
        arm: body.arm(&local),
        force: if is_eye { t * tension } else { Vector::zeros() },
        stiffness: (Matrix3::identity() - t * t.transpose()) * (tension / length),
    })
}

/// What the velocities of a body itself have of `K`.
struct OwnStiffness {
    /// As places on it move against segments: nowhere below 0.
    across: Matrix6<f64>,
    /// As its arms turn against the pulls.
    lever: Matrix3<f64>,
}

impl OwnStiffness {
    fn new(pulls: &[Pull]) -> Self {
        let (mut across, mut lever) = (Matrix6::zeros(), Matrix3::zeros());
        for pull in pulls {
            let cross = pull.arm.cross_matrix();
            // The place moves with `v - [r] omega`.
            let to_turn = pull.stiffness * cross;
            let mut add = |row: usize, column: usize, part: Matrix3<f64>| {
                let mut block = across.fixed_view_mut::<3, 3>(row, column);
                block += part;
            };
            add(0, 0, pull.stiffness);
            add(0, 3, -to_turn);
            add(3, 0, -to_turn.transpose());
            add(3, 3, cross.transpose() * to_turn);
            let outer = pull.arm * pull.force.transpose();
            lever += Matrix3::identity() * pull.arm.dot(&pull.force);
            lever -= (outer + outer.transpose()) / 2.0;
        }
        OwnStiffness { across, lever }
    }

    fn whole(&self) -> Matrix6<f64> {
        let mut whole = self.across;
        let mut turning = whole.fixed_view_mut::<3, 3>(3, 3);
        turning += self.lever;
        whole
    }

    /// The trace of `K_b M^-1`, in which no lever counts below 0.
    fn strength(&self, body: &Body) -> f64 {
        let moved: Matrix3<f64> = self.across.fixed_view::<3, 3>(0, 0).into();
        let turned: Matrix3<f64> = self.across.fixed_view::<3, 3>(3, 3).into();
        let of_turning = mobility(body).map_or(f64::INFINITY, |mobility| {
            (mobility * turned).trace() + (mobility * self.lever).trace().max(0.0)
        });
        moved.trace() / body.mass + of_turning
    }

    /// How far a lever is below 0 at most, by Gershgorin's circles: a body lies aside of its pulls then.
    fn below_zero(&self) -> f64 {
        let rows = (0..3).map(|row| {
            let beside: f64 = self.lever.row(row).iter().map(|entry| entry.abs()).sum();
            let own = self.lever[(row, row)];
            beside - own.abs() - own
        });
        rows.fold(0.0, f64::max)
    }
}

/// The inverse of the inertia in space.
fn mobility(body: &Body) -> Option<Matrix3<f64>> {
    body.world_inertia().try_inverse()
}

/// `W`, as two inertias with three components each; none if the body has no inertia in some direction.
fn against_forces(
    body: &Body,
    pulls: &[Pull],
    own: &OwnStiffness,
    reach: f64,
) -> Option<[InertiaTerm; 2]> {
    let at = pulls.first()?.body;
    let stiffness = own.whole();
    let mut masses = Matrix6::identity() * body.mass;
    masses
        .fixed_view_mut::<3, 3>(3, 3)
        .copy_from(&body.world_inertia());
    let mut bound = masses * FOLLOWED + stiffness * (2.0 * reach);
    let below_zero = own.below_zero();
    for axis in 3..6 {
        bound[(axis, axis)] += 2.0 * reach * below_zero;
    }
    // `W = |C^-1 k v|^2` with `C C^T` the bound.
    let inverse: Matrix6<f64> = bound.cholesky()?.l().try_inverse()?;
    let mut parts = [0, 3].map(|row| {
        let rows: SMatrix<f64, 3, 6> = inverse.fixed_view::<3, 6>(row, 0).into();
        let own = rows * stiffness * -reach;
        InertiaTerm {
            mass: 1.0,
            nodes: SmallVec::new(),
            body: Some((
                at,
                [0, 3].map(|column| own.fixed_view::<3, 3>(0, column).into()),
            )),
        }
    });
    for pull in pulls {
        for (part, row) in parts.iter_mut().zip([0, 3]) {
            let force: Matrix3<f64> = inverse.fixed_view::<3, 3>(row, 0).into();
            let moment: Matrix3<f64> = inverse.fixed_view::<3, 3>(row, 3).into();
            let of_force = (force + moment * pull.arm.cross_matrix()) * reach;
            part.nodes.push((
                pull.neighbour.0,
                pull.neighbour.1,
                of_force * pull.stiffness,
            ));
        }
    }
    Some(parts)
}

/// What resists a moment that turns the body by more than a step can follow.
fn against_moment(
    body: &Body,
    pulls: &[Pull],
    own: &OwnStiffness,
    reach: f64,
) -> Option<InertiaTerm> {
    let at = pulls.first()?.body;
    let moment: Vector = pulls.iter().map(|pull| pull.arm.cross(&pull.force)).sum();
    let needed = TURNS * reach * (moment.norm() + own.below_zero());
    let inertia = 1.0 / mobility(body)?.trace();
    (needed > AT_ONCE * inertia).then(|| InertiaTerm {
        mass: needed * needed / (FOLLOWED * inertia + needed),
        nodes: SmallVec::new(),
        body: Some((at, [Matrix3::zeros(), Matrix3::identity()])),
    })
}

#[cfg(test)]
mod tests;

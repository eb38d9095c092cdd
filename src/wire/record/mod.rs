//! What is observed of a step.

mod collision;

pub use collision::{
    BodyCrossing, BodyCrossingOutcome, CollisionRecord, CoreCrossing, Crossing, CrossingOutcome,
    PairAnswer, PairRecord, ScaledIsland,
};

use nalgebra::UnitQuaternion;

use super::contact::ContactConstraint;
use super::energy::Energy;
use super::model::{Body, BodyId, NodeKind, WireId};
use super::resolution::Remesh;
use super::step::motion::ProposedMotion;
use super::vector::Vector;
use super::world::World;
use crate::query::Point;

/// Everything that happened in one step. Outside of this crate one starts as the default, for tests
/// of what reads it.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct StepRecord {
    /// The step, from 0.
    pub step: u64,
    /// Time at its end in s.
    pub time: f64,
    /// Each wire.
    pub wires: Vec<WireRecord>,
    /// Each body.
    pub bodies: Vec<BodyRecord>,
    /// The contacts of the step.
    pub contacts: Vec<ContactRecord>,
    /// The collisions between wires; empty unless the step looked for them.
    pub collisions: CollisionRecord,
    /// Wires that slid over contact nodes in the motion, and those that left one after it.
    pub slides: Vec<Slide>,
    /// Changes of resolution, after the motion.
    pub remeshes: Vec<Remesh>,
    /// Energies of the motion: kinetic of the velocities with which everything moved, potential
    /// halfway, elastic of the forces that wires had. Free fall keeps their sum to rounding, and
    /// what swings to the second order of the step.
    pub energy: Energy,
    /// Energies as everything lies and moves at the end, as of [`World::energy`].
    pub energy_at_end: Energy,
    /// What scripted bodies and reels did on what forces move, in J, by wires and contacts, as the step was solved: where
    /// its motion was held they did less. So `energy` grows by at most this from step to step, but for what the scheme
    /// and contacts that are pushed out of bodies add.
    pub work: f64,
    /// What acted beside forces and masses.
    pub added_inertia: AddedInertia,
    /// What forces took from the motion because they had the directions at the end of the step, in J; 0 but in steps in which a wire is
    /// caught so hard that no solution with mean directions is found.
    pub numerical_damping: f64,
    /// How the system was solved.
    pub solver: SolverRecord,
    /// How long the phases took.
    pub phases: Phases,
}

/// What keeps a step stable beside segments that are too short for their tension. It acts on what a step cannot follow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct AddedInertia {
    /// At how many nodes it acts; one between segments of both kinds counts twice.
    pub places: usize,
    /// What it took from the motion in this step, in J, to first order in what it changed.
    pub damped: f64,
}

/// A wire in a step. Its nodes move on straight lines.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct WireRecord {
    /// Radius in m.
    pub radius: f64,
    /// Arc length of each node in m.
    pub arcs: Vec<f64>,
    /// What carries each node.
    pub kinds: Vec<NodeKind>,
    /// Position of each node before the motion, in m.
    pub before: Vec<Point>,
    /// Position of each node after it, in m.
    pub after: Vec<Point>,
    /// Tension of each segment in N.
    pub tensions: Vec<f64>,
    /// Torque of the wire in N m, positive if its last end is twisted counterclockwise seen from beyond
    /// it; 0 for a wire that does not hold twist.
    pub torque: f64,
    /// How far its last end is twisted against its first one after the motion, in rad.
    pub twist: f64,
}

/// A body in a step. From pose to pose it turns as [`RigidMotion`](crate::rigid::RigidMotion) says.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodyRecord {
    /// Before the motion.
    pub before: Pose,
    /// On the way, at equal times, where this body, or one that may come near it, turns by more than
    /// 45 degrees: from one pose to the next each turns by at most that. As many of all that may come
    /// near each other, none of a body that stays where it is.
    pub between: Vec<Pose>,
    /// After it.
    pub after: Pose,
}

/// Position and orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose {
    /// Centre of mass in m.
    pub position: Point,
    /// From the body's frame to the world.
    pub orientation: UnitQuaternion<f64>,
}

/// A contact and what it did.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactRecord {
    /// The contact as it was given.
    pub contact: ContactConstraint,
    /// Force on its place A in N, friction included.
    pub force: Vector,
}

impl ContactRecord {
    /// The force along the normal in N, at least 0.
    pub fn normal_force(&self) -> f64 {
        self.force.dot(&self.contact.normal)
    }
}

/// A wire that slid over a contact node, or was let out at its last node.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Slide {
    /// The wire.
    pub wire: WireId,
    /// The node's number after the motion.
    pub node: usize,
    /// How far the node's arc length went, in m; 0 for a node that left its body.
    pub distance: f64,
    /// Whether the wire would have slid farther, and what was left of a segment held it: half of the
    /// segment that got shorter, or a sixteenth of one between two nodes. What moves the wire is braked
    /// then. A resolution of more than twice what slides in a step avoids it.
    pub held: bool,
    /// Whether the node left its body and is free now.
    pub left: bool,
}

/// How a step was solved: of each number the largest of all islands, of what contacts and bodies that
/// forces move tie together.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SolverRecord {
    /// Backward error of the solution.
    pub residual: f64,
    /// Factorisations: 1, and one more for every wrong guess of which segments of chains pull, or
    /// for every step of Newton's method where contacts are in the system.
    pub factorisations: usize,
    /// Sweeps over the contacts; 0 where they are in the system.
    pub sweeps: usize,
    /// Whether the step ended because it had spent its [`work`](super::Settings::work), or could not
    /// find what pulls and slides.
    pub cut_short: bool,
    /// Whether a motion was slowed, since its contacts were not solved and it had more energy than there was.
    pub slowed: bool,
    /// The largest error of contact velocities, in m/s: the change in the last sweep, or the part
    /// that was not predicted. Above the tolerance of the settings if that took too long.
    pub contact_residual: f64,
    /// The largest difference between a bound of friction at a contact node and the one that the
    /// tensions beside it give, as a fraction of the largest; above 1e-9 only if rounds were not
    /// enough.
    pub slide_residual: f64,
}

/// Wall-clock time in s by phase; of islands that threads solve at the same time, the sum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Phases {
    /// Putting the system together.
    pub assembly: f64,
    /// Factoring it.
    pub factor: f64,
    /// Solving it without contacts.
    pub solve: f64,
    /// Contacts and friction; where contacts are in the system, all of its solution.
    pub contacts: f64,
    /// Boxes of what may collide, and which of them meet.
    pub broad: f64,
    /// The rest of collision detection: pairs whose boxes meet, and what becomes of their contacts.
    pub narrow: f64,
    /// Moving everything.
    pub commit: f64,
    /// Nodes that leave their bodies, and changes of resolution.
    pub resolution: f64,
}

impl Phases {
    /// Adds the time that another part took.
    pub(in crate::wire) fn add(&mut self, other: &Phases) {
        self.assembly += other.assembly;
        self.factor += other.factor;
        self.solve += other.solve;
        self.contacts += other.contacts;
        self.broad += other.broad;
        self.narrow += other.narrow;
        self.commit += other.commit;
        self.resolution += other.resolution;
    }
}

impl StepRecord {
    /// What is known before the motion.
    pub(in crate::wire) fn before(world: &World) -> Self {
        let wires = world.wires.iter().map(|wire| WireRecord {
            radius: wire.material.radius,
            arcs: wire.nodes.iter().map(|node| node.arc).collect(),
            kinds: wire.nodes.iter().map(|node| node.kind).collect(),
            before: wire.nodes.iter().map(|node| node.position).collect(),
            ..WireRecord::default()
        });
        let poses = poses(world).map(|before| BodyRecord {
            before,
            between: Vec::new(),
            after: before,
        });
        StepRecord {
            step: world.steps,
            wires: wires.collect(),
            bodies: poses.collect(),
            ..StepRecord::default()
        }
    }

    /// Adds the poses on the way of a motion.
    pub(in crate::wire) fn turns(&mut self, motion: &ProposedMotion) {
        for (body, record) in self.bodies.iter_mut().enumerate() {
            record
                .between
                .clone_from(&motion.body(BodyId(body)).between);
        }
    }

    /// Adds what the motion came to.
    pub(in crate::wire) fn after(&mut self, world: &World) {
        for (record, wire) in self.wires.iter_mut().zip(&world.wires) {
            record.after = wire.nodes.iter().map(|node| node.position).collect();
            record.tensions = wire.segments.iter().map(|s| s.tension).collect();
            record.twist = wire.twist;
        }
        for (record, pose) in self.bodies.iter_mut().zip(poses(world)) {
            record.after = pose;
        }
        self.time = world.time();
        self.energy_at_end = world.energy();
    }
}

fn poses(world: &World) -> impl Iterator<Item = Pose> {
    world.bodies.iter().map(Pose::of)
}

impl Pose {
    /// Where a body is.
    pub(in crate::wire) fn of(body: &Body) -> Self {
        Pose {
            position: body.position,
            orientation: body.orientation,
        }
    }
}

impl World {
    pub(in crate::wire) fn contact_records(
        &self,
        contacts: &[ContactConstraint],
        impulses: &[Vector],
    ) -> Vec<ContactRecord> {
        let pairs = contacts.iter().zip(impulses);
        pairs
            .map(|(&contact, impulse)| ContactRecord {
                contact,
                force: impulse / self.settings.step,
            })
            .collect()
    }
}

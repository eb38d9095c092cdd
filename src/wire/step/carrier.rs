//! Where points get their velocity from, and the numbering of the unknowns.

use smallvec::SmallVec;

use super::linearisation::Linearisation;
use super::order::Block;
use super::transverse::SteepNode;
use crate::wire::error::Part;
use crate::wire::model::wire::Clamp;
use crate::wire::model::{BodyId, NodeKind, WireId};
use crate::wire::world::World;
use crate::wire::{ContactConstraint, ContactSite, Vector};

/// What the velocity of a point is made of.
#[derive(Clone, Copy, Debug)]
pub(super) enum Carrier {
    /// Three unknowns from here on.
    Free(usize),
    /// Six unknowns of a body from here on, velocity and angular velocity, and the point seen from
    /// the centre of mass.
    Body(usize, Vector),
    /// Prescribed.
    Prescribed(Vector),
}

/// Columns and values of one row of a Jacobian.
pub(super) type Columns = SmallVec<[(usize, f64); 24]>;

impl Carrier {
    /// Adds the row of `direction . velocity` to `columns`. A prescribed velocity has no columns.
    pub(super) fn columns(&self, direction: &Vector, columns: &mut Columns) {
        self.each_column(direction, |column, value| columns.push((column, value)));
    }

    /// Calls back for each column and value of the row of `direction . velocity`.
    #[inline]
    pub(super) fn each_column(&self, direction: &Vector, mut take: impl FnMut(usize, f64)) {
        let (Carrier::Free(first) | Carrier::Body(first, _)) = *self else {
            return;
        };
        take(first, direction.x);
        take(first + 1, direction.y);
        take(first + 2, direction.z);
        if let Carrier::Body(_, arm) = self {
            let moment = arm.cross(direction);
            take(first + 3, moment.x);
            take(first + 4, moment.y);
            take(first + 5, moment.z);
        }
    }

    /// The velocity that is prescribed; 0 if it is unknown.
    pub(super) fn prescribed_velocity(&self) -> Vector {
        match self {
            Carrier::Prescribed(velocity) => *velocity,
            _ => Vector::zeros(),
        }
    }

    /// The velocity for a solution `x`.
    pub(super) fn velocity(&self, x: &[f64]) -> Vector {
        let three = |first: usize| Vector::new(x[first], x[first + 1], x[first + 2]);
        match self {
            Carrier::Free(first) => three(*first),
            Carrier::Body(first, arm) => three(*first) + three(first + 3).cross(arm),
            Carrier::Prescribed(velocity) => *velocity,
        }
    }
}

/// The numbering of the unknowns: velocities and multipliers in order of elimination.
///
/// Free nodes, each followed by what keeps [steep segments](super::transverse) beside it stable and
/// by the rows that it can eliminate, and bodies come in a given order ([`order`](super::order)), then
/// what slides over contact nodes, and last what belongs to no free node.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// How many unknowns there are.
    pub(super) size: usize,
    /// Where wire `w` starts in `nodes`; its segments start at `first_node[w] - w`.
    pub(super) first_node: Vec<usize>,
    /// What carries each node of each wire.
    pub(super) nodes: Vec<Carrier>,
    /// The first unknown of each dynamic body.
    pub(super) bodies: Vec<Option<usize>>,
    /// The multiplier of each segment's stretch row.
    pub(super) stretch: Vec<usize>,
    /// The first multiplier of each node's bend rows.
    pub(super) bend: Vec<Option<usize>>,
    /// The first of three impulses of each node beside steep segments.
    pub(super) steep: Vec<Option<usize>>,
    /// The speed of sliding over each contact node. The multiplier of its friction is the next
    /// unknown.
    pub(super) slides: Vec<Option<usize>>,
    /// The multiplier of each wire's row of twist, its torque; none of a wire that holds no twist. It
    /// is tied to all nodes of the wire and comes after them.
    pub(super) twist: Vec<Option<usize>>,
}

const UNSET: usize = usize::MAX;

impl Layout {
    /// Numbers blocks in the order given, each followed by the rows that it can eliminate.
    pub(super) fn new(
        world: &World,
        linearisation: &Linearisation,
        order: &[Block],
        steep: &[SteepNode],
    ) -> Self {
        let mut layout = Layout::carried(world);
        for at in steep {
            layout.steep[layout.first_node[at.wire] + at.node] = Some(UNSET);
        }
        for block in order {
            match *block {
                Block::Node { wire, node } => {
                    layout.eliminate_node(wire, node, world.wires[wire].nodes.len());
                }
                Block::Body(at) => layout.bodies[at] = Some(layout.take(6)),
            }
        }
        layout.rest(world, linearisation);
        layout
    }

    /// No unknown has a number yet; what is prescribed is there.
    fn carried(world: &World) -> Self {
        let mut nodes = Vec::new();
        let mut first_node = Vec::new();
        let mut bend = Vec::new();
        let mut slides = Vec::new();
        for wire in &world.wires {
            first_node.push(nodes.len());
            for (i, node) in wire.nodes.iter().enumerate() {
                nodes.push(match node.kind {
                    NodeKind::Free => Carrier::Free(UNSET),
                    _ => Carrier::Prescribed(Vector::zeros()),
                });
                let ends = i == 0 || i + 1 == wire.nodes.len();
                bend.push((!ends && !wire.material.is_chain()).then_some(UNSET));
                let slides_over = matches!(node.kind, NodeKind::Contact { .. });
                slides.push(slides_over.then_some(UNSET));
            }
        }
        Layout {
            size: 0,
            stretch: vec![UNSET; nodes.len() - first_node.len()],
            bend,
            steep: vec![None; nodes.len()],
            slides,
            nodes,
            first_node,
            bodies: vec![None; world.bodies.len()],
            twist: (world.wires.iter())
                .map(|wire| wire.holds_twist().then_some(UNSET))
                .collect(),
        }
    }

    /// What an unknown belongs to. That of a stretch is its segment's first node, that of a twist its wire's.
    pub(super) fn part(&self, unknown: usize) -> Part {
        let has = |first: Option<usize>, count: usize| {
            first.is_some_and(|first| (first..first + count).contains(&unknown))
        };
        if let Some(body) = self.bodies.iter().position(|first| has(*first, 6)) {
            return Part::Body(BodyId(body));
        }
        let is_of_node = |&at: &usize| {
            let free = match self.nodes[at] {
                Carrier::Free(first) => Some(first),
                _ => None,
            };
            has(free, 3)
                || has(self.steep[at], 3)
                || has(self.bend[at], 3)
                || has(self.slides[at], 2)
        };
        let wire_of = |at: usize| self.first_node.partition_point(|first| *first <= at) - 1;
        let node = (0..self.nodes.len()).find(is_of_node).or_else(|| {
            let segment = self.stretch.iter().position(|at| *at == unknown)?;
            let starts = self.first_node.iter().enumerate();
            let before = starts.filter(|(wire, first)| **first - wire <= segment);
            Some(segment + before.count() - 1)
        });
        if let Some(at) = node {
            let wire = wire_of(at);
            return Part::Node {
                wire: WireId(wire),
                node: at - self.first_node[wire],
            };
        }
        let wire = self.twist.iter().position(|at| *at == Some(unknown));
        Part::Node {
            wire: WireId(wire.unwrap_or(0)),
            node: 0,
        }
    }

    fn take(&mut self, count: usize) -> usize {
        self.size += count;
        self.size - count
    }

    fn eliminate_node(&mut self, wire: usize, node: usize, count: usize) {
        let at = self.first_node[wire] + node;
        self.nodes[at] = Carrier::Free(self.take(3));
        if self.steep[at].is_some() {
            self.steep[at] = Some(self.take(3));
        }
        let before = (node > 0).then(|| at - wire - 1);
        let after = (node + 1 < count).then_some(at - wire);
        for segment in [before, after].into_iter().flatten() {
            if self.stretch[segment] == UNSET {
                self.stretch[segment] = self.take(1);
            }
        }
        if self.bend[at].is_some() {
            self.bend[at] = Some(self.take(3));
        }
    }

    /// Numbers what slides and the rows that no free node took, and ties the nodes of bodies to
    /// them.
    fn rest(&mut self, world: &World, linearisation: &Linearisation) {
        for at in 0..self.slides.len() {
            if self.slides[at].is_some() {
                self.slides[at] = Some(self.take(2));
            }
        }
        for at in 0..self.steep.len() {
            if self.steep[at] == Some(UNSET) {
                self.steep[at] = Some(self.take(3));
            }
        }
        for segment in 0..self.stretch.len() {
            if self.stretch[segment] == UNSET {
                self.stretch[segment] = self.take(1);
            }
        }
        for at in 0..self.bend.len() {
            if self.bend[at] == Some(UNSET) {
                self.bend[at] = Some(self.take(3));
            }
        }
        for at in 0..self.twist.len() {
            if self.twist[at].is_some() {
                self.twist[at] = Some(self.take(1));
            }
        }
        for (wire, &first) in world.wires.iter().zip(&self.first_node) {
            for (i, node) in wire.nodes.iter().enumerate() {
                if let Some((body, local)) = node.kind.carrier() {
                    let arm = linearisation.arm(world, body, &local);
                    self.nodes[first + i] = self.body(world, body, arm);
                }
            }
        }
    }

    fn body(&self, world: &World, id: BodyId, arm: Vector) -> Carrier {
        match self.bodies[id.0] {
            Some(first) => Carrier::Body(first, arm),
            None => Carrier::Prescribed(prescribed(world, id, &arm)),
        }
    }

    /// What carries the angular velocity of what clamps a wire.
    pub(super) fn spin(&self, world: &World, clamp: Clamp) -> Carrier {
        let Clamp::Body(id) = clamp else {
            return Carrier::Prescribed(Vector::zeros());
        };
        match self.bodies[id.0] {
            Some(first) => Carrier::Free(first + 3),
            None => {
                let (_, spin) = world.bodies[id.0].prescribed(world.time(), world.settings.step);
                Carrier::Prescribed(spin)
            }
        }
    }

    /// What carries the velocity of a contact's place A seen from B, by carriers and their weights.
    pub(super) fn contact(
        &self,
        world: &World,
        contact: &ContactConstraint,
    ) -> SmallVec<[(Carrier, f64); 4]> {
        let b = self.place(world, &contact.b).into_iter();
        let a = self.place(world, &contact.a).into_iter();
        a.chain(b.map(|(carrier, weight)| (carrier, -weight)))
            .collect()
    }

    /// What prescribed velocities do by contacts with these impulses on their places A, in J.
    pub(super) fn work_of_contacts(
        &self,
        world: &World,
        contacts: &[ContactConstraint],
        impulses: &[Vector],
    ) -> f64 {
        let works = contacts.iter().zip(impulses).map(|(contact, impulse)| {
            let carriers = self.contact(world, contact).into_iter();
            let velocities =
                carriers.map(|(carrier, weight)| carrier.prescribed_velocity() * weight);
            -impulse.dot(&velocities.sum())
        });
        works.sum()
    }

    /// What carries a place, by at most two carriers and their weights.
    pub(super) fn place(
        &self,
        world: &World,
        place: &ContactSite,
    ) -> SmallVec<[(Carrier, f64); 2]> {
        match *place {
            ContactSite::World => SmallVec::new(),
            ContactSite::Body { body, local } => {
                let arm = world.bodies[body.0].arm(&local);
                let carrier = self.body(world, body, arm);
                SmallVec::from_slice(&[(carrier, 1.0)])
            }
            ContactSite::Wire { wire, arc } => {
                let (segment, parameter) = world.wires[wire.0].at(arc);
                let first = self.first_node[wire.0] + segment;
                let (start, end) = (self.nodes[first], self.nodes[first + 1]);
                SmallVec::from_slice(&[(start, 1.0 - parameter), (end, parameter)])
            }
        }
    }
}

/// The velocity of a place before the step.
pub(super) fn velocity_of(world: &World, place: &ContactSite) -> Vector {
    match *place {
        ContactSite::World => Vector::zeros(),
        ContactSite::Body { body, local } => world.bodies[body.0].velocity_at(&local),
        ContactSite::Wire { wire, arc } => {
            let wire = &world.wires[wire.0];
            let (segment, parameter) = wire.at(arc);
            let nodes = &wire.nodes[segment..segment + 2];
            nodes[0].velocity * (1.0 - parameter) + nodes[1].velocity * parameter
        }
    }
}

/// The velocity that is prescribed in the step of a point of a body, 0 of a dynamic one.
fn prescribed(world: &World, id: BodyId, arm: &Vector) -> Vector {
    let body = &world.bodies[id.0];
    if body.dynamic {
        return Vector::zeros();
    }
    let (velocity, spin) = body.prescribed(world.time(), world.settings.step);
    velocity + spin.cross(arm)
}

#[cfg(test)]
mod tests;

//! Islands: what bodies that forces move and contacts tie together. Nothing else does, so each is
//! solved for itself, at the same time as the others.
//!
//! An island is a world of its own while it is solved, and what it comes to hangs on nothing else:
//! not on the number of threads, and not on what else there is, but for what it may
//! [spend](super::budget).

use crate::wire::contact::{ContactConstraint, ContactSite};
use crate::wire::error::{Part, Reason};
use crate::wire::model::{BodyId, NodeKind, WireId};
use crate::wire::solver_cache::SolverCache;
use crate::wire::union_find::UnionFind;
use crate::wire::world::World;

/// What is solved together. All numbers ascend.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Island {
    pub(super) wires: Vec<usize>,
    /// Bodies that forces move, and others that something of it touches.
    pub(super) bodies: Vec<usize>,
    /// Which of all contacts.
    pub(super) contacts: Vec<usize>,
    /// Whether it is all of the world.
    is_whole: bool,
}

impl Island {
    /// All of a world.
    pub(super) fn whole(world: &World, contacts: &[ContactConstraint]) -> Self {
        Island {
            wires: (0..world.wires.len()).collect(),
            bodies: (0..world.bodies.len()).collect(),
            contacts: (0..contacts.len()).collect(),
            is_whole: true,
        }
    }

    /// What forces move of it: wires, and bodies, which are numbered after all wires.
    pub(super) fn members(&self, world: &World) -> impl Iterator<Item = usize> {
        let bodies = self.bodies.iter().copied();
        let moving = bodies.filter(|&body| world.bodies[body].dynamic);
        let wires = self.wires.iter().copied();
        wires.chain(moving.map(|body| world.wires.len() + body))
    }

    /// Its least member.
    pub(super) fn key(&self, world: &World) -> usize {
        self.members(world).next().unwrap_or(0)
    }

    /// It as a world, unless it is all of one.
    pub(super) fn world(&self, world: &World) -> Option<World> {
        if self.is_whole {
            return None;
        }
        let mut own = World {
            settings: world.settings.clone(),
            bodies: self
                .bodies
                .iter()
                .map(|&b| world.bodies[b].clone())
                .collect(),
            wires: self.wires.iter().map(|&w| world.wires[w].clone()).collect(),
            steps: world.steps,
            epoch: world.epoch,
            cache: SolverCache::default(),
        };
        let nodes = own.wires.iter_mut().flat_map(|wire| &mut wire.nodes);
        for node in nodes {
            if let NodeKind::Eye { body, .. } | NodeKind::Contact { body, .. } = &mut node.kind {
                *body = self.body(*body);
            }
        }
        Some(own)
    }

    /// Its contacts, as that world numbers wires and bodies.
    pub(super) fn contacts(&self, contacts: &[ContactConstraint]) -> Vec<ContactConstraint> {
        let own = self.contacts.iter().map(|&at| ContactConstraint {
            a: self.place(&contacts[at].a),
            b: self.place(&contacts[at].b),
            ..contacts[at]
        });
        own.collect()
    }

    fn place(&self, place: &ContactSite) -> ContactSite {
        match *place {
            ContactSite::World => ContactSite::World,
            ContactSite::Body { body, local } => ContactSite::Body {
                body: self.body(body),
                local,
            },
            ContactSite::Wire { wire, arc } => ContactSite::Wire {
                wire: WireId(number(&self.wires, wire.0)),
                arc,
            },
        }
    }

    fn body(&self, body: BodyId) -> BodyId {
        BodyId(number(&self.bodies, body.0))
    }

    /// Why it has no solution, as the whole world numbers wires and bodies.
    pub(super) fn reason(&self, of_own: Reason) -> Reason {
        let whole = |part: Part| match part {
            Part::Node { wire, node } => Part::Node {
                wire: WireId(self.wires[wire.0]),
                node,
            },
            Part::Body(body) => Part::Body(BodyId(self.bodies[body.0])),
        };
        match of_own {
            Reason::Pivot { part } => Reason::Pivot { part: whole(part) },
            Reason::Residual { part, error, limit } => Reason::Residual {
                part: whole(part),
                error,
                limit,
            },
            other => other,
        }
    }

    /// Whether more than one factorisation and one solve may be needed: it has contacts or wires.
    pub(super) fn iterates(&self) -> bool {
        !self.contacts.is_empty() || !self.wires.is_empty()
    }

    /// Segments and contacts.
    pub(super) fn things(&self, world: &World) -> usize {
        let segments = self
            .wires
            .iter()
            .map(|&wire| world.wires[wire].segments.len());
        segments.sum::<usize>() + self.contacts.len()
    }
}

/// Which of these numbers it is.
fn number(ascending: &[usize], at: usize) -> usize {
    ascending.partition_point(|&other| other < at)
}

/// All islands, by their least members. A contact between things that nothing moves is in none, unless
/// there is but one.
pub(super) fn islands(world: &World, contacts: &[ContactConstraint]) -> Vec<Island> {
    let wires = world.wires.len();
    let moves = |body: BodyId| world.bodies[body.0].dynamic;
    let mut groups = UnionFind::new(wires + world.bodies.len());
    let member = |place: &ContactSite| match *place {
        ContactSite::World => None,
        ContactSite::Body { body, .. } => moves(body).then_some(wires + body.0),
        ContactSite::Wire { wire, .. } => Some(wire.0),
    };
    for (w, wire) in world.wires.iter().enumerate() {
        let carriers = wire.nodes.iter().filter_map(|node| node.kind.carrier());
        for (body, _) in carriers.filter(|(body, _)| moves(*body)) {
            groups.join(w, wires + body.0);
        }
    }
    for contact in contacts {
        if let (Some(a), Some(b)) = (member(&contact.a), member(&contact.b)) {
            groups.join(a, b);
        }
    }
    let is_there = |&member: &usize| member < wires || moves(BodyId(member - wires));
    let mut islands: Vec<Island> = Vec::new();
    let mut of_root = vec![usize::MAX; groups.len()];
    for member in (0..groups.len()).filter(is_there) {
        let root = groups.root(member);
        if of_root[root] == usize::MAX {
            of_root[root] = islands.len();
            islands.push(Island {
                wires: Vec::new(),
                bodies: Vec::new(),
                contacts: Vec::new(),
                is_whole: false,
            });
        }
        let island = &mut islands[of_root[root]];
        if member < wires {
            island.wires.push(member);
            let carriers = world.wires[member].nodes.iter();
            let carriers = carriers.filter_map(|node| node.kind.carrier());
            island.bodies.extend(carriers.map(|(body, _)| body.0));
        } else {
            island.bodies.push(member - wires);
        }
    }
    if islands.len() < 2 {
        return vec![Island::whole(world, contacts)];
    }
    for (at, contact) in contacts.iter().enumerate() {
        let Some(member) = member(&contact.a).or_else(|| member(&contact.b)) else {
            continue;
        };
        let island = &mut islands[of_root[groups.root(member)]];
        island.contacts.push(at);
        for place in [&contact.a, &contact.b] {
            if let ContactSite::Body { body, .. } = place {
                island.bodies.push(body.0);
            }
        }
    }
    for island in &mut islands {
        island.bodies.sort_unstable();
        island.bodies.dedup();
    }
    islands
}

#[cfg(test)]
mod tests;

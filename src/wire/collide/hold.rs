//! Motion that is shortened because a crossing is left.

use super::detect::Hit;
use crate::wire::Vector;
use crate::wire::contact::{Contact, Place};
use crate::wire::model::{BodyId, WireId};
use crate::wire::record::Held;
use crate::wire::step::motion::Shares;
use crate::wire::world::World;

/// How often motion is shortened before nothing moves at all.
const TRIES: usize = 20;

/// The part of the way to a crossing that is gone.
const PART: f64 = 0.9;

/// Islands, the things that are tied to each other by eyes and contacts, and the share of its motion that each makes.
///
/// All that meets shares a fate: a hit joins its islands and shortens them. Within one island a shorter motion
/// is a part of the longer one; that islands of different shares do not meet is tested again. After
/// some tries nothing moves, and where nothing moves nothing new meets.
pub(super) struct Hold {
    /// Wires, then bodies: each one's way to the root of its island.
    parent: Vec<usize>,
    /// Of roots.
    share: Vec<f64>,
    wires: usize,
    tries: usize,
}

impl Hold {
    pub(super) fn new(world: &World, contacts: &[Contact], impulses: &[Vector]) -> Self {
        let wires = world.wires.len();
        let count = wires + world.bodies.len();
        let mut hold = Hold {
            parent: (0..count).collect(),
            share: vec![1.0; count],
            wires,
            tries: 0,
        };
        for (w, wire) in world.wires.iter().enumerate() {
            for (body, _) in wire.nodes.iter().filter_map(|node| node.kind.carrier()) {
                if moves(world, body) {
                    hold.join(w, wires + body.0);
                }
            }
        }
        for (contact, impulse) in contacts.iter().zip(impulses) {
            let [a, b] = [&contact.a, &contact.b].map(|place| hold.thing(world, place));
            if let (Some(a), Some(b), true) = (a, b, impulse.norm_squared() > 0.0) {
                hold.join(a, b);
            }
        }
        hold
    }

    fn thing(&self, world: &World, place: &Place) -> Option<usize> {
        match *place {
            Place::World => None,
            Place::Body { body, .. } => moves(world, body).then_some(self.wires + body.0),
            Place::Wire { wire, .. } => Some(wire.0),
        }
    }

    fn root(&self, mut thing: usize) -> usize {
        while self.parent[thing] != thing {
            thing = self.parent[thing];
        }
        thing
    }

    fn join(&mut self, a: usize, b: usize) -> usize {
        let [a, b] = [self.root(a), self.root(b)];
        let (root, other) = (a.min(b), a.max(b));
        self.parent[other] = root;
        self.share[root] = self.share[root].min(self.share[other]);
        root
    }

    /// Whether nothing moves any more.
    pub(super) fn is_still(&self) -> bool {
        self.share.iter().all(|share| *share == 0.0)
    }

    /// Shortens the islands of what meets.
    pub(super) fn shorten(&mut self, hits: &[Hit]) {
        self.tries += 1;
        if self.tries > TRIES {
            self.share.fill(0.0);
            return;
        }
        for hit in hits {
            self.join(hit.sites[0].wire.0, hit.sites[1].wire.0);
        }
        let mut part = vec![1.0f64; self.share.len()];
        for hit in hits {
            let root = self.root(hit.sites[0].wire.0);
            part[root] = part[root].min(PART * hit.contact.toi);
        }
        for (share, part) in self.share.iter_mut().zip(part) {
            *share *= part;
        }
    }

    pub(super) fn shares(&self) -> Shares {
        let all: Vec<f64> = (0..self.parent.len())
            .map(|thing| self.share[self.root(thing)])
            .collect();
        let (wires, bodies) = all.split_at(self.wires);
        Shares {
            wires: wires.to_vec(),
            bodies: bodies.to_vec(),
        }
    }

    /// The islands that were shortened.
    pub(super) fn held(&self, world: &World) -> Vec<Held> {
        let roots = (0..self.parent.len()).filter(|&thing| self.parent[thing] == thing);
        let short = roots.filter(|&root| self.share[root] < 1.0);
        let islands = short.map(|root| {
            let of = |thing: usize| self.root(thing) == root;
            let wires = (0..self.wires).filter(|&w| of(w)).map(WireId);
            let bodies = (0..world.bodies.len()).filter(|&b| of(self.wires + b));
            let bodies = bodies.map(BodyId).filter(|&body| moves(world, body));
            let bodies: Vec<BodyId> = bodies.collect();
            let prescribed = |body: &&BodyId| !world.bodies[body.0].dynamic;
            Held {
                share: self.share[root],
                wires: wires.collect(),
                behind: bodies.iter().filter(prescribed).copied().collect(),
                bodies,
            }
        });
        let islands = islands.filter(|held| !held.wires.is_empty() || !held.bodies.is_empty());
        islands.collect()
    }
}

/// Whether a body can move. What cannot ties nothing together.
fn moves(world: &World, body: BodyId) -> bool {
    let body = &world.bodies[body.0];
    body.dynamic || !body.phases.is_empty()
}

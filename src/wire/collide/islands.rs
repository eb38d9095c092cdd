//! ProposedMotion that is shortened because a crossing is left.

use super::body_detect::CoreHits;
use super::detect::MidlineHit;
use crate::wire::Vector;
use crate::wire::contact::{ContactConstraint, ContactSite};
use crate::wire::model::{BodyId, WireId};
use crate::wire::record::ScaledIsland;
use crate::wire::step::motion::MotionScales;
use crate::wire::union_find::UnionFind;
use crate::wire::world::World;

/// How often motion is shortened before nothing moves at all.
const ATTEMPTS: usize = 20;

/// Motion goes up to this fraction of the time to a crossing.
pub(super) const SAFETY: f64 = 0.9;

/// Islands: wires and bodies that eyes and contacts tie together, and the factor on the motion of
/// each island.
///
/// A hit joins the islands of both wires and scales their motion down. Within an island a scaled
/// motion is the first part of the whole one. Islands of different factors may meet, so the scaled
/// motion is tested again. After [`ATTEMPTS`] nothing moves, and where nothing moves nothing new
/// meets.
pub(super) struct Islands {
    /// Wires, then bodies.
    groups: UnionFind,
    /// Of roots.
    scale: Vec<f64>,
    wires: usize,
    attempts: usize,
}

impl Islands {
    pub(super) fn new(world: &World, contacts: &[ContactConstraint], impulses: &[Vector]) -> Self {
        let wires = world.wires.len();
        let count = wires + world.bodies.len();
        let mut islands = Islands {
            groups: UnionFind::new(count),
            scale: vec![1.0; count],
            wires,
            attempts: 0,
        };
        for (w, wire) in world.wires.iter().enumerate() {
            for (body, _) in wire.nodes.iter().filter_map(|node| node.kind.carrier()) {
                if moves(world, body) {
                    islands.join(w, wires + body.0);
                }
            }
        }
        for (contact, impulse) in contacts.iter().zip(impulses) {
            let [a, b] = [&contact.a, &contact.b].map(|place| islands.member(world, place));
            if let (Some(a), Some(b), true) = (a, b, impulse.norm_squared() > 0.0) {
                islands.join(a, b);
            }
        }
        islands
    }

    fn member(&self, world: &World, place: &ContactSite) -> Option<usize> {
        match *place {
            ContactSite::World => None,
            ContactSite::Body { body, .. } => moves(world, body).then_some(self.wires + body.0),
            ContactSite::Wire { wire, .. } => Some(wire.0),
        }
    }

    fn join(&mut self, a: usize, b: usize) {
        let [root, other] = self.groups.join(a, b);
        self.scale[root] = self.scale[root].min(self.scale[other]);
    }

    /// Whether nothing moves any more.
    pub(super) fn is_still(&self) -> bool {
        self.scale.iter().all(|scale| *scale == 0.0)
    }

    /// Joins the islands of each hit and scales their motion down.
    pub(super) fn shorten(&mut self, world: &World, hits: &[MidlineHit], cores: &CoreHits) {
        self.attempts += 1;
        if self.attempts > ATTEMPTS {
            self.scale.fill(0.0);
            return;
        }
        for hit in hits {
            self.join(hit.sites[0].wire.0, hit.sites[1].wire.0);
        }
        let midlines = cores.midlines.iter();
        for hit in midlines.clone().filter(|hit| moves(world, hit.body)) {
            self.join(hit.site.wire.0, self.wires + hit.body.0);
        }
        let pairs = cores.bodies.iter();
        let pairs: Vec<_> = pairs
            .filter_map(|hit| {
                let of = hit.bodies().into_iter();
                let mut moving = of.filter(|body| moves(world, *body));
                let first = self.wires + moving.next()?.0;
                if let Some(second) = moving.next() {
                    self.join(first, self.wires + second.0);
                }
                Some((first, hit.toi))
            })
            .collect();
        let mut part = vec![1.0f64; self.scale.len()];
        let of_wires = hits
            .iter()
            .map(|hit| (hit.sites[0].wire.0, hit.contact.toi));
        let of_midlines = midlines.map(|hit| (hit.site.wire.0, hit.toi));
        for (member, toi) in of_wires.chain(of_midlines).chain(pairs) {
            let root = self.groups.root(member);
            part[root] = part[root].min(SAFETY * toi);
        }
        for (scale, part) in self.scale.iter_mut().zip(part) {
            *scale *= part;
        }
    }

    pub(super) fn motion_scales(&self, world: &World) -> MotionScales {
        let all: Vec<f64> = (0..self.groups.len())
            .map(|member| self.scale[self.groups.root(member)])
            .collect();
        let (wires, bodies) = all.split_at(self.wires);
        MotionScales {
            nodes: (wires.iter().zip(&world.wires))
                .map(|(&scale, wire)| vec![scale; wire.nodes.len()])
                .collect(),
            bodies: bodies.to_vec(),
        }
    }

    /// The islands whose motion was scaled down.
    pub(super) fn scaled(&self, world: &World) -> Vec<ScaledIsland> {
        let roots = (0..self.groups.len()).filter(|&member| self.groups.is_root(member));
        let short = roots.filter(|&root| self.scale[root] < 1.0);
        let islands = short.map(|root| {
            let of = |member: usize| self.groups.root(member) == root;
            let wires = (0..self.wires).filter(|&w| of(w)).map(WireId);
            let bodies = (0..world.bodies.len()).filter(|&b| of(self.wires + b));
            let bodies = bodies.map(BodyId).filter(|&body| moves(world, body));
            let bodies: Vec<BodyId> = bodies.collect();
            let prescribed = |body: &&BodyId| !world.bodies[body.0].dynamic;
            ScaledIsland {
                motion_scale: self.scale[root],
                wires: wires.collect(),
                behind: bodies.iter().filter(prescribed).copied().collect(),
                bodies,
            }
        });
        let islands =
            islands.filter(|island| !island.wires.is_empty() || !island.bodies.is_empty());
        islands.collect()
    }
}

/// Whether a body can move. What cannot ties nothing together.
pub(super) fn moves(world: &World, body: BodyId) -> bool {
    let body = &world.bodies[body.0];
    body.dynamic || !body.phases.is_empty()
}

//! Motion that is shortened node by node, where thickness is guarded.
//!
//! Thick wires that lie on each other touch in many places. If all that is tied together moved less
//! wherever two segments come too near, a whole pile would stand still in the air. So the nodes of
//! these two segments are shortened alone, and what is shortened between others is tested again.

use super::body_detect::CoreHits;
use super::detect::MidlineHit;
use super::islands::{SAFETY, moves};
use crate::wire::model::{BodyId, WireId};
use crate::wire::record::ScaledIsland;
use crate::wire::site::SegmentId;
use crate::wire::step::motion::MotionScales;
use crate::wire::world::World;

/// How often motion is shortened before two segments that come too near do not move at all.
const ATTEMPTS: usize = 10;

/// The factor on the motion of every body and of every node that no body carries.
///
/// Two segments whose nodes have one factor make the first part of their motion. After
/// [`ATTEMPTS`] it is 0. So each further attempt leaves fewer nodes that move, and where nothing
/// moves nothing new meets.
pub(super) struct Parts {
    scales: MotionScales,
    attempts: usize,
}

impl Parts {
    pub(super) fn new(world: &World) -> Self {
        Parts {
            scales: MotionScales::all(world),
            attempts: 0,
        }
    }

    /// Scales the motion of each hit down, of two segments, of a segment and a body, or of two bodies.
    /// False if one does not move any more.
    pub(super) fn shorten(&mut self, world: &World, hits: &[MidlineHit], cores: &CoreHits) -> bool {
        self.attempts += 1;
        let before = self.scales.clone();
        for hit in hits {
            let nodes = hit.segments().map(nodes);
            self.shorten_nodes(world, &before, nodes.as_flattened(), 1.0, hit.contact.toi);
        }
        for hit in &cores.midlines {
            let body = hit.body.0;
            let (nodes, own) = (nodes(hit.segment), before.bodies[body]);
            let scale = self.shorten_nodes(world, &before, &nodes, own, hit.toi);
            let part = &mut self.scales.bodies[body];
            *part = part.min(scale);
        }
        for hit in &cores.bodies {
            let bodies = hit.bodies().map(|body| body.0);
            let least = bodies
                .iter()
                .fold(1.0, |least: f64, body| least.min(before.bodies[*body]));
            let scale = self.scale(least, hit.toi);
            for body in bodies {
                let part = &mut self.scales.bodies[body];
                *part = part.min(scale);
            }
        }
        self.scales != before
    }

    /// Scales the motion of some nodes down, from the least of their factors and of another one.
    /// Returns the new factor.
    fn shorten_nodes(
        &mut self,
        world: &World,
        before: &MotionScales,
        nodes: &[(usize, usize)],
        other: f64,
        toi: f64,
    ) -> f64 {
        let of = |&(wire, node): &(usize, usize)| before.of(world, wire, node);
        let least = nodes.iter().map(of).fold(other, f64::min);
        let scale = self.scale(least, toi);
        for &(wire, node) in nodes {
            let part = self.scales.part(world, wire, node);
            *part = part.min(scale);
        }
        scale
    }

    /// What becomes of a factor where what it is of touches.
    fn scale(&self, least: f64, toi: f64) -> f64 {
        match self.attempts > ATTEMPTS {
            true => 0.0,
            false => least * SAFETY * toi,
        }
    }

    pub(super) fn motion_scales(&self) -> MotionScales {
        self.scales.clone()
    }

    /// What was scaled down, by its factor.
    pub(super) fn scaled(&self, world: &World) -> Vec<ScaledIsland> {
        let mut islands: Vec<ScaledIsland> = Vec::new();
        let mut of = |scale: f64| {
            let known = islands
                .iter()
                .position(|island| island.motion_scale == scale);
            let at = known.unwrap_or(islands.len());
            if known.is_none() {
                islands.push(ScaledIsland {
                    motion_scale: scale,
                    wires: Vec::new(),
                    bodies: Vec::new(),
                    behind: Vec::new(),
                });
            }
            at
        };
        let mut wires = Vec::new();
        for (w, wire) in self.scales.nodes.iter().enumerate() {
            let short = wire.iter().filter(|scale| **scale < 1.0);
            wires.extend(short.map(|&scale| (of(scale), WireId(w))));
        }
        let bodies = self.scales.bodies.iter().enumerate();
        let bodies = bodies.map(|(b, &scale)| (BodyId(b), scale));
        let short = bodies.filter(|&(body, scale)| scale < 1.0 && moves(world, body));
        let bodies: Vec<_> = short.map(|(body, scale)| (of(scale), body)).collect();
        for (at, wire) in wires {
            if islands[at].wires.last() != Some(&wire) {
                islands[at].wires.push(wire);
            }
        }
        for (at, body) in bodies {
            islands[at].bodies.push(body);
            if !world.bodies[body.0].dynamic {
                islands[at].behind.push(body);
            }
        }
        islands
    }
}

/// Both nodes of a segment, by wire and number.
fn nodes(id: SegmentId) -> [(usize, usize); 2] {
    [0, 1].map(|end| (id.wire.0, id.segment + end))
}

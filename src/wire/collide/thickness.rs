//! How far apart guard mode keeps two segments.
//!
//! A share of the thickness is guarded. Two segments that are farther apart than that share of the
//! sum of their radii where a motion starts stay farther apart. Two that are nearer come no nearer,
//! on a scale of [`STEPS`] steps: of the distances `share (j / 64) (r1 + r2)` they stay beyond the
//! last one that they are beyond. The scale is the same in every time step, so what rests or slides
//! for long loses no more by rounding than what moves once.
//!
//! A stretch of wire of length `g` that is bent into half a circle has its ends `2 g / pi` apart. So
//! places of one wire that are nearer along it than `pi / 2` diameters touch at that distance only,
//! and that much less of their thickness is guarded. Neighbours have nothing between them.

use std::f64::consts::FRAC_2_PI;

use smallvec::SmallVec;

use super::segment::{reach, stretch_between};
use crate::certified::decide_discrete;
use crate::query::{EdgeEdge, Point, QueryError};
use crate::wire::model::BodyId;
use crate::wire::site::{SegmentId, WireSite};
use crate::wire::world::World;

/// Steps of the scale.
const STEPS: u32 = 64;

/// The share of the thickness that is guarded, in `[0, 1)`. With 0 it is midlines that are kept
/// apart, and no more.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Thickness(pub(super) f64);

impl Thickness {
    pub(super) fn is_guarded(self) -> bool {
        self.0 > 0.0
    }

    /// How much nearer to each other than two radii places of one wire touch, in m, because the wire
    /// bends between them.
    pub(super) fn allowance(
        self,
        world: &World,
        pair: [SegmentId; 2],
        sites: &[WireSite; 2],
    ) -> f64 {
        let [a, b] = sites;
        if !self.is_guarded() || a.wire != b.wire {
            return 0.0;
        }
        (reach(world, pair) - FRAC_2_PI * (a.arc - b.arc).abs()).max(0.0)
    }

    /// The distance at which the surfaces at two places touch, in m.
    pub(super) fn touching(
        self,
        world: &World,
        pair: [SegmentId; 2],
        sites: &[WireSite; 2],
    ) -> f64 {
        reach(world, pair) - self.allowance(world, pair, sites)
    }

    /// Whether two places are no contact at any distance, because they are so close along one wire, or along two
    /// to places of one body, that thickness brings them together. Where thickness is guarded there are no such
    /// places, but an [`allowance`](Self::allowance), and what one body [holds](is_held).
    pub(super) fn is_bend(
        self,
        world: &World,
        pair: [SegmentId; 2],
        sites: &[WireSite; 2],
    ) -> bool {
        let [a, b] = sites;
        let reach = reach(world, pair);
        let near = || (a.arc - b.arc).abs() <= 2.0 * reach;
        let is_bend = || a.wire == b.wire && near() || is_held(world, pair, sites, reach);
        !self.is_guarded() && is_bend()
    }

    /// How far along both wires contacts are one, in m: as far as they are thick. Where thickness is
    /// guarded not farther than half a segment, so that each may have a contact at both ends.
    pub(super) fn spacing(self, world: &World, sites: &[WireSite; 2]) -> f64 {
        let diameter = self.most_spacing(world, sites);
        if !self.is_guarded() {
            return diameter;
        }
        let wires = sites.map(|site| &world.wires[site.wire.0]);
        let half = |k: usize| wires[k].rest_length(wires[k].at(sites[k].arc).0) / 2.0;
        diameter.min(half(0)).min(half(1))
    }

    /// The most that [`spacing`](Self::spacing) can be, in m.
    pub(super) fn most_spacing(self, world: &World, sites: &[WireSite; 2]) -> f64 {
        let radius = |site: &WireSite| world.wires[site.wire.0].material.radius;
        radius(&sites[0]) + radius(&sites[1])
    }

    /// The motion of two segments. Its radius is what they have to stay beyond.
    pub(super) fn query(
        self,
        world: &World,
        pair: [SegmentId; 2],
        start: [Point; 4],
        end: [Point; 4],
    ) -> Result<EdgeEdge, QueryError> {
        let limit = self.limit(world, pair, stretch_between(world, pair));
        let step = self.beyond(world, pair, start, limit)?;
        EdgeEdge::new(start, end, self.radii(world, pair, step))
    }

    /// The last step of the scale that two segments can be beyond: the last one of all, or as much
    /// as the stretch of wire between them leaves.
    pub(super) fn limit(self, world: &World, pair: [SegmentId; 2], stretch: Option<f64>) -> u32 {
        let Some(stretch) = stretch else { return STEPS };
        let share = FRAC_2_PI * stretch / reach(world, pair);
        // A whole number, rounded down.
        (share.clamp(0.0, 1.0) * f64::from(STEPS)) as u32
    }

    /// The last step up to a limit that two segments at rest are beyond. Exact.
    pub(super) fn beyond(
        self,
        world: &World,
        pair: [SegmentId; 2],
        points: [Point; 4],
        limit: u32,
    ) -> Result<u32, QueryError> {
        if !self.is_guarded() || limit == 0 {
            return Ok(0);
        }
        let at = |step| {
            let query = EdgeEdge::at_rest(points, self.radii(world, pair, step))?;
            Ok(decide_discrete(&query))
        };
        let found = at(limit)?;
        if !found.touches {
            return Ok(limit);
        }
        // As far as the bounds tell, and from there one by one.
        let share = found.distance_high / (self.0 * reach(world, pair));
        let near = (share * f64::from(STEPS)).min(f64::from(limit)) as u32;
        let mut step = limit.min(near + 1);
        while step > 0 && at(step)?.touches {
            step -= 1;
        }
        Ok(step)
    }

    /// The two numbers whose exact sum is a step of the scale.
    pub(super) fn radii(self, world: &World, pair: [SegmentId; 2], step: u32) -> [f64; 2] {
        let share = self.0 * (f64::from(step) / f64::from(STEPS));
        pair.map(|segment| share * segment.of(world).material.radius)
    }
}

/// Whether two places are no farther along their segments than `within`, in m, from two nodes on one body: what
/// is between the nodes never changes.
pub(super) fn is_held(
    world: &World,
    pair: [SegmentId; 2],
    sites: &[WireSite; 2],
    within: f64,
) -> bool {
    let bodies = [0, 1].map(|k| {
        let nodes = pair[k].nodes(world).into_iter();
        let near = nodes.filter(move |node| (node.arc - sites[k].arc).abs() <= within);
        near.filter_map(|node| Some(node.kind.carrier()?.0))
    });
    let [a, b] = bodies;
    let b: SmallVec<[BodyId; 2]> = b.collect();
    a.into_iter().any(|body| b.contains(&body))
}

#[cfg(test)]
mod tests;

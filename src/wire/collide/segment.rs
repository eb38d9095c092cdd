//! Segments of wires, places on them, and how close two are.

use crate::closest::closest;
use crate::query::Point;
use crate::wire::Vector;
use crate::wire::model::{Node, NodeKind, Wire};
use crate::wire::site::{SegmentId, WireSite};
use crate::wire::world::World;

/// Which pairs of segments are tested at all, over and above those that are joined.
pub type PairFilter<'n> = &'n dyn Fn(SegmentId, SegmentId) -> bool;

impl SegmentId {
    pub(super) fn of(self, world: &World) -> &Wire {
        &world.wires[self.wire.0]
    }

    pub(super) fn nodes(self, world: &World) -> [&Node; 2] {
        [0, 1].map(|end| &self.of(world).nodes[self.segment + end])
    }

    /// Where its ends are.
    pub(super) fn ends(self, world: &World) -> [Point; 2] {
        self.nodes(world).map(|node| node.position)
    }

    /// The site at a parameter from 0 to 1 along the segment. Next to a node it is that of the
    /// node, so that all segments there give the same site.
    pub(super) fn site(self, world: &World, parameter: f64) -> WireSite {
        const NEXT: f64 = 1e-9;
        let [start, end] = self.nodes(world).map(|node| node.arc);
        let arc = if parameter <= NEXT {
            start
        } else if parameter >= 1.0 - NEXT {
            end
        } else {
            start + (end - start) * parameter
        };
        let wire = self.wire;
        WireSite { wire, arc }
    }

    /// The neighbour beyond an end, at 0 or 1, if there is one; none from inside.
    pub(super) fn beyond(self, world: &World, parameter: f64) -> Option<Self> {
        let segment = match parameter {
            0.0 => self.segment.checked_sub(1),
            1.0 => Some(self.segment + 1).filter(|&to| to < self.of(world).segments.len()),
            _ => None,
        }?;
        Some(SegmentId { segment, ..self })
    }

    /// The segment at a place, if its wire is there; at a node the one after it, at the last node
    /// the last.
    pub(super) fn at(world: &World, site: &WireSite) -> Option<Self> {
        let wire = world.wires.get(site.wire.0)?;
        let (segment, _) = wire.at(site.arc);
        let wire = site.wire;
        Some(SegmentId { wire, segment })
    }
}

/// The segments at two places, if their wires are there.
pub(super) fn pair_at(world: &World, [a, b]: &[WireSite; 2]) -> Option<[SegmentId; 2]> {
    Some([SegmentId::at(world, a)?, SegmentId::at(world, b)?])
}

/// The sum of the radii of two wires, in m: closer than this their surfaces meet.
pub(super) fn reach(world: &World, pair: [SegmentId; 2]) -> f64 {
    let [a, b] = pair.map(|segment| segment.of(world).material.radius);
    a + b
}

/// The length of wire between two segments, if they are of one wire; 0 between neighbours.
pub(super) fn stretch_between(world: &World, [a, b]: [SegmentId; 2]) -> Option<f64> {
    let (first, last) = (a.min(b), a.max(b));
    let [end, start] = [first.nodes(world)[1].arc, last.nodes(world)[0].arc];
    (a.wire == b.wire).then(|| (start - end).max(0.0))
}

/// Whether two segments are no pair to test: one and the same, of one node, or fixed to one point.
pub(super) fn joined(world: &World, [a, b]: [SegmentId; 2]) -> bool {
    let neighbours = a.wire == b.wire && a.segment.abs_diff(b.segment) <= 1;
    let one_point = |x: &Node| b.nodes(world).iter().any(|y| fixed_together(x, y));
    neighbours || a.nodes(world).into_iter().any(one_point)
}

fn fixed_together(x: &Node, y: &Node) -> bool {
    match (x.kind.carrier(), y.kind.carrier()) {
        (Some(x), Some(y)) => x == y,
        (None, None) => {
            let pinned = |node: &Node| node.kind == NodeKind::Pinned;
            pinned(x) && pinned(y) && x.position == y.position
        }
        _ => false,
    }
}

/// The closest points of two segments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Closest {
    /// Where on each, from 0 to 1.
    pub(super) parameters: [f64; 2],
    /// From B to A.
    pub(super) separation: Vector,
}

impl Closest {
    /// Of the segments `AB` and `CD`.
    pub(super) fn new(points: &[Point; 4]) -> Self {
        let x = points.map(|point| point.coords);
        let (u, v) = closest(&x);
        let separation = between(points, [u, v]);
        let parameters = [u, v];
        Closest {
            parameters,
            separation,
        }
    }

    pub(super) fn of(world: &World, [a, b]: [SegmentId; 2]) -> Self {
        let ([a, b], [c, d]) = (a.ends(world), b.ends(world));
        Closest::new(&[a, b, c, d])
    }

    /// Of one end, at 0 or 1, of one of two segments and of the other segment.
    pub(super) fn beside(world: &World, pair: [SegmentId; 2], which: usize, end: f64) -> Self {
        let [start, last] = pair[which].ends(world);
        let point = if end == 0.0 { start } else { last };
        let [a, b] = pair[1 - which].ends(world);
        let span = b - a;
        let along = (point - a).dot(&span) / span.norm_squared();
        // A segment without length is at its start.
        let along = if along > 0.0 { along.min(1.0) } else { 0.0 };
        let apart = point - (a + span * along);
        if which == 0 {
            Closest {
                parameters: [end, along],
                separation: apart,
            }
        } else {
            Closest {
                parameters: [along, end],
                separation: -apart,
            }
        }
    }

    /// The places on both segments.
    pub(super) fn sites(&self, world: &World, pair: [SegmentId; 2]) -> [WireSite; 2] {
        [0, 1].map(|k| pair[k].site(world, self.parameters[k]))
    }

    pub(super) fn distance(&self) -> f64 {
        self.separation.norm()
    }
}

/// From the place at `v` on `CD` to the place at `u` on `AB`.
pub(super) fn between([a, b, c, d]: &[Point; 4], [u, v]: [f64; 2]) -> Vector {
    (a - c) + (b - a) * u - (d - c) * v
}

/// A direction of length 1 to rounding, also where the square of the length is beyond `f64`; none
/// of 0.
pub(super) fn direction(vector: &Vector) -> Option<Vector> {
    let largest = vector.amax();
    (largest > 0.0 && largest.is_finite()).then(|| (vector / largest).normalize())
}

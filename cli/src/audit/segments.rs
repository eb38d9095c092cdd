//! The segments of all wires on their way, and which pairs of them can meet.

use tunnelproof::query::{EdgeEdge, Point, QueryError};
use tunnelproof::wire::{NodeKind, SegmentId, StepRecord, WireId};

use super::aside::{Held, Node};

/// A segment on its way: straight, from start to end.
pub(super) struct Segment {
    pub(super) id: SegmentId,
    pub(super) start: [Point; 2],
    pub(super) end: [Point; 2],
    pub(super) radius: f64,
    arcs: [f64; 2],
    is_last: [bool; 2],
    pub(super) kinds: [NodeKind; 2],
}

impl Segment {
    /// The smallest and the largest coordinates on the way, so far farther. If that is 0 they are
    /// compared and not computed, so they are exact.
    fn reach(&self, farther: f64) -> [[f64; 2]; 3] {
        let points = [self.start, self.end];
        let wider = |[low, high]: [f64; 2]| match farther > 0.0 {
            true => [(low - farther).next_down(), (high + farther).next_up()],
            false => [low, high],
        };
        [0, 1, 2].map(|axis| {
            let of = points.as_flattened().iter().map(|point| point[axis]);
            wider([
                of.clone().fold(f64::INFINITY, f64::min),
                of.fold(f64::NEG_INFINITY, f64::max),
            ])
        })
    }

    /// The length of wire between two segments, if they are of one wire.
    pub(super) fn stretch(&self, other: &Segment) -> Option<f64> {
        let (first, last) = match self.id < other.id {
            true => (self, other),
            false => (other, self),
        };
        let stretch = last.arcs[0] - first.arcs[1];
        (self.id.wire == other.id.wire).then(|| stretch.max(0.0))
    }

    /// The same segment, at rest where the motion ends.
    pub(super) fn ended(&self) -> Segment {
        Segment {
            start: self.end,
            ..*self
        }
    }

    /// It and what fixes its ends.
    pub(super) fn held(&self) -> Held {
        let id = self.id;
        let node = |at: [Point; 2], k: usize| Node {
            arc: self.arcs[k],
            kind: self.kinds[k],
            at: at[k],
        };
        let ends = [self.start, self.end].map(|at| [0, 1].map(|k| node(at, k)));
        let is_last = self.is_last;
        Held { id, ends, is_last }
    }

    /// Whether two segments are one and the same, have a node in common, or are fixed to one point.
    fn is_joined(&self, other: &Segment) -> bool {
        let (a, b) = (self.id, other.id);
        let neighbours = a.wire == b.wire && a.segment.abs_diff(b.segment) <= 1;
        let ends = |segment: &Segment| [0, 1].map(|k| (segment.kinds[k], segment.start[k]));
        let one_point = |x: &(NodeKind, Point)| ends(other).iter().any(|y| is_one_point(x, y));
        neighbours || ends(self).iter().any(one_point)
    }
}

/// Whether two nodes are fixed to the same point of a body or of the world.
pub(super) fn is_one_point(x: &(NodeKind, Point), y: &(NodeKind, Point)) -> bool {
    match (x.0.carrier(), y.0.carrier()) {
        (Some(x), Some(y)) => x == y,
        (None, None) => x == y && x.0 == NodeKind::Pinned,
        _ => false,
    }
}

/// All segments in the motion of a step.
pub(super) fn moving(record: &StepRecord) -> Vec<Segment> {
    let mut all = Vec::new();
    for (w, wire) in record.wires.iter().enumerate() {
        let nodes = wire
            .before
            .len()
            .min(wire.after.len())
            .min(wire.kinds.len())
            .min(wire.arcs.len());
        for segment in 0..nodes.saturating_sub(1) {
            let at = |points: &[Point]| [points[segment], points[segment + 1]];
            let wire_id = WireId(w);
            all.push(Segment {
                id: SegmentId {
                    wire: wire_id,
                    segment,
                },
                start: at(&wire.before),
                end: at(&wire.after),
                radius: wire.radius,
                is_last: [segment == 0, segment + 2 == nodes],
                arcs: [wire.arcs[segment], wire.arcs[segment + 1]],
                kinds: [wire.kinds[segment], wire.kinds[segment + 1]],
            });
        }
    }
    all
}

/// The question whether two segments meet.
pub(super) fn query(a: &Segment, b: &Segment) -> Result<EdgeEdge, QueryError> {
    EdgeEdge::new(four(a.start, b.start), four(a.end, b.end), 0.0)
}

/// The points of two segments.
pub(super) fn four(a: [Point; 2], b: [Point; 2]) -> [Point; 4] {
    [a[0], a[1], b[0], b[1]]
}

/// All pairs whose boxes meet and that are not joined, by number, the smaller first. The boxes are
/// wider by a share of the radius.
pub(super) fn candidates(segments: &[Segment], share: f64) -> Vec<[usize; 2]> {
    let reach = |segment: &Segment| segment.reach(share * segment.radius);
    let reaches: Vec<_> = segments.iter().map(reach).collect();
    let axis = widest(&reaches);
    let mut order: Vec<usize> = (0..segments.len()).collect();
    order.sort_by(|&a, &b| reaches[a][axis][0].total_cmp(&reaches[b][axis][0]));
    let mut pairs = Vec::new();
    for (k, &a) in order.iter().enumerate() {
        let near = |b: &&usize| reaches[**b][axis][0] <= reaches[a][axis][1];
        for &b in order[k + 1..].iter().take_while(near) {
            let meet = (0..3).all(|axis| {
                let [[low, high], [other_low, other_high]] = [a, b].map(|k| reaches[k][axis]);
                low <= other_high && other_low <= high
            });
            if meet && !segments[a].is_joined(&segments[b]) {
                pairs.push([a.min(b), a.max(b)]);
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

/// The axis along which the segments are spread the most.
fn widest(reaches: &[[[f64; 2]; 3]]) -> usize {
    let spread = |axis: usize| {
        let low = reaches
            .iter()
            .map(|reach| reach[axis][0])
            .fold(f64::INFINITY, f64::min);
        let high = reaches
            .iter()
            .map(|reach| reach[axis][1])
            .fold(f64::NEG_INFINITY, f64::max);
        high - low
    };
    (0..3)
        .max_by(|&a, &b| spread(a).total_cmp(&spread(b)))
        .unwrap_or(0)
}

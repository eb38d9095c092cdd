//! Changes of resolution as motions.

use super::segment::PairFilter;
use super::segment::joined;
use super::thickness::Thickness;
use crate::broad::Aabb;
use crate::certified::decide;
use crate::query::{EdgeEdge, QueryError};
use crate::wire::error::CollisionError;
use crate::wire::model::{NodeKind, Wire, WireId};
use crate::wire::resolution::Remesh;
use crate::wire::site::SegmentId;
use crate::wire::world::World;

/// Whether the triangle that a change sweeps meets another segment, by the certified path: no time
/// passes in a change, so it is nothing that a narrow phase for motions would be asked.
///
/// The segment from `b` to `c` whose end `b` goes straight to `a` passes every point of the
/// triangle `abc` and no other, so one query without rounding asks for all of it. Segments at the
/// corners are left out, as neighbours are in a step.
pub(super) fn meets(
    world: &World,
    change: &Remesh,
    filter: Option<PairFilter<'_>>,
    thickness: Thickness,
) -> Result<bool, CollisionError> {
    let [a, b, c] = change.triangle;
    let guarded = |wire: &Wire| thickness.0 * wire.material.radius;
    let swept = Aabb::swept(&[b, c], &[a, c], guarded(&world.wires[change.wire.0]))?;
    let own = own(world, change);
    for (w, of) in world.wires.iter().enumerate() {
        for segment in 0..of.segments.len() {
            let wire = WireId(w);
            let other = SegmentId { wire, segment };
            let tested = |&mine: &SegmentId| filter.is_none_or(|keep| keep(mine, other));
            if own.iter().any(|&mine| joined(world, [mine, other])) || !own.iter().any(tested) {
                continue;
            }
            let ends = other.ends(world);
            if !Aabb::swept(&ends, &ends, guarded(of))?.overlaps(&swept) {
                continue;
            }
            let [p, q] = ends;
            let radii = kept(world, change, thickness, &own, other)?;
            let query = EdgeEdge::new([b, c, p, q], [a, c, p, q], radii)?;
            if decide(&query).is_some() {
                return Ok(true);
            }
        }
    }
    Ok(false)
}

/// How near a change may not come to another segment, as the two numbers whose sum it is: what its
/// own segments keep, and of one wire no more than the stretch between leaves.
fn kept(
    world: &World,
    change: &Remesh,
    thickness: Thickness,
    own: &[SegmentId],
    other: SegmentId,
) -> Result<[f64; 2], QueryError> {
    let [from, _, to] = change.arcs;
    let [start, end] = other.nodes(world).map(|node| node.arc);
    let stretch = (other.wire == change.wire).then(|| (start - to).max(from - end).max(0.0));
    let Some(&first) = own.first() else {
        return Ok([0.0; 2]);
    };
    let mut step = thickness.limit(world, [first, other], stretch);
    let [p, q] = other.ends(world);
    for &mine in own {
        let [a, b] = mine.ends(world);
        step = thickness.beyond(world, [mine, other], [a, b, p, q], step)?;
    }
    Ok(thickness.radii(world, [first, other], step))
}

/// Whether a node that lies beside a contact node, and hardly off the line between its neighbours,
/// would be taken out: wire that slides over a body brings its nodes, and whatever else the body
/// pushes on them does not hold them there.
pub(super) fn straightens_beside_contact_node(world: &World, change: &Remesh) -> bool {
    let wire = &world.wires[change.wire.0];
    let is_contact = |arc: f64| {
        let node = &wire.nodes[wire.nearest_node(arc)];
        matches!(node.kind, NodeKind::Contact { .. })
    };
    let [a, b, c] = change.triangle;
    let off = (b - a).cross(&(c - a)).norm() / (c - a).norm();
    let [from, _, to] = change.arcs;
    (is_contact(from) || is_contact(to)) && off <= wire.material.radius
}

/// The segments that a change takes out or divides.
fn own(world: &World, change: &Remesh) -> Vec<SegmentId> {
    let nodes = &world.wires[change.wire.0].nodes;
    let at = |arc: f64| nodes.partition_point(|node| node.arc < arc);
    let wire = change.wire;
    let own = at(change.arcs[0])..at(change.arcs[2]);
    own.map(|segment| SegmentId { wire, segment }).collect()
}

//! From the motion of all wires and bodies to the midlines that touch cores, and the cores that touch
//! each other ([`core_pairs`](super::core_pairs)).
//!
//! Where a segment that is apart from a closed surface first touches it, one of its nodes touches a
//! face, or the segment touches an edge. Each of these is a query of [`decide_rigid`]. A segment
//! that touches the core or is inside it where the step starts is left out, for as long as that is
//! so.

use super::body_contacts::HAIR;
use super::body_motion::{BodyWay, SegmentWay, Stage, between, direction_into_body};
use super::boxes::Boxes;
use super::core_boxes::{self, Bounds, CornerBoxes};
use super::core_pairs::{CoreHit, first_core_touch};
use super::inside::{covering, is_in};
use super::segment::direction;
use crate::broad::{Aabb, BroadError, Method};
use crate::certified::decide_rigid;
use crate::contact::{EdgePoint, FacePlace, Hit};
use crate::parallel::mapped;
use crate::query::Point;
use crate::rigid::{EdgeTurningEdge, RigidError, RigidMotion, VertexTurningFace};
use crate::wire::Vector;
use crate::wire::contact::{ContactConstraint, ContactSite};
use crate::wire::error::CollisionError;
use crate::wire::model::core::{Core, Surface};
use crate::wire::model::{BodyId, WireId};
use crate::wire::record::{BodyCrossing, BodyCrossingOutcome, CollisionRecord};
use crate::wire::site::{SegmentId, WireSite};
use crate::wire::step::motion::ProposedMotion;
use crate::wire::world::World;

/// Segments in a run, the items of the broad phase.
const RUN: usize = 16;

/// How many runs beside one body a thread asks about at a time.
const SHARE: usize = 16;

/// The cores of all bodies, and what may come near them.
pub(super) struct CoreDetection {
    pub(super) cores: Vec<Core>,
    boxes: Boxes,
}

/// A midline that touches a core.
pub(super) struct BodyHit {
    pub(super) segment: SegmentId,
    pub(super) site: WireSite,
    pub(super) body: BodyId,
    /// Where on the core.
    pub(super) local: Vector,
    /// When, from 0 to 1 in the step.
    pub(super) toi: f64,
    /// Unit normal in the body's frame from the core to where the wire comes from.
    pub(super) normal: Option<Vector>,
}

/// What touches a core.
#[derive(Default)]
pub(super) struct CoreHits {
    pub(super) midlines: Vec<BodyHit>,
    pub(super) bodies: Vec<CoreHit>,
}

/// What may touch, by number.
#[derive(Default)]
struct Near {
    /// Two bodies, of which forces move one.
    bodies: Vec<[usize; 2]>,
    /// A body and a run.
    runs: Vec<(usize, usize)>,
}

/// The first touch in a stage.
struct Touch {
    toi: f64,
    toi_above: f64,
    /// On the segment.
    parameter: f64,
    local: Vector,
    normal: Option<Vector>,
}

/// Some segments in a row.
struct Run {
    wire: usize,
    first: usize,
    last: usize,
}

/// All nodes where a motion starts and where it ends, by wire.
struct Nodes {
    start: Vec<Vec<Point>>,
    end: Vec<Vec<Point>>,
}

impl CoreDetection {
    pub(super) fn new(method: Method) -> Self {
        CoreDetection {
            cores: Vec::new(),
            boxes: Boxes::new(method),
        }
    }

    /// Wall-clock time in s of its broad phase so far.
    pub(super) fn broad_seconds(&self) -> f64 {
        self.boxes.seconds
    }

    /// Bodies that were added since the last step.
    pub(super) fn learn(&mut self, world: &World) {
        let new = &world.bodies[self.cores.len()..];
        self.cores
            .extend(new.iter().map(|body| Core::of(&body.shape)));
    }

    /// What touches a core while `world` makes a motion: the first touch of each segment and body,
    /// and of each two bodies.
    pub(super) fn detect(
        &mut self,
        world: &World,
        motion: &ProposedMotion,
        record: &mut CollisionRecord,
    ) -> Result<CoreHits, CollisionError> {
        let mut hits = CoreHits::default();
        if self.cores.is_empty() {
            return Ok(hits);
        }
        let ways = (0..self.cores.len()).map(|body| BodyWay::new(world, motion, BodyId(body)));
        let ways: Vec<BodyWay> = ways.collect::<Result<_, _>>()?;
        let nodes = Nodes::new(world, motion);
        let runs = runs(&nodes);
        let near = self.near(world, &ways, &nodes, &runs)?;
        for pair in near.bodies {
            let cores = pair.map(|body| &self.cores[body]);
            let of = pair.map(|body| &ways[body]);
            let mut tested = false;
            let hit = first_core_touch(pair.map(BodyId), cores, of, &mut tested)?;
            record.tested_core_pairs += usize::from(tested);
            hits.bodies.extend(hit);
        }
        let of_bodies = near.runs.chunk_by(|a, b| a.0 == b.0);
        let shares: Vec<_> = of_bodies.flat_map(|runs| runs.chunks(SHARE)).collect();
        let touched = mapped(shares.len(), 1, |at| {
            let body = BodyId(shares[at][0].0);
            let mut beside = Beside::new(&self.cores[body.0], &ways[body.0]);
            let mut midlines = Vec::new();
            for run in shares[at].iter().map(|(_, run)| &runs[*run]) {
                beside.add_hits(world, &nodes, run, body, &mut midlines)?;
            }
            Ok::<_, RigidError>((midlines, beside.tested))
        });
        for of_share in touched {
            let (midlines, tested) = of_share?;
            hits.midlines.extend(midlines);
            record.tested_cores += tested;
        }
        Ok(hits)
    }

    /// Bodies and runs whose boxes meet, or that are tied to each other, and two bodies.
    fn near(
        &mut self,
        world: &World,
        ways: &[BodyWay],
        nodes: &Nodes,
        runs: &[Run],
    ) -> Result<Near, CollisionError> {
        let of_bodies = self.cores.iter().zip(ways);
        let mut boxes: Vec<_> = of_bodies.map(|(core, way)| swept(core, way)).collect();
        boxes.extend(runs.iter().map(|run| {
            let of = |all: &[Vec<Point>]| all[run.wire][run.first..run.last + 2].to_vec();
            Aabb::swept(&of(&nodes.start), &of(&nodes.end), 0.0)
        }));
        self.boxes.place(boxes.into_iter())?;
        let bodies = self.cores.len();
        let forces_move = |body: usize| world.bodies[body].dynamic;
        let keep = |[a, b]: [usize; 2]| match [a < bodies, b < bodies] {
            [true, true] => {
                let is_still = ways[a].rests && ways[b].rests;
                !is_still && (forces_move(a) || forces_move(b))
            }
            [false, false] => false,
            _ => true,
        };
        let mut near = Near::default();
        for pair in self.boxes.pairs(keep) {
            let [a, b] = [pair.first().index(), pair.second().index()];
            match [a.min(b), a.max(b)] {
                [a, b] if b < bodies => near.bodies.push([a, b]),
                [body, run] => near.runs.push((body, run - bodies)),
            }
        }
        // What is tied to a body goes on its arcs, which the boxes of straight ways may not hold.
        for (r, run) in runs.iter().enumerate() {
            let tied = &world.wires[run.wire].nodes[run.first..run.last + 2];
            let carriers = tied.iter().filter_map(|node| node.kind.carrier());
            near.runs.extend(carriers.map(|(body, _)| (body.0, r)));
        }
        near.bodies.sort_unstable();
        near.runs.sort_unstable();
        near.runs.dedup();
        Ok(near)
    }
}

impl Nodes {
    fn new(world: &World, motion: &ProposedMotion) -> Self {
        let start = world.wires.iter();
        let start = start.map(|wire| wire.nodes.iter().map(|node| node.position).collect());
        let end = motion.wires.iter();
        let end = end.map(|wire| wire.iter().map(|(position, _)| *position).collect());
        Nodes {
            start: start.collect(),
            end: end.collect(),
        }
    }
}

fn runs(nodes: &Nodes) -> Vec<Run> {
    let runs = nodes.start.iter().enumerate().flat_map(|(wire, nodes)| {
        let segments = nodes.len().saturating_sub(1);
        (0..segments).step_by(RUN).map(move |first| {
            let last = (first + RUN).min(segments) - 1;
            Run { wire, first, last }
        })
    });
    runs.collect()
}

/// The box that holds a core on its way; all of space for a plane.
fn swept(core: &Core, way: &BodyWay) -> Result<Aabb, BroadError> {
    let Core::Surface(surface) = core else {
        let [low, high] = [f64::NEG_INFINITY, f64::INFINITY].map(|x| Point::new(x, x, x));
        return Aabb::new(low, high);
    };
    let around = way
        .pieces
        .iter()
        .map(|piece| core_boxes::in_space(piece, &surface.bounds()));
    let whole = around.reduce(|a, b| a.joined(&b));
    let bounds = whole.unwrap_or(Bounds::NOTHING);
    Aabb::new(bounds.low.into(), bounds.high.into())
}

/// Asks what comes near one core.
struct Beside<'a> {
    core: &'a Core,
    way: &'a BodyWay,
    /// Of each piece of the way, as soon as something is near.
    boxes: Vec<Option<CornerBoxes>>,
    /// Segments whose boxes met that of the core.
    tested: usize,
}

impl<'a> Beside<'a> {
    fn new(core: &'a Core, way: &'a BodyWay) -> Self {
        Beside {
            core,
            way,
            boxes: way.pieces.iter().map(|_| None).collect(),
            tested: 0,
        }
    }

    /// Adds the first touch of each segment of a run.
    fn add_hits(
        &mut self,
        world: &World,
        nodes: &Nodes,
        run: &Run,
        body: BodyId,
        hits: &mut Vec<BodyHit>,
    ) -> Result<(), RigidError> {
        for segment in run.first..=run.last {
            let wire = WireId(run.wire);
            let id = SegmentId { wire, segment };
            let end = [0, 1].map(|k| nodes.end[run.wire][segment + k]);
            let way = SegmentWay::new(world, id, end, body);
            if let Some((times, touch)) = self.first_touch(&way)? {
                hits.extend(self.hit(world, &way, body, times, touch)?);
            }
        }
        Ok(())
    }

    /// The first touch of a segment, and when the part of the step starts and ends that it is in.
    fn first_touch(
        &mut self,
        segment: &SegmentWay,
    ) -> Result<Option<([f64; 2], Touch)>, RigidError> {
        if segment.is_still_beside(self.way) {
            return Ok(None);
        }
        // The end of a wire in its body would be asked about in every one of its parts.
        let parts = |piece: &RigidMotion| segment.parts(piece) > 1;
        if self.way.pieces.iter().any(parts)
            && is_in(self.core, self.way.pieces[0].start(), &segment.start)?
        {
            return Ok(None);
        }
        let mut tested = false;
        for piece in 0..self.way.pieces.len() {
            let parts = segment.parts(&self.way.pieces[piece]);
            for part in 0..parts {
                let stage = self.way.stage(segment, piece, part, parts)?;
                let touch = match self.core {
                    Core::Plane => {
                        tested = true;
                        touch_plane(&stage)?
                    }
                    Core::Surface(surface) if parts == 1 => {
                        let boxes = self.boxes[piece].get_or_insert_with(|| {
                            CornerBoxes::new(&stage.motion, &surface.vertices)
                        });
                        touch_surface(&stage, surface, boxes, &mut tested)?
                    }
                    Core::Surface(surface) => {
                        let boxes = CornerBoxes::new(&stage.motion, &surface.vertices);
                        touch_surface(&stage, surface, &boxes, &mut tested)?
                    }
                };
                if let Some(touch) = touch {
                    self.tested += 1;
                    return Ok(Some((stage.times, touch)));
                }
            }
        }
        self.tested += usize::from(tested);
        Ok(None)
    }

    /// A touch as a hit, unless the segment touches the core or is inside it as the step starts.
    fn hit(
        &self,
        world: &World,
        segment: &SegmentWay,
        body: BodyId,
        [from, to]: [f64; 2],
        touch: Touch,
    ) -> Result<Option<BodyHit>, RigidError> {
        let starts = self.way.pieces[0].start();
        let at_once = from == 0.0 && touch.toi_above == 0.0;
        if at_once || is_in(self.core, starts, &segment.start)? {
            return Ok(None);
        }
        let at_start = between(&segment.start[0], &segment.start[1], touch.parameter);
        let first = &self.way.pieces[0];
        let came_from = direction_into_body(first, 0.0, &(at_start - starts.centre)) - touch.local;
        Ok(Some(BodyHit {
            segment: segment.id,
            site: segment.id.site(world, touch.parameter),
            body,
            local: touch.local,
            toi: from + (to - from) * touch.toi,
            normal: side(touch.normal, &came_from),
        }))
    }
}

/// The normal, if what comes from there comes along it by a tenth at least; else the direction from
/// which it comes.
pub(super) fn side(normal: Option<Vector>, came_from: &Vector) -> Option<Vector> {
    const TENTH: f64 = 0.1;
    let along = |normal: &Vector| normal.dot(came_from) >= TENTH * came_from.norm();
    normal.filter(along).or_else(|| direction(came_from))
}

/// The first touch of a segment with a surface in a stage.
fn touch_surface(
    stage: &Stage,
    surface: &Surface,
    boxes: &CornerBoxes,
    tested: &mut bool,
) -> Result<Option<Touch>, RigidError> {
    let nodes = core_boxes::nodes(stage);
    let segment = nodes[0].joined(&nodes[1]);
    if boxes.whole.is_apart(&segment) {
        return Ok(None);
    }
    *tested = true;
    let mut first: Option<Touch> = None;
    for face in &surface.faces {
        let around = boxes.of(face);
        if around.is_apart(&segment) {
            continue;
        }
        for node in (0..2).filter(|&node| !around.is_apart(&nodes[node])) {
            let corners = face.map(|k| surface.vertices[k]);
            keep_first(&mut first, touch_face(stage, node, corners)?);
        }
    }
    for edge in &surface.edges {
        if !boxes.of(edge).is_apart(&segment) {
            let ends = edge.map(|k| surface.vertices[k]);
            keep_first(&mut first, touch_edge(stage, ends)?);
        }
    }
    Ok(first)
}

fn keep_first(first: &mut Option<Touch>, other: Option<Touch>) {
    let Some(other) = other else { return };
    let key = |touch: &Touch| (touch.toi, touch.toi_above);
    if first.as_ref().is_none_or(|first| key(&other) < key(first)) {
        *first = Some(other);
    }
}

/// Where on a face a vertex touches it, and the unit normal on the side from which it comes, in the
/// body's frame.
pub(super) fn on_face(hit: &Hit<FacePlace>, corners: &[Point; 3]) -> (Vector, Option<Vector>) {
    let [b, c, d] = corners.map(|corner| corner.coords);
    let weights = hit.place.weights;
    let normal = (c - b).cross(&(d - b)) * f64::from(hit.side);
    let place = b * weights[0] + c * weights[1] + d * weights[2];
    (place, direction(&normal))
}

/// The unit vector across two edges AB and CD, from CD to where AB comes from. None where they are all
/// but parallel.
pub(super) fn across_edges([a, b, c, d]: &[Point; 4], side: i8) -> Option<Vector> {
    /// Edges at a smaller angle have no normal.
    const ANGLE: f64 = 1e-6;
    let (k, l) = direction(&(b - a)).zip(direction(&(d - c)))?;
    // The side is that of CD, seen from AB.
    let across = k.cross(&l) * -f64::from(side);
    (across.norm() > ANGLE).then(|| across.normalize())
}

fn touch_face(
    stage: &Stage,
    node: usize,
    corners: [Point; 3],
) -> Result<Option<Touch>, RigidError> {
    let (start, end) = ([stage.start[node]], [stage.end[node]]);
    let query = VertexTurningFace::new(start, end, corners, stage.motion)?;
    let touch = decide_rigid(&query).map(|hit| {
        let (local, normal) = on_face(&hit, &corners);
        Touch::new(&hit, node as f64, local, normal)
    });
    Ok(touch)
}

fn touch_edge(stage: &Stage, ends: [Point; 2]) -> Result<Option<Touch>, RigidError> {
    let query = EdgeTurningEdge::new(stage.start, stage.end, ends, stage.motion)?;
    let touch = decide_rigid(&query).map(|hit| {
        let EdgePoint { u, v } = hit.place.first;
        let across = across_edges(&query.positions(hit.toi), hit.side);
        let normal = across.map(|across| direction_into_body(&stage.motion, hit.toi, &across));
        let local = ends[0].coords * (1.0 - v) + ends[1].coords * v;
        Touch::new(&hit, u, local, normal)
    });
    Ok(touch)
}

/// The first touch of a segment with a plane: a node's.
fn touch_plane(stage: &Stage) -> Result<Option<Touch>, RigidError> {
    let mut first = None;
    for node in 0..2 {
        let corners = covering(&stage.motion, stage.start[node], stage.end[node]);
        if let Some(corners) = corners {
            keep_first(&mut first, touch_face(stage, node, corners)?);
        }
    }
    Ok(first)
}

impl CoreHits {
    pub(super) fn is_empty(&self) -> bool {
        self.midlines.is_empty() && self.bodies.is_empty()
    }
}

impl Touch {
    fn new<P>(hit: &Hit<P>, parameter: f64, local: Vector, normal: Option<Vector>) -> Self {
        Touch {
            toi: hit.toi,
            toi_above: hit.toi_above,
            parameter,
            local,
            normal,
        }
    }
}

impl BodyHit {
    pub(super) fn crossing(&self, outcome: BodyCrossingOutcome) -> BodyCrossing {
        BodyCrossing {
            body: self.body,
            segment: self.segment,
            arc: self.site.arc,
            toi: self.toi,
            outcome,
        }
    }

    /// A contact by which the wire stays on its side of the body where the motion ends: as far from
    /// the core as the surface and the wire's radius are. What is in the surface already is held off the core, and pushed
    /// out by no more than a hair: the contacts with the surface push it out, where it has any. None if the wire does not
    /// come from anywhere.
    pub(super) fn row(
        &self,
        world: &World,
        motion: &ProposedMotion,
        inset: f64,
        friction: f64,
        key: u64,
    ) -> Option<ContactConstraint> {
        let body = &world.bodies[self.body.0];
        let wire = &world.wires[self.site.wire.0];
        let ended = motion.body(self.body);
        let normal = direction(&(ended.orientation * self.normal?))?;
        let (segment, parameter) = wire.at(self.site.arc);
        let place = wire.nodes[segment].position + wire.span(segment) * parameter;
        // The row takes the body's point straight on at its velocity, the motion turns it.
        let arm = body.arm(&self.local);
        let straight = (ended.velocity + ended.angular_velocity.cross(&arm)) * world.settings.step;
        let arrives = ended.position + ended.orientation * self.local;
        let apart = normal.dot(&(place - arrives + straight));
        let gap = apart - inset - wire.material.radius;
        Some(ContactConstraint {
            key,
            a: self.site.into(),
            b: ContactSite::Body {
                body: self.body,
                local: self.local,
            },
            normal,
            gap: gap.max(-HAIR * wire.material.radius),
            friction,
        })
    }
}

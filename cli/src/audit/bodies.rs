//! Midlines against the cores of bodies, from the records alone.
//!
//! A body goes from pose to pose as `RigidMotion` says, and nodes go straight, but for those fixed
//! to the body: on the way of such a segment there are more places at which the node is where the
//! body has it (docs/wires-and-bodies.md). Each part of a way is asked of the oracle: each node against each
//! face, the segment against each edge. Left out before that is what is apart in the body's frame:
//! there a node strays from the straight line between its places by at most
//! `((1.5 a^2 r + 2.5 a d) / 8`, with the angle `a` of the turn, at most 45 degrees, the largest
//! distance `r` from the centre and the displacement `d` seen from it, because its acceleration is
//! at most `(w^2 + |w'|) r + 2 w d`, `w <= 1.02 a` and `|w'| <= 0.2 a^2`.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use tunnelproof::contact::ContactKind;
use tunnelproof::query::Point;
use tunnelproof::rigid::{
    EdgeTurningEdge, Pose, RigidError, RigidMotion, RigidQuery, VertexTurningFace,
};
use tunnelproof::wire::{self, BodyRecord, NodeKind};
use tunnelproof_reference::answer::ExactHit;
use tunnelproof_reference::oracle::decide_rigid_query;

use super::core::{Core, ROUNDING, Surface};
use super::inside::is_node_inside;
use super::pairs::covering;
use super::separate::{are_boxes_apart, is_node_apart, is_segment_apart};

type Vector = Vector3<f64>;

/// The largest turn of a part, in radians, for a segment that is fixed to the body.
const FINE: f64 = std::f64::consts::PI / 180.0;

/// How many times a part is looked at before the oracle is asked.
const LOOKS: usize = 16;

/// The way of a body in a step.
pub(super) struct BodyWay {
    pieces: Vec<RigidMotion>,
}

/// A segment's nodes at the start and the end of a step, and where they are fixed to the body.
#[derive(Clone, Copy)]
pub(super) struct SegmentWay {
    pub(super) start: [Point; 2],
    pub(super) end: [Point; 2],
    pub(super) fixed: [Option<Point>; 2],
}

/// The first contact of a segment and a core.
pub(super) struct Touch {
    /// As a part of the step, rounded down.
    pub(super) toi: f64,
    pub(super) crossing: bool,
    /// The features that touch, in a part of the way.
    pub(super) query: RigidQuery,
}

/// A contact and what it is of.
pub(super) type Hit = (ExactHit, RigidQuery);

/// A part of a way in which nodes go straight.
struct Part {
    motion: RigidMotion,
    start: [Point; 2],
    end: [Point; 2],
}

impl BodyWay {
    pub(super) fn new(body: &BodyRecord) -> Result<Self, RigidError> {
        let mut poses = vec![pose(&body.before)];
        poses.extend(body.between.iter().map(pose));
        poses.push(pose(&body.after));
        let pieces = poses.windows(2).map(|two| RigidMotion::new(two[0], two[1]));
        Ok(BodyWay {
            pieces: pieces.collect::<Result<_, _>>()?,
        })
    }

    /// At rest.
    pub(super) fn resting(at: &wire::Pose) -> Result<Self, RigidError> {
        let pieces = vec![RigidMotion::new(pose(at), pose(at))?];
        Ok(BodyWay { pieces })
    }

    /// The motion of its first piece.
    pub(super) fn first(&self) -> &RigidMotion {
        &self.pieces[0]
    }

    /// Where it starts.
    pub(super) fn pose(&self) -> &Pose {
        self.pieces[0].start()
    }

    /// Its centre at the start and at the end.
    pub(super) fn centres(&self) -> [Point; 2] {
        let last = &self.pieces[self.pieces.len() - 1];
        [self.pose().centre, last.end().centre]
    }

    /// How far its centre is at most from where it would be at the same time on a straight way.
    pub(super) fn stray_of_centre(&self) -> f64 {
        let [from, to] = self.centres();
        let ends = self.pieces.iter().map(|piece| piece.end().centre);
        let count = self.pieces.len() as f64;
        let strays = ends.enumerate().map(|(piece, at)| {
            let t = (piece + 1) as f64 / count;
            (at - from - (to - from) * t).norm()
        });
        strays.fold(0.0, f64::max)
    }

    /// Its motions from pose to pose.
    pub(super) fn pieces(&self) -> &[RigidMotion] {
        &self.pieces
    }

    /// Whether it stays where it is.
    pub(super) fn is_still(&self) -> bool {
        self.pieces.iter().all(|piece| piece.start() == piece.end())
    }

    /// The first contact of a segment, if it neither touches the core nor is inside it at the
    /// start; and how many parts were asked about.
    pub(super) fn touch(
        &self,
        segment: &SegmentWay,
        core: &Core,
    ) -> Result<(Option<Touch>, u64), RigidError> {
        let rides = segment.fixed.iter().all(Option::is_some);
        if rides || self.is_still() && segment.start == segment.end {
            return Ok((None, 0));
        }
        let (pieces, mut asked) = (self.pieces.len() as f64, 0);
        let mut was_looked_at = false;
        for piece in 0..self.pieces.len() {
            let parts = self.parts(segment, piece);
            for k in 0..parts {
                let part = self.part(segment, piece, k, parts)?;
                if !part.comes_near(core) {
                    continue;
                }
                if !was_looked_at {
                    was_looked_at = true;
                    if is_in(core, self.pieces[0].start(), &segment.start)? {
                        return Ok((None, asked));
                    }
                }
                let Some((hit, query)) = part.touch(core, &mut asked)? else {
                    continue;
                };
                let at = |k: usize| (piece as f64 + k as f64 / parts as f64) / pieces;
                let [from, to] = [at(k), at(k + 1)];
                let touch = Touch {
                    toi: from + (to - from) * hit.toi.below,
                    crossing: hit.kind == ContactKind::Crossing || hit.crosses,
                    query,
                };
                return Ok((Some(touch), asked));
            }
        }
        Ok((None, asked))
    }

    /// Into how many parts a piece is divided: one, or so that four times the tangent of a quarter
    /// of the turn is at most a degree in each.
    fn parts(&self, segment: &SegmentWay, piece: usize) -> usize {
        if segment.fixed == [None, None] {
            return 1;
        }
        ((4.0 * quarter_tangent(&self.pieces[piece]) / FINE).ceil() as usize).max(1)
    }

    fn part(
        &self,
        segment: &SegmentWay,
        piece: usize,
        k: usize,
        parts: usize,
    ) -> Result<Part, RigidError> {
        let ends = |k: usize| [0, 1].map(|node| self.place(segment, node, piece, k, parts));
        let motion = self.pieces[piece];
        let pose = |k: usize| pose_on_way(&motion, k, parts);
        Ok(Part {
            motion: RigidMotion::new(pose(k), pose(k + 1))?,
            start: ends(k),
            end: ends(k + 1),
        })
    }

    /// Where a node is after `k` of the parts of a piece.
    fn place(&self, way: &SegmentWay, node: usize, piece: usize, k: usize, parts: usize) -> Point {
        let (piece, k) = if k == parts {
            (piece + 1, 0)
        } else {
            (piece, k)
        };
        let t = k as f64 / parts as f64;
        match (self.pieces.get(piece), way.fixed[node]) {
            (None, _) => way.end[node],
            _ if piece == 0 && k == 0 => way.start[node],
            (Some(motion), Some(local)) => motion.position(&local, t),
            (Some(_), None) => {
                let t = (piece as f64 + t) / self.pieces.len() as f64;
                mean(&way.start[node], &way.end[node], t)
            }
        }
    }
}

pub(super) fn pose(pose: &wire::Pose) -> Pose {
    Pose::new(pose.position, *pose.orientation.quaternion())
}

fn mean(from: &Point, to: &Point, t: f64) -> Point {
    Point::from(from.coords * (1.0 - t) + to.coords * t)
}

/// The pose after `k` of `parts` of a motion: centre and quaternion, each on its line, rounded.
fn pose_on_way(motion: &RigidMotion, k: usize, parts: usize) -> Pose {
    match k {
        0 => *motion.start(),
        _ if k == parts => *motion.end(),
        _ => {
            let t = k as f64 / parts as f64;
            let [from, to] = motion.quaternions();
            let q = [0, 1, 2, 3].map(|i| (1.0 - t) * from[i] + t * to[i]);
            let centre = mean(&motion.start().centre, &motion.end().centre, t);
            Pose::new(centre, Quaternion::new(q[0], q[1], q[2], q[3]))
        }
    }
}

/// The tangent of a quarter of the angle of a motion.
pub(super) fn quarter_tangent(motion: &RigidMotion) -> f64 {
    let [from, to] = motion.quaternions().map(|[w, x, y, z]| {
        let q = Quaternion::new(w, x, y, z).coords;
        (q / q.amax()).normalize()
    });
    (to - from).norm() / (to + from).norm()
}

/// The orientation of a body at a time of a motion, rounded.
pub(super) fn orientation(motion: &RigidMotion, t: f64) -> UnitQuaternion<f64> {
    let [from, to] = motion.quaternions();
    let [w, x, y, z] = [0, 1, 2, 3].map(|i| from[i] * (1.0 - t) + to[i] * t);
    UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z))
}

/// A vector of space in the body's frame at a time of a motion, rounded.
fn seen(motion: &RigidMotion, t: f64, vector: &Vector) -> Vector {
    orientation(motion, t).inverse_transform_vector(vector)
}

impl Part {
    /// Both nodes in the body's frame at [`LOOKS`] + 1 times, two by two, and how far they may be
    /// from the lines between.
    fn looks(&self) -> (Vec<[Vector; 2]>, f64) {
        let angle = 4.0 * quarter_tangent(&self.motion);
        let centres = [self.motion.start(), self.motion.end()].map(|pose| pose.centre);
        let [mut stray, mut rounding]: [f64; 2] = [0.0; 2];
        for (from, to) in self.start.iter().zip(&self.end) {
            let [first, last] = [from - centres[0], to - centres[1]];
            let (r, d) = (first.norm().max(last.norm()), (last - first).norm());
            stray = stray.max((1.5 * angle * angle * r + 2.5 * angle * d) / 8.0);
            // Only what is seen from the centre is rounded.
            rounding = rounding.max(ROUNDING * r);
        }
        let at = |k: usize| {
            let t = k as f64 / LOOKS as f64;
            [0, 1].map(|node| {
                let from = self.start[node] - centres[0];
                let to = self.end[node] - centres[1];
                seen(&self.motion, t, &(from * (1.0 - t) + to * t))
            })
        };
        let looks = (0..=LOOKS).map(at).collect();
        // A part of the time of half the length has a quarter of the stray.
        (looks, stray / (LOOKS * LOOKS) as f64 + rounding)
    }

    /// Whether the segment comes near the core at all.
    fn comes_near(&self, core: &Core) -> bool {
        let (looks, stray) = self.looks();
        match core {
            Core::Plane => looks.as_flattened().iter().any(|point| point.z <= stray),
            Core::Surface(surface) => !near(&looks, stray, surface).0.is_empty(),
        }
    }

    /// The first contact, by the oracle.
    fn touch(&self, core: &Core, asked: &mut u64) -> Result<Option<Hit>, RigidError> {
        let (looks, stray) = self.looks();
        match core {
            Core::Plane => {
                if looks.as_flattened().iter().all(|point| point.z > stray) {
                    return Ok(None);
                }
                *asked += 1;
                let covering = covering(reach(looks.as_flattened()));
                let on_node = |node: usize| self.against_face(node, &covering);
                Ok(first([on_node(0)?, on_node(1)?]))
            }
            Core::Surface(surface) => {
                let (near, stray) = near(&looks, stray, surface);
                if near.is_empty() {
                    return Ok(None);
                }
                *asked += 1;
                self.touch_surface(surface, &near, stray)
            }
        }
    }

    /// The first contact with a surface, `near` which the segment is, by at most `stray` elsewhere.
    fn touch_surface(
        &self,
        surface: &Surface,
        near: &[[Vector; 4]],
        stray: f64,
    ) -> Result<Option<Hit>, RigidError> {
        let mut hits = Vec::new();
        for face in &surface.faces {
            let corners = face.map(|corner| corner.coords);
            for node in [0, 1] {
                let apart =
                    |p: &[Vector; 4]| is_node_apart(&[p[node], p[node + 2]], &corners, stray);
                if !near.iter().all(apart) {
                    hits.push(self.against_face(node, face)?);
                }
            }
        }
        for edge in &surface.edges {
            let corners = edge.map(|corner| corner.coords);
            if !near.iter().all(|p| is_segment_apart(p, &corners, stray)) {
                let query = EdgeTurningEdge::new(self.start, self.end, *edge, self.motion)?;
                hits.push(hit(query));
            }
        }
        Ok(first(hits))
    }

    fn against_face(&self, node: usize, face: &[Point; 3]) -> Result<Option<Hit>, RigidError> {
        let (start, end) = ([self.start[node]], [self.end[node]]);
        let query = VertexTurningFace::new(start, end, *face, self.motion)?;
        Ok(hit(query))
    }
}

/// The first contact of a query, by the oracle.
pub(super) fn hit(query: impl Into<RigidQuery>) -> Option<Hit> {
    let query = query.into();
    Some((decide_rigid_query(&query).hit?, query))
}

/// Where the segment is, from look to look, when it may be near a surface, and how far it may be from
/// there.
fn near(looks: &[[Vector; 2]], stray: f64, surface: &Surface) -> (Vec<[Vector; 4]>, f64) {
    let stray = stray + ROUNDING * surface.extent();
    let between = looks.windows(2);
    let between = between.map(|two| [two[0][0], two[0][1], two[1][0], two[1][1]]);
    let is_near = |points: &[Vector; 4]| {
        let apart = are_boxes_apart(points, stray, &surface.low, &surface.high);
        !apart && !surface.is_beyond(points, stray)
    };
    (between.filter(is_near).collect(), stray)
}

pub(super) fn first(hits: impl IntoIterator<Item = Option<Hit>>) -> Option<Hit> {
    let earlier = |(a, _): &Hit, (b, _): &Hit| {
        let below = a.toi.below.total_cmp(&b.toi.below);
        below.then(a.toi.above.total_cmp(&b.toi.above))
    };
    hits.into_iter().flatten().min_by(earlier)
}

/// The largest distance of some points from the origin.
fn reach(points: &[Vector]) -> f64 {
    points
        .iter()
        .fold(0.0, |far: f64, point| far.max(point.norm()))
}

/// Whether a segment touches a core, or is inside.
pub(super) fn is_in(core: &Core, pose: &Pose, ends: &[Point; 2]) -> Result<bool, RigidError> {
    let motion = RigidMotion::new(*pose, *pose)?;
    let inside = ends.iter().any(|end| is_node_inside(core, pose, end));
    Ok(inside || swept(core, &motion, &[ends[0], ends[1], ends[1]])?.is_some())
}

/// What of a triangle touches the surface of a core of a body at rest: one of its sides a face, or
/// an edge the triangle.
pub(super) fn swept(
    core: &Core,
    motion: &RigidMotion,
    triangle: &[Point; 3],
) -> Result<Option<RigidQuery>, RigidError> {
    let centre = motion.start().centre;
    let local = triangle.map(|point| seen(motion, 0.0, &(point - centre)));
    let [a, b, c] = *triangle;
    let sides = [[a, b], [b, c], [c, a]];
    let touches = |from: Point, to: Point, face: &[Point; 3]| {
        let query = VertexTurningFace::new([from], [to], *face, *motion)?;
        Ok(hit(query).map(|(_, query)| query))
    };
    let surface = match core {
        Core::Plane => {
            let covering = covering(reach(&local));
            return any(sides, |[from, to]| touches(from, to, &covering));
        }
        Core::Surface(surface) => surface,
    };
    let size = reach(&local) + surface.extent();
    let apart = |low: &Vector, high: &Vector| are_boxes_apart(&local, ROUNDING * size, low, high);
    if apart(&surface.low, &surface.high) || surface.is_beyond(&local, ROUNDING * size) {
        return Ok(None);
    }
    let near = surface.faces.iter().filter(|face| {
        let [a, b, c] = face.map(|corner| corner.coords);
        !apart(&a.inf(&b).inf(&c), &a.sup(&b).sup(&c))
    });
    let pierces = any(near, |face| {
        any(sides, |[from, to]| touches(from, to, face))
    })?;
    if pierces.is_some() {
        return Ok(pierces);
    }
    // The segment from `b` to `a`, whose end `a` goes to `c`.
    let crossed = |edge: &[Point; 2]| {
        let query = EdgeTurningEdge::new([a, b], [c, b], *edge, *motion)?;
        Ok(hit(query).map(|(_, query)| query))
    };
    let near = surface.edges.iter().filter(|edge| {
        let way = [local[0], local[1], local[2], local[1]];
        let corners = edge.map(|corner| corner.coords);
        !is_segment_apart(&way, &corners, ROUNDING * size)
    });
    any(near, crossed)
}

/// What the first of some things that touches does it by.
fn any<T>(
    of: impl IntoIterator<Item = T>,
    mut touches: impl FnMut(T) -> Result<Option<RigidQuery>, RigidError>,
) -> Result<Option<RigidQuery>, RigidError> {
    for one in of {
        let touched = touches(one)?;
        if touched.is_some() {
            return Ok(touched);
        }
    }
    Ok(None)
}

/// Where a node is fixed to a body, if it is.
pub(super) fn fixed_to(kind: &NodeKind, body: usize) -> Option<Point> {
    let (carrier, local) = kind.carrier()?;
    (carrier.0 == body).then(|| Point::from(local))
}

#[cfg(test)]
mod tests;

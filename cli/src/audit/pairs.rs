//! Cores of bodies against each other, from the records alone.
//!
//! Both bodies go from pose to pose at the same times, as `RigidMotion` says; one that stays where it
//! is has no poses between, and two that stay farther apart than both reach may have poses at other
//! times. Each such stage is asked of the oracle: vertices of each against faces of
//! the other, edges against edges. Left out before that is what is apart in space. There a point at
//! the distance `r` from a centre strays from the straight line between its places by at most
//! `1.5 a^2 r / 8`, with the angle `a` of the turn, at most 90 degrees, because its acceleration is at
//! most `(w^2 + |w'|) r`, `w <= 1.06 a` and `|w'| <= 0.34 a^2`; in a part of the stage, times the
//! square of that part. Centres go straight.

use nalgebra::Vector3;
use tunnelproof::contact::ContactKind;
use tunnelproof::query::Point;
use tunnelproof::rigid::{
    Pose, RigidError, RigidMotion, RigidQuery, TurningEdgeTurningEdge, TurningVertexTurningFace,
};

use super::bodies::{BodyWay, Hit, Touch, first, hit, orientation, quarter_tangent};
use super::core::{Core, ROUNDING};
use super::overlap::overlap;
use super::separate::gap;

type Vector = Vector3<f64>;

/// How often a stage is halved before the oracle is asked about two parts of cores.
const HALVINGS: u32 = 9;

/// The same before parts are looked at.
const FIRST_HALVINGS: u32 = 4;

/// What was found of two bodies in a step.
#[derive(Default)]
pub(super) struct Found {
    /// Whether they came near each other.
    pub(super) near: bool,
    /// The first touch of cores that neither touch nor overlap at the start.
    pub(super) touch: Option<Touch>,
}

/// The first touch of two cores; `None` if the poses of both are not at the same times, and the two
/// may come near each other.
pub(super) fn first_touch(
    cores: [&Core; 2],
    ways: [&BodyWay; 2],
) -> Result<Option<Found>, RigidError> {
    let mut found = Found::default();
    let counts = ways.map(|way| way.pieces().len());
    let stages = counts[0].max(counts[1]);
    let is_common = |way: &&BodyWay| way.is_still() || way.pieces().len() == stages;
    if !ways.iter().all(is_common) {
        return Ok(stay_out_of_reach(cores, ways).then_some(found));
    }
    if ways.iter().all(|way| way.is_still()) {
        return Ok(Some(found));
    }
    for stage in 0..stages {
        let of = |way: &BodyWay| match way.is_still() {
            true => way.pieces()[0],
            false => way.pieces()[stage],
        };
        let stage_of = Stage::new(cores, ways.map(of));
        if stage_of.stays_apart() {
            continue;
        }
        if !found.near {
            found.near = true;
            if overlap(cores, ways.map(BodyWay::pose)) {
                return Ok(Some(found));
            }
        }
        let Some((hit, query)) = stage_of.touch(cores)? else {
            continue;
        };
        if stage > 0 || !hit.is_initial() {
            let at = |stage: usize| stage as f64 / stages as f64;
            let [from, to] = [at(stage), at(stage + 1)];
            found.touch = Some(Touch {
                toi: from + (to - from) * hit.toi.below,
                crossing: hit.kind == ContactKind::Crossing || hit.crosses,
                query,
            });
        }
        return Ok(Some(found));
    }
    Ok(Some(found))
}

/// The largest distance of a corner from the body's centre.
fn radius(core: &Core) -> f64 {
    match core {
        Core::Plane => f64::INFINITY,
        Core::Surface(surface) => {
            let vertices = surface.faces.as_flattened().iter();
            vertices.fold(0.0, |r: f64, vertex| r.max(vertex.coords.norm()))
        }
    }
}

/// Whether the centres of two bodies stay farther apart than corners are from them, whatever turns.
/// Each centre is taken to go straight from the start of the step to its end, as far from there as
/// any of its poses is.
fn stay_out_of_reach(cores: [&Core; 2], ways: [&BodyWay; 2]) -> bool {
    let ends = ways.map(BodyWay::centres);
    let [from, to] = [0, 1].map(|end| ends[0][end] - ends[1][end]);
    let mut least = f64::INFINITY;
    // The distance from a point to a line, by the nearest of its ends and what is across it.
    let along = to - from;
    let length = along.norm();
    if length > 0.0 && from.dot(&along) < 0.0 && to.dot(&along) > 0.0 {
        least = from.cross(&along).norm() / length;
    }
    least = least.min(from.norm()).min(to.norm());
    let size = from.amax().max(to.amax());
    let strays: f64 = ways.iter().map(|way| way.stray_of_centre()).sum();
    least > radius(cores[0]) + radius(cores[1]) + strays + ROUNDING * size
}

/// A stage of two bodies.
struct Stage {
    motions: [RigidMotion; 2],
    /// The vertices of both; those of a plane are a triangle that covers wherever the other one comes.
    vertices: [Vec<Point>; 2],
    /// How far points may stray from straight lines in the whole stage, and how much is rounded.
    stray: f64,
    rounding: f64,
}

impl Stage {
    fn new(cores: [&Core; 2], motions: [RigidMotion; 2]) -> Self {
        let radii = cores.map(|core| match core {
            Core::Plane => 0.0,
            Core::Surface(_) => radius(core),
        });
        let ends = motions.map(|motion| [motion.start().centre, motion.end().centre]);
        let far = [0, 1].map(|end| (ends[0][end] - ends[1][end]).norm());
        let reach = far[0].max(far[1]) + radii[0] + radii[1];
        let vertices = cores.map(|core| match core {
            Core::Plane => covering(reach).to_vec(),
            Core::Surface(surface) => corners(&surface.faces),
        });
        let angles = motions
            .each_ref()
            .map(|motion| 4.0 * quarter_tangent(motion));
        let stray = |body: usize| {
            let radius = match cores[body] {
                Core::Plane => 64.0 * reach,
                Core::Surface(_) => radii[body],
            };
            1.5 * angles[body] * angles[body] * radius / 8.0
        };
        Stage {
            stray: stray(0) + stray(1),
            rounding: ROUNDING * reach,
            motions,
            vertices,
        }
    }

    /// Whether two cores do not come near each other at all.
    fn stays_apart(&self) -> bool {
        let [a, b] = &self.vertices;
        self.is_apart(a, b, [0.0, 1.0], FIRST_HALVINGS)
    }

    /// Whether points of both bodies, and all that is between those of one body, certainly stay apart
    /// in a part of the stage: by a plane that is still, seen from the second body's centre.
    fn is_apart(&self, a: &[Point], b: &[Point], [from, to]: [f64; 2], halvings: u32) -> bool {
        let part = to - from;
        let margin = self.stray * part * part + self.rounding;
        let ends = [from, to].map(|t| [self.places(0, a, t), self.places(1, b, t)]);
        let middle = 0.5 * (from + to);
        let axes = axes(&self.places(0, a, middle), &self.places(1, b, middle));
        if axes.iter().any(|axis| is_between(axis, &ends, margin)) {
            return true;
        }
        halvings > 0
            && self.is_apart(a, b, [from, middle], halvings - 1)
            && self.is_apart(a, b, [middle, to], halvings - 1)
    }

    /// Points of a body at a time, seen from the centre of the second one.
    fn places(&self, body: usize, points: &[Point], t: f64) -> Vec<Vector> {
        let ends = |end: fn(&RigidMotion) -> &Pose| {
            let [of_body, second] = [body, 1].map(|k| end(&self.motions[k]).centre);
            of_body - second
        };
        let offset = ends(RigidMotion::start) * (1.0 - t) + ends(RigidMotion::end) * t;
        let turn = orientation(&self.motions[body], t);
        let place = |point: &Point| turn * point.coords + offset;
        points.iter().map(place).collect()
    }

    /// The parts of one body that come near the other one.
    fn near<const N: usize>(&self, body: usize, parts: &[[Point; N]]) -> Vec<[Point; N]> {
        let other = &self.vertices[1 - body];
        let is_near = |part: &&[Point; N]| match body {
            0 => !self.is_apart(&part[..], other, [0.0, 1.0], FIRST_HALVINGS),
            _ => !self.is_apart(other, &part[..], [0.0, 1.0], FIRST_HALVINGS),
        };
        parts.iter().filter(is_near).copied().collect()
    }

    /// The first contact, by the oracle.
    fn touch(&self, cores: [&Core; 2]) -> Result<Option<Hit>, RigidError> {
        let faces = [0, 1].map(|body| match cores[body] {
            Core::Plane => vec![[
                self.vertices[body][0],
                self.vertices[body][1],
                self.vertices[body][2],
            ]],
            Core::Surface(surface) => self.near(body, &surface.faces),
        });
        let [m, n] = self.motions;
        let mut hits = Vec::new();
        let mut ask = |query: RigidQuery| hits.push(hit(query));
        let vertices = |body: usize| match cores[body] {
            Core::Plane => Vec::new(),
            Core::Surface(_) => self.vertices[body].iter().map(|vertex| [*vertex]).collect(),
        };
        for vertex in self.near(0, &vertices(0)) {
            for face in faces[1]
                .iter()
                .filter(|face| self.are_near(&vertex, &face[..]))
            {
                ask(TurningVertexTurningFace::new(vertex, m, *face, n)?.into());
            }
        }
        for vertex in self.near(1, &vertices(1)) {
            for face in faces[0]
                .iter()
                .filter(|face| self.are_near(&face[..], &vertex))
            {
                ask(TurningVertexTurningFace::new(vertex, n, *face, m)?.into());
            }
        }
        if let [Core::Surface(a), Core::Surface(b)] = cores {
            let of_second = self.near(1, &b.edges);
            for edge in self.near(0, &a.edges) {
                for other in of_second
                    .iter()
                    .filter(|other| self.are_near(&edge, &other[..]))
                {
                    ask(TurningEdgeTurningEdge::new(edge, m, *other, n)?.into());
                }
            }
        }
        Ok(first(hits))
    }

    fn are_near(&self, a: &[Point], b: &[Point]) -> bool {
        !self.is_apart(a, b, [0.0, 1.0], HALVINGS)
    }
}

/// Whether points of two bodies are farther apart than a margin along an axis, at each of some times.
fn is_between(axis: &Vector, times: &[[Vec<Vector>; 2]], margin: f64) -> bool {
    let is_beyond = |[first, second]: [usize; 2]| {
        let mut times = times.iter();
        times.all(|points| gap(axis, &points[first], &points[second]) > margin)
    };
    is_beyond([0, 1]) || is_beyond([1, 0])
}

/// Whether points of two bodies at rest are farther apart than a margin.
pub(super) fn are_apart(a: &[Vector], b: &[Vector], margin: f64) -> bool {
    let now = [[a.to_vec(), b.to_vec()]];
    axes(a, b).iter().any(|axis| is_between(axis, &now, margin))
}

/// The corners of some faces, once each.
pub(super) fn corners(faces: &[[Point; 3]]) -> Vec<Point> {
    let mut corners: Vec<Point> = faces.as_flattened().to_vec();
    let order = |a: &Point, b: &Point| {
        let by_axis = (0..3).map(|axis| a[axis].total_cmp(&b[axis]));
        by_axis.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
    };
    corners.sort_by(order);
    corners.dedup();
    corners
}

/// A triangle of the plane `z = 0` that covers a circle of this radius.
pub(super) fn covering(radius: f64) -> [Point; 3] {
    let size = 16.0 * radius.max(1e-300);
    [
        Point::new(-size, -size, 0.0),
        Point::new(2.0 * size, -size, 0.0),
        Point::new(-size, 2.0 * size, 0.0),
    ]
}

/// Directions in which points of two bodies may be apart, each of length 1: those of the axes, that
/// from one to the other, and of single edges and faces those across them.
fn axes(a: &[Vector], b: &[Vector]) -> Vec<Vector> {
    let mean = |points: &[Vector]| points.iter().sum::<Vector>() / points.len().max(1) as f64;
    let mut axes = vec![Vector::x(), Vector::y(), Vector::z(), mean(a) - mean(b)];
    let sides = |points: &[Vector]| -> Vec<Vector> {
        match points {
            [p, q] => vec![q - p],
            [p, q, r] => vec![q - p, r - q, p - r],
            _ => Vec::new(),
        }
    };
    let (of_a, of_b) = (sides(a), sides(b));
    for own in [&of_a, &of_b] {
        if let [first, second, _] = own[..] {
            let normal = first.cross(&second);
            axes.push(normal);
            axes.extend(own.iter().map(|side| side.cross(&normal)));
        }
    }
    axes.extend(
        of_a.iter()
            .flat_map(|k| of_b.iter().map(move |l| k.cross(l))),
    );
    let unit = |axis: &Vector| axis.try_normalize(1e-200);
    axes.iter().filter_map(unit).collect()
}

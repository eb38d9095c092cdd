//! Two bodies whose cores touch.
//!
//! Both go from stage to stage at the same times, and in each stage as [`RigidMotion`] says. Where
//! two closed surfaces that are apart first touch, a vertex of one touches a face of the other, or an
//! edge touches an edge: `TurningVertexTurningFace` and `TurningEdgeTurningEdge`, decided by the
//! certified path. Two that touch or overlap as the step starts are left out, for as long as that is
//! so.

use super::body_detect::{across_edges, on_face, side};
use super::body_motion::{BodyWay, direction_into_body};
use super::core_boxes::{self, Bounds, CornerBoxes};
use super::inside::plane_around;
use super::overlap;
use super::segment::direction;
use crate::certified::decide_rigid;
use crate::contact::{EdgePoint, Hit};
use crate::query::Point;
use crate::rigid::{RigidError, RigidMotion, TurningEdgeTurningEdge, TurningVertexTurningFace};
use crate::wire::Vector;
use crate::wire::contact::{ContactConstraint, ContactSite};
use crate::wire::model::BodyId;
use crate::wire::model::core::{Core, Surface};
use crate::wire::record::{BodyCrossingOutcome, CoreCrossing};
use crate::wire::step::motion::ProposedMotion;
use crate::wire::world::World;

/// Two cores that touch.
pub(super) struct CoreHit {
    /// The two places; the normal is in the frame of the second body.
    pub(super) sites: [CoreSite; 2],
    /// When, from 0 to 1 in the step.
    pub(super) toi: f64,
    /// Where in space, rounded.
    at: Point,
    /// Unit normal from the second body to where the first one comes from. None where parallel edges
    /// touch.
    normal: Option<Vector>,
}

/// A place on a core, in the body's frame.
#[derive(Clone, Copy)]
pub(super) struct CoreSite {
    pub(super) body: BodyId,
    local: Vector,
}

/// How far apart two cores are to be, in m.
#[derive(Clone, Copy)]
pub(super) struct Clearance {
    /// Where the surfaces touch.
    surfaces: f64,
    /// More than the solver may err.
    least: f64,
}

impl Clearance {
    pub(super) fn of(cores: [&Core; 2]) -> Self {
        /// As parts of the larger core: for surfaces that are their own cores, and the least.
        const PARTS: [f64; 2] = [1e-4, 1e-6];
        let size = cores.map(Core::size);
        let [own, least] = PARTS.map(|part| part * size[0].max(size[1]));
        let [a, b] = cores.map(Core::inset);
        let surfaces = if a + b > 0.0 { a + b } else { own };
        Clearance { surfaces, least }
    }

    /// The gap of a contact of cores that are so far apart. Below 0 it pushes, and yields; where it is
    /// not, it holds. Surfaces that are inside each other are held where they are: contacts push
    /// them. Only cores that all but touch are pushed.
    fn gap(&self, apart: f64) -> f64 {
        let gap = apart - self.surfaces;
        match apart > self.least {
            true => gap.max(0.0),
            false => gap.max(-self.surfaces),
        }
    }
}

/// The first touch of the cores of two bodies, of which one moves; whether their boxes met in any
/// stage.
pub(super) fn first_core_touch(
    bodies: [BodyId; 2],
    cores: [&Core; 2],
    ways: [&BodyWay; 2],
    tested: &mut bool,
) -> Result<Option<CoreHit>, RigidError> {
    let Some(stages) = BodyWay::common_pieces(ways) else {
        return Ok(None);
    };
    for stage in 0..stages {
        let motions = ways.map(|way| way.piece(stage));
        let touch = match cores {
            [Core::Surface(a), Core::Surface(b)] => touch_surfaces([a, b], motions, tested)?,
            [Core::Surface(a), Core::Plane] => touch_plane(a, motions, tested)?,
            [Core::Plane, Core::Surface(b)] => {
                let [a_motion, b_motion] = motions;
                touch_plane(b, [b_motion, a_motion], tested)?.map(Touch::turned)
            }
            // No force moves a plane.
            [Core::Plane, Core::Plane] => None,
        };
        let Some(touch) = touch else { continue };
        let at_once = stage == 0 && touch.toi_above == 0.0;
        let starts = ways.map(|way| way.pieces[0].start());
        if at_once || overlap::is_certain(cores, starts)? {
            return Ok(None);
        }
        let at = |stage: usize| stage as f64 / stages as f64;
        let [from, to] = [at(stage), at(stage + 1)];
        let toi = from + (to - from) * touch.toi;
        return Ok(Some(touch.hit(bodies, ways, motions, toi)));
    }
    Ok(None)
}

/// The first touch in a stage.
struct Touch {
    toi: f64,
    toi_above: f64,
    /// The places on the first and on the second body.
    locals: [Vector; 2],
    /// Which body's frame the normal is in; it points from that body to the other one.
    holder: usize,
    normal: Option<Vector>,
}

impl Touch {
    fn new<P>(hit: &Hit<P>, locals: [Vector; 2], normal: Option<Vector>) -> Self {
        Touch {
            toi: hit.toi,
            toi_above: hit.toi_above,
            locals,
            holder: 1,
            normal,
        }
    }

    /// With the bodies the other way round.
    fn turned(self) -> Self {
        let [a, b] = self.locals;
        Touch {
            locals: [b, a],
            holder: 1 - self.holder,
            ..self
        }
    }

    /// As a hit, at a time of the whole step.
    fn hit(
        self,
        bodies: [BodyId; 2],
        ways: [&BodyWay; 2],
        motions: [&RigidMotion; 2],
        toi: f64,
    ) -> CoreHit {
        let (first, second) = (1 - self.holder, self.holder);
        let place = |body: usize, motion: &RigidMotion, t: f64| {
            motion.position(&Point::from(self.locals[body]), t)
        };
        let starts = ways.map(|way| &way.pieces[0]);
        let came_from = place(first, starts[first], 0.0) - place(second, starts[second], 0.0);
        let came_from = direction_into_body(starts[second], 0.0, &came_from);
        let site = |body: usize| CoreSite {
            body: bodies[body],
            local: self.locals[body],
        };
        CoreHit {
            sites: [site(first), site(second)],
            toi,
            at: place(second, motions[second], self.toi),
            normal: self
                .normal
                .and_then(|normal| side(Some(normal), &came_from)),
        }
    }
}

fn keep_first(first: &mut Option<Touch>, other: Option<Touch>) {
    let Some(other) = other else { return };
    let key = |touch: &Touch| (touch.toi, touch.toi_above);
    if first.as_ref().is_none_or(|first| key(&other) < key(first)) {
        *first = Some(other);
    }
}

/// The first touch of two closed surfaces in a stage.
fn touch_surfaces(
    surfaces: [&Surface; 2],
    motions: [&RigidMotion; 2],
    tested: &mut bool,
) -> Result<Option<Touch>, RigidError> {
    let [a, b] = surfaces;
    let offset = core_boxes::offset(motions[1], motions[0]);
    let a_boxes = CornerBoxes::new(motions[0], &a.vertices).seen_from(&offset);
    let b_boxes = CornerBoxes::new(motions[1], &b.vertices);
    if a_boxes.whole.is_apart(&b_boxes.whole) {
        return Ok(None);
    }
    *tested = true;
    let mut first = None;
    vertices_on_faces(&mut first, [a, b], [&a_boxes, &b_boxes], motions, |touch| {
        touch
    })?;
    let [a_motion, b_motion] = motions;
    vertices_on_faces(
        &mut first,
        [b, a],
        [&b_boxes, &a_boxes],
        [b_motion, a_motion],
        Touch::turned,
    )?;
    let b_edges = near(&b.edges, &b_boxes, &a_boxes.whole);
    for (edge, around) in near(&a.edges, &a_boxes, &b_boxes.whole) {
        for (other, beside) in &b_edges {
            if !around.is_apart(beside) {
                let own = edge.map(|k| a.vertices[k]);
                let other = other.map(|k| b.vertices[k]);
                keep_first(&mut first, touch_edges([own, other], motions)?);
            }
        }
    }
    Ok(first)
}

/// Edges or faces whose boxes meet another one.
fn near<const N: usize>(
    parts: &[[usize; N]],
    boxes: &CornerBoxes,
    other: &Bounds,
) -> Vec<([usize; N], Bounds)> {
    let around = parts.iter().map(|part| (*part, boxes.of(part)));
    around
        .filter(|(_, around)| !around.is_apart(other))
        .collect()
}

/// Keeps the first touch of vertices of the first surface with faces of the second one.
fn vertices_on_faces(
    first: &mut Option<Touch>,
    [a, b]: [&Surface; 2],
    [a_boxes, b_boxes]: [&CornerBoxes; 2],
    motions: [&RigidMotion; 2],
    ordered: fn(Touch) -> Touch,
) -> Result<(), RigidError> {
    let faces = near(&b.faces, b_boxes, &a_boxes.whole);
    for (vertex, at) in a.vertices.iter().zip(&a_boxes.corners) {
        for (face, around) in &faces {
            if !at.is_apart(around) {
                let corners = face.map(|k| b.vertices[k]);
                let touch = touch_face(vertex, &corners, motions)?;
                keep_first(first, touch.map(ordered));
            }
        }
    }
    Ok(())
}

/// The first touch of a surface with the plane of the second body: that of a vertex.
fn touch_plane(
    surface: &Surface,
    motions: [&RigidMotion; 2],
    tested: &mut bool,
) -> Result<Option<Touch>, RigidError> {
    let [motion, of_plane] = motions;
    let ends = |m: &RigidMotion| [m.start(), m.end()].map(|pose| pose.centre);
    let ways = ends(motion).into_iter().zip(ends(of_plane));
    let far = ways.fold(0.0, |far: f64, (to, from)| far.max((to - from).norm()));
    let mut first = None;
    for vertex in &surface.vertices {
        if core_boxes::is_above(motion, vertex, of_plane) {
            continue;
        }
        *tested = true;
        // Nowhere is it farther from the plane's centre than the body's centre and it from that.
        let corners = plane_around(far + vertex.coords.norm());
        keep_first(&mut first, touch_face(vertex, &corners, motions)?);
    }
    Ok(first)
}

fn touch_face(
    vertex: &Point,
    corners: &[Point; 3],
    motions: [&RigidMotion; 2],
) -> Result<Option<Touch>, RigidError> {
    let query = TurningVertexTurningFace::new([*vertex], *motions[0], *corners, *motions[1])?;
    let touch = decide_rigid(&query).map(|hit| {
        let (place, normal) = on_face(&hit, corners);
        Touch::new(&hit, [vertex.coords, place], normal)
    });
    Ok(touch)
}

fn touch_edges(
    [own, other]: [[Point; 2]; 2],
    motions: [&RigidMotion; 2],
) -> Result<Option<Touch>, RigidError> {
    let query = TurningEdgeTurningEdge::new(own, *motions[0], other, *motions[1])?;
    let touch = decide_rigid(&query).map(|hit| {
        let EdgePoint { u, v } = hit.place.first;
        let across = across_edges(&query.positions(hit.toi), hit.side);
        let normal = across.map(|across| direction_into_body(motions[1], hit.toi, &across));
        let place = |ends: &[Point; 2], w: f64| ends[0].coords * (1.0 - w) + ends[1].coords * w;
        Touch::new(&hit, [place(&own, u), place(&other, v)], normal)
    });
    Ok(touch)
}

impl CoreHit {
    /// The two bodies, by number.
    pub(super) fn bodies(&self) -> [BodyId; 2] {
        let [a, b] = self.sites.map(|site| site.body);
        [a.min(b), a.max(b)]
    }

    pub(super) fn crossing(&self, outcome: BodyCrossingOutcome) -> CoreCrossing {
        CoreCrossing {
            bodies: self.bodies(),
            toi: self.toi,
            at: self.at,
            outcome,
        }
    }

    /// A contact by which the bodies stay on their sides of each other where the motion ends. None
    /// without a normal.
    pub(super) fn row(
        &self,
        world: &World,
        motion: &ProposedMotion,
        clearance: Clearance,
        friction: f64,
        key: u64,
    ) -> Option<ContactConstraint> {
        let [first, second] = &self.sites;
        let ended = motion.body(second.body);
        let normal = direction(&(ended.orientation * self.normal?))?;
        let arrives = first.straight_from(world, motion) - second.straight_from(world, motion);
        let gap = clearance.gap(normal.dot(&arrives));
        let [a, b] = self
            .sites
            .map(|CoreSite { body, local }| ContactSite::Body { body, local });
        Some(ContactConstraint {
            key,
            a,
            b,
            normal,
            gap,
            friction,
        })
    }
}

impl CoreSite {
    /// Where a straight way at the velocity of the row has to start, to arrive where the motion
    /// does: the row takes the point straight on, the motion turns it.
    fn straight_from(&self, world: &World, motion: &ProposedMotion) -> Point {
        let ended = motion.body(self.body);
        let arm = world.bodies[self.body.0].arm(&self.local);
        let velocity = ended.velocity + ended.angular_velocity.cross(&arm);
        ended.position + ended.orientation * self.local - velocity * world.settings.step
    }
}

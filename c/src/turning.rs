//! Bodies that turn.

use std::mem::MaybeUninit;
use std::slice;

use tunnelproof::certified::RigidKind;
use tunnelproof::contact::Place;
use tunnelproof::nalgebra::Quaternion;
use tunnelproof::rigid::{EdgeTurningEdge, Pose, RigidError, RigidMotion, VertexTurningFace};
use tunnelproof::{Hit as EngineHit, Point, Radius, decide_rigid};
use tunnelproof_float_env::with_default;

use crate::{
    ContactPoint, HIT, Hit, MISS, NO_ORIENTATION, NOT_FINITE, NULL, RADIUS, TURNS_TOO_FAR,
};

/// A kind of query about a body that turns.
trait Turning: RigidKind {
    /// How many points there are in space, and in the body's frame.
    const POINTS: [usize; 2];

    /// The query of the points in space at the start, then at the end, and those in the body's
    /// frame, of which there are as many as [`POINTS`](Self::POINTS) says.
    fn new(
        points: &[f64],
        local: &[f64],
        motion: RigidMotion,
        radius: Radius,
    ) -> Result<Self, RigidError>;

    fn point(&self, weights: &[f64; 4], t: f64) -> Point;
}

/// Point `i` of coordinates that follow one another.
fn point(coordinates: &[f64], i: usize) -> Point {
    Point::new(
        coordinates[3 * i],
        coordinates[3 * i + 1],
        coordinates[3 * i + 2],
    )
}

impl Turning for EdgeTurningEdge {
    const POINTS: [usize; 2] = [2, 2];

    fn new(
        points: &[f64],
        local: &[f64],
        motion: RigidMotion,
        radius: Radius,
    ) -> Result<Self, RigidError> {
        let at = |i| point(points, i);
        let local = [point(local, 0), point(local, 1)];
        EdgeTurningEdge::with_radius([at(0), at(1)], [at(2), at(3)], local, motion, radius)
    }

    fn point(&self, weights: &[f64; 4], t: f64) -> Point {
        self.point(weights, t)
    }
}

impl Turning for VertexTurningFace {
    const POINTS: [usize; 2] = [1, 3];

    fn new(
        points: &[f64],
        local: &[f64],
        motion: RigidMotion,
        radius: Radius,
    ) -> Result<Self, RigidError> {
        let at = |i| point(points, i);
        let local = [0, 1, 2].map(|i| point(local, i));
        VertexTurningFace::with_radius([at(0)], [at(1)], local, motion, radius)
    }

    fn point(&self, weights: &[f64; 4], t: f64) -> Point {
        self.point(weights, t)
    }
}

/// The numbers of queries that follow one another.
struct Numbers<'a> {
    points: &'a [f64],
    local: &'a [f64],
    poses: &'a [[f64; 14]],
    radii: Option<&'a [[f64; 2]]>,
}

impl Numbers<'_> {
    /// A query, or the verdict that refuses it.
    fn query<K: Turning>(&self, index: usize) -> Result<K, i32> {
        let [world, local] = K::POINTS;
        let points = &self.points[6 * world * index..][..6 * world];
        let local = &self.local[3 * local * index..][..3 * local];
        let [cx, cy, cz, w, x, y, z, end @ ..] = self.poses[index];
        let pose = |[cx, cy, cz, w, x, y, z]: [f64; 7]| {
            Pose::new(Point::new(cx, cy, cz), Quaternion::new(w, x, y, z))
        };
        let radii = self.radii.map_or([0.0; 2], |radii| radii[index]);
        let motion = RigidMotion::new(pose([cx, cy, cz, w, x, y, z]), pose(end));
        motion
            .and_then(|motion| K::new(points, local, motion, Radius::from(radii)))
            .map_err(|error| match error {
                RigidError::NoOrientation { .. } => NO_ORIENTATION,
                RigidError::TurnsTooFar { .. } => TURNS_TOO_FAR,
                RigidError::Radius(_) => RADIUS,
                _ => NOT_FINITE,
            })
    }
}

fn decide<K: Turning>(query: &K, out: Option<&mut MaybeUninit<Hit>>) -> i32 {
    let Some(hit) = decide_rigid(query) else {
        return MISS;
    };
    if let Some(out) = out {
        out.write(written(query, &hit));
    }
    HIT
}

fn written<K: Turning>(query: &K, hit: &EngineHit<K::Place>) -> Hit {
    let place: Place = hit.place.into();
    let contact = |weights| ContactPoint {
        weights,
        point: query.point(&weights, hit.toi).into(),
    };
    let (first, second) = place.weights();
    Hit::without_normal(hit, contact(first), second.map(contact))
}

/// Reads the arguments of queries.
///
/// # Safety
///
/// Each pointer is null or points to what the header says, `count` times.
unsafe fn decide_all_at<K: Turning>(
    [points, local, poses, radii]: [*const f64; 4],
    count: usize,
    verdicts: *mut i32,
    hits: *mut Hit,
) -> i64 {
    if count == 0 {
        return 0;
    }
    if points.is_null() || local.is_null() || poses.is_null() || verdicts.is_null() {
        return NULL.into();
    }
    let [of_world, of_body] = K::POINTS;
    // SAFETY: none of them is null, each points to so many numbers, of which nobody changes one
    // during the call. So do the radii, if they are not null.
    let numbers = unsafe {
        Numbers {
            points: slice::from_raw_parts(points, 6 * of_world * count),
            local: slice::from_raw_parts(local, 3 * of_body * count),
            poses: slice::from_raw_parts(poses.cast(), count),
            radii: (!radii.is_null()).then(|| slice::from_raw_parts(radii.cast(), count)),
        }
    };
    // SAFETY: it is not null and points to memory for `count` integers that nobody else uses
    // during the call.
    let verdicts = unsafe { slice::from_raw_parts_mut(verdicts.cast::<MaybeUninit<i32>>(), count) };
    let hits = hits.cast::<MaybeUninit<Hit>>();
    // SAFETY: as above, with `count` hits.
    let mut hits = (!hits.is_null()).then(|| unsafe { slice::from_raw_parts_mut(hits, count) });
    let mut found = 0;
    for (index, verdict) in verdicts.iter_mut().enumerate() {
        let out = hits.as_mut().map(|hits| &mut hits[index]);
        let said = numbers
            .query::<K>(index)
            .map_or_else(|refused| refused, |query| decide(&query, out));
        verdict.write(said);
        found += i64::from(said == HIT);
    }
    found
}

/// Reads the arguments of a single query.
///
/// # Safety
///
/// Each pointer is null or points to what the header says.
unsafe fn decide_at<K: Turning>(numbers: [*const f64; 4], hit: *mut Hit) -> i32 {
    let mut verdict = NULL;
    // SAFETY: the caller's promise is the same; there is one verdict, which is ours.
    unsafe { decide_all_at::<K>(numbers, 1, &mut verdict, hit) };
    verdict
}

/// `tunnelproof_decide_edge_turning_edge`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_edge_turning_edge(
    points: *const f64,
    local: *const f64,
    poses: *const f64,
    radii: *const f64,
    hit: *mut Hit,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_at::<EdgeTurningEdge>([points, local, poses, radii], hit) })
}

/// `tunnelproof_decide_edge_turning_edge_batch`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_edge_turning_edge_batch(
    points: *const f64,
    local: *const f64,
    poses: *const f64,
    radii: *const f64,
    count: usize,
    verdicts: *mut i32,
    hits: *mut Hit,
) -> i64 {
    let numbers = [points, local, poses, radii];
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_all_at::<EdgeTurningEdge>(numbers, count, verdicts, hits) })
}

/// `tunnelproof_decide_vertex_turning_face`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_vertex_turning_face(
    points: *const f64,
    local: *const f64,
    poses: *const f64,
    radii: *const f64,
    hit: *mut Hit,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_at::<VertexTurningFace>([points, local, poses, radii], hit) })
}

/// `tunnelproof_decide_vertex_turning_face_batch`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_vertex_turning_face_batch(
    points: *const f64,
    local: *const f64,
    poses: *const f64,
    radii: *const f64,
    count: usize,
    verdicts: *mut i32,
    hits: *mut Hit,
) -> i64 {
    let numbers = [points, local, poses, radii];
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_all_at::<VertexTurningFace>(numbers, count, verdicts, hits) })
}

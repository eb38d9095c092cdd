//! Bodies that turn.

use std::mem::MaybeUninit;
use std::{ptr, slice};

use tunnelproof::certified::RigidKind as _;
use tunnelproof::nalgebra::Quaternion;
use tunnelproof::query::QueryKind;
use tunnelproof::rigid::{Pose, RigidError, RigidQuery};
use tunnelproof::{Point, Radius, decide_rigid};
use tunnelproof_float_env::with_default;

use crate::{
    ContactPoint, HIT, Hit, MISS, NO_ORIENTATION, NOT_FINITE, NULL, RADIUS, TURNS_TOO_FAR,
};

/// A kind of query.
#[derive(Clone, Copy)]
struct Form {
    kind: QueryKind,
    /// Whether the first side is of a body too.
    both_turn: bool,
}

const EDGES: Form = Form {
    kind: QueryKind::EdgeEdge,
    both_turn: false,
};
const FACE: Form = Form {
    kind: QueryKind::VertexFace,
    both_turn: false,
};
const TURNING_EDGES: Form = Form {
    both_turn: true,
    ..EDGES
};
const TURNING_FACE: Form = Form {
    both_turn: true,
    ..FACE
};

impl Form {
    /// How many numbers a query has for points in space, for points of bodies and for poses.
    fn numbers(self) -> [usize; 3] {
        match (self.both_turn, self.kind) {
            (true, _) => [0, 12, 28],
            (false, QueryKind::EdgeEdge) => [12, 6, 14],
            (false, QueryKind::VertexFace) => [6, 9, 14],
        }
    }
}

/// The numbers of queries that follow one another.
struct Numbers<'a> {
    form: Form,
    points: &'a [f64],
    local: &'a [f64],
    poses: &'a [f64],
    radii: Option<&'a [[f64; 2]]>,
}

impl Numbers<'_> {
    /// A query, or the verdict that refuses it.
    fn query(&self, index: usize) -> Result<RigidQuery, i32> {
        let [of_points, of_local, of_poses] = self.form.numbers();
        let points = rows(&self.points[of_points * index..][..of_points], point);
        let local = rows(&self.local[of_local * index..][..of_local], point);
        let poses = rows(&self.poses[of_poses * index..][..of_poses], pose);
        let radius = Radius::from(self.radii.map_or([0.0; 2], |radii| radii[index]));
        let query = RigidQuery::from_lists(self.form.kind, &points, &local, &poses, radius);
        query.map_err(|error| match error {
            RigidError::NoOrientation { .. } => NO_ORIENTATION,
            RigidError::TurnsTooFar { .. } => TURNS_TOO_FAR,
            RigidError::Radius(_) => RADIUS,
            _ => NOT_FINITE,
        })
    }
}

fn rows<T, const N: usize>(numbers: &[f64], row: fn([f64; N]) -> T) -> Vec<T> {
    let (rows, _) = numbers.as_chunks();
    rows.iter().copied().map(row).collect()
}

fn point([x, y, z]: [f64; 3]) -> Point {
    Point::new(x, y, z)
}

fn pose([cx, cy, cz, w, x, y, z]: [f64; 7]) -> Pose {
    Pose::new(Point::new(cx, cy, cz), Quaternion::new(w, x, y, z))
}

fn decide(query: &RigidQuery, out: Option<&mut MaybeUninit<Hit>>) -> i32 {
    let Some(hit) = decide_rigid(query) else {
        return MISS;
    };
    if let Some(out) = out {
        let contact = |weights| ContactPoint {
            weights,
            point: query.point(&weights, hit.toi).into(),
        };
        let (first, second) = hit.place.weights();
        out.write(Hit::without_normal(
            &hit,
            contact(first),
            second.map(contact),
        ));
    }
    HIT
}

/// Reads the arguments of queries.
///
/// # Safety
///
/// Each pointer is null or points to what the header says, `count` times.
unsafe fn decide_all_at(
    form: Form,
    [points, local, poses, radii]: [*const f64; 4],
    count: usize,
    verdicts: *mut i32,
    hits: *mut Hit,
) -> i64 {
    if count == 0 {
        return 0;
    }
    let [of_points, of_local, of_poses] = form.numbers();
    let lacks_points = points.is_null() && !form.both_turn;
    if lacks_points || local.is_null() || poses.is_null() || verdicts.is_null() {
        return NULL.into();
    }
    // SAFETY: none of them is null, each points to so many numbers, of which nobody changes one
    // during the call. So do the radii, if they are not null, and the points, if there are any.
    let numbers = unsafe {
        Numbers {
            form,
            points: match form.both_turn {
                true => &[],
                false => slice::from_raw_parts(points, of_points * count),
            },
            local: slice::from_raw_parts(local, of_local * count),
            poses: slice::from_raw_parts(poses, of_poses * count),
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
            .query(index)
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
unsafe fn decide_at(form: Form, numbers: [*const f64; 4], hit: *mut Hit) -> i32 {
    let mut verdict = NULL;
    // SAFETY: the caller's promise is the same; there is one verdict, which is ours.
    unsafe { decide_all_at(form, numbers, 1, &mut verdict, hit) };
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
    with_default(|| unsafe { decide_at(EDGES, [points, local, poses, radii], hit) })
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
    with_default(|| unsafe { decide_all_at(EDGES, numbers, count, verdicts, hits) })
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
    with_default(|| unsafe { decide_at(FACE, [points, local, poses, radii], hit) })
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
    with_default(|| unsafe { decide_all_at(FACE, numbers, count, verdicts, hits) })
}

/// `tunnelproof_decide_turning_edge_turning_edge`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_turning_edge_turning_edge(
    local: *const f64,
    poses: *const f64,
    radii: *const f64,
    hit: *mut Hit,
) -> i32 {
    let numbers = [ptr::null(), local, poses, radii];
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_at(TURNING_EDGES, numbers, hit) })
}

/// `tunnelproof_decide_turning_edge_turning_edge_batch`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_turning_edge_turning_edge_batch(
    local: *const f64,
    poses: *const f64,
    radii: *const f64,
    count: usize,
    verdicts: *mut i32,
    hits: *mut Hit,
) -> i64 {
    let numbers = [ptr::null(), local, poses, radii];
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_all_at(TURNING_EDGES, numbers, count, verdicts, hits) })
}

/// `tunnelproof_decide_turning_vertex_turning_face`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_turning_vertex_turning_face(
    local: *const f64,
    poses: *const f64,
    radii: *const f64,
    hit: *mut Hit,
) -> i32 {
    let numbers = [ptr::null(), local, poses, radii];
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_at(TURNING_FACE, numbers, hit) })
}

/// `tunnelproof_decide_turning_vertex_turning_face_batch`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_turning_vertex_turning_face_batch(
    local: *const f64,
    poses: *const f64,
    radii: *const f64,
    count: usize,
    verdicts: *mut i32,
    hits: *mut Hit,
) -> i64 {
    let numbers = [ptr::null(), local, poses, radii];
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_all_at(TURNING_FACE, numbers, count, verdicts, hits) })
}

//! The certified path for C: `include/tunnelproof.h`, which documents it, function for function.
//!
//! Pointers are all that is unsafe here. Each function reads its arguments as slices in one place,
//! next to the header's promise that makes it sound, and works on those. All of it happens in the
//! default floating-point environment ([`with_default`]), also the comparison of an argument with 0,
//! which a host that flushes subnormal numbers to zero would answer otherwise; so do the threads of
//! the pool for meshes and pairs, which is started there and runs nothing else.

use std::ffi::{CStr, c_char};
use std::mem::MaybeUninit;
use std::slice;

use tunnelproof::certified::Kind;
use tunnelproof::contact::Place;
use tunnelproof::{
    Batch, Case, ContactKind, ContactPoint as EnginePoint, EdgeEdge, Hit as EngineHit, Normal,
    Point, QueryError, Radius, VertexFace,
};
use tunnelproof_float_env::with_default;

mod advance;
mod arrays;
mod mesh;
mod motion;
mod pairs;
mod step;
mod subject;
mod turning;

pub use advance::{
    Advance, tunnelproof_advance_edge_edge, tunnelproof_advance_edge_edge_f32,
    tunnelproof_advance_vertex_face, tunnelproof_advance_vertex_face_f32,
};
pub use arrays::Error;
pub use mesh::*;
pub use motion::*;
pub use pairs::*;
pub use step::*;
pub use subject::{tunnelproof_certified_edge_edge, tunnelproof_certified_vertex_face};
pub use turning::*;

const MISS: i32 = 0;
const HIT: i32 = 1;
const NULL: i32 = -1;
const NOT_FINITE: i32 = -2;
const RADIUS: i32 = -3;
const INDEX: i32 = -4;
const COUNT: i32 = -5;
const LENGTH: i32 = -6;
const CLEARANCE: i32 = -7;
const NO_ORIENTATION: i32 = -8;
const TURNS_TOO_FAR: i32 = -9;
const POSITIONS: i32 = -10;

/// `tunnelproof_contact_point`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ContactPoint {
    weights: [f64; 4],
    point: [f64; 3],
}

impl From<EnginePoint> for ContactPoint {
    fn from(contact: EnginePoint) -> Self {
        ContactPoint {
            weights: contact.weights,
            point: contact.point.into(),
        }
    }
}

/// `tunnelproof_hit`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    toi: f64,
    toi_above: f64,
    kind: i32,
    side: i32,
    motion_case: i32,
    temporarily_parallel: i32,
    temporarily_point: i32,
    has_second: i32,
    first: ContactPoint,
    second: ContactPoint,
    place_error: f64,
    normal: [f64; 3],
    normal_error: f64,
}

impl Hit {
    fn new<Q: Query>(query: &Q, hit: &EngineHit<Q::Place>) -> Self {
        let (first, second) = hit.points(query);
        let points = (first.into(), second.map(ContactPoint::from));
        Hit::at(hit, points, hit.normal(query))
    }

    /// A hit with its point or points and its normal.
    fn at<P: Copy + Into<Place>>(
        hit: &EngineHit<P>,
        (first, second): (ContactPoint, Option<ContactPoint>),
        normal: Option<Normal>,
    ) -> Self {
        let place: Place = hit.place.into();
        Hit {
            toi: hit.toi,
            toi_above: hit.toi_above,
            kind: kind(hit.kind),
            side: hit.side.into(),
            motion_case: case(hit.case),
            temporarily_parallel: hit.flags.temporarily_parallel.into(),
            temporarily_point: hit.flags.temporarily_point.into(),
            has_second: second.is_some().into(),
            first,
            second: second.unwrap_or(first),
            place_error: place.error(),
            normal: normal.map_or([0.0; 3], |normal| normal.direction.into()),
            normal_error: normal.map_or(0.0, |normal| normal.error),
        }
    }
}

/// A value of `tunnelproof_kind`.
fn kind(kind: ContactKind) -> i32 {
    match kind {
        ContactKind::Crossing => 1,
        ContactKind::Graze => 2,
    }
}

/// A value of `tunnelproof_case`.
fn case(case: Case) -> i32 {
    match case {
        Case::General => 1,
        Case::Coplanar => 2,
        Case::Parallel => 3,
        Case::Collinear => 4,
        Case::SharedStart => 5,
        Case::Degenerate => 6,
    }
}

/// A kind of query.
trait Query: Kind {
    fn new(start: [Point; 4], end: [Point; 4], radius: Radius) -> Result<Self, QueryError>;
}

impl Query for EdgeEdge {
    fn new(start: [Point; 4], end: [Point; 4], radius: Radius) -> Result<Self, QueryError> {
        EdgeEdge::new(start, end, radius)
    }
}

impl Query for VertexFace {
    fn new(start: [Point; 4], end: [Point; 4], radius: Radius) -> Result<Self, QueryError> {
        VertexFace::new(start, end, radius)
    }
}

/// The query of 24 coordinates and two radii, or the verdict that refuses it.
fn query<Q: Query>(points: &[f64; 24], radii: [f64; 2]) -> Result<Q, i32> {
    let point = |i: usize| Point::new(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    let (start, end) = ([0, 1, 2, 3].map(point), [4, 5, 6, 7].map(point));
    <Q as Query>::new(start, end, Radius::from(radii)).map_err(|error| match error {
        QueryError::Radius(_) => RADIUS,
        // A coordinate, or what a later version refuses besides.
        _ => NOT_FINITE,
    })
}

fn decide<Q: Query>(
    points: &[f64; 24],
    radii: [f64; 2],
    out: Option<&mut MaybeUninit<Hit>>,
) -> i32 {
    let query = match query::<Q>(points, radii) {
        Ok(query) => query,
        Err(refused) => return refused,
    };
    match tunnelproof::decide(&query) {
        None => MISS,
        Some(hit) => {
            if let Some(out) = out {
                out.write(Hit::new(&query, &hit));
            }
            HIT
        }
    }
}

/// How many queries are decided together; so much memory is taken at a time.
const CHUNK: usize = 4096;

fn decide_all<Q: Query>(
    points: &[[f64; 24]],
    radii: Option<&[[f64; 2]]>,
    verdicts: &mut [MaybeUninit<i32>],
    mut hits: Option<&mut [MaybeUninit<Hit>]>,
) -> i64 {
    let mut count = 0;
    let (mut batch, mut queries) = (Batch::new(), Vec::new());
    for first in (0..points.len()).step_by(CHUNK) {
        batch.clear();
        queries.clear();
        for index in first..points.len().min(first + CHUNK) {
            let radii = radii.map_or([0.0; 2], |radii| radii[index]);
            let verdict = match query::<Q>(&points[index], radii) {
                Ok(query) => {
                    batch.push(&query);
                    queries.push((index, query));
                    MISS
                }
                Err(refused) => refused,
            };
            verdicts[index].write(verdict);
        }
        for (place, hit) in batch.decide() {
            let (index, query) = &queries[place];
            verdicts[*index].write(HIT);
            if let Some(hits) = &mut hits {
                hits[*index].write(Hit::new(query, &hit));
            }
            count += 1;
        }
    }
    count
}

/// Reads the arguments of a single query.
///
/// # Safety
///
/// Each pointer is null or points to what the header says.
unsafe fn decide_at<Q: Query>(points: *const f64, radii: *const f64, hit: *mut Hit) -> i32 {
    // SAFETY: not null, it points to 24 numbers, of which nobody changes one during the call.
    let Some(points) = (unsafe { points.cast::<[f64; 24]>().as_ref() }) else {
        return NULL;
    };
    // SAFETY: not null, it points to two numbers, of which nobody changes one during the call.
    let radii = unsafe { radii.cast::<[f64; 2]>().as_ref() };
    // SAFETY: not null, it points to memory for a hit that nobody else uses during the call.
    let hit = unsafe { hit.cast::<MaybeUninit<Hit>>().as_mut() };
    decide::<Q>(points, radii.copied().unwrap_or_default(), hit)
}

/// Reads the arguments of many queries.
///
/// # Safety
///
/// Each pointer is null or points to what the header says, `count` times.
unsafe fn decide_all_at<Q: Query>(
    points: *const f64,
    radii: *const f64,
    count: usize,
    verdicts: *mut i32,
    hits: *mut Hit,
) -> i64 {
    if count == 0 {
        return 0;
    }
    if points.is_null() || verdicts.is_null() {
        return NULL.into();
    }
    // SAFETY: it is not null and points to `count` times 24 numbers, of which nobody changes one
    // during the call.
    let points = unsafe { slice::from_raw_parts(points.cast::<[f64; 24]>(), count) };
    // SAFETY: as above, with two numbers each.
    let radii = (!radii.is_null())
        .then(|| unsafe { slice::from_raw_parts(radii.cast::<[f64; 2]>(), count) });
    // SAFETY: it is not null and points to memory for `count` integers that nobody else uses
    // during the call.
    let verdicts = unsafe { slice::from_raw_parts_mut(verdicts.cast::<MaybeUninit<i32>>(), count) };
    let hits = hits.cast::<MaybeUninit<Hit>>();
    // SAFETY: as above, with `count` hits.
    let hits = (!hits.is_null()).then(|| unsafe { slice::from_raw_parts_mut(hits, count) });
    decide_all::<Q>(points, radii, verdicts, hits)
}

/// `tunnelproof_decide_edge_edge`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_edge_edge(
    points: *const f64,
    radii: *const f64,
    hit: *mut Hit,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_at::<EdgeEdge>(points, radii, hit) })
}

/// `tunnelproof_decide_vertex_face`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_vertex_face(
    points: *const f64,
    radii: *const f64,
    hit: *mut Hit,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_at::<VertexFace>(points, radii, hit) })
}

/// `tunnelproof_decide_edge_edge_batch`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_edge_edge_batch(
    points: *const f64,
    radii: *const f64,
    count: usize,
    verdicts: *mut i32,
    hits: *mut Hit,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_all_at::<EdgeEdge>(points, radii, count, verdicts, hits) })
}

/// `tunnelproof_decide_vertex_face_batch`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_vertex_face_batch(
    points: *const f64,
    radii: *const f64,
    count: usize,
    verdicts: *mut i32,
    hits: *mut Hit,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide_all_at::<VertexFace>(points, radii, count, verdicts, hits) })
}

/// `tunnelproof_version`.
#[unsafe(no_mangle)]
pub extern "C" fn tunnelproof_version() -> *const c_char {
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(version) => version,
            Err(_) => c"",
        };
    VERSION.as_ptr()
}

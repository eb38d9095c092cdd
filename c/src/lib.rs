//! The certified path for C: `include/tunnelproof.h`, which documents it, function for function.
//!
//! Pointers are all that is unsafe here. Each function reads its arguments as slices in one place, next to
//! the header's promise that makes it sound, and works on those.

use std::ffi::{CStr, c_char};
use std::mem::MaybeUninit;
use std::slice;

use tunnelproof::certified::{
    self, Batch, FaceBatch, FaceHit as CertifiedFaceHit, Hit as CertifiedHit, Verdict,
};
use tunnelproof::contact::ContactKind;
use tunnelproof::query::{EdgeEdge, Point, QueryError, Radius, VertexFace};

const MISS: i32 = 0;
const HIT: i32 = 1;
const NULL: i32 = -1;
const NOT_FINITE: i32 = -2;
const RADIUS: i32 = -3;

/// `tunnelproof_edge_hit`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct EdgeHit {
    toi: f64,
    toi_above: f64,
    u: f64,
    v: f64,
    second_u: f64,
    second_v: f64,
    parameter_error: f64,
    crosses: i32,
    side: i32,
    is_overlap: i32,
}

impl From<CertifiedHit> for EdgeHit {
    fn from(hit: CertifiedHit) -> Self {
        let second = hit.second.unwrap_or(hit.first);
        EdgeHit {
            toi: hit.toi,
            toi_above: hit.toi_above,
            u: hit.first.u,
            v: hit.first.v,
            second_u: second.u,
            second_v: second.v,
            parameter_error: hit.parameter_error,
            crosses: crosses(hit.kind),
            side: hit.side.into(),
            is_overlap: hit.second.is_some().into(),
        }
    }
}

/// `tunnelproof_face_hit`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FaceHit {
    toi: f64,
    toi_above: f64,
    weights: [f64; 3],
    weight_error: f64,
    crosses: i32,
    side: i32,
}

impl From<CertifiedFaceHit> for FaceHit {
    fn from(hit: CertifiedFaceHit) -> Self {
        FaceHit {
            toi: hit.toi,
            toi_above: hit.toi_above,
            weights: hit.weights,
            weight_error: hit.weight_error,
            crosses: crosses(hit.kind),
            side: hit.side.into(),
        }
    }
}

fn crosses(kind: ContactKind) -> i32 {
    i32::from(kind == ContactKind::Crossing)
}

/// A kind of query.
trait Query: Sized {
    type Hit;

    fn new(start: [Point; 4], end: [Point; 4], radius: Radius) -> Result<Self, QueryError>;

    fn decide(&self) -> Option<Self::Hit>;

    /// All hits, by the place of the query.
    fn decide_all(queries: &[Self], hit: impl FnMut(usize, Self::Hit));
}

impl Query for EdgeEdge {
    type Hit = EdgeHit;

    fn new(start: [Point; 4], end: [Point; 4], radius: Radius) -> Result<Self, QueryError> {
        EdgeEdge::new(start, end, radius)
    }

    fn decide(&self) -> Option<EdgeHit> {
        match certified::decide(self) {
            Verdict::Miss => None,
            Verdict::Hit(hit) => Some(hit.into()),
        }
    }

    fn decide_all(queries: &[Self], mut hit: impl FnMut(usize, EdgeHit)) {
        let mut batch = Batch::new();
        queries.iter().for_each(|query| batch.push(query));
        batch.decide(|index, found| hit(index, found.into()));
    }
}

impl Query for VertexFace {
    type Hit = FaceHit;

    fn new(start: [Point; 4], end: [Point; 4], radius: Radius) -> Result<Self, QueryError> {
        VertexFace::new(start, end, radius)
    }

    fn decide(&self) -> Option<FaceHit> {
        certified::decide_vertex_face(self).map(FaceHit::from)
    }

    fn decide_all(queries: &[Self], mut hit: impl FnMut(usize, FaceHit)) {
        let mut batch = FaceBatch::new();
        queries.iter().for_each(|query| batch.push(query));
        batch.decide(|index, found| hit(index, found.into()));
    }
}

/// The query of 24 coordinates and two radii, or what is said of it instead.
fn query<Q: Query>(points: &[f64; 24], radii: [f64; 2]) -> Result<Q, i32> {
    let point = |i: usize| Point::new(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    let (start, end) = ([0, 1, 2, 3].map(point), [4, 5, 6, 7].map(point));
    Q::new(start, end, Radius::from(radii)).map_err(|error| match error {
        QueryError::NotFinite { .. } => NOT_FINITE,
        QueryError::Radius(_) => RADIUS,
    })
}

fn decide<Q: Query>(
    points: &[f64; 24],
    radii: [f64; 2],
    out: Option<&mut MaybeUninit<Q::Hit>>,
) -> i32 {
    match query::<Q>(points, radii).map(|query| query.decide()) {
        Err(refused) => refused,
        Ok(None) => MISS,
        Ok(Some(hit)) => {
            if let Some(out) = out {
                out.write(hit);
            }
            HIT
        }
    }
}

/// How many queries are decided together; so much memory is taken at a time.
const SHARE: usize = 4096;

fn decide_all<Q: Query>(
    points: &[[f64; 24]],
    radii: Option<&[[f64; 2]]>,
    verdicts: &mut [MaybeUninit<i32>],
    mut hits: Option<&mut [MaybeUninit<Q::Hit>]>,
) -> i64 {
    let mut count = 0;
    for (share, (points, verdicts)) in points
        .chunks(SHARE)
        .zip(verdicts.chunks_mut(SHARE))
        .enumerate()
    {
        let first = share * SHARE;
        let (mut queries, mut places) = (Vec::new(), Vec::new());
        for (i, (points, verdict)) in points.iter().zip(verdicts.iter_mut()).enumerate() {
            let radii = radii.map_or([0.0; 2], |radii| radii[first + i]);
            match query::<Q>(points, radii) {
                Ok(query) => {
                    verdict.write(MISS);
                    queries.push(query);
                    places.push(i);
                }
                Err(refused) => {
                    verdict.write(refused);
                }
            }
        }
        Q::decide_all(&queries, |index, hit| {
            let place = places[index];
            verdicts[place].write(HIT);
            if let Some(hits) = &mut hits {
                hits[first + place].write(hit);
            }
            count += 1;
        });
    }
    count
}

/// Reads the arguments of a single query.
///
/// # Safety
///
/// Each pointer is null or points to what the header says.
unsafe fn decide_at<Q: Query>(points: *const f64, radii: *const f64, hit: *mut Q::Hit) -> i32 {
    // SAFETY: not null, it points to 24 numbers, of which nobody changes one during the call.
    let Some(points) = (unsafe { points.cast::<[f64; 24]>().as_ref() }) else {
        return NULL;
    };
    // SAFETY: not null, it points to two numbers, of which nobody changes one during the call.
    let radii = unsafe { radii.cast::<[f64; 2]>().as_ref() };
    // SAFETY: not null, it points to memory for a hit that nobody else uses during the call.
    let hit = unsafe { hit.cast::<MaybeUninit<Q::Hit>>().as_mut() };
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
    hits: *mut Q::Hit,
) -> i64 {
    if count == 0 {
        return 0;
    }
    if points.is_null() || verdicts.is_null() {
        return NULL.into();
    }
    // SAFETY: it is not null and points to `count` times 24 numbers, of which nobody changes one during the call.
    let points = unsafe { slice::from_raw_parts(points.cast::<[f64; 24]>(), count) };
    // SAFETY: as above, with two numbers each.
    let radii = (!radii.is_null())
        .then(|| unsafe { slice::from_raw_parts(radii.cast::<[f64; 2]>(), count) });
    // SAFETY: it is not null and points to memory for `count` integers that nobody else uses during the call.
    let verdicts = unsafe { slice::from_raw_parts_mut(verdicts.cast::<MaybeUninit<i32>>(), count) };
    let hits = hits.cast::<MaybeUninit<Q::Hit>>();
    // SAFETY: as above, with `count` hits.
    let hits = (!hits.is_null()).then(|| unsafe { slice::from_raw_parts_mut(hits, count) });
    decide_all::<Q>(points, radii, verdicts, hits)
}

/// `tunnelproof_edge_edge`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_edge_edge(
    points: *const f64,
    radii: *const f64,
    hit: *mut EdgeHit,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    unsafe { decide_at::<EdgeEdge>(points, radii, hit) }
}

/// `tunnelproof_vertex_face`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_vertex_face(
    points: *const f64,
    radii: *const f64,
    hit: *mut FaceHit,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    unsafe { decide_at::<VertexFace>(points, radii, hit) }
}

/// `tunnelproof_edge_edge_batch`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_edge_edge_batch(
    points: *const f64,
    radii: *const f64,
    count: usize,
    verdicts: *mut i32,
    hits: *mut EdgeHit,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    unsafe { decide_all_at::<EdgeEdge>(points, radii, count, verdicts, hits) }
}

/// `tunnelproof_vertex_face_batch`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_vertex_face_batch(
    points: *const f64,
    radii: *const f64,
    count: usize,
    verdicts: *mut i32,
    hits: *mut FaceHit,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    unsafe { decide_all_at::<VertexFace>(points, radii, count, verdicts, hits) }
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

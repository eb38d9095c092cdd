//! Pairs by the indices of their points.

use std::ffi::CStr;

use tunnelproof::{
    Clearance, Coordinate, EdgeEdge, ListedPair as EngineListedPair, Pairs as EnginePairs,
    PairsError, QueryKind, Radius, VertexFace, advance_pairs,
};
use tunnelproof_float_env::with_default;

use crate::advance::clearance;
use crate::arrays::{Error, answered, read, write};
use crate::step::Step;
use crate::{CLEARANCE, COUNT, Hit, INDEX, LENGTH, NOT_FINITE, POSITIONS, Query, RADIUS};

/// `tunnelproof_pairs`, and for positions in `f32` `tunnelproof_pairs_f32`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Pairs<C> {
    start: *const C,
    end: *const C,
    point_count: usize,
    indices: *const u32,
    pair_count: usize,
    radii: *const f64,
    radius_count: usize,
}

/// `tunnelproof_pair_hit`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct PairHit {
    pair: usize,
    hit: Hit,
}

/// `tunnelproof_listed_pair`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct ListedPair {
    kind: i32,
    index: usize,
}

impl From<EngineListedPair> for ListedPair {
    fn from(EngineListedPair { kind, index }: EngineListedPair) -> Self {
        let kind = match kind {
            QueryKind::EdgeEdge => 1,
            QueryKind::VertexFace => 2,
        };
        ListedPair { kind, index }
    }
}

/// What a list and its arrays are called where they are refused.
struct Names {
    list: &'static CStr,
    start: &'static CStr,
    end: &'static CStr,
    indices: &'static CStr,
    radii: &'static CStr,
}

const PAIRS: Names = Names {
    list: c"pairs",
    start: c"start",
    end: c"end",
    indices: c"indices",
    radii: c"radii",
};

const EDGES: Names = Names {
    list: c"edges",
    start: c"edges.start",
    end: c"edges.end",
    indices: c"edges.indices",
    radii: c"edges.radii",
};

const FACES: Names = Names {
    list: c"faces",
    start: c"faces.start",
    end: c"faces.end",
    indices: c"faces.indices",
    radii: c"faces.radii",
};

impl Names {
    fn of(&self, array: &str) -> &'static CStr {
        match array {
            "start" => self.start,
            "end" => self.end,
            "radii" => self.radii,
            _ => self.indices,
        }
    }

    fn error(&self, error: PairsError) -> Error {
        let (code, array, index, corner, value) = match error {
            PairsError::Length {
                array,
                found,
                expected,
            } => (LENGTH, self.of(array), expected, 0, found as f64),
            PairsError::NotFinite {
                array,
                point,
                axis,
                value,
            } => (NOT_FINITE, self.of(array), point, axis, value),
            PairsError::Index {
                pair,
                corner,
                index,
                ..
            } => (INDEX, self.indices, pair, corner, index.into()),
            PairsError::Radius { pair, radius } => {
                let [first, second] = radius.parts();
                let is_first = !(first >= 0.0 && first.is_finite());
                let (corner, value) = if is_first { (0, first) } else { (1, second) };
                (RADIUS, self.radii, pair.unwrap_or(0), corner, value)
            }
            PairsError::Positions => (POSITIONS, self.list, 0, 0, 0.0),
            PairsError::Clearance(_) => (CLEARANCE, c"clearance", 0, 0, 0.0),
            // What the engine may come to refuse.
            _ => (COUNT, self.indices, 0, 0, 0.0),
        };
        Error {
            index,
            corner,
            value,
            ..Error::new(code, array)
        }
    }
}

/// A list of pairs, read from pointers.
struct List<'a, C> {
    names: &'static Names,
    start: &'a [[C; 3]],
    end: &'a [[C; 3]],
    indices: &'a [[u32; 4]],
    radii: Vec<Radius>,
}

impl<C: Coordinate> List<'_, C> {
    /// # Safety
    ///
    /// Each pointer, also in the pairs, is null or points to what the header says, and nobody
    /// changes that during `'_`.
    unsafe fn read(pairs: *const Pairs<C>, names: &'static Names) -> Result<Self, Error> {
        // SAFETY: not null, it points to pairs that nobody changes.
        let pairs = unsafe { pairs.as_ref() }.ok_or(Error::null(names.list))?;
        let (points, count) = (pairs.point_count, pairs.pair_count);
        // SAFETY: not null, it points to three numbers for each point that nobody changes.
        let start = unsafe { read(pairs.start.cast::<[C; 3]>(), points, names.start) }?;
        // SAFETY: as above.
        let end = unsafe { read(pairs.end.cast::<[C; 3]>(), points, names.end) }?;
        // SAFETY: not null, it points to four indices for each pair that nobody changes.
        let indices = unsafe { read(pairs.indices.cast::<[u32; 4]>(), count, names.indices) }?;
        let (radii, count) = (pairs.radii.cast::<[f64; 2]>(), pairs.radius_count);
        // SAFETY: not null, it points to two numbers for each radius that nobody changes.
        let radii = unsafe { read(radii, count, names.radii) }?;
        Ok(List {
            names,
            start,
            end,
            indices,
            radii: radii.iter().map(|&radius| radius.into()).collect(),
        })
    }

    fn pairs<Q: Query>(&self) -> Result<EnginePairs<'_, Q, C>, Error> {
        let (start, end, indices) = (self.start, self.end, self.indices);
        let pairs = match *self.radii {
            [] => EnginePairs::new(start, end, indices, Radius::ZERO),
            [radius] => EnginePairs::new(start, end, indices, radius),
            _ => EnginePairs::with_radii(start, end, indices, &self.radii),
        };
        pairs.map_err(|error| self.names.error(error))
    }
}

/// The hits, by all threads where the pool of threads is built in.
fn answers<Q: Query, C: Coordinate>(pairs: &EnginePairs<Q, C>) -> Vec<PairHit> {
    #[cfg(feature = "rayon")]
    let hits = pairs.par_decide();
    #[cfg(not(feature = "rayon"))]
    let hits = pairs.decide();
    let whole = |(pair, hit)| {
        // It is the place of one of these pairs.
        let query = pairs.get(pair)?;
        let hit = Hit::new(&query, &hit);
        Some(PairHit { pair, hit })
    };
    hits.into_iter().filter_map(whole).collect()
}

/// Decides pairs, and writes the hits.
///
/// # Safety
///
/// Each pointer, also in the pairs, is null or points to what the header says.
unsafe fn decide<Q: Query, C: Coordinate>(
    pairs: *const Pairs<C>,
    hits: *mut PairHit,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    let list = unsafe { List::read(pairs, &PAIRS) };
    let found = list.and_then(|list| {
        let found = answers(&list.pairs::<Q>()?);
        let count = found.len() as i64;
        // SAFETY: not null, it points to memory for so many hits that nobody else uses.
        unsafe { write(hits, capacity, found.into_iter()) };
        Ok(count)
    });
    // SAFETY: the caller's promise is the same.
    unsafe { answered(found, error) }
}

/// `tunnelproof_decide_edge_edge_pairs`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_edge_edge_pairs(
    pairs: *const Pairs<f64>,
    hits: *mut PairHit,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide::<EdgeEdge, _>(pairs, hits, capacity, error) })
}

/// `tunnelproof_decide_vertex_face_pairs`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_vertex_face_pairs(
    pairs: *const Pairs<f64>,
    hits: *mut PairHit,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide::<VertexFace, _>(pairs, hits, capacity, error) })
}

/// `tunnelproof_decide_edge_edge_pairs_f32`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_edge_edge_pairs_f32(
    pairs: *const Pairs<f32>,
    hits: *mut PairHit,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide::<EdgeEdge, _>(pairs, hits, capacity, error) })
}

/// `tunnelproof_decide_vertex_face_pairs_f32`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_vertex_face_pairs_f32(
    pairs: *const Pairs<f32>,
    hits: *mut PairHit,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide::<VertexFace, _>(pairs, hits, capacity, error) })
}

/// `tunnelproof_advance_pairs`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_advance_pairs(
    edges: *const Pairs<f64>,
    faces: *const Pairs<f64>,
    distance: f64,
    share: f64,
    out: *mut Step<ListedPair, f64>,
    error: *mut Error,
) -> i32 {
    let clearance = || clearance(distance, share);
    // SAFETY: the caller's promise is the same.
    let step = || unsafe { step(edges, faces, clearance(), out) };
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(step(), error) })
}

/// `tunnelproof_advance_pairs_f32`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_advance_pairs_f32(
    edges: *const Pairs<f32>,
    faces: *const Pairs<f32>,
    distance: f64,
    share: f64,
    out: *mut Step<ListedPair, f32>,
    error: *mut Error,
) -> i32 {
    let clearance = || clearance(distance, share);
    // SAFETY: the caller's promise is the same.
    let step = || unsafe { step(edges, faces, clearance(), out) };
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(step(), error) })
}

/// Reads the arguments of a step, and writes what is answered.
///
/// # Safety
///
/// As the header says of the pointers of `tunnelproof_advance_pairs`.
unsafe fn step<C: Coordinate>(
    edges: *const Pairs<C>,
    faces: *const Pairs<C>,
    clearance: Option<Clearance>,
    out: *mut Step<ListedPair, C>,
) -> Result<i32, Error> {
    // SAFETY: not null, it points to a step that nobody else uses, with its buffers set.
    let out = unsafe { out.as_mut() }.ok_or(Error::null(c"step"))?;
    // SAFETY: the caller's promise is the same.
    let edges = unsafe { List::read(edges, &EDGES) }?;
    // SAFETY: as above.
    let faces = unsafe { List::read(faces, &FACES) }?;
    out.check(edges.start.len())?;
    let clearance = clearance.ok_or(Error::new(CLEARANCE, c"clearance"))?;
    let step = advance_pairs(&edges.pairs()?, &faces.pairs()?, clearance);
    let step = step.map_err(|error| FACES.error(error))?;
    let limits = step.limits.iter();
    let limits = limits.map(|limit| (limit.pair.into(), limit.blocked));
    let near = step.near.iter().map(|&(pair, kept)| (pair.into(), kept));
    // SAFETY: the caller's promise is the same.
    unsafe { out.write(step.step, &step.positions, limits, near) };
    Ok(0)
}

//! Pairs by the indices of their points.

use tunnelproof::{EdgeEdge, Pairs as EnginePairs, PairsError, Radius, VertexFace};
use tunnelproof_float_env::with_default;

use crate::arrays::{Error, answered, name, read, write};
use crate::{COUNT, Hit, INDEX, LENGTH, NOT_FINITE, Query, RADIUS};

/// `tunnelproof_pairs`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Pairs {
    start: *const f64,
    end: *const f64,
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

impl From<PairsError> for Error {
    fn from(error: PairsError) -> Self {
        let (code, array, index, corner, value) = match error {
            PairsError::Length {
                array,
                found,
                expected,
            } => (LENGTH, array, expected, 0, found as f64),
            PairsError::NotFinite {
                array,
                point,
                axis,
                value,
            } => (NOT_FINITE, array, point, axis, value),
            PairsError::Index {
                pair,
                corner,
                index,
                ..
            } => (INDEX, "indices", pair, corner, index.into()),
            PairsError::Radius { pair, radius } => {
                let [first, second] = radius.parts();
                let is_first = !(first >= 0.0 && first.is_finite());
                let (corner, value) = if is_first { (0, first) } else { (1, second) };
                (RADIUS, "radii", pair.unwrap_or(0), corner, value)
            }
            // What the engine may come to refuse.
            _ => (COUNT, "indices", 0, 0, 0.0),
        };
        Error {
            index,
            corner,
            value,
            ..Error::new(code, name(array))
        }
    }
}

/// Reads pairs and decides them.
///
/// # Safety
///
/// Each pointer, also in the pairs, is null or points to what the header says, and nobody changes
/// that during the call.
unsafe fn decided<Q: Query>(pairs: *const Pairs) -> Result<Vec<PairHit>, Error> {
    // SAFETY: not null, it points to pairs that nobody changes.
    let pairs = unsafe { pairs.as_ref() }.ok_or(Error::null(c"pairs"))?;
    let (points, count) = (pairs.point_count, pairs.pair_count);
    // SAFETY: not null, it points to three numbers for each point that nobody changes.
    let start = unsafe { read(pairs.start.cast::<[f64; 3]>(), points, c"start") }?;
    // SAFETY: as above.
    let end = unsafe { read(pairs.end.cast::<[f64; 3]>(), points, c"end") }?;
    // SAFETY: not null, it points to four indices for each pair that nobody changes.
    let indices = unsafe { read(pairs.indices.cast::<[u32; 4]>(), count, c"indices") }?;
    // SAFETY: not null, it points to two numbers for each radius that nobody changes.
    let radii = unsafe { read(pairs.radii.cast::<[f64; 2]>(), pairs.radius_count, c"radii") }?;
    let same = |radius: Radius| EnginePairs::<Q>::new(start, end, indices, radius);
    Ok(match *radii {
        [] => answers(&same(Radius::ZERO)?),
        [radius] => answers(&same(radius.into())?),
        _ => {
            let radii: Vec<_> = radii.iter().map(|&radius| radius.into()).collect();
            answers(&EnginePairs::<Q>::with_radii(start, end, indices, &radii)?)
        }
    })
}

/// The hits, by all threads where the pool of threads is built in.
fn answers<Q: Query>(pairs: &EnginePairs<Q>) -> Vec<PairHit> {
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
unsafe fn decide<Q: Query>(
    pairs: *const Pairs,
    hits: *mut PairHit,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    let found = unsafe { decided::<Q>(pairs) }.map(|found| {
        let count = found.len() as i64;
        // SAFETY: not null, it points to memory for so many hits that nobody else uses.
        unsafe { write(hits, capacity, found.into_iter()) };
        count
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
    pairs: *const Pairs,
    hits: *mut PairHit,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide::<EdgeEdge>(pairs, hits, capacity, error) })
}

/// `tunnelproof_decide_vertex_face_pairs`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_decide_vertex_face_pairs(
    pairs: *const Pairs,
    hits: *mut PairHit,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { decide::<VertexFace>(pairs, hits, capacity, error) })
}

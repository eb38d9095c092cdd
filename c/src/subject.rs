//! The certified path as a subject of the judge: the functions of `tunnelproof_subject.h` under
//! other names, so that a library that defines those can be linked with this one.

use tunnelproof::{EdgeEdge, VertexFace};
use tunnelproof_float_env::with_default;

use crate::{HIT, Hit, MISS, Query, decide_at};

/// What the header of subjects says of queries that are not taken.
const UNSUPPORTED: i32 = 2;

/// Decides a query and writes its time of impact.
///
/// # Safety
///
/// As the header of subjects says of the pointers.
unsafe fn answer<Q: Query>(points: *const f64, radius: *const f64, toi: *mut f64) -> i32 {
    let mut hit = std::mem::MaybeUninit::<Hit>::uninit();
    // SAFETY: the caller's promise is the same, and the hit is a place of our own.
    match unsafe { decide_at::<Q>(points, radius, hit.as_mut_ptr()) } {
        MISS => MISS,
        HIT => {
            // SAFETY: after a hit it is written; not null, `toi` points to a number of the caller's.
            if let (hit, Some(toi)) = unsafe { (hit.assume_init(), toi.as_mut()) } {
                *toi = hit.toi;
            }
            HIT
        }
        _ => UNSUPPORTED,
    }
}

/// `tunnelproof_edge_edge` of `tunnelproof_subject.h`.
///
/// # Safety
///
/// As that header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_certified_edge_edge(
    points: *const f64,
    radius: *const f64,
    toi: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answer::<EdgeEdge>(points, radius, toi) })
}

/// `tunnelproof_vertex_face` of `tunnelproof_subject.h`.
///
/// # Safety
///
/// As that header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_certified_vertex_face(
    points: *const f64,
    radius: *const f64,
    toi: *mut f64,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answer::<VertexFace>(points, radius, toi) })
}

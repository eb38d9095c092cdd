//! The certified step of a pair.

use std::mem::MaybeUninit;

use tunnelproof::{
    Advance as EngineAdvance, Blocked, Clearance, EdgeEdge, Precision, VertexFace, advance_in,
};
use tunnelproof_float_env::with_default;

use crate::{CLEARANCE, NULL, Query, query};

/// `tunnelproof_advance`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Advance {
    step: f64,
    points: [[f64; 3]; 4],
    kept: [f64; 2],
    is_proved: i32,
    blocked: i32,
}

impl From<EngineAdvance> for Advance {
    fn from(advance: EngineAdvance) -> Self {
        Advance {
            step: advance.step,
            points: advance.points.map(Into::into),
            kept: advance.kept.map_or([0.0; 2], |kept| kept.parts()),
            is_proved: advance.kept.is_some().into(),
            blocked: advance.blocked.map_or(0, blocked),
        }
    }
}

/// A value of `tunnelproof_blocked`.
pub(crate) fn blocked(blocked: Blocked) -> i32 {
    match blocked {
        Blocked::Ahead => 1,
        Blocked::Rounding => 2,
        Blocked::Touching => 3,
        // The engine may come to know others.
        _ => 4,
    }
}

/// The clearance of a distance and a share, one of which is 0.
pub(crate) fn clearance(distance: f64, share: f64) -> Option<Clearance> {
    match (distance == 0.0, share == 0.0) {
        (true, true) => Some(Clearance::None),
        (false, true) => Some(Clearance::Distance(distance)),
        (true, false) => Some(Clearance::Share(share)),
        (false, false) => None,
    }
}

fn advance<Q: Query>(
    points: &[f64; 24],
    radii: [f64; 2],
    clearance: Option<Clearance>,
    precision: Precision,
) -> Result<Advance, i32> {
    let query = query::<Q>(points, radii)?;
    let clearance = clearance.ok_or(CLEARANCE)?;
    match advance_in(&query, clearance, precision) {
        Ok(advance) => Ok(advance.into()),
        Err(_) => Err(CLEARANCE),
    }
}

/// Reads the arguments of a query, and writes the answer.
///
/// # Safety
///
/// Each pointer is null or points to what the header says.
unsafe fn advance_at<Q: Query>(
    points: *const f64,
    radii: *const f64,
    [distance, share]: [f64; 2],
    precision: Precision,
    out: *mut Advance,
) -> i32 {
    // SAFETY: not null, it points to 24 numbers, of which nobody changes one during the call.
    let points = unsafe { points.cast::<[f64; 24]>().as_ref() };
    // SAFETY: not null, it points to two numbers, of which nobody changes one during the call.
    let radii = unsafe { radii.cast::<[f64; 2]>().as_ref() };
    // SAFETY: not null, it points to memory for the answer that nobody else uses during the call.
    let out = unsafe { out.cast::<MaybeUninit<Advance>>().as_mut() };
    let (Some(points), Some(out)) = (points, out) else {
        return NULL;
    };
    let radii = radii.copied().unwrap_or_default();
    let advance = || advance::<Q>(points, radii, clearance(distance, share), precision);
    match with_default(advance) {
        Ok(advance) => out.write(advance).blocked,
        Err(refused) => refused,
    }
}

/// `tunnelproof_advance_edge_edge`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_advance_edge_edge(
    points: *const f64,
    radii: *const f64,
    distance: f64,
    share: f64,
    advance: *mut Advance,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    unsafe { advance_at::<EdgeEdge>(points, radii, [distance, share], Precision::F64, advance) }
}

/// `tunnelproof_advance_vertex_face`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_advance_vertex_face(
    points: *const f64,
    radii: *const f64,
    distance: f64,
    share: f64,
    advance: *mut Advance,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    unsafe { advance_at::<VertexFace>(points, radii, [distance, share], Precision::F64, advance) }
}

/// `tunnelproof_advance_edge_edge_f32`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_advance_edge_edge_f32(
    points: *const f64,
    radii: *const f64,
    distance: f64,
    share: f64,
    advance: *mut Advance,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    unsafe { advance_at::<EdgeEdge>(points, radii, [distance, share], Precision::F32, advance) }
}

/// `tunnelproof_advance_vertex_face_f32`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_advance_vertex_face_f32(
    points: *const f64,
    radii: *const f64,
    distance: f64,
    share: f64,
    advance: *mut Advance,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    unsafe { advance_at::<VertexFace>(points, radii, [distance, share], Precision::F32, advance) }
}

//! Bodies that turn.

use std::mem::MaybeUninit;
use std::{ptr, slice};

use tunnelproof::nalgebra::Quaternion;
use tunnelproof::rigid::{Lengths, Pose, RigidError, RigidQuery, RigidQueryKind};
use tunnelproof::{Point, Radius, decide_rigid};
use tunnelproof_float_env::with_default;

use crate::{
    ContactPoint, HIT, Hit, MISS, NO_ORIENTATION, NOT_FINITE, NULL, RADIUS, TURNS_TOO_FAR,
};

/// How many numbers a query has for points in space, for points of bodies and for poses.
fn numbers(kind: RigidQueryKind) -> [usize; 3] {
    let Lengths {
        points,
        local,
        poses,
    } = kind.lengths();
    [3 * points, 3 * local, 7 * poses]
}

/// The numbers of queries that follow one another.
struct Numbers<'a> {
    kind: RigidQueryKind,
    points: &'a [f64],
    local: &'a [f64],
    poses: &'a [f64],
    radii: Option<&'a [[f64; 2]]>,
}

impl Numbers<'_> {
    /// A query, or the verdict that refuses it.
    fn query(&self, index: usize) -> Result<RigidQuery, i32> {
        let [of_points, of_local, of_poses] = numbers(self.kind);
        let points = rows(&self.points[of_points * index..][..of_points], point);
        let local = rows(&self.local[of_local * index..][..of_local], point);
        let poses = rows(&self.poses[of_poses * index..][..of_poses], pose);
        let radius = Radius::from(self.radii.map_or([0.0; 2], |radii| radii[index]));
        let query = RigidQuery::from_lists(self.kind, &points, &local, &poses, radius);
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
        let points = (contact(first), second.map(contact));
        out.write(Hit::at(&hit, points, hit.normal(query)));
    }
    HIT
}

/// Reads the arguments of queries.
///
/// # Safety
///
/// Each pointer is null or points to what the header says, `count` times.
unsafe fn decide_all_at(
    kind: RigidQueryKind,
    [points, local, poses, radii]: [*const f64; 4],
    count: usize,
    verdicts: *mut i32,
    hits: *mut Hit,
) -> i64 {
    if count == 0 {
        return 0;
    }
    let [of_points, of_local, of_poses] = numbers(kind);
    let lacks_points = points.is_null() && of_points > 0;
    if lacks_points || local.is_null() || poses.is_null() || verdicts.is_null() {
        return NULL.into();
    }
    // SAFETY: none of them is null, each points to so many numbers, of which nobody changes one
    // during the call. So do the radii, if they are not null, and the points, if there are any.
    let numbers = unsafe {
        Numbers {
            kind,
            points: match of_points {
                0 => &[],
                _ => slice::from_raw_parts(points, of_points * count),
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
unsafe fn decide_at(kind: RigidQueryKind, numbers: [*const f64; 4], hit: *mut Hit) -> i32 {
    let mut verdict = NULL;
    // SAFETY: the caller's promise is the same; there is one verdict, which is ours.
    unsafe { decide_all_at(kind, numbers, 1, &mut verdict, hit) };
    verdict
}

/// The functions of a kind whose first side has these points in space, if it has any.
macro_rules! functions {
    ($kind:ident($($points:ident)?), $one:ident, $batch:ident) => {
        /// As the header says.
        ///
        /// # Safety
        ///
        /// As the header says of its pointers.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $one(
            $($points: *const f64,)?
            local: *const f64,
            poses: *const f64,
            radii: *const f64,
            hit: *mut Hit,
        ) -> i32 {
            let points = [$($points,)? ptr::null()][0];
            let numbers = [points, local, poses, radii];
            // SAFETY: the caller's promise is the same.
            with_default(|| unsafe { decide_at(RigidQueryKind::$kind, numbers, hit) })
        }

        /// As the header says.
        ///
        /// # Safety
        ///
        /// As the header says of its pointers.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $batch(
            $($points: *const f64,)?
            local: *const f64,
            poses: *const f64,
            radii: *const f64,
            count: usize,
            verdicts: *mut i32,
            hits: *mut Hit,
        ) -> i64 {
            let points = [$($points,)? ptr::null()][0];
            let numbers = [points, local, poses, radii];
            // SAFETY: the caller's promise is the same.
            with_default(|| unsafe {
                decide_all_at(RigidQueryKind::$kind, numbers, count, verdicts, hits)
            })
        }
    };
}

functions!(
    EdgeTurningEdge(points),
    tunnelproof_decide_edge_turning_edge,
    tunnelproof_decide_edge_turning_edge_batch
);
functions!(
    VertexTurningFace(points),
    tunnelproof_decide_vertex_turning_face,
    tunnelproof_decide_vertex_turning_face_batch
);
functions!(
    TurningEdgeTurningEdge(),
    tunnelproof_decide_turning_edge_turning_edge,
    tunnelproof_decide_turning_edge_turning_edge_batch
);
functions!(
    TurningVertexTurningFace(),
    tunnelproof_decide_turning_vertex_turning_face,
    tunnelproof_decide_turning_vertex_turning_face_batch
);

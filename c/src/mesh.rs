//! Whole meshes.

use std::ptr;

use tunnelproof::mesh::{Feature, MeshError, Pair as EnginePair};
use tunnelproof_float_env::with_default;

use crate::arrays::{Error, answered, name, read, write};
use crate::{CLEARANCE, COUNT, INDEX, LENGTH, NOT_FINITE, NULL, RADIUS};

/// `tunnelproof_mesh`.
#[derive(Debug)]
pub struct Mesh(pub(crate) tunnelproof::Mesh);

impl From<MeshError> for Error {
    fn from(error: MeshError) -> Self {
        let (code, array, index, corner, value) = match error {
            MeshError::Index {
                array,
                index,
                corner,
                value,
                ..
            } => (INDEX, array, index, corner, value.into()),
            MeshError::Count { array, found } => (COUNT, array, 0, 0, found as f64),
            MeshError::Length {
                array,
                found,
                expected,
            } => (LENGTH, array, expected, 0, found as f64),
            MeshError::NotFinite {
                array,
                vertex,
                axis,
                value,
            } => (NOT_FINITE, array, vertex, axis, value),
            MeshError::Group { value, .. } => (INDEX, "groups", 0, 0, value.into()),
            MeshError::Thickness { group, value } => {
                (RADIUS, "thickness", group.unwrap_or(0), 0, value)
            }
            // And what the engine may come to refuse.
            _ => (CLEARANCE, "clearance", 0, 0, 0.0),
        };
        Error {
            index,
            corner,
            value,
            ..Error::new(code, name(array))
        }
    }
}

/// `tunnelproof_pair`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    first_feature: i32,
    first: u32,
    second_feature: i32,
    second: u32,
    vertices: [u32; 4],
}

impl Pair {
    pub(crate) fn new(mesh: &Mesh, pair: EnginePair) -> Self {
        let (first_feature, first) = feature(pair.first);
        let (second_feature, second) = feature(pair.second);
        Pair {
            first_feature,
            first,
            second_feature,
            second,
            // It is a pair of this mesh.
            vertices: mesh.0.vertices_of(pair).unwrap_or_default(),
        }
    }
}

/// A value of `tunnelproof_feature`, and the index.
fn feature(feature: Feature) -> (i32, u32) {
    match feature {
        Feature::Vertex(index) => (1, index),
        Feature::Edge(index) => (2, index),
        Feature::Face(index) => (3, index),
    }
}

/// `tunnelproof_mesh_new`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_new(
    vertex_count: usize,
    edges: *const u32,
    edge_count: usize,
    faces: *const u32,
    face_count: usize,
    error: *mut Error,
) -> *mut Mesh {
    with_default(|| {
        // SAFETY: not null, it points to two indices for each edge that nobody changes.
        let edges = unsafe { read(edges.cast::<[u32; 2]>(), edge_count, c"edges") };
        // SAFETY: not null, it points to three indices for each face that nobody changes.
        let faces = unsafe { read(faces.cast::<[u32; 3]>(), face_count, c"faces") };
        let mesh = edges.and_then(|edges| Ok(tunnelproof::Mesh::new(vertex_count, edges, faces?)?));
        match mesh {
            Ok(mesh) => Box::into_raw(Box::new(Mesh(mesh))),
            Err(refused) => {
                // SAFETY: it is the header's promise, and the capacity is 1.
                unsafe { write(error, 1, [refused].into_iter()) };
                ptr::null_mut()
            }
        }
    })
}

/// `tunnelproof_mesh_free`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_free(mesh: *mut Mesh) {
    if !mesh.is_null() {
        // SAFETY: it is of `Box::into_raw` in `tunnelproof_mesh_new`, and not freed before.
        drop(unsafe { Box::from_raw(mesh) });
    }
}

/// Changes a mesh.
///
/// # Safety
///
/// Each pointer is null or points to what the header says.
unsafe fn change(
    mesh: *mut Mesh,
    error: *mut Error,
    change: impl FnOnce(&mut tunnelproof::Mesh) -> Result<(), Error>,
) -> i32 {
    // SAFETY: not null, it is of `tunnelproof_mesh_new`, not freed, and nobody else uses it.
    let mesh = unsafe { mesh.as_mut() }.ok_or(Error::null(c"mesh"));
    let changed = mesh.and_then(|mesh| change(&mut mesh.0)).map(|()| 0);
    // SAFETY: the caller's promise is the same.
    unsafe { answered(changed, error) }
}

/// `tunnelproof_mesh_set_groups`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_set_groups(
    mesh: *mut Mesh,
    groups: *const u32,
    error: *mut Error,
) -> i32 {
    with_default(|| {
        let set = |mesh: &mut tunnelproof::Mesh| {
            // SAFETY: not null, it points to a number for each vertex that nobody changes.
            let groups = unsafe { read(groups, mesh.vertex_count(), c"groups") }?;
            Ok(mesh.set_groups(groups)?)
        };
        // SAFETY: the caller's promise is the same.
        unsafe { change(mesh, error, set) }
    })
}

/// `tunnelproof_mesh_leave_out`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_leave_out(
    mesh: *mut Mesh,
    first: u32,
    second: u32,
    error: *mut Error,
) -> i32 {
    with_default(|| {
        // SAFETY: the caller's promise is the same.
        unsafe { change(mesh, error, |mesh| Ok(mesh.leave_out(first, second)?)) }
    })
}

/// `tunnelproof_mesh_edges`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_edges(
    mesh: *const Mesh,
    edges: *mut u32,
    capacity: usize,
) -> i64 {
    // SAFETY: not null, it is of `tunnelproof_mesh_new` and not freed; nobody changes it.
    let Some(mesh) = (unsafe { mesh.as_ref() }) else {
        return NULL.into();
    };
    let all = mesh.0.edges();
    // SAFETY: not null, it points to memory for so many edges that nobody else uses.
    unsafe { write(edges.cast::<[u32; 2]>(), capacity, all.iter().copied()) };
    all.len() as i64
}

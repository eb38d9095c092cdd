//! Whole meshes.

use std::mem::{MaybeUninit, offset_of};
use std::ptr;

use tunnelproof::mesh::{Feature, MeshContact, MeshError, Pair as EnginePair, Thickness};
use tunnelproof::{Clearance, Precision};
use tunnelproof_float_env::with_default;

use crate::advance::clearance;
use crate::arrays::{Error, answered, name, read, write};
use crate::step::Step;
use crate::{
    CLEARANCE, COUNT, ContactPoint, HIT, INDEX, LENGTH, MISS, NOT_FINITE, NULL, RADIUS, kind,
};

/// `tunnelproof_mesh`.
#[derive(Debug)]
pub struct Mesh(tunnelproof::Mesh);

/// `tunnelproof_motion`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    start: *const f64,
    end: *const f64,
    thickness: *const f64,
    thickness_count: usize,
}

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
    fn new(mesh: &Mesh, pair: EnginePair) -> Self {
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

/// `tunnelproof_mesh_contact`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    pair: Pair,
    toi: f64,
    toi_above: f64,
    kind: i32,
    has_second: i32,
    first: ContactPoint,
    second: ContactPoint,
    normal: [f64; 3],
}

impl Contact {
    fn new(mesh: &Mesh, found: &MeshContact) -> Self {
        let contact = &found.contact;
        Contact {
            pair: Pair::new(mesh, found.pair),
            toi: found.toi,
            toi_above: found.toi_above,
            kind: kind(found.kind),
            has_second: contact.second.is_some().into(),
            first: contact.first.into(),
            second: contact.second.unwrap_or(contact.first).into(),
            normal: contact.normal.map_or([0.0; 3], Into::into),
        }
    }
}

/// `tunnelproof_step`.
#[repr(C)]
#[derive(Debug)]
pub struct MeshStep {
    step: Step<Pair>,
    candidates: MaybeUninit<[usize; 2]>,
}

// In the header its fields follow one another: nothing is between those of the two.
const _: () = assert!(offset_of!(MeshStep, candidates) == Step::<Pair>::END);

/// A mesh and a question about it, read from pointers.
struct Question<'a> {
    mesh: &'a Mesh,
    start: &'a [[f64; 3]],
    end: &'a [[f64; 3]],
    thickness: Thickness<'a>,
}

impl<'a> Question<'a> {
    /// # Safety
    ///
    /// Each pointer, also in the motion, is null or points to what the header says, and nobody
    /// changes that during `'a`.
    unsafe fn read(mesh: *const Mesh, motion: *const Motion) -> Result<Self, Error> {
        // SAFETY: not null, it is of `tunnelproof_mesh_new` and not freed; nobody changes it.
        let mesh: &Mesh = unsafe { mesh.as_ref() }.ok_or(Error::null(c"mesh"))?;
        // SAFETY: not null, it points to a motion that nobody changes.
        let motion = unsafe { motion.as_ref() }.ok_or(Error::null(c"motion"))?;
        let count = mesh.0.vertex_count();
        let Motion {
            start,
            end,
            thickness,
            thickness_count,
        } = *motion;
        // SAFETY: not null, it points to three numbers for each vertex that nobody changes.
        let start = unsafe { read(start.cast::<[f64; 3]>(), count, c"start") }?;
        // SAFETY: as above.
        let end = unsafe { read(end.cast::<[f64; 3]>(), count, c"end") }?;
        // SAFETY: not null, it points to so many numbers that nobody changes.
        let thickness = match unsafe { read(thickness, thickness_count, c"thickness") }? {
            [] => Thickness::Uniform(0.0),
            [uniform] => Thickness::Uniform(*uniform),
            of_groups => Thickness::PerGroup(of_groups),
        };
        Ok(Question {
            mesh,
            start,
            end,
            thickness,
        })
    }

    fn first_contact(&self) -> Result<Option<MeshContact>, Error> {
        let mesh = &self.mesh.0;
        Ok(mesh.first_contact(self.start, self.end, self.thickness)?)
    }

    fn all_contacts(&self) -> Result<Vec<MeshContact>, Error> {
        let mesh = &self.mesh.0;
        Ok(mesh.all_contacts(self.start, self.end, self.thickness)?)
    }

    fn is_free(&self) -> Result<bool, Error> {
        let mesh = &self.mesh.0;
        Ok(mesh.is_free(self.start, self.end, self.thickness)?)
    }

    fn step(
        &self,
        clearance: Option<Clearance>,
        precision: Precision,
    ) -> Result<tunnelproof::mesh::MeshStep, Error> {
        let clearance = clearance.ok_or(Error::new(CLEARANCE, c"clearance"))?;
        let mesh = &self.mesh.0;
        Ok(mesh.step_in(self.start, self.end, self.thickness, clearance, precision)?)
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

/// `tunnelproof_mesh_first_contact`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_first_contact(
    mesh: *const Mesh,
    motion: *const Motion,
    contact: *mut Contact,
    error: *mut Error,
) -> i32 {
    with_default(|| {
        // SAFETY: the caller's promise is the same.
        let question = unsafe { Question::read(mesh, motion) };
        let found = question.and_then(|question| {
            let first = question.first_contact()?;
            let first = first.map(|found| Contact::new(question.mesh, &found));
            let verdict = if first.is_some() { HIT } else { MISS };
            // SAFETY: not null, it points to memory for a contact that nobody else uses.
            unsafe { write(contact, 1, first.into_iter()) };
            Ok(verdict)
        });
        // SAFETY: the caller's promise is the same.
        unsafe { answered(found, error) }
    })
}

/// `tunnelproof_mesh_all_contacts`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_all_contacts(
    mesh: *const Mesh,
    motion: *const Motion,
    contacts: *mut Contact,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    with_default(|| {
        // SAFETY: the caller's promise is the same.
        let question = unsafe { Question::read(mesh, motion) };
        let found = question.and_then(|question| {
            let all = question.all_contacts()?;
            let shown = all.iter().map(|found| Contact::new(question.mesh, found));
            // SAFETY: not null, it points to memory for so many contacts that nobody else uses.
            unsafe { write(contacts, capacity, shown) };
            Ok(all.len() as i64)
        });
        // SAFETY: the caller's promise is the same.
        unsafe { answered(found, error) }
    })
}

/// `tunnelproof_mesh_is_free`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_is_free(
    mesh: *const Mesh,
    motion: *const Motion,
    error: *mut Error,
) -> i32 {
    with_default(|| {
        // SAFETY: the caller's promise is the same.
        let question = unsafe { Question::read(mesh, motion) };
        let is_free = question.and_then(|question| question.is_free());
        // SAFETY: the caller's promise is the same.
        unsafe { answered(is_free.map(i32::from), error) }
    })
}

/// `tunnelproof_mesh_step`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_step(
    mesh: *const Mesh,
    motion: *const Motion,
    distance: f64,
    share: f64,
    out: *mut MeshStep,
    error: *mut Error,
) -> i32 {
    let clearance = || clearance(distance, share);
    // SAFETY: the caller's promise is the same.
    let step = || unsafe { step(mesh, motion, clearance(), Precision::F64, out) };
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(step(), error) })
}

/// `tunnelproof_mesh_step_f32`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_step_f32(
    mesh: *const Mesh,
    motion: *const Motion,
    distance: f64,
    share: f64,
    out: *mut MeshStep,
    error: *mut Error,
) -> i32 {
    let clearance = || clearance(distance, share);
    // SAFETY: the caller's promise is the same.
    let step = || unsafe { step(mesh, motion, clearance(), Precision::F32, out) };
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(step(), error) })
}

/// Reads the arguments of a step, and writes what is answered.
///
/// # Safety
///
/// As the header says of the pointers of `tunnelproof_mesh_step`.
unsafe fn step(
    mesh: *const Mesh,
    motion: *const Motion,
    clearance: Option<Clearance>,
    precision: Precision,
    out: *mut MeshStep,
) -> Result<i32, Error> {
    // SAFETY: not null, it points to a step that nobody else uses, with its buffers set.
    let out = unsafe { out.as_mut() }.ok_or(Error::null(c"step"))?;
    // SAFETY: the caller's promise is the same.
    let question = unsafe { Question::read(mesh, motion) }?;
    let mesh = question.mesh;
    out.step.check(mesh.0.vertex_count())?;
    let step = question.step(clearance, precision)?;
    out.candidates.write(step.candidates);
    let limits = step.limits.iter();
    let limits = limits.map(|limit| (Pair::new(mesh, limit.pair), limit.blocked));
    let near = step.near.iter();
    let near = near.map(|&(pair, kept)| (Pair::new(mesh, pair), kept));
    // SAFETY: the caller's promise is the same.
    unsafe { out.step.write(step.step, &step.positions, limits, near) };
    Ok(0)
}

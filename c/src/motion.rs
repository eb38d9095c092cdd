//! Whole meshes in motion: contacts and steps, of positions in `f64` or in `f32`.

use std::mem::{MaybeUninit, offset_of};

use tunnelproof::mesh::{MeshContact, Thickness};
use tunnelproof::{Clearance, Coordinate};
use tunnelproof_float_env::with_default;

use crate::advance::clearance;
use crate::arrays::{Error, answered, read, write};
use crate::mesh::{Mesh, Pair};
use crate::step::Step;
use crate::{CLEARANCE, ContactPoint, HIT, MISS, kind};

/// `tunnelproof_motion`, and for positions in `f32` `tunnelproof_motion_f32`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Motion<C> {
    start: *const C,
    end: *const C,
    thickness: *const f64,
    thickness_count: usize,
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

/// `tunnelproof_step`, and for positions in `f32` `tunnelproof_step_f32`.
#[repr(C)]
#[derive(Debug)]
pub struct MeshStep<C> {
    step: Step<Pair, C>,
    candidates: MaybeUninit<[usize; 2]>,
}

// In the header its fields follow one another: nothing is between those of the two.
const _: () = assert!(offset_of!(MeshStep<f64>, candidates) == Step::<Pair, f64>::END);
const _: () = assert!(offset_of!(MeshStep<f32>, candidates) == Step::<Pair, f32>::END);

/// A mesh and a question about it, read from pointers.
struct Question<'a, C> {
    mesh: &'a Mesh,
    start: &'a [[C; 3]],
    end: &'a [[C; 3]],
    thickness: Thickness<'a>,
}

impl<'a, C: Coordinate> Question<'a, C> {
    /// # Safety
    ///
    /// Each pointer, also in the motion, is null or points to what the header says, and nobody
    /// changes that during `'a`.
    unsafe fn read(mesh: *const Mesh, motion: *const Motion<C>) -> Result<Self, Error> {
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
        let start = unsafe { read(start.cast::<[C; 3]>(), count, c"start") }?;
        // SAFETY: as above.
        let end = unsafe { read(end.cast::<[C; 3]>(), count, c"end") }?;
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

    fn step(&self, clearance: Option<Clearance>) -> Result<tunnelproof::mesh::MeshStep<C>, Error> {
        let clearance = clearance.ok_or(Error::new(CLEARANCE, c"clearance"))?;
        let mesh = &self.mesh.0;
        Ok(mesh.step_with_clearance(self.start, self.end, self.thickness, clearance)?)
    }
}

/// Writes the first contact, and says whether there is one.
///
/// # Safety
///
/// As the header says of the pointers of `tunnelproof_mesh_first_contact`.
unsafe fn first_contact<C: Coordinate>(
    mesh: *const Mesh,
    motion: *const Motion<C>,
    contact: *mut Contact,
) -> Result<i32, Error> {
    // SAFETY: the caller's promise is the same.
    let question = unsafe { Question::read(mesh, motion) }?;
    let first = question.first_contact()?;
    let first = first.map(|found| Contact::new(question.mesh, &found));
    let verdict = if first.is_some() { HIT } else { MISS };
    // SAFETY: not null, it points to memory for a contact that nobody else uses.
    unsafe { write(contact, 1, first.into_iter()) };
    Ok(verdict)
}

/// Writes all contacts, and says how many there are.
///
/// # Safety
///
/// As the header says of the pointers of `tunnelproof_mesh_all_contacts`.
unsafe fn all_contacts<C: Coordinate>(
    mesh: *const Mesh,
    motion: *const Motion<C>,
    contacts: *mut Contact,
    capacity: usize,
) -> Result<i64, Error> {
    // SAFETY: the caller's promise is the same.
    let question = unsafe { Question::read(mesh, motion) }?;
    let all = question.all_contacts()?;
    let shown = all.iter().map(|found| Contact::new(question.mesh, found));
    // SAFETY: not null, it points to memory for so many contacts that nobody else uses.
    unsafe { write(contacts, capacity, shown) };
    Ok(all.len() as i64)
}

/// Whether nothing touches.
///
/// # Safety
///
/// As the header says of the pointers of `tunnelproof_mesh_is_free`.
unsafe fn is_free<C: Coordinate>(
    mesh: *const Mesh,
    motion: *const Motion<C>,
) -> Result<i32, Error> {
    // SAFETY: the caller's promise is the same.
    let question = unsafe { Question::read(mesh, motion) }?;
    question.is_free().map(i32::from)
}

/// Reads the arguments of a step, and writes what is answered.
///
/// # Safety
///
/// As the header says of the pointers of `tunnelproof_mesh_step`.
unsafe fn step<C: Coordinate>(
    mesh: *const Mesh,
    motion: *const Motion<C>,
    clearance: Option<Clearance>,
    out: *mut MeshStep<C>,
) -> Result<i32, Error> {
    // SAFETY: not null, it points to a step that nobody else uses, with its buffers set.
    let out = unsafe { out.as_mut() }.ok_or(Error::null(c"step"))?;
    // SAFETY: the caller's promise is the same.
    let question = unsafe { Question::read(mesh, motion) }?;
    let mesh = question.mesh;
    out.step.check(mesh.0.vertex_count())?;
    let step = question.step(clearance)?;
    out.candidates.write(step.candidates);
    let limits = step.limits.iter();
    let limits = limits.map(|limit| (Pair::new(mesh, limit.pair), limit.blocked));
    let near = step.near.iter();
    let near = near.map(|&(pair, kept)| (Pair::new(mesh, pair), kept));
    // SAFETY: the caller's promise is the same.
    unsafe { out.step.write(step.step, &step.positions, limits, near) };
    Ok(0)
}

/// `tunnelproof_mesh_first_contact`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_first_contact(
    mesh: *const Mesh,
    motion: *const Motion<f64>,
    contact: *mut Contact,
    error: *mut Error,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(first_contact(mesh, motion, contact), error) })
}

/// `tunnelproof_mesh_all_contacts`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_all_contacts(
    mesh: *const Mesh,
    motion: *const Motion<f64>,
    contacts: *mut Contact,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(all_contacts(mesh, motion, contacts, capacity), error) })
}

/// `tunnelproof_mesh_is_free`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_is_free(
    mesh: *const Mesh,
    motion: *const Motion<f64>,
    error: *mut Error,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(is_free(mesh, motion), error) })
}

/// `tunnelproof_mesh_step`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_step(
    mesh: *const Mesh,
    motion: *const Motion<f64>,
    distance: f64,
    share: f64,
    out: *mut MeshStep<f64>,
    error: *mut Error,
) -> i32 {
    let clearance = || clearance(distance, share);
    // SAFETY: the caller's promise is the same.
    let step = || unsafe { step(mesh, motion, clearance(), out) };
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(step(), error) })
}

/// `tunnelproof_mesh_first_contact_f32`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_first_contact_f32(
    mesh: *const Mesh,
    motion: *const Motion<f32>,
    contact: *mut Contact,
    error: *mut Error,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(first_contact(mesh, motion, contact), error) })
}

/// `tunnelproof_mesh_all_contacts_f32`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_all_contacts_f32(
    mesh: *const Mesh,
    motion: *const Motion<f32>,
    contacts: *mut Contact,
    capacity: usize,
    error: *mut Error,
) -> i64 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(all_contacts(mesh, motion, contacts, capacity), error) })
}

/// `tunnelproof_mesh_is_free_f32`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_is_free_f32(
    mesh: *const Mesh,
    motion: *const Motion<f32>,
    error: *mut Error,
) -> i32 {
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(is_free(mesh, motion), error) })
}

/// `tunnelproof_mesh_step_f32`.
///
/// # Safety
///
/// As the header says of its pointers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tunnelproof_mesh_step_f32(
    mesh: *const Mesh,
    motion: *const Motion<f32>,
    distance: f64,
    share: f64,
    out: *mut MeshStep<f32>,
    error: *mut Error,
) -> i32 {
    let clearance = || clearance(distance, share);
    // SAFETY: the caller's promise is the same.
    let step = || unsafe { step(mesh, motion, clearance(), out) };
    // SAFETY: the caller's promise is the same.
    with_default(|| unsafe { answered(step(), error) })
}

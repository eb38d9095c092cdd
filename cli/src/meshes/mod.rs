//! Meshes from files, and two of them as a motion.
//!
//! Read are `.ply` (ascii, binary of either byte order), `.obj` and `.stl` (ascii and binary), by
//! their extensions. A coordinate is the `f64` that the file states: the nearest one to a decimal,
//! and the `f32` of a PLY property `float` or an STL. A motion in `f32` has the `f32` nearest to that.
//!
//! - A polygon of more than three corners becomes a fan of triangles around its first corner.
//! - PLY elements `edge` (`vertex1`, `vertex2`) and OBJ lines `l` are edges.
//! - An STL has no shared vertices. Corners that are at the same place at the start, in all three
//!   coordinates, become one vertex; at the end they have to be together still.
//!
//! Everything else in a file (normals, texture coordinates, colours, groups, materials) is passed
//! over.

use std::fs;
use std::io;
use std::path::Path;

use tunnelproof::certified::Precision;
use tunnelproof::mesh::Mesh;
use tunnelproof_reference::corpus;

pub mod audit;
mod compare;
mod error;
mod format;
mod obj;
mod ply;
mod stl;
#[cfg(test)]
mod tests;

pub use error::MeshFileError;
pub use format::{Format, WritableFormat};

use error::Problem;

/// A position in metres.
pub type Position = [f64; 3];

/// What a file says of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parts {
    /// The positions of the vertices.
    pub vertices: Vec<Position>,
    /// The edges that the file names, by their vertices.
    pub edges: Vec<[u32; 2]>,
    /// The triangles, those of a polygon one after the other.
    pub faces: Vec<[u32; 3]>,
}

/// A mesh at the start and at the end of a step.
#[derive(Clone, Debug)]
pub struct Motion {
    /// What the file of the start says, with its positions.
    pub start: Parts,
    /// The positions at the end.
    pub end: Vec<Position>,
    /// The mesh.
    pub mesh: Mesh,
}

impl Motion {
    /// Reads two files of one mesh. Positions are rounded to the precision.
    ///
    /// # Errors
    ///
    /// [`MeshFileError`] if a file cannot be read or is not of the format that its extension says,
    /// if the two differ in more than positions, or if a coordinate is beyond the precision.
    pub fn read(start: &str, end: &str, precision: Precision) -> Result<Self, MeshFileError> {
        let (first, last) = (Format::of_path(start)?, Format::of_path(end)?);
        let refuse = |path: &str, problem| MeshFileError::new(path, problem);
        let [mut parts, mut moved] = match [first, last] {
            [Format::Stl, Format::Stl] => stl::read_both(start, end)?,
            [Format::Stl, _] | [_, Format::Stl] => {
                return Err(refuse(end, Problem::OneStl(start.to_owned())));
            }
            _ => [read(start, first)?, read(end, last)?],
        };
        for (path, parts) in [(start, &mut parts), (end, &mut moved)] {
            check(parts).map_err(|problem| refuse(path, problem))?;
            if precision == Precision::F32 {
                round(parts).map_err(|problem| refuse(path, problem))?;
            }
        }
        compare::same(&parts, &moved).map_err(|difference| {
            let start = start.to_owned();
            refuse(end, Problem::Differs { difference, start })
        })?;
        let mesh = Mesh::new(parts.vertices.len(), &parts.edges, &parts.faces);
        Ok(Motion {
            mesh: mesh.map_err(|error| refuse(start, Problem::Mesh(error)))?,
            start: parts,
            end: moved.vertices,
        })
    }
}

/// Reads a file that is no STL.
fn read(path: &str, format: Format) -> Result<Parts, MeshFileError> {
    let bytes = bytes(path)?;
    match format {
        Format::Ply => ply::read(&bytes),
        _ => obj::read(&bytes),
    }
    .map_err(|problem| MeshFileError::new(path, problem))
}

/// The file as a whole.
fn bytes(path: &str) -> Result<Vec<u8>, MeshFileError> {
    let is_folder = Path::new(path).is_dir();
    let bytes = match is_folder {
        true => Err(io::ErrorKind::IsADirectory.into()),
        false => fs::read(path),
    };
    bytes.map_err(|error| MeshFileError::new(path, Problem::Io(corpus::Problem::Io(error))))
}

/// Refuses files without vertices, and coordinates that are not finite.
fn check(parts: &Parts) -> Result<(), Problem> {
    if parts.vertices.is_empty() {
        return Err(Problem::Empty);
    }
    for (vertex, position) in parts.vertices.iter().enumerate() {
        for (axis, &value) in ["x", "y", "z"].iter().zip(position) {
            if !value.is_finite() {
                return Err(Problem::NotFinite {
                    vertex,
                    axis,
                    value,
                });
            }
        }
    }
    Ok(())
}

/// Rounds the coordinates to `f32`, and refuses what is beyond it.
fn round(parts: &mut Parts) -> Result<(), Problem> {
    for (vertex, position) in parts.vertices.iter_mut().enumerate() {
        for (axis, value) in ["x", "y", "z"].iter().zip(position) {
            let single = *value as f32;
            if !single.is_finite() {
                let value = *value;
                return Err(Problem::BeyondSingle {
                    vertex,
                    axis,
                    value,
                });
            }
            *value = single.into();
        }
    }
    Ok(())
}

impl Parts {
    /// Adds a polygon as a fan of triangles around its first corner.
    fn push_polygon(&mut self, corners: &[u32]) {
        let Some((&first, rest)) = corners.split_first() else {
            return;
        };
        for pair in rest.windows(2) {
            self.faces.push([first, pair[0], pair[1]]);
        }
    }
}

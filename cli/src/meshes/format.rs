//! The formats, by the extensions of files, and files in them.

use std::path::Path;

use tunnelproof::certified::Precision;

use super::error::{MeshFileError, Problem};
use super::{Motion, Position, obj, ply};

/// A format that is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Polygon File Format.
    Ply,
    /// Wavefront.
    Obj,
    /// Stereolithography.
    Stl,
}

/// A format that holds `f64`, so that positions can be written without rounding them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WritableFormat {
    /// Polygon File Format, binary, little-endian, with `double` or `float`.
    Ply,
    /// Wavefront, with the shortest decimals that are read as the same numbers.
    Obj,
}

impl Format {
    /// The format of a file, by its extension.
    ///
    /// # Errors
    ///
    /// [`MeshFileError`] if that is none of the three.
    pub fn of_path(path: &str) -> Result<Self, MeshFileError> {
        let extension = Path::new(path).extension().and_then(|text| text.to_str());
        match extension.map(str::to_ascii_lowercase).as_deref() {
            Some("ply") => Ok(Format::Ply),
            Some("obj") => Ok(Format::Obj),
            Some("stl") => Ok(Format::Stl),
            _ => Err(MeshFileError::new(path, Problem::Extension)),
        }
    }
}

impl WritableFormat {
    /// The format of a file to write, by its extension.
    ///
    /// # Errors
    ///
    /// [`MeshFileError`] if that is none of the three, or of STL, which holds `f32`.
    pub fn of_path(path: &str) -> Result<Self, MeshFileError> {
        match Format::of_path(path)? {
            Format::Ply => Ok(WritableFormat::Ply),
            Format::Obj => Ok(WritableFormat::Obj),
            Format::Stl => Err(MeshFileError::new(path, Problem::RoundedOutput)),
        }
    }

    /// The file of a mesh with other positions, which are numbers of the precision: its triangles, and
    /// the edges that it names.
    pub fn write(self, motion: &Motion, positions: &[Position], precision: Precision) -> Vec<u8> {
        match self {
            WritableFormat::Ply => ply::write(&motion.start, positions, precision),
            WritableFormat::Obj => obj::write(&motion.start, positions).into_bytes(),
        }
    }
}

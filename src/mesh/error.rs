//! Why arrays are not a mesh, or not its positions.

use std::fmt;

use crate::certified::{Clearance, ClearanceError};
use crate::query::{Counted, Short};

/// What is wrong with the arrays of a mesh or of a question about it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MeshError {
    /// An edge or a face has a vertex that does not exist.
    Index {
        /// `edges` or `faces`.
        array: &'static str,
        /// Which one, from 0.
        index: usize,
        /// Which of its vertices, from 0.
        corner: usize,
        /// The vertex that it names.
        value: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// There are more vertices, edges or faces than indices of 32 bits.
    Count {
        /// `vertices`, `edges` or `faces`.
        array: &'static str,
        /// How many.
        found: usize,
    },
    /// An array has another length than it should have.
    Length {
        /// `start`, `end`, `groups` or `thickness`.
        array: &'static str,
        /// Its length.
        found: usize,
        /// The length that it should have: the number of vertices, or of groups.
        expected: usize,
    },
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// `start` or `end`.
        array: &'static str,
        /// Which vertex.
        vertex: usize,
        /// Which coordinate, 0 to 2 for x to z.
        axis: usize,
        /// The value refused.
        value: f64,
    },
    /// A group that no vertex has.
    Group {
        /// The group named.
        value: u32,
        /// How many groups there are.
        groups: usize,
    },
    /// A thickness is NaN, infinite or negative.
    Thickness {
        /// Of which group, if there is one for each.
        group: Option<usize>,
        /// The value refused.
        value: f64,
    },
    /// The clearance has no meaning.
    Clearance(Clearance),
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            MeshError::Index {
                array,
                index,
                corner,
                value,
                vertices,
            } => {
                let of = Counted(vertices, "vertex", "vertices");
                let verb = of.verb();
                write!(
                    f,
                    "{array}[{index}][{corner}] is vertex {value}, and there {verb} {of}"
                )
            }
            MeshError::Count { array, found } => write!(
                f,
                "there are {found} {array}, more than indices of 32 bits can name"
            ),
            MeshError::Length {
                array,
                found,
                expected,
            } => {
                let of = match array {
                    "thickness" => Counted(expected, "group", "groups"),
                    _ => Counted(expected, "vertex", "vertices"),
                };
                let found = Counted(found, "entry", "entries");
                write!(f, "{array} has {found}, and there {} {of}", of.verb())
            }
            MeshError::NotFinite {
                array,
                vertex,
                axis,
                value,
            } => write!(
                f,
                "{array}[{vertex}][{axis}] is {value}, not a finite number"
            ),
            MeshError::Group { value, groups } => {
                write!(
                    f,
                    "there is no group {value}; the largest is {}",
                    groups.saturating_sub(1)
                )
            }
            MeshError::Thickness { group, value } => {
                match group {
                    Some(group) => write!(f, "thickness[{group}]")?,
                    None => f.write_str("the thickness")?,
                }
                let value = Short(value);
                write!(f, " is {value}; it has to be finite, and 0 or more")
            }
            MeshError::Clearance(clearance) => ClearanceError(clearance).fmt(f),
        }
    }
}

impl std::error::Error for MeshError {}

impl From<ClearanceError> for MeshError {
    fn from(ClearanceError(clearance): ClearanceError) -> Self {
        MeshError::Clearance(clearance)
    }
}

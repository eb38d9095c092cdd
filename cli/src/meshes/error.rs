//! What can be wrong with files of meshes, and where.

use std::fmt;

use tunnelproof::mesh::MeshError;
use tunnelproof_reference::corpus;

/// What is wrong with a file of a mesh and where; written as one line, `path:line: what is wrong`.
#[derive(Debug)]
pub struct MeshFileError {
    path: String,
    problem: Problem,
}

/// What is wrong with a file of a mesh.
#[derive(Debug, thiserror::Error)]
pub(super) enum Problem {
    /// The file cannot be opened or read.
    #[error(transparent)]
    Io(corpus::Problem),
    /// The file name has an extension that is not read, or none.
    #[error("is neither a .ply nor an .obj nor a .stl file")]
    Extension,
    /// An STL is asked for as output.
    #[error(
        "an STL holds f32, which would round the positions that are proved; write a .ply or an .obj"
    )]
    RoundedOutput,
    /// A line says what is no mesh.
    #[error("{what}")]
    Line {
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        what: String,
    },
    /// The file is not of its format, in no certain line.
    #[error("{0}")]
    Malformed(String),
    /// There is no vertex in it.
    #[error("holds no vertex")]
    Empty,
    /// A coordinate is NaN or infinite.
    #[error("{axis} of vertex {vertex} is {value}, not a finite number")]
    NotFinite {
        /// Which vertex.
        vertex: usize,
        /// Which coordinate.
        axis: &'static str,
        /// The value refused.
        value: f64,
    },
    /// A coordinate is too large for `f32`.
    #[error("{axis} of vertex {vertex} is {value:e}, which is beyond f32")]
    BeyondSingle {
        /// Which vertex.
        vertex: usize,
        /// Which coordinate.
        axis: &'static str,
        /// The value refused.
        value: f64,
    },
    /// Edges or faces name vertices that do not exist, or there are too many.
    #[error("{0}")]
    Mesh(MeshError),
    /// The two files are not of the same mesh.
    #[error("{difference}; it has to be the mesh of {start}")]
    Differs {
        /// What differs.
        difference: String,
        /// The file of the start.
        start: String,
    },
    /// One of two files is an STL.
    #[error("is of another format than {0}; an STL has no vertices to compare with other formats")]
    OneStl(String),
}

impl MeshFileError {
    pub(super) fn new(path: &str, problem: Problem) -> Self {
        MeshFileError {
            path: path.to_owned(),
            problem,
        }
    }
}

impl Problem {
    pub(super) fn line(line: usize, what: impl Into<String>) -> Self {
        Problem::Line {
            line,
            what: what.into(),
        }
    }
}

impl fmt::Display for MeshFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let MeshFileError { path, problem } = self;
        match problem {
            Problem::Line { line, what } => write!(f, "{path}:{line}: {what}"),
            problem => write!(f, "{path}: {problem}"),
        }
    }
}

impl std::error::Error for MeshFileError {}

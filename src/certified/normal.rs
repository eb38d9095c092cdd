//! Stub.
use nalgebra::Vector3;

use crate::contact::{EdgePlace, FacePlace, Hit};
use crate::query::{EdgeEdge, VertexFace};

/// A unit vector with a bound on its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normal {
    /// The unit vector.
    pub direction: Vector3<f64>,
    /// Its distance from the exact one is at most this.
    pub error: f64,
}

pub(super) fn of_edges(_: &EdgeEdge, _: &Hit<EdgePlace>) -> Option<Normal> {
    None
}

pub(super) fn of_face(_: &VertexFace, _: &Hit<FacePlace>) -> Option<Normal> {
    None
}

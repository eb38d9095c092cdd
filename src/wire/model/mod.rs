//! What is simulated: bodies and wires.

mod body;
pub(super) mod check;
pub(super) mod core;
mod error;
mod material;
mod mesh;
mod phases;
mod plan;
pub(in crate::wire) mod reel;
mod shape;
pub(in crate::wire) mod wire;

pub use body::{Body, BodyId, BodyPlan, Drive, Phase};
pub use error::ModelError;
pub use material::{Material, RopePlan};
pub use mesh::Mesh;
#[cfg(feature = "recording")]
pub(in crate::wire) use mesh::Parts as MeshParts;
#[cfg(test)]
pub(in crate::wire) use mesh::tests::box_mesh;
pub use plan::{Stop, WirePlan};
pub use reel::ReelPhase;
pub use shape::{MassProperties, Shape};
pub use wire::{Node, NodeKind, Resolution, Segment, Wire, WireId};

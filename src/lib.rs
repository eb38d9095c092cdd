//! Continuous collision detection of moving line segments, for simulators whose thin things must
//! not pass through each other unnoticed.
//!
//! This crate is the engine: pure Rust, `f64`, no C. What is asked is a [`query`]; what is answered
//! is a [`contact`]; whoever answers is a [`narrow::NarrowPhase`]. The [`thesis`] path is the
//! published method with its thresholds, Algorithms 1 to 20. `wire`, with the feature of this name, steps wires and bodies. Whether an answer is *true* is judged
//! by the crate `tunnelproof-reference`, which the engine never uses.

pub mod additive;
pub mod broad;
pub mod certified;
mod closest;
pub mod contact;
pub mod narrow;
pub mod query;
pub mod thesis;
#[cfg(feature = "wire")]
pub mod wire;

pub use certified::{Batch, BatchError, Normal, classify, decide, decide_discrete, decide_exactly};
pub use contact::{
    Case, Contact, ContactKind, ContactPoint, EdgePlace, EdgePoint, FacePlace, Flags, Hit,
};
pub use nalgebra;
pub use query::{EdgeEdge, Point, Query, QueryError, QueryKind, Radius, VertexFace};

/// The example of the README, as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

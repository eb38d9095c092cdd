//! Continuous collision detection that misses nothing and invents nothing.
//!
//! A simulator steps its world in fixed time steps. Thin things, such as ropes, wires, cloth and
//! hair, can pass through each other between two steps: they *tunnel*. This crate finds the first
//! time at which two moving edges, or a moving vertex and a moving face, touch during a step:
//!
//! ```
//! use tunnelproof::nalgebra::Vector3;
//! use tunnelproof::{EdgeEdge, Point, decide};
//!
//! let p = Point::new;
//! // The edge AB rests. The edge CD falls through it, from z = 1 to z = -3.
//! let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.5, -1.0, 1.0), p(0.5, 1.0, 1.0)];
//! let end = [start[0], start[1], p(0.5, -1.0, -3.0), p(0.5, 1.0, -3.0)];
//!
//! let query = EdgeEdge::new(start, end, 0.0)?;
//! let hit = decide(&query).expect("they touch");
//! assert_eq!(hit.toi, 0.25);
//! assert_eq!((hit.place.first.u, hit.place.first.v), (0.75, 0.5));
//! let contact = hit.contact(&query);
//! assert_eq!(contact.first.point, p(0.5, 0.0, 0.0));
//! assert_eq!(contact.normal, Some(Vector3::z()));
//! # Ok::<(), tunnelproof::QueryError>(())
//! ```
//!
//! [`decide`] takes an [`EdgeEdge`] or a [`VertexFace`], with or without a [`Radius`], and gives
//! `Some(`[`Hit`]`)` or `None`. [`Pairs`] decides many queries of a kind.
//!
//! # Guarantee
//!
//! No hit is false and no contact is missed, for every finite input: coplanar, parallel and
//! collinear edges, edges that collapse to a point, subnormal numbers, 1e308. [`Hit::toi`] is the
//! exact time of impact rounded down. There is nothing to tune.
//!
//! The guarantee is about the query as it is given:
//!
//! - Each point moves on a straight line, at constant velocity, from its start to its end.
//! - `toi` bounds the *time*. Positions that are rounded to `f64` at that time may already be past
//!   the contact.
//! - The processor rounds to nearest and does not flush subnormal numbers to zero, as Rust programs
//!   run. A host that changes these settings voids the proofs. [`environment::check`] says whether
//!   a thread is as it should be.
//!
//! # Modules
//!
//! - [`rigid`] asks about rigid bodies that turn within the step: [`decide_rigid`].
//! - [`query`] is what is asked, [`contact`] what is answered, [`certified`] the method.
//! - [`mesh`] asks about whole meshes, and makes certified steps: the positions to store, with a
//!   proof that nothing touches on the way.
//! - [`broad`] finds the pairs that may meet during a step.
//! - [`environment`] is how the processor has to compute, and a check of it.
//! - [`narrow`] is the trait of every method, also of your own. The crate `tunnelproof-reference`
//!   judges any of them against the exact answer.
//! - [`thesis`] and [`additive`] are published methods to compare with.
//! - `wire` steps wires, ropes and rigid bodies; it needs the feature `wire`.
//!
//! # Features
//!
//! | feature | what it adds |
//! | --- | --- |
//! | `rayon` | `par_decide` of `Pairs` and `Batch`; steps of pairs and meshes on all threads |
//! | `wire` | the wire stepper |
//! | `serde` | its settings and records as data; includes `wire` |
//! | `recording` | its steps, and its state, to a file and back; includes `serde` |
//!
//! None is on by default. The types of points and vectors are those of [`nalgebra`], which this
//! crate re-exports.

pub mod additive;
pub mod broad;
pub mod certified;
mod closest;
pub mod contact;
pub mod environment;
pub mod mesh;
pub mod narrow;
mod parallel;
pub mod query;
mod registers;
pub mod rigid;
pub mod thesis;
#[cfg(feature = "wire")]
pub mod wire;

pub use certified::{
    Advance, Batch, BatchError, Blocked, Clearance, ClearanceError, Kind, ListedPair, Normal,
    Pairs, PairsError, PairsLimit, PairsStep, Precision, Proximity, Stage, advance, advance_in,
    advance_pairs, classify, decide, decide_discrete, decide_exactly, decide_rigid, interpolate,
    interpolate_in,
};
pub use contact::{
    Case, Contact, ContactKind, ContactPoint, EdgePlace, EdgePoint, FacePlace, Flags, Hit,
};
pub use mesh::Mesh;
pub use nalgebra;
pub use query::{Coordinate, EdgeEdge, Point, Query, QueryError, QueryKind, Radius, VertexFace};

/// The example of the README, as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

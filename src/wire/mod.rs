//! The wire stepper: wires, ropes and chains under large tension, with rigid bodies.
//!
//! A [`World`] holds bodies and wires; [`World::step`] moves them by one time step. A wire is a row
//! of point masses with rows that resist stretch and bending; contacts with friction are given to
//! each step as data. [`World::step_colliding`] finds them itself, and lets no wire through
//! another. SI units throughout. The equations, the defaults and where they come from are in
//! `docs/wires.md`.
//!
//! The same input gives the same bits, whatever the build and the machine: one thread, no order
//! that depends on addresses, no fused operations, and of transcendental functions only the sine,
//! cosine and arc tangent of the `libm` crate.
//!
//! ```
//! use tunnelproof::query::Point;
//! use tunnelproof::wire::{Material, Settings, Stop, WirePlan, World};
//!
//! let mut world = World::new(Settings::default())?;
//! let ends = [Point::new(0.0, 0.0, 0.0), Point::new(2.0, 0.0, 0.0)];
//! let route = ends.map(Stop::Pinned).to_vec();
//! let wire = world.add_wire(&WirePlan::new(Material::steel(0.02), 0.25, route))?;
//! let record = world.step(&[])?;
//! assert_eq!(record.wires[wire.0].after.len(), 9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bisect;
mod clock;
mod collide;
mod contact;
mod energy;
mod error;
#[cfg(feature = "recording")]
mod file;
mod model;
mod record;
#[cfg(feature = "recording")]
pub mod recording;
mod resolution;
mod settings;
mod site;
mod solver_cache;
mod sparse;
#[cfg(feature = "recording")]
pub mod state;
mod step;
mod torsion;
mod union_find;
mod vector;
mod world;

pub use collide::{CollisionMemory, CollisionSettings, Collisions, Mode, PairFilter};
pub use contact::{ContactConstraint, ContactSite};
pub use energy::Energy;
pub use error::{CollisionError, Part, Reason, StepError};
pub use model::{
    Body, BodyId, BodyPlan, Drive, MassProperties, Material, Mesh, ModelError, Node, NodeKind,
    Phase, ReelPhase, Resolution, RopePlan, Segment, Shape, Stop, Wire, WireId, WirePlan,
};
pub use record::{
    AddedInertia, BodyCrossing, BodyCrossingOutcome, BodyRecord, CollisionRecord, ContactRecord,
    CoreCrossing, Crossing, CrossingOutcome, PairAnswer, PairRecord, Phases, Pose, ScaledIsland,
    Slide, SolverRecord, StepRecord, WireRecord,
};
pub use resolution::{Remesh, RemeshGuard, RemeshKind};
pub use settings::Settings;
pub use site::{SegmentId, WireSite};
pub use vector::Vector;
pub use world::World;

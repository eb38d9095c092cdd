//! The certified path: edges against edges and vertices against faces without thresholds, fast and
//! never wrong.
//!
//! [`decide`] answers one query, of two edges or of a vertex and a face; a [`Batch`] answers many.
//! No hit is false, no contact is missed, and the time of impact is the exact one rounded down.
//!
//! ```
//! use tunnelproof::certified::{Stage, decide_observed};
//! use tunnelproof::{EdgeEdge, Point};
//!
//! let p = Point::new;
//! let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, -1.0, 1.0), p(0.0, 1.0, 1.0)];
//! let mut end = start;
//! end[2].z = 0.5;
//! end[3].z = 0.5;
//! // They stay apart, and the first stage proves it.
//! let mut stages = Vec::new();
//! let hit = decide_observed(&EdgeEdge::new(start, end, 0.0)?, &mut |stage| stages.push(stage));
//! assert_eq!((hit, &stages[..]), (None, &[Stage::Boxes][..]));
//! # Ok::<(), tunnelproof::QueryError>(())
//! ```
//!
//! A query goes through a cascade ([`Stage`]) of which each stage answers only what it can prove,
//! in `f64` with an error bound derived beside the code:
//!
//! 1. the swept boxes are disjoint (`separate`);
//! 2. a direction separates the edges for the whole step (`separate`);
//! 3. the cubic `f = (K x L) . M`, with `K = B - A`, `L = D - C`, `M = C - A`, has no root, by the
//!    signs of its Bernstein coefficients (`cubic`): edges that touch are coplanar;
//! 4. its roots are bracketed (`root`), or in a part of the step in which the edges are apart
//!    anyway; the edges are inside or outside of each other there (`locate`), and the last bit of
//!    the time, or what is near an edge's end, is settled in double-double arithmetic (`refine`,
//!    `double`); edges with a common end at the start touch there (`start`);
//! 5. a separating direction is searched for (`separate`);
//! 6. integers decide what is left ([`decide_exactly`], `exact`): degenerate motion, contact at
//!    ends.
//!
//! [`Batch`] takes the first four stages for many queries at once, as far as they need no branch
//! (`block`); both ends of the step are a pair of numbers (`ends`) throughout.
//!
//! With a radius above 0 other stages take their place (`thick`): planes that separate for a part
//! of the step, up to the contact, where double-double arithmetic settles the time; and integers
//! again.
//!
//! [`advance`] moves two sides as far as they may go, and gives the positions to store (`step`).
//!
//! [`decide_discrete`] is the question at one instant, with a radius (`discrete`).
//!
//! No stage has a threshold: an error bound is a proof, and what it cannot prove it hands on.

#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison with NaN must mean: not proved"
)]

mod advance_pairs;
mod batch;
mod block;
mod cascade;
mod contact;
mod crossing;
mod cubic;
mod discrete;
mod double;
mod edges;
mod ends;
mod exact;
mod face;
mod kind;
mod locate;
mod motion;
mod narrow;
mod nearest;
mod normal;
mod pairs;
mod queries;
mod refine;
mod rigid;
mod root;
mod separate;
mod single;
mod stage;
mod start;
mod step;
#[cfg(test)]
pub(crate) mod testing;
mod thick;
mod together;
mod vector;

pub use advance_pairs::{ListedPair, PairsLimit, PairsStep, advance_pairs};
pub use batch::{Batch, BatchError};
pub(crate) use block::CHUNK;
pub use cascade::{classify, decide, decide_exactly, decide_observed};
pub use discrete::{Proximity, decide_discrete};
pub use kind::Kind;
pub(crate) use motion::Positions;
pub use narrow::Certified;
pub use normal::{HasNormal, Normal};
pub(crate) use pairs::{Indexed, Radii};
pub use pairs::{Pairs, PairsError};
pub(crate) use queries::MayTouch;
pub use rigid::{RigidKind, decide_rigid, decide_rigid_exactly};
pub use stage::Stage;
pub use step::{
    Advance, Blocked, Clearance, ClearanceError, Precision, advance, advance_in, interpolate,
    interpolate_in,
};
pub(crate) use step::{Limit, first_toi, rounding_of};
pub(crate) use together::{Moved, PairMotion, Together};

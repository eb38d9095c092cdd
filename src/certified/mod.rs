//! The certified path: edges against edges and vertices against faces without thresholds, fast and never
//! wrong.
//!
//! [`decide`] answers one query of two edges, [`Batch`] many; [`decide_vertex_face`] and [`FaceBatch`] do
//! so for a vertex and a face, by the same stages (`face`). No hit is false, no contact is missed, and the time
//! of impact is the exact one rounded down. A query goes through a cascade ([`Stage`]) of which each
//! stage answers only what it can prove, in `f64` with an error bound derived beside the code:
//!
//! 1. the swept boxes are disjoint (`separate`);
//! 2. a direction separates the edges for the whole step (`separate`);
//! 3. the cubic `f = (K x L) . M`, with `K = B - A`, `L = D - C`, `M = C - A`, has no root, by the signs
//!    of its Bernstein coefficients (`cubic`): edges that touch are coplanar;
//! 4. its roots are bracketed (`root`), or in a part of the step in which the edges are apart anyway;
//!    the edges are inside or outside of each other there (`locate`), and the last bit of the time, or
//!    what is near an edge's end, is settled in double-double arithmetic (`refine`, `double`); edges
//!    with a common end at the start touch there (`start`);
//! 5. a separating direction is searched for (`separate`);
//! 6. integers decide what is left ([`decide_exactly`], `exact`): degenerate motion, contact at ends.
//!
//! [`Batch`] takes the first four stages for many queries at once, as far as they need no branch
//! (`block`); both ends of the step are a pair of numbers (`ends`) throughout.
//!
//! With a radius above 0 other stages take their place (`thick`): planes that separate for a part of the step, up to
//! the contact, where double-double arithmetic settles the time; and integers again.
//!
//! [`decide_discrete`] is the question at one instant, with a radius (`discrete`).
//!
//! No stage has a threshold: an error bound is a proof, and what it cannot prove it hands on.

#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    reason = "a comparison with NaN must mean: not proved"
)]

mod batch;
mod block;
mod cascade;
mod cubic;
mod discrete;
mod double;
mod ends;
mod exact;
mod face;
mod locate;
mod motion;
mod narrow;
mod normal;
mod pair;
mod refine;
mod root;
mod separate;
mod start;
#[cfg(test)]
mod testing;
mod thick;
mod verdict;

pub use batch::{Batch, BatchError, FaceBatch, PairBatch};
pub use cascade::{Stage, decide, decide_observed};
pub use discrete::{Proximity, decide_discrete};
pub use exact::{Decision, decide_exactly};
pub use face::{
    FaceHit, decide_vertex_face, decide_vertex_face_exactly, decide_vertex_face_observed,
};
pub use narrow::Certified;
pub use normal::Normal;
pub use pair::Batched;
pub use verdict::{Hit, Parameters, Verdict};

//! The certified path: an edge-edge test without thresholds, never wrong.
//!
//! Its last stage, [`decide_exactly`], decides every finite query in integer arithmetic.

mod exact;

pub use exact::{Decision, ExactHit, PARAMETER_ERROR, Parameters, decide_exactly};

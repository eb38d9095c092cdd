//! Certification: subjects judged on queries against the exact answer.
//!
//! The oracle says what is true, and a second judge, the shadow of the thesis' algorithms, has to
//! say the same on every query. Each query is judged by itself, on any thread; what is counted is
//! counted in the order of the queries, so that the result does not depend on the threads.
//!
//! [`judged`] compares one answer with the exact one, [`verdict`] says what it is worth, [`tally`]
//! counts, in a [`block`] for a whole [`source`] or a [`shard`] of it. A [`query`] is of linear motion
//! or of a body that turns. [`run`] does it, all blocks are the [`findings`], [`strict`] says whether the result passes and [`table`] writes it down,
//! with a [`summary`] first and [`details`] on request. [`caller`] says how a find is shown again,
//! [`defaults`] which families a subject gets by itself.
//! How far a subject may be off, it declares itself ([`tolerance`](crate::subject::Subject::tolerance));
//! [`margin`] says where thresholds excuse the thesis path from a fuzz target.

pub mod batch;
pub mod block;
pub mod boxes;
pub mod caller;
pub mod defaults;
pub mod details;
pub mod findings;
pub mod fingerprint;
pub mod judged;
pub mod margin;
pub mod named;
pub mod query;
mod reply;
pub mod run;
pub mod shard;
pub mod source;
pub mod strict;
pub mod summary;
pub mod table;
pub mod tally;
pub mod trial;
pub mod verdict;

#[cfg(test)]
mod tests;

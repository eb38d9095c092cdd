//! What the thesis' thresholds cost: the thesis path judged over a grid of their values.
//!
//! A [`Sample`] holds queries of a [`Domain`], each with what the verdicts need of its exact
//! answer. That is found once, and kept in a [`Cache`] between runs. A [`Grid`] of [`Setting`]s is
//! then judged on all of them, each to a [`Price`]. The verdicts are those of
//! [`mod@tunnelproof_reference::certify`].
//!
//! All hits without contact are false hits here. The distance within which the thesis path declares
//! them to be near is one of the thresholds, and would excuse more the larger it is.

mod cache;
mod container;
mod domain;
mod grid;
mod price;
mod record;
mod run;
mod sample;
mod setting;
#[cfg(test)]
mod tests;

pub use cache::Cache;
pub use container::Damage;
pub use domain::{Domain, DomainError, Precision};
pub use grid::{Axis, AxisError, Grid, STEPS};
pub use price::{Counts, Gaps, Price, Worst};
pub use run::{Evaluated, Interrupted, Watch, run};
pub use sample::{Part, Sample};
pub use setting::Setting;

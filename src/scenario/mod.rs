//! Queries and scenes that are defined once, for tests, benches, the command line and the docs.

#[cfg(feature = "wire")]
pub mod analytic;
pub mod figures;
#[cfg(feature = "scenes")]
pub mod rows;
#[cfg(feature = "scenes")]
pub mod scenes;

//! Queries and scenes that are defined once, for tests, benches, the command line and the docs.

pub mod figures;

//! The command line from outside: what it writes, and how it ends.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod advance;
#[cfg(unix)]
mod boxes;
mod certificate;
mod certify;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod environment;
mod eval;
mod explain;
mod general;
#[cfg(unix)]
mod lib_subject;
mod mesh_step;
#[cfg(unix)]
mod program;
mod run;
mod shrink;
mod simulate;
mod slowest;
mod states;
mod sweep;
mod vectors;

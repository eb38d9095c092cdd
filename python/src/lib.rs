//! The extension module behind the Python package `tunnelproof`, which documents and checks what comes in.
//!
//! Everything that computes does so in the default floating-point environment (`with_default`), once for each call. The
//! pool of threads is started there as well. What it runs besides is a method to be judged, whose changes of the
//! environment end with its call (`with_restored`).

use pyo3::prelude::*;

mod advance;
mod certified;
mod certify;
mod columns;
mod exact;
mod families;
mod interrupt;
mod mesh;
mod method;
mod pairs;
mod queries;
mod query;
mod simulate;
mod turning;

/// The functions that `tunnelproof/__init__.py` calls.
#[pymodule]
mod _tunnelproof {
    #[pymodule_export]
    use crate::advance::advance;
    #[pymodule_export]
    use crate::certified::decide;
    #[pymodule_export]
    use crate::certify::{certify, merge};
    #[pymodule_export]
    use crate::exact::exact;
    #[pymodule_export]
    use crate::families::{families, family};
    #[pymodule_export]
    use crate::mesh::Mesh;
    #[pymodule_export]
    use crate::pairs::{advance_pairs, decide_pairs};
    #[pymodule_export]
    use crate::query::{draw, explain, gap, locate, shrink};
    #[pymodule_export]
    use crate::simulate::{Seen, scenes, simulate};
    #[pymodule_export]
    use crate::turning::decide_rigid;

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}

//! The extension module behind the Python package `tunnelproof`, which documents and checks what comes in.

use pyo3::prelude::*;

mod certified;
mod certify;
mod columns;
mod exact;
mod families;
mod method;
mod queries;

/// The functions that `tunnelproof/__init__.py` calls.
#[pymodule]
mod _tunnelproof {
    #[pymodule_export]
    use crate::certified::decide;
    #[pymodule_export]
    use crate::certify::{certify, merge};
    #[pymodule_export]
    use crate::exact::exact;
    #[pymodule_export]
    use crate::families::{families, family};

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}

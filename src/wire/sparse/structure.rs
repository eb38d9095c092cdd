//! The storage of a system, kept while its structure stays.

use super::{Ldl, Symmetric};

/// A system's entries, matrix and factor. As long as the entries are in the same places, the
/// elimination tree and the storage are used again.
#[derive(Clone, Debug)]
pub(in crate::wire) struct Structure {
    pub(in crate::wire) index: Vec<(u32, u32)>,
    pub(in crate::wire) matrix: Symmetric,
    pub(in crate::wire) ldl: Ldl,
}

//! Sparse symmetric systems: storage, elimination order, factorisation.

mod ldl;
mod order;
mod symmetric;

pub(super) use ldl::{Ldl, SparseColumns};
pub(super) use order::dissect;
pub(super) use symmetric::{Symmetric, Triplets};

//! Sparse symmetric systems: storage, elimination order, factorisation.

mod ldl;
mod order;
mod structure;
mod symmetric;

pub(super) use ldl::{Ldl, SparseColumns};
pub(super) use order::{dissect, least_degree};
pub(super) use structure::Structure;
pub(super) use symmetric::{Symmetric, Triplets, sorted_by_key};

//! Sparse symmetric systems: storage, elimination order, factorisation; roots of one variable.

mod bisect;
mod ldl;
mod order;
mod symmetric;

pub(super) use bisect::bisect;
pub(super) use ldl::{Ldl, SparseColumns};
pub(super) use order::{dissect, least_degree};
pub(super) use symmetric::{Symmetric, Triplets};

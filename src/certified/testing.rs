//! What the tests of the stages share: exact arithmetic, and a search for the inputs at which an
//! error comes nearest to its bound.

mod geometry;
mod number;
mod polynomial;
mod random;
mod rooted;
mod search;

pub(super) use geometry::{Exact, dot, layout, points, points_and_direction, range};
pub(super) use number::Number;
pub(super) use polynomial::Polynomial;
pub(crate) use random::Random;
pub(super) use rooted::Rooted;
pub(super) use search::{Claim, Search};

#[cfg(test)]
mod tests;

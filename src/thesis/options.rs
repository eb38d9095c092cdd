//! How the thesis' text is to be read.

use super::text::Repairs;
use super::threshold::Thresholds;

/// The thresholds, and the readings where the text leaves or needs a choice.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Options {
    /// The values below which something counts as zero.
    pub thresholds: Thresholds,
    /// What Algorithm 16 asks of the lines' intersection.
    pub residual: Residual,
    /// Which errors of the text are repaired; by default [`Repairs::SLIPS`].
    pub repairs: Repairs,
}

/// Which equations of `R u - S v = Q - P` Algorithm 16 checks after solving for `u` and `v`.
///
/// It solves by least squares over all three, so that any of them may be left unfulfilled; what it
/// then checks is `R_i u - S_i v - B_i` with an `i` that is nowhere set, and the comment "Check
/// third equation".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Residual {
    /// The third, `i = 2`, as the comment says.
    #[default]
    Third,
    /// All three, as the prose of 3.1.3.1 says (`δ = A x - b` should be 0).
    All,
}

//! How far a law gives way to an impulse that was not predicted.
//!
//! A law that jumps, or nearly does, is no function of velocity that Newton's method can follow. The
//! method of multipliers makes it one near a predicted impulse, by a compliance that counts what was
//! not predicted alone: where prediction and solution agree, the law is satisfied.

/// The first compliance, as a fraction of the mobility. A large one takes few Newton steps; a
/// small one leaves a small residual.
const SOFT: f64 = 1e-1;

/// The factor on it at each new prediction.
const HARDER: f64 = 0.1;

/// The smallest, as a fraction of the mobility.
const HARD: f64 = 1e-7;

/// A compliance to what was not predicted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Softness {
    /// What an impulse changes of its own velocity, in 1/kg. Only the order of magnitude counts.
    pub(super) mobility: f64,
    /// In 1/kg.
    pub(super) compliance: f64,
}

impl Softness {
    pub(super) fn new(mobility: f64) -> Self {
        Softness {
            mobility,
            compliance: SOFT * mobility,
        }
    }

    /// That of the next prediction.
    pub(super) fn harden(&mut self) {
        self.compliance = (self.compliance * HARDER).max(self.mobility * HARD);
    }
}

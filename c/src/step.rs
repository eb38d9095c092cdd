//! What the steps of many pairs have in common.

use std::mem::{MaybeUninit, offset_of};

use tunnelproof::{Blocked, Coordinate, Radius};

use crate::advance::blocked;
use crate::arrays::{Error, write};

/// `tunnelproof_limit` and `tunnelproof_pairs_limit`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Limit<P> {
    pair: P,
    blocked: i32,
}

/// `tunnelproof_near_pair` and `tunnelproof_near_listed_pair`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct NearPair<P> {
    pair: P,
    kept: [f64; 2],
}

/// `tunnelproof_pairs_step`, with which `tunnelproof_step` begins, and the same with `_f32`.
#[repr(C)]
#[derive(Debug)]
pub struct Step<P, C> {
    positions: *mut C,
    limits: *mut Limit<P>,
    limit_capacity: usize,
    near_pairs: *mut NearPair<P>,
    near_capacity: usize,
    step: MaybeUninit<f64>,
    limit_count: MaybeUninit<usize>,
    near_count: MaybeUninit<usize>,
}

impl<P, C: Coordinate> Step<P, C> {
    /// Where its last field ends.
    pub(crate) const END: usize = offset_of!(Self, near_count) + size_of::<usize>();

    /// Whether so many positions can be written.
    pub(crate) fn check(&self, count: usize) -> Result<(), Error> {
        match self.positions.is_null() && count > 0 {
            true => Err(Error::null(c"positions")),
            false => Ok(()),
        }
    }

    /// Writes what is answered.
    ///
    /// # Safety
    ///
    /// Each pointer is null or points to memory that nobody else uses: for all positions, and for as
    /// many limits and pairs as its capacity says. That of the positions may be the start or the end
    /// of the motion, which are not read any more.
    pub(crate) unsafe fn write(
        &mut self,
        step: f64,
        positions: &[[C; 3]],
        limits: impl ExactSizeIterator<Item = (P, Blocked)>,
        near: impl ExactSizeIterator<Item = (P, Radius)>,
    ) {
        self.step.write(step);
        self.limit_count.write(limits.len());
        self.near_count.write(near.len());
        let limits = limits.map(|(pair, why)| Limit {
            pair,
            blocked: blocked(why),
        });
        let near = near.map(|(pair, kept)| NearPair {
            pair,
            kept: kept.parts(),
        });
        // SAFETY: the caller's promise is the same.
        unsafe { write(self.limits, self.limit_capacity, limits) };
        // SAFETY: as above.
        unsafe { write(self.near_pairs, self.near_capacity, near) };
        let stored = self.positions.cast::<[C; 3]>();
        // SAFETY: as above.
        unsafe { write(stored, positions.len(), positions.iter().copied()) };
    }
}

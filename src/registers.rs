//! Work with the widest registers that the processor has: AVX-512, AVX2, SSE2 or NEON.
//!
//! What it has is found out at run time. The work is arithmetic in which nothing is contracted or
//! reordered, so what comes of it has the same bits with all of them.

use pulp::{Arch, WithSimd};

/// Does some work with the widest registers.
pub(crate) fn with_widest<W: WithSimd>(work: W) -> W::Output {
    #[cfg(test)]
    if let Some(chosen) = *tests::CHOSEN.read().unwrap() {
        return chosen.dispatch(work);
    }
    Arch::new().dispatch(work)
}

#[cfg(test)]
mod tests;

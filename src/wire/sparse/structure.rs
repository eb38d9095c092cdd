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

impl Structure {
    /// The solution of `A x = b` as factored, refined once.
    pub(in crate::wire) fn refined(&self, b: &[f64]) -> Vec<f64> {
        let mut x = b.to_vec();
        self.ldl.solve(&mut x);
        self.refine(b, &mut x);
        x
    }

    /// Refines a solution of `A x = b` once more.
    pub(in crate::wire) fn refine(&self, b: &[f64], x: &mut [f64]) {
        let mut correction = self.matrix.residual(b, x);
        self.ldl.solve(&mut correction);
        for (x, correction) in x.iter_mut().zip(&correction) {
            *x += correction;
        }
    }
}

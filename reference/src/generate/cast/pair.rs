//! Which bodies are cast, and how large their radii are.

use rand::{Rng, RngExt};
use tunnelproof::query::QueryKind;

/// What is cast against what.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Pair {
    Capsules,
    Segments,
    SphereFace,
}

impl Pair {
    pub(super) fn kind(self) -> QueryKind {
        match self {
            Pair::Capsules | Pair::Segments => QueryKind::EdgeEdge,
            Pair::SphereFace => QueryKind::VertexFace,
        }
    }

    /// Which body each of the four points belongs to.
    pub(super) fn bodies(self) -> [usize; 4] {
        match self.kind() {
            QueryKind::EdgeEdge => [0, 0, 1, 1],
            QueryKind::VertexFace => [0, 1, 1, 1],
        }
    }

    /// Two radii of which the greater is at most this, or which are together this.
    pub(super) fn radii(self, rng: &mut dyn Rng, size: Size) -> [i32; 2] {
        match (self, size) {
            (Pair::Segments, _) => [0, 0],
            (Pair::SphereFace, Size::AtMost(most)) => [rng.random_range(1..=most), 0],
            (Pair::SphereFace, Size::Together(all)) => [all, 0],
            (Pair::Capsules, Size::AtMost(most)) => [(); 2].map(|()| rng.random_range(1..=most)),
            (Pair::Capsules, Size::Together(all)) => {
                let first = rng.random_range(1..all.max(2));
                [first, (all - first).max(1)]
            }
        }
    }
}

/// How large radii are, in units.
#[derive(Clone, Copy)]
pub(super) enum Size {
    AtMost(i32),
    Together(i32),
}

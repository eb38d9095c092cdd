//! Motion in space: `f` is not identically 0, and every contact time is a root of it.

use std::cmp::Ordering;

use crate::contact::{Case, ContactKind};

use super::isolate::Roots;
use super::lane::Lane;
use super::motion::Motion;
use super::poly::Poly;
use super::time::Time;
use crate::certified::verdict::Hit;

impl<L: Lane> Motion<L> {
    /// The first contact of a motion with `f` not identically 0.
    pub(super) fn decide_general(&self) -> Option<Hit> {
        if !self.may_have_roots() {
            return None;
        }
        let roots = Roots::new(Poly::new(&self.f));
        roots.cells().iter().find_map(|cell| {
            let time = Time::of_root(&roots, cell);
            let locus = self.locus(&time)?;
            let swaps = cell.before != cell.after && time.is_inside();
            let kind = if swaps && locus.cuts_inside {
                ContactKind::Crossing
            } else {
                ContactKind::Graze
            };
            Some(Hit::exact(&time, &locus, kind, cell.before, Case::General))
        })
    }

    /// Whether the signs of the Bernstein coefficients of `f` leave a root in `[0, 1]` possible.
    fn may_have_roots(&self) -> bool {
        let signs = self.bernstein_signs();
        let [first, .., last] = signs;
        let opposite = |sign: &Ordering| *sign == first.reverse();
        first.is_eq() || last.is_eq() || signs.iter().any(opposite)
    }
}

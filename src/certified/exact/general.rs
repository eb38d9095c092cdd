//! Motion in space: `f` is not identically 0, and every contact time is a root of it.

use crate::contact::{Case, ContactKind, EdgePlace, Hit};

use super::curve::Curve;
use super::edge_hit;
use super::motion::Motion;
use super::roots::Roots;
use super::width::Width;

impl<L: Width> Motion<L> {
    /// The first contact of a motion with `f` not identically 0.
    pub(super) fn decide_general(&self) -> Option<Hit<EdgePlace>> {
        let mut roots = Roots::none();
        roots.find(Curve::Cubic(self.f.clone()));
        roots.iter().find_map(|(time, before, after)| {
            let locus = self.locus(&time)?;
            let swaps = before != after && time.is_inside();
            let kind = if swaps && locus.cuts_inside {
                ContactKind::Crossing
            } else {
                ContactKind::Graze
            };
            Some(edge_hit(&time, &locus, kind, before, Case::General))
        })
    }
}

//! Motion in space: `f` is not identically 0, and every contact time is a root of it.

use std::cmp::Ordering;

use tunnelproof::contact::ContactKind;

use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::Integer;

use super::locus::Locus;
use super::motion::Motion;
use super::{Hit, is_inside};

impl<Z: Integer> Motion<Z> {
    /// The first contact of a motion with `f` not identically 0.
    pub(super) fn decide_general(&self) -> Option<Hit<Z>> {
        let times = isolate_roots(&self.f).into_iter();
        let mut contacts = times.filter_map(|time| Some((self.locus(&time)?, time)));
        let (locus, toi) = contacts.next()?;
        let (before, _) = self.signs_around(&toi);
        let crosses_first = self.crosses(&toi, &locus);
        Some(Hit {
            kind: if crosses_first {
                ContactKind::Crossing
            } else {
                ContactKind::Graze
            },
            crosses: crosses_first || contacts.any(|(locus, time)| self.crosses(&time, &locus)),
            side: if toi.is_zero() {
                Ordering::Equal
            } else {
                before
            },
            toi,
            locus,
        })
    }

    /// Whether the contact at this root of `f` is a crossing, in the sense of [`crate::answer`].
    fn crosses(&self, time: &Algebraic<Z>, locus: &Locus<Z>) -> bool {
        let (before, after) = self.signs_around(time);
        locus.cuts_inside && before != after && is_inside(time)
    }

    /// The signs of `f` just before and just after a root of it.
    ///
    /// Near a root of multiplicity `m`, `f` is `f^(m) (t - root)^m / m!` to leading order.
    fn signs_around(&self, root: &Algebraic<Z>) -> (Ordering, Ordering) {
        let mut derivative = self.f.derivative();
        let mut changes = true;
        loop {
            let sign = root.sign_of(&derivative);
            if sign.is_ne() {
                return (if changes { sign.reverse() } else { sign }, sign);
            }
            derivative = derivative.derivative();
            changes = !changes;
        }
    }
}

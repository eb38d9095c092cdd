//! Motion confined to a plane or a line: `f` is identically 0.
//!
//! Edges that are a point for the whole step and edges with a common start belong here too.

use std::cmp::Ordering;

use tunnelproof::contact::ContactKind;

use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::Integer;

use super::motion::{End, Motion};
use super::{Hit, is_inside};

impl<Z: Integer> Motion<Z> {
    /// The first contact of a motion with `f` identically 0.
    pub(super) fn decide_confined(&self) -> Option<Hit<Z>> {
        let ends = self.ends();
        let (toi, locus) = match self.locus(&Algebraic::zero()) {
            Some(locus) => (Algebraic::zero(), locus),
            None => {
                let times = ends.iter().filter_map(End::first_contact);
                let toi = times.min_by(Algebraic::compare)?;
                let locus = self.locus(&toi)?;
                (toi, locus)
            }
        };
        let crossings = self.crossings(&ends);
        let crosses_first = crossings.iter().any(|time| time.compare(&toi).is_eq());
        Some(Hit {
            kind: if crosses_first {
                ContactKind::Crossing
            } else {
                ContactKind::Graze
            },
            crosses: !crossings.is_empty(),
            side: Ordering::Equal,
            toi,
            locus,
        })
    }

    /// The times strictly inside the step at which the edges cross, in the sense of
    /// [`crate::answer`].
    fn crossings(&self, ends: &[End<Z>; 4]) -> Vec<Algebraic<Z>> {
        if ends.iter().all(|end| end.turn.is_zero()) {
            return self.collinear_crossings(ends);
        }
        ends.iter()
            .flat_map(|end| self.planar_crossings(end))
            .collect()
    }

    /// The times at which an end passes through the line of the other edge, in contact with it.
    fn planar_crossings(&self, end: &End<Z>) -> Vec<Algebraic<Z>> {
        let zeros = end.turn.common_zeros();
        let slope = zeros.derivative();
        let mut times = isolate_roots(&zeros);
        times.retain(|time| {
            // The turn has components of degree 2, so an odd root is a simple one.
            is_inside(time)
                && time.sign_of(&slope).is_ne()
                && (time.sign_of(&end.between).is_lt()
                    || self.locus(time).is_some_and(|locus| locus.second.is_some()))
        });
        times
    }

    /// The times at which edges on one line come into contact: an end of one meets an end of the
    /// other, and they were apart just before.
    fn collinear_crossings(&self, ends: &[End<Z>; 4]) -> Vec<Algebraic<Z>> {
        let [a, b, _, _] = ends;
        let differences = [&a.to_y, &a.to_z, &b.to_y, &b.to_z];
        let mut meetings = vec![Algebraic::zero()];
        for difference in differences {
            meetings.extend(isolate_roots(&difference.common_zeros()));
        }
        meetings.sort_by(Algebraic::compare);
        meetings.dedup_by(|x, y| x.compare(y).is_eq());
        let pairs = meetings.windows(2).filter(|pair| is_inside(&pair[1]));
        let apart_before = pairs.filter(|pair| self.locus(&pair[0].between(&pair[1])).is_none());
        apart_before.map(|pair| pair[1].clone()).collect()
    }
}

impl<Z: Integer> End<Z> {
    /// The first time at which the end is on the other edge.
    fn first_contact(&self) -> Option<Algebraic<Z>> {
        if self.turn.is_zero() {
            // Always on the line; the first time between the ends of the edge.
            let at_start = Algebraic::zero();
            if at_start.sign_of(&self.between).is_le() {
                return Some(at_start);
            }
            return isolate_roots(&self.between).into_iter().next();
        }
        let times = isolate_roots(&self.turn.common_zeros());
        times
            .into_iter()
            .find(|time| time.sign_of(&self.between).is_le())
    }
}

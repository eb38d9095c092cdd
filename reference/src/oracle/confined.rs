//! Motion confined to a plane or a line: `f` is identically 0.
//!
//! Edges and faces that are a point for the whole step and edges with a common start belong here
//! too.

use std::cmp::Ordering;

use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::Integer;

use super::general::signs_around;
use super::motion::{End, Motion};
use super::{Hit, is_inside, kind};

/// The first contact of a motion with `f` identically 0.
pub(super) fn decide_confined<Z: Integer>(motion: &dyn Motion<Z>) -> Option<Hit<Z>> {
    let ends = motion.ends();
    let (toi, locus) = match motion.locus(&Algebraic::zero()) {
        Some(locus) => (Algebraic::zero(), locus),
        None => {
            let times = ends.iter().filter_map(End::first_contact);
            let toi = times.min_by(Algebraic::compare)?;
            let locus = motion.locus(&toi)?;
            (toi, locus)
        }
    };
    let crossings = crossings(motion, &ends);
    Some(Hit {
        kind: kind(crossings.iter().any(|time| time.compare(&toi).is_eq())),
        crosses: !crossings.is_empty(),
        side: Ordering::Equal,
        toi,
        locus,
    })
}

/// The times strictly inside the step of crossings in the sense of [`crate::answer`].
fn crossings<Z: Integer>(motion: &dyn Motion<Z>, ends: &[End<Z>]) -> Vec<Algebraic<Z>> {
    if ends.iter().all(|end| end.turn.is_zero()) {
        return collinear_crossings(motion);
    }
    let of_end = |end| planar_crossings(motion, end);
    ends.iter().flat_map(of_end).collect()
}

/// The times at which a vertex passes through the line of an edge, in contact with it.
fn planar_crossings<Z: Integer>(motion: &dyn Motion<Z>, end: &End<Z>) -> Vec<Algebraic<Z>> {
    let zeros = end.turn.common_zeros();
    let mut times = isolate_roots(&zeros);
    times.retain(|time| {
        let overlaps = || {
            motion
                .locus(time)
                .is_some_and(|locus| locus.second.is_some())
        };
        // The turn reverses its direction where the common divisor of its components changes its
        // sign.
        let (before, after) = signs_around(&zeros, time);
        is_inside(time) && before != after && (time.sign_of(&end.between).is_lt() || overlaps())
    });
    times
}

/// The times at which what is on one line comes into contact: vertices meet, and all was apart just
/// before.
fn collinear_crossings<Z: Integer>(motion: &dyn Motion<Z>) -> Vec<Algebraic<Z>> {
    let mut meetings = vec![Algebraic::zero()];
    for way in motion.meetings() {
        meetings.extend(isolate_roots(&way.common_zeros()));
    }
    meetings.sort_by(Algebraic::compare);
    meetings.dedup_by(|x, y| x.compare(y).is_eq());
    let pairs = meetings.windows(2).filter(|pair| is_inside(&pair[1]));
    let apart_before = pairs.filter(|pair| motion.locus(&pair[0].between(&pair[1])).is_none());
    apart_before.map(|pair| pair[1].clone()).collect()
}

impl<Z: Integer> End<Z> {
    /// The first time at which the vertex is on the edge.
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

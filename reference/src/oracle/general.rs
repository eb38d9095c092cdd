//! Motion in space: `f` is not identically 0, and every contact time is a root of it.

use std::cmp::Ordering;

use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::Integer;
use crate::poly::Poly;

use super::locus::Locus;
use super::motion::Motion;
use super::{Hit, is_inside, kind};

/// The first contact of a motion with `f` not identically 0.
pub(super) fn decide_general<Z: Integer>(motion: &dyn Motion<Z>) -> Option<Hit<Z>> {
    let times = isolate_roots(motion.f()).into_iter();
    let mut contacts = times.filter_map(|time| Some((motion.locus(&time)?, time)));
    let (locus, toi) = contacts.next()?;
    let crosses_first = crosses(motion, &toi, &locus);
    let mut later = contacts.map(|(locus, time)| crosses(motion, &time, &locus));
    Some(Hit {
        kind: kind(crosses_first),
        crosses: crosses_first || later.any(|crosses| crosses),
        side: match toi.is_zero() {
            true => Ordering::Equal,
            false => signs_around(motion.f(), &toi).0,
        },
        toi,
        locus,
    })
}

/// Whether the contact at this root of `f` is a crossing, in the sense of [`crate::answer`].
fn crosses<Z: Integer>(motion: &dyn Motion<Z>, time: &Algebraic<Z>, locus: &Locus<Z>) -> bool {
    if !locus.cuts_inside {
        return false;
    }
    let (before, after) = signs_around(motion.f(), time);
    before != after && is_inside(time)
}

/// The passages of a motion with `f` not identically 0: +1 for each contact at which `f` rises, -1 for each at which it
/// falls. `None` if a contact is not inside both edges and the step: then a disturbance decides.
pub(super) fn passages<Z: Integer>(motion: &dyn Motion<Z>) -> Option<i64> {
    let mut sum = 0;
    for time in isolate_roots(motion.f()) {
        let Some(locus) = motion.locus(&time) else {
            continue;
        };
        if !(locus.cuts_inside && is_inside(&time)) {
            return None;
        }
        sum += match signs_around(motion.f(), &time) {
            (before, after) if before == after => 0,
            (Ordering::Less, _) => 1,
            _ => -1,
        };
    }
    Some(sum)
}

/// The signs of `f`, which is not identically 0, just before and just after a root of it.
///
/// Near a root of multiplicity `m`, `f` is `f^(m) (t - root)^m / m!` to leading order.
pub(super) fn signs_around<Z: Integer>(f: &Poly<Z>, root: &Algebraic<Z>) -> (Ordering, Ordering) {
    let mut derivative = f.derivative();
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

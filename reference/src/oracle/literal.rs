//! The description of contact evaluated at every candidate: slow, plain, and the test of the rest.

use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::Integer;
use crate::poly::Poly;
use crate::scaled::Scaled;

use super::motion::{End, Motion};

/// The first contact time, from the definition alone.
///
/// `contact(t)` is: `N.N > 0` and `f = 0` and `0 <= U <= N.N` and `0 <= W <= N.N` with
/// `U = (M x L) . N` and `W = (M x K) . N`; or an end is on the other edge.
pub(super) fn first_contact<Z: Integer>(points: &Scaled<Z>) -> Option<Algebraic<Z>> {
    let motion = Motion::new(points);
    let Motion { k, l, m, n, f } = &motion;
    let (n2, u, w) = (n.dot(n), m.cross(l).dot(n), m.cross(k).dot(n));
    let bounds = [u.clone(), n2.sub(&u), w.clone(), n2.sub(&w)];
    let ends = motion.ends();

    let mut candidates = vec![Algebraic::zero()];
    let of_ends = ends
        .iter()
        .flat_map(|end| end.turn.0.iter().chain([&end.between]));
    for poly in bounds.iter().chain([&n2, f]).chain(of_ends) {
        candidates.extend(isolate_roots(poly));
    }
    candidates.sort_by(Algebraic::compare);

    let lines_touch_inside = |time: &Algebraic<Z>| {
        let not_negative = |poly: &Poly<Z>| time.sign_of(poly).is_ge();
        time.sign_of(&n2).is_gt() && time.sign_of(f).is_eq() && bounds.iter().all(not_negative)
    };
    let is_on = |end: &End<Z>, time: &Algebraic<Z>| {
        end.turn.is_zero_at(time) && time.sign_of(&end.between).is_le()
    };
    candidates
        .into_iter()
        .find(|time| lines_touch_inside(time) || ends.iter().any(|end| is_on(end, time)))
}

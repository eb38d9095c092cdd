//! A contact by numbers alone, without a branch: for several queries at once.

use super::advance::{Moving, differences};
use super::contact::side;
use super::instant::Instant;
use super::refine_toi::Approach;
use super::{LARGEST, SMALLEST};
use crate::certified::crossing;
use crate::certified::cubic::Cubic;
use crate::certified::ends::Ends;
use crate::certified::kind::Stages;
use crate::contact::{Case, ContactKind, Flags, Hit, PLACE_ERROR};

/// A contact within the step, where the first correction of the time makes it certain. It is the
/// same in every bit as what [`decide_from`](super::decide_from) finds, which corrects the time more
/// often and asks more where it is not.
#[derive(Clone, Copy, Debug)]
pub(in crate::certified) struct Touch {
    /// The time of impact, rounded down.
    pub(in crate::certified) toi: f64,
    pub(in crate::certified) u: f64,
    pub(in crate::certified) v: f64,
    /// The error of `u` and `v`.
    pub(in crate::certified) error: f64,
}

impl Touch {
    /// The contact at the radius, which is the sum of the two, after a time up to which they are
    /// apart and which planes lead to, or at the start, if that time is 0; and whether it is certain.
    #[inline(always)]
    pub(in crate::certified) fn new<K: Stages, E: Ends>(
        points: &[[E; 3]; 4],
        radius: f64,
        radii: [f64; 2],
        t: f64,
    ) -> (Self, bool) {
        let moving = Moving::new::<K>(points, radius);
        let here = Instant::new::<K, E>(&moving, t);
        let approach = Approach::new::<K, E>(points, &moving, radii, &here, t);
        let is_at_start = t == 0.0;
        let while_ = if is_at_start { 0.0 } else { approach.while_ };
        let (nearness, is_near) = moving.nearness_in_space(&here, while_);
        let (root, is_ahead) = approach.root(&nearness);
        let (toi, is_certain) = root.below();
        // As [`Moving::is_ordinary`], so that the same stage answers, and of the differences as well.
        let is_ordinary = (radius > SMALLEST)
            & (radius < LARGEST)
            & (moving.boxes.size() < LARGEST)
            & approach.is_small();
        let is_placed = nearness.error <= PLACE_ERROR / 4.0;
        let is_later = is_certain & approach.is_ahead & is_ahead & (t > 0.0);
        let is_at_start = is_at_start & approach.is_within;
        let touch = Touch {
            toi: if is_at_start { 0.0 } else { toi },
            u: here.spot.u,
            v: here.spot.v,
            error: nearness.error,
        };
        let is_touch = is_at_start | is_later;
        (touch, is_touch & is_near & is_placed & is_ordinary)
    }

    /// The sign of `f` just before a time of impact, or 1 at the start, times 2 if the midlines cross
    /// during the step and 1 if not; 0 if something is not certain.
    #[inline(always)]
    pub(in crate::certified) fn passage<K: Stages, E: Ends>(points: &[[E; 3]; 4], toi: f64) -> f64 {
        let cubic = Cubic::unchecked(&differences::<K, E>(points));
        let is_in_space = cubic.is_valid() & cubic.is_not_identically_0();
        let sign = if toi > 0.0 { side(&cubic, toi) } else { 1.0 };
        let motion = K::motion(points);
        let [are_apart, cross] = crossing::cross::<K, E>(&motion, &Cubic::unchecked(&motion));
        let passage = sign * if cross { 2.0 } else { 1.0 };
        if is_in_space & (are_apart | cross) {
            passage
        } else {
            0.0
        }
    }

    /// The contact with a [`passage`](Self::passage); `None` if that is not certain.
    pub(in crate::certified) fn hit<K: Stages>(&self, passage: f64) -> Option<Hit<K::Place>> {
        let toi = self.toi;
        let kind = if passage.abs() > 1.0 {
            ContactKind::Crossing
        } else {
            ContactKind::Graze
        };
        let hit = || Hit {
            toi,
            toi_above: if toi > 0.0 { toi.next_up() } else { 0.0 },
            kind,
            side: match passage > 0.0 {
                _ if toi == 0.0 => 0,
                true => 1,
                false => -1,
            },
            case: Case::General,
            flags: Flags::default(),
            place: K::place(self.u, self.v, self.error),
        };
        (passage != 0.0).then(hit)
    }
}

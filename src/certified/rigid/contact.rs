//! The contact of two sides of which one turns, certified in double-double arithmetic.
//!
//! [`Moving::apart_until`] has proved that they are apart up to some time. From there a guess of the
//! contact in `f64` tells which two [`Features`] are nearest then. If the conditions hold, with
//! certainty, under which these are the nearest from that time on, and the excess of their squared
//! distance passes 0 once ([`root_after`]), then that is the first contact. A part on which this is
//! not so is halved: in its first half the excess must not be 0.
//!
//! Whatever is not certain is left to the integers: contact without a radius at the end of an edge,
//! contact at a time that is a number in `f64`, grazes, edges that are or may be parallel.

use std::cmp::Ordering;

use super::ball::{Ball, UP};
use super::differences::Differences;
use super::features::Features;
use super::place::{SHARE_ERROR, place};
use super::root::root_after;
use super::series::{LONG, LONG_OF_TWO, SHORT, SHORT_OF_TWO, Series};
use super::term::{Vector, cross, dot};
use super::{First, Moving, Turning};
use crate::certified::exact::Passage;
use crate::certified::kind::Stages;
use crate::certified::nearest::Spot;
use crate::contact::{Case, ContactKind, Flags, Hit};

/// How often a part of the step is halved.
const HALVES: usize = 6;

/// A contact, but for what the midlines do.
pub(super) struct Touch {
    toi: [f64; 2],
    side: Ordering,
    /// `u` and `v`.
    place: [f64; 2],
}

impl Touch {
    /// The whole answer.
    pub(super) fn hit<K: Stages>(self, passage: Passage) -> Hit<K::Place> {
        let [toi, toi_above] = self.toi;
        let [u, v] = self.place;
        Hit {
            toi,
            toi_above,
            kind: passage.kind,
            side: self.side as i8,
            case: passage.case,
            flags: Flags::default(),
            place: K::place(u, v, SHARE_ERROR),
        }
    }
}

/// What two midlines do that cross.
pub(super) const CROSSING: Passage = Passage {
    case: Case::General,
    kind: ContactKind::Crossing,
};

/// What two midlines do that stay apart.
pub(super) const APART: Passage = Passage {
    case: Case::General,
    kind: ContactKind::Graze,
};

/// The first contact, if it is certain, of what is apart up to a time.
pub(super) fn touch<K: Stages, const FIRST: usize, const SECOND: usize>(
    query: &Turning<FIRST, SECOND>,
    moving: &Moving<FIRST, SECOND>,
    apart_until: f64,
) -> Option<Touch> {
    let is_thick = !query.radius.is_zero();
    if apart_until == 0.0
        && is_thick
        && let Some(touch) = near_start::<K, FIRST, SECOND>(query, moving)
    {
        return Some(touch);
    }
    let guess = moving.guess::<K>(query.radius, apart_until)?;
    let spot = is_thick.then(|| moving.nearest::<K>(guess).0);
    let (is_long, spot) = (is_thick && K::FIRST == 2, spot.as_ref());
    let do_both_turn = matches!(query.first, First::Turning(_));
    match (do_both_turn, is_long) {
        (false, false) => touch_near::<K, SHORT, FIRST, SECOND>(query, apart_until, guess, spot),
        (false, true) => touch_near::<K, LONG, FIRST, SECOND>(query, apart_until, guess, spot),
        (true, false) => {
            touch_near::<K, SHORT_OF_TWO, FIRST, SECOND>(query, apart_until, guess, spot)
        }
        (true, true) => {
            touch_near::<K, LONG_OF_TWO, FIRST, SECOND>(query, apart_until, guess, spot)
        }
    }
}

/// The first contact after a time, if it is certain that it is near a guess.
fn touch_near<K: Stages, const N: usize, const FIRST: usize, const SECOND: usize>(
    query: &Turning<FIRST, SECOND>,
    mut from: f64,
    guess: f64,
    spot: Option<&Spot>,
) -> Option<Touch> {
    for _ in 0..HALVES {
        let part = Part::<N>::new::<K, FIRST, SECOND>(query, [from, guess], spot)?;
        if let Some(touch) = part.touch::<K, FIRST, SECOND>(query, guess, spot) {
            return Some(touch);
        }
        let half = [from, part.middle];
        let part = Part::<N>::new::<K, FIRST, SECOND>(query, half, spot)?;
        if !part.is_clear(half[1]) {
            return None;
        }
        from = half[1];
    }
    None
}

/// The contact at the start, if they are certainly nearer than a radius then.
fn near_start<K: Stages, const FIRST: usize, const SECOND: usize>(
    query: &Turning<FIRST, SECOND>,
    moving: &Moving<FIRST, SECOND>,
) -> Option<Touch> {
    let (spot, _) = moving.nearest::<K>(0.0);
    let now = Now::new::<K, FIRST, SECOND>(query, Ball::ZERO, Some(&spot))?;
    let is_nearest = now.features.throughout.iter().all(|c| c.sign() == ABOVE);
    let is_near = now.features.excess.sign() == Some(Ordering::Less);
    // The case is a general one.
    now.side()?;
    let touch = now.touch::<K>([0.0; 2], Ordering::Equal);
    touch.filter(|_| is_near && is_nearest)
}

const ABOVE: Option<Ordering> = Some(Ordering::Greater);

/// A part of the step, with polynomials around its middle.
struct Part<const N: usize> {
    from: f64,
    middle: f64,
    features: Features<Series<N>>,
    /// Whether the excess is `f`, times something above 0.
    is_volume: bool,
}

impl<const N: usize> Part<N> {
    /// With the features that are nearest at a place, or, without a radius, both sides inside.
    fn new<K: Stages, const FIRST: usize, const SECOND: usize>(
        query: &Turning<FIRST, SECOND>,
        [from, to]: [f64; 2],
        spot: Option<&Spot>,
    ) -> Option<Self> {
        let middle = from + 0.5 * (to - from);
        let differences = Differences::<Series<N>>::new::<K, FIRST, SECOND>(query, middle);
        let n = cross(&differences.k.vector, &differences.l.vector);
        Some(Part {
            from,
            middle,
            features: Features::new(&differences, &n, spot, query.radius)?,
            is_volume: spot.is_none(),
        })
    }

    /// The first contact, if it is certain that it is near the guess.
    fn touch<K: Stages, const FIRST: usize, const SECOND: usize>(
        &self,
        query: &Turning<FIRST, SECOND>,
        guess: f64,
        spot: Option<&Spot>,
    ) -> Option<Touch> {
        let now = |time: Ball| Now::new::<K, FIRST, SECOND>(query, time, spot);
        let excess = |time: Ball| now(time).map_or(Ball::UNKNOWN, |now| now.features.excess);
        let root = root_after(&self.features.excess, self.middle, self.from, guess, excess)?;
        // Before it they are apart: with a radius, farther than that.
        let is_first = self.is_volume || root.before.is_gt();
        if !is_first || !self.holds_until(root.bracket[1]) {
            return None;
        }
        let now = now(root.time)?;
        let side = match self.is_volume {
            true => root.before,
            false => now.side()?,
        };
        now.touch::<K>(root.bracket, side)
    }

    /// Whether the features are certainly the nearest ones from the start of the part until then.
    fn holds_until(&self, to: f64) -> bool {
        let reach = self.reach(to);
        let mut conditions = self.features.throughout.iter();
        conditions.all(|condition| condition.sign_within(reach) == ABOVE)
    }

    /// Whether there is certainly no contact from the start of the part until then.
    fn is_clear(&self, to: f64) -> bool {
        let sign = self.features.excess.sign_within(self.reach(to));
        let is_apart = sign == ABOVE || self.is_volume && sign.is_some();
        is_apart && self.holds_until(to)
    }

    /// Not below what is between the middle and either end.
    fn reach(&self, to: f64) -> f64 {
        (self.middle - self.from).max(to - self.middle) * UP
    }
}

/// The two sides at one time.
struct Now {
    differences: Differences<Ball>,
    /// A positive multiple of `K x L`.
    n: Vector<Ball>,
    features: Features<Ball>,
}

impl Now {
    fn new<K: Stages, const FIRST: usize, const SECOND: usize>(
        query: &Turning<FIRST, SECOND>,
        time: Ball,
        spot: Option<&Spot>,
    ) -> Option<Self> {
        let differences = Differences::<Ball>::new::<K, FIRST, SECOND>(query, time);
        let n = cross(&differences.k.vector, &differences.l.vector);
        Some(Now {
            features: Features::new(&differences, &n, spot, query.radius)?,
            differences,
            n,
        })
    }

    /// The sign of `f`, if it is certain that it is not 0.
    fn side(&self) -> Option<Ordering> {
        dot(&self.differences.m, &self.n).sign()
    }

    /// The contact at this time, if its place is certain.
    fn touch<K: Stages>(&self, toi: [f64; 2], side: Ordering) -> Option<Touch> {
        // A face has no angle.
        let is_at_angle = K::FIRST == 1 || self.n.iter().any(|n| n.sign().is_some());
        let place = place::<K>(&self.features.nearest, &self.differences, &self.n)?;
        is_at_angle.then_some(Touch { toi, side, place })
    }
}

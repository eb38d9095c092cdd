//! The certified path for a radius above 0: the distance of two edges, or of a vertex and a face.
//!
//! 1. The swept boxes are farther apart than the radius (`separate`).
//! 2. The direction from middle to middle separates them by more than the radius for the whole step
//!    (`advance`).
//! 3. A plane that stays does so, between the points that are nearest where that direction fails;
//!    or others, which turn with the two (`turning`), do so for one part of the step after the
//!    other, up to its end or to the contact (`advance`). There the squared distance of the points
//!    that are nearest, in double-double arithmetic, and a bound on how far these move (`nearness`)
//!    hold the time of impact between neighbours in `f64` (`refine_toi`). Points that are near at
//!    the start are a contact there. The rest of the answer is bounded in `f64` too (`contact`).
//!    Where edges are parallel, or one is a point, words say where they are nearest; where a time of
//!    impact may be an `f64` itself, the distance there is compared in integers (`exact::thick`).
//!    Double-double arithmetic says at which end edges are nearest that are parallel but for
//!    rounding (`nearly_parallel`), whether the two are within the radius at the start, and, by a
//!    plane between their nearest points, that they stay apart (`sharp_plane`).
//! 4. Integers decide what is left (`exact::thick`): edges that may be parallel where they touch,
//!    grazes.
//!
//! For several queries at once, the first correction of the time, without a branch, finds most
//! contacts (`touch`).
//!
//! The proofs need no case distinction: a plane between two sides bounds their distance from below,
//! two points bound it from above, wherever they come from.

mod advance;
mod contact;
mod doubled;
mod instant;
mod nearly_parallel;
mod nearness;
mod refine_toi;
mod sharp_plane;
#[cfg(test)]
mod testing;
mod touch;
mod turning;

use wide::f64x2;

use super::ends::Ends;
use super::kind::Stages;
use super::motion::{Positions, dot};
use super::nearest::Spot;
use super::separate::U;
use super::stage::{Finding, Stage};
use crate::contact::Hit;
use crate::query::Radius;
pub(super) use advance::Reached;
pub(super) use advance::rounded_up;
use advance::{Advance, Moving, Plane};
use contact::contact;
use doubled::excess;
use instant::Instant;
use refine_toi::{RefinedToi, refine_toi};
pub(super) use touch::Touch;

/// The distance of the two sides at the start, about.
pub(super) fn start_distance<K: Stages>(positions: &Positions) -> f64 {
    let moving = Moving::new::<K>(&positions.points::<f64x2>(), 0.0);
    let difference = Instant::new::<K, _>(&moving, 0.0).difference;
    dot(&difference, &difference).sqrt()
}

/// Whether the swept boxes are farther apart than a radius, which is [`rounded_up`], and up to when
/// the direction from middle to middle separates the two by more than it: 1 or more for the whole
/// step.
#[inline(always)]
pub(super) fn apart_until_by_centres<K: Stages, E: Ends>(
    points: &[[E; 3]; 4],
    radius: f64,
) -> (bool, f64) {
    let moving = Moving::new::<K>(points, radius);
    let proved = moving.stays_apart_by_centres::<K>();
    (moving.boxes.are_disjoint, proved)
}

/// Whether the plane between the points that are nearest at a time separates the two by more than
/// the radius for the whole step.
#[inline(always)]
pub(super) fn are_apart_from<K: Stages, E: Ends>(
    points: &[[E; 3]; 4],
    radius: f64,
    t: f64,
) -> bool {
    let moving = Moving::new::<K>(points, radius);
    let here = Instant::new::<K, E>(&moving, t);
    moving.is_separated_by::<K>(&here.difference)
}

/// What the next plane that turns proves, from a time on.
#[inline(always)]
pub(super) fn next_plane<K: Stages, E: Ends>(points: &[[E; 3]; 4], radius: f64, t: f64) -> Plane {
    let moving = Moving::new::<K>(points, radius);
    moving.next_plane::<K>(&Instant::new::<K, E>(&moving, t), t)
}

/// Up to when the two sides are certainly farther apart than a radius above 0, as far as planes
/// prove it: 1 for the whole step, 0 if that is not proved of any part.
#[inline(always)]
pub(super) fn apart_until<K: Stages>(points: &[[f64x2; 3]; 4], radius: Radius) -> f64 {
    let moving = Moving::new::<K>(points, rounded_up(radius));
    if moving.boxes.are_disjoint {
        return 1.0;
    }
    let proved = moving.stays_apart_by_centres::<K>();
    if proved >= 1.0 {
        return 1.0;
    }
    apart_until_by_planes::<K>(&moving, proved)
}

#[inline(never)]
fn apart_until_by_planes<K: Stages>(moving: &Moving<f64x2>, proved: f64) -> f64 {
    match moving.advance::<K>(Reached::ByCentres(proved)) {
        Advance::Apart => 1.0,
        Advance::Until(proved) => proved,
        Advance::Near => 0.0,
    }
}

/// Whether the two sides are certainly within a radius above 0 of each other at the start.
pub(super) fn starts_within<K: Stages>(positions: &Positions, radius: Radius) -> bool {
    let moving = Moving::new::<K>(&positions.points::<f64x2>(), rounded_up(radius));
    moving.is_ordinary() && moving.is_within(&Instant::new::<K, _>(&moving, 0.0), radius)
}

/// When the two sides first come within a radius above 0, rounded down: without a place, which is
/// the dear part where they start within it and are nearest in more than one place.
#[inline(always)]
pub(super) fn toi<K: Stages>(positions: &Positions, radius: Radius) -> Option<f64> {
    let moving = Moving::new::<K>(&positions.points::<f64x2>(), rounded_up(radius));
    if moving.boxes.are_disjoint {
        return None;
    }
    let proved = moving.stays_apart_by_centres::<K>();
    if proved >= 1.0 {
        return None;
    }
    toi_open::<K>(positions, &moving, radius, proved)
}

#[inline(never)]
fn toi_open<K: Stages>(
    positions: &Positions,
    moving: &Moving<f64x2>,
    radius: Radius,
    proved: f64,
) -> Option<f64> {
    let is_open = proved == 0.0 && moving.is_ordinary();
    if is_open && moving.is_within(&Instant::new::<K, _>(moving, 0.0), radius) {
        return Some(0.0);
    }
    let reached = Reached::ByCentres(proved);
    decide_open::<K>(&|| *positions, moving, radius, reached, &mut |_| {}).map(|hit| hit.toi)
}

/// The first contact within a radius above 0, by all stages.
#[inline(always)]
pub(super) fn decide<K: Stages>(
    positions: impl Fn() -> Positions,
    radius: Radius,
    observe: &mut impl FnMut(Stage),
) -> Option<Hit<K::Place>> {
    let moving = Moving::new::<K>(&positions().points::<f64x2>(), rounded_up(radius));
    if moving.boxes.are_disjoint {
        observe(Stage::Boxes);
        return None;
    }
    let proved = moving.stays_apart_by_centres::<K>();
    if proved >= 1.0 {
        observe(Stage::Direction);
        return None;
    }
    decide_open::<K>(
        &positions,
        &moving,
        radius,
        Reached::ByCentres(proved),
        observe,
    )
}

/// The first contact within a radius above 0, by the stages after those that have reached a time.
pub(super) fn decide_from<K: Stages>(
    positions: &Positions,
    radius: Radius,
    reached: Reached,
    observe: &mut impl FnMut(Stage),
) -> Option<Hit<K::Place>> {
    let moving = Moving::new::<K>(&positions.points::<f64x2>(), rounded_up(radius));
    decide_open::<K>(&|| *positions, &moving, radius, reached, observe)
}

/// What the first two stages leave open; not inlined, so that these stay small.
#[inline(never)]
fn decide_open<K: Stages>(
    positions: &impl Fn() -> Positions,
    moving: &Moving<f64x2>,
    radius: Radius,
    reached: Reached,
    observe: &mut impl FnMut(Stage),
) -> Option<Hit<K::Place>> {
    match decide_by_planes::<K>(positions, moving, radius, reached) {
        Finding::Hit(hit) => {
            observe(Stage::Planes);
            Some(hit)
        }
        Finding::Miss => {
            observe(Stage::Planes);
            None
        }
        Finding::Undecided => {
            observe(Stage::Exact);
            K::decide_thick_exactly(&positions(), radius)
        }
    }
}

/// The contact, if any, as far as `f64` and double-double arithmetic prove it.
fn decide_by_planes<K: Stages>(
    positions: &impl Fn() -> Positions,
    moving: &Moving<f64x2>,
    radius: Radius,
    reached: Reached,
) -> Finding<Hit<K::Place>> {
    let refined = match moving.advance::<K>(reached) {
        Advance::Apart => return Finding::Miss,
        _ if !moving.is_ordinary() => return Finding::Undecided,
        Advance::Near => {
            let (positions, start) = (positions(), Instant::new::<K, _>(moving, 0.0));
            if !moving.is_within(&start, radius)
                && !moving.is_within_sharply::<K>(&positions, radius, &start)
            {
                // Apart at the start, if they are, by less than `f64` can tell.
                refine_toi::<K>(&positions, moving, radius, 0.0)
            } else if let Some(near) = moving.near_start::<K>(&start) {
                Finding::Hit(near)
            } else if let Some(hit) = K::contact_of_parallel(&positions, [0.0; 2]) {
                return Finding::Hit(hit);
            } else {
                Finding::of_certain(moving.near_start_at_boundary::<K>(&positions, &start))
            }
        }
        Advance::Until(proved) => refine_toi::<K>(&positions(), moving, radius, proved),
    };
    refined.and_then(|refined| {
        let positions = positions();
        Finding::of_certain(match refined.is_parallel {
            true => K::contact_of_parallel(&positions, refined.toi),
            false => contact::<K>(&positions, moving, &refined),
        })
    })
}

impl Moving<f64x2> {
    /// Whether squares, and their errors in double-double arithmetic, neither over- nor underflow.
    fn is_ordinary(&self) -> bool {
        self.radius > SMALLEST && self.radius < LARGEST && self.boxes.size() < LARGEST
    }

    /// The contact at the start, at which two points are within the radius of each other.
    fn near_start<K: Stages>(&self, start: &Instant) -> Option<RefinedToi> {
        let nearness = self.nearness::<K>(start, 0.0)?;
        RefinedToi::new([0.0; 2], start.spot, &nearness)
    }

    /// The same as [`is_within`](Self::is_within) to twice the precision, at the place or at one on
    /// the boundary.
    #[inline(never)]
    fn is_within_sharply<K: Stages>(
        &self,
        positions: &Positions,
        radius: Radius,
        start: &Instant,
    ) -> bool {
        let (points, (_, size)) = (positions.points::<f64x2>(), self.reaches());
        let is_within = |spot: Spot| {
            let (x, error) = excess::<K, _>(&points, radius.parts(), 0.0, &spot, &size);
            x * (1.0 - 2.0 * U) < -error
        };
        is_within(start.spot) || K::nearest_on_sides(&start.gram).into_iter().any(is_within)
    }

    /// The same of edges that are nearly parallel.
    #[inline(never)]
    fn near_start_at_boundary<K: Stages>(
        &self,
        positions: &Positions,
        start: &Instant,
    ) -> Option<RefinedToi> {
        let mut spots = K::nearest_on_sides(&start.gram).into_iter();
        spots.find_map(|spot| {
            let start = start.at_spot(spot);
            let nearness = self.nearness_at_boundary::<K>(positions, &start, 0.0, 0.0)?;
            RefinedToi::new([0.0; 2], spot, &nearness)
        })
    }

    /// Whether the points of a place at the start are certainly within the radius of each other.
    ///
    /// With the size `e` of the box around all points, a component of the difference is within
    /// `12 u e` of the exact one; its length then within `12 u |e|`, and computed with a relative
    /// error below `4 u`. Where squares underflow both lengths are off by less than `2^-536`, which
    /// is nothing beside an ulp of the radius.
    fn is_within(&self, start: &Instant, radius: Radius) -> bool {
        let length = dot(&start.difference, &start.difference).sqrt();
        let high = (length + 16.0 * U * self.boxes.size()) * (1.0 + 16.0 * U) + f64::MIN_POSITIVE;
        length.is_finite() && high <= radius.rounded().next_down()
    }
}

/// 2^-200.
const SMALLEST: f64 = f64::from_bits((1023 - 200) << 52);

/// 2^180.
const LARGEST: f64 = f64::from_bits((1023 + 180) << 52);

//! Conservative advancement: planes that keep the two sides more than the radius apart, each for a
//! part of the step, until the step ends or they are no farther apart than rounding can tell.
//!
//! The first plane's normal is the direction from middle to middle of the motion, the second one's
//! that between the points that are nearest where the first one fails; both stay
//! ([`Moving::stays_apart_by`]). Then they turn ([`Turning`]): taken from the nearest points at the
//! time reached, such a plane is the best there is up to the second order, and so is the next time:
//! it is Newton's method from the safe side (after Mirtich, "Impulse-based dynamic simulation of
//! rigid body systems", 1996, who advances by bounds on speeds).

use super::instant::Instant;
use super::turning::Turning;
use crate::certified::ends::Ends;
use crate::certified::kind::Stages;
use crate::certified::motion::{Motion, Vector, add, both, dot, scaled, sub};
use crate::certified::separate::{SweptBoxes, U};
use crate::query::Radius;

/// A query in `f64`.
pub(super) struct Moving<E> {
    /// `K`, `L` and `M` of the shape.
    pub(super) motion: Motion<E>,
    pub(super) boxes: SweptBoxes,
    /// Not below the radius, and above it by no more than some `u`.
    pub(super) radius: f64,
}

/// How far it is proved that they are more than the radius apart.
#[derive(Clone, Copy, Debug)]
pub(super) enum Advance {
    /// During the whole step.
    Apart,
    /// Up to this time, at which they are about the radius apart.
    Until(f64),
    /// Not even at the start.
    Near,
}

/// How far planes have been tried.
#[derive(Clone, Copy, Debug)]
pub(in crate::certified) enum Reached {
    /// The direction from middle to middle proves so much.
    ByCentres(f64),
    /// Planes that turn prove so much.
    ByPlanes {
        t: f64,
        /// How many there have been.
        planes: u32,
        /// Whether another one would not lead farther.
        is_last: bool,
    },
}

/// What a plane that turns proves.
#[derive(Clone, Copy, Debug)]
pub(in crate::certified) struct Plane {
    /// That they are apart for the whole step.
    pub(in crate::certified) is_apart: bool,
    /// Else that they are up to this time.
    pub(in crate::certified) t: f64,
    /// Whether another plane would not lead farther.
    pub(in crate::certified) is_last: bool,
}

const MOST_PLANES: u32 = 24;

/// `K`, `L` and `M` of the shape.
#[inline(always)]
pub(super) fn differences<K: Stages, E: Ends>(points: &[[E; 3]; 4]) -> Motion<E> {
    let [k, l, m] = K::DIFFERENCES;
    Motion {
        k: sub(&points[k.1], &points[k.0]),
        l: sub(&points[l.1], &points[l.0]),
        m: sub(&points[m.1], &points[m.0]),
    }
}

impl<E: Ends> Moving<E> {
    #[inline(always)]
    pub(super) fn new<K: Stages>(points: &[[E; 3]; 4], radius: f64) -> Self {
        Moving {
            motion: differences::<K, E>(points),
            boxes: K::boxes(points, radius * (1.0 + 4.0 * U)),
            radius,
        }
    }

    /// How far certainly beyond the radius, times the length of the normal, all corners are on a
    /// plane's side, at the start and at the end; neither is above 0 unless that is a proof.
    ///
    /// The least product of a corner with `n` is a concave function of time, not below the line
    /// from its value at the start to that at the end.
    ///
    /// Error bound: the products with `n` at both ends are within [`SweptBoxes::bound`] of the
    /// exact ones, `|n|` within `4 u`. NaN and infinities prove nothing, nor does what underflows.
    #[inline(always)]
    fn margins<K: Stages>(&self, n: &Vector) -> [f64; 2] {
        let square = dot(n, n);
        let least = self.radius * square.sqrt() * (1.0 + 8.0 * U) + self.boxes.bound(n);
        let along = both(n);
        let Motion { k, l, m } = &self.motion;
        let corner = K::least_corner(dot(k, &along), dot(l, &along), dot(m, &along));
        let is_proof = (square > SMALLEST) & (square < LARGEST) & (least < LARGEST);
        let least = if is_proof { least } else { f64::INFINITY };
        [corner.start() - least, corner.end() - least]
    }

    /// Up to when a plane with this normal certainly keeps them more than the radius apart, if not
    /// for the whole step: then 1 or more; 0 if not even at the start.
    ///
    /// What is computed from the margins passes three roundings, which `8 u` outweigh. Nothing
    /// underflows: a margin above 0 is not below `2 u` of what is taken from it, which is at least
    /// `24 u` of all that the other one is made of.
    #[inline(always)]
    pub(super) fn stays_apart_by<K: Stages>(&self, n: &Vector) -> f64 {
        let [start, end] = self.margins::<K>(n);
        match (start > 0.0, end > 0.0) {
            (true, true) => 1.0,
            (true, false) => start / (start - end) * (1.0 - 8.0 * U),
            (false, _) => 0.0,
        }
    }

    /// Whether it does so for the whole step.
    #[inline(always)]
    pub(super) fn is_separated_by<K: Stages>(&self, n: &Vector) -> bool {
        let [start, end] = self.margins::<K>(n);
        (start > 0.0) & (end > 0.0)
    }

    /// The same as [`stays_apart_by`](Self::stays_apart_by) for the direction from the middle of
    /// one side's motion to that of the other.
    #[inline(always)]
    pub(super) fn stays_apart_by_centres<K: Stages>(&self) -> f64 {
        self.stays_apart_by::<K>(&self.between_centres::<K>())
    }

    /// The direction from the middle of one side's motion to that of the other.
    #[inline(always)]
    fn between_centres<K: Stages>(&self) -> Vector {
        let Motion { k, l, m } = &self.motion;
        let sum = |[x, y, z]: &[E; 3]| [x.sum(), y.sum(), z.sum()];
        let (u, v) = K::MIDDLE;
        difference(&[sum(k), sum(l), sum(m)], u, v)
    }

    /// Advances from a time up to which they are apart.
    pub(super) fn advance<K: Stages>(&self, reached: Reached) -> Advance {
        let (mut t, mut planes) = match reached {
            Reached::ByCentres(t) => (t, 0),
            Reached::ByPlanes { t, is_last, .. } if is_last => return Advance::until(t),
            Reached::ByPlanes { t, planes, .. } => (t, planes),
        };
        let mut here = Instant::new::<K, E>(self, t);
        // Most sides that stay apart turn little.
        let is_first = matches!(reached, Reached::ByCentres(_));
        if is_first && self.is_separated_by::<K>(&here.difference) {
            return Advance::Apart;
        }
        // Ends: after so many planes, at the end of the step or not.
        while planes < MOST_PLANES {
            let plane = self.next_plane::<K>(&here, t);
            if plane.is_apart {
                return Advance::Apart;
            }
            t = plane.t;
            if plane.is_last {
                break;
            }
            here = Instant::new::<K, E>(self, t);
            planes += 1;
        }
        Advance::until(t)
    }

    /// The plane that turns, from a time on.
    #[inline(always)]
    pub(super) fn next_plane<K: Stages>(&self, here: &Instant, t: f64) -> Plane {
        // Not below what is left.
        let left = (1.0 - t) * (1.0 + 2.0 * U);
        let step = self.stays_apart_turning::<K>(here, &Turning::new(here), left);
        // Not above the time that is reached.
        let next = (t + step) * (1.0 - 2.0 * U);
        let is_later = next > t;
        Plane {
            is_apart: step >= left,
            t: if is_later { next } else { t },
            is_last: !is_later | (step < next * SHORT),
        }
    }
}

impl Advance {
    fn until(t: f64) -> Self {
        if t > 0.0 {
            Advance::Until(t)
        } else {
            Advance::Near
        }
    }
}

/// Not below the sum of both radii, and above it by no more than `4 u`.
pub(in crate::certified) fn rounded_up(radius: Radius) -> f64 {
    radius.rounded().next_up()
}

/// `M + v L - u K`.
#[inline(always)]
pub(super) fn difference([k, l, m]: &[Vector; 3], u: f64, v: f64) -> Vector {
    sub(&add(m, &scaled(v, l)), &scaled(u, k))
}

/// A step so short that the next one, of its square, is as short as what is left to
/// [`refine_toi`](super::refine_toi).
const SHORT: f64 = 1.0 / (1u64 << 20) as f64;

/// 2^-900: squares above it lose nothing to underflow.
pub(super) const SMALLEST: f64 = f64::from_bits((1023 - 900) << 52);

/// 2^900.
pub(super) const LARGEST: f64 = f64::from_bits((1023 + 900) << 52);

#[cfg(test)]
mod tests;

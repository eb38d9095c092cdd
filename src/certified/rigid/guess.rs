//! About when two sides come within the radius, in `f64`. Heuristic: nothing that is proved rests on
//! it.

use super::Moving;
use crate::certified::ends::{Ends, Plain};
use crate::certified::kind::Stages;
use crate::certified::motion::{Vector, add, cross, dot, scaled, sub};
use crate::certified::nearest::{Gram, Spot};
use crate::query::Radius;

/// The first step in which a change of sign is looked for, as a part of the time step.
const FIRST_STEP: f64 = 1.0 / 1024.0;

/// The most steps of the secant method.
const STEPS: usize = 60;

impl<const FIRST: usize, const SECOND: usize> Moving<'_, FIRST, SECOND> {
    /// The places of all points at a time.
    pub(super) fn places_at(&self, t: f64) -> [Vector; 4] {
        let both = self.places(Plain::both(t));
        both.map(|point| point.map(Plain::start))
    }

    /// `K`, `L` and `M` at a time.
    fn differences<K: Stages>(&self, t: f64) -> [Vector; 3] {
        let points = self.places_at(t);
        K::DIFFERENCES.map(|(from, to)| sub(&points[to], &points[from]))
    }

    /// Where they are nearest at a time, and how far apart they are there.
    pub(super) fn nearest<K: Stages>(&self, t: f64) -> (Spot, f64) {
        let vectors = self.differences::<K>(t);
        let spot = K::nearest(&Gram::new(&vectors));
        let [k, l, m] = &vectors;
        let difference = sub(&add(m, &scaled(spot.v, l)), &scaled(spot.u, k));
        (spot, dot(&difference, &difference).sqrt())
    }

    /// When they first come within the radius after a time; without one, when all points are in a
    /// plane.
    pub(super) fn guess<K: Stages>(&self, radius: Radius, from: f64) -> Option<f64> {
        let radius = radius.rounded();
        let excess = |t: f64| match radius > 0.0 {
            true => self.nearest::<K>(t).1 - radius,
            false => {
                let [k, l, m] = &self.differences::<K>(t);
                dot(&cross(k, l), m)
            }
        };
        let first = excess(from);
        let sign = first.signum();
        let (mut low, mut at_low) = (from, sign * first);
        let mut length = FIRST_STEP;
        // Ends: parts grow, up to the end of the step.
        let (mut high, mut at_high) = loop {
            let t = f64::min(low + length, 1.0);
            let value = sign * excess(t);
            if value < 0.0 {
                break (t, value);
            }
            if t == 1.0 {
                return None;
            }
            (low, at_low) = (t, value);
            length *= 1.5;
        };
        // The Illinois method: the end that stays counts half.
        for _ in 0..STEPS {
            let t = (low * at_high - high * at_low) / (at_high - at_low);
            if !(t > low && t < high) {
                break;
            }
            let value = sign * excess(t);
            if value < 0.0 {
                (high, at_high) = (t, value);
                at_low *= 0.5;
            } else {
                (low, at_low) = (t, value);
                at_high *= 0.5;
            }
        }
        Some(if low > from { low } else { high })
    }
}

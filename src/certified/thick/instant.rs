//! The two sides at one time, about: where they are nearest, and how that moves.

use super::advance::{Moving, difference};
use crate::certified::ends::Ends;
use crate::certified::kind::Stages;
use crate::certified::locate::at;
use crate::certified::motion::{Motion, Vector, scaled, sub};
use crate::certified::nearest::{Direction, Gram, Spot};

/// The two sides at a time. Not certified: proofs that start here bound its errors.
pub(super) struct Instant {
    /// `K`, `L` and `M`.
    pub(super) at: [Vector; 3],
    /// Their changes in a whole step.
    pub(super) change: [Vector; 3],
    /// Scalar products of these vectors.
    pub(super) gram: Gram,
    /// The nearest place.
    pub(super) spot: Spot,
    /// The difference there.
    pub(super) difference: Vector,
}

impl Instant {
    #[inline(always)]
    pub(super) fn new<K: Stages, E: Ends>(moving: &Moving<E>, t: f64) -> Self {
        let Motion { k, l, m } = &moving.motion;
        let vectors = [at(k, t), at(l, t), at(m, t)];
        let gram = Gram::new(&vectors);
        let spot = K::nearest(&gram);
        Instant {
            change: [change(k), change(l), change(m)],
            difference: difference(&vectors, spot.u, spot.v),
            spot,
            gram,
            at: vectors,
        }
    }

    /// The same time with another place.
    pub(super) fn at_spot(&self, spot: Spot) -> Self {
        Instant {
            at: self.at,
            change: self.change,
            gram: self.gram,
            difference: difference(&self.at, spot.u, spot.v),
            spot,
        }
    }

    /// How the difference changes along both directions of the spot.
    #[inline(always)]
    pub(super) fn along(&self) -> [Vector; 2] {
        let [first, second] = &self.spot.directions;
        [along(first, &self.at), along(second, &self.at)]
    }

    /// The change of the difference in a whole step, with the place kept.
    #[inline(always)]
    pub(super) fn velocity(&self) -> Vector {
        difference(&self.change, self.spot.u, self.spot.v)
    }
}

#[inline(always)]
fn along(direction: &Direction, [k, l, _]: &[Vector; 3]) -> Vector {
    sub(&scaled(direction.v, l), &scaled(direction.u, k))
}

#[inline(always)]
fn change<E: Ends>([x, y, z]: &[E; 3]) -> Vector {
    let change = |x: &E| x.end() - x.start();
    [change(x), change(y), change(z)]
}

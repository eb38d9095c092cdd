//! Two features of the two sides: when these are nearest, and how far they are apart.
//!
//! The distance of the two sides is that of the set of `M + v L - u K` from 0 ([`Differences`]). The
//! set is convex, so that a point `P` of it is nearest to 0 where no direction into the set leads
//! nearer: `P . V >= 0`. For a corner, a side, or the set without its boundary, these are the signs
//! of a few polynomials, and so is that of the distance less the radius:
//!
//! | nearest | 0 in contact | above 0 where it is nearest |
//! | --- | --- | --- |
//! | corner `P` | `P . P - R^2` | `P . V` for both sides from there |
//! | side from `P` along `V` | `\|P x V\|^2 - R^2 V . V` | `-P . V`, `(P + V) . V`, `Q . W`, with `Q` the foot of 0, `W` into the set |
//! | inside | `(M . N)^2 - R^2 N . N`; `M . N` without a radius | `u`, `v` and `1 - u`, `1 - v`, or `1 - u - v` |
//!
//! Inside, the signs matter in contact alone: before it the whole set is in the plane across `N`, and
//! so nowhere nearer than that.

use super::ball::Ball;
use super::differences::{Arm, Differences};
use super::term::{Term, Vector, add, cross, dot, neg, scaled, sub};
use crate::certified::nearest::{Direction, Spot};
use crate::query::Radius;

/// What decides contact of two features.
pub(super) struct Features<T> {
    /// 0 where they are as far apart as the radius; without a radius, where `f` is 0.
    pub(super) excess: T,
    /// Above 0 at all times at which these are the nearest.
    pub(super) throughout: Vec<T>,
    pub(super) nearest: Nearest<T>,
}

/// Where they are nearest, as the way to compute it.
pub(super) enum Nearest<T> {
    /// Where `M + v L - u K` is a multiple of `N`: the nearest points are inside if `(u, v)` is.
    Inside,
    /// At a corner.
    Corner([f64; 2]),
    /// On a side, from one corner to another one, at the foot of 0.
    Side {
        from: [f64; 2],
        to: [f64; 2],
        /// `above / below` is the part of the side before it.
        above: T,
        below: T,
    },
}

impl<T: Term> Features<T> {
    /// The features that are nearest at a place; without a radius, and so without a place, both sides
    /// inside. `N` is a positive multiple of `K x L`.
    pub(super) fn new(
        of: &Differences<T>,
        n: &Vector<T>,
        spot: Option<&Spot>,
        radius: Radius,
    ) -> Option<Self> {
        let Some(spot) = spot else {
            return Some(Self::inside(dot(&of.m, n)));
        };
        // D R, squared.
        let reach = T::constant(Ball::sum(radius.parts())).times(&of.d);
        let reach = reach.times(&reach);
        let [first, second] = &spot.directions;
        match (first.is_free, second.is_free) {
            (true, true) => {
                let f = dot(&of.m, n);
                let far = reach.times(&dot(n, n));
                Some(Self::inside(f.times(&f).minus(&far)))
            }
            (true, false) => Self::side(of, spot, [first, second], &reach),
            (false, true) => Self::side(of, spot, [second, first], &reach),
            (false, false) => Self::corner(of, spot, &reach),
        }
    }

    /// Where no boundary is in the way.
    fn inside(excess: T) -> Self {
        Features {
            excess,
            throughout: Vec::new(),
            nearest: Nearest::Inside,
        }
    }

    fn corner(of: &Differences<T>, spot: &Spot, reach: &T) -> Option<Self> {
        let p = of.corner([spot.u, spot.v])?;
        let ways = spot.directions.iter().map(|way| of.way(way));
        let throughout = ways.map(|way| Some(dot(&p, &way?.vector)));
        Some(Features {
            excess: dot(&p, &p).minus(reach),
            throughout: throughout.collect::<Option<_>>()?,
            nearest: Nearest::Corner([spot.u, spot.v]),
        })
    }

    /// The side through a place along the first direction, of which the second one leads into the
    /// set.
    fn side(
        of: &Differences<T>,
        spot: &Spot,
        [free, inward]: [&Direction; 2],
        reach: &T,
    ) -> Option<Self> {
        // The end from which the side leaves along the direction.
        let end = |at: f64, along: f64| match along {
            along if along > 0.0 => 0.0,
            along if along < 0.0 => 1.0,
            _ => at,
        };
        let from = [end(spot.u, free.u), end(spot.v, free.v)];
        let to = [from[0] + free.u, from[1] + free.v];
        let p = of.corner(from)?;
        let (way, inward) = (of.way(free)?, of.way(inward)?);
        let v = &way.vector;
        let (square, above) = (dot(v, v), dot(&p, v).negative());
        // V . V times D Q.
        let foot = add(&scaled(&square, &p), &scaled(&above, v));
        let moment = cross(&p, v);
        let excess = dot(&moment, &moment).minus(&reach.times(&square));
        let below = match way.rests {
            true => of.d.times(&square),
            false => square,
        };
        let throughout = vec![
            above.clone(),
            below.minus(&above),
            dot(&foot, &inward.vector),
        ];
        Some(Features {
            excess,
            throughout,
            nearest: Nearest::Side {
                from,
                to,
                above,
                below,
            },
        })
    }
}

impl<T: Term> Differences<T> {
    /// `D (M + v L - u K)` at a corner; `None` if it is none.
    fn corner(&self, [u, v]: [f64; 2]) -> Option<Vector<T>> {
        let full = |arm: &Arm<T>| match arm.rests {
            true => scaled(&self.d, &arm.vector),
            false => arm.vector.clone(),
        };
        let is_corner = [u, v].iter().all(|at| *at == 0.0 || *at == 1.0);
        let mut p = self.m.clone();
        if v == 1.0 {
            p = add(&p, &full(&self.l));
        }
        if u == 1.0 {
            p = sub(&p, &full(&self.k));
        }
        is_corner.then_some(p)
    }

    /// The vector along a direction; `None` if a part of it rests and another one does not.
    fn way(&self, &Direction { u, v, .. }: &Direction) -> Option<Arm<T>> {
        let along = |arm: &Arm<T>, factor: f64| Arm {
            vector: match factor > 0.0 {
                true => arm.vector.clone(),
                false => neg(&arm.vector),
            },
            rests: arm.rests,
        };
        match (u != 0.0, v != 0.0) {
            (true, false) => Some(along(&self.k, -u)),
            (false, true) => Some(along(&self.l, v)),
            (true, true) if self.k.rests == self.l.rests => Some(Arm {
                vector: add(&along(&self.k, -u).vector, &along(&self.l, v).vector),
                rests: self.k.rests,
            }),
            _ => None,
        }
    }
}

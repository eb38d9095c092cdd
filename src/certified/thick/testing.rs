//! What the tests of the stages share: a query in `f64`, and the same exactly.

use wide::f64x2;

use super::advance::Moving;
use crate::certified::kind::Stages;
use crate::certified::motion::Positions;
use crate::certified::testing::{Exact, Number, Search, dot, layout};

/// How long to look for the worst inputs.
pub(super) fn search(seed: u64) -> Search {
    Search {
        seed,
        climbs: if cfg!(debug_assertions) { 2 } else { 6 },
        starts: 200,
        steps: 1500,
    }
}

pub(super) struct Sample {
    pub(super) positions: Positions,
    pub(super) moving: Moving<f64x2>,
    exact: Exact,
}

impl Sample {
    /// From 24 coordinates.
    pub(super) fn new<K: Stages>(coordinates: &[f64], radius: f64) -> Self {
        let positions = layout(coordinates);
        Sample {
            moving: Moving::new::<K>(&positions.points(), radius),
            exact: Exact::of(&positions, K::DIFFERENCES.map(|(from, to)| (to, from))),
            positions,
        }
    }

    /// The exact `K`, `L` and `M` at a time.
    pub(super) fn at(&self, t: &Number) -> [[Number; 3]; 3] {
        let Exact { k, l, m, .. } = &self.exact;
        [k, l, m].map(|x| x.each_ref().map(|p| p.at(t)))
    }

    /// The exact difference of the points of a place at a time.
    pub(super) fn difference(&self, t: &Number, [u, v]: &[Number; 2]) -> [Number; 3] {
        let [k, l, m] = self.at(t);
        [0, 1, 2].map(|i| &(&m[i] + &(v * &l[i])) - &(u * &k[i]))
    }

    /// The least exact product of a corner with a vector at a time.
    pub(super) fn least_corner<K: Stages>(&self, t: &Number, n: &[Number; 3]) -> Number {
        let corners = K::CORNERS.iter().map(|&(u, v)| {
            let difference = self.difference(t, &[u, v].map(Number::from));
            dot(&difference, n)
        });
        corners.reduce(Number::smaller).expect("a corner")
    }
}

//! What the tests of the stages share: a query in `f64`, and the same exactly.

use wide::f64x2;

use super::advance::Moving;
use super::nearness::Nearness;
use crate::certified::kind::Stages;
use crate::certified::motion::Positions;
use crate::certified::nearest::Spot;
use crate::certified::testing::{Claim, Exact, Number, Random, Search, dot, layout, points};

/// How long to look for the worst inputs.
pub(super) fn search(seed: u64) -> Search {
    Search {
        seed,
        climbs: if cfg!(debug_assertions) { 2 } else { 6 },
        starts: 200,
        steps: 1500,
    }
}

/// Edges that are parallel but for a little, and stay so but for a little.
pub(super) fn nearly_parallel(random: &mut Random) -> [f64; 24] {
    let mut x = points(random, (-4, 4));
    let noise = |random: &mut Random| random.signed() * 2f64.powi(-random.whole(20, 60));
    // Coordinate `3 p + i` at the start, `12 + 3 p + i` at the end.
    let (length, speed) = (random.signed() * 2.0, random.unit());
    for i in 0..3 {
        let edge = x[3 + i] - x[i];
        x[9 + i] = x[6 + i] + length * edge + noise(random);
        let step = [random.signed() * speed, random.signed() * speed];
        for (p, step) in [(0, step[0]), (1, step[0]), (2, step[1]), (3, step[1])] {
            x[12 + 3 * p + i] = x[3 * p + i] + step + noise(random);
        }
    }
    x
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

/// Where the difference is nearest to 0 on the line or plane of one part of the boundary: `u`, `v`
/// and the squared distance, all times `scale`.
pub(super) struct Foot {
    place: [Number; 2],
    square: Number,
    scale: Number,
}

impl Foot {
    /// On the line through two corners; `None` beyond them.
    fn on_side(sample: &Sample, t: &Number, from: (f64, f64), to: (f64, f64)) -> Option<Foot> {
        let corner = |(u, v): (f64, f64)| [u, v].map(Number::from);
        let (from, to) = (corner(from), corner(to));
        let (start, end) = (sample.difference(t, &from), sample.difference(t, &to));
        let side = [0, 1, 2].map(|i| &end[i] - &start[i]);
        let (length, share) = (dot(&side, &side), -&dot(&start, &side));
        let is_inside = share.sign().is_ge() && (&length - &share).sign().is_ge();
        (is_inside && length.sign().is_gt()).then(|| Foot {
            place: [0, 1].map(|i| &(&from[i] * &length) + &(&(&to[i] - &from[i]) * &share)),
            square: &(&dot(&start, &start) * &length) - &(&share * &share),
            scale: length,
        })
    }

    /// In the plane; `None` outside, or if there is none.
    fn inside<K: Stages>(sample: &Sample, t: &Number) -> Option<Foot> {
        let [k, l, m] = sample.at(t);
        let (kk, ll, kl) = (dot(&k, &k), dot(&l, &l), dot(&k, &l));
        let (mk, ml, mm) = (dot(&m, &k), dot(&m, &l), dot(&m, &m));
        let scale = &(&kk * &ll) - &(&kl * &kl);
        let u = &(&mk * &ll) - &(&ml * &kl);
        let v = &(&mk * &kl) - &(&ml * &kk);
        let rest = |x: &Number| &scale - x;
        let mut parts = vec![u.clone(), v.clone(), rest(&u), rest(&v)];
        if K::CORNERS.len() == 3 {
            parts.push(&rest(&u) - &v);
        }
        let is_inside = parts.iter().all(|x| x.sign().is_ge()) && scale.sign().is_gt();
        is_inside.then(|| Foot {
            square: &(&(&mm * &scale) - &(&u * &mk)) + &(&v * &ml),
            place: [u, v],
            scale,
        })
    }

    /// The nearest place, exactly.
    fn nearest<K: Stages>(sample: &Sample, t: &Number) -> Foot {
        let pairs = K::CORNERS
            .iter()
            .flat_map(|from| K::CORNERS.iter().map(move |to| (from, to)));
        // The diagonals of a square are no sides, but in the set.
        let sides = pairs.filter_map(|(from, to)| Foot::on_side(sample, t, *from, *to));
        let corners = K::CORNERS.iter().map(|&(u, v)| {
            let place = [u, v].map(Number::from);
            let difference = sample.difference(t, &place);
            Foot {
                place,
                square: dot(&difference, &difference),
                scale: Number::from(1.0),
            }
        });
        let feet = sides.chain(corners).chain(Foot::inside::<K>(sample, t));
        let nearer = |x: Foot, y: Foot| {
            if &y.square * &x.scale < &x.square * &y.scale {
                y
            } else {
                x
            }
        };
        feet.reduce(nearer).expect("a corner")
    }
}

impl Nearness {
    /// What it says of a place, by how much the squared distance falls and how far the place
    /// shifts, at a time and after a while.
    pub(super) fn claims<K: Stages>(
        &self,
        sample: &Sample,
        spot: &Spot,
        t: f64,
        while_: f64,
    ) -> [Claim; 4] {
        let spot = [spot.u, spot.v].map(Number::from);
        let at = |t: &Number| {
            let foot = Foot::nearest::<K>(sample, t);
            let difference = sample.difference(t, &spot);
            let fall = &(&dot(&difference, &difference) * &foot.scale) - &foot.square;
            let shift = |i: usize| Claim {
                error: (&(&spot[i] * &foot.scale) - &foot.place[i]).abs(),
                bound: &Number::from(self.error) * &foot.scale,
            };
            let fall = Claim {
                error: fall,
                bound: &Number::from(self.excess) * &foot.scale,
            };
            (fall, shift(0).worse(shift(1)))
        };
        let t = Number::from(t);
        let ((fall, shift), (later_fall, later_shift)) =
            (at(&t), at(&(&t + &Number::from(while_))));
        [fall, shift, later_fall, later_shift]
    }
}

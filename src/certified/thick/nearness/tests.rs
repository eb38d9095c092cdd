use std::cell::Cell;

use super::super::testing::{Sample, search};
use super::*;
use crate::certified::kind::Stages;
use crate::certified::testing::{Claim, Number, Random, dot as exact_dot, points};
use crate::query::{EdgeEdge, VertexFace};

/// Where the difference is nearest to 0 on the line or plane of one part of the boundary: `u`, `v`
/// and the squared distance, all times `scale`.
struct Foot {
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
        let (length, share) = (exact_dot(&side, &side), -&exact_dot(&start, &side));
        let is_inside = share.sign().is_ge() && (&length - &share).sign().is_ge();
        (is_inside && length.sign().is_gt()).then(|| Foot {
            place: [0, 1].map(|i| &(&from[i] * &length) + &(&(&to[i] - &from[i]) * &share)),
            square: &(&exact_dot(&start, &start) * &length) - &(&share * &share),
            scale: length,
        })
    }

    /// In the plane; `None` outside, or if there is none.
    fn inside<K: Stages>(sample: &Sample, t: &Number) -> Option<Foot> {
        let [k, l, m] = sample.at(t);
        let (kk, ll, kl) = (exact_dot(&k, &k), exact_dot(&l, &l), exact_dot(&k, &l));
        let (mk, ml, mm) = (exact_dot(&m, &k), exact_dot(&m, &l), exact_dot(&m, &m));
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
                square: exact_dot(&difference, &difference),
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

fn nearest_places_are_within_their_bounds<K: Stages>(seed: u64) {
    // Inside, on a side, at a corner.
    let counts = Cell::new([0; 3]);
    let claims = |x: &[f64; 26]| {
        let (t, while_) = (x[24].abs().min(1.0), x[25].abs().min(0.1));
        let sample = Sample::new::<K>(&x[..24], 1.0);
        let here = Instant::new::<K, _>(&sample.moving, t);
        let nearness = sample.moving.nearness::<K>(&here, while_)?;
        if !nearness.error.is_finite() {
            return None;
        }
        let held = here
            .spot
            .directions
            .iter()
            .filter(|direction| !direction.is_free)
            .count();
        let mut count = counts.get();
        count[held] += 1;
        counts.set(count);
        let spot = [here.spot.u, here.spot.v].map(Number::from);
        let at = |t: &Number| {
            let foot = Foot::nearest::<K>(&sample, t);
            let difference = sample.difference(t, &spot);
            let fall = &(&exact_dot(&difference, &difference) * &foot.scale) - &foot.square;
            let shift = |i: usize| Claim {
                error: (&(&spot[i] * &foot.scale) - &foot.place[i]).abs(),
                bound: &Number::from(nearness.error) * &foot.scale,
            };
            let fall = Claim {
                error: fall,
                bound: &Number::from(nearness.excess) * &foot.scale,
            };
            (fall, shift(0).worse(shift(1)))
        };
        let t = Number::from(t);
        let ((fall, shift), (later_fall, later_shift)) =
            (at(&t), at(&(&t + &Number::from(while_))));
        Some([fall, shift, later_fall, later_shift])
    };
    let start = |random: &mut Random| {
        let mut x = [0.0; 26];
        x[..24].copy_from_slice(&points(random, (-100, 100)));
        x[24] = random.unit();
        x[25] = random.unit() * 2f64.powi(-random.whole(0, 80));
        x
    };
    let worst = search(seed).worst(start, claims);
    println!("thick: nearest places {worst:?}, {:?}", counts.get());
    // The bounds take every error for the largest, and add up magnitudes.
    assert!(worst.iter().all(|&ratio| ratio > 1e-3));
    assert!(counts.get().iter().all(|&count| count > 100));
}

#[test]
fn thick_nearest_places_of_edges_are_within_their_bounds() {
    nearest_places_are_within_their_bounds::<EdgeEdge>(1);
}

#[test]
fn thick_nearest_places_in_a_face_are_within_their_bounds() {
    nearest_places_are_within_their_bounds::<VertexFace>(2);
}

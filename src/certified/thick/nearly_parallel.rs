//! The nearest place of two edges that are parallel but for a little, as those are that lie along
//! each other and have been rounded.
//!
//! `f64` cannot tell at which end of the part that they have side by side they are nearer. The
//! slopes of the squared distance along the edges, in double-double arithmetic, can.

use wide::f64x2;

use super::advance::Moving;
use super::doubled::{MINOR_ERROR, SLOPE_ERROR, edges_at, normal_of, slopes_at};
use super::instant::Instant;
use super::nearness::{Nearness, SHORTEST, TINY};
use crate::certified::cubic::permanents;
use crate::certified::double::Double;
use crate::certified::kind::Stages;
use crate::certified::motion::{Positions, Vector, add, cross, dot};
use crate::certified::separate::U;

/// A slope and a bound on its error, from a time on for a while.
#[derive(Clone, Copy)]
struct Slope {
    value: f64,
    error: f64,
}

impl Slope {
    fn is_uphill(&self) -> bool {
        self.value > self.error
    }

    fn size(&self) -> f64 {
        self.value.abs() + self.error
    }
}

impl Moving<f64x2> {
    /// The same as [`nearness`](Self::nearness) of two edges at a place on the boundary; `None`
    /// unless the distance certainly grows from it inwards.
    ///
    /// # Proof
    ///
    /// Let `V1` and `V2` be the directions from the place, `g1` and `g2` the products of these with
    /// the difference there, `c = V1 . V2 / V1^2`, `N` the normal, `s` the nearest place, and
    /// `s2 >= 0`, as the second direction is not free. With `e = s1 + c s2` and `m = g2 - c g1` the
    /// squared distance grows by
    ///
    /// ```text
    /// 2 g . s + s . Q s  =  2 g1 e + V1^2 e^2 + 2 m s2 + (N^2 / V1^2) s2^2
    /// ```
    ///
    /// Let `m` be above 0. Then it falls by at most `g1^2 / V1^2`. At the nearest place its gradient
    /// leads away from the place that is given, so that `V1^2 e^2 + m s2 <= |g1 e|`: `|e|` is at most
    /// `|g1| / V1^2`, and `s2` at most `g1^2 / 4 V1^2 m`. `m` is the product of the difference with a
    /// combination of the directions: so these are not parallel, and `s` is a single one.
    ///
    /// If neither direction is free and both `g` are above 0, it is nearest here, and here alone.
    /// That is said only if the two are certainly not parallel all the while.
    ///
    /// # Error bounds
    ///
    /// With the larger magnitudes `v` of a direction at both ends, their sum `s` for `K`, `L` and
    /// `M`, and the while `T < 1/8`; `V'` and `w'` are the changes of a direction and of the
    /// difference `w` in a whole step, at most `2 v` and `2 s`.
    ///
    /// - The slopes at the time are within [`SLOPE_ERROR`] of `v . s`.
    /// - In the while they change by at most `T |V' . w + V . w'| + T^2 |V' . w'|`. That is computed
    ///   with the errors `4 u v` of `V'`, `6 u v` of `V` and `12 u s` of `w` and `w'`, and the sums
    ///   of three products add `4 u` of these: it is within `80 u v . s`.
    /// - Lengths, `V1 . V2` and `V1^2` are as in [`nearness`](Self::nearness): the last two within
    ///   `(16 u + 5 T)` of the products of their `v`.
    /// - `N` at the time is within [`MINOR_ERROR`] of the permanent `p` of the `v` of `K` and `L`, and
    ///   changes as slopes do: `V' x V`, of a component below `4 p`, is computed within `80 u p`.
    ///
    /// What underflows is in `TINY`, and in `SHORTEST` for the directions.
    pub(super) fn nearness_at_boundary<K: Stages>(
        &self,
        positions: &Positions,
        here: &Instant,
        t: f64,
        while_: f64,
    ) -> Option<Nearness> {
        if !(0.0..0.125).contains(&while_) {
            return None;
        }
        let directions = here.spot.directions;
        let ([k, l], size) = self.reaches();
        let reaches = [k, l];
        let along = here.along();
        let turns = [&here.change[0], &here.change[1]];
        let velocity = here.velocity();
        let points = positions.points::<f64x2>();
        let edges = edges_at::<K>(&points, t);
        let [of_k, of_l] = slopes_at::<K>(&points, &edges, t, here);
        let signs = [-directions[0].u, directions[1].v];
        let values = [signs[0] * of_k, signs[1] * of_l];
        let slope = |i: usize| {
            let product = dot(&reaches[i], &size);
            let turn = signs[i] * dot(turns[i], &here.difference);
            let change = (turn + dot(&along[i], &velocity)).abs();
            let rounding = (SLOPE_ERROR + while_ * (80.0 * U + 4.0 * while_)) * product;
            Slope {
                value: values[i],
                error: (rounding + while_ * change) * (1.0 + 16.0 * U) + TINY,
            }
        };
        let slopes = [slope(0), slope(1)];
        let is_at_corner = !directions[0].is_free && !directions[1].is_free;
        if is_at_corner && slopes.iter().all(Slope::is_uphill) {
            let is_single = is_never_parallel(&edges, here, &reaches, while_);
            return is_single.then_some(Nearness {
                excess: 0.0,
                error: 0.0,
                is_parallel: false,
            });
        }
        let nearness = |first: usize, second: usize| {
            if directions[second].is_free {
                return None;
            }
            let (of_first, of_second) = (slopes[first], slopes[second]);
            let pair =
                |i: usize, j: usize| (dot(&along[i], &along[j]), dot(&reaches[i], &reaches[j]));
            let (square, most) = pair(first, first);
            let (product, mixed) = pair(first, second);
            let near = 16.0 * U + 5.0 * while_;
            // Of `V1^2`, all the while.
            let least = (square - near * most) * (1.0 - 8.0 * U);
            let share = product / square;
            let share_error = near * (mixed + share.abs() * most) / least + 8.0 * U * share.abs();
            let inwards = of_second.value - share * of_first.value;
            let error = of_second.error
                + share.abs() * of_first.error
                + share_error * of_first.size()
                + 4.0 * U * (of_second.value.abs() + (share * of_first.value).abs());
            let inwards = inwards - error * (1.0 + 16.0 * U);
            if !(least > SHORTEST * SHORTEST && inwards > 0.0) {
                return None;
            }
            let fall = of_first.size() * of_first.size() / least;
            let second = fall / (4.0 * inwards);
            let first = of_first.size() / least + (share.abs() + share_error) * second;
            Some((fall, first + second))
        };
        let (excess, error) = nearness(0, 1).or_else(|| nearness(1, 0))?;
        Some(Nearness {
            excess: excess * (1.0 + 64.0 * U),
            error: error * (1.0 + 64.0 * U),
            is_parallel: false,
        })
    }
}

/// Whether `K x L` is certainly not 0 from a time on, for a while; the error bound is with
/// [`nearness_at_boundary`](Moving::nearness_at_boundary).
#[inline(always)]
fn is_never_parallel(
    edges: &[Double<f64x2>; 3],
    here: &Instant,
    [k_reach, l_reach]: &[Vector; 2],
    while_: f64,
) -> bool {
    let ([k, l, _], [k_change, l_change, _]) = (&here.at, &here.change);
    let change = add(&cross(k_change, l), &cross(k, l_change));
    let (normal, permanents) = (normal_of(edges), permanents(k_reach, l_reach));
    [0, 1, 2].into_iter().any(|axis: usize| {
        let minor = normal[axis].abs();
        let rounding = (MINOR_ERROR + while_ * (80.0 * U + 4.0 * while_)) * permanents[axis];
        let error = (rounding + while_ * change[axis].abs()) * (1.0 + 16.0 * U) + TINY;
        minor * (1.0 - 2.0 * U) > error
    })
}

#[cfg(test)]
mod tests;

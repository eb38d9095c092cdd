//! A plane that stays, in double-double arithmetic: where the two are farther apart than the radius
//! by less than `f64` can tell, and come no nearer, as after a contact.

use wide::f64x2;

use super::advance::Moving;
use super::doubled::{H, difference_at, edges_at, slopes_at};
use super::instant::Instant;
use super::nearness::SHORTEST;
use crate::certified::double::{Double, two_difference, two_sum};
use crate::certified::ends::Ends;
use crate::certified::kind::Stages;
use crate::certified::motion::{Positions, dot};
use crate::certified::nearest::Gram;
use crate::query::Radius;

impl Moving<f64x2> {
    /// Whether the plane between the points that are nearest at a time certainly keeps the two more
    /// than the radius apart for the whole step.
    ///
    /// # Proof
    ///
    /// As with [`stays_apart_by`](Self::stays_apart_by), for a normal of two `f64` for each
    /// component, any one: `X . n > R |n|` for the corners `X` at both ends of the step. That is so
    /// where `X . n > 0` and `(X . n)^2 > R^2 n^2`.
    ///
    /// Error bound, with `h = 2^-106`, `s` the sum of the larger magnitudes of `K`, `L` and `M`, and
    /// `S = s . |n|`: components of `K`, `L` and `M` are exact at both ends, products add `8 h`, and so
    /// do two sums of what they add, and two more to the corner: its product is within `42 h S`, the
    /// square of that within `93 h S^2`. `R^2 n^2` is within `48 h` of itself, and the difference adds `8 h` of
    /// both. Nothing that underflows counts beside these, as `n^2` is above `2^-450` and `R^2` above
    /// `2^-400`.
    pub(super) fn stays_apart_sharply<K: Stages>(
        &self,
        positions: &Positions,
        radius: Radius,
        here: &Instant,
        t: f64,
    ) -> bool {
        let points = positions.points::<f64x2>();
        let normal = sharp_normal::<K>(&points, here, t);
        let rough = normal.map(|x| x.value());
        if !(dot(&rough, &rough) > SHORTEST && self.is_ordinary()) {
            return false;
        }
        let normal = normal.map(Double::<f64x2>::both);
        let products = products::<K>(&points, &normal);
        let [x, y, z] = normal;
        let [first, second] = radius.parts();
        let reach = Double::both(two_sum(first, second));
        let square = x.mul(x).add(y.mul(y)).add(z.mul(z));
        let least = reach.mul(reach).mul(square);
        let (_, size) = self.reaches();
        let sum = dot(&size, &rough.map(f64::abs));
        let error = H * (112.0 * sum * sum + 56.0 * least.high.start());
        K::CORNERS.iter().all(|&(u, v)| {
            let corner = corner(&products, u, v);
            let more = corner.mul(corner).sub(least);
            let is_beyond = |corner: f64, more: f64| corner > 0.0 && more > error;
            is_beyond(corner.high.start(), more.high.start())
                && is_beyond(corner.high.end(), more.high.end())
        })
    }
}

/// The products of `K`, `L` and `M` with a normal, at both ends of the step.
#[inline(always)]
fn products<K: Stages>(
    points: &[[f64x2; 3]; 4],
    normal: &[Double<f64x2>; 3],
) -> [Double<f64x2>; 3] {
    K::DIFFERENCES.map(|(from, to)| {
        let product = |i: usize| two_difference(points[to][i], points[from][i]).mul(normal[i]);
        product(0).add(product(1)).add(product(2))
    })
}

/// The product of a corner with the normal.
#[inline(always)]
fn corner([k, l, m]: &[Double<f64x2>; 3], u: f64, v: f64) -> Double<f64x2> {
    let corner = if v > 0.0 { m.add(*l) } else { *m };
    if u > 0.0 { corner.sub(*k) } else { corner }
}

/// The difference of the points that are nearest at a time, perpendicular to the directions that
/// are free there.
fn sharp_normal<K: Stages>(points: &[[f64x2; 3]; 4], here: &Instant, t: f64) -> [Double<f64>; 3] {
    let edges = edges_at::<K>(points, t);
    let [of_k, of_l] = slopes_at::<K>(points, &edges, t, here);
    let Gram { kk, ll, kl, .. } = here.gram;
    let [first, second] = here.spot.directions;
    // Added are `v L - u K`.
    let (u, v) = match (first.is_free, second.is_free) {
        (false, false) => (0.0, 0.0),
        (true, true) => {
            let determinant = here.gram.determinant();
            (
                (of_k * ll - of_l * kl) / determinant,
                (of_k * kl - of_l * kk) / determinant,
            )
        }
        (is_first, _) => {
            let direction = if is_first { first } else { second };
            let square = direction.u * direction.u * kk - 2.0 * direction.u * direction.v * kl
                + direction.v * direction.v * ll;
            let share = (direction.u * of_k - direction.v * of_l) / square;
            (share * direction.u, share * direction.v)
        }
    };
    let shares = Double {
        high: Ends::new(-u, v),
        low: f64x2::both(0.0),
    };
    let [xy, zz] = difference_at::<K, _>(points, t, &here.spot);
    let ([x, y], [z, _]) = (xy.lanes(), zz.lanes());
    let with_shares = |i: usize, far: Double<f64>| {
        let [k, l] = edges[i].mul(shares).lanes();
        far.add(k).add(l)
    };
    [with_shares(0, x), with_shares(1, y), with_shares(2, z)]
}

#[cfg(test)]
mod tests;

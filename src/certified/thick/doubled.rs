//! The two sides at one time in double-double arithmetic: where `f64` cannot tell, as near the time
//! of impact, at a start at which they touch, and where they are nearly parallel.

use wide::f64x2;

use super::instant::Instant;
use crate::certified::double::{Double, two_difference, two_sum};
use crate::certified::ends::Ends;
use crate::certified::kind::Stages;
use crate::certified::motion::{Vector, dot};
use crate::certified::nearest::Spot;
use crate::certified::refine::difference;
use crate::certified::separate::U;

/// `2^-106`.
pub(super) const H: f64 = U * U;

/// The error of [`slopes_at`] in units of the products of sizes.
pub(super) const SLOPE_ERROR: f64 = 260.0 * H;

/// The error of [`normal_of`] in units of the permanents of sizes.
pub(super) const MINOR_ERROR: f64 = 132.0 * H;

/// `K` and `L` at a time, in double-double arithmetic: both of an axis.
#[inline(always)]
pub(super) fn edges_at<K: Stages>(points: &[[f64x2; 3]; 4], t: f64) -> [Double<f64x2>; 3] {
    let [(a, b), (c, d), _] = K::DIFFERENCES;
    let time = two_sum(t, 0.0);
    [0, 1, 2].map(|i: usize| {
        difference(
            [points[a][i], points[c][i]],
            [points[b][i], points[d][i]],
            time,
        )
    })
}

/// `K x L` at a time, from [`edges_at`]; a component is within [`MINOR_ERROR`] of the permanent of the
/// larger magnitudes at both ends.
///
/// Error bound, with `h = 2^-106`: components within `57 h v`, products `8 h` more, and so does the
/// difference: below `132 h` of the permanent. The rounding to `f64` is relative.
#[inline(always)]
pub(super) fn normal_of(edges: &[Double<f64x2>; 3]) -> Vector {
    let minor = |i: usize, j: usize| {
        let [first, second] = edges[i].mul(edges[j].swapped()).lanes();
        first.sub(second).value()
    };
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// The products of the difference of the points of a place with `K` and with `L` at a time, in
/// double-double arithmetic; within [`SLOPE_ERROR`] of the products of the larger magnitudes.
///
/// Error bound, with `h = 2^-106`: a component of `K` or `L` is within `57 h v` of the exact one
/// ([`difference`]), one of the difference within `160 h s` ([`difference_at`]), their product adds
/// `8 h`: `226 h v s`. Two sums add `8 h` each of what they add: below `260 h v . s`. The rounding
/// to `f64` is relative.
#[inline(always)]
pub(super) fn slopes_at<K: Stages>(
    points: &[[f64x2; 3]; 4],
    edges: &[Double<f64x2>; 3],
    t: f64,
    here: &Instant,
) -> [f64; 2] {
    let [xy, zz] = difference_at::<K, _>(points, t, &here.spot);
    let ([x, y], [z, _]) = (xy.lanes(), zz.lanes());
    let product = |i: usize, far: Double<f64>| edges[i].mul(Double::both(far));
    let [k, l] = product(0, x).add(product(1, y)).add(product(2, z)).lanes();
    [k.value(), l.value()]
}

/// The difference of the points of a place at a time, in double-double arithmetic: `x` and `y`, and
/// `z` twice.
///
/// Error bound, with `h = 2^-106` and `s` the sum of the larger magnitudes at both ends: the
/// differences are exact, their products with `u` and `v` add `16 h s`, two sums `16 h s`: below
/// `32 h s` at each end of the step. The change is within `(64 + 24) h s`, the product with the
/// time adds `16 h s`, the sum `24 h s`: below `160 h s`.
#[inline(always)]
pub(super) fn difference_at<K: Stages, E: Ends>(
    points: &[[E; 3]; 4],
    t: f64,
    spot: &Spot,
) -> [Double<E>; 2] {
    let (u, v, time) = (number(spot.u), number(spot.v), number(t));
    let x = difference_at_ends::<K, E>(points, 0, u, v);
    let y = difference_at_ends::<K, E>(points, 1, u, v);
    let z = difference_at_ends::<K, E>(points, 2, u, v);
    let (xy, zz) = (x.transposed(y), z.transposed(z));
    [at_time(xy, time), at_time(zz, time)]
}

/// A number of one `f64`, in both lanes.
#[inline(always)]
fn number<E: Ends>(x: f64) -> Double<E> {
    Double {
        high: E::both(x),
        low: E::both(0.0),
    }
}

/// The difference on an axis at both ends of the step.
#[inline(always)]
fn difference_at_ends<K: Stages, E: Ends>(
    points: &[[E; 3]; 4],
    axis: usize,
    u: Double<E>,
    v: Double<E>,
) -> Double<E> {
    let [k, l, m] = K::DIFFERENCES;
    let (k, l, m) = (
        two_difference(points[k.1][axis], points[k.0][axis]),
        two_difference(points[l.1][axis], points[l.0][axis]),
        two_difference(points[m.1][axis], points[m.0][axis]),
    );
    m.add(v.mul(l)).sub(u.mul(k))
}

#[inline(always)]
fn at_time<E: Ends>([start, end]: [Double<E>; 2], time: Double<E>) -> Double<E> {
    start.add(end.sub(start).mul(time))
}

/// The squared distance less `R^2` of the points of a place at a time, in double-double arithmetic,
/// and a bound on its error but for the rounding to `f64`.
///
/// Error bound, with that of [`difference_at`]: `w^2` is off by `320 h |w| s` and the
/// square of that error; products, sums and the radius add `64 h` of both sides. What underflows is
/// far below that of the radius.
#[inline(always)]
pub(super) fn excess<K: Stages, E: Ends>(
    points: &[[E; 3]; 4],
    [first, second]: [f64; 2],
    t: f64,
    spot: &Spot,
    size: &Vector,
) -> (f64, f64) {
    let [xy, zz] = difference_at::<K, E>(points, t, spot);
    let [zr, _] = zz.transposed(Double::both(two_sum(first, second)));
    let ([x2, y2], [z2, r2]) = (xy.mul(xy).lanes(), zr.mul(zr).lanes());
    let value = x2.add(y2).add(z2).sub(r2).value();
    let difference = [
        xy.high.start().abs(),
        xy.high.end().abs(),
        zz.high.start().abs(),
    ];
    let total = 160.0 * H * (size[0] + size[1] + size[2]);
    let error = 330.0 * H * dot(&difference, size)
        + total * total
        + 64.0 * H * (x2.high + y2.high + z2.high + r2.high);
    (value, error)
}

#[cfg(test)]
mod tests;

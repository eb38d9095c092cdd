//! What else is certain of a contact: how precise its place is, the side they come from, and whether the
//! midlines cross.

use super::advance::Moving;
use super::shape::{Shape, Spot};
use crate::certified::cubic::{Cubic, permanents};
use crate::certified::ends::Ends;
use crate::certified::motion::{Vector, cross, dot, reach};
use crate::certified::separate::U;

/// A bound on the errors of `u` and `v` of the nearest place at a time of impact that is up to `2 u` from `t`;
/// `None` unless `N = K x L` is certainly not 0 there. Then the nearest place is a single one.
///
/// Half of the squared distance, in lengths `a = u |K|` and `b = v |L|`, has second derivatives of at least
/// `1 - |cos| >= N^2 / 2 K^2 L^2` in every direction, and half of its gradient at the exact place makes no acute angle with what
/// leads away from the set. So with the difference `D` of the exact place and the gradient `g` at this one,
/// `D^2 N^2 / 2 K^2 L^2 <= g . D`, which is at most the length of [`Shape::slack`], in lengths, times that of `D`.
///
/// Error bounds, with the larger magnitudes `k`, `l`, `m` at both ends and their sum `s`: a component of `K` is within
/// `4 u k` of the exact one and changes by `4 u k` up to the time of impact, one of the way is within `12 u s` and changes by
/// `4 u s`; the products with `K` add `4 u`: half the gradient in `u` is within `32 u` of the sum of the `k s`, and the slack sums
/// up no more than three of each. A component of `N` is within `20 u` of the permanents of `k` and `l`, and changes by `4 u` of them.
/// Below, that may be half of `N`, so `N^2` is a quarter of what is computed.
pub(super) fn parameter_error<S: Shape, E: Ends>(
    moving: &Moving<E>,
    t: f64,
    spot: &Spot,
) -> Option<f64> {
    let motion = &moving.motion;
    let [k_reach, l_reach, m_reach] = [&motion.k, &motion.l, &motion.m].map(reach);
    let size = [0, 1, 2].map(|i| k_reach[i] + l_reach[i] + m_reach[i]);
    let vectors = moving.at(t);
    let [k, l, _] = &vectors;
    let normal = cross(k, l);
    let n2 = dot(&normal, &normal);
    let error_n: f64 = permanents(&k_reach, &l_reach).iter().sum::<f64>() * (24.0 * U);
    if !(n2.sqrt() > 2.0 * error_n && n2 > SMALLEST) {
        return None;
    }
    let way = super::advance::way(&vectors, spot.u, spot.v);
    let error = 4.0 * 40.0 * U * (dot(&k_reach, &size) + dot(&l_reach, &size));
    let [a, b] = S::slack(spot, [-dot(k, &way), dot(l, &way)]).map(|slack| slack + error);
    let ([k_least, k_most], [l_least, l_most]) = (length(k, &k_reach), length(l, &l_reach));
    if !(k_least > 0.0 && l_least > 0.0) {
        return None;
    }
    let slack = (a / k_least).hypot(b / l_least);
    let size = k_most * l_most;
    let distance = slack * (8.0 * size * size / n2) * (1.0 + 64.0 * U);
    Some(distance / k_least.min(l_least) + 4.0 * U)
}

/// Bounds on the length of `K` or `L` up to the time of impact.
fn length(x: &Vector, reach: &Vector) -> [f64; 2] {
    let (length, error) = (dot(x, x).sqrt(), 16.0 * U * dot(reach, reach).sqrt());
    [length - error, length + error]
}

/// The sign of `f` just before a time of impact up to `2 u` from `t`, if it is certain.
///
/// The value is within twice the error of the cubic of that at `t`, and changes by at most 2 u times three
/// differences of coefficients: `12 u P`, less than its error.
pub(super) fn side(cubic: &Cubic, t: f64) -> Option<i8> {
    let (value, _) = cubic.evaluate(t);
    let error = 3.0 * cubic.error;
    if value > error {
        Some(1)
    } else {
        (value < -error).then_some(-1)
    }
}

/// Far above what underflows.
const SMALLEST: f64 = f64::from_bits((1023 - 900) << 52);

#[cfg(test)]
mod tests;

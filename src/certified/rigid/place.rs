//! Where two sides are nearest at a time that is known up to an error.

use std::cmp::Ordering;

use super::ball::Ball;
use super::differences::{Arm, Differences};
use super::features::Nearest;
use super::term::{Vector, cross, dot};
use crate::certified::kind::Stages;

/// `2^-52`: the largest error of `u` and `v`; the weights of a face are off by at most twice that
/// and some roundings.
pub(super) const SHARE_ERROR: f64 = f64::from_bits((1023 - 52) << 52);

/// `u` and `v`, each within [`SHARE_ERROR`]; `None` if that, or that they are inside, is not certain.
///
/// `N` is a positive multiple of `K x L`.
pub(super) fn place<K: Stages>(
    nearest: &Nearest<Ball>,
    of: &Differences<Ball>,
    n: &Vector<Ball>,
) -> Option<[f64; 2]> {
    match *nearest {
        Nearest::Corner(place) => Some(place),
        Nearest::Side {
            from,
            to,
            above,
            below,
        } => {
            let share = quotient(above, below)?;
            // Each is 0, 1, the share or what is left of it.
            Some(std::array::from_fn(|i| from[i] + (to[i] - from[i]) * share))
        }
        Nearest::Inside => inside::<K>(of, n),
    }
}

/// Where the common perpendicular meets both.
///
/// `D M x L = u D K x L` and `D M x K = v D K x L`, up to multiples of the perpendicular; the arms
/// have their factors `D`, and `N` has those of both.
fn inside<K: Stages>(of: &Differences<Ball>, n: &Vector<Ball>) -> Option<[f64; 2]> {
    let square = dot(n, n);
    let with_d = |arm: &Arm<Ball>| match arm.rests {
        true => of.d.mul(square),
        false => square,
    };
    let (u, of_u) = (dot(&cross(&of.m, &of.l.vector), n), with_d(&of.k));
    let (v, of_v) = (dot(&cross(&of.m, &of.k.vector), n), with_d(&of.l));
    let is_above = |number: Ball| number.sign() == Some(Ordering::Greater);
    let are_below = match K::FIRST {
        1 => is_above(of_u.sub(u).sub(v)),
        _ => is_above(of_u.sub(u)) && is_above(of_v.sub(v)),
    };
    if !(is_above(u) && is_above(v) && are_below) {
        return None;
    }
    Some([quotient(u, of_u)?, quotient(v, of_v)?])
}

/// A quotient from 0 to 1, if it is certain up to [`SHARE_ERROR`].
///
/// A number `x` is off `n / d` by `|n - x d| / |d|`.
fn quotient(above: Ball, below: Ball) -> Option<f64> {
    let rest = |x: f64| above.sub(below.mul(Ball::new(x)));
    let first = above.value() / below.value();
    let value = (first + rest(first).value() / below.value()).clamp(0.0, 1.0);
    let is_certain = rest(value).most() <= 0.5 * SHARE_ERROR * below.least();
    is_certain.then_some(value)
}

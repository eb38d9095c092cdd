//! The judge of two edges at one instant: everything that
//! [`decide_discrete`](tunnelproof::decide_discrete) promises, in rational numbers.
//!
//! Lengths are compared by their squares. The direction of a vector `w` is irrational; that a unit
//! vector `n` is within `e` of it means `n . w >= c |w|` with `c = (|n|^2 + 1 - e^2) / 2`, and that
//! is decided by squares too, where `c > 0`.

use std::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};
use tunnelproof::certified::Proximity;
use tunnelproof::query::{EdgeEdge, Point};

use crate::vector::{cross, dot};

type Vector = [BigRational; 3];

/// What of a [`Proximity`] is not as promised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrong {
    /// Whether they are within the radius.
    Touches,
    /// The lower bound on the distance is above it, or no number from 0.
    Low,
    /// The upper bound on the distance is below it.
    High,
    /// The parameters: outside `[0, 1]`, or of points that are too far apart, or whose difference
    /// is too far from the shortest vector.
    Nearest,
    /// The points: too far from those with the parameters.
    Points,
    /// The normal: there where there is none, or missing, or too far from the exact one.
    Normal,
    /// The depth.
    Depth,
}

/// All that is wrong with an answer; none if it keeps every promise.
pub fn wrongs(query: &EdgeEdge, found: &Proximity) -> Vec<Wrong> {
    // Without these the rest means nothing.
    if !(0.0..=f64::MAX).contains(&found.distance_low) {
        return vec![Wrong::Low];
    }
    if found.distance_high.is_nan() || found.distance_high < found.distance_low {
        return vec![Wrong::High];
    }
    let exact = Instant::new(query.start());
    let reach = radius(query);
    let touches = exact.squared <= &reach * &reach;
    let checks = [
        (Wrong::Touches, found.touches == touches),
        (Wrong::Low, exact.squared >= square(found.distance_low)),
        (
            Wrong::High,
            found.distance_high.is_infinite() || exact.squared <= square(found.distance_high),
        ),
        (Wrong::Nearest, exact.is_near(found)),
        (Wrong::Points, are_points(query.start(), found)),
        (Wrong::Normal, exact.is_normal(found)),
        (Wrong::Depth, is_depth(found, touches, &reach)),
    ];
    let wrong = checks.into_iter().filter(|(_, is_right)| !is_right);
    wrong.map(|(what, _)| what).collect()
}

/// Two edges at one instant, exactly.
pub struct Instant {
    k: Vector,
    l: Vector,
    m: Vector,
    /// The shortest vector from AB to CD.
    pub way: [BigRational; 3],
    /// Its squared length.
    pub squared: BigRational,
}

impl Instant {
    /// The edges AB and CD.
    pub fn new(points: &[Point; 4]) -> Self {
        let difference = |to: usize, from: usize| {
            [0, 1, 2].map(|i| number(points[to][i]) - number(points[from][i]))
        };
        let (k, l, m) = (difference(1, 0), difference(3, 2), difference(2, 0));
        let ways = places(&k, &l, &m).map(|(u, v)| way(&k, &l, &m, &u, &v));
        let shortest = ways.map(|way| (dot(&way, &way), way));
        // There are four ends.
        let (squared, way) = shortest
            .min_by(|a, b| a.0.cmp(&b.0))
            .unwrap_or_else(|| (dot(&m, &m), m.clone()));
        Instant {
            k,
            l,
            m,
            way,
            squared,
        }
    }

    fn is_near(&self, found: &Proximity) -> bool {
        let (u, v) = (found.nearest.u, found.nearest.v);
        if ![u, v].iter().all(|x| (0.0..=1.0).contains(x)) {
            return false;
        }
        if found.distance_high.is_infinite() {
            return true;
        }
        let way = way(&self.k, &self.l, &self.m, &number(u), &number(v));
        let off = [0, 1, 2].map(|i| &way[i] - &self.way[i]);
        let (high, low) = (square(found.distance_high), square(found.distance_low));
        dot(&way, &way) <= high && dot(&off, &off) <= high - low
    }

    fn is_normal(&self, found: &Proximity) -> bool {
        let (way, error) = if self.squared.is_zero() {
            (cross(&self.k, &self.l), 1.0 / (1u64 << 50) as f64)
        } else {
            (self.way.clone(), deviation(found))
        };
        match found.normal {
            None => way.iter().all(Zero::is_zero),
            Some(normal) => is_along(&[normal.x, normal.y, normal.z], &way, error),
        }
    }
}

/// How far a normal may be from the direction of the shortest vector, rounded up.
fn deviation(found: &Proximity) -> f64 {
    let ratio = match found.distance_high.is_finite() && found.distance_high > 0.0 {
        true => found.distance_low / found.distance_high,
        false => 0.0,
    };
    // The quotient, the difference and the root round.
    let stated = (2.0 * (1.0 - ratio + f64::EPSILON)).sqrt() * (1.0 + 4.0 * f64::EPSILON);
    (stated + 1.0 / (1u64 << 49) as f64).min(1.0 / 1024.0)
}

/// Whether a vector is within so much, below 1, of the direction of another; never of 0.
pub fn is_along(unit: &[f64; 3], way: &[BigRational; 3], error: f64) -> bool {
    if !unit.iter().all(|x| x.is_finite()) {
        return false;
    }
    let unit = unit.map(number);
    let (along, length) = (dot(&unit, way), dot(way, way));
    let least = (dot(&unit, &unit) + BigRational::one() - square(error)) / number(2.0);
    // A vector so short that `c` is not above 0 is no unit vector.
    least.is_positive() && along.is_positive() && &along * &along >= &least * &least * length
}

/// The pairs of parameters one of which is nearest: the inner points of both, and every end with
/// what is nearest to it.
fn places(k: &Vector, l: &Vector, m: &Vector) -> impl Iterator<Item = (BigRational, BigRational)> {
    let (zero, one) = (BigRational::zero(), BigRational::one());
    let (kk, ll, kl) = (dot(k, k), dot(l, l), dot(k, l));
    let (mk, ml) = (dot(m, k), dot(m, l));
    let share = |n: BigRational, d: &BigRational| match d.is_zero() {
        true => BigRational::zero(),
        false => (n / d).clamp(BigRational::zero(), BigRational::one()),
    };
    let ends = [
        (zero.clone(), share(-&ml, &ll)),
        (one.clone(), share(&kl - &ml, &ll)),
        (share(mk.clone(), &kk), zero.clone()),
        (share(&mk + &kl, &kk), one.clone()),
    ];
    let determinant = &kk * &ll - &kl * &kl;
    let inner = (!determinant.is_zero()).then(|| {
        let u = (&mk * &ll - &ml * &kl) / &determinant;
        let v = (&mk * &kl - &ml * &kk) / &determinant;
        (u, v)
    });
    let is_share = move |x: &BigRational| *x >= zero && *x <= one;
    let inner = inner.filter(|(u, v)| is_share(u) && is_share(v));
    ends.into_iter().chain(inner)
}

/// From the point of AB at `u` to that of CD at `v`.
fn way(k: &Vector, l: &Vector, m: &Vector, u: &BigRational, v: &BigRational) -> Vector {
    [0, 1, 2].map(|i| &m[i] + v * &l[i] - u * &k[i])
}

/// Whether the points are those with the parameters: within `2^-51` of the larger coordinate of the
/// two ends and `2^-1073`, and between the ends.
fn are_points(corners: &[Point; 4], found: &Proximity) -> bool {
    let [a, b, c, d] = corners;
    let least = number(f64::from_bits(2));
    let is_point = |p: &Point, q: &Point, t: f64, point: &Point| {
        (0..3).all(|i| {
            if !(p[i].min(q[i])..=p[i].max(q[i])).contains(&point[i]) {
                return false;
            }
            let exact = number(p[i]) + number(t) * (number(q[i]) - number(p[i]));
            let size = number(p[i].abs().max(q[i].abs()));
            (exact - number(point[i])).abs() <= size / number((1u64 << 51) as f64) + &least
        })
    };
    let [first, second] = &found.points;
    let (u, v) = (found.nearest.u, found.nearest.v);
    [u, v].iter().all(|x| x.is_finite()) && is_point(a, b, u, first) && is_point(c, d, v, second)
}

/// Whether the depth is the radius less the distance, up to the width of the bounds and to
/// roundings.
fn is_depth(found: &Proximity, touches: bool, radius: &BigRational) -> bool {
    if !touches {
        return found.depth == 0.0;
    }
    // Four roundings.
    let rounding = radius / number((1u64 << 50) as f64) + number(f64::from_bits(4));
    let most = radius - number(found.distance_low) + &rounding;
    if found.depth.is_infinite() {
        return found.depth > 0.0 && most > number(f64::MAX);
    }
    let is_above = || {
        let least = radius - number(found.distance_high) - &rounding;
        number(found.depth) >= least
    };
    found.depth >= 0.0
        && number(found.depth) <= most
        && (found.distance_high.is_infinite() || is_above())
}

fn radius(query: &EdgeEdge) -> BigRational {
    let [first, second] = query.radius().parts();
    number(first) + number(second)
}

/// A finite number, exactly; 0 for another, which no caller has.
fn number(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap_or_else(|| BigRational::from_integer(BigInt::ZERO))
}

fn square(x: f64) -> BigRational {
    let x = number(x);
    &x * &x
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Wrong::Touches => "whether they touch",
            Wrong::Low => "the lower bound on the distance",
            Wrong::High => "the upper bound on the distance",
            Wrong::Nearest => "the parameters of the nearest points",
            Wrong::Points => "the nearest points",
            Wrong::Normal => "the normal",
            Wrong::Depth => "the depth",
        })
    }
}

#[cfg(test)]
mod tests;

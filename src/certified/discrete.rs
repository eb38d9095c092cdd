//! Two edges at one instant: how near they are, and whether that is within a radius.
//!
//! What a simulator asks of pairs that do not tunnel. The points found are an upper bound on the
//! distance, however they were found; a plane between the edges is a lower one. Where the two do
//! not tell on which side of the radius the distance is, integers do; so they do where the bounds
//! say too little of the direction.
//!
//! All is computed at one scale: the differences of the points times a power of two.

use nalgebra::Vector3;

use super::exact;
use super::motion::{Positions, Vector, add, dot, largest, sub};
use super::separate::U;
use super::vector::{between, normalised};
use crate::contact::EdgePoint;
use crate::environment;
use crate::query::{EdgeEdge, Point};

/// How near two edges are at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proximity {
    /// Whether the distance is at most the radius. Exact.
    pub touches: bool,
    /// The distance is not below this, in metres.
    pub distance_low: f64,
    /// The distance is not above this.
    ///
    /// The two are about `2^-26` of the size of the box around the edges apart where these are
    /// nearly parallel, else a few units in the last place of that size: at every scale, up to the
    /// rounding to the next subnormal number. Infinite where the distance may be above
    /// [`f64::MAX`].
    pub distance_high: f64,
    /// Where the edges are nearest; one such place of several.
    ///
    /// The exact points with these parameters are not farther apart than `distance_high`, and the
    /// vector from one to the other is within `sqrt(distance_high^2 - distance_low^2)` of the
    /// shortest one: that is the point nearest to 0 of a convex set, with which other points of the
    /// set make no acute angle.
    pub nearest: EdgePoint,
    /// The points of AB and CD with these parameters: a coordinate is off by at most `2^-51` of the
    /// larger one of the two ends and `2^-1073`, and between them.
    pub points: [Point; 2],
    /// The direction from AB to CD: that of the shortest vector, within
    /// `sqrt(2 (1 - distance_low / distance_high)) + 2^-49`, and within `2^-10` in any case. Where
    /// they touch at distance 0 it is that of `K x L` with `K = B - A` and `L = D - C`, within
    /// `2^-50`. `None` if and only if they touch at distance 0 and are parallel, or one is a point.
    pub normal: Option<Vector3<f64>>,
    /// The radius less the distance, up to `distance_high - distance_low` and the rounding of the
    /// radius and of the result; 0 where they do not touch. Infinite above [`f64::MAX`].
    pub depth: f64,
}

/// How near two edges are at the start of the step, and whether that is within the radius.
///
/// [`EdgeEdge::at_rest`] makes a query of edges at one instant.
///
/// Of all lengths times a power of two it says the same, times that power, to the last bit, as long
/// as no coordinate and no length leaves the range of normal numbers.
pub fn decide_discrete(query: &EdgeEdge) -> Proximity {
    debug_assert_eq!(environment::check(), Ok(()));
    let (points, radius) = (query.start(), query.radius());
    let corners = points.each_ref().map(|p| [p.x, p.y, p.z]);
    let (edges, exponent) = Edges::scaled(&corners);
    let (nearest, difference) = edges.nearest();
    let bounds = edges.distance(&difference);
    let (low, high) = match edges.are_one_point() {
        true => (0.0, 0.0),
        false => (
            scaled_down(bounds.0, exponent),
            scaled_up(bounds.1, exponent),
        ),
    };
    let rounded = radius.rounded();
    let touches = if high <= rounded.next_down() {
        true
    } else if low > rounded.next_up() {
        false
    } else {
        exact::are_near(&corners, radius.parts())
    };
    let [a, b, c, d] = points.each_ref().map(|point| point.coords);
    Proximity {
        touches,
        distance_low: low,
        distance_high: high,
        nearest,
        points: [inside(&a, &b, nearest.u), inside(&c, &d, nearest.v)].map(Point::from),
        normal: normal(&corners, &difference, bounds),
        depth: if touches {
            depth(radius.parts(), high)
        } else {
            0.0
        },
    }
}

/// The direction of the shortest vector, or of `K x L` where there is none.
///
/// The lower bound is proved with the direction `d` of the difference itself: no vector of the
/// convex set of differences has less than `low` along it, the shortest one neither. That is not
/// longer than `high`, so the cosine of the angle between the two is at least `low / high`, and the
/// unit vectors are within `sqrt(2 (1 - low / high))`. Where that says little, integers do.
fn normal(
    corners: &[Vector; 4],
    difference: &Vector,
    (low, high): (f64, f64),
) -> Option<Vector3<f64>> {
    if low > 0.0 && low >= high * CLOSE {
        return normalised(&(*difference).into());
    }
    let positions = Positions {
        start: *corners,
        end: *corners,
    };
    // At one instant any radius above 0 asks for the shortest vector there; this one is of the
    // query's scale, so that the integers are small.
    let size = corners.as_flattened().iter().map(|x| x.abs());
    let radii = [size.fold(f64::from_bits(1), f64::max), 0.0];
    exact::normal_of_edges_exactly(&positions, radii, [0.0; 2])
        .or_else(|| exact::perpendicular_of_edges(&positions))
        .map(Vector3::from)
}

/// The sum of the radii less a length, without overflow of the sum.
fn depth(radii: [f64; 2], length: f64) -> f64 {
    let sum = radii[0] + radii[1];
    let depth = match sum.is_finite() && length.is_finite() {
        true => sum - length,
        false => 2.0 * ((0.5 * radii[0] - 0.5 * length.min(f64::MAX)) + 0.5 * radii[1]),
    };
    depth.max(0.0)
}

/// The point at `t` in `[0, 1]` from `a` to `b`, in the box of the two: rounding alone could leave
/// it, and overflow.
fn inside(a: &Vector3<f64>, b: &Vector3<f64>, t: f64) -> Vector3<f64> {
    between(a, b, t).sup(&a.inf(b)).inf(&a.sup(b))
}

/// Two edges.
struct Edges {
    /// `B - A`, `D - C` and `C - A`, rounded.
    k: Vector,
    l: Vector,
    m: Vector,
    /// The size of the box around the points: no difference of two of them is larger, but for the
    /// rounding of one subtraction.
    extent: Vector,
}

impl Edges {
    /// The edges times `2^-exponent`, with the largest extent in `[1, 2)`, unless all is 0.
    ///
    /// The differences are scaled, not the points, for a subtraction does not underflow: what far
    /// points have near each other stays. Where one overflows, the points are taken at a quarter.
    /// What underflows then is below `2^-1070` of the largest extent, as is what underflows where
    /// the differences become smaller.
    fn scaled(corners: &[Vector; 4]) -> (Self, i32) {
        let edges = Edges::new(corners);
        if !largest(&edges.extent).is_finite() {
            let quarters = corners.map(|point| point.map(|x| 0.25 * x));
            let (edges, exponent) = Edges::scaled(&quarters);
            return (edges, exponent + 2);
        }
        let exponent = exponent_of(largest(&edges.extent));
        let Edges { k, l, m, extent } = edges;
        let [k, l, m, extent] = [k, l, m, extent].map(|x| x.map(|x| times_power(x, -exponent)));
        (Edges { k, l, m, extent }, exponent)
    }

    fn are_one_point(&self) -> bool {
        self.extent == [0.0; 3]
    }

    fn new([a, b, c, d]: &[Vector; 4]) -> Self {
        let extent = |i: usize| {
            let (low, high) = (
                a[i].min(b[i]).min(c[i]).min(d[i]),
                a[i].max(b[i]).max(c[i]).max(d[i]),
            );
            high - low
        };
        Edges {
            k: sub(b, a),
            l: sub(d, c),
            m: sub(c, a),
            extent: [extent(0), extent(1), extent(2)],
        }
    }

    /// Where the edges are about nearest, and the difference from AB to CD there.
    ///
    /// The inner points that solve `(M + v L - u K) . K = 0` and `(M + v L - u K) . L = 0`, and
    /// every end with the point of the other edge that is nearest to it.
    fn nearest(&self) -> (EdgePoint, Vector) {
        let Edges { k, l, m, .. } = self;
        let (kk, ll, kl) = (dot(k, k), dot(l, l), dot(k, l));
        let (mk, ml) = (dot(m, k), dot(m, l));
        let on_ab = |v: f64| clamped_quotient(mk + v * kl, kk);
        let on_cd = |u: f64| clamped_quotient(u * kl - ml, ll);
        // Near parallel edges a step from one edge to the other and back mends the quotient.
        let v = on_cd(clamped_quotient(mk * ll - ml * kl, kk * ll - kl * kl));
        let u = on_ab(v);
        let places = [
            (u, on_cd(u)),
            (0.0, on_cd(0.0)),
            (1.0, on_cd(1.0)),
            (on_ab(0.0), 0.0),
            (on_ab(1.0), 1.0),
        ];
        let places_and_differences =
            places.map(|(u, v)| (EdgePoint { u, v }, self.difference(u, v)));
        let mut nearest = places_and_differences[0];
        for other in &places_and_differences[1..] {
            if length(&other.1) < length(&nearest.1) {
                nearest = *other;
            }
        }
        nearest
    }

    /// From the point of AB at `u` to that of CD at `v`.
    fn difference(&self, u: f64, v: f64) -> Vector {
        let Edges { k, l, m, .. } = self;
        sub(&add(m, &l.map(|x| v * x)), &k.map(|x| u * x))
    }

    /// Bounds on the distance, from a difference between two points of the edges; 0 and infinity if
    /// nothing better is certain.
    ///
    /// With `u = 2^-53` and the extents `e_i`: a component of the difference passes three rounded
    /// differences, two products and two sums of values up to `3 e_i`, so it is within `12 u e_i`
    /// of that of the exact points, and the difference within `12 u |e|`. A length has a relative
    /// error below `4 u`.
    ///
    /// For any direction `d` no two points are nearer than the least `X . d` of the four
    /// differences `X` of ends, over `|d|`. That is computed within `22 u S`, `S` the sum of
    /// `e_i |d_i|`, as that of [`SweptBoxes::is_certain`](super::separate::SweptBoxes::is_certain).
    /// `TINY` is far above what underflow adds. What overflows is no bound.
    fn distance(&self, difference: &Vector) -> (f64, f64) {
        let Edges { k, l, m, extent } = self;
        let high = (length(difference) + 16.0 * U * length(extent) + TINY) * (1.0 + 16.0 * U);
        let size = largest(&difference.map(f64::abs));
        let d = difference.map(|x| x / size);
        let along = dot(m, &d) + dot(l, &d).min(0.0) - dot(k, &d).max(0.0);
        let error = 24.0 * U * dot(extent, &d.map(f64::abs)) + TINY;
        let low = (along - error) / length(&d) * (1.0 - 16.0 * U);
        (
            if low > 0.0 && low.is_finite() {
                low
            } else {
                0.0
            },
            if high.is_finite() {
                high
            } else {
                f64::INFINITY
            },
        )
    }
}

/// `n / d` in `[0, 1]`; 0 if it is not a number.
fn clamped_quotient(n: f64, d: f64) -> f64 {
    let quotient = n / d;
    if quotient > 0.0 {
        quotient.min(1.0)
    } else {
        0.0
    }
}

/// The length of a vector, without overflow or underflow of the squares.
fn length(x: &Vector) -> f64 {
    let size = largest(&x.map(f64::abs));
    if size == 0.0 {
        return 0.0;
    }
    let unit = x.map(|x| x / size);
    size * dot(&unit, &unit).sqrt()
}

/// The exponent of the largest power of two that is not above a number; 0 for 0.
fn exponent_of(x: f64) -> i32 {
    let exponent = |x: f64| (x.to_bits() >> 52) as i32 - 1023;
    if x == 0.0 {
        0
    } else if x < f64::MIN_POSITIVE {
        exponent(x * power(54)) - 54
    } else {
        exponent(x)
    }
}

/// `x 2^exponent`, rounded once: the first of two factors leaves the range of numbers on neither
/// side, unless the product does too.
fn times_power(x: f64, exponent: i32) -> f64 {
    let first = exponent.clamp(-1000, 1000);
    match exponent - first {
        0 => x * power(first),
        rest => x * power(rest) * power(first),
    }
}

/// `2^exponent`, for the exponents of normal numbers.
fn power(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// A length times `2^exponent`, rounded down.
fn scaled_down(length: f64, exponent: i32) -> f64 {
    let scaled = times_power(length, exponent).min(f64::MAX);
    match times_power(scaled, -exponent) > length {
        true => scaled.next_down(),
        false => scaled,
    }
}

/// A length times `2^exponent`, rounded up.
fn scaled_up(length: f64, exponent: i32) -> f64 {
    let scaled = times_power(length, exponent);
    match times_power(scaled, -exponent) < length {
        true => scaled.next_up(),
        false => scaled,
    }
}

/// The bounds are nearer to each other than this where the normal comes from them: `1 - 2^-22`.
const CLOSE: f64 = 1.0 - 1.0 / (1 << 22) as f64;

/// Far above what underflow adds.
const TINY: f64 = 1e-300;

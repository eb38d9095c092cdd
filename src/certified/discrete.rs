//! Two edges at one instant: how near they are, and whether that is within a radius.
//!
//! What a simulator asks of pairs that do not tunnel. The points found are an upper bound on the
//! distance, however they were found; a plane between the edges is a lower one. Where the two do
//! not tell on which side of the radius the distance is, integers do.

use nalgebra::Vector3;

use super::exact;
use super::motion::{Vector, add, cross, dot, largest, sub};
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
    /// The two are about `2^-26` of the size of the edges apart where these are nearly parallel,
    /// else a few units in the last place of the coordinates.
    pub distance_high: f64,
    /// Where the edges are nearest; one such place of several.
    ///
    /// The exact points with these parameters are not farther apart than `distance_high`, and the
    /// vector from one to the other is within `sqrt(distance_high^2 - distance_low^2)` of the
    /// shortest one: that is the point nearest to 0 of a convex set, with which other points of the
    /// set make no acute angle.
    pub nearest: EdgePoint,
    /// The points of AB and CD with these parameters, rounded.
    pub points: [Point; 2],
    /// The direction from AB to CD. Where they may touch at distance 0 it is that of `K x L` with
    /// `K = B - A` and `L = D - C`, or `None` if they are parallel.
    pub normal: Option<Vector3<f64>>,
    /// The radius less the distance, up to `distance_high - distance_low` and the rounding of the
    /// radius; 0 where they do not touch.
    pub depth: f64,
}

/// How near two edges are at the start of the step, and whether that is within the radius.
///
/// [`EdgeEdge::at_rest`] makes a query of edges at one instant.
pub fn decide_discrete(query: &EdgeEdge) -> Proximity {
    debug_assert_eq!(environment::check(), Ok(()));
    let (points, radius) = (query.start(), query.radius());
    let corners = points.each_ref().map(|p| [p.x, p.y, p.z]);
    let edges = Edges::new(&corners);
    let (nearest, difference) = edges.nearest();
    let (low, high) = edges.distance(&difference);
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
        points: [between(&a, &b, nearest.u), between(&c, &d, nearest.v)].map(Point::from),
        normal: normalised(&if low > 0.0 {
            difference.into()
        } else {
            cross(&edges.k, &edges.l).into()
        }),
        depth: if touches {
            (rounded - high).max(0.0)
        } else {
            0.0
        },
    }
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

/// Far above what underflow adds.
const TINY: f64 = 1e-300;

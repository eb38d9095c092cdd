//! Where thresholds and rounding excuse the thesis path: near the borders of its decisions.
//!
//! [`is_clear`] is a proof, for one query, that the thesis path has to take the decisions of the
//! same algorithms in exact arithmetic with every threshold 0. Every number that it compares is
//! bounded away from the border by more than its threshold and the error of its computation in
//! `f64`, or is 0 by equal inputs. What is not proved is not clear, so the rule errs to the side of
//! the subject. The rule and its derivation are in `docs/method.md`, "What excuses the thesis
//! path".

use nalgebra::Vector3;
use tunnelproof::contact::Case;
use tunnelproof::query::{EdgeEdge, Point, Query};
use tunnelproof::thesis::Thresholds;

use crate::algebraic::{Algebraic, dyadic, isolate_roots};
use crate::field;
use crate::field::Integer;
use crate::oracle::{self, Step};
use crate::poly::Poly;
use crate::scaled::Scaled;

mod confined;

type Z = field::Default;

/// The unit roundoff of `f64`.
const U: f64 = f64::EPSILON / 2.0;

/// Numbers of other sizes may overflow or underflow in products.
const ORDINARY: std::ops::Range<f64> = 1e-60..1e60;

/// Whether a query is so near to a border between two answers of the thesis' algorithms that either
/// is excused.
pub fn excuses(query: &Query) -> bool {
    match query {
        Query::EdgeEdge(query) => !is_clear(query, &Thresholds::default()),
        Query::VertexFace(_) => false,
    }
}

/// Whether no decision of the thesis path on this query is near its border.
pub fn is_clear(query: &EdgeEdge, thresholds: &Thresholds) -> bool {
    let sizes = Sizes::new(query);
    if !sizes.are_ordinary {
        return false;
    }
    let decision = oracle::decide::<Z>(&Query::EdgeEdge(*query));
    let same = |i, j| is_clearly_same_or_not(query, i, j, thresholds, &sizes);
    match decision.case() {
        // Points that are equal at both ends of the step are so in `f64`, and nothing more is
        // asked.
        Case::Degenerate => true,
        Case::SharedStart => same(0, 1) && same(2, 3),
        case @ (Case::Parallel | Case::Collinear | Case::Coplanar) => {
            confined::is_clear(query, case, thresholds)
        }
        Case::General => {
            let unit = Scaled::<Z>::new(&Query::EdgeEdge(*query)).exponent;
            let f = TripleProduct::new(decision.f(), unit, sizes.error_of_f());
            same(0, 1)
                && same(2, 3)
                && same(0, 2)
                && sizes.is_clearly_turned(thresholds)
                && f.is_clearly_not_zero(thresholds)
                && roots_are_clear(query, &f, &decision.steps(), thresholds, &sizes)
        }
    }
}

/// Algorithms 1 and 2: equal in every bit, or farther apart than the threshold at the start or in
/// velocity.
fn is_clearly_same_or_not(
    query: &EdgeEdge,
    i: usize,
    j: usize,
    thresholds: &Thresholds,
    sizes: &Sizes,
) -> bool {
    let start = query.start()[j] - query.start()[i];
    let end = query.end()[j] - query.end()[i];
    let least = 2.0 * thresholds.dist + 16.0 * U * sizes.coordinate;
    start == Vector3::zeros() && end == Vector3::zeros()
        || start.amax() > least
        || (end - start).amax() > least
}

/// Bounds of what is computed with.
struct Sizes {
    are_ordinary: bool,
    /// Of the coordinates.
    coordinate: f64,
    /// `K`, `L` and `M` at the start and at the end, rounded.
    vectors: [[Vector3<f64>; 2]; 3],
    /// For each of `K`, `L` and `M`: the position at the start, the velocity, and twice the
    /// velocity of a point, all together; in units of it both errors are a few `U`.
    sums: [f64; 3],
    /// Of a velocity of `K`, `L` or `M`.
    velocity: f64,
}

impl Sizes {
    fn new(query: &EdgeEdge) -> Self {
        let points = || query.start().iter().chain(query.end());
        let numbers = || points().flat_map(|point| point.iter().map(|x| x.abs()));
        let velocity_of_points = (query.start().iter().zip(query.end()))
            .map(|(start, end): (&Point, &Point)| (end - start).amax())
            .fold(0.0, f64::max);
        let vectors = [(0, 1), (2, 3), (0, 2)].map(|(from, to): (usize, usize)| {
            [query.start(), query.end()].map(|points| points[to] - points[from])
        });
        let velocities = vectors.map(|[start, end]| (end - start).amax());
        let sum = |h: usize| vectors[h][0].amax() + velocities[h] + 2.0 * velocity_of_points;
        Sizes {
            are_ordinary: numbers().all(|x| x == 0.0 || ORDINARY.contains(&x)),
            coordinate: numbers().fold(0.0, f64::max),
            vectors,
            sums: [0, 1, 2].map(sum),
            velocity: velocities.into_iter().fold(0.0, f64::max),
        }
    }

    /// How far the value of equation 3.9 at a time of the step may be off, with its coefficients,
    /// by rounding: six products of three factors, each off by less than 2^5 U.
    fn error_of_f(&self) -> f64 {
        256.0 * U * self.sums.iter().product::<f64>()
    }

    /// `K`, `L` and `M` at a time.
    fn at(&self, t: f64) -> [Vector3<f64>; 3] {
        self.vectors.map(|[start, end]| start * (1.0 - t) + end * t)
    }

    /// Algorithm 5: `K x L` is so large at some time that one of its three coefficients is above
    /// the threshold.
    fn is_clearly_turned(&self, thresholds: &Thresholds) -> bool {
        let error = 64.0 * U * self.sums[0] * self.sums[1];
        let least = 3.0 * (2.0 * thresholds.coefficients_quadratic + error);
        [0.0, 0.5, 1.0].into_iter().any(|t| {
            let [k, l, _] = self.at(t);
            k.cross(&l).amax() > least
        })
    }
}

/// `f` of equation 3.9, exact, and how far it may be off in `f64`.
struct TripleProduct<'a> {
    f: &'a Poly<Z>,
    /// A coefficient is its integer times this power of two, in cubic metres.
    exponent: i64,
    error: f64,
}

impl<'a> TripleProduct<'a> {
    fn new(f: &'a Poly<Z>, unit: i64, error: f64) -> Self {
        let exponent = 3 * unit;
        TripleProduct { f, exponent, error }
    }

    /// Algorithm 7.
    fn is_clearly_not_zero(&self, thresholds: &Thresholds) -> bool {
        let least = 2.0 * thresholds.coefficients_cubic + self.error;
        let coefficients = self.f.coefficients().iter();
        coefficients
            .map(|c| real(c, self.exponent))
            .any(|c| c.abs() > least)
    }

    /// The value at a time of the step.
    fn at(&self, t: f64) -> f64 {
        let (numerator, bits) = dyadic::<Z>(t);
        let value = self.f.evaluate_dyadic(&numerator, bits);
        real(&value, self.exponent - bits as i64 * self.f.degree() as i64)
    }

    /// Whether the sign in `f64` is that of the value.
    fn has_clear_sign(&self, t: f64) -> bool {
        self.at(t).abs() > 4.0 * self.error
    }

    /// How far from the root `r` one in `f64` may be; `None` if farther than the time threshold.
    fn spread(&self, r: f64, thresholds: &Thresholds) -> Option<f64> {
        let spreads = (1..=50).rev().map(|bits| 0.5f64.powi(bits));
        spreads
            .take_while(|spread| *spread < thresholds.t / 2.0)
            .find(|spread| {
                let ends = [(r - spread).max(0.0), (r + spread).min(1.0)];
                let [low, high] = ends.map(|t| self.at(t) > 0.0);
                low != high && ends.iter().all(|&t| self.has_clear_sign(t))
            })
    }
}

/// `integer 2^exponent`, rounded; 0 where it underflows.
fn real(integer: &Z, exponent: i64) -> f64 {
    let (mantissa, own) = integer.approximate();
    let exponent = (own + exponent).clamp(-4000, 4000) as i32;
    mantissa * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2)
}

/// Algorithms 19 and 16: `Solve` finds the roots of `f` and no others, each within its spread, and
/// at each of them up to the first contact it is clear whether the segments intersect.
fn roots_are_clear(
    query: &EdgeEdge,
    f: &TripleProduct,
    steps: &[Step<Z>],
    thresholds: &Thresholds,
    sizes: &Sizes,
) -> bool {
    let extrema = isolate_roots(&f.f.derivative());
    let borders = extrema.iter().map(rounded).chain([0.0, 1.0]);
    if !borders.into_iter().all(|t| f.has_clear_sign(t)) {
        return false;
    }
    let mut before = 0.0;
    for step in steps {
        let r = rounded(&step.time);
        let Some(spread) = f.spread(r, thresholds) else {
            return false;
        };
        if r - spread <= before {
            return false;
        }
        before = r + spread;
        match Meeting::new(query, step, spread, sizes).is_inside(thresholds) {
            None => return false,
            Some(true) => return true,
            Some(false) => {}
        }
    }
    true
}

/// The number, rounded down.
fn rounded(number: &Algebraic<Z>) -> f64 {
    number.enclosure().below
}

/// The lines of the edges at a root of `f`.
struct Meeting {
    /// Of `K` and `L`.
    lengths: [f64; 2],
    /// Of `K x L`.
    turn: f64,
    /// Of `M`.
    between: f64,
    /// How far each coordinate of `K`, `L` and `M` may be off in `f64`: at another time, and
    /// rounded.
    error: f64,
    /// `u` and `v`, if the lines meet in one point.
    parameters: Option<[f64; 2]>,
}

impl Meeting {
    fn new(query: &EdgeEdge, step: &Step<Z>, spread: f64, sizes: &Sizes) -> Self {
        let [k, l, m] = sizes.at(rounded(&step.time));
        let far = query.start().iter().chain(query.end());
        let far = far.fold(0.0, |far: f64, point| far.max(point.coords.amax()));
        Meeting {
            lengths: [k.norm(), l.norm()],
            turn: k.cross(&l).norm(),
            between: m.norm(),
            error: spread * sizes.velocity + 32.0 * U * far,
            parameters: step.meeting,
        }
    }

    /// Whether the point in which the lines meet is within both segments; `None` if it is not clear
    /// that the thesis path sees what is so.
    fn is_inside(&self, thresholds: &Thresholds) -> Option<bool> {
        let [u, v] = self.parameters?;
        let [k, l] = self.lengths;
        let error = 2.0 * self.error;
        let has_length = k.min(l) > 2.0 * thresholds.direction + error;
        let is_turned = self.turn > 2.0 * thresholds.parallel + 4.0 * (k + l + error) * error;
        if !has_length || !is_turned {
            return None;
        }
        let off = self.error_of_parameters(u, v);
        let inside = |x: f64| x >= off && x <= 1.0 - off;
        let outside = |x: f64| x < -off || x > 1.0 + off;
        if inside(u) && inside(v) {
            let residual = (k + l) * off + 6.0 * error;
            (residual < thresholds.dist_1d / 2.0).then_some(true)
        } else {
            (outside(u) || outside(v)).then_some(false)
        }
    }

    /// How far `u` and `v` may be off: least squares of slightly other vectors, by normal equations
    /// in `f64`.
    ///
    /// The least singular value of the system is at least `turn / size`, and the residual is 0.
    fn error_of_parameters(&self, u: f64, v: f64) -> f64 {
        let [k, l] = self.lengths;
        let size = k.hypot(l);
        let condition = size / self.turn;
        let parameters = u.abs() + v.abs();
        let disturbed = 4.0 * self.error * (1.0 + parameters) * condition;
        let rounded = 64.0 * U * condition * condition * size * (size * parameters + self.between);
        2.0 * (disturbed + rounded)
    }
}

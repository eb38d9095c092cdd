//! How near two edges come during a step: the least distance, exactly enough to judge a false hit.
//!
//! Whether the distance is at most `R` at some time of the step is decided exactly, by evaluating
//! its description at every candidate, as in [`super::literal`]; the least distance follows by
//! bisection on `R`, from a guess in floating point, which can cost time only. With `E = Z - Y`, `w = X - Y` and `e2 = E.E`, the edges are within `R` when
//!
//! - `N.N > 0`, `f^2 <= R^2 N.N`, and the lines are nearest inside both edges, or
//! - an end `X` is within `R` of an end of the other edge `YZ`, or
//! - `e2 > 0`, `0 <= w.E <= e2` and `|w x E|^2 <= R^2 e2` for an end `X` and the other edge `YZ`.

use nalgebra::Vector3;
use tunnelproof::query::{EdgeEdge, Query};

use crate::algebraic::{Algebraic, decompose, isolate_roots};
use crate::answer::Enclosure;
use crate::field::{self, Integer};
use crate::poly::Poly;
use crate::scaled::Scaled;

use super::motion::{End, Motion};
use super::vector::Vector;

/// Whether the two edges come within `distance` metres of each other during the step, exactly. The
/// radius of the query does not count; `distance` is finite and not negative.
pub fn comes_within(query: &EdgeEdge, distance: f64) -> bool {
    Proximity::<field::Default>::new(query).is_within(distance)
}

/// The least distance of the two edges during the step in metres, between two `f64` that differ by
/// less than one part in a thousand (or are neighbours).
pub fn least_distance(query: &EdgeEdge) -> Enclosure {
    let proximity = Proximity::<field::Default>::new(query);
    if proximity.is_within(0.0) {
        return Enclosure::exactly(0.0);
    }
    // The bits of an f64 above 0 are in the order of the values.
    let (mut below, mut above) = (0, f64::MAX.to_bits());
    let guess = estimate_distance(query);
    let mut cuts = [guess * 0.9996, guess * 1.0004].into_iter();
    while above - below > 1 && f64::from_bits(below) * 1.001 < f64::from_bits(above) {
        let guessed = cuts
            .next()
            .map(f64::to_bits)
            .filter(|cut| (below + 1..above).contains(cut));
        let cut = guessed.unwrap_or(below + (above - below) / 2);
        if proximity.is_within(f64::from_bits(cut)) {
            above = cut
        } else {
            below = cut
        }
    }
    Enclosure {
        below: f64::from_bits(below),
        above: f64::from_bits(above),
    }
}

/// The least distance in metres in floating point, by sampling and ternary search. Heuristic: to choose
/// what to measure exactly.
pub fn estimate_distance(query: &EdgeEdge) -> f64 {
    let distance = |t: f64| {
        let at = |i: usize| query.start()[i].coords * (1.0 - t) + query.end()[i].coords * t;
        distance_of_segments(&[at(0), at(1), at(2), at(3)])
    };
    const SAMPLES: u32 = 64;
    let time = |i: u32| f64::from(i) / f64::from(SAMPLES);
    let nearest = (0..=SAMPLES).min_by(|&i, &j| distance(time(i)).total_cmp(&distance(time(j))));
    let nearest = nearest.unwrap_or(0);
    let (mut low, mut high) = (
        time(nearest.saturating_sub(1)),
        time((nearest + 1).min(SAMPLES)),
    );
    for _ in 0..60 {
        let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if distance(left) < distance(right) {
            high = right
        } else {
            low = left
        }
    }
    distance(low).min(distance(time(nearest)))
}

/// The distance of two segments in floating point: of an end from the other segment, or of the lines.
fn distance_of_segments([a, b, c, d]: &[Vector3<f64>; 4]) -> f64 {
    let to_segment = |x: &Vector3<f64>, y: &Vector3<f64>, z: &Vector3<f64>| {
        let edge = z - y;
        let s = (x - y).dot(&edge) / edge.dot(&edge);
        (x - y - edge * if s > 0.0 { s.min(1.0) } else { 0.0 }).norm()
    };
    let of_ends = to_segment(a, c, d).min(to_segment(b, c, d));
    let of_ends = of_ends.min(to_segment(c, a, b)).min(to_segment(d, a, b));
    let (k, l, m) = (b - a, d - c, c - a);
    let n = k.cross(&l);
    let (u, v) = (m.cross(&l).dot(&n), m.cross(&k).dot(&n));
    let inside = 0.0..=n.norm_squared();
    if n.norm() > 0.0 && inside.contains(&u) && inside.contains(&v) {
        of_ends.min(m.dot(&n).abs() / n.norm())
    } else {
        of_ends
    }
}

/// The polynomials that the distance is described by, without the radius.
struct Proximity<Z> {
    /// A coordinate is its integer times `2^exponent` metres.
    exponent: i64,
    n2: Poly<Z>,
    f2: Poly<Z>,
    /// At least 0 where the lines are nearest inside both edges.
    inside: [Poly<Z>; 4],
    ends: [EndProximity<Z>; 4],
}

/// An end `X` against the other edge `YZ`.
struct EndProximity<Z> {
    /// `|X - Y|^2` and `|X - Z|^2`.
    squares: [Poly<Z>; 2],
    e2: Poly<Z>,
    /// `w.E` and `e2 - w.E`: at least 0 where `X` is nearest inside the edge.
    inside: [Poly<Z>; 2],
    /// `|w x E|^2`.
    area2: Poly<Z>,
}

impl<Z: Integer> EndProximity<Z> {
    fn new(end: &End<Z>) -> Self {
        let edge = end.to_z.sub(&end.to_y);
        let square = |v: &Vector<Z>| v.dot(v);
        EndProximity {
            squares: [square(&end.to_y), square(&end.to_z)],
            e2: square(&edge),
            inside: [end.to_y.dot(&edge).neg(), end.to_z.dot(&edge)],
            area2: square(&end.turn),
        }
    }
}

impl<Z: Integer> Proximity<Z> {
    fn new(query: &EdgeEdge) -> Self {
        let points = Scaled::new(&Query::EdgeEdge(*query));
        let motion = Motion::new(&points);
        let Motion { k, l, m, n, f } = &motion;
        let (n2, u, w) = (n.dot(n), m.cross(l).dot(n), m.cross(k).dot(n));
        let inside = [u.clone(), n2.sub(&u), w.clone(), n2.sub(&w)];
        let ends = motion.ends().each_ref().map(EndProximity::new);
        Proximity {
            exponent: points.exponent,
            f2: f.mul(f),
            n2,
            inside,
            ends,
        }
    }

    fn is_within(&self, distance: f64) -> bool {
        // distance^2 = numerator / 2^shift in units of the squared coordinates
        let (mantissa, exponent) = decompose(distance);
        let exponent = 2 * (exponent - self.exponent);
        let square = Z::from_i64(mantissa).mul(&Z::from_i64(mantissa));
        let (r2, shift) = match exponent {
            0.. => (square.shl(exponent.unsigned_abs()), 0),
            _ => (square, exponent.unsigned_abs()),
        };
        // At most 0 where x <= R^2 y.
        let excess = |x: &Poly<Z>, y: &Poly<Z>| {
            let mut excess = x.scale(&Z::one().shl(shift));
            excess.sub_product(&Poly::constant(r2.clone()), y);
            excess
        };
        let one = Poly::constant(Z::one());
        let lines = Region {
            above: &self.n2,
            at_least: &self.inside,
            at_most: excess(&self.f2, &self.n2),
        };
        let mut regions = vec![lines];
        for end in &self.ends {
            for square in &end.squares {
                let at_most = excess(square, &one);
                regions.push(Region {
                    above: &one,
                    at_least: &[],
                    at_most,
                });
            }
            let at_most = excess(&end.area2, &end.e2);
            regions.push(Region {
                above: &end.e2,
                at_least: &end.inside,
                at_most,
            });
        }
        regions.iter().any(|region| region.is_not_empty())
    }
}

/// The times at which some polynomials have given signs.
struct Region<'a, Z> {
    above: &'a Poly<Z>,
    at_least: &'a [Poly<Z>],
    at_most: Poly<Z>,
}

impl<Z: Integer> Region<'_, Z> {
    /// Whether some time of the step is in the region; may say no if the region reaches only up to
    /// times at which `above` is 0.
    ///
    /// The signs change at roots only, so a part of the region ends at 0, at 1, at a root of one of
    /// the other polynomials (all of them candidates), or where `above` is 0. There the edges are
    /// parallel or an edge is a point, and as near by continuity; then an end is as near as any
    /// point, and the region of that end (and of its corner, where the other edge is a point too)
    /// says yes.
    fn is_not_empty(&self) -> bool {
        let mut candidates = vec![Algebraic::zero(), Algebraic::dyadic(Z::one(), 0)];
        candidates.extend(isolate_roots(&self.at_most));
        candidates.extend(self.at_least.iter().flat_map(isolate_roots));
        let holds = |time: &Algebraic<Z>| {
            time.sign_of(&self.at_most).is_le()
                && self.at_least.iter().all(|poly| time.sign_of(poly).is_ge())
                && time.sign_of(self.above).is_gt()
        };
        candidates.iter().any(holds)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use tunnelproof::query::Point;

    use super::*;
    use crate::oracle::decide;

    fn query(points: [[f64; 3]; 8]) -> EdgeEdge {
        let p = points.map(|[x, y, z]| Point::new(x, y, z));
        EdgeEdge::new([p[0], p[1], p[2], p[3]], [p[4], p[5], p[6], p[7]], 0.0).unwrap()
    }

    #[test]
    fn least_distance_known_values() {
        let still = [[-1., 0., 0.], [1., 0., 0.]];
        let pass = |c: [f64; 3], d: [f64; 3], e: [f64; 3], f: [f64; 3]| {
            least_distance(&query([still[0], still[1], c, d, still[0], still[1], e, f]))
        };
        let near = |gap: Enclosure, value: f64| {
            assert!(
                gap.below < value && value <= gap.above,
                "{gap} instead of {value}"
            );
            assert!(gap.above <= gap.below * 1.001);
        };
        // Line above line, sideways past the end, parallel, and a point.
        near(
            pass([0., -1., 3.], [0., 1., 3.], [0., -1., 0.25], [0., 1., 0.25]),
            0.25,
        );
        near(
            pass(
                [1.5, -1., 3.],
                [1.5, 1., 3.],
                [1.5, -1., -3.],
                [1.5, 1., -3.],
            ),
            0.5,
        );
        near(
            pass([0., 0., 3.], [9., 0., 3.], [0., 0., 1e-9], [9., 0., 1e-9]),
            1e-9,
        );
        near(
            pass([4., 4., 0.], [4., 4., 0.], [4., 4., 0.], [4., 4., 0.]),
            5.0,
        );
        // Nearest in the middle of the step only.
        near(
            pass([2., 5., 0.], [2., 6., 0.], [2., -6., 0.], [2., -5., 0.]),
            1.0,
        );
        let crossing = pass([0., -1., 1.], [0., 1., 1.], [0., -1., -1.], [0., 1., -1.]);
        assert_eq!(crossing, Enclosure::exactly(0.0));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]

        #[test]
        fn comes_within_zero_is_a_hit(points in prop::array::uniform8(prop::array::uniform3(-2i8..=2))) {
            let query = query(points.map(|p| p.map(f64::from)));
            let hit = decide::<field::Default>(&query).unwrap().toi().is_some();
            prop_assert_eq!(comes_within(&query, 0.0), hit);
        }

        #[test]
        fn least_distance_is_not_above_any_sampled_distance(
            points in prop::array::uniform8(prop::array::uniform3(-4i8..=4)),
        ) {
            let query = query(points.map(|p| p.map(f64::from)));
            let gap = least_distance(&query);
            let at = |t: f64, i: usize| {
                query.start()[i].coords * (1.0 - t) + query.end()[i].coords * t
            };
            let mut sampled = f64::MAX;
            for i in 0..=64 {
                let t = f64::from(i) / 64.0;
                let [a, b, c, d] = [0, 1, 2, 3].map(|i| at(t, i));
                for j in 0..=16 {
                    for k in 0..=16 {
                        let (u, v) = (f64::from(j) / 16.0, f64::from(k) / 16.0);
                        sampled = sampled.min((a + (b - a) * u - c - (d - c) * v).norm());
                    }
                }
            }
            prop_assert!(gap.below <= sampled * (1.0 + 1e-9), "{} {}", gap, sampled);
            // Half a step of the grid moves the points by at most 14 (1/64 + 1/16).
            prop_assert!(gap.above >= sampled - 1.1, "{} {}", gap, sampled);
        }
    }
}

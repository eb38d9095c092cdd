//! The judge of contact points: how far a point in space is from the exact contact.
//!
//! The exact contact is known by the oracle's neighbours in `f64` of the time of impact and of the
//! parameters. A coordinate is linear in each of them, so it lies between its values at the ends of
//! these intervals, in rational numbers. What is said to be too far off is so for every contact
//! that the intervals allow: no point is accused falsely.
//!
//! A point means one on the first side: on AB, or the vertex. Where two edges overlap, or are
//! nearest, in more than a point, every point of that stretch of AB is right.

use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};
use tunnelproof::query::{Point, Query};

use crate::answer::{Enclosure, ExactHit};
use crate::vector::{dot, sub};

type Vector = [BigRational; 3];

/// Where two sides touch at the exact time of impact, on the first of them.
pub struct Places {
    /// The ends of the stretch of contact, up to `width`; the same where it is a point.
    ends: [Vector; 2],
    /// No exact point of contact is farther from the stretch, and the other way round.
    width: BigRational,
}

impl Places {
    /// The places of an exact contact.
    pub fn new(query: &Query, hit: &ExactHit) -> Self {
        let end = |u: Enclosure| match query {
            Query::EdgeEdge(_) => Range::of_edge(query, hit.toi, u),
            Query::VertexFace(_) => Range::of_edge(query, hit.toi, Enclosure::exactly(0.0)),
        };
        let second = hit.second.unwrap_or(hit.first);
        let ranges = [hit.first.u, second.u].map(end);
        let [first, second] = ranges.each_ref().map(Range::width);
        Places {
            width: first.max(second),
            ends: ranges.map(|range| range.middle),
        }
    }

    /// Whether a point may be within so many metres of a point of contact; a point that is not
    /// finite never is.
    pub fn may_be_within(&self, point: &Point, metres: f64) -> bool {
        let (Some(point), Some(metres)) = (vector(point), BigRational::from_float(metres)) else {
            return false;
        };
        let reach = metres + &self.width;
        !reach.is_negative() && self.squared(&point) <= &reach * &reach
    }

    /// How far a point is from the contact in metres, up to some parts in 2^50 of the coordinates;
    /// infinite for a point that is not finite.
    pub fn distance(&self, point: &Point) -> f64 {
        let squared = vector(point).map(|point| self.squared(&point));
        let squared = squared.and_then(|squared| squared.to_f64());
        squared.map_or(f64::INFINITY, f64::sqrt)
    }

    /// The squared distance of a point from the stretch.
    fn squared(&self, point: &Vector) -> BigRational {
        let [first, second] = &self.ends;
        let (edge, way) = (sub(second, first), sub(point, first));
        let length = dot(&edge, &edge);
        let share = match length.is_zero() {
            true => BigRational::zero(),
            false => (dot(&way, &edge) / length).clamp(BigRational::zero(), BigRational::one()),
        };
        let off = [0, 1, 2].map(|i| &way[i] - &share * &edge[i]);
        dot(&off, &off)
    }
}

/// Where a point may be.
struct Range {
    middle: Vector,
    /// How far from the middle on each axis.
    half: Vector,
}

impl Range {
    /// The point of AB at a parameter, at a time.
    fn of_edge(query: &Query, toi: Enclosure, u: Enclosure) -> Self {
        let (start, end) = (query.start(), query.end());
        let axes = [0, 1, 2].map(|i| {
            let at = |t: &BigRational, u: &BigRational| {
                let moved = |k: usize| between(&number(start[k][i]), &number(end[k][i]), t);
                between(&moved(0), &moved(1), u)
            };
            let times = [toi.below, toi.above].map(number);
            let shares = [u.below, u.above].map(number);
            let all = times
                .iter()
                .flat_map(|t| shares.iter().map(move |u| (t, u)));
            let values: Vec<_> = all.map(|(t, u)| at(t, u)).collect();
            let first = values[0].clone();
            let least = values.iter().fold(first.clone(), |x, y| x.min(y.clone()));
            let most = values.into_iter().fold(first, BigRational::max);
            let two = number(2.0);
            ((&least + &most) / &two, (most - least) / two)
        });
        let [(x, dx), (y, dy), (z, dz)] = axes;
        Range {
            middle: [x, y, z],
            half: [dx, dy, dz],
        }
    }

    /// No point of it is farther from the middle.
    fn width(&self) -> BigRational {
        self.half.iter().sum()
    }
}

fn vector(point: &Point) -> Option<Vector> {
    let [x, y, z] = [point.x, point.y, point.z].map(BigRational::from_float);
    Some([x?, y?, z?])
}

/// A number of a query or of an exact answer, which are finite.
fn number(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap_or_else(BigRational::zero)
}

fn between(a: &BigRational, b: &BigRational, t: &BigRational) -> BigRational {
    a + t * (b - a)
}

#[cfg(test)]
mod tests;

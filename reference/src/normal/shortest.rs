//! The shortest vector between two sides in integers: all features are tried.
//!
//! Vectors are exact up to a factor above 0.

use num_bigint::BigInt;
use tunnelproof::query::QueryKind;

use crate::vector::{cross, dot, sub};

pub(super) type Vector = [BigInt; 3];

pub(super) fn times(factor: &BigInt, x: &Vector) -> Vector {
    x.each_ref().map(|x| factor * x)
}

/// The vector `way / by`, `by` above 0.
struct Candidate {
    way: Vector,
    by: BigInt,
}

impl Candidate {
    fn is_shorter(&self, other: &Self) -> bool {
        dot(&self.way, &self.way) * &other.by * &other.by
            < dot(&other.way, &other.way) * &self.by * &self.by
    }
}

/// From a point to the nearest one of a segment.
fn to_segment(x: &Vector, y: &Vector, z: &Vector) -> Candidate {
    let (edge, to_y, to_z) = (sub(z, y), sub(y, x), sub(z, x));
    let (square, along) = (dot(&edge, &edge), -dot(&to_y, &edge));
    let zero = BigInt::ZERO;
    let one = BigInt::from(1);
    if along <= zero {
        Candidate { way: to_y, by: one }
    } else if along >= square {
        Candidate { way: to_z, by: one }
    } else {
        let foot = [0, 1, 2].map(|i: usize| &to_y[i] * &square + &edge[i] * &along);
        Candidate {
            way: foot,
            by: square,
        }
    }
}

fn reversed(candidate: Candidate) -> Candidate {
    Candidate {
        way: candidate.way.map(|x| -x),
        ..candidate
    }
}

/// From the line of AB to that of CD, or from A to the plane of B, C and D, if that ends inside;
/// the part of `m` along the perpendicular of `k` and `l`. `is_inside` is asked for the two shares
/// of `k` and `l` that go to the nearest points, times the last number.
fn perpendicular(
    m: &Vector,
    k: &Vector,
    l: &Vector,
    is_inside: impl Fn(&BigInt, &BigInt, &BigInt) -> bool,
) -> Option<Candidate> {
    let n = cross(k, l);
    let square = dot(&n, &n);
    if square == BigInt::ZERO {
        return None;
    }
    // m = s k + t l + r n
    let (s, t) = (dot(&cross(m, l), &n), dot(&cross(k, m), &n));
    is_inside(&s, &t, &square).then(|| Candidate {
        way: times(&dot(m, &n), &n),
        by: square,
    })
}

/// The shortest vector from the first side to the second.
pub(super) fn shortest(kind: QueryKind, [a, b, c, d]: &[Vector; 4]) -> Vector {
    let is_in = |x: &BigInt, one: &BigInt| *x >= BigInt::ZERO && x <= one;
    let candidates = match kind {
        QueryKind::EdgeEdge => {
            let cut = perpendicular(&sub(c, a), &sub(b, a), &sub(d, c), |s, t, one| {
                // C - A = s K + t L + ..., so that C - t L is the point of CD
                is_in(s, one) && is_in(&-t, one)
            });
            vec![
                Some(to_segment(a, c, d)),
                Some(to_segment(b, c, d)),
                Some(reversed(to_segment(c, a, b))),
                Some(reversed(to_segment(d, a, b))),
                cut,
            ]
        }
        QueryKind::VertexFace => {
            let foot = perpendicular(&sub(a, b), &sub(c, b), &sub(d, b), |s, t, one| {
                is_in(s, one) && is_in(t, one) && s + t <= *one
            });
            vec![
                Some(to_segment(a, b, c)),
                Some(to_segment(a, c, d)),
                Some(to_segment(a, d, b)),
                foot.map(reversed),
            ]
        }
    };
    let all = candidates.into_iter().flatten();
    let shortest = all.reduce(|best, other| match other.is_shorter(&best) {
        true => other,
        false => best,
    });
    shortest.expect("there are candidates").way
}

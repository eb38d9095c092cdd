//! The shortest vector between two sides in integers, and its direction.
//!
//! It is found by trying all features. Vectors are exact up to a factor above 0, directions are
//! numbers in fixed point.

use num_bigint::BigInt;
use tunnelproof::certified::Normal;
use tunnelproof::query::QueryKind;
use tunnelproof_reference::algebraic::Algebraic;

/// The bits of numbers in fixed point.
pub(crate) const BITS: u64 = 200;

pub(crate) type Vector = [BigInt; 3];

pub(crate) fn sub(x: &Vector, y: &Vector) -> Vector {
    [0, 1, 2].map(|i: usize| &x[i] - &y[i])
}

pub(crate) fn times(factor: &BigInt, x: &Vector) -> Vector {
    x.each_ref().map(|x| factor * x)
}

pub(crate) fn dot(x: &Vector, y: &Vector) -> BigInt {
    &x[0] * &y[0] + &x[1] * &y[1] + &x[2] * &y[2]
}

pub(crate) fn cross(x: &Vector, y: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j): (usize, usize)| &x[i] * &y[j] - &x[j] * &y[i])
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
pub(crate) fn shortest(kind: QueryKind, [a, b, c, d]: &[Vector; 4]) -> Vector {
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

/// The direction in fixed point; `None` of 0.
pub(crate) fn direction(way: &Vector) -> Option<Vector> {
    let bits = way.iter().map(BigInt::bits).max().expect("three");
    let up = (4 * BITS).saturating_sub(bits);
    let way = way.each_ref().map(|x| x << up);
    let length = dot(&way, &way).sqrt();
    (bits > 0).then(|| way.map(|x| (x << BITS) / &length))
}

pub(crate) fn to_f64(x: &BigInt) -> f64 {
    let down = x.bits().saturating_sub(64);
    let head = i128::try_from(x >> down).expect("64 bits");
    head as f64 * 2f64.powi(down as i32 - BITS as i32)
}

pub(crate) fn distance(x: &Vector, y: &Vector) -> f64 {
    let [x, y, z] = sub(x, y).each_ref().map(to_f64);
    x.hypot(y).hypot(z)
}

pub(crate) fn fixed(normal: &Normal) -> Vector {
    let fixed = |x: f64| {
        let bits = x.to_bits();
        let biased = (bits >> 52 & 0x7ff) as i64;
        let mantissa = (bits & ((1 << 52) - 1)) | u64::from(biased != 0) << 52;
        let shift = biased.max(1) - 1075 + BITS as i64;
        let magnitude = match shift < 0 {
            true => BigInt::from(mantissa) >> shift.unsigned_abs(),
            false => BigInt::from(mantissa) << shift,
        };
        if x < 0.0 { -magnitude } else { magnitude }
    };
    [normal.direction.x, normal.direction.y, normal.direction.z].map(fixed)
}

/// The direction to which that of the shortest vector tends before a time, in fixed point; at the
/// start, that there, `None` if it is 0.
///
/// `direction_at` has it at `numerator / 2^exponent`. The time before which it is taken is so near
/// that nearer ones no longer turn it: no point moves by more than `2^-200` of the smallest unit of
/// the coordinates, of which the largest has `span` bits.
pub(crate) fn direction_before(
    toi: &Algebraic<BigInt>,
    span: u64,
    direction_at: impl Fn(&BigInt, u64) -> Option<Vector>,
) -> Option<Vector> {
    if toi.is_zero() {
        return direction_at(&BigInt::ZERO, 0);
    }
    // 2^-least is below the time of impact.
    let mut least = 64;
    while {
        toi.refine(least);
        toi.bounds().0 == BigInt::ZERO
    } {
        least *= 2;
    }
    let mut last: Option<Vector> = None;
    let mut bits = least + span + 200;
    loop {
        toi.refine(bits);
        let (low, _, exponent) = toi.bounds();
        let common = exponent.max(bits);
        let before = (low << (common - exponent)) - (BigInt::from(1) << (common - bits));
        let here = direction_at(&before, common).expect("apart before contact");
        if let Some(last) = last
            && distance(&last, &here) < 2f64.powi(-90)
        {
            return Some(here);
        }
        last = Some(here);
        bits *= 2;
    }
}

/// How far a normal is from the exact one, in units of its bound, and how far from length 1.
pub(crate) fn deviation(normal: &Normal, exact: &Vector) -> (f64, f64) {
    let own = fixed(normal);
    let length = dot(&own, &own).sqrt() - (BigInt::from(1) << BITS);
    (distance(&own, exact) / normal.error, to_f64(&length).abs())
}

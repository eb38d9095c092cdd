//! The exact contact normal, and normals judged by it.
//!
//! The normal of a contact is the direction of the shortest vector from the first side to the second,
//! a moment before the first contact ([`Hit::normal`](tunnelproof::contact::Hit::normal)). Here that vector is found in integers, by trying
//! all features, at a time so shortly before the oracle's time of impact that nearer ones no longer
//! turn it. With a radius above 0 that is the normal at the contact too, because the vector is
//! continuous there.

use num_bigint::BigInt;
use tunnelproof::certified::Normal;
use tunnelproof::query::Query;
use tunnelproof::rigid::RigidQuery;

use crate::algebraic::Algebraic;
use crate::oracle;
use crate::scaled::{Scaled, ScaledBody, ScaledRigid, ScaledSide};
use crate::vector::{cross, dot, sub};

mod shortest;

use shortest::{Vector, shortest, times};

/// The bits of numbers in fixed point.
const BITS: u64 = 200;

/// The largest bound on its error that the engine may state with a normal.
const WORST: f64 = 1.0 / (1u64 << 32) as f64;

/// How far from 1 the length of a normal may be.
const OFF_UNIT: f64 = 1.0 / (1u64 << 50) as f64;

/// The exact normal of a contact; there is none where the sides touch at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct ExactNormal(Option<Vector>);

impl ExactNormal {
    /// The exact normal of a query; `None` of a miss.
    pub fn of(query: &Query) -> Option<Self> {
        let decision = oracle::decide::<BigInt>(query);
        let toi = decision.toi()?;
        let points = Scaled::<BigInt>::new(query);
        let direction_at = |numerator: &BigInt, exponent: u64| {
            let one = BigInt::from(1) << exponent;
            let at = [0, 1, 2, 3]
                .map(|p: usize| line([&points.start[p], &points.end[p]], numerator, &one));
            direction(&shortest(query.kind(), &at))
        };
        let all = points.start.iter().chain(&points.end).flatten();
        let span = all.map(BigInt::bits).max().expect("24");
        Some(ExactNormal(direction_before(toi, span, direction_at)))
    }

    /// The exact normal of a query of bodies that turn; `None` of a miss.
    pub fn of_rigid(query: &RigidQuery) -> Option<Self> {
        let decision = oracle::decide_rigid::<BigInt>(query);
        let toi = decision.toi()?;
        let scaled = ScaledRigid::<BigInt>::new(query);
        let kind = query.kind().linear();
        let direction_at = |at: &BigInt, exponent: u64| {
            let one = BigInt::from(1) << exponent;
            direction(&shortest(kind, &points(&scaled, at, &one)))
        };
        Some(ExactNormal(direction_before(
            toi,
            span(&scaled),
            direction_at,
        )))
    }

    /// Its coordinates, rounded; `None` where there is no normal.
    pub fn rounded(&self) -> Option<[f64; 3]> {
        let direction = self.0.as_ref()?;
        Some(direction.each_ref().map(to_f64))
    }

    /// Judges the normal of a hit: it must be there if there is one, be off by no more than the bound
    /// that comes with it, which must be at most `2^-32`, and have the length 1 within `2^-50`.
    /// Returns how far it is off in units of its bound; 0 where there is no normal.
    ///
    /// # Errors
    ///
    /// What is wrong, in a line.
    pub fn judge(&self, found: Option<&Normal>) -> Result<f64, String> {
        let (exact, normal) = match (&self.0, found) {
            (None, None) => return Ok(0.0),
            (Some(exact), Some(normal)) => (exact, normal),
            _ => {
                return Err(format!(
                    "the normal {found:?} instead of {:?}",
                    self.rounded()
                ));
            }
        };
        let (off, from_unit) = deviation(normal, exact);
        if off <= 1.0 && normal.error <= WORST && from_unit <= OFF_UNIT {
            return Ok(off);
        }
        let exact = self.rounded();
        Err(format!(
            "the normal {normal:?} instead of {exact:?}, off by {off:e} bounds"
        ))
    }
}

/// `(1 - t) start + t end` for `t = at / one`, times `one`.
fn line<const N: usize>([start, end]: [&[BigInt; N]; 2], at: &BigInt, one: &BigInt) -> [BigInt; N] {
    let rest = one - at;
    std::array::from_fn(|i| &rest * &start[i] + at * &end[i])
}

/// The places of a body's points at `t = at / one`, times `one` and the second number.
fn places(body: &ScaledBody<BigInt>, at: &BigInt, one: &BigInt) -> (Vec<Vector>, BigInt) {
    let centre = line(body.centres.each_ref(), at, one);
    let [w, x, y, z] = line(body.quaternions.each_ref(), at, one);
    let v = [x, y, z];
    let (ww, vv) = (&w * &w, dot(&v, &v));
    let (square, difference) = (&ww + &vv, &ww - &vv);
    // |q|^2 R x = (w^2 - v . v) x + 2 (v . x) v + 2 w (v x x)
    let turned = |x: &Vector| -> Vector {
        let (along, across) = (dot(&v, x), cross(&v, x));
        std::array::from_fn(|i| {
            &difference * &x[i] + BigInt::from(2) * (&along * &v[i] + &w * &across[i])
        })
    };
    let place = |x: &Vector| -> Vector {
        let turned = turned(x);
        std::array::from_fn(|i| &square * &centre[i] + one * &turned[i])
    };
    (body.local.iter().map(place).collect(), square)
}

/// All four points at `t = at / one`, times a number above 0.
fn points(query: &ScaledRigid<BigInt>, at: &BigInt, one: &BigInt) -> [Vector; 4] {
    let (second, of_second) = places(&query.second, at, one);
    let (first, of_first) = match &query.first {
        ScaledSide::Straight(points) => {
            let points = points.iter().map(|both| line(both.each_ref(), at, one));
            (points.collect(), BigInt::from(1))
        }
        ScaledSide::Turning(body) => places(body, at, one),
    };
    let first = first.iter().map(|x| times(&of_second, x));
    let second = second.iter().map(|x| times(&of_first, x));
    let all: Vec<Vector> = first.chain(second).collect();
    all.try_into().expect("four points")
}

/// The bits of the largest number.
fn span(query: &ScaledRigid<BigInt>) -> u64 {
    let of_body = |body: &ScaledBody<BigInt>| {
        let numbers = body.local.iter().chain(&body.centres).flatten();
        let all = numbers.chain(body.quaternions.iter().flatten());
        all.map(BigInt::bits).max().expect("centres")
    };
    let first = match &query.first {
        ScaledSide::Straight(points) => {
            let all = points.iter().flatten().flatten();
            all.map(BigInt::bits).max().expect("points")
        }
        ScaledSide::Turning(body) => of_body(body),
    };
    first.max(of_body(&query.second))
}

/// The direction in fixed point; `None` of 0.
fn direction(way: &Vector) -> Option<Vector> {
    let bits = way.iter().map(BigInt::bits).max().expect("three");
    let up = (4 * BITS).saturating_sub(bits);
    let way = way.each_ref().map(|x| x << up);
    let length = dot(&way, &way).sqrt();
    (bits > 0).then(|| way.map(|x| (x << BITS) / &length))
}

fn to_f64(x: &BigInt) -> f64 {
    let down = x.bits().saturating_sub(64);
    let head = i128::try_from(x >> down).expect("64 bits");
    head as f64 * 2f64.powi(down as i32 - BITS as i32)
}

fn distance(x: &Vector, y: &Vector) -> f64 {
    let [x, y, z] = sub(x, y).each_ref().map(to_f64);
    x.hypot(y).hypot(z)
}

fn fixed(normal: &Normal) -> Vector {
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
fn direction_before(
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
fn deviation(normal: &Normal, exact: &Vector) -> (f64, f64) {
    let own = fixed(normal);
    let length = dot(&own, &own).sqrt() - (BigInt::from(1) << BITS);
    (distance(&own, exact) / normal.error, to_f64(&length).abs())
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;
    use tunnelproof::query::{Point, QueryKind};

    use super::*;

    /// AB along x at rest, CD along y, which falls through it.
    fn exact() -> ExactNormal {
        let at = |z| {
            [
                [-1.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
                [0.0, -1.0, z],
                [0.0, 1.0, z],
            ]
        };
        let [start, end] = [1.0, -1.0].map(|z| at(z).map(|[x, y, z]| Point::new(x, y, z)));
        let query = Query::new(QueryKind::EdgeEdge, start, end, [0.0; 2]).unwrap();
        ExactNormal::of(&query).expect("a hit")
    }

    #[test]
    fn normals_are_judged_by_their_bound_its_limit_and_their_length() {
        let judge = |z: f64, error: f64| {
            let direction = Vector3::new(0.0, 0.0, z);
            exact().judge(Some(&Normal { direction, error }))
        };
        let (unit, most) = ((-50f64).exp2(), (-32f64).exp2());
        assert_eq!(judge(1.0, most), Ok(0.0));
        assert_eq!(judge(1.0 + unit, unit), Ok(1.0));
        assert_eq!(judge(1.0 - unit, unit), Ok(1.0));
        // Off by more than is stated; a bound that is too large; too long; too short.
        assert!(judge(1.0 + unit, unit / 2.0).is_err());
        assert!(judge(1.0, most.next_up()).is_err());
        assert!(judge((1.0 + unit).next_up(), most).is_err());
        assert!(judge((1.0 - unit).next_down(), most).is_err());
    }
}

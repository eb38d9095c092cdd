//! The contact normal against the shortest vector in integers, a moment before the exact time of impact.
//!
//! The shortest vector is found by trying all features, at a time so shortly before that nearer ones no longer turn it.
//! With a radius above 0 that is the normal at the contact too, because the vector is continuous there.
//!
//! `TUNNELPROOF_CASES` sets the number of queries of a kind.

use num_bigint::BigInt;
use proptest::prelude::*;
use tunnelproof::certified::{Kind, Normal, decide, decide_exactly};
use tunnelproof::query::{Point, Query, QueryKind};
use tunnelproof_reference::generate;
use tunnelproof_reference::oracle;
use tunnelproof_reference::scaled::Scaled;

use corners::{all_scales, cases, lattice, nearly_degenerate, ordinary_scales, uniform};

mod corners;

/// The bits of numbers in fixed point.
const BITS: u64 = 200;

/// The largest bound that there may be.
const WORST: f64 = 1.0 / (1u64 << 32) as f64;

/// The bound of the normals that integers give.
const EXACT: f64 = 4.0 * f64::EPSILON;

type Vector = [BigInt; 3];

fn sub(x: &Vector, y: &Vector) -> Vector {
    [0, 1, 2].map(|i: usize| &x[i] - &y[i])
}

fn times(factor: &BigInt, x: &Vector) -> Vector {
    x.each_ref().map(|x| factor * x)
}

fn dot(x: &Vector, y: &Vector) -> BigInt {
    &x[0] * &y[0] + &x[1] * &y[1] + &x[2] * &y[2]
}

fn cross(x: &Vector, y: &Vector) -> Vector {
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

/// From the line of AB to that of CD, or from A to the plane of B, C and D, if that ends inside; the part of `m` along the
/// perpendicular of `k` and `l`. `is_inside` is asked for the two shares of `k` and `l` that go to the nearest points, times
/// the last number.
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
fn shortest(kind: QueryKind, [a, b, c, d]: &[Vector; 4]) -> Vector {
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

/// The exact normal in fixed point; `None` where the sides touch at the start. Outside: of a miss.
fn exact_normal(query: &Query) -> Option<Option<Vector>> {
    let decision = oracle::decide::<BigInt>(query);
    let toi = decision.toi()?;
    let points = Scaled::<BigInt>::new(query);
    let direction_at = |numerator: BigInt, exponent: u64| {
        let rest = (BigInt::from(1) << exponent) - &numerator;
        let at = [0, 1, 2, 3].map(|p: usize| {
            [0, 1, 2].map(|i: usize| &rest * &points.start[p][i] + &numerator * &points.end[p][i])
        });
        direction(&shortest(query.kind(), &at))
    };
    if toi.is_zero() {
        return Some(direction_at(BigInt::ZERO, 0));
    }
    // 2^-least is below the time of impact.
    let mut least = 64;
    while {
        toi.refine(least);
        toi.bounds().0 == BigInt::ZERO
    } {
        least *= 2;
    }
    // So shortly before that no point moves by more than 2^-200 of the smallest unit of the coordinates.
    let all = points.start.iter().chain(&points.end).flatten();
    let span = all.map(BigInt::bits).max().expect("24");
    let mut last: Option<Vector> = None;
    let mut bits = least + span + 200;
    loop {
        toi.refine(bits);
        let (low, _, exponent) = toi.bounds();
        let common = exponent.max(bits);
        let before = (low << (common - exponent)) - (BigInt::from(1) << (common - bits));
        let here = direction_at(before, common).expect("apart before contact");
        if let Some(last) = last
            && distance(&last, &here) < 2f64.powi(-90)
        {
            return Some(Some(here));
        }
        last = Some(here);
        bits *= 2;
    }
}

/// The normal of both stages' hits; outside: of a miss.
fn normals(query: &Query) -> Option<[Option<Normal>; 2]> {
    match query {
        Query::EdgeEdge(query) => normals_of(query),
        Query::VertexFace(query) => normals_of(query),
    }
}

fn normals_of<K: Kind>(query: &K) -> Option<[Option<Normal>; 2]> {
    let hit = decide(query)?;
    let exact = decide_exactly(query).expect("a hit");
    Some([hit.normal(query), exact.normal(query)])
}

/// What was found of some queries.
#[derive(Debug, Default)]
struct Tally {
    hits: u32,
    /// Without normal: in touch at the start.
    none: u32,
    /// By integers.
    exact: u32,
    worst_error: f64,
    worst_ratio: f64,
}

fn judge(query: &Query, tally: &mut Tally) -> Result<(), String> {
    let expected = exact_normal(query);
    let found = normals(query);
    let (Some(expected), Some(found)) = (&expected, &found) else {
        return match expected.is_none() && found.is_none() {
            true => Ok(()),
            false => Err(format!("{found:?} instead of {expected:?} for {query:?}")),
        };
    };
    tally.hits += 1;
    for normal in found {
        let (Some(expected), Some(normal)) = (expected, normal) else {
            tally.none += 1;
            if expected.is_some() || normal.is_some() {
                return Err(format!("{normal:?} instead of {expected:?} for {query:?}"));
            }
            continue;
        };
        let own = fixed(normal);
        let off = distance(&own, expected);
        let length = dot(&own, &own).sqrt() - (BigInt::from(1) << BITS);
        let is_right = off <= normal.error && normal.error <= WORST;
        if !is_right || to_f64(&length).abs() > 2f64.powi(-50) {
            let [x, y, z] = expected.each_ref().map(to_f64);
            return Err(format!(
                "{normal:?} instead of {:?}, off by {off:e}, for {query:?}",
                [x, y, z]
            ));
        }
        tally.exact += u32::from(normal.error == EXACT);
        tally.worst_error = tally.worst_error.max(normal.error);
        tally.worst_ratio = tally.worst_ratio.max(off / normal.error);
    }
    Ok(())
}

fn query(kind: QueryKind, start: [Point; 4], end: [Point; 4], radius: [f64; 2]) -> Query {
    Query::new(kind, start, end, radius).expect("finite")
}

/// The hits of both stages.
fn hits(query: &Query) -> [String; 2] {
    match query {
        Query::EdgeEdge(query) => [
            format!("{:?}", decide(query)),
            format!("{:?}", decide_exactly(query)),
        ],
        Query::VertexFace(query) => [
            format!("{:?}", decide(query)),
            format!("{:?}", decide_exactly(query)),
        ],
    }
}

fn are_near(x: &Option<Normal>, y: &Option<Normal>, sign: f64) -> bool {
    match (x, y) {
        (Some(x), Some(y)) => (x.direction - y.direction * sign).norm() <= x.error + y.error,
        (x, y) => x.is_none() && y.is_none(),
    }
}

/// Scaled by a power of two, the normal of a hit with the same bits has the same bits, unless a coordinate rounds. Where
/// `f64` would overflow, hits come from another stage with other errors.
fn judge_scaled(of: &Query, exponent: i32) -> Result<(), String> {
    let factor = 2f64.powi(exponent);
    let back = 1.0 / factor;
    let parts = of.radius().parts();
    let all = of.start().iter().chain(of.end()).flat_map(|p| p.iter());
    if !all
        .chain(&parts)
        .all(|x| (x * factor).is_finite() && x * factor * back == *x)
    {
        return Ok(());
    }
    let scaled = |p: Point| Point::from(p.coords * factor);
    let scaled = query(
        of.kind(),
        of.start().map(scaled),
        of.end().map(scaled),
        parts.map(|x| x * factor),
    );
    let (Some(own), Some(other)) = (normals(of), normals(&scaled)) else {
        return Ok(());
    };
    let (own_hits, other_hits) = (hits(of), hits(&scaled));
    let is_right = |i: usize| match own_hits[i] == other_hits[i] {
        true => own[i] == other[i],
        false => are_near(&own[i], &other[i], 1.0),
    };
    match is_right(0) && is_right(1) {
        true => Ok(()),
        false => Err(format!("{own:?} but {other:?} times {factor:e}: {of:?}")),
    }
}

/// With the sides swapped the normal is reversed; with the corners of a face in another order, the same.
fn judge_swapped(of: &Query) -> Result<(), String> {
    let (order, sign) = match of.kind() {
        QueryKind::EdgeEdge => ([2, 3, 0, 1], -1.0),
        QueryKind::VertexFace => ([0, 2, 3, 1], 1.0),
    };
    let ordered = |points: &[Point; 4]| order.map(|i: usize| points[i]);
    let swapped = query(
        of.kind(),
        ordered(of.start()),
        ordered(of.end()),
        of.radius().parts(),
    );
    let (own, other) = (normals(of), normals(&swapped));
    match (&own, &other) {
        (Some(x), Some(y)) if (0..2).all(|i: usize| are_near(&x[i], &y[i], sign)) => Ok(()),
        (None, None) => Ok(()),
        _ => Err(format!("{own:?} but {other:?} swapped: {of:?}")),
    }
}

#[test]
fn normal_is_the_exact_one_on_every_family() {
    let mut hits = 0;
    for family in generate::all() {
        let mut tally = Tally::default();
        for index in 0..u64::from(cases(150)) {
            let query = family.query(11, index);
            let judged = judge(&query, &mut tally)
                .and_then(|()| judge_scaled(&query, [-300, 8, 300][index as usize % 3]))
                .and_then(|()| judge_swapped(&query));
            assert_eq!(judged, Ok(()), "{}:11:{index}", family.name());
        }
        eprintln!("{}: {tally:?}", family.name());
        hits += tally.hits;
    }
    assert!(hits > 0);
}

/// Radii from far below to above the size of a query, and 0.
fn radius() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(0.5),
        0.0..0.3f64,
        (1.0..2.0f64, -60i32..3).prop_map(|(x, e)| x * 2f64.powi(e)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(1500)))]

    #[test]
    fn normal_is_the_exact_one_of_any_corners(
        corners in prop_oneof![
            lattice(),
            lattice(),
            uniform(),
            nearly_degenerate(),
            ordinary_scales(),
            all_scales(),
        ],
        radius in radius(),
        is_face in any::<bool>(),
    ) {
        let p = corners.map(Point::from);
        let kind = if is_face { QueryKind::VertexFace } else { QueryKind::EdgeEdge };
        let query = query(kind, [p[0], p[1], p[2], p[3]], [p[4], p[5], p[6], p[7]], [radius, 0.0]);
        let judged = judge(&query, &mut Tally::default())
            .and_then(|()| judge_swapped(&query));
        prop_assert_eq!(judged, Ok(()));
    }
}

//! The contact normal of bodies that turn against the shortest vector in space, in integers, a moment
//! before the oracle's time of impact.
//!
//! `TUNNELPROOF_RIGID_COUNT` sets the number of queries of a family, `TUNNELPROOF_RIGID_SEED` the
//! seed, and `TUNNELPROOF_RIGID_FAMILIES` a part of the families' names.

use num_bigint::BigInt;
use tunnelproof::certified::{Normal, decide_rigid, decide_rigid_exactly};
use tunnelproof::rigid::RigidQuery;
use tunnelproof_reference::generate::{RIGID_FAMILIES, RigidFamily};
use tunnelproof_reference::oracle;
use tunnelproof_reference::scaled::{ScaledBody, ScaledRigid, ScaledSide};

use shortest::{
    Vector, cross, deviation, direction, direction_before, dot, shortest, times, to_f64,
};

mod shortest;

/// How many queries of each family are judged.
fn count() -> u64 {
    let asked = std::env::var("TUNNELPROOF_RIGID_COUNT").ok();
    let usual = if cfg!(debug_assertions) { 40 } else { 400 };
    asked.map_or(usual, |text| text.parse().expect("a number"))
}

fn seed() -> u64 {
    let asked = std::env::var("TUNNELPROOF_RIGID_SEED").ok();
    asked.map_or(2033, |text| text.parse().expect("a number"))
}

fn families() -> impl Iterator<Item = &'static RigidFamily> {
    let asked = std::env::var("TUNNELPROOF_RIGID_FAMILIES").unwrap_or_default();
    RIGID_FAMILIES
        .iter()
        .filter(move |family| family.name().contains(&asked))
}

/// The largest bound that there may be.
const WORST: f64 = 1.0 / (1u64 << 32) as f64;

/// The bound of the normals that integers give.
const EXACT: f64 = 4.0 * f64::EPSILON;

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

/// The exact normal in fixed point; `None` where the sides touch at the start. Outside: of a miss.
fn exact_normal(query: &RigidQuery) -> Option<Option<Vector>> {
    let decision = oracle::decide_rigid::<BigInt>(query);
    let toi = decision.toi()?;
    let scaled = ScaledRigid::<BigInt>::new(query);
    let kind = query.kind().linear();
    let direction_at = |at: &BigInt, exponent: u64| {
        let one = BigInt::from(1) << exponent;
        direction(&shortest(kind, &points(&scaled, at, &one)))
    };
    Some(direction_before(toi, span(&scaled), direction_at))
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

/// The normal of both stages' hits; outside: of a miss.
fn normals(query: &RigidQuery) -> Option<[Option<Normal>; 2]> {
    let hit = decide_rigid(query)?;
    let exact = decide_rigid_exactly(query).expect("a hit");
    Some([hit.normal(query), exact.normal(query)])
}

/// What was found of some queries.
#[derive(Debug, Default)]
struct Tally {
    hits: u32,
    /// Without normal: in touch at the start.
    none: u32,
    /// Of both stages' normals, those by integers.
    exact: u32,
    worst_error: f64,
    worst_ratio: f64,
}

/// What is wrong with a normal.
fn judge_normal(found: &Option<Normal>, expected: &Option<Vector>) -> Result<f64, String> {
    match (expected, found) {
        (None, None) => Ok(0.0),
        (Some(expected), Some(normal)) => {
            let (off, from_unit) = deviation(normal, expected);
            match off <= 1.0 && normal.error <= WORST && from_unit <= 2f64.powi(-50) {
                true => Ok(off),
                false => {
                    let exact = expected.each_ref().map(to_f64);
                    Err(format!(
                        "{normal:?} instead of {exact:?}, off by {off:e} bounds"
                    ))
                }
            }
        }
        _ => Err(format!("{found:?} instead of {expected:?}")),
    }
}

fn judge(query: &RigidQuery, tally: &mut Tally) -> Result<(), String> {
    let (expected, found) = (exact_normal(query), normals(query));
    let (Some(expected), Some(found)) = (&expected, &found) else {
        return match expected.is_none() && found.is_none() {
            true => Ok(()),
            false => Err(format!("{found:?} instead of {expected:?} for {query:?}")),
        };
    };
    tally.hits += 1;
    tally.none += u32::from(expected.is_none());
    for normal in found {
        let off =
            judge_normal(normal, expected).map_err(|wrong| format!("{wrong} of {query:?}"))?;
        tally.worst_ratio = tally.worst_ratio.max(off);
        let error = normal.map_or(0.0, |normal| normal.error);
        tally.worst_error = tally.worst_error.max(error);
        tally.exact += u32::from(error == EXACT);
    }
    Ok(())
}

#[test]
fn rigid_normal_is_the_exact_one_on_every_family() {
    let mut hits = 0;
    for family in families() {
        let mut tally = Tally::default();
        for index in 0..count() {
            let judged = judge(&family.query(seed(), index), &mut tally);
            assert_eq!(judged, Ok(()), "{}:{}:{index}", family.name(), seed());
        }
        println!("{}: {tally:?}", family.name());
        hits += tally.hits;
    }
    assert!(hits > 0);
}

//! The contact normal against the shortest vector in integers, a moment before the exact time of
//! impact.
//!
//! `TUNNELPROOF_CASES` sets the number of queries of a kind.

use proptest::prelude::*;
use tunnelproof::certified::{Kind, Normal, decide, decide_exactly};
use tunnelproof::query::{Point, Query, QueryKind};
use tunnelproof_reference::generate;
use tunnelproof_reference::normal::ExactNormal;

use corners::{all_scales, cases, lattice, nearly_degenerate, ordinary_scales, uniform};

mod corners;

/// The bound of the normals that integers give.
const EXACT: f64 = 4.0 * f64::EPSILON;

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
    let (expected, found) = (ExactNormal::of(query), normals(query));
    let (Some(expected), Some(found)) = (&expected, &found) else {
        return match expected.is_none() && found.is_none() {
            true => Ok(()),
            false => Err(format!("{found:?} instead of {expected:?} for {query:?}")),
        };
    };
    tally.hits += 1;
    for normal in found {
        let off = expected.judge(normal.as_ref());
        let off = off.map_err(|wrong| format!("{wrong}, for {query:?}"))?;
        let error = normal.map_or(0.0, |normal| normal.error);
        tally.none += u32::from(normal.is_none());
        tally.exact += u32::from(error == EXACT);
        tally.worst_error = tally.worst_error.max(error);
        tally.worst_ratio = tally.worst_ratio.max(off);
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

/// Scaled by a power of two, the normal of a hit with the same bits has the same bits, unless a
/// coordinate rounds. Where `f64` would overflow, hits come from another stage with other errors.
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

/// With the sides swapped the normal is reversed; with the corners of a face in another order, the
/// same.
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

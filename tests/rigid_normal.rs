//! The contact normal of bodies that turn against the shortest vector in space, in integers, a moment
//! before the oracle's time of impact.
//!
//! `TUNNELPROOF_RIGID_COUNT` sets the number of queries of a family, `TUNNELPROOF_RIGID_SEED` the
//! seed, and `TUNNELPROOF_RIGID_FAMILIES` a part of the families' names.

use tunnelproof::certified::{Normal, decide_rigid, decide_rigid_exactly};
use tunnelproof::contact::Place;
use tunnelproof::nalgebra::{Quaternion, Vector3};
use tunnelproof::query::QueryKind;
use tunnelproof::rigid::{EdgeTurningEdge, Pose, RigidMotion, RigidQuery, Side};
use tunnelproof::{EdgeEdge, Point, VertexFace, decide};
use tunnelproof_reference::generate::{RIGID_FAMILIES, RigidFamily, rigid_by_name};
use tunnelproof_reference::normal::ExactNormal;

/// How many queries of each family are judged.
fn count() -> u64 {
    let asked = std::env::var("TUNNELPROOF_RIGID_COUNT").ok();
    let usual = if cfg!(debug_assertions) { 40 } else { 200 };
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

/// The bound of the normals that integers give.
const EXACT: f64 = 4.0 * f64::EPSILON;

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

fn judge(query: &RigidQuery, tally: &mut Tally) -> Result<(), String> {
    let (expected, found) = (ExactNormal::of_rigid(query), normals(query));
    let (Some(expected), Some(found)) = (&expected, &found) else {
        return match expected.is_none() && found.is_none() {
            true => Ok(()),
            false => Err(format!("{found:?} instead of {expected:?} for {query:?}")),
        };
    };
    tally.hits += 1;
    tally.none += u32::from(expected.rounded().is_none());
    for normal in found {
        let off = expected.judge(normal.as_ref());
        let off = off.map_err(|wrong| format!("{wrong}, for {query:?}"))?;
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

/// A reversed normal, one in the body's frame, one of the time of the start, one off by three bounds
/// and a missing one are seen.
#[test]
fn rigid_normal_comparison_sees_planted_faults() {
    for name in [
        "turning_uniform",
        "turning_grazing",
        "turning_thick_uniform",
        "turning_bodies_uniform",
    ] {
        let family = rigid_by_name(name).expect("a family");
        let mut seen = 0;
        for index in 0..100 {
            let query = family.query(seed(), index);
            let expected = ExactNormal::of_rigid(&query);
            let Some(expected) = expected.filter(|normal| normal.rounded().is_some()) else {
                continue;
            };
            let [found, _] = normals(&query).expect("a hit");
            assert!(expected.judge(found.as_ref()).is_ok());
            assert!(expected.judge(None).is_err());
            let right = found.expect("a normal");
            let is_seen = |direction: Vector3<f64>| {
                let faulty = Normal { direction, ..right };
                expected.judge(Some(&faulty)).is_err()
            };
            assert!(is_seen(-right.direction));
            let aside = right.direction.yzx().cross(&right.direction);
            let aside = aside
                .try_normalize(1e-3)
                .map(|aside| aside * 3.0 * right.error);
            assert!(aside.is_none_or(|aside| is_seen(right.direction + aside)));
            let hit = decide_rigid(&query).expect("a hit");
            let [_, second] = query.sides();
            let turn = |t: f64| {
                let at = |x: f64, y: f64, z: f64| -> Vector3<f64> {
                    let Side::Turning { motion, .. } = second else {
                        unreachable!("the second side turns");
                    };
                    motion.position(&Point::new(x, y, z), t) - motion.position(&Point::origin(), t)
                };
                [at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(0.0, 0.0, 1.0)]
            };
            let in_body = Vector3::from(turn(hit.toi).map(|axis| axis.dot(&right.direction)));
            let [x, y, z] = turn(0.0);
            let at_start = x * in_body.x + y * in_body.y + z * in_body.z;
            for other in [in_body, at_start] {
                let is_other = (other - right.direction).norm() > 3.0 * right.error;
                assert!(!is_other || is_seen(other), "{name} {index}");
                seen += u32::from(is_other);
            }
        }
        assert!(seen > 30, "{name}: {seen}");
    }
}

fn are_near(x: &Option<Normal>, y: &Option<Normal>, sign: f64) -> bool {
    match (x, y) {
        (Some(x), Some(y)) => (x.direction - y.direction * sign).norm() <= x.error + y.error,
        (x, y) => x.is_none() && y.is_none(),
    }
}

/// The normal of the linear query of the same points; outside: of a miss.
fn linear(query: &RigidQuery) -> Option<Option<Normal>> {
    let (start, end, radius) = (query.positions(0.0), query.positions(1.0), query.radius());
    match query.kind().linear() {
        QueryKind::EdgeEdge => {
            let query = EdgeEdge::new(start, end, radius).expect("finite");
            decide(&query).map(|hit| hit.normal(&query))
        }
        QueryKind::VertexFace => {
            let query = VertexFace::new(start, end, radius).expect("finite");
            decide(&query).map(|hit| hit.normal(&query))
        }
    }
}

#[test]
fn rigid_normal_of_a_translation_is_that_of_the_linear_query() {
    for name in ["turning_translation", "turning_thick_still"] {
        let family = rigid_by_name(name).expect("a family");
        let mut hits = 0;
        for index in 0..2000 {
            let query = family.query(seed(), index);
            let (own, linear) = (normals(&query), linear(&query));
            let (Some(own), Some(linear)) = (own, linear) else {
                assert!(own.is_none() && linear.is_none());
                continue;
            };
            for own in own {
                assert!(are_near(&own, &linear, 1.0), "{own:?} {linear:?} {query:?}");
            }
            hits += 1;
        }
        assert!(hits > 50, "{name}: {hits}");
    }
}

/// Called the other way round, two edges have the reversed normal.
#[test]
fn rigid_normal_is_reversed_when_the_bodies_are_swapped() {
    for name in [
        "turning_bodies_uniform",
        "turning_bodies_lattice",
        "turning_bodies_confined",
        "turning_bodies_grazing",
        "turning_bodies_thick_lattice",
    ] {
        let family = rigid_by_name(name).expect("a family");
        let mut hits = 0;
        for index in 0..150 {
            let query = family.query(seed(), index);
            if query.kind().linear() == QueryKind::VertexFace {
                continue;
            }
            let [first, second] = query.sides();
            let other = RigidQuery::new([second, first], query.radius()).expect("finite");
            if let (Some(own), Some(other)) = (normals(&query), normals(&other)) {
                for (own, other) in own.iter().zip(&other) {
                    assert!(are_near(own, other, -1.0), "{own:?} {other:?} {query:?}");
                }
                hits += 1;
            }
        }
        assert!(hits > 5, "{name}: {hits}");
    }
}

/// A wire at rest and a rod, which turns by 90 degrees about z.
fn rod(wire: [Point; 2], rod: [Point; 2], size: f64, radius: f64) -> RigidQuery {
    let pose = |z: f64| Pose::new(Point::origin(), Quaternion::new(1.0, 0.0, 0.0, z));
    let motion = RigidMotion::new(pose(0.0), pose(1.0)).expect("90 degrees");
    let scaled = |points: [Point; 2]| points.map(|p| p * size);
    let (wire, rod) = (scaled(wire), scaled(rod));
    EdgeTurningEdge::with_radius(wire, wire, rod, motion, radius * size)
        .expect("finite")
        .into()
}

/// A wire across the plane in which a rod turns, inside it or at its end; with a radius too; and one
/// in that plane, which the tip of the rod meets.
#[test]
fn rigid_normal_is_the_known_one_at_every_scale() {
    let p = Point::new;
    let across = [p(1.0, 1.0, -1.0), p(1.0, 1.0, 1.0)];
    let at_end = [p(1.5, 2.0, -1.0), p(1.5, 2.0, 1.0)];
    let in_plane = [p(0.0, 2.0, 0.0), p(4.0, 2.0, 0.0)];
    let own = [p(0.0, 0.0, 0.0), p(2.5, 0.0, 0.0)];
    let half_root = 0.5f64.sqrt();
    let known = [
        (across, 0.0, [half_root, -half_root, 0.0]),
        (at_end, 0.0, [0.8, -0.6, 0.0]),
        (in_plane, 0.0, [0.0, -1.0, 0.0]),
        (in_plane, 0.25, [0.0, -1.0, 0.0]),
    ];
    for (wire, radius, expected) in known {
        for exponent in [-1000, -540, -300, 0, 300, 1000] {
            let query = rod(wire, own, 2f64.powi(exponent), radius);
            for normal in normals(&query).expect("a hit") {
                let normal = normal.expect("a normal");
                // The numbers that are expected are rounded.
                let off = (normal.direction - Vector3::from(expected)).norm();
                assert!(
                    off <= normal.error + 1e-15,
                    "{normal:?} {expected:?} {exponent}"
                );
                assert!(normal.error < 1e-12, "{normal:?} {exponent}");
            }
        }
    }
}

/// A normal of another query's hit means nothing, but ends; that of another kind of place is none.
#[test]
fn rigid_normal_of_a_hit_of_another_query_is_no_panic() {
    for family in families() {
        let hits = (0..60).filter_map(|index| decide_rigid(&family.query(seed(), index)));
        let mut others = 0;
        for (index, hit) in hits.enumerate() {
            let query = family.query(seed() + 1, index as u64);
            let normal = hit.normal(&query);
            let is_edges = matches!(hit.place, Place::Edges(_));
            if is_edges != (query.kind().linear() == QueryKind::EdgeEdge) {
                assert_eq!(normal, None);
                others += 1;
            }
        }
        println!("{}: {others} of the other kind", family.name());
    }
}

//! Advanced pairs against the oracle: the motion to the stored positions has no contact.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::fmt;
use std::iter::Sum;
use std::sync::atomic::{AtomicU64, Ordering};

use num_bigint::Sign;
use num_rational::BigRational;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tunnelproof::certified::{Blocked, Clearance, Precision, advance_in, decide, interpolate_in};
use tunnelproof::mesh::Mesh;
use tunnelproof::query::{EdgeEdge, Point, Query, QueryKind, Radius, VertexFace};
use tunnelproof_reference::generate;
use tunnelproof_reference::oracle::decide_query;

/// Queries of a family: fewer where Rust checks its arithmetic. `TUNNELPROOF_QUERIES` says how many
/// those families get that the oracle answers quickest; the others get a part of that.
fn count_of(family: &str) -> u64 {
    const USUAL: u64 = if cfg!(debug_assertions) { 40 } else { 500 };
    const QUICK: [&str; 6] = [
        "uniform",
        "lattice",
        "slow",
        "joint",
        "face_uniform",
        "face_lattice",
    ];
    let most = number("TUNNELPROOF_QUERIES", 0);
    let part = match family {
        _ if QUICK.contains(&family) => 1,
        _ if family.ends_with("scales") => 10_000,
        _ if family.starts_with("thick") => 40,
        _ => 12,
    };
    USUAL.max(most / part)
}

/// Steps of each walk, as many as `TUNNELPROOF_STEPS` says.
fn steps() -> u64 {
    let usual = if cfg!(debug_assertions) { 200 } else { 2_000 };
    number("TUNNELPROOF_STEPS", usual)
}

fn number(variable: &str, usual: u64) -> u64 {
    match std::env::var(variable) {
        Ok(value) => value.parse().unwrap(),
        Err(_) => usual,
    }
}

/// Does all jobs, on all threads.
fn all_of<T: Send>(jobs: u64, job: impl Fn(u64) -> T + Sync) -> Vec<T> {
    let threads = std::thread::available_parallelism().unwrap().get();
    let next = AtomicU64::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= jobs {
                return done;
            }
            done.push(job(index));
        }
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let parts = workers.into_iter().map(|worker| worker.join().unwrap());
        parts.flatten().collect()
    })
}

/// What came of advancing.
#[derive(Default)]
struct Tally {
    pairs: u64,
    moved: u64,
    ahead: u64,
    near: u64,
    near_moved: u64,
    touching: u64,
}

impl Sum for Tally {
    fn sum<I: Iterator<Item = Tally>>(parts: I) -> Tally {
        parts.fold(Tally::default(), |sum, part| Tally {
            pairs: sum.pairs + part.pairs,
            moved: sum.moved + part.moved,
            ahead: sum.ahead + part.ahead,
            near: sum.near + part.near,
            near_moved: sum.near_moved + part.near_moved,
            touching: sum.touching + part.touching,
        })
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tally {
            pairs,
            moved,
            ahead,
            near,
            near_moved,
            touching,
        } = self;
        write!(
            f,
            "{pairs} pairs: {moved} moved, {ahead} ahead, {near} near ({near_moved} moved), \
             {touching} touching"
        )
    }
}

fn query(kind: QueryKind, start: [Point; 4], end: [Point; 4], radius: Radius) -> Query {
    match kind {
        QueryKind::EdgeEdge => Query::EdgeEdge(EdgeEdge::new(start, end, radius).unwrap()),
        QueryKind::VertexFace => Query::VertexFace(VertexFace::new(start, end, radius).unwrap()),
    }
}

/// The numbers that positions are stored in, and what is kept.
#[derive(Clone, Copy)]
struct Asked(Precision, Clearance);

/// Whether it is an `f32`.
fn is_single(x: f64) -> bool {
    f64::from(x as f32) == x
}

/// The same from a start that is `f32`, if no coordinate of it is too large.
fn in_single(q: &Query) -> Option<Query> {
    let start = q.start().map(|p| p.map(|x| f64::from(x as f32)));
    let is_finite = start.iter().flat_map(|p| p.iter()).all(|x| x.is_finite());
    is_finite.then(|| query(q.kind(), start, *q.end(), q.radius()))
}

/// The motion that is made: with `f32`, towards ends that are rounded.
fn towards(q: &Query, precision: Precision) -> Query {
    let target = |x: f64| match (precision, x as f32) {
        (Precision::F64, _) => x,
        (_, single) if single.is_infinite() => f64::from(f32::MAX.copysign(single)),
        (_, single) => single.into(),
    };
    query(
        q.kind(),
        *q.start(),
        q.end().map(|p| p.map(target)),
        q.radius(),
    )
}

/// Advances, and asks the oracle about what is stored. Returns the stored points.
fn judge(q: &Query, Asked(precision, clearance): Asked, id: &str, tally: &mut Tally) -> [Point; 4] {
    let moved = match q {
        Query::EdgeEdge(query) => advance_in(query, clearance, precision).unwrap(),
        Query::VertexFace(query) => advance_in(query, clearance, precision).unwrap(),
    };
    let toi = match towards(q, precision) {
        Query::EdgeEdge(query) => decide(&query).map(|hit| hit.toi),
        Query::VertexFace(query) => decide(&query).map(|hit| hit.toi),
    };
    tally.pairs += 1;
    assert!((0.0..=1.0).contains(&moved.step), "{id}: {moved:?}");
    for (i, point) in moved.points.iter().enumerate() {
        assert_eq!(
            *point,
            interpolate_in(&q.start()[i], &q.end()[i], moved.step, precision),
            "{id}"
        );
        let both = q.start()[i].iter().zip(point.iter());
        assert!(
            precision == Precision::F64
                || both.clone().all(|(a, x)| !is_single(*a) || is_single(*x)),
            "{id}: {moved:?}"
        );
    }
    assert!(
        moved.blocked.is_none() || moved.step == 0.0 || moved.points != *q.start(),
        "{id}: {moved:?} moves nothing"
    );
    match moved.blocked {
        None => {
            let end = *towards(q, precision).end();
            assert_eq!((moved.step, moved.points), (1.0, end), "{id}");
        }
        Some(Blocked::Ahead) => tally.ahead += 1,
        Some(Blocked::Rounding) => {
            tally.near += 1;
            tally.near_moved += u64::from(moved.step > 0.0);
        }
        Some(Blocked::Touching) => {
            tally.touching += 1;
            let still = query(q.kind(), *q.start(), *q.start(), Radius::ZERO);
            assert!(decide_query(&still).hit.is_some(), "{id}");
        }
        other => unreachable!("{other:?}"),
    }
    let Some(kept) = moved.kept else {
        assert_eq!((moved.step, moved.points), (0.0, *q.start()), "{id}");
        return moved.points;
    };
    tally.moved += 1;
    let stored = query(q.kind(), *q.start(), moved.points, kept);
    assert!(decide_query(&stored).hit.is_none(), "{id}: {moved:?}");
    // What starts outside of the radius stays there.
    if kept != q.radius() {
        let still = query(q.kind(), *q.start(), *q.start(), q.radius());
        let stored = query(q.kind(), *q.start(), moved.points, q.radius());
        let is_outside = decide_query(&still).hit.is_none();
        assert!(
            !is_outside || decide_query(&stored).hit.is_none(),
            "{id}: {moved:?}"
        );
    }
    // The step is as large as the rounding of positions lets it be.
    let is_of_radius = clearance == Clearance::None && kept == q.radius();
    if let (true, Some(Blocked::Ahead), Some(toi)) = (is_of_radius, moved.blocked, toi) {
        assert!(moved.step <= toi, "{id}: {moved:?} {toi}");
        if id.starts_with("uniform") || id.starts_with("face_uniform") {
            let least = match precision {
                Precision::F32 => 0.999,
                _ => 0.999_999,
            };
            assert!(moved.step >= least * toi, "{id}: {moved:?} {toi}");
        }
    }
    moved.points
}

#[test]
fn advance_stores_positions_that_are_apart_on_every_family() {
    const BLOCK: u64 = 1000;
    /// Every so many queries with a clearance, too.
    const OTHERS: u64 = 16;
    /// Every so many rounded to `f32`.
    const SINGLE: u64 = 2;
    let mut all = Tally::default();
    for family in generate::all() {
        let count = count_of(family.name());
        let blocks = count.div_ceil(BLOCK);
        let of_block = |block: u64| {
            let mut tally = Tally::default();
            for index in block * BLOCK..count.min((block + 1) * BLOCK) {
                let q = family.query(11, index);
                let id = format!("{}:11:{index}", family.name());
                let mut asked = |q: &Query, precision, clearance| {
                    judge(q, Asked(precision, clearance), &id, &mut tally);
                };
                asked(&q, Precision::F64, Clearance::None);
                if index % OTHERS == 0 {
                    asked(&q, Precision::F64, Clearance::Distance(1e-3));
                    asked(&q, Precision::F64, Clearance::Share(0.1));
                    // Coordinates that are not `f32`.
                    asked(&q, Precision::F32, Clearance::None);
                }
                if index % SINGLE == 0
                    && let Some(q) = in_single(&q)
                {
                    asked(&q, Precision::F32, Clearance::None);
                    if index % OTHERS == 0 {
                        asked(&q, Precision::F32, Clearance::Distance(1e-3));
                        asked(&q, Precision::F32, Clearance::Share(0.1));
                    }
                }
            }
            tally
        };
        let tally: Tally = all_of(blocks, of_block).into_iter().sum();
        println!("{}: {tally}", family.name());
        assert!(tally.moved > 0, "{}", family.name());
        all = [all, tally].into_iter().sum();
    }
    println!("all: {all}");
}

/// With a little more than the room that rounding needs a step is no shorter than with less: a few
/// steps are tried either way, of a pair and of a mesh of it.
#[test]
fn advance_with_hardly_room_goes_as_far_as_without() {
    let p = Point::new;
    let face = [
        p(-1000., -1000., 0.),
        p(1000., -1000., 0.),
        p(0., 1000., 0.),
    ];
    let start = [p(64., 64., 2.), face[0], face[1], face[2]];
    let end = [p(164., 164., 1.9999760389328003), face[0], face[1], face[2]];
    let mesh = Mesh::new(4, &[], &[[1, 2, 3]]).unwrap();
    let single = |point: Point| <[f64; 3]>::from(point).map(|x| x as f32);
    let [from, to] = [start, end].map(|points| points.map(single));
    let mut blocked = Vec::new();
    for radius in [
        1.9999803304680321,
        1.9999803304481658,
        1.99998033,
        1.99998,
        1.99997,
    ] {
        let query = VertexFace::new(start, end, radius).unwrap();
        let moved = advance_in(&query, Clearance::None, Precision::F32).unwrap();
        blocked.push(moved.blocked);
        assert!(moved.step > 0.2, "{radius}: {moved:?}");
        let step = mesh.step(&from, &to, radius).unwrap();
        assert!(step.step > 0.2, "{radius}: {step:?}");
        for points in [
            moved.points,
            [0, 1, 2, 3].map(|i| Point::from(step.positions[i].map(f64::from))),
        ] {
            let stored = query_of_face(start, points, radius);
            assert!(decide_query(&stored).hit.is_none(), "{radius}: {points:?}");
        }
    }
    assert_eq!(blocked[..2], [Some(Blocked::Rounding); 2]);
}

fn query_of_face(start: [Point; 4], end: [Point; 4], radius: f64) -> Query {
    query(QueryKind::VertexFace, start, end, radius.into())
}

/// What is too little to move any stored number is no step.
#[test]
fn advance_that_moves_nothing_is_no_step() {
    let p = Point::new;
    let face = [p(0., 0., 0.), p(1., 0., 0.), p(0., 1., 0.)];
    let start = [
        p(0.25, 0.25, 1.000_000_119_209_289_6),
        face[0],
        face[1],
        face[2],
    ];
    let end = [p(0.25, 0.25, 1.), face[0], face[1], face[2]];
    let query = VertexFace::new(start, end, 1.000_000_035_762_787).unwrap();
    let moved = advance_in(&query, Clearance::None, Precision::F32).unwrap();
    let expected = (0.0, start, None, Some(Blocked::Rounding));
    assert_eq!(
        (moved.step, moved.points, moved.kept, moved.blocked),
        expected
    );
}

/// The sign of the volume of the four points: on which side of the first the second is.
fn volume(points: &[Point; 4]) -> Sign {
    let exact = points.map(|p| [p.x, p.y, p.z].map(|x| BigRational::from_float(x).unwrap()));
    let from_a =
        |i: usize| -> [BigRational; 3] { std::array::from_fn(|k| &exact[i][k] - &exact[0][k]) };
    let [x, y, z] = [from_a(1), from_a(2), from_a(3)];
    let minor = |i: usize, j: usize| &y[i] * &z[j] - &y[j] * &z[i];
    (&x[0] * minor(1, 2) + &x[1] * minor(2, 0) + &x[2] * minor(0, 1))
        .numer()
        .sign()
}

/// Two edges, or a vertex and a face, pushed into each other by random targets, stay on their
/// sides, exactly.
#[test]
fn advance_never_passes_through_however_many_steps_follow() {
    const WALKS: u64 = 40;
    let steps = steps();
    let tally: Tally = all_of(WALKS, |number| walk(number, steps))
        .into_iter()
        .sum();
    println!("{tally}");
    assert_eq!(tally.touching, 0);
    assert!(tally.ahead > tally.pairs / 100, "{tally}");
}

fn walk(number: u64, steps: u64) -> Tally {
    let precision = match number % 16 {
        0..8 => Precision::F64,
        _ => Precision::F32,
    };
    let rng = &mut ChaCha8Rng::seed_from_u64(number);
    let mut tally = Tally::default();
    let radius = Radius::from(if number % 4 < 2 { 0.0 } else { 0.05 });
    let clearance = match number % 8 {
        0..4 => Clearance::None,
        4..6 => Clearance::Distance(1e-6),
        _ => Clearance::Share(0.1),
    };
    // The second side is above the first, and never can come below: it is longer than the
    // targets reach, as both are drawn back to where they started.
    let p = Point::new;
    let kind = [QueryKind::EdgeEdge, QueryKind::VertexFace][(number % 2) as usize];
    let home = match kind {
        QueryKind::EdgeEdge => [p(-9., 0., 0.), p(9., 0., 0.), p(0., -9., 1.), p(0., 9., 1.)],
        QueryKind::VertexFace => [
            p(0., 0., 1.),
            p(-9., -9., 0.),
            p(9., -9., 0.),
            p(0., 9., 0.),
        ],
    };
    let mut points = home;
    let before = volume(&points);
    for step in 0..steps {
        let mut targets = points;
        for (point, home) in targets.iter_mut().zip(home) {
            // Half of the targets press the two against each other.
            let z = if rng.random() {
                0.5
            } else {
                rng.random_range(-1.0..2.0)
            };
            let mut beside =
                |x: f64, home: f64| x + 1e-4 * (home - x) + rng.random_range(-1e-3..1e-3);
            *point = p(beside(point.x, home.x), beside(point.y, home.y), z);
        }
        let q = query(kind, points, targets, radius);
        points = judge(
            &q,
            Asked(precision, clearance),
            &format!("walk {number}, step {step}"),
            &mut tally,
        );
        let after = volume(&points);
        assert_eq!(after, before, "walk {number}, step {step}");
    }
    tally
}

/// A vertex beside a thin triangle: the nearest point that is computed in floating point is another one, and the distance
/// is a third of what it seems.
#[test]
fn what_starts_too_near_a_thin_face_keeps_nine_tenths_of_its_distance() {
    let points = [
        [0.47638255552785147, -0.9234973286299054, 0.7071589933150213],
        [0.447528201212287, -0.8792571325394025, 0.7278100755116355],
        [0.21247338536115068, -0.5188648679341976, 0.8960400809713431],
        [0.5834258705350636, -1.0876190355586097, 0.6305473772043766],
    ];
    let distance = 1.12e-7;
    let query = VertexFace::at_rest(points.map(Point::from), 3.0 * distance).unwrap();
    let moved = advance_in(&query, Clearance::None, Precision::F64).unwrap();
    let kept = moved.kept.unwrap().rounded();
    assert!(kept > 0.89 * distance && kept < 0.91 * distance, "{kept:e}");
}

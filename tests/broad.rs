//! The broad phase against exact arithmetic: swept boxes hold what moves, and no pair is left out
//! that meets.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use num_bigint::BigInt;
use proptest::prelude::*;
use tunnelproof::broad::{Aabb, BroadPhase, ItemId, Method, SlowPairs};
use tunnelproof::query::{Point, Query, QueryKind};
use tunnelproof_reference::oracle::comes_within;

/// A finite number in units of 2^-1074: exact.
fn exact(x: f64) -> BigInt {
    let bits = x.abs().to_bits();
    let (exponent, fraction) = (bits >> 52, bits & ((1 << 52) - 1));
    let magnitude = match exponent {
        0 => BigInt::from(fraction),
        _ => BigInt::from(fraction | 1 << 52) << (exponent - 1),
    };
    if x < 0.0 { -magnitude } else { magnitude }
}

/// Any finite number, most of ordinary size.
fn coordinate() -> impl Strategy<Value = f64> {
    let any_bits = any::<u64>().prop_map(f64::from_bits);
    prop_oneof![
        4 => -10.0..10.0,
        1 => any_bits.prop_filter("finite", |x| x.is_finite()),
        1 => prop::sample::select(&[0.0, -0.0, 5e-324, f64::MAX, -f64::MAX, 1.0][..]),
    ]
}

fn segment() -> impl Strategy<Value = [Point; 2]> {
    let point = prop::array::uniform3(coordinate()).prop_map(Point::from);
    prop::array::uniform2(point)
}

const PARTS: i64 = 12;

/// A mean of two numbers in parts of [`PARTS`], exact, in units of `2^-1074 / PARTS^2`.
fn mean(part: i64, [x, y]: [BigInt; 2]) -> BigInt {
    x * (PARTS - part) + y * part
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn swept_box_holds_the_segment_and_its_radius_at_exact_times(
        start in segment(),
        end in segment(),
        radius in coordinate().prop_map(f64::abs),
        time in 0..=PARTS,
        along in 0..=PARTS,
    ) {
        let swept = Aabb::swept(&start, &end, radius).unwrap();
        for axis in 0..3 {
            let at = [0, 1].map(|point: usize| {
                mean(time, [start, end].map(|points: [Point; 2]| exact(points[point][axis])))
            });
            let place = mean(along, at);
            let scaled = |x: f64| exact(x) * (PARTS * PARTS);
            let (low, high) = (swept.low()[axis], swept.high()[axis]);
            let is_below = low.is_finite() && &place - scaled(radius) < scaled(low);
            let is_above = high.is_finite() && &place + scaled(radius) > scaled(high);
            prop_assert!(!is_below && !is_above, "{} in {}..{}", axis, low, high);
            prop_assert!(low < f64::INFINITY && high > f64::NEG_INFINITY);
        }
    }
}

/// A scene that changes: where segments are placed, one step after the other, and their radius.
/// Lengths, speeds and radii are of every proportion; some segments hardly move, some jump.
#[derive(Clone, Debug)]
struct Scene {
    radius: f64,
    starts: Vec<[Point; 2]>,
    steps: Vec<Vec<[Point; 2]>>,
}

fn scene() -> impl Strategy<Value = Scene> {
    let point = |size: f64| prop::array::uniform3(-size..size);
    let segment = move |size: f64| prop::array::uniform2(point(size));
    let scale = prop::sample::select(&[1e-160, 1.0, 1e100, 1e300][..]);
    let radius = prop::sample::select(&[0.0, 0.0625, 0.25][..]);
    let speed = prop::sample::select(&[1e-3, 0.1, 0.3, 2.0][..]);
    (2..6usize, 1..8usize, scale, radius, speed).prop_flat_map(
        move |(count, length, scale, radius, speed)| {
            let starts = prop::collection::vec(segment(1.0), count);
            let moves = prop::collection::vec(segment(speed), count);
            let moves = prop::collection::vec(moves, length);
            (starts, moves).prop_map(move |(starts, moves)| {
                let scaled = |ends: [[f64; 3]; 2]| ends.map(|p| p.map(|x| x * scale).into());
                let mut now = starts.clone();
                let steps = moves.iter().map(|moves| {
                    for (segment, by) in now.iter_mut().zip(moves) {
                        *segment = [0, 1].map(|end| {
                            [0, 1, 2].map(|axis: usize| segment[end][axis] + by[end][axis])
                        });
                    }
                    now.iter().copied().map(scaled).collect()
                });
                Scene {
                    radius: radius * scale,
                    steps: steps.collect(),
                    starts: starts.into_iter().map(scaled).collect(),
                }
            })
        },
    )
}

/// Runs a scene; returns how many pairs were left out of tests, having asked the oracle about all
/// that broad phase and exclusion leave out.
fn run(scene: &Scene, method: Method) -> u64 {
    let mut broad = BroadPhase::new(method);
    let mut slow = SlowPairs::default();
    let point = Aabb::swept(&scene.starts[0], &scene.starts[0], 0.0).unwrap();
    let items: Vec<ItemId> = scene.starts.iter().map(|_| broad.insert(point)).collect();
    for (item, ends) in items.iter().zip(&scene.starts) {
        slow.place(*item, *ends, scene.radius).unwrap();
    }
    let mut before = &scene.starts;
    for after in &scene.steps {
        for (i, item) in items.iter().enumerate() {
            let swept = Aabb::swept(&before[i], &after[i], scene.radius).unwrap();
            broad.set(*item, swept).unwrap();
            slow.place(*item, after[i], scene.radius).unwrap();
        }
        let left = slow.remaining(broad.pairs(|_| true));
        for j in 0..items.len() {
            for i in 0..j {
                let is_left = left
                    .iter()
                    .any(|p| (p.first(), p.second()) == (items[i], items[j]));
                let points = |at: &Vec<[Point; 2]>| [at[i][0], at[i][1], at[j][0], at[j][1]];
                let query =
                    Query::new(QueryKind::EdgeEdge, points(before), points(after), 0.0).unwrap();
                // Twice a number is exact.
                let meet = comes_within(&query, 2.0 * scene.radius);
                assert!(is_left || !meet, "{method:?}: {i} and {j} of {scene:?}");
            }
        }
        before = after;
    }
    let counts = slow.counts();
    counts.remembered + counts.measured
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 400,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn broad_phase_and_exclusion_leave_out_no_pair_that_meets(scene in scene()) {
        let sweep = run(&scene, Method::SweepAndPrune);
        prop_assert_eq!(sweep, run(&scene, Method::HierarchicalGrid));
    }
}

/// Whether exclusion leaves a pair of segments at rest in, the sum of their radii given.
fn remains([a, b, c, d]: [Point; 4], radius: f64) -> bool {
    let mut broad = BroadPhase::new(Method::BruteForce);
    let mut slow = SlowPairs::default();
    let still = Aabb::swept(&[a], &[a], 0.0).unwrap();
    for (ends, radius) in [([a, b], radius), ([c, d], 0.0)] {
        let item = broad.insert(still);
        slow.place(item, ends, radius).unwrap();
    }
    slow.remaining(broad.pairs(|_| true)).len() == 1
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn exclusion_takes_no_distance_for_larger_than_it_is_and_wastes_little(
        points in prop::array::uniform4(prop::array::uniform3(-1.0..1.0f64)),
    ) {
        let points = points.map(Point::from);
        let still = Query::new(QueryKind::EdgeEdge, points, points, 0.0).unwrap();
        // The least radius at which they touch, to the last bit.
        let (mut apart, mut within) = (0, 4f64.to_bits());
        while within - apart > 1 {
            let middle = apart + (within - apart) / 2;
            if comes_within(&still, f64::from_bits(middle)) {
                within = middle;
            } else {
                apart = middle;
            }
        }
        let least = f64::from_bits(within);
        prop_assert!(remains(points, least));
        prop_assert!(least < 1e-3 || !remains(points, least * (1.0 - 1e-9)));
    }
}

#[test]
fn exclusion_leaves_out_most_of_a_slow_scene_and_stops_in_time() {
    // Two segments whose boxes overlap all the time; one comes down on the other at 1/64 a step.
    let p = Point::new;
    let diagonal = [p(-1.0, -1.0, -1.0), p(1.0, 1.0, 1.0)];
    let above = |step: u32| {
        let z = 1.0 - f64::from(step) / 64.0;
        [p(-1.0, 1.0, z), p(1.0, -1.0, z)]
    };
    let scene = Scene {
        radius: 0.0,
        starts: vec![diagonal, above(0)],
        steps: (1..=70).map(|step| vec![diagonal, above(step)]).collect(),
    };
    // They meet at the end of step 64; `run` sees that they are left then.
    let excluded = run(&scene, Method::BruteForce);
    assert!((60..=69).contains(&excluded), "{excluded}");
}

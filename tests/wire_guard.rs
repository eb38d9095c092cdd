//! Guard mode by the exact oracle: random wires at hard speeds, and no motion that is made, changes
//! of resolution included, in which midlines meet.
//!
//! `TUNNELPROOF_SCENES=10000 cargo test --release --test wire_guard` for more scenes, and
//! `TUNNELPROOF_SCENES=5000..10000` for a part of them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::atomic::{AtomicU64, Ordering};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tunnelproof::broad::Method;
use tunnelproof::certified::Certified;
use tunnelproof::contact::Verdict;
use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
use tunnelproof::query::{EdgeEdge, Point, Query};
use tunnelproof::wire::{
    BodyId, BodyPlan, CollisionError, Collisions, Drive, Material, Mode, NodeKind, Phase, Reason,
    Remesh, RemeshKind, Settings, Shape, StepRecord, Stop, Vector, WirePlan, World,
};
use tunnelproof_reference::oracle::decide_query;

#[path = "wire_guard/thickness.rs"]
mod thickness;

const STEPS: usize = 12;

fn vector(rng: &mut ChaCha8Rng, size: f64) -> Vector {
    Vector::from_fn(|_, _| rng.random_range(-size..=size))
}

/// A ball that is thrown, or moved by a script.
fn ball(rng: &mut ChaCha8Rng, position: Point) -> BodyPlan {
    let speed = [0.0, 1.0, 30.0][rng.random_range(0..3)];
    let (velocity, angular_velocity) = (vector(rng, speed), vector(rng, speed));
    let drive = if rng.random_bool(0.5) {
        Drive::Dynamic {
            density: 10f64.powf(rng.random_range(2.0..4.0)),
            velocity,
            angular_velocity,
        }
    } else {
        let from = 0.0;
        Drive::Kinematic(vec![Phase {
            from,
            velocity,
            angular_velocity,
        }])
    };
    let shape = Shape::Sphere { radius: 0.2 };
    BodyPlan {
        drive,
        ..BodyPlan::fixed(shape, position)
    }
}

/// The end of a wire.
fn end(rng: &mut ChaCha8Rng, world: &mut World, point: Point) -> Stop {
    match rng.random_range(0..10) {
        0..3 => Stop::Pinned(point),
        3..6 => {
            let body: BodyId = world.add_body(ball(rng, point)).unwrap();
            let local = vector(rng, 0.2);
            Stop::Eye { body, local }
        }
        _ => Stop::Free(point),
    }
}

fn wire(rng: &mut ChaCha8Rng, world: &mut World) -> WirePlan {
    let mut point = Point::from(vector(rng, 1.0));
    let mut route = vec![end(rng, world, point)];
    for _ in 0..rng.random_range(0..3) {
        point += vector(rng, 1.0);
        route.push(Stop::Free(point));
    }
    point += vector(rng, 1.0);
    route.push(end(rng, world, point));
    let mut material = Material::steel(rng.random_range(0.002..0.03));
    if rng.random_bool(0.3) {
        material = material.chain();
    }
    let mut plan = WirePlan::new(material, rng.random_range(0.1..0.5), route);
    let speed = [0.0, 1.0, 10.0, 100.0][rng.random_range(0..4)];
    plan.velocity = vector(rng, speed);
    plan.resolution.adaptive = rng.random_bool(0.6);
    plan
}

/// Two to twelve wires.
fn scene(seed: u64) -> World {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let mut world = World::new(Settings::default()).unwrap();
    for _ in 0..rng.random_range(2..=12) {
        let plan = wire(rng, &mut world);
        world.add_wire(&plan).unwrap();
    }
    world
}

/// Arc length and position of a node.
type Wire = Vec<(f64, Point)>;

fn wires(world: &World) -> Vec<Wire> {
    let nodes = world.wires().iter().map(|wire| wire.nodes());
    let wires = nodes.map(|nodes| nodes.iter().map(|n| (n.arc, n.position)).collect());
    wires.collect()
}

/// By the oracle, with a test of boxes before it.
fn meet(start: [Point; 4], end: [Point; 4]) -> bool {
    let apart = (0..3).any(|axis| {
        let range = |k: usize| {
            let of = [start[k], start[k + 1], end[k], end[k + 1]].map(|point| point[axis]);
            let low = of.iter().fold(f64::INFINITY, |a, &b| a.min(b));
            (low, of.iter().fold(f64::NEG_INFINITY, |a, &b| a.max(b)))
        };
        let ((low, high), (other_low, other_high)) = (range(0), range(2));
        high < other_low || other_high < low
    });
    let query = Query::EdgeEdge(EdgeEdge::new(start, end, 0.0).unwrap());
    !apart && decide_query(&query).hit.is_some()
}

/// Pairs of segments that meet on their way through a step.
fn meetings(record: &StepRecord) -> usize {
    let segments: Vec<_> = (record.wires.iter().enumerate())
        .flat_map(|(w, wire)| {
            (1..wire.before.len()).map(move |i| {
                let ends = |points: &[Point]| [points[i - 1], points[i]];
                (w, i, ends(&wire.before), ends(&wire.after))
            })
        })
        .collect();
    let mut count = 0;
    for (k, &(w, i, a, b)) in segments.iter().enumerate() {
        for &(other, j, c, d) in &segments[..k] {
            let neighbours = w == other && i - j <= 1;
            let start = [a[0], a[1], c[0], c[1]];
            let end = [b[0], b[1], d[0], d[1]];
            count += usize::from(!neighbours && meet(start, end));
        }
    }
    count
}

/// Makes a change of resolution; segments that its triangle meets. Unlike the stepper, it sweeps
/// the triangle around its middle.
fn remesh(wires: &mut [Wire], change: &Remesh) -> usize {
    let [a, b, c] = change.triangle;
    let mut count = 0;
    for (w, wire) in wires.iter().enumerate() {
        for two in wire.windows(2) {
            let at_corner = two.iter().any(|(arc, _)| change.arcs.contains(arc));
            let [p, q] = [two[0].1, two[1].1];
            let own = w == change.wire.0 && at_corner;
            count += usize::from(!own && meet([a, b, p, q], [c, b, p, q]));
        }
    }
    let wire = &mut wires[change.wire.0];
    let at = wire.partition_point(|(arc, _)| *arc < change.arcs[1]);
    match change.kind {
        RemeshKind::Merge => drop(wire.remove(at)),
        RemeshKind::Split => wire.insert(at, (change.arcs[1], b)),
    }
    count
}

fn is_touching(reason: &Reason) -> bool {
    matches!(reason, Reason::Collision(CollisionError::Touching { .. }))
}

/// What happened in some scenes.
#[derive(Debug, Default)]
struct Tally {
    steps: usize,
    prevented: usize,
    held: usize,
    remeshed: usize,
    refused: usize,
    /// Contact nodes, counted in every step.
    riding: usize,
    /// Why steps were not done.
    failed: Vec<String>,
    /// Steps that had spent their work.
    cut_short: usize,
    /// Failed because midlines touched before a step, which guard mode must not let happen.
    stuck: usize,
    /// Motions made in which midlines meet.
    met: usize,
    /// The same of changes of resolution.
    met_remeshing: usize,
}

impl Tally {
    fn step(&mut self, mut before: Vec<Wire>, record: &StepRecord, world: &World) {
        self.steps += 1;
        self.prevented += record.collisions.crossings.len();
        self.held += record.collisions.scaled_islands.len();
        self.refused += record.collisions.refused_remeshes;
        self.remeshed += record.remeshes.len();
        let kinds = record.wires.iter().flat_map(|wire| &wire.kinds);
        let riding = kinds.filter(|kind| matches!(kind, NodeKind::Contact { .. }));
        self.riding += riding.count();
        self.met += meetings(record);
        self.cut_short += usize::from(record.solver.cut_short);
        for (wire, moved) in before.iter_mut().zip(&record.wires) {
            assert!(wire.iter().map(|(_, point)| point).eq(&moved.before));
            for ((_, point), to) in wire.iter_mut().zip(&moved.after) {
                *point = *to;
            }
        }
        for slide in &record.slides {
            before[slide.wire.0][slide.node].0 += slide.distance;
        }
        for change in &record.remeshes {
            self.met_remeshing += remesh(&mut before, change);
        }
        // So nothing was moved that is not in the record.
        assert_eq!(before, wires(world));
    }

    fn scene(&mut self, mut world: World, collisions: &mut Collisions<'_>) {
        for _ in 0..STEPS {
            let before = wires(&world);
            match world.step_colliding(collisions, &[]) {
                Ok(record) => self.step(before, &record, &world),
                Err(error) => {
                    assert_eq!(before, wires(&world));
                    self.failed.push(error.to_string());
                    self.stuck += usize::from(is_touching(&error.reason));
                    return;
                }
            }
        }
    }
}

/// Guard mode with one of both broad phases, and in every other pair of scenes with contact nodes.
fn collisions(seed: u64) -> Collisions<'static> {
    let method = [Method::SweepAndPrune, Method::HierarchicalGrid][seed as usize % 2];
    let collisions = Collisions::new(Mode::Guard, method, &Certified);
    if seed / 2 % 2 == 1 {
        collisions
    } else {
        collisions.without_contact_nodes()
    }
}

/// The seeds of the scenes: the first so many, or `TUNNELPROOF_SCENES`.
fn scenes(usual: u64) -> std::ops::Range<u64> {
    let seed = |text: &str| {
        text.parse()
            .expect("TUNNELPROOF_SCENES=COUNT or FIRST..END")
    };
    match std::env::var("TUNNELPROOF_SCENES") {
        Err(_) => 0..usual,
        Ok(text) => match text.split_once("..") {
            Some((first, end)) => seed(first)..seed(end),
            None => 0..seed(&text),
        },
    }
}

#[test]
fn guard_commits_no_motion_in_which_midlines_meet() {
    let scenes = scenes(60);
    let mut tally = Tally::default();
    for seed in scenes.clone() {
        let mut collisions = collisions(seed);
        let before = (tally.met, tally.met_remeshing);
        let failed = tally.failed.len();
        tally.scene(scene(seed), &mut collisions);
        for failure in &mut tally.failed[failed..] {
            failure.insert_str(0, &format!("seed {seed}, "));
        }
        assert_eq!(
            before,
            (tally.met, tally.met_remeshing),
            "scene of seed {seed}"
        );
    }
    println!("scenes {scenes:?}: {tally:?}");
    assert_eq!(tally.stuck, 0);
    // All parts of guard mode took part.
    assert!(tally.prevented > 0 && tally.held > 0 && tally.remeshed > 0 && tally.refused > 0);
    assert!(tally.riding > 0);
}

/// Scenes in which steps were once refused: chains whose segments pull in turns, one that threw a
/// coordinate to infinity, and contact nodes over which all of a segment would have slid.
#[test]
fn guard_does_every_step_of_scenes_that_were_hard() {
    for seed in [72, 1066, 1122, 1515, 3243, 6060, 6644, 9114] {
        let mut tally = Tally::default();
        let mut collisions = collisions(seed);
        tally.scene(scene(seed), &mut collisions);
        println!("seed {seed}: {tally:?}");
        assert_eq!(tally.steps, STEPS, "seed {seed}: {tally:?}");
        assert_eq!((tally.met, tally.met_remeshing), (0, 0), "seed {seed}");
    }
}

/// With nothing to spend no step fails: it ends with what the first sweeps or the first Newton step
/// give, says so, and is guarded all the same.
#[test]
fn steps_that_may_spend_nothing_are_made_guarded_and_said_to_be_cut_short() {
    let [mut fewest, mut usual] = [Tally::default(), Tally::default()];
    for seed in 0..40 {
        let mut world = scene(seed);
        usual.scene(world.clone(), &mut collisions(seed));
        let mut settings = world.settings().clone();
        settings.work = 0;
        world.set_settings(settings).unwrap();
        fewest.scene(world, &mut collisions(seed));
    }
    println!("{fewest:?}");
    assert_eq!(fewest.steps, 40 * STEPS, "{:?}", fewest.failed);
    assert_eq!((fewest.met, fewest.met_remeshing, fewest.stuck), (0, 0, 0));
    assert!(
        usual.cut_short > 0 && fewest.cut_short > 5 * usual.cut_short,
        "{usual:?}"
    );
}

/// The certified path, but every so many hits it says miss.
struct Careless {
    every: u64,
    hits: AtomicU64,
}

impl Careless {
    fn new(every: u64) -> Self {
        let hits = AtomicU64::new(0);
        Careless { every, hits }
    }
}

impl NarrowPhase for Careless {
    fn name(&self) -> &str {
        "careless"
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
        let mut report = Certified.edge_edge(query)?;
        if report.verdict.is_hit() {
            let hit = self.hits.fetch_add(1, Ordering::Relaxed);
            if hit % self.every == self.every - 1 {
                report.verdict = Verdict::Miss;
            }
        }
        Ok(report)
    }
}

/// No time passes in them, so the narrow phase has no say.
#[test]
fn changes_of_resolution_do_not_cross_whatever_narrow_phase_motions_have() {
    let narrow = Careless::new(1);
    let mut tally = Tally::default();
    for seed in 0..20 {
        let mut collisions = Collisions::new(Mode::Guard, Method::default(), &narrow);
        tally.scene(scene(seed), &mut collisions);
    }
    assert!(tally.met > 0 && tally.refused > 0, "{tally:?}");
    assert_eq!(tally.met_remeshing, 0, "{tally:?}");
}

/// A wire at 100 m/s across one that is pinned, each of one segment, so that they are kept apart by a
/// single pair.
fn one_pair() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let pinned = [-1.0, 1.0].map(|y| Stop::Pinned(Point::new(0.0, y, 0.0)));
    let thrown = [-1.0, 1.0].map(|x| Stop::Free(Point::new(x, 0.1, 0.5)));
    for (route, speed) in [(pinned, 0.0), (thrown, -100.0)] {
        let mut plan = WirePlan::new(Material::steel(0.01), 2.0, route.to_vec());
        plan.velocity = Vector::new(0.0, 0.0, speed);
        plan.resolution.adaptive = false;
        world.add_wire(&plan).unwrap();
    }
    world
}

#[test]
fn soak_finds_a_broad_phase_that_drops_a_pair() {
    for is_kept in [true, false] {
        let asked = AtomicU64::new(0);
        let keeps = |_, _| {
            asked.fetch_add(1, Ordering::Relaxed);
            is_kept
        };
        let mut tally = Tally::default();
        tally.scene(one_pair(), &mut Collisions::default().with_filter(&keeps));
        assert_eq!(tally.steps, STEPS, "{tally:?}");
        assert!(asked.into_inner() > 0, "{tally:?}");
        assert_eq!(tally.met > 0, !is_kept, "{tally:?}");
        assert_eq!(tally.prevented > 0, is_kept, "{tally:?}");
    }
}

#[test]
fn soak_finds_a_narrow_phase_that_misses() {
    for (every, is_missed) in [(1, true), (1000, false)] {
        let narrow = Careless::new(every);
        let mut tally = Tally::default();
        let mut collisions = Collisions::new(Mode::Guard, Method::default(), &narrow);
        tally.scene(one_pair(), &mut collisions);
        assert_eq!(tally.steps, STEPS, "{tally:?}");
        assert!(narrow.hits.into_inner() > 0, "{tally:?}");
        assert_eq!(tally.met > 0, is_missed, "{tally:?}");
        assert_eq!(tally.prevented > 0, !is_missed, "{tally:?}");
    }
}

//! Guard mode between two bodies, by the audit: thin plates and rods that are thrown at each other at
//! hard speeds, and none that passes through another one.
//!
//! `TUNNELPROOF_SCENES=10000 cargo test --release -p tunnelproof-cli --test two_bodies` for more
//! scenes.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tunnelproof::broad::Method;
use tunnelproof::certified::Certified;
use tunnelproof::nalgebra::{UnitQuaternion, UnitVector3};
use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyCrossingOutcome, BodyPlan, Collisions, Drive, Mode, Phase, Settings, Shape, StepRecord,
    Vector, World,
};
use tunnelproof_cli::audit::{Audit, Report, What};

const STEPS: usize = 6;

const SPEEDS: [f64; 5] = [15.0, 20.0, 50.0, 100.0, 300.0];

fn vector(rng: &mut ChaCha8Rng, size: f64) -> Vector {
    Vector::from_fn(|_, _| rng.random_range(-size..=size))
}

fn direction(rng: &mut ChaCha8Rng) -> Vector {
    UnitVector3::new_normalize(vector(rng, 1.0) + Vector::repeat(1e-3)).into_inner()
}

/// A plate or a rod, from 1 mm to 30 mm thick.
fn thin(rng: &mut ChaCha8Rng) -> Shape {
    let half = 0.5 * 10f64.powf(rng.random_range(-3.0..-1.5));
    let half_height = rng.random_range(0.2..0.6);
    match rng.random_range(0..4) {
        0 => Shape::Cylinder {
            radius: half,
            half_height,
        },
        1 => Shape::Capsule {
            radius: half,
            half_height,
        },
        2 => Shape::Box {
            half: Vector::new(half, half, half_height),
        },
        _ => Shape::Box {
            half: Vector::new(half, rng.random_range(0.2..0.6), half_height),
        },
    }
}

/// A body near a place that moves at a velocity, with random turn and spin.
fn body(rng: &mut ChaCha8Rng, position: Point, velocity: Vector, is_scripted: bool) -> BodyPlan {
    let spin = [0.0, 5.0, 60.0][rng.random_range(0..3)];
    let angular_velocity = vector(rng, spin);
    let drive = if is_scripted {
        Drive::Kinematic(vec![Phase {
            from: 0.0,
            velocity,
            angular_velocity,
        }])
    } else {
        Drive::Dynamic {
            density: 10f64.powf(rng.random_range(2.0..4.0)),
            velocity,
            angular_velocity,
        }
    };
    BodyPlan {
        drive,
        orientation: UnitQuaternion::from_scaled_axis(vector(rng, 2.0)),
        ..BodyPlan::fixed(thin(rng), position)
    }
}

/// A body that is thrown at another one, which forces move; a script moves the first one in every
/// second scene. Sometimes there is a third one, and a plane.
fn scene(seed: u64) -> World {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let mut world = World::new(Settings::default()).unwrap();
    let speed = SPEEDS[seed as usize % SPEEDS.len()];
    let away = direction(rng);
    let steps = rng.random_range(0.6..3.0);
    let offset = vector(rng, 0.25);
    let from = Point::from(away * (0.7 + speed * steps / 60.0) + offset);
    let is_scripted = seed / 5 % 2 == 0;
    let thrown = body(rng, from, -away * speed, is_scripted);
    world.add_body(thrown).unwrap();
    let drift = vector(rng, 2.0);
    let target = body(rng, Point::origin(), drift, false);
    world.add_body(target).unwrap();
    if rng.random_bool(0.3) {
        let beyond = Point::from(-away * rng.random_range(1.3..2.0));
        let third = body(rng, beyond, Vector::zeros(), false);
        world.add_body(third).unwrap();
    }
    if rng.random_bool(0.2) {
        let below = Point::new(0.0, 0.0, -0.7);
        world
            .add_body(BodyPlan::fixed(Shape::Plane, below))
            .unwrap();
    }
    world
}

fn collisions(seed: u64, mode: Mode) -> Collisions<'static> {
    let method = [Method::SweepAndPrune, Method::HierarchicalGrid][seed as usize % 2];
    let collisions = Collisions::new(mode, method, &Certified);
    if seed % 7 == 3 {
        collisions.with_guarded_thickness(0.5).unwrap()
    } else {
        collisions
    }
}

/// A run: its audit, its records, and why it stopped.
struct Run {
    report: Report,
    records: Vec<StepRecord>,
    stopped: Option<String>,
}

fn run(mut world: World, mut collisions: Collisions<'_>, steps: usize) -> Run {
    let mut audit = Audit::of_world(&world);
    let (mut records, mut stopped) = (Vec::new(), None);
    for _ in 0..steps {
        match world.step_colliding(&mut collisions, &[]) {
            Ok(record) => {
                audit.step(&record);
                records.push(record);
            }
            Err(error) => {
                stopped = Some(error.to_string());
                break;
            }
        }
    }
    let report = audit.finish();
    Run {
        report,
        records,
        stopped,
    }
}

fn count() -> u64 {
    let scenes = std::env::var("TUNNELPROOF_SCENES");
    scenes.map_or(60, |count| count.parse().expect("a number of scenes"))
}

fn held(records: &[StepRecord]) -> usize {
    let islands = records.iter().map(|r| r.collisions.scaled_islands.len());
    islands.sum()
}

#[test]
fn guard_lets_no_thin_body_pass_through_another() {
    let (mut steps, mut near, mut prevented, mut islands, mut rounds) = (0, 0, 0, 0, 0);
    let mut failures = Vec::new();
    for seed in 0..count() {
        let Run {
            report,
            records,
            stopped,
        } = run(scene(seed), collisions(seed, Mode::Guard), STEPS);
        steps += report.steps;
        near += report.core_pairs;
        prevented += report.core_prevented;
        islands += held(&records);
        rounds += records.iter().map(|r| r.collisions.rounds).sum::<usize>();
        if let Some(error) = stopped {
            failures.push(format!("seed {seed}: {error}"));
        }
        if !report.is_exact() {
            let findings: Vec<String> = report.findings.iter().map(|f| f.to_string()).collect();
            failures.push(format!(
                "seed {seed}: {findings:?} {:?}",
                report.core_standing
            ));
        }
    }
    println!(
        "{steps} steps, {near} pairs near each other, {prevented} touches prevented, {rounds} \
         solutions more, {islands} islands held"
    );
    assert_eq!(failures, Vec::<String>::new());
    assert!(prevented > 0);
}

/// Without a guard they pass, and the audit says so.
#[test]
fn bodies_pass_without_a_guard() {
    let (mut missed, mut passed, mut crossings) = (0, 0, 0);
    for seed in 0..count() {
        let unguarded = run(
            scene(seed),
            collisions(seed, Mode::Guard).without_bodies(),
            STEPS,
        );
        missed += u64::from(unguarded.report.core_missed > 0);
        let findings = unguarded.report.findings.iter();
        let crosses = |what: &What| matches!(what, What::CoreMissed { crossing: true, .. });
        crossings += findings.filter(|f| crosses(&f.what)).count();
        let thesis = run(scene(seed), collisions(seed, Mode::Thesis), STEPS);
        assert_eq!(thesis.report.core_missed, 0, "seed {seed}");
        assert_eq!(thesis.report.inexact(), 0, "seed {seed}");
        let through = |record: &StepRecord| {
            let crossings = record.collisions.core_crossings.iter();
            crossings
                .filter(|crossing| crossing.outcome == BodyCrossingOutcome::Passed)
                .count()
        };
        let through: usize = thesis.records.iter().map(through).sum();
        assert_eq!(through as u64, thesis.report.core_contacts, "seed {seed}");
        passed += u64::from(through > 0);
    }
    println!(
        "of {} scenes: {missed} without contacts, {crossings} crossings, {passed} in thesis mode",
        count()
    );
    assert!(missed > count() / 3 && passed > 0);
}

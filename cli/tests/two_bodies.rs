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
/// second run of five scenes. Sometimes there is a third one beyond it, or a plane.
fn scene(seed: u64) -> World {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let mut world = World::new(Settings::default()).unwrap();
    let speed = SPEEDS[seed as usize % SPEEDS.len()];
    let away = direction(rng);
    let steps = rng.random_range(0.6..3.0);
    let offset = vector(rng, 0.25);
    let from = Point::from(away * (0.7 + speed * steps / 60.0) + offset);
    let is_scripted = (seed / 5).is_multiple_of(2);
    let thrown = body(rng, from, -away * speed, is_scripted);
    world.add_body(thrown).unwrap();
    let drift = vector(rng, 2.0);
    let target = body(rng, Point::origin(), drift, false);
    world.add_body(target).unwrap();
    match rng.random_range(0..10) {
        0..3 => {
            let beyond = Point::from(-away * rng.random_range(1.3..2.0));
            let third = body(rng, beyond, Vector::zeros(), false);
            world.add_body(third).unwrap();
        }
        3..5 => {
            let turn = UnitQuaternion::rotation_between(&Vector::z(), &away);
            let beyond = BodyPlan {
                orientation: turn.unwrap_or_default(),
                ..BodyPlan::fixed(Shape::Plane, Point::from(-away))
            };
            world.add_body(beyond).unwrap();
        }
        _ => {}
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

fn audited(world: &World, records: &[StepRecord]) -> Report {
    let mut audit = Audit::of_world(world);
    records.iter().for_each(|record| audit.step(record));
    audit.finish()
}

/// Runs in thesis mode in which bodies pass.
fn passages() -> Vec<(World, Vec<StepRecord>)> {
    let runs = (0..30).map(|seed| {
        let world = scene(seed);
        let records = run(world.clone(), collisions(seed, Mode::Thesis), STEPS).records;
        (world, records)
    });
    let passes = |record: &StepRecord| !record.collisions.core_crossings.is_empty();
    runs.filter(|(_, records)| records.iter().any(passes))
        .collect()
}

#[test]
fn audit_finds_touches_that_are_dropped_moved_or_made_up() {
    let runs = passages();
    assert!(runs.len() > 5);
    for (world, records) in runs {
        let touches = |records: &[StepRecord]| -> u64 {
            let touches = records.iter().map(|r| r.collisions.core_crossings.len());
            touches.sum::<usize>() as u64
        };
        assert_eq!(audited(&world, &records).inexact(), 0);
        let changed = |change: &dyn Fn(&mut StepRecord)| {
            let mut records = records.clone();
            records.iter_mut().for_each(change);
            audited(&world, &records)
        };
        let dropped = changed(&|record| record.collisions.core_crossings.clear());
        assert_eq!(dropped.core_missed, touches(&records));
        let moved = |by: f64| {
            changed(&|record| {
                let crossings = record.collisions.core_crossings.iter_mut();
                crossings.for_each(|crossing| crossing.toi += by);
            })
        };
        assert_eq!(moved(1e-9).late.0, touches(&records));
        assert_eq!(moved(-1e-9).early.0, touches(&records));
        let made_up = changed(&|record| {
            let crossings = &mut record.collisions.core_crossings;
            crossings
                .iter_mut()
                .for_each(|crossing| crossing.bodies[1].0 += 9);
        });
        assert_eq!(made_up.false_hits, touches(&records));
        assert_eq!(made_up.core_missed, touches(&records));
    }
}

/// A scripted rod that turns by 286 degrees in a step, in seven stages, and a slow one across its
/// circle at an angle from where it starts.
fn fan(degrees: f64) -> World {
    let mut settings = Settings::default();
    settings.gravity = Vector::zeros();
    let mut world = World::new(settings).unwrap();
    let rod = |half: [f64; 3]| Shape::Box {
        half: Vector::from(half),
    };
    let turning = Drive::Kinematic(vec![Phase {
        from: 0.0,
        velocity: Vector::new(0.1, 0.2, 0.3),
        angular_velocity: Vector::new(0.0, 0.0, 300.0),
    }]);
    world
        .add_body(BodyPlan {
            drive: turning,
            ..BodyPlan::fixed(rod([0.4, 0.005, 0.005]), Point::new(0.4, 0.0, 0.0))
        })
        .unwrap();
    let angle = degrees.to_radians();
    let at = Point::new(0.4 + 0.35 * angle.cos(), 0.35 * angle.sin(), 0.02);
    let slow = Drive::Dynamic {
        density: 1000.0,
        velocity: Vector::new(0.2, 0.1, 0.0),
        angular_velocity: Vector::new(0.0, 0.0, 1.0),
    };
    world
        .add_body(BodyPlan {
            drive: slow,
            ..BodyPlan::fixed(rod([0.004, 0.004, 0.3]), at)
        })
        .unwrap();
    world
}

#[test]
fn touches_are_found_in_every_stage_of_a_turn() {
    let mut stages = [0; 7];
    for k in 0..20 {
        let world = fan(f64::from(k) * 9.0 + 4.0);
        let Run {
            report, records, ..
        } = run(world.clone(), collisions(0, Mode::Thesis), 1);
        let [record] = &records[..] else {
            panic!("no step")
        };
        let counts = record.bodies.iter().map(|body| body.between.len());
        assert_eq!(counts.collect::<Vec<_>>(), [6, 6]);
        // Where contacts keep them apart there is none.
        let [crossing] = record.collisions.core_crossings[..] else {
            continue;
        };
        assert_eq!((report.core_missed, report.inexact()), (0, 0), "{k}");
        stages[(crossing.toi * 7.0) as usize] += 1;
        let mut silent = records.clone();
        silent[0].collisions.core_crossings.clear();
        assert_eq!(audited(&world, &silent).core_missed, 1, "{k}");
        // Poses on the way of one body alone are not at the times of the other one's.
        let mut uneven = records.clone();
        uneven[0].bodies[1].between.pop();
        let findings = audited(&world, &uneven).findings;
        let is_unsound = |what: &What| matches!(what, What::BodyUnsound { .. });
        assert!(findings.iter().any(|finding| is_unsound(&finding.what)));
        let guarded = run(world, collisions(0, Mode::Guard), 3);
        assert_eq!(guarded.stopped, None);
        assert!(
            guarded.report.is_exact() && guarded.report.core_prevented > 0,
            "{k}"
        );
    }
    // A rod comes by twice in a turn of 360 degrees, so the first half has all first touches.
    assert!(stages[..4].iter().all(|count| *count > 0), "{stages:?}");
}

/// The fan, a body 5 m away, and a fast one 20 m away.
fn fan_and_others(degrees: f64) -> World {
    let mut world = fan(degrees);
    for (x, spin) in [(5.0, 1.0), (20.0, 1000.0)] {
        let drive = Drive::Dynamic {
            density: 1000.0,
            velocity: Vector::zeros(),
            angular_velocity: Vector::new(0.0, 0.0, spin),
        };
        let half = Vector::new(0.1, 0.01, 0.01);
        world
            .add_body(BodyPlan {
                drive,
                ..BodyPlan::fixed(Shape::Box { half }, Point::new(x, 0.0, 0.0))
            })
            .unwrap();
    }
    world
}

/// What is near a fast one has its stages, what is apart its own; the audit needs no more.
#[test]
fn bodies_that_are_far_from_each_other_have_their_own_stages() {
    let (mut prevented, mut turned) = (0, 0);
    for k in 0..20 {
        let world = fan_and_others(f64::from(k) * 9.0 + 4.0);
        let run = run(world.clone(), collisions(0, Mode::Guard), 3);
        assert_eq!((run.stopped, run.report.is_exact()), (None, true));
        prevented += run.report.core_prevented;
        let mut record = run.records[0].clone();
        let counts = record.bodies.iter().map(|body| body.between.len());
        let counts: Vec<usize> = counts.collect();
        // The fan may be held.
        assert!(counts[0] <= 6 && counts == [counts[0], counts[0], 0, 21]);
        turned += usize::from(counts[0] == 6);
        // Two with poses at other times must be out of reach by their records.
        let body = &mut record.bodies[2];
        for pose in [&mut body.before, &mut body.after] {
            pose.position.x = 19.85;
        }
        let findings = audited(&world, &[record]).findings;
        let uneven = |what: &What| matches!(what, What::BodyUnsound { body: 3 });
        assert!(findings.iter().any(|finding| uneven(&finding.what)));
    }
    assert!(prevented > 0 && turned > 0);
}

/// Scripts are kept where nothing can give way.
#[test]
fn two_scripted_bodies_pass_through_each_other() {
    let mut world = World::new(Settings::default()).unwrap();
    for sign in [-1.0, 1.0] {
        let drive = Drive::Kinematic(vec![Phase {
            from: 0.0,
            velocity: Vector::new(-sign * 50.0, 0.0, 0.0),
            angular_velocity: Vector::zeros(),
        }]);
        let half = Vector::new(0.01, 0.5, 0.5);
        world
            .add_body(BodyPlan {
                drive,
                ..BodyPlan::fixed(Shape::Box { half }, Point::new(sign, 0.0, 0.0))
            })
            .unwrap();
    }
    let run = run(world, Collisions::default(), 3);
    assert_eq!(run.stopped, None);
    assert_eq!((run.report.core_pairs, run.report.is_exact()), (0, true));
    let crossings = run
        .records
        .iter()
        .map(|r| r.collisions.core_crossings.len());
    assert_eq!(crossings.sum::<usize>(), 0);
}

/// A scripted plate that would force a body through a wall falls behind its script.
#[test]
fn scripted_body_falls_behind_where_nothing_gives_way() {
    let mut world = World::new(Settings::default()).unwrap();
    let wall = Shape::Box {
        half: Vector::new(0.005, 0.5, 0.5),
    };
    let at = |x: f64| Point::new(x, 0.0, 0.0);
    world
        .add_body(BodyPlan::fixed(wall.clone(), at(0.0)))
        .unwrap();
    let cube = Shape::Box {
        half: Vector::repeat(0.1),
    };
    world
        .add_body(BodyPlan::dynamic(cube, 1000.0, at(-0.2)))
        .unwrap();
    let drive = Drive::Kinematic(vec![Phase {
        from: 0.0,
        velocity: Vector::new(30.0, 0.0, 0.0),
        angular_velocity: Vector::zeros(),
    }]);
    world
        .add_body(BodyPlan {
            drive,
            ..BodyPlan::fixed(wall, at(-0.6))
        })
        .unwrap();
    let run = run(world, Collisions::default(), 12);
    assert_eq!((run.stopped, run.report.is_exact()), (None, true));
    let behind = run
        .records
        .iter()
        .flat_map(|r| &r.collisions.scaled_islands);
    assert!(
        behind
            .flat_map(|island| &island.behind)
            .any(|body| body.0 == 2)
    );
    let places = run.records.last().unwrap().bodies.iter();
    let places: Vec<f64> = places.map(|body| body.after.position.x).collect();
    // In the order in which they started, and the plate far behind its script.
    assert!(places[2] < places[1] && places[1] < places[0], "{places:?}");
    assert!(places[2] < 0.0, "{places:?}");
}

/// Two that overlap as they start are left out until they are apart.
#[test]
fn bodies_that_start_inside_each_other_may_come_apart() {
    let mut world = World::new(Settings::default()).unwrap();
    let half = Vector::repeat(0.2);
    let cube = Shape::Box { half };
    world
        .add_body(BodyPlan::fixed(cube.clone(), Point::origin()))
        .unwrap();
    let drive = Drive::Dynamic {
        density: 1000.0,
        velocity: Vector::new(20.0, 0.0, 0.0),
        angular_velocity: Vector::zeros(),
    };
    world
        .add_body(BodyPlan {
            drive,
            ..BodyPlan::fixed(cube, Point::new(0.2, 0.05, 0.03))
        })
        .unwrap();
    let run = run(world, Collisions::default(), 6);
    assert_eq!(run.stopped, None);
    let first = &run.records[0].collisions;
    assert!(first.core_crossings.is_empty() && first.scaled_islands.is_empty());
    assert!(run.report.is_exact(), "{:?}", run.report.findings.first());
    let last = run.records.last().unwrap();
    assert!(last.bodies[1].after.position.x > 0.5);
}

/// The same records on any number of threads, but for how long they took.
#[test]
fn records_do_not_depend_on_the_number_of_threads() {
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let records = |seed: u64| {
            let mut records = run(scene(seed), collisions(seed, Mode::Guard), STEPS).records;
            records
                .iter_mut()
                .for_each(|record| record.phases = Default::default());
            records
        };
        let all = || (0..20).map(records).collect::<Vec<_>>();
        pool.build().unwrap().install(all)
    };
    assert_eq!(of(1), of(3));
}

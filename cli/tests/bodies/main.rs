//! Guard mode against bodies, by the audit: thin bodies at hard speeds, and no midline that passes
//! through one.
//!
//! `TUNNELPROOF_SCENES=10000 cargo test --release -p tunnelproof-cli --test bodies` for more scenes.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use tunnelproof::broad::Method;
use tunnelproof::certified::Certified;
use tunnelproof::nalgebra::{UnitQuaternion, UnitVector3};
use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyCrossingOutcome, BodyPlan, Collisions, Drive, Material, Mode, Phase, Settings, Shape,
    StepRecord, Stop, Vector, WirePlan, World,
};
use tunnelproof_cli::audit::{Audit, Report, What};
use tunnelproof_cli::scenes::Scene;

const STEPS: usize = 12;

fn vector(rng: &mut ChaCha8Rng, size: f64) -> Vector {
    Vector::from_fn(|_, _| rng.random_range(-size..=size))
}

fn direction(rng: &mut ChaCha8Rng) -> Vector {
    UnitVector3::new_normalize(vector(rng, 1.0) + Vector::repeat(1e-3)).into_inner()
}

/// From 1 mm to 100 mm thick.
fn thin(rng: &mut ChaCha8Rng) -> Shape {
    let half = 0.5 * 10f64.powf(rng.random_range(-3.0..-1.0));
    let half_height = rng.random_range(0.2..1.0);
    let width = rng.random_range(0.05..0.6);
    match rng.random_range(0..5) {
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
        3 => Shape::Box {
            half: Vector::new(half, width, half_height),
        },
        _ => Shape::Sphere {
            radius: half.max(0.01),
        },
    }
}

/// A thin body that is thrown or moved by a script at the wires, which are around the origin.
fn body(rng: &mut ChaCha8Rng) -> BodyPlan {
    let speed = [1.0, 15.0, 100.0, 300.0][rng.random_range(0..4)] * rng.random_range(0.5..1.0);
    let away = direction(rng);
    let velocity = -away * speed;
    let spin = [0.0, 3.0, 40.0][rng.random_range(0..3)];
    let angular_velocity = vector(rng, spin);
    let steps = rng.random_range(0.5..3.0);
    let position = Point::from(away * (0.3 + speed * steps / 60.0) + vector(rng, 0.3));
    let drive = if rng.random_bool(0.5) {
        Drive::Dynamic {
            density: 10f64.powf(rng.random_range(2.0..4.0)),
            velocity,
            angular_velocity,
        }
    } else {
        Drive::Kinematic(vec![Phase {
            from: 0.0,
            velocity,
            angular_velocity,
        }])
    };
    BodyPlan {
        drive,
        orientation: UnitQuaternion::from_scaled_axis(vector(rng, 2.0)),
        ..BodyPlan::fixed(thin(rng), position)
    }
}

fn wire(rng: &mut ChaCha8Rng, world: &mut World) -> WirePlan {
    let mut point = Point::from(vector(rng, 1.0));
    let end = |rng: &mut ChaCha8Rng, world: &mut World, point: Point| match rng.random_range(0..9) {
        0..4 => Stop::Pinned(point),
        4..6 => {
            let mut plan = body(rng);
            plan.position = point;
            let body = world.add_body(plan).unwrap();
            Stop::Eye {
                body,
                local: vector(rng, 0.1),
            }
        }
        _ => Stop::Free(point),
    };
    let mut route = vec![end(rng, world, point)];
    for _ in 0..rng.random_range(0..3) {
        point += vector(rng, 1.0);
        route.push(Stop::Free(point));
    }
    point += vector(rng, 1.0);
    route.push(end(rng, world, point));
    let mut material = Material::steel(10f64.powf(rng.random_range(-3.0..-1.7)));
    if rng.random_bool(0.5) {
        material = material.chain();
    }
    material.stretch_modulus = 10f64.powf(rng.random_range(6.0..11.0));
    let mut plan = WirePlan::new(material, rng.random_range(0.1..0.5), route);
    let speed = [0.0, 1.0, 30.0][rng.random_range(0..3)];
    plan.velocity = vector(rng, speed);
    plan.resolution.adaptive = rng.random_bool(0.6);
    plan
}

/// Wires, and bodies that come at them.
fn scene(seed: u64) -> World {
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    let mut world = World::new(Settings::default()).unwrap();
    for _ in 0..rng.random_range(1..=4) {
        let plan = wire(rng, &mut world);
        world.add_wire(&plan).unwrap();
    }
    for _ in 0..rng.random_range(1..=3) {
        world.add_body(body(rng)).unwrap();
    }
    if rng.random_bool(0.2) {
        let below = Point::new(0.0, 0.0, -1.2);
        world
            .add_body(BodyPlan::fixed(Shape::Plane, below))
            .unwrap();
    }
    world
}

fn collisions(seed: u64) -> Collisions<'static> {
    let method = [Method::SweepAndPrune, Method::HierarchicalGrid][seed as usize % 2];
    let collisions = Collisions::new(Mode::Guard, method, &Certified);
    if seed / 2 % 2 == 1 {
        collisions
    } else {
        collisions.without_contact_nodes()
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

/// What was found wrong.
fn passed(report: &Report) -> u64 {
    report.body_missed + report.body_remeshes_through + report.jumps + report.astray
}

fn count() -> u64 {
    let scenes = std::env::var("TUNNELPROOF_SCENES");
    scenes.map_or(60, |count| count.parse().expect("a number of scenes"))
}

#[test]
fn guard_lets_no_midline_pass_through_a_thin_body() {
    let (mut steps, mut prevented, mut asked, mut held, mut built_in) = (0, 0, 0, 0, 0);
    let mut failures = Vec::new();
    let seeds = (0..count()).into_par_iter();
    let runs = seeds.map(|seed| run(scene(seed), collisions(seed), STEPS));
    for (seed, run) in (0..).zip(runs.collect::<Vec<Run>>()) {
        let Run {
            report,
            records,
            stopped,
        } = run;
        steps += report.steps;
        prevented += report.body_prevented;
        asked += report.body_pairs;
        built_in += report.body_standing.len();
        held += records
            .iter()
            .map(|r| r.collisions.scaled_islands.len())
            .sum::<usize>();
        if let Some(error) = stopped {
            failures.push(format!("seed {seed}: {error}"));
        }
        if passed(&report) > 0 || report.missed != [0; 3] {
            let findings: Vec<String> = report.findings.iter().map(|f| f.to_string()).collect();
            failures.push(format!("seed {seed}: {findings:?}"));
        }
    }
    println!(
        "{steps} steps, {asked} segments beside bodies, {prevented} touches prevented, {held} \
         islands held, {built_in} wires in bodies"
    );
    assert_eq!(failures, Vec::<String>::new());
    assert!(prevented > 0);
}

/// A soft wire between two pins, and a rod or bar across it that moves at it.
fn across(shape: Shape, speed: f64, offset: f64) -> World {
    let mut settings = Settings::default();
    settings.gravity = Vector::zeros();
    let mut world = World::new(settings).unwrap();
    let mut material = Material::steel(0.005).chain();
    material.stretch_modulus = 1e6;
    let ends = [-1.0, 1.0].map(|x| Stop::Pinned(Point::new(x, 0.0, 0.0)));
    let mut plan = WirePlan::new(material, 0.2, ends.to_vec());
    plan.resolution.adaptive = false;
    world.add_wire(&plan).unwrap();
    let drive = Drive::Kinematic(vec![Phase {
        from: 0.0,
        velocity: Vector::new(0.0, 0.0, speed),
        angular_velocity: Vector::zeros(),
    }]);
    // The cylinder's axis is z: along y.
    let along_y = UnitQuaternion::from_axis_angle(&Vector::x_axis(), -std::f64::consts::FRAC_PI_2);
    world
        .add_body(BodyPlan {
            drive,
            orientation: along_y,
            ..BodyPlan::fixed(shape, Point::new(0.03, 0.0, offset))
        })
        .unwrap();
    world
}

fn rods() -> impl Iterator<Item = (Shape, f64, f64)> {
    let mut rng = ChaCha8Rng::seed_from_u64(29);
    let radii = [0.002, 0.01, 0.05];
    [15.0, 20.0, 50.0, 100.0]
        .into_iter()
        .flat_map(move |speed| {
            let mut runs = Vec::new();
            for radius in radii {
                for is_bar in [false, true] {
                    let half_height = 0.5;
                    let shape = if is_bar {
                        Shape::Box {
                            half: Vector::new(radius, radius, half_height),
                        }
                    } else {
                        Shape::Cylinder {
                            radius,
                            half_height,
                        }
                    };
                    let offset = -radius - 0.006 - rng.random_range(0.0..1.0) * speed / 60.0;
                    runs.push((shape, speed, offset));
                }
            }
            runs
        })
}

#[test]
fn guard_carries_a_wire_along_with_every_rod() {
    for (shape, speed, offset) in rods() {
        let Run {
            report,
            records,
            stopped,
        } = run(
            across(shape.clone(), speed, offset),
            Collisions::default(),
            8,
        );
        let last = records.last().unwrap();
        let body = last.bodies[0].after.position.z;
        let script = offset + speed * records.len() as f64 / 60.0;
        let nodes = last.wires[0].after.iter().map(|point| point.z);
        let highest = nodes.fold(f64::NEG_INFINITY, f64::max);
        println!(
            "{shape:?} at {speed} m/s from {offset:.4}: body at {body:.3} of {script:.3}, wire at \
             {highest:.3}, prevented {}, held {}",
            report.body_prevented,
            records
                .iter()
                .map(|r| r.collisions.scaled_islands.len())
                .sum::<usize>()
        );
        assert_eq!(
            (stopped, passed(&report)),
            (None, 0),
            "{shape:?} {speed} {offset}"
        );
        assert!(report.body_standing.is_empty());
        assert!(highest > body, "the wire is not carried along");
    }
}

/// Without a guard they pass, and the audit says so.
#[test]
fn audit_finds_a_guard_that_ignores_bodies() {
    let (mut found, mut all) = (0, 0);
    for (shape, speed, offset) in rods() {
        let run = run(
            across(shape, speed, offset),
            Collisions::default().without_bodies(),
            8,
        );
        all += 1;
        found += usize::from(run.report.body_missed > 0 && !run.report.is_clean());
    }
    assert_eq!(found, all);
}

/// Thesis mode lets them pass, and says so.
#[test]
fn thesis_mode_reports_what_passes() {
    let mut passages = 0;
    for (shape, speed, offset) in rods() {
        let collisions = Collisions::new(Mode::Thesis, Method::default(), &Certified);
        let run = run(across(shape, speed, offset), collisions, 8);
        let of = |record: &StepRecord| {
            let crossings = record.collisions.body_crossings.iter();
            crossings
                .filter(|c| c.outcome == BodyCrossingOutcome::Passed)
                .count()
        };
        passages += run.records.iter().map(of).sum::<usize>();
        assert_eq!((run.report.body_missed, run.report.inexact()), (0, 0));
    }
    assert!(passages > 0);
}

#[test]
fn audit_finds_a_wrong_pose_and_a_crossing_that_was_not_reported() {
    let (shape, speed, offset) = rods().next().unwrap();
    let world = across(shape, speed, offset);
    let audited = |records: &[StepRecord]| {
        let mut audit = Audit::of_world(&world);
        records.iter().for_each(|record| audit.step(record));
        audit.finish()
    };
    let good = run(world.clone(), Collisions::default(), 4).records;
    assert_eq!(passed(&audited(&good)), 0);
    let mut moved = good.clone();
    moved[1].bodies[0].after.position.z += 0.3;
    let report = audited(&moved);
    assert!(report.body_missed > 0, "{report:?}");
    assert!(
        report
            .findings
            .iter()
            .any(|f| f.what == What::BodyJump { body: 0 })
    );
    let mut flipped = good.clone();
    flipped[2].bodies[0].after.orientation *=
        UnitQuaternion::from_axis_angle(&Vector::z_axis(), 3.0);
    let report = audited(&flipped);
    assert!(
        report
            .findings
            .iter()
            .any(|f| f.what == What::BodyUnsound { body: 0 })
    );
    let mut unknown = Audit::new(&[]);
    unknown.step(&good[0]);
    assert!(!unknown.finish().is_clean());
    let collisions = Collisions::new(Mode::Thesis, Method::default(), &Certified);
    let mut silent = run(world.clone(), collisions, 8).records;
    let dropped = silent
        .iter_mut()
        .map(|r| std::mem::take(&mut r.collisions.body_crossings));
    let dropped: usize = dropped.map(|crossings| crossings.len()).sum();
    assert_eq!(audited(&silent).body_missed, dropped as u64);
}

/// The scenes with thin bodies: nothing passes, and the guard has something to do.
#[test]
fn scenes_with_thin_bodies_run_to_their_ends_and_nothing_passes() {
    let scenes = [
        ("thin-blade", include_str!("../../scenes/thin-blade.toml")),
        ("propeller", include_str!("../../scenes/propeller.toml")),
        ("net", include_str!("../../scenes/net.toml")),
        ("plate-edge", include_str!("../../scenes/plate-edge.toml")),
        (
            "closing-hook",
            include_str!("../../scenes/closing-hook.toml"),
        ),
    ];
    for (name, text) in scenes {
        let scene = Scene::from_toml(text).unwrap();
        let collisions = scene.collisions(Mode::Guard, &Certified).unwrap();
        let Run {
            report, stopped, ..
        } = run(scene.world().unwrap(), collisions, scene.steps() as usize);
        println!("{name}: {} prevented of bodies", report.body_prevented);
        assert_eq!(stopped, None, "{name}");
        assert!(report.is_clean(), "{name}: {:?}", report.findings.first());
        let without = scene
            .collisions(Mode::Guard, &Certified)
            .unwrap()
            .without_bodies();
        let report = run(scene.world().unwrap(), without, scene.steps() as usize).report;
        assert!(
            report.body_missed > 0,
            "{name} has nothing to guard against"
        );
    }
}

//! A run that is saved, loaded and gone on with gives the same bits as one that was never stopped.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use proptest::prelude::*;
use tunnelproof::broad::Method;
use tunnelproof::certified::Certified;
use tunnelproof::narrow::NarrowPhase;
use tunnelproof::query::Point;
use tunnelproof::thesis::Thesis;
use tunnelproof::wire::recording::Recorder;
use tunnelproof::wire::state::State;
use tunnelproof::wire::{
    BodyPlan, Collisions, ContactConstraint, Material, Mode, NodeKind, Phases, Resolution,
    Settings, Shape, StepRecord, Stop, Vector, WireId, WirePlan, World,
};
use tunnelproof_cli::scenes::{self, Scene};
use tunnelproof_cli::simulate::Discrete;

mod worlds;

/// A world between two steps, and what it is stepped with.
struct Run {
    world: World,
    collisions: Collisions<'static>,
    /// Contacts that are given, in place of collisions.
    given: Option<fn(&World) -> Vec<ContactConstraint>>,
    narrow: &'static dyn NarrowPhase,
}

impl Run {
    fn new(world: World, collisions: Collisions<'static>) -> Self {
        Run {
            world,
            collisions,
            given: None,
            narrow: &Certified,
        }
    }

    fn given(world: World, given: fn(&World) -> Vec<ContactConstraint>) -> Self {
        let run = Run::new(world, Collisions::default());
        let given = Some(given);
        Run { given, ..run }
    }

    fn scene(scene: &Scene, mode: Mode, narrow: &'static dyn NarrowPhase) -> Self {
        let collisions = scene.collisions(mode, narrow).unwrap();
        Run {
            narrow,
            ..Run::new(scene.world().unwrap(), collisions)
        }
    }

    /// A step, without the time it took.
    fn step(&mut self) -> StepRecord {
        let mut record = match self.given {
            Some(given) => self.world.step(&given(&self.world)),
            None => self.world.step_colliding(&mut self.collisions, &[]),
        }
        .unwrap();
        record.phases = Phases::default();
        record
    }

    fn saved(&self) -> Vec<u8> {
        let mut file = Vec::new();
        State::of(&self.world, &self.collisions)
            .save(&mut file)
            .unwrap();
        file
    }

    /// What comes of a file, found by another broad phase.
    fn loaded(&self, file: &[u8]) -> Run {
        let state = State::load(file).unwrap();
        Run {
            collisions: state.collisions(Method::BruteForce, self.narrow),
            world: state.world,
            ..*self
        }
    }
}

/// A record to the bit.
fn bits(run: &Run, record: &StepRecord) -> Vec<u8> {
    let mut recorder = Recorder::new(Vec::new(), &run.world).unwrap();
    recorder.record(record).unwrap();
    recorder.into_inner()
}

/// Saves the run after every step from some step on, goes on from there by one step, and every so
/// often to the end. Returns the records.
fn check(name: &str, mut run: Run, steps: usize, from: usize) -> Vec<StepRecord> {
    let mut others: Vec<(usize, Run)> = Vec::new();
    let mut records = Vec::new();
    for step in 0..steps {
        let mut file = None;
        if step >= from {
            let saved = run.saved();
            let loaded = run.loaded(&saved);
            assert!(loaded.saved() == saved, "{name}: saved again at {step}");
            let is_kept = (step - from).is_multiple_of(23);
            file = Some((is_kept, loaded));
        }
        let record = run.step();
        let [expected, now] = [bits(&run, &record), run.saved()];
        let check = |since: usize, other: &mut Run| {
            let record = other.step();
            let [record, state] = [bits(other, &record), other.saved()];
            assert!(
                record == expected,
                "{name}: record of step {step}, loaded at {since}"
            );
            assert!(
                state == now,
                "{name}: state after step {step}, loaded at {since}"
            );
        };
        for (since, other) in &mut others {
            check(*since, other);
        }
        if let Some((is_kept, mut loaded)) = file {
            check(step, &mut loaded);
            if is_kept {
                others.push((step, loaded));
            }
        }
        records.push(record);
    }
    records
}

#[test]
fn worlds_of_all_sorts_go_on_from_every_step() {
    check(
        "box",
        Run::given(worlds::tumbling_box(), worlds::contacts),
        120,
        0,
    );
    let records = check("hoist", Run::given(worlds::hoist(), |_| Vec::new()), 60, 0);
    assert!(records.iter().any(|record| !record.slides.is_empty()));
    let records = check(
        "heap",
        Run::new(worlds::heap(), Collisions::default()),
        120,
        0,
    );
    assert!(records.iter().any(|record| record.contacts.len() > 4));
    let run = Run::new(worlds::twisted(), Collisions::default());
    let records = check("twisted", run, 90, 0);
    let last = &records[89].wires;
    assert!(last[0].torque.abs() > 1.0 && last[1].torque > 1.0);
    assert!(records.iter().any(|record| !record.remeshes.is_empty()));
    let collisions = Collisions::default();
    let collisions = collisions.with_friction(0.1).unwrap();
    let records = check("edge", Run::new(worlds::edge(), collisions), 60, 0);
    let mut slides = records.iter().flat_map(|record| &record.slides);
    assert!(slides.any(|slide| slide.left));
    let mut kinds = records.iter().flat_map(|record| &record.wires[0].kinds);
    assert!(kinds.any(|kind| matches!(kind, NodeKind::Contact { .. })));
}

#[test]
fn scenes_of_the_thesis_go_on_from_every_step_with_contacts() {
    for (name, steps, from) in [
        ("basic-collision", 150, 0),
        ("pulling-anchor", 600, 520),
        ("twisting-under-load", 60, 0),
        ("chains-on-deck", 80, 30),
    ] {
        let scene = Scene::embedded(name).unwrap();
        let records = check(
            name,
            Run::scene(&scene, Mode::Guard, &Certified),
            steps,
            from,
        );
        let contacts = records[from..].iter().map(|record| record.contacts.len());
        assert!(contacts.sum::<usize>() > 0, "{name}");
        if name == "basic-collision" {
            let mut records = records.iter();
            assert!(records.any(|record| !record.collisions.crossings.is_empty()));
        }
    }
}

/// The ledger of sides, and narrow phases whose answers depend on what is left out of a step.
#[test]
fn thesis_mode_goes_on_from_every_step() {
    static THESIS: std::sync::LazyLock<Thesis> = std::sync::LazyLock::new(Thesis::default);
    let scene = Scene::embedded("basic-collision").unwrap();
    let narrow: [&'static dyn NarrowPhase; 2] = [&Discrete, &*THESIS];
    for narrow in narrow {
        let name = narrow.name().to_owned();
        let records = check(&name, Run::scene(&scene, Mode::Thesis, narrow), 200, 0);
        let passed = |record: &StepRecord| !record.collisions.crossings.is_empty();
        assert_eq!(records.iter().any(passed), name == "thesis");
    }
}

#[test]
fn thin_and_thick_scenes_go_on_from_every_step() {
    for (file, thickness) in [
        (include_str!("../scenes/two-plates.toml"), 0.0),
        (include_str!("../scenes/propeller.toml"), 0.0),
        (include_str!("../scenes/plate-edge.toml"), 0.0),
        (include_str!("../scenes/crane.toml"), 0.0),
        (include_str!("../scenes/basic-collision.toml"), 0.5),
    ] {
        let mut scene = Scene::from_toml(file).unwrap();
        scene.guarded_thickness = thickness;
        let steps = scene.steps().min(120) as usize;
        let name = scene.title.clone();
        check(&name, Run::scene(&scene, Mode::Guard, &Certified), steps, 0);
    }
}

/// Bytes do not tell that settings are others, steps do; time goes on from where it was.
#[test]
fn state_is_stepped_again_with_other_settings() {
    let mut scene = Scene::embedded("basic-collision").unwrap();
    let ends = [-1.0, 1.0].map(|x| scenes::Stop::Free([x, 0.0, 0.6]));
    scene.wires[2].route = ends.to_vec();
    let mut run = Run::scene(&scene, Mode::Guard, &Certified);
    // While the third wire falls.
    for _ in 0..2 {
        run.step();
    }
    let file = run.saved();
    let time = run.world.time();
    let tried = |change: &dyn Fn(&mut Run)| {
        let mut other = run.loaded(&file);
        change(&mut other);
        assert_eq!(other.world.time(), time);
        let records: Vec<_> = (0..60).map(|_| other.step()).collect();
        (other, records)
    };
    let (_, as_it_was) = tried(&|_| {});
    let (half, _) = tried(&|run| {
        let step = run.world.settings().step / 2.0;
        let settings = run.world.settings().clone().with_step(step);
        run.world.set_settings(settings).unwrap();
    });
    let step = half.world.settings().step;
    assert_eq!(half.world.time(), time + 60.0 * step);
    let (finer, _) = tried(&|run| {
        let resolution = Resolution {
            length: run.world.wires()[0].resolution().length / 4.0,
            adaptive: true,
        };
        run.world.set_resolution(WireId(0), resolution).unwrap();
    });
    let nodes = |world: &World| world.wires()[0].nodes().len();
    assert!(nodes(&finer.world) > nodes(&run.world));
    let unguarded = |run: &mut Run| {
        let memory = run.collisions.memory();
        let collisions = Collisions::new(Mode::Guard, Method::default(), &Discrete);
        run.collisions = collisions.with_mode(Mode::Thesis).with_memory(memory);
    };
    let (_, unguarded) = tried(&unguarded);
    assert!(as_it_was != unguarded);
    let mut world = run.loaded(&file).world;
    let settings = Settings::default().with_step(-1.0);
    assert!(world.set_settings(settings).is_err());
    let resolution = Resolution {
        length: 0.0,
        adaptive: true,
    };
    assert!(world.set_resolution(WireId(0), resolution).is_err());
    assert!(world.set_resolution(WireId(9), resolution).is_err());
}

/// Wires and bodies anywhere near each other.
fn random_world(
    wires: &[([f64; 3], [f64; 3], f64, bool)],
    bodies: &[([f64; 3], u8)],
    step: f64,
) -> World {
    let mut world = World::new(Settings::default().with_step(step)).unwrap();
    let ground = BodyPlan::fixed(Shape::Plane, Point::new(0.0, 0.0, -1.5));
    world.add_body(ground).unwrap();
    for (position, shape) in bodies {
        let radius = 0.2;
        let half_height = 0.15;
        let shape = match shape % 4 {
            0 => Shape::Sphere { radius },
            1 => Shape::Box {
                half: Vector::new(0.1, 0.2, 0.3),
            },
            2 => Shape::Cylinder {
                radius,
                half_height,
            },
            _ => Shape::Capsule {
                radius,
                half_height,
            },
        };
        let plan = BodyPlan::dynamic(shape, 700.0, Point::from(*position));
        world.add_body(plan).unwrap();
    }
    for (from, to, speed, is_chain) in wires {
        let steel = Material::steel(0.01);
        let material = if *is_chain { steel.chain() } else { steel };
        let [from, to] = [from, to].map(|at| Point::from(*at));
        let stops = [Stop::Pinned(from), Stop::Free(to + Vector::repeat(1e-3))];
        let mut plan = WirePlan::new(material, 0.2, stops.to_vec()).adaptive();
        plan.velocity = Vector::new(0.0, 0.0, *speed);
        world.add_wire(&plan).unwrap();
    }
    world
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn random_worlds_go_on_as_if_there_had_been_no_stop(
        wires in prop::collection::vec(
            (
                prop::array::uniform3(-1.0..1.0),
                prop::array::uniform3(-1.0..1.0),
                -5.0..5.0,
                any::<bool>(),
            ),
            1..5,
        ),
        bodies in prop::collection::vec((prop::array::uniform3(-1.0..1.0), any::<u8>()), 0..4),
        step in 0.005..0.03,
        thickness in prop::sample::select(vec![0.0, 0.5]),
        contact_nodes in any::<bool>(),
        before in 0_usize..30,
    ) {
        let world = random_world(&wires, &bodies, step);
        let mut collisions = Collisions::default().with_guarded_thickness(thickness).unwrap();
        if !contact_nodes {
            collisions = collisions.without_contact_nodes();
        }
        let mut run = Run::new(world, collisions);
        for _ in 0..before {
            prop_assume!(run.world.step_colliding(&mut run.collisions, &[]).is_ok());
        }
        let file = run.saved();
        let mut other = run.loaded(&file);
        prop_assert!(other.saved() == file);
        for _ in 0..15 {
            let [one, two] = [&mut run, &mut other].map(|run| {
                let record = run.world.step_colliding(&mut run.collisions, &[]);
                record.map(|mut record| {
                    record.phases = Phases::default();
                    bits(run, &record)
                })
            });
            prop_assert!(one == two);
            prop_assert!(run.saved() == other.saved());
        }
    }
}

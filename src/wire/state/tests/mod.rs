use std::sync::LazyLock;

use super::content::Content;
use super::*;
use crate::certified::Certified;
use crate::query::Point;
use crate::wire::file::LABEL;
use crate::wire::file::testing::forged;
use crate::wire::{
    BodyId, BodyPlan, ContactConstraint, ContactSite, Drive, Material, Phase, Settings, Shape,
    Stop, Vector, WirePlan,
};

mod every_field;
mod hostile;

use every_field::every_field;

/// Where a state that was written once is; a change of the layout without a new version does not
/// write it again.
const GOLDEN: &[u8] = include_bytes!("golden.tpstate");

fn saved(state: &State) -> Vec<u8> {
    let mut file = Vec::new();
    state.save(&mut file).unwrap();
    file
}

/// What is packed in a file.
fn plain(file: &[u8]) -> Vec<u8> {
    let (content, _) = FORMAT
        .part::<Content>(&mut &file[LABEL..])
        .unwrap()
        .unwrap();
    postcard::to_stdvec(&content).unwrap()
}

/// A file of a content that was changed, under a checksum that is right.
fn file_of(plain: &[u8]) -> Vec<u8> {
    [FORMAT.opening(), forged(plain)].concat()
}

/// A wire that falls on another and on a body, in guard mode, after some steps.
fn after(steps: usize) -> (World, Collisions<'static>) {
    let mut world = World::new(Settings::default()).unwrap();
    let half = Vector::new(0.2, 0.3, 0.1);
    let plan = BodyPlan::dynamic(Shape::Box { half }, 800.0, Point::new(0.6, 0.0, 0.1));
    let body = world.add_body(plan).unwrap();
    let ground = BodyPlan::fixed(Shape::Plane, Point::new(0.0, 0.0, -0.5));
    world.add_body(ground).unwrap();
    let turning = Drive::Kinematic(vec![Phase {
        from: 0.0,
        velocity: Vector::zeros(),
        angular_velocity: Vector::x(),
    }]);
    let drum = BodyPlan::fixed(Shape::Sphere { radius: 0.1 }, Point::new(-1.0, 0.0, -0.2));
    let drive = turning;
    world.add_body(BodyPlan { drive, ..drum }).unwrap();
    let steel = Material::steel(0.01);
    let ends = [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]].map(|at| Stop::Pinned(at.into()));
    world
        .add_wire(&WirePlan::new(steel, 0.25, ends.to_vec()))
        .unwrap();
    let eye = Stop::Eye {
        body,
        local: Vector::new(-0.2, 0.0, 0.1),
    };
    let route = vec![Stop::Free(Point::new(-1.5, 0.05, 0.25)), eye];
    let mut plan = WirePlan::new(steel.chain(), 0.125, route).adaptive();
    plan.velocity = Vector::new(0.0, 0.0, -6.0);
    world.add_wire(&plan).unwrap();
    let mut collisions = Collisions::default();
    for _ in 0..steps {
        world.step_colliding(&mut collisions, &[]).unwrap();
    }
    (world, collisions)
}

/// What is packed in a file after two steps.
fn plain_after_two() -> Vec<u8> {
    static PLAIN: LazyLock<Vec<u8>> = LazyLock::new(|| plain(&saved(&state_after(2))));
    PLAIN.clone()
}

fn state_after(steps: usize) -> State {
    let (world, collisions) = after(steps);
    State::of(&world, &collisions)
}

#[test]
fn state_reads_back_bit_for_bit_with_something_in_every_field() {
    for state in [every_field(), state_after(0), state_after(40)] {
        let file = saved(&state);
        let loaded = State::load(file.as_slice()).unwrap();
        assert_eq!(saved(&loaded), file);
        assert_eq!(loaded.world.bodies, state.world.bodies);
        assert_eq!(loaded.world.wires, state.world.wires);
        assert_eq!(loaded.world.settings, state.world.settings);
        assert_eq!(loaded.world.time(), state.world.time());
        assert_eq!(loaded.settings, state.settings);
        let known = |state: &State| format!("{:?}", state.memory.between_wires);
        assert_eq!(known(&loaded), known(&state));
    }
}

/// To write the file anew, with a new [`VERSION`]:
/// `TUNNELPROOF_GOLDEN=1 cargo test --lib layout_is_that_of_the_version`.
#[test]
fn layout_is_that_of_the_version() {
    let file = saved(&every_field());
    if std::env::var_os("TUNNELPROOF_GOLDEN").is_some() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/src/wire/state/tests/golden.tpstate"
        );
        std::fs::write(path, &file).unwrap();
    }
    assert_eq!(GOLDEN[..LABEL], file[..LABEL]);
    assert!(
        plain(GOLDEN) == plain(&file),
        "the layout has changed: it needs a new version"
    );
    // Whoever packs it, it is the same state.
    assert_eq!(saved(&State::load(GOLDEN).unwrap()), file);
}

#[test]
fn negative_zero_and_the_least_number_stay() {
    let mut state = state_after(0);
    let node = &mut state.world.wires[1].nodes[2];
    node.velocity = Vector::new(-0.0, 5e-324, -5e-324);
    let loaded = State::load(saved(&state).as_slice()).unwrap();
    let bits = |state: &State| {
        let velocity = state.world.wires[1].nodes[2].velocity;
        [velocity.x, velocity.y, velocity.z].map(f64::to_bits)
    };
    assert_eq!(bits(&loaded), bits(&state));
}

#[test]
fn step_that_fails_leaves_the_state_as_it_was() {
    let (mut world, mut collisions) = after(20);
    let before = saved(&State::of(&world, &collisions));
    let unknown = ContactConstraint {
        key: 1,
        a: ContactSite::World,
        b: ContactSite::Body {
            body: BodyId(9),
            local: Vector::zeros(),
        },
        normal: Vector::z(),
        gap: 0.0,
        friction: 0.0,
    };
    world
        .step_colliding(&mut collisions, &[unknown])
        .unwrap_err();
    assert!(saved(&State::of(&world, &collisions)) == before);
    // A midline that stands in another.
    let mut through = world.clone();
    through.wires[1].nodes[1].position = world.wires[0].nodes[4].position;
    let before = saved(&State::of(&through, &collisions));
    through.step_colliding(&mut collisions, &[]).unwrap_err();
    assert!(saved(&State::of(&through, &collisions)) == before);
}

/// The structure of the last system, which is left out, changes no bit: a world that lost it goes
/// on as one that kept it.
#[test]
fn memory_and_world_go_on_as_if_there_had_been_no_stop() {
    let (mut world, mut collisions) = after(0);
    let mut seen = [false; 5];
    for step in 0..90 {
        let state = State::of(&world, &collisions);
        let memory = &state.memory;
        for (seen, is_there) in seen.iter_mut().zip([
            !state.world.cache.warm_start.impulses().is_empty(),
            memory.between_wires.list.iter().any(|touch| touch.pushing),
            !memory.with_bodies.last.is_empty(),
            !memory.with_bodies.pushed.is_empty(),
            !memory.slow.excluded().is_empty(),
        ]) {
            *seen |= is_there;
        }
        let state = State::load(saved(&state).as_slice()).unwrap();
        let mut again = state.collisions(Method::HierarchicalGrid, &Certified);
        let mut copy = state.world;
        let [mut record, mut other] = [
            world.step_colliding(&mut collisions, &[]).unwrap(),
            copy.step_colliding(&mut again, &[]).unwrap(),
        ];
        (record.phases, other.phases) = Default::default();
        let bits = |record| postcard::to_stdvec(&record).unwrap();
        assert!(bits(record) == bits(other), "record of step {step}");
        let [kept, lost] = [(&world, &collisions), (&copy, &again)]
            .map(|(world, collisions)| saved(&State::of(world, collisions)));
        assert!(kept == lost, "state after step {step}");
    }
    // Steps leave something in every part.
    assert_eq!(seen, [true; 5]);
}

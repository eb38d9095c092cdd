use std::sync::LazyLock;

use nalgebra::{Matrix3, UnitQuaternion};
use proptest::prelude::*;
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

use super::content::{Content, ModeContent, ShapeContent};
use super::*;
use crate::broad::SlowPairs;
use crate::certified::Certified;
use crate::query::Point;
use crate::wire::collide::{BODY_KEYS, KnownContacts, WIRE_KEYS, WireContact, WireContacts};
use crate::wire::file::LABEL;
use crate::wire::file::testing::{edited, edits, forged, labelled};
use crate::wire::model::wire::TENSION_HISTORY;
use crate::wire::model::{Body, Node, NodeKind, Segment, Wire};
use crate::wire::site::WireSite;
use crate::wire::solver_cache::{SolverCache, WarmStart};
use crate::wire::world::Epoch;
use crate::wire::{
    BodyId, BodyPlan, ContactConstraint, ContactSite, Drive, Material, Mesh, Mode, Phase,
    Resolution, Settings, Shape, Stop, Vector, WireId, WirePlan,
};

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

/// Numbers of which no two are the same, in order of use.
struct Numbers(f64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 += 1.0;
        self.0
    }

    fn vector(&mut self) -> Vector {
        Vector::from_fn(|_, _| self.next())
    }
}

/// A state with something in every field, and no number twice where there is a choice: made by
/// hand, so that it does not hang on the bits of steps.
fn every_field() -> State {
    let mut n = Numbers(0.0);
    let settings = Settings {
        step: n.next(),
        gravity: n.vector(),
        contact_compliance: n.next(),
        contact_damping: n.next(),
        impact_speed: n.next(),
        sweeps: 17,
        contact_tolerance: n.next(),
        stability_margin: 0.25,
        split_ratio: n.next(),
        slide_limit: n.next(),
    };
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mesh = Mesh::new(corners.map(Point::from).to_vec(), triangles).unwrap();
    let shapes = [
        Shape::Mesh(mesh),
        Shape::Box { half: n.vector() },
        Shape::Cylinder {
            radius: n.next(),
            half_height: n.next(),
        },
        Shape::Sphere { radius: n.next() },
        Shape::Capsule {
            radius: n.next(),
            half_height: n.next(),
        },
        Shape::Plane,
    ];
    let mut bodies = Vec::new();
    for (k, shape) in shapes.into_iter().enumerate() {
        let dynamic = k == 1;
        let phases = (0..k / 2).map(|_| Phase {
            from: n.next(),
            velocity: n.vector(),
            angular_velocity: n.vector(),
        });
        let phases = phases.collect();
        let (mut mass, mut inertia) = (0.0, Matrix3::zeros());
        if dynamic {
            mass = n.next();
            let diagonal = n.vector() * 100.0;
            inertia = Matrix3::from_diagonal(&diagonal);
            (inertia[(0, 1)], inertia[(1, 0)]) = (0.5, 0.5);
        }
        bodies.push(Body {
            shape,
            dynamic,
            phases,
            mass,
            inertia,
            position: n.vector().into(),
            orientation: UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3),
            velocity: n.vector(),
            angular_velocity: n.vector(),
        });
    }
    let material = Material {
        density: n.next(),
        radius: n.next(),
        stretch_modulus: n.next(),
        bend_modulus: n.next(),
        stretch_damping: n.next(),
        bend_damping: n.next(),
    };
    let local = n.vector();
    let body = BodyId(2);
    let contact = NodeKind::Contact {
        body,
        local,
        normal: n.vector(),
        friction: n.next(),
    };
    let eye = NodeKind::Eye { body, local };
    let at = bodies[2].point(&local);
    let kinds = [NodeKind::Pinned, NodeKind::Free, contact, eye];
    let nodes = kinds.into_iter().enumerate().map(|(k, kind)| Node {
        position: if k < 2 { n.vector().into() } else { at },
        velocity: n.vector(),
        arc: 10.0 * k as f64,
        kind,
        slide: if k == 2 { -n.next() } else { 0.0 },
        remesh_from: k as u64,
    });
    let nodes = nodes.collect();
    let segments = (0..3).map(|_| Segment {
        tension: -n.next(),
        tension_history: std::array::from_fn(|_| n.next()),
    });
    let segments = segments.collect();
    let wire = Wire {
        material,
        resolution: Resolution {
            length: n.next(),
            adaptive: true,
        },
        nodes,
        segments,
    };
    let impulses = [(3, n.vector()), (8, n.vector())];
    let world = World {
        settings,
        bodies,
        wires: vec![wire],
        steps: 1000,
        epoch: Epoch {
            steps: 900,
            time: n.next(),
        },
        cache: SolverCache {
            warm_start: WarmStart::new(impulses.into_iter()),
            structure: None,
        },
    };
    let site = |arc| WireSite {
        wire: WireId(0),
        arc,
    };
    let touch = WireContact {
        key: WIRE_KEYS + 5,
        sites: [site(1.0), site(25.0)],
        wrong: true,
        normal: -Vector::y(),
        gap: n.next(),
        pushing: false,
    };
    let other = WireContact {
        key: WIRE_KEYS + 4,
        sites: [site(2.0), site(26.0)],
        wrong: false,
        pushing: true,
        ..touch.clone()
    };
    let with_body = ContactConstraint {
        key: BODY_KEYS + 7,
        a: site(3.0).into(),
        b: ContactSite::Body { body, local },
        normal: Vector::z(),
        gap: n.next(),
        friction: n.next(),
    };
    let placed = [0.0, 1e4, 2e4].map(|z| {
        let ends = [0.0, 1.0].map(|x| Point::new(x, n.next(), z));
        (n.next(), ends)
    });
    let [a, b, c] = placed;
    let memory = CollisionMemory {
        slow: SlowPairs::between_steps(
            vec![Some(a), None, Some(b), Some(c)],
            vec![([0, 2], n.next()), ([0, 3], n.next())],
        ),
        between_wires: WireContacts {
            list: vec![touch, other],
            made: 6,
        },
        with_bodies: KnownContacts {
            last: vec![with_body],
            given: 9,
            pushed: vec![site(4.0)],
        },
    };
    State {
        world,
        narrow: "certified".to_owned(),
        settings: CollisionSettings {
            mode: Mode::Thesis,
            friction: n.next(),
            guarded_thickness: 0.375,
            bodies: true,
            contact_nodes: false,
        },
        memory,
    }
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
    let mut collisions = Collisions::default().with_contact_nodes();
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
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/wire/state/golden.tpstate");
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

#[test]
fn file_that_is_cut_or_has_more_is_refused() {
    let file = saved(&state_after(3));
    for cut in 0..file.len() {
        let error = State::load(&file[..cut]).unwrap_err();
        let offset = if cut < LABEL { 0 } else { Format::OPENING };
        assert_eq!((error.offset, error.fault), (offset, Fault::Cut), "{cut}");
    }
    let error = State::load([&file[..], b"x"].concat().as_slice()).unwrap_err();
    let text = format!(
        "byte {}: is sound but not what belongs here: more bytes after the state of a world",
        file.len()
    );
    assert_eq!(error.to_string(), text);
}

#[test]
fn byte_that_is_wrong_is_found_or_changes_nothing() {
    let file = saved(&state_after(2));
    let mut found = 0;
    for at in 0..file.len() {
        for flip in [0x01, 0x80, 0xff] {
            let mut bad = file.clone();
            bad[at] ^= flip;
            match State::load(bad.as_slice()) {
                Ok(state) => assert_eq!(saved(&state), file, "byte {at}"),
                Err(_) => found += 1,
            }
        }
    }
    // A byte may stand for nothing, such as a flag of a zstd frame that is not looked at.
    assert!(
        found > 3 * file.len() * 99 / 100,
        "{found} of {}",
        3 * file.len()
    );
}

#[test]
fn file_of_something_else_is_named() {
    let said = |bytes: &[u8]| State::load(bytes).unwrap_err().to_string();
    assert_eq!(
        said(b"something else"),
        "byte 0: this is no state of a world"
    );
    let recording = crate::wire::recording::Recorder::new(Vec::new(), &state_after(0).world);
    let recording = recording.unwrap().into_inner();
    assert_eq!(said(&recording), "byte 0: this is no state of a world");
    let mut other = saved(&state_after(0));
    other[16] = 99;
    let text = format!("byte 0: version 99 of the layout; only {VERSION} is known");
    assert_eq!(said(&other), text);
    assert_eq!(said(&file_of(b"abc")).split(':').next().unwrap(), "byte 20");
}

/// What is said of a state of which something was changed.
fn refusal(change: impl FnOnce(&mut Content)) -> String {
    let mut content = Content::from(&every_field());
    change(&mut content);
    let file = [FORMAT.opening(), FORMAT.pack(&content).unwrap()].concat();
    let error = State::load(file.as_slice()).unwrap_err();
    assert_eq!(error.offset, Format::OPENING);
    assert!(matches!(error.fault, Fault::Value { .. }), "{error}");
    error.to_string().replacen("byte 20: ", "", 1)
}

#[test]
fn values_that_no_world_has_are_refused_by_their_place() {
    let texts = [
        refusal(|c| c.world.settings.step = f64::NAN),
        refusal(|c| c.world.steps = u64::MAX),
        refusal(|c| c.world.epoch.0 = 1001),
        refusal(|c| c.world.epoch.1 = -1.0),
        refusal(|c| c.world.bodies[1].orientation.as_mut_unchecked().coords.x = 2.0),
        refusal(|c| c.world.bodies[1].position.y = f64::INFINITY),
        refusal(|c| c.world.bodies[1].mass = 0.0),
        refusal(|c| c.world.bodies[1].inertia[(0, 1)] = 1.0),
        refusal(|c| c.world.bodies[1].shape = ShapeContent::Plane),
        refusal(|c| c.world.bodies[3].shape = ShapeContent::Sphere { radius: -1.0 }),
        refusal(|c| c.world.bodies[4].phases.swap(0, 1)),
        refusal(|c| c.world.bodies[0].mass = 1.0),
        refusal(|c| c.world.wires[0].material.radius = 0.0),
        refusal(|c| c.world.wires[0].resolution.length = 1e-9),
        refusal(|c| drop(c.world.wires[0].segments.pop())),
        refusal(|c| c.world.wires[0].segments[1].tension_history[4] = f64::NAN),
        refusal(|c| c.world.wires[0].nodes[1].velocity.z = f64::NAN),
        refusal(|c| c.world.wires[0].nodes[1].arc = 20.0),
        refusal(|c| c.world.wires[0].nodes[1].slide = 1.0),
        refusal(|c| c.world.wires[0].nodes[1].remesh_from = 2000),
        refusal(|c| c.world.wires[0].nodes[3].position.x += 1.0),
        refusal(|c| c.world.wires[0].nodes.swap(2, 3)),
        refusal(|c| c.world.warm_start[1].1.x = f64::NAN),
        refusal(|c| c.settings.friction = -1.0),
        refusal(|c| c.settings.guarded_thickness = 1.0),
        refusal(|c| c.memory.made = 1 << 62),
        refusal(|c| c.memory.made = 4),
        refusal(|c| c.memory.between_wires[1].key += 1),
        refusal(|c| c.memory.between_wires[0].normal *= 2.0),
        refusal(|c| c.memory.between_wires[0].sites[1].arc = 31.0),
        refusal(|c| c.memory.between_wires[0].sites[1].wire = WireId(1)),
        refusal(|c| c.memory.with_bodies[0].key = 7),
        refusal(|c| c.memory.with_bodies[0].gap = f64::NAN),
        refusal(|c| c.memory.pushed[0].arc = -1.0),
        refusal(|c| c.memory.placed[2].as_mut().unwrap().0 = -1.0),
        refusal(|c| c.memory.placed[2].as_mut().unwrap().1[1].x = f64::NAN),
        refusal(|c| c.memory.excluded.swap(0, 1)),
        refusal(|c| c.memory.excluded[0].0 = [0, 1]),
        refusal(|c| c.memory.excluded[1].0 = [0, 99]),
        refusal(|c| c.memory.excluded[0].1 = 2e4),
        refusal(|c| c.memory.excluded[0].1 = f64::NAN),
        refusal(|c| c.memory.excluded[0].1 = 0.0),
    ];
    let expected = include_str!("refusals.txt");
    assert_eq!(texts.join("\n") + "\n", expected, "{}", texts.join("\n"));
}

#[test]
fn mesh_that_is_none_is_refused_by_its_place() {
    let state = every_field();
    let mut bytes = plain(&saved(&state));
    let Shape::Mesh(mesh) = state.world.bodies[0].shape() else {
        panic!()
    };
    let triangles = postcard::to_stdvec(mesh.triangles()).unwrap();
    let at = bytes
        .windows(triangles.len())
        .position(|window| window == triangles)
        .unwrap();
    bytes[at + 1] = 9;
    let error = State::load(file_of(&bytes).as_slice()).unwrap_err();
    let text = "byte 20: bodies[0]: triangle 0 has corner 9: vertices are 0 to 4 (excluded)";
    assert_eq!(error.to_string(), text);
}

/// A pair is refused from where the bound on its distance is not proved, to the bit.
#[test]
fn slack_is_refused_from_the_distance_on() {
    let end = |x: f64, z: f64| Point::new(x, 0.0, z);
    let mut content = Content::from(&every_field());
    content.memory.placed = vec![
        Some((0.25, [end(-1.0, 0.0), end(1.0, 0.0)])),
        Some((0.5, [end(0.0, 4.0), end(0.0, 9.0)])),
    ];
    let is_refused = |content: &mut Content, slack: f64| {
        content.memory.excluded = vec![([0, 1], slack)];
        let file = [FORMAT.opening(), FORMAT.pack(content).unwrap()].concat();
        State::load(file.as_slice()).is_err()
    };
    // The sum of the radii is rounded down by half a unit of 1.
    assert!(!is_refused(&mut content, 3.25));
    assert!(is_refused(&mut content, 3.25_f64.next_up()));
    content.settings.mode = ModeContent::Guard;
    assert!(!is_refused(&mut content, 3.0));
}

#[test]
fn history_has_the_length_of_the_layout() {
    assert_eq!(TENSION_HISTORY, 10);
}

/// Bytes that tell of more than there is cost no memory.
#[test]
fn state_takes_no_memory_for_what_is_not_there() {
    let zeros = vec![0; 1 << 26];
    let bomb = compress_to_vec(zeros.as_slice(), CompressionLevel::Fastest);
    let mut many = plain(&saved(&state_after(0)));
    // The number of bodies comes after settings, steps and epoch.
    let content = Content::from(&state_after(0));
    let head = postcard::to_stdvec(&(
        &content.world.settings,
        content.world.steps,
        content.world.epoch,
    ));
    many.truncate(head.unwrap().len());
    many.extend([0xff; 9]);
    many.push(1);
    for tail in [
        labelled(&bomb, 1000, 0),
        labelled(b"", MOST_BYTES, 0),
        labelled(b"", MOST_BYTES + 1, 0),
        forged(&many),
    ] {
        let bad = [FORMAT.opening(), tail].concat();
        let memory = allocation_counter::measure(|| {
            State::load(bad.as_slice()).unwrap_err();
        });
        assert!(memory.bytes_max < 8 << 20, "{} bytes", memory.bytes_max);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// Edits under a checksum that is right again: it is refused, or a state that is saved and
    /// loaded again.
    #[test]
    fn state_of_forged_bytes_is_refused_or_whole(edits in edits(), lived in any::<bool>()) {
        let bytes = if lived { plain_after_two() } else { plain(GOLDEN) };
        let bytes = edited(bytes, edits);
        prop_assert!(holds(&bytes));
    }

    /// The same with single numbers, which checks alone can tell.
    #[test]
    fn state_of_a_forged_number_is_refused_or_whole(
        at in any::<prop::sample::Index>(),
        number in prop_oneof![
            any::<f64>(),
            prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, f64::NAN, f64::INFINITY, 1e-300, 1e300]),
        ],
    ) {
        let mut bytes = plain_after_two();
        let at = at.index(bytes.len() - 8);
        bytes[at..at + 8].copy_from_slice(&number.to_le_bytes());
        prop_assert!(holds(&bytes));
    }
}

/// Whether what is loaded of some bytes, if anything, is whole.
fn holds(bytes: &[u8]) -> bool {
    let Ok(state) = State::load(file_of(bytes).as_slice()) else {
        return true;
    };
    let file = saved(&state);
    State::load(file.as_slice()).map(|state| saved(&state)) == Ok(file)
}

//! Files that are no state, or hardly one.

use proptest::prelude::*;
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

use super::every_field::every_field;
use super::{GOLDEN, file_of, plain, plain_after_two, saved, state_after};
use crate::query::Point;
use crate::wire::file::LABEL;
use crate::wire::file::testing::{edited, edits, forged, labelled};
use crate::wire::model::wire::TENSION_HISTORY;
use crate::wire::state::content::{Content, ModeContent, ShapeContent};
use crate::wire::state::{FORMAT, Fault, Format, MOST_BYTES, State, VERSION};
use crate::wire::{NodeKind, Shape, Vector, WireId};

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
        refusal(|c| c.world.wires[0].segments.truncate(2)),
        refusal(|c| c.world.wires[0].segments[1].tension_history[4] = f64::NAN),
        refusal(|c| c.world.wires[0].nodes[1].velocity.z = f64::NAN),
        refusal(|c| c.world.wires[0].nodes[1].arc = 20.0),
        refusal(|c| c.world.wires[0].nodes[1].slide = 1.0),
        refusal(|c| c.world.wires[0].nodes[1].remesh_from = 2000),
        refusal(|c| c.world.wires[0].nodes[3].position.x += 1.0),
        refusal(|c| c.world.wires[0].nodes.swap(2, 3)),
        refusal(|c| {
            if let NodeKind::Contact { aside, .. } = &mut c.world.wires[0].nodes[2].kind {
                *aside = Some(Vector::zeros());
            }
        }),
        refusal(|c| c.world.wires[0].twist = 1.0),
        refusal(|c| c.world.wires[0].reel.swap(0, 1)),
        refusal(|c| c.world.wires[0].reel[1].speed = f64::NAN),
        refusal(|c| c.world.wires[1].reel = c.world.wires[0].reel.clone()),
        refusal(|c| c.world.wires[1].twist = f64::NEG_INFINITY),
        refusal(|c| c.world.wires[1].material.twist_modulus = 0.0),
        refusal(|c| c.world.wires[1].material.twist_modulus = -1.0),
        refusal(|c| c.world.wires[1].material.twist_damping = f64::NAN),
        refusal(|c| c.world.wires[1].material.bend_modulus = 0.0),
        refusal(|c| c.world.wires[1].nodes[1].position = c.world.wires[1].nodes[0].position),
        refusal(|c| c.world.warm_start[1].1.x = f64::NAN),
        refusal(|c| c.settings.friction = -1.0),
        refusal(|c| c.settings.guarded_thickness = 1.0),
        refusal(|c| c.memory.made = 1 << 62),
        refusal(|c| c.memory.made = 4),
        refusal(|c| c.memory.between_wires[1].key += 1),
        refusal(|c| c.memory.between_wires[0].normal *= 2.0),
        refusal(|c| c.memory.between_wires[0].sites[1].arc = 31.0),
        refusal(|c| c.memory.between_wires[0].sites[1].wire = WireId(2)),
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

use nalgebra::UnitQuaternion;
use proptest::prelude::*;
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

use super::layout::FORMAT;
use super::*;
use crate::query::Point;
use crate::wire::file::LABEL;
use crate::wire::file::testing::{edited, edits, forged, labelled};
use crate::wire::{
    BodyId, BodyPlan, ContactConstraint, ContactSite, Material, Mesh, Settings, Shape, StepRecord,
    Stop, Vector, WirePlan, World,
};

/// A steel wire with a contact node over a fixed mesh, from a tight end to a falling, tumbling box
/// that touches the ground: everything that a record can hold.
fn world() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let half = Vector::new(0.3, 0.4, 0.5);
    let mut plan = BodyPlan::dynamic(Shape::Box { half }, 2000.0, Point::new(4.0, 0.1, 0.45));
    plan.orientation = UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3);
    let body = world.add_body(plan).unwrap();
    let vertices = [
        [0.1, 0.2, 0.3],
        [1.1, 0.2, 0.3],
        [0.1, 1.2, 0.3],
        [0.1, 0.2, 1.3],
    ];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mesh = Mesh::new(vertices.map(Point::from).to_vec(), triangles).unwrap();
    let fixed = BodyPlan::fixed(Shape::Mesh(mesh), Point::new(2.0, 0.0, 2.0));
    let saddle = world.add_body(fixed).unwrap();
    let over = Stop::Contact {
        body: saddle,
        local: Vector::new(0.0, 0.0, 0.3),
        normal: Vector::z(),
        friction: 0.1,
    };
    let local = Vector::new(-0.3, 0.0, 0.5);
    let top = Stop::Pinned(Point::new(0.0, 0.0, 1.0));
    let route = vec![top, over, Stop::Eye { body, local }];
    let plan = WirePlan::new(Material::steel(0.01), 0.25, route).adaptive();
    world.add_wire(&plan).unwrap();
    world
}

fn ground(world: &World) -> Vec<ContactConstraint> {
    let body = BodyId(0);
    let local = Vector::new(0.3, 0.4, -0.5);
    let gap = world.bodies()[0].point(&local).z;
    let contact = ContactConstraint {
        key: u64::MAX,
        a: ContactSite::Body { body, local },
        b: ContactSite::World,
        normal: Vector::z(),
        gap,
        friction: 0.5,
    };
    vec![contact]
}

/// A recording and what it was made from.
fn recorded(steps: usize) -> (Vec<u8>, World, Vec<StepRecord>) {
    let mut world = world();
    let mut recorder = Recorder::new(Vec::new(), &world).unwrap();
    let step = |_| {
        let record = world.step(&ground(&world)).unwrap();
        recorder.record(&record).unwrap();
        record
    };
    let records = (0..steps).map(step).collect();
    (recorder.into_inner(), world, records)
}

/// Where the header and each step start, and the end.
fn starts(file: &[u8]) -> Vec<usize> {
    let mut starts = vec![LABEL];
    while let Some(&at) = starts.last().filter(|&&at| at < file.len()) {
        let packed = u32::from_le_bytes(file[at + 8..at + 12].try_into().unwrap());
        starts.push(at + LABEL + packed as usize);
    }
    starts
}

/// The steps that a file holds, and how it goes on after them.
fn read_all(file: &[u8]) -> (Vec<StepRecord>, Option<ReadError>) {
    let recording = match Recording::open(file) {
        Ok(recording) => recording,
        Err(error) => return (Vec::new(), Some(error)),
    };
    let mut steps = Vec::new();
    let mut end = None;
    for step in recording {
        assert!(end.is_none(), "more after an error");
        match step {
            Ok(step) => steps.push(step),
            Err(error) => end = Some(error),
        }
    }
    (steps, end)
}

fn bits(record: &StepRecord) -> Vec<u8> {
    postcard::to_stdvec(record).unwrap()
}

#[test]
fn recording_reads_back_bit_for_bit() {
    let (file, world, records) = recorded(60);
    // Every part of a record is there.
    assert!(records.iter().any(|r| !r.slides.is_empty()));
    assert!(records.iter().any(|r| !r.remeshes.is_empty()));
    let presses = |r: &StepRecord| r.contacts[0].normal_force() > 0.0;
    assert!(records.iter().any(presses));

    let recording = Recording::open(file.as_slice()).unwrap();
    let header = recording.header().clone();
    assert_eq!(header, Header::from(&world));
    let bytes = postcard::to_stdvec(&header).unwrap();
    assert_eq!(bytes, postcard::to_stdvec(&Header::from(&world)).unwrap());
    let (steps, end) = read_all(&file);
    assert_eq!((steps.len(), end), (60, None));
    for (read, record) in steps.iter().zip(&records) {
        assert_eq!(read, record);
        assert_eq!(bits(read), bits(record));
    }
}

#[test]
fn recording_keeps_the_bits_of_what_is_no_number() {
    let (mut file, _, _) = recorded(0);
    let odd = [
        f64::NAN,
        -f64::NAN,
        f64::from_bits(0x7ff0_0000_0000_0001),
        f64::INFINITY,
        -0.0,
        5e-324,
    ];
    let mut record = StepRecord {
        step: u64::MAX,
        ..StepRecord::default()
    };
    record.wires.resize_with(1, Default::default);
    record.wires[0].tensions = odd.to_vec();
    file.extend(FORMAT.pack(&record).unwrap());
    let (steps, end) = read_all(&file);
    assert_eq!(end, None);
    let read = steps[0].wires[0].tensions.iter().map(|t| t.to_bits());
    assert!(read.eq(odd.map(f64::to_bits)));
    assert_eq!(steps[0].step, u64::MAX);
}

#[test]
fn recording_reads_up_to_the_last_whole_step_wherever_it_is_cut() {
    let (file, _, records) = recorded(4);
    let starts = starts(&file);
    for cut in 0..file.len() {
        let (steps, end) = read_all(&file[..cut]);
        let whole = starts.iter().filter(|&&start| start <= cut).count();
        assert_eq!(steps, records[..whole.saturating_sub(2)], "cut at {cut}");
        let between_steps = whole >= 2 && starts[whole - 1] == cut;
        let expected = (!between_steps).then(|| ReadError {
            offset: if whole == 0 {
                0
            } else {
                starts[whole - 1] as u64
            },
            fault: Fault::Cut,
        });
        assert_eq!(end, expected, "cut at {cut}");
    }
}

#[test]
fn recording_never_reads_back_anything_else_when_a_byte_is_wrong() {
    let (file, world, records) = recorded(2);
    let header = Header::from(&world);
    let starts = starts(&file);
    let mut found = 0;
    for at in 0..file.len() {
        for flip in [0x01, 0x80, 0xff] {
            let mut bad = file.clone();
            bad[at] ^= flip;
            let part = starts.iter().filter(|&&start| start <= at).count();
            match Recording::open(bad.as_slice()) {
                Ok(recording) => {
                    assert_eq!(recording.header(), &header, "byte {at}");
                    let (steps, end) = read_all(&bad);
                    assert_eq!(steps, records[..steps.len()], "byte {at}");
                    // What comes before the byte is there, and the error tells of the part with the
                    // byte.
                    if let Some(error) = end {
                        assert_eq!(
                            error.offset as usize,
                            starts[part - 1],
                            "byte {at}: {error}"
                        );
                        assert_eq!(steps.len(), part - 2, "byte {at}: {error}");
                        found += 1;
                    } else {
                        assert_eq!(steps.len(), 2, "byte {at}");
                    }
                }
                Err(error) => {
                    let start = if part == 0 { 0 } else { starts[0] };
                    assert_eq!(error.offset as usize, start, "byte {at}: {error}");
                    found += 1;
                }
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
fn recording_names_what_is_wrong_and_where() {
    let (file, _, _) = recorded(1);
    let end = file.len();
    let with = |tail: Vec<u8>| {
        let bad = [file.clone(), tail].concat();
        read_all(&bad).1.unwrap()
    };
    let fault = |tail: Vec<u8>| {
        let error = with(tail);
        assert_eq!(error.offset as usize, end);
        error.fault
    };
    assert_eq!(fault(b"twenty bytes of text".to_vec()), Fault::Label);
    let too_long = Fault::TooLong {
        length: u32::MAX,
        most_bytes: MOST_BYTES,
    };
    assert_eq!(fault(labelled(b"", u32::MAX, 0)), too_long);
    assert!(matches!(
        fault(labelled(b"no zstd frame", 3, 0)),
        Fault::Packing(_)
    ));
    let packed = compress_to_vec(&b"abc"[..], CompressionLevel::Fastest);
    let (expected, found) = (7, crc32fast::hash(b"abc"));
    let wrong = Fault::Checksum { expected, found };
    assert_eq!(fault(labelled(&packed, 3, 7)), wrong);
    let wrong = |expected, found| Fault::Length { expected, found };
    assert_eq!(fault(labelled(&packed, 2, found)), wrong(2, 3));
    assert_eq!(fault(labelled(&packed, 9, found)), wrong(9, 3));
    let longer = [packed, vec![0]].concat();
    assert!(matches!(
        fault(labelled(&longer, 3, found)),
        Fault::Packing(_)
    ));
    assert!(matches!(fault(forged(b"abc")), Fault::Content(_)));
    let long = [bits(&StepRecord::default()), vec![0]].concat();
    assert_eq!(
        fault(forged(&long)),
        Fault::Content("1 bytes are left".into())
    );
    let text = with(b"twenty bytes of text".to_vec()).to_string();
    assert_eq!(text, format!("byte {end}: no part of the file starts here"));

    let mut other = file.clone();
    other[16] = 1;
    let (found, known) = (1, VERSION);
    let version = Fault::Version { found, known };
    assert_eq!(read_all(&other).1.unwrap().fault, version);
    let opening = Fault::Opening("recording of steps");
    assert_eq!(read_all(b"something else").1.unwrap().fault, opening);
}

#[test]
fn recording_refuses_a_mesh_that_is_none() {
    let world = world();
    let mut header = postcard::to_stdvec(&Header::from(&world)).unwrap();
    let Shape::Mesh(mesh) = world.bodies()[1].shape() else {
        panic!()
    };
    let mesh = postcard::to_stdvec(mesh.triangles()).unwrap();
    let at = header
        .windows(mesh.len())
        .position(|bytes| bytes == mesh)
        .unwrap();
    header[at + 1] = 9;
    let file = [&recorded(0).0[..LABEL], &forged(&header)].concat();
    let error = Recording::open(file.as_slice()).unwrap_err();
    assert!(matches!(error.fault, Fault::Content(_)), "{error}");
}

/// Bytes that tell of more than there is cost no memory.
#[test]
fn recording_takes_no_memory_for_what_is_not_there() {
    let (file, _, _) = recorded(0);
    let zeros = vec![0; 1 << 26];
    let bomb = compress_to_vec(zeros.as_slice(), CompressionLevel::Fastest);
    // The longest number of wires; a window of 2^41 bytes.
    let wires = b"\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff\xff\x01";
    let window = b"\x28\xb5\x2f\xfd\0\xf8\x01\0\0";
    let tails = [
        labelled(&bomb, 1000, 0),
        forged(wires),
        labelled(window, 0, 0),
        labelled(b"", MOST_BYTES, 0),
        b"\x5d\x2a\x4d\x18\x0c\0\0\0\0\0\0\x02\0\0\0\x02\0\0\0\0".to_vec(),
    ];
    for tail in tails {
        let bad = [file.clone(), tail].concat();
        let memory = allocation_counter::measure(|| assert!(read_all(&bad).1.is_some()));
        assert!(memory.bytes_max < 8 << 20, "{} bytes", memory.bytes_max);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Edits anywhere; every step that is read is one of those written, in their order.
    #[test]
    fn recording_of_edited_bytes_gives_steps_that_were_written(edits in edits()) {
        let (file, _, records) = recorded(2);
        let (steps, _) = read_all(&edited(file, edits));
        for (step, record) in steps.iter().zip(&records) {
            prop_assert_eq!(step, record);
        }
    }

    /// Edits under a checksum that is right again: whatever is read, nothing panics, and memory
    /// stays in proportion.
    #[test]
    fn recording_of_forged_bytes_ends_in_proportion(edits in edits(), packed in any::<bool>()) {
        let (file, _, records) = recorded(1);
        let plain = bits(&records[0]);
        let tail = if packed {
            let frame = compress_to_vec(plain.as_slice(), CompressionLevel::Fastest);
            labelled(&edited(frame, edits), plain.len() as u32, crc32fast::hash(&plain))
        } else {
            forged(&edited(plain, edits))
        };
        let bad = [file, tail].concat();
        let memory = allocation_counter::measure(|| drop(read_all(&bad)));
        prop_assert!(memory.bytes_max < 8 << 20, "{} bytes", memory.bytes_max);
    }
}

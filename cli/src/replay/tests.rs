use crate::scenes::Scene;
use tunnelproof::wire::{Collisions, ContactSite, WireId};

use super::*;

fn records(scene: &Scene, steps: usize) -> (Header, Vec<StepRecord>) {
    let mut world = scene.world().unwrap();
    let mut collisions = Collisions::default();
    let header = Header::from(&world);
    let step = |_| world.step_colliding(&mut collisions, &[]).unwrap();
    (header, (0..steps).map(step).collect())
}

fn basic_collision() -> Scene {
    Scene::embedded("basic-collision").unwrap()
}

#[test]
fn replay_has_a_frame_for_the_start_and_for_every_step() {
    let (header, records) = records(&basic_collision(), 3);
    let replay = Replay::new("a </script> & b", header, 3);
    assert_eq!(replay.names.wires, ["wire 0", "wire 1", "wire 2"]);
    let mut replay = replay.named_as_in(&basic_collision());
    assert_eq!(replay.names.wires, ["left", "right", "falling"]);
    records.iter().for_each(|record| replay.step(record));
    assert_eq!(replay.frames.len(), 4);
    assert_eq!(replay.frames[0].time, 0.0);
    assert_eq!(replay.frames[0].wires[2][2], 0.1);
    assert_eq!(replay.frames[0].kinds[0], "pfffffffp");
    let mark = replay.frames[1].marks[0];
    assert_eq!(mark.what, "prevented");
    // The falling wire is held where it meets one of the others.
    let [x, y, z] = mark.at.unwrap();
    assert!((x.abs() - 0.5).abs() < 0.05 && y.abs() < 0.05 && z.abs() < 0.05);
    assert!(!replay.frames[2].contacts.is_empty());
    let page = page(&[replay]).unwrap();
    // The run, the libraries and the three parts of the page: nothing in them ends a script.
    assert_eq!(page.matches("</script>").count(), 5);
    assert!(!page.contains("http-equiv") && !page.contains("src="));
}

#[test]
fn replay_without_a_step_shows_the_start_and_why_it_stopped() {
    let scene = basic_collision();
    let (header, records) = records(&scene, 1);
    let empty = || Replay::new("empty", header.clone(), 1);
    let nothing = page(&[empty()]).unwrap();
    assert!(nothing.contains("the recording has no step"), "{nothing}");
    let summary = Summary {
        stopped: Some("step 0: too fast".to_owned()),
        ..Summary::default()
    };
    let replay = empty().ended(&scene.world().unwrap(), &summary);
    // As a run starts that goes on.
    let mut stepped = empty();
    stepped.step(&records[0]);
    assert_eq!(replay.frames.len(), 1);
    let (start, expected) = (&replay.frames[0], &stepped.frames[0]);
    assert_eq!((start.time, start.step), (expected.time, expected.step));
    assert_eq!(start.wires, expected.wires);
    assert_eq!(start.kinds, expected.kinds);
    assert_eq!(start.bodies, expected.bodies);
    let runs = [replay];
    let (page, drawing) = (page(&runs).unwrap(), Drawing::new(&runs));
    let words = "stopped: step 0: too fast";
    assert!(page.contains(words) && drawing.frame(0).contains(words));
}

#[test]
fn replay_of_a_long_run_keeps_every_event() {
    let (header, records) = records(&basic_collision(), 4);
    let prevented: usize = records
        .iter()
        .map(|record| record.collisions.crossings.len())
        .sum();
    let mut replay = Replay::new("long", header, 2 * MOST_FRAMES);
    records.iter().for_each(|record| replay.step(record));
    assert_eq!(replay.frames.len(), 3);
    let shown = replay.frames.iter().map(|frame| frame.marks.len());
    assert_eq!(shown.sum::<usize>(), prevented);
}

#[test]
fn replay_places_contacts_by_arc_length() {
    let (_, records) = records(&basic_collision(), 1);
    let arc = 1.125;
    let wire = WireId(0);
    let at = place(&records[0], &ContactSite::Wire { wire, arc }).unwrap();
    let after = &records[0].wires[0].after;
    assert!((at - nalgebra::center(&after[4], &after[5])).norm() < 1e-12);
}

#[test]
fn every_mark_has_its_colour_and_words() {
    let (header, records) = records(&basic_collision(), 2);
    let mut replay = Replay::new("marks", header, 2);
    records.iter().for_each(|record| replay.step(record));
    for mark in replay.frames.iter().flat_map(|frame| &frame.marks) {
        assert!(frame::MARKS.iter().any(|kind| kind.what == mark.what));
    }
}

#[test]
fn drawing_is_xml_with_every_segment_of_both_runs_in_its_picture() {
    let (header, records) = records(&basic_collision(), 3);
    let mut replay = Replay::new("a < b & c", header.clone(), 3);
    records.iter().for_each(|record| replay.step(record));
    let shorter = {
        let mut replay = Replay::new("shorter", header, 3);
        replay.step(&records[0]);
        replay.called("one step")
    };
    let runs = [replay, shorter];
    let drawing = Drawing::new(&runs);
    assert_eq!(drawing.frames(), 4);
    let picture = drawing.frame(3);
    let document = roxmltree::Document::parse(&picture).unwrap();
    let named = |name: &str| -> Vec<_> {
        let all = document.descendants();
        all.filter(|node| node.tag_name().name() == name).collect()
    };
    let segments = |record: &StepRecord| -> usize {
        let wires = record.wires.iter();
        wires.map(|wire| wire.after.len() - 1).sum()
    };
    let lines = named("line");
    assert_eq!(lines.len(), segments(&records[2]) + segments(&records[0]));
    for line in lines {
        let number = |name| line.attribute(name).unwrap().parse::<f64>().unwrap();
        assert!((0.0..=1280.0).contains(&number("x1")) && (0.0..=720.0).contains(&number("y2")));
    }
    let texts = named("text");
    assert!(texts.iter().any(|text| text.text() == Some("a < b & c")));
}

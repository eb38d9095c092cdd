use crate::scenes::Scene;
use tunnelproof::wire::{Collisions, WireId};

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
    assert!(replay.frames[1].events["prevented"] > 0);
    assert!(!replay.frames[2].contacts.is_empty());
    let page = replay.page(None).unwrap();
    // The run, the libraries and the page itself: nothing in them ends a script.
    assert_eq!(page.matches("</script>").count(), 3);
    assert!(!page.contains("http-equiv") && !page.contains("src="));
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
    let shown = replay
        .frames
        .iter()
        .filter_map(|frame| frame.events.get("prevented"));
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

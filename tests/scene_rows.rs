//! The scenes of the thesis (4.2) in guard mode: what comes out beside what the thesis says of it.
//!
//! `cargo test --release --features scenes --test scene_rows -- --nocapture` prints the table.

#![cfg(feature = "scenes")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::f64::consts::PI;

use tunnelproof::scenario::scenes::Scene;
use tunnelproof::wire::{
    BodyId, Collisions, ContactRecord, Outcome, Place, StepRecord, WireId, World,
};

/// What the thesis says, what comes out, and how far they may be apart.
struct Row {
    what: &'static str,
    thesis: f64,
    ours: f64,
    within: f64,
}

impl Row {
    fn holds(&self) -> bool {
        (self.ours - self.thesis).abs() <= self.within
    }
}

/// Prints the rows of a scene, all of which must hold.
fn judge(scene: &str, rows: &[Row]) {
    for row in rows {
        let verdict = if row.holds() { "holds" } else { "differs" };
        println!(
            "{scene}: {}: thesis {:.2}, ours {:.2}, within {:.2}: {verdict}",
            row.what, row.thesis, row.ours, row.within
        );
    }
    let differ = rows.iter().filter(|row| !row.holds());
    let differ: Vec<&str> = differ.map(|row| row.what).collect();
    assert!(differ.is_empty(), "{scene}: {differ:?}");
}

/// Runs a scene of the thesis. No motion is made in which midlines meet.
fn run(name: &str, mut look: impl FnMut(&World, &StepRecord)) {
    let scene = Scene::embedded(name).unwrap();
    let mut world = scene.world().unwrap();
    let mut collisions = Collisions::default();
    for _ in 0..scene.steps() {
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        let crossings = record.collisions.crossings.iter();
        assert!(
            crossings
                .map(|c| c.outcome)
                .all(|o| o == Outcome::Prevented)
        );
        look(&world, &record);
    }
}

/// Contacts that push, by what they are between.
fn pushing<T>(record: &StepRecord, between: impl Fn(&Place, &Place) -> Option<T>) -> Vec<T> {
    let pushing = |contact: &&ContactRecord| contact.normal_force() > 0.0;
    let contacts = record.contacts.iter().filter(pushing);
    contacts
        .filter_map(|record| between(&record.contact.a, &record.contact.b))
        .collect()
}

/// The arc lengths at which two wires push on each other.
fn between_wires(a: &Place, b: &Place) -> Option<[f64; 2]> {
    match (*a, *b) {
        (Place::Wire { arc, .. }, Place::Wire { arc: other, .. }) => Some([arc, other]),
        _ => None,
    }
}

/// How often a place that had stayed within 5 cm for half a second goes more than half a metre in the next half.
fn slips(places: &[(f64, f64)]) -> usize {
    let mut count = 0;
    let mut after = 0.0;
    for &(time, place) in places {
        let before = places.iter().filter(|(t, _)| *t < time && *t >= time - 0.5);
        let stuck =
            before.clone().count() > 20 && before.clone().all(|(_, p)| (place - p).abs() < 0.05);
        let mut later = places.iter().filter(|(t, _)| *t > time && *t <= time + 0.5);
        if time > after && stuck && later.any(|(_, p)| p - place > 0.5) {
            count += 1;
            after = time + 0.5;
        }
    }
    count
}

#[test]
fn pulling_anchor_collides_slips_and_catches_the_cylinder() {
    let (mut places, mut caught) = (Vec::new(), None);
    run("pulling-anchor", |_, record| {
        let arcs = pushing(record, between_wires);
        places.extend(arcs.first().map(|arcs| (record.time, arcs[0])));
        let pulled_on_cylinder = pushing(record, |a, b| match (*a, *b) {
            (Place::Wire { wire, .. }, Place::Body { body, .. }) => {
                Some((wire, body)).filter(|pair| *pair == (WireId(1), BodyId(0)))
            }
            _ => None,
        });
        let at_its_end = arcs.iter().any(|arcs| arcs[0] > 24.5);
        if at_its_end && !pulled_on_cylinder.is_empty() {
            caught = caught.or(Some(record.time));
        }
    });
    let rows = [
        Row {
            what: "the wires collide, s",
            thesis: 8.85,
            ours: places[0].0,
            within: 0.5,
        },
        Row {
            what: "slips",
            thesis: 2.0,
            ours: slips(&places) as f64,
            within: 1.0,
        },
        Row {
            what: "the cylinder is caught between the wires, s",
            thesis: 31.6,
            ours: caught.unwrap_or(f64::INFINITY),
            within: 1.5,
        },
    ];
    judge("pulling-anchor", &rows);
}

#[test]
fn twisting_under_load_winds_its_wires_up() {
    let (mut first, mut speed, mut turns) = (None, 0.0, 0.0);
    run("twisting-under-load", |world, record| {
        if !pushing(record, between_wires).is_empty() {
            first = first.or(Some(record.time));
        }
        let spin = world.bodies()[1].angular_velocity().z;
        if record.time <= 0.55 + 1e-9 {
            turns += spin * world.settings().step / (2.0 * PI);
        }
        if record.time <= 2.1 + 1e-9 {
            speed = spin / PI;
        }
    });
    let rows = [
        Row {
            what: "the wires touch after 0.2 s and by 0.55 s",
            thesis: 0.375,
            ours: first.unwrap_or(f64::INFINITY),
            within: 0.175,
        },
        Row {
            what: "almost a full turn by 0.55 s",
            thesis: 0.9,
            ours: turns,
            within: 0.1,
        },
        Row {
            what: "speed at 2.1 s, pi rad/s",
            thesis: 2.83,
            ours: speed,
            within: 0.3,
        },
    ];
    judge("twisting-under-load", &rows);
}

#[test]
fn chains_on_deck_meet_and_are_pulled_twice() {
    let (mut first, mut near, mut tensions) = (None, None, Vec::new());
    run("chains-on-deck", |_, record| {
        let arcs = pushing(record, between_wires);
        if !arcs.is_empty() {
            first = first.or(Some(record.time));
        }
        // Where the chains hang down from their boxes.
        if arcs.iter().any(|[a, b]| a.max(*b) < 0.9) {
            near = near.or(Some(record.time));
        }
        let all = record.wires[1].tensions.iter();
        tensions.push((record.time, all.fold(0.0, |a: f64, b| a.max(*b))));
    });
    let largest = |[from, to]: [f64; 2]| {
        let inside = tensions
            .iter()
            .filter(|(time, _)| *time > from && *time <= to);
        inside.fold(0.0, |a: f64, (_, tension)| a.max(*tension))
    };
    const FIRST_PULL: [f64; 2] = [4.2, 5.0];
    const SECOND_PULL: [f64; 2] = [7.0, 8.3];
    let slack = |what, during: [f64; 2], pull: [f64; 2]| Row {
        what,
        thesis: 0.0,
        ours: largest(during) / largest(pull),
        within: 0.1,
    };
    let rows = [
        Row {
            what: "the chains touch, s",
            thesis: 2.1,
            ours: first.unwrap_or(f64::INFINITY),
            within: 0.5,
        },
        Row {
            what: "the chains touch near both boxes, s",
            thesis: 3.08,
            ours: near.unwrap_or(f64::INFINITY),
            within: 0.3,
        },
        slack(
            "tension before 3 s, of that from 4.2 s to 5 s",
            [1.0, 3.0],
            FIRST_PULL,
        ),
        slack(
            "tension from 5.3 s to 6.5 s, of that from 4.2 s to 5 s",
            [5.3, 6.5],
            FIRST_PULL,
        ),
        slack(
            "tension from 5.3 s to 6.5 s, of that from 7 s to 8.3 s",
            [5.3, 6.5],
            SECOND_PULL,
        ),
        slack(
            "tension after the halt, of that from 7 s to 8.3 s",
            [8.6, 9.0],
            SECOND_PULL,
        ),
    ];
    judge("chains-on-deck", &rows);
}

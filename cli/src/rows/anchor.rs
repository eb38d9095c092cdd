//! Scene 2: a pulled wire catches another one on which a cylinder hangs.

use super::{First, Row, Rows, SceneRows, between_wires, pushing, run_guarded};
use tunnelproof::wire::{BodyId, ContactSite, WireId};

pub(super) const ROWS: SceneRows = SceneRows {
    scene: NAME,
    run: rows,
};

const NAME: &str = "pulling-anchor";

fn rows() -> Rows {
    let (mut collided, mut caught) = (First::never(), First::never());
    let mut places = Vec::new();
    let crossed = run_guarded(NAME, |_, record| {
        let arcs = pushing(record, between_wires);
        if let Some(arcs) = arcs.first() {
            collided.note(record);
            places.push((record.time, arcs[0]));
        }
        let pulled_on_cylinder = |a: &ContactSite, b: &ContactSite| match (*a, *b) {
            (ContactSite::Wire { wire, .. }, ContactSite::Body { body, .. }) => {
                Some((wire, body)).filter(|pair| *pair == (WireId(1), BodyId(0)))
            }
            _ => None,
        };
        let at_its_end = arcs.iter().any(|arcs| arcs[0] > 24.5);
        if at_its_end && !pushing(record, pulled_on_cylinder).is_empty() {
            caught.note(record);
        }
    })?;
    let slips = slips(&places) as f64;
    Ok(vec![
        crossed,
        Row::near("the wires collide, s", 8.85, collided.0, 0.5),
        Row::near("slips", 2.0, slips, 1.0),
        Row::near(
            "the cylinder is caught between the wires, s",
            31.6,
            caught.0,
            1.5,
        ),
    ])
}

/// How often a place that had stayed within 5 cm for half a second goes more than half a metre in
/// the next half.
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

//! Scene 2: a pulled wire catches another one on which a cylinder hangs.

use std::error::Error;

use super::{
    First, Row, Rows, SceneRows, between_wires, from_starts, median, pushing, run_guarded,
};
use crate::scenes::Scene;
use tunnelproof::wire::{BodyId, ContactSite, WireId};

pub(super) const ROWS: SceneRows = SceneRows {
    scene: NAME,
    run: rows,
};

const NAME: &str = "pulling-anchor";

/// From how many starts the end of the scene is looked at. Whether the cylinder is caught hangs on
/// the last millimetre: the sharp turn of a wire over another one holds, or lets go.
const STARTS: u64 = 16;

fn rows() -> Rows {
    let (crossed, starts) = from_starts(&Scene::embedded(NAME)?, STARTS, Outcome::of)?;
    let caught = starts.iter().map(|start| start.caught);
    let caught: Vec<f64> = caught.filter(|time| !time.is_nan()).collect();
    let first = &starts[0];
    let slips = slips(&first.places) as f64;
    Ok(vec![
        crossed,
        Row::near("the wires collide, s", 8.85, first.collided, 0.5),
        Row::near("slips", 2.0, slips, 1.0),
        Row::between(
            "starts of 16 from which the cylinder is caught",
            "caught",
            caught.len() as f64,
            [4.0, 16.0],
        ),
        Row::near("median of when it is caught, s", 31.6, median(caught), 1.5),
    ])
}

/// What happens from one start.
struct Outcome {
    /// When the wires collide, in s.
    collided: f64,
    /// When the cylinder is caught between them, in s; NaN if it is not.
    caught: f64,
    /// Times and places at which they push on each other.
    places: Vec<(f64, f64)>,
}

impl Outcome {
    fn of(scene: &Scene) -> Result<(Row, Self), Box<dyn Error>> {
        let (mut collided, mut caught) = (First::never(), First::never());
        let mut places = Vec::new();
        let crossed = run_guarded(scene, |_, record| {
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
        let outcome = Outcome {
            collided: collided.0,
            caught: caught.0,
            places,
        };
        Ok((crossed, outcome))
    }
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

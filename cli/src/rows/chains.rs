//! Scene 4: a box drags its chain across another one on a deck.

use super::{First, Row, Rows, SceneRows, between_wires, pushing, run_guarded};
use crate::scenes::Scene;

pub(super) const ROWS: SceneRows = SceneRows {
    scene: NAME,
    run: rows,
};

const NAME: &str = "chains-on-deck";

/// When the brown box pulls its chain taut, in s.
const FIRST_PULL: [f64; 2] = [4.2, 5.0];
/// A pull of a few steps.
const SECOND_PULL: [f64; 2] = [7.0, 8.3];
/// Between them, when links slide over each other: single steps have up to a tenth of the first pull.
const RELEASED: [f64; 2] = [5.3, 6.5];

fn rows() -> Rows {
    let (mut touched, mut near) = (First::never(), First::never());
    let mut tensions = Vec::new();
    let crossed = run_guarded(&Scene::embedded(NAME)?, |_, record| {
        let arcs = pushing(record, between_wires);
        if !arcs.is_empty() {
            touched.note(record);
        }
        // Where the chains hang down from their boxes.
        if arcs.iter().any(|[a, b]| a.max(*b) < 0.9) {
            near.note(record);
        }
        let all = record.wires[1].tensions.iter();
        tensions.push((record.time, all.fold(0.0, |a: f64, b| a.max(*b))));
    })?;
    let during = |[from, to]: [f64; 2]| {
        let inside = move |(time, _): &&(f64, f64)| *time > from && *time <= to;
        tensions.iter().filter(inside).map(|(_, tension)| *tension)
    };
    let mean = |span| during(span).sum::<f64>() / during(span).count() as f64;
    let largest = |span| during(span).fold(0.0, f64::max);
    let slack = |what, thesis, ratio| Row::between(what, thesis, ratio, [0.0, 0.1]);
    Ok(vec![
        crossed,
        Row::near("the chains touch, s", 2.1, touched.0, 0.5),
        Row::near("the chains touch near both boxes, s", 3.08, near.0, 0.3),
        slack(
            "mean tension from 1 s to 3 s, of that from 4.2 s to 5 s",
            "not yet taut",
            mean([1.0, 3.0]) / mean(FIRST_PULL),
        ),
        slack(
            "mean tension from 5.3 s to 6.5 s, of that from 4.2 s to 5 s",
            "released",
            mean(RELEASED) / mean(FIRST_PULL),
        ),
        slack(
            "largest tension from 5.3 s to 6.5 s, of that from 7 s to 8.3 s",
            "released, then new",
            largest(RELEASED) / largest(SECOND_PULL),
        ),
        slack(
            "largest tension after the halt, of that from 7 s to 8.3 s",
            "released",
            largest([8.6, 9.0]) / largest(SECOND_PULL),
        ),
    ])
}

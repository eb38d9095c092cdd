//! Scene 3: a load turns on four wires, which twist about each other.

use std::f64::consts::PI;

use super::{First, Row, Rows, SceneRows, between_wires, pushing, run_guarded};
use crate::scenes::Scene;

pub(super) const ROWS: SceneRows = SceneRows {
    scene: NAME,
    run: rows,
};

const NAME: &str = "twisting-under-load";

/// Times are sums of steps.
const ROUNDING: f64 = 1e-9;

fn rows() -> Rows {
    let (mut touched, mut speed, mut turns) = (First::never(), 0.0, 0.0);
    let crossed = run_guarded(&Scene::embedded(NAME)?, |world, record| {
        if !pushing(record, between_wires).is_empty() {
            touched.note(record);
        }
        let spin = world.bodies()[1].angular_velocity().z;
        if record.time <= 0.55 + ROUNDING {
            turns += spin * world.settings().step / (2.0 * PI);
        }
        if record.time <= 2.1 + ROUNDING {
            speed = spin / PI;
        }
    })?;
    Ok(vec![
        crossed,
        Row::between("the wires touch, s", "0.2 to 0.55", touched.0, [0.2, 0.55]),
        Row::between("turns by 0.55 s", "almost 1", turns, [0.8, 1.0]),
        Row::near("speed at 2.1 s, pi rad/s", 2.83, speed, 0.3),
    ])
}

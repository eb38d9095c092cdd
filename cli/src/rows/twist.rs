//! Scene 3: a load turns on four wires, which twist about each other.

use std::error::Error;
use std::f64::consts::PI;

use super::{
    First, Row, Rows, SceneRows, between_wires, from_starts, median, pushing, run_guarded,
};
use crate::scenes::Scene;

pub(super) const ROWS: SceneRows = SceneRows {
    scene: NAME,
    run: rows,
};

const NAME: &str = "twisting-under-load";

/// Times are sums of steps.
const ROUNDING: f64 = 1e-9;

/// From how many starts the speed is looked at: it is not the same by some hundredths.
const STARTS: u64 = 8;

fn rows() -> Rows {
    let (crossed, starts) = from_starts(&Scene::embedded(NAME)?, STARTS, Outcome::of)?;
    let first = &starts[0];
    let speed = median(starts.iter().map(|start| start.speed).collect());
    let what = "median of 8 starts of the speed at 2.1 s, pi rad/s";
    Ok(vec![
        crossed,
        Row::between(
            "the wires touch, s",
            "0.2 to 0.55",
            first.touched,
            [0.2, 0.55],
        ),
        Row::between("turns by 0.55 s", "almost 1", first.turns, [0.8, 1.0]),
        Row::near(what, 2.83, speed, 0.3),
    ])
}

/// What happens from one start.
struct Outcome {
    /// When the wires touch, in s.
    touched: f64,
    /// Turns of the load by 0.55 s.
    turns: f64,
    /// How fast it turns at 2.1 s, in pi rad/s.
    speed: f64,
}

impl Outcome {
    fn of(scene: &Scene) -> Result<(Row, Self), Box<dyn Error>> {
        let (mut touched, mut speed, mut turns) = (First::never(), 0.0, 0.0);
        let crossed = run_guarded(scene, |world, record| {
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
        let outcome = Outcome {
            touched: touched.0,
            turns,
            speed,
        };
        Ok((crossed, outcome))
    }
}

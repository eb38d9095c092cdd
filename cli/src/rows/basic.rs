//! Scene 1: a wire that falls through two others within a step, or on them.

use super::{Row, Rows, SceneRows, outcomes, run, run_guarded};
use crate::scenes::Scene;
use tunnelproof::wire::{CrossingOutcome, Mode, Vector, World};

pub(super) const ROWS: SceneRows = SceneRows {
    scene: NAME,
    run: rows,
};

const NAME: &str = "basic-collision";

/// Of the falling wire, in N.
const WEIGHT: f64 = 193.48;

fn rows() -> Rows {
    let (mut tunnels, mut returns, mut thesis) = (0, 0, Rest::default());
    run(&Scene::embedded(NAME)?, Mode::Thesis, |world, record| {
        let count = |outcome| outcomes(record).filter(|other| *other == outcome).count();
        tunnels += count(CrossingOutcome::Tunnelled);
        returns += count(CrossingOutcome::Returned);
        thesis = Rest::of(world);
    })?;
    let (mut force, mut held, mut guard) = (Vector::zeros(), 0, Rest::default());
    let crossed = run_guarded(&Scene::embedded(NAME)?, |world, record| {
        // B of each contact is the falling wire, which was added last.
        force = record.contacts.iter().map(|contact| -contact.force).sum();
        held += record.collisions.scaled_islands.len();
        guard = Rest::of(world);
    })?;
    let rests = "rests on both";
    let above = [0.03, f64::INFINITY];
    let slow = [0.0, 0.05];
    Ok(vec![
        Row::near("thesis mode: tunnels", 2.0, tunnels as f64, 0.0),
        Row::near("thesis mode: returns", 2.0, returns as f64, 0.0),
        Row::between(
            "thesis mode: above both at 5 s, m",
            rests,
            thesis.height,
            above,
        ),
        Row::between("thesis mode: speed at 5 s, m/s", rests, thesis.speed, slow),
        crossed,
        Row::near("motions held", 0.0, held as f64, 0.0),
        Row::between("above both at 5 s, m", rests, guard.height, above),
        Row::between("speed at 5 s, m/s", rests, guard.speed, slow),
        Row::near("sum of normals at 5 s, N", WEIGHT, force.z, 0.01 * WEIGHT),
    ])
}

/// How the falling wire rests.
#[derive(Default)]
struct Rest {
    /// Of its lowest node where the others are, in m above them.
    height: f64,
    /// Of its fastest node, in m/s.
    speed: f64,
}

impl Rest {
    fn of(world: &World) -> Self {
        let nodes = world.wires()[2].nodes();
        let over = nodes.iter().filter(|node| node.position.x.abs() <= 0.75);
        let speeds = nodes.iter().map(|node| node.velocity.norm());
        Rest {
            height: over.map(|node| node.position.z).fold(f64::MAX, f64::min),
            speed: speeds.fold(0.0, f64::max),
        }
    }
}

//! What is published of a chain that falls: folded, one end let go.

use std::error::Error;

use super::{Case, Comparison, at, settle};
use tunnelproof::wire::{Material, Settings, Stop, WirePlan, World};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

pub(super) const FOLDED: Case = Case {
    name: "folded chain",
    formula: "v^2 = g x (2L - x)/(L - x); Calkin and March 1989",
    run: folded,
};

/// What part of the length the end falls: at the end it swings.
const FALLEN: f64 = 0.9;

/// The length of the chain in m.
pub(crate) const LENGTH: f64 = 1.0;

/// A chain that hangs by one end, at the moment at which the other one beside it is let go.
pub(crate) fn let_go(links: usize, step: f64) -> Result<World, Box<dyn Error>> {
    let length = LENGTH;
    let link = length / links as f64;
    let material = Material::steel(0.002).chain();
    let mut hanging = World::new(Settings::default())?;
    let ends = [at(0.0, 0.0, 0.0), at(2.0 * link, 0.0, 0.0)].map(Stop::Pinned);
    let bottom = Stop::Free(at(link, 0.0, -(length - 2.0 * link) / 2.0));
    let mut plan = WirePlan::new(material, link, vec![ends[0], bottom, ends[1]]);
    plan.length = Some(length);
    hanging.add_wire(&plan)?;
    settle(&mut hanging, &|_| Vec::new(), 1e-9, 50_000)?;

    let nodes = hanging.wires()[0].nodes();
    let mut route: Vec<_> = nodes.iter().map(|node| Stop::Free(node.position)).collect();
    route[0] = ends[0];
    let mut world = World::new(Settings::default().with_step(step))?;
    // Damped for two steps, as is usual.
    let damped = Material {
        stretch_damping: 2.0 * step,
        ..material
    };
    let mut plan = WirePlan::new(damped, 2.0 * link, route);
    plan.length = Some(length);
    world.add_wire(&plan)?;
    Ok(world)
}

/// How long the free end takes to fall, in s, and its speed then.
fn fall(links: usize, step: f64) -> Result<(f64, f64), Box<dyn Error>> {
    let mut world = let_go(links, step)?;
    let free = (2.0 * LENGTH / -world.settings().gravity.z).sqrt();
    let mark = -FALLEN * LENGTH;
    while world.time() < 1.2 * free {
        let before = end_height(&world);
        world.step(&[])?;
        let after = end_height(&world);
        if after <= mark {
            let speed = (before - after) / step;
            return Ok((world.time() - (mark - after) / speed, speed));
        }
    }
    Err("the end does not come down".into())
}

fn end_height(world: &World) -> f64 {
    let nodes = world.wires()[0].nodes();
    nodes[nodes.len() - 1].position.z
}

/// When an end that is let go has fallen by a part of the length, and how fast, in s and m/s, by conservation of energy:
/// `v^2 = g x (2 L - x) / (L - x)` after a way `x` of a chain whose ends start at one place.
pub(crate) fn by_energy(gravity: f64, fallen: f64) -> (f64, f64) {
    // Simpson's rule over `u = sqrt(x)`, where the integrand has no pole.
    let rate = |u: f64| 2.0 * ((1.0 - u * u) / (gravity * (2.0 - u * u))).sqrt();
    let (parts, end) = (100, fallen.sqrt());
    let part = end / f64::from(parts);
    let weight = |i| match i {
        0 => 1.0,
        _ if i == parts => 1.0,
        _ => f64::from(2 + 2 * (i % 2)),
    };
    let sum: f64 = (0..=parts)
        .map(|i| weight(i) * rate(part * f64::from(i)))
        .sum();
    let speed = gravity * fallen * (2.0 - fallen) / (1.0 - fallen);
    (sum * part / 3.0, speed.sqrt())
}

fn folded() -> Outcome {
    let gravity = -Settings::default().gravity.z;
    let free = (2.0 * FALLEN / gravity).sqrt();
    let (time, speed) = by_energy(gravity, FALLEN);
    let (measured, measured_speed) = fall(128, 2.5e-4)?;
    let what = "time for 0.9 of the length, in free falls";
    Ok(vec![
        Comparison::new(what, time / free, measured / free, 1.5e-2),
        Comparison::new("speed then, m/s", speed, measured_speed, 5e-2),
    ])
}

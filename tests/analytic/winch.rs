//! What hangs on wires that a reel lets out and hauls in.

use std::error::Error;

use super::{Case, Comparison, at};
use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyPlan, Material, ReelPhase, Settings, Shape, Stop, Vector, WirePlan, World,
};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

/// A ball on a wire of steel whose upper end is on a reel at the origin.
fn hanging(
    mass: f64,
    [length, resolution]: [f64; 2],
    degrees: f64,
    step: f64,
    phases: Vec<ReelPhase>,
) -> Result<World, Box<dyn Error>> {
    let settings = Settings::default().with_step(step);
    let gravity = -settings.gravity.z;
    let mut world = World::new(settings)?;
    let theta = degrees.to_radians();
    let start = at(length * libm::sin(theta), 0.0, -length * libm::cos(theta));
    let shape = Shape::Sphere { radius: 0.1 };
    let density = mass / shape.mass_properties(1.0)?.mass;
    let body = world.add_body(BodyPlan::dynamic(shape, density, start))?;
    let local = Vector::zeros();
    let route = vec![Stop::Eye { body, local }, Stop::Pinned(Point::origin())];
    let material = Material::steel(0.002);
    let mut plan = WirePlan::new(material, resolution, route).reeled(phases);
    plan.length = Some(length / (1.0 + mass * gravity / material.stretch_stiffness()));
    world.add_wire(&plan)?;
    Ok(world)
}

/// From 1 s to 5 s.
fn for_four_seconds(speed: f64) -> Vec<ReelPhase> {
    vec![
        ReelPhase { from: 1.0, speed },
        ReelPhase {
            from: 5.0,
            speed: 0.0,
        },
    ]
}

pub(super) const WINCH: Case = Case {
    name: "winch",
    formula: "a load goes as far as wire is hauled in or let out; the reel does m g z + m v^2",
    run: || {
        let mut comparisons = Vec::new();
        for per_second in [30.0, 60.0, 240.0] {
            for speed in [-1.0, 1.0] {
                comparisons.extend(winch(per_second, speed)?);
            }
        }
        Ok(comparisons)
    },
};

/// 100 kg on 10 m of wire, of segments of 0.25 m, go by 4 m.
fn winch(per_second: f64, speed: f64) -> Outcome {
    let mass = 100.0;
    let mut world = hanging(
        mass,
        [10.0, 0.25],
        0.0,
        1.0 / per_second,
        for_four_seconds(speed),
    )?;
    let gravity = -world.settings().gravity.z;
    let start = world.bodies()[0].position().z;
    let (mut work, mut tensions) = (0.0, Vec::new());
    let before = world.energy_halfway().total();
    let mut after = before;
    while world.time() < 6.0 {
        let record = world.step(&[])?;
        work += record.work;
        after = record.energy.total();
        if world.time() > 4.0 && world.time() <= 5.0 {
            tensions.push(world.wires()[0].segments()[0].tension);
        }
    }
    let rise = world.bodies()[0].position().z - start;
    let mean = tensions.iter().sum::<f64>() / tensions.len() as f64;
    let said = |what: &str| format!("h = 1/{per_second} s, {speed} m/s, {what}");
    // The load is at once as fast as the wire, and at once at rest: that sets it swinging along the
    // wire, with `m v^2 / 2` each time, which damping takes.
    let due = after - before + mass * speed * speed;
    // The stretch is 0.3 mm for each metre.
    Ok(vec![
        Comparison::new(said("rise in m"), -4.0 * speed, rise, 1e-3),
        Comparison::new(said("tension in N"), mass * gravity, mean, 1e-3),
        Comparison::new(said("work of the reel in J"), due, work, 1e-3),
    ])
}

pub(super) const HAULED_PENDULUM: Case = Case {
    name: "pendulum that is hauled in",
    formula: "energy over frequency stays, if slowly; Ehrenfest 1916",
    run: || {
        let mut comparisons = Vec::new();
        for per_second in [60.0, 240.0] {
            comparisons.extend(pendulum(per_second)?);
        }
        Ok(comparisons)
    },
};

/// 1 kg from 4 m to 2 m in 40 s.
fn pendulum(per_second: f64) -> Outcome {
    let phases = vec![
        ReelPhase {
            from: 0.0,
            speed: -0.05,
        },
        ReelPhase {
            from: 40.0,
            speed: 0.0,
        },
    ];
    let mut world = hanging(1.0, [4.0, 0.2], 2.0, 1.0 / per_second, phases)?;
    let mut kept = 0.0f64;
    while world.time() < 50.0 {
        world.step(&[])?;
        let place = world.bodies()[0].position();
        if world.time() > 42.0 {
            kept = kept.max(libm::atan2(place.x.abs(), -place.z));
        }
    }
    // Energy over frequency is in proportion to `sqrt(I k) theta^2`, with the inertia `I = m l^2 + mu
    // l^3 / 3` and `k = (m + mu l / 2) g l`.
    let per_length = Material::steel(0.002).mass_per_length();
    let action =
        |l: f64| (l * l * (1.0 + per_length * l / 3.0) * l * (1.0 + per_length * l / 2.0)).sqrt();
    let expected = 2.0 * (action(4.0) / action(2.0)).sqrt();
    let said = format!("h = 1/{per_second} s, degrees");
    Ok(vec![Comparison::new(
        said,
        expected,
        kept.to_degrees(),
        0.02,
    )])
}

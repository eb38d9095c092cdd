//! What swings on wires whose segments are short for their tension: nothing damps it.

use std::error::Error;
use std::f64::consts::PI;

use super::{Case, Comparison, at, period};
use tunnelproof::query::Point;
use tunnelproof::wire::{BodyPlan, Material, Settings, Shape, Stop, Vector, WirePlan, World};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

/// The steps in s.
const STEPS: [f64; 3] = [30.0, 60.0, 240.0];

pub(super) const SWAY: Case = Case {
    name: "sway",
    formula: "a load keeps its angle; 2 pi sqrt(L/g) (1 + theta^2/16)",
    run: || {
        pendulum(&Pendulum {
            what: "1 t on 5 m of 4 mm steel, 2 minutes",
            mass: 1000.0,
            length: 5.0,
            resolution: 0.25,
            material: Material::steel(0.002),
            degrees: 5.0,
            seconds: 120.0,
        })
    },
};

pub(super) const LIGHT_PENDULUM: Case = Case {
    name: "light pendulum",
    formula: "a load keeps its angle; 2 pi sqrt(L/g) (1 + theta^2/16)",
    run: || {
        pendulum(&Pendulum {
            what: "1 kg on 2 m of 2 mm steel, 1 minute",
            mass: 1.0,
            length: 2.0,
            resolution: 0.05,
            material: Material::steel(0.001),
            degrees: 20.0,
            seconds: 60.0,
        })
    },
};

/// A ball on a wire of short segments.
struct Pendulum {
    what: &'static str,
    /// In kg.
    mass: f64,
    /// To the middle of the ball, in m.
    length: f64,
    /// The length of segments in m.
    resolution: f64,
    material: Material,
    /// The angle at which it starts.
    degrees: f64,
    /// How long it swings.
    seconds: f64,
}

/// The largest angle in the last fifth of the time, and the period, for each step.
fn pendulum(pendulum: &Pendulum) -> Outcome {
    let mut comparisons = Vec::new();
    for per_second in STEPS {
        let settings = Settings::default().with_step(1.0 / per_second);
        let gravity = -settings.gravity.z;
        let mut world = World::new(settings)?;
        let theta = pendulum.degrees.to_radians();
        let length = pendulum.length;
        let start = at(length * libm::sin(theta), 0.0, -length * libm::cos(theta));
        let shape = Shape::Sphere { radius: 0.1 };
        let density = pendulum.mass / shape.mass_properties(1.0)?.mass;
        let body = world.add_body(BodyPlan::dynamic(shape, density, start))?;
        let local = Vector::zeros();
        let route = vec![Stop::Pinned(Point::origin()), Stop::Eye { body, local }];
        let mut plan = WirePlan::new(pendulum.material, pendulum.resolution, route);
        let stretch = pendulum.mass * gravity / pendulum.material.stretch_stiffness();
        plan.length = Some(length / (1.0 + stretch));
        world.add_wire(&plan)?;
        let (mut samples, mut kept) = (Vec::new(), 0.0f64);
        while world.time() < pendulum.seconds {
            world.step(&[])?;
            let place = world.bodies()[0].position();
            samples.push(place.x);
            if world.time() > 0.8 * pendulum.seconds {
                kept = kept.max(libm::atan2(place.x.abs(), -place.z));
            }
        }
        let what = pendulum.what;
        let said = format!("{what}, h = 1/{per_second} s, degrees");
        comparisons.push(Comparison::new(
            said,
            pendulum.degrees,
            kept.to_degrees(),
            0.01,
        ));
        let expected = 2.0 * PI * (length / gravity).sqrt() * (1.0 + theta * theta / 16.0);
        let measured = period(&samples, 1.0 / per_second);
        let said = format!("{what}, h = 1/{per_second} s, period in s");
        comparisons.push(Comparison::new(said, expected, measured, 0.01));
    }
    Ok(comparisons)
}

pub(super) const TAUT_STRING: Case = Case {
    name: "taut string",
    formula: "f = c / (2 l), first mode; decay (omega h)^4 / (64 s^4) in a step",
    run: || {
        Ok(STEPS
            .map(taut_string)
            .into_iter()
            .collect::<Result<Vec<_>, _>>()?
            .concat())
    },
};

/// The first mode of a string of 40 segments of 0.25 m on which waves travel 1.5 m in 1/60 s. A
/// step moves with the velocity at its end, which makes frequencies higher by `(omega h)^2 / 24`, 4%
/// at 1/30 s.
fn taut_string(per_second: f64) -> Outcome {
    const SEGMENTS: u32 = 40;
    let (length, frequency, amplitude) = (10.0, 4.5, 1e-3);
    let speed = 2.0 * length * frequency;
    let settings = Settings::default().with_step(1.0 / per_second);
    let margin = settings.stability_margin;
    let mut world = World::new(settings.with_gravity(Vector::zeros()))?;
    let material = Material::steel(0.002).chain();
    let strain = material.density * speed * speed / material.stretch_modulus;
    let stop = |i: u32| {
        let part = f64::from(i) / f64::from(SEGMENTS);
        let point = at(part * length, 0.0, amplitude * libm::sin(PI * part));
        if i.is_multiple_of(SEGMENTS) {
            Stop::Pinned(point)
        } else {
            Stop::Free(point)
        }
    };
    let mut plan = WirePlan::new(material, length, (0..=SEGMENTS).map(stop).collect());
    plan.length = Some(length / (1.0 + strain));
    world.add_wire(&plan)?;
    // Amplitudes in the first and in the fourth second.
    let (mut samples, mut first, mut kept) = (Vec::new(), 0.0f64, 0.0f64);
    while world.time() < 4.0 {
        world.step(&[])?;
        let middle = world.wires()[0].nodes()[SEGMENTS as usize / 2].position.z;
        samples.push(middle);
        if world.time() > 3.0 {
            kept = kept.max(middle);
        } else if world.time() < 1.0 {
            first = first.max(middle);
        }
    }
    let measured = 1.0 / period(&samples, 1.0 / per_second);
    let tolerance = if per_second < 60.0 { 0.04 } else { 0.01 };
    let turned = 2.0 * PI * frequency / per_second;
    let left = libm::exp(-3.0 * per_second * turned.powi(4) / (64.0 * margin.powi(4)));
    let named = |what: &str| format!("h = 1/{per_second} s, {what}");
    Ok(vec![
        Comparison::new(named("Hz"), frequency, measured, tolerance),
        Comparison::new(
            named("part of the amplitude after 3 s"),
            left,
            kept / first,
            0.2,
        ),
    ])
}

//! What is published of cables that swing: a chain by its upper end, a cable that sags.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};

use super::{Case, Comparison, at, period};
use tunnelproof::wire::{Material, Settings, Stop, Vector, WirePlan, World};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

pub(super) const HANGING: Case = Case {
    name: "hanging chain",
    formula: "omega = j/2 sqrt(g/L), J0(j) = 0; D. Bernoulli 1738",
    run: hanging,
};

/// The first three zeros of the Bessel function `J0`.
const ZEROS: [f64; 3] = [2.404_826, 5.520_078, 8.653_728];

/// The Bessel function `J0` by its series.
fn bessel(x: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..40 {
        term *= -x * x / 4.0 / f64::from(k * k);
        sum += term;
    }
    sum
}

fn hanging() -> Outcome {
    let (length, links, swing) = (2.0, 64, 1e-3);
    let settings = Settings::default().with_step(1.0 / 480.0);
    let (gravity, step) = (-settings.gravity.z, settings.step);
    let material = Material::steel(0.002).chain();
    let mut rows = Vec::new();
    for (mode, zero) in (1..).zip(ZEROS) {
        // The shape of the mode, of which the end swings by a millimetre.
        let shape = |i: i32| bessel(zero * (1.0 - f64::from(i) / f64::from(links)).sqrt());
        let place = |i| {
            at(
                swing * shape(i),
                0.0,
                -length * f64::from(i) / f64::from(links),
            )
        };
        let mut route = vec![Stop::Pinned(place(0))];
        route.extend((1..=links).map(|i| Stop::Free(place(i))));
        let mut world = World::new(settings.clone())?;
        world.add_wire(&WirePlan::new(material, length, route))?;
        let mut samples = Vec::new();
        for _ in 0..(8.0 / step) as usize {
            world.step(&[])?;
            let nodes = world.wires()[0].nodes();
            samples.push(nodes[nodes.len() - 1].position.x);
        }
        let omega = zero / 2.0 * (gravity / length).sqrt();
        let measured = 2.0 * PI / period(&samples, step);
        let what = format!("mode {mode}, rad/s");
        rows.push(Comparison::new(what, omega, measured, 1e-2));
    }
    Ok(rows)
}

pub(super) const SAGGING: Case = Case {
    name: "sagging cable",
    formula: "tan(w/2) = w/2 - (4/lambda^2) (w/2)^3; Irvine and Caughey 1974",
    run: sagging,
};

/// The first symmetric frequency of a cable in multiples of `sqrt(H/m)/l`, for a parameter `lambda^2`.
fn symmetric(parameter: f64) -> f64 {
    // With x = w/2 between pi/2 and 3 pi/2, times the cosine.
    let excess = |x: f64| libm::sin(x) - libm::cos(x) * (x - 4.0 * x * x * x / parameter);
    let mut bracket = [FRAC_PI_2, 3.0 * FRAC_PI_2];
    for _ in 0..60 {
        let middle = (bracket[0] + bracket[1]) / 2.0;
        bracket[usize::from(excess(middle) < 0.0)] = middle;
    }
    2.0 * bracket[0]
}

fn sagging() -> Outcome {
    let mut rows = Vec::new();
    // On both sides of `4 pi^2`, where the mode becomes faster than that of two waves.
    for modulus in [5e7, 3e8] {
        rows.extend(cable(modulus)?);
    }
    Ok(rows)
}

/// A chain of 20 m with a sag of about a twentieth.
fn cable(modulus: f64) -> Outcome {
    let (width, links) = (20.0, 64);
    let material = Material {
        density: 2000.0,
        stretch_modulus: modulus,
        ..Material::steel(0.01).chain()
    };
    let ends = [at(0.0, 0.0, 0.0), at(width, 0.0, 0.0)].map(Stop::Pinned);
    let mut world = World::new(Settings::default())?;
    let mut plan = WirePlan::new(material, width / f64::from(links), ends.to_vec());
    plan.length = Some(width * 1.004);
    world.add_wire(&plan)?;
    // Halted at its fastest a cable shakes along itself for long; every quarter of a second it comes to rest.
    for _ in 0..2000 {
        world.halt();
        let mut kinetic = 0.0;
        for _ in 0..15 {
            kinetic = world.step(&[])?.energy.kinetic;
        }
        if kinetic < 1e-7 {
            break;
        }
    }
    let wire = &world.wires()[0];
    let middle = wire.segments().len() / 2;
    let pull = wire.segments()[middle].tension * wire.span(middle).normalize().x;
    let mass = material.mass_per_length();
    let weight = mass * -world.settings().gravity.z;
    let sag = -wire.nodes()[middle].position.z;
    // Irvine's parameter: sag against stretch.
    let long = width * (1.0 + 8.0 * (sag / width).powi(2));
    let parameter =
        (weight * width / pull).powi(2) * width * material.stretch_stiffness() / (pull * long);
    let expected = symmetric(parameter) / width * (pull / mass).sqrt();

    let rest: Vec<f64> = wire.nodes().iter().map(|node| node.position.z).collect();
    let mut route: Vec<_> = wire
        .nodes()
        .iter()
        .map(|node| Stop::Free(node.position))
        .collect();
    (route[0], route[rest.len() - 1]) = (ends[0], ends[1]);
    let step = 1.0 / 480.0;
    let mut world = World::new(Settings::default().with_step(step))?;
    // Damped for two steps, as is usual.
    let damped = Material {
        stretch_damping: 2.0 * step,
        ..material
    };
    let mut plan = WirePlan::new(damped, width, route);
    plan.length = Some(width * 1.004);
    plan.velocity = Vector::new(0.0, 0.0, 0.01);
    world.add_wire(&plan)?;
    let mut samples = Vec::new();
    for _ in 0..(10.0 / step) as usize {
        world.step(&[])?;
        let nodes = world.wires()[0].nodes();
        let height = |i: usize| nodes[i].position.z - rest[i];
        let shape = |i: usize| libm::sin(PI * i as f64 / f64::from(links));
        samples.push((0..nodes.len()).map(|i| height(i) * shape(i)).sum());
    }
    let measured = 2.0 * PI / period(&samples, step);
    let what = format!("lambda^2 = {parameter:.1}, rad/s");
    Ok(vec![Comparison::new(what, expected, measured, 1e-2)])
}

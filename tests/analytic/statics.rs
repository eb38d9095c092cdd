//! What rests: stretch, catenary, cantilever.

use std::error::Error;

use super::{Case, Comparison, at, settle};
use tunnelproof::wire::{BodyPlan, Material, Settings, Shape, Stop, Vector, WirePlan, World};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

pub(super) const STRETCH: Case = Case {
    name: "elastic stretch",
    formula: "F L / (E A)",
    run: stretch,
};

fn stretch() -> Outcome {
    Ok(vec![hang(100.0, 0.5)?, hang(1e5, 0.1)?])
}

/// The stretch of 2 m of steel wire under a body of a mass in kg and its own weight.
fn hang(mass: f64, resolution: f64) -> Result<Comparison, Box<dyn Error>> {
    let length = 2.0;
    let mut world = World::new(Settings::default())?;
    let bob = Shape::Sphere { radius: 0.5 };
    let density = mass / bob.mass_properties(1.0)?.mass;
    let body = world.add_body(BodyPlan::dynamic(bob, density, at(0.0, 0.0, -length)))?;
    let local = Vector::zeros();
    let route = vec![Stop::Pinned(at(0.0, 0.0, 0.0)), Stop::Eye { body, local }];
    let material = Material::steel(0.02);
    world.add_wire(&WirePlan::new(material, resolution, route))?;
    for _ in 0..600 {
        world.step(&[])?;
    }
    // The tension grows along the wire by its own weight; its mean is that in the middle.
    let weight = mass + material.mass_per_length() * length / 2.0;
    let force = weight * -world.settings().gravity.z;
    let expected = force * length / material.stretch_stiffness();
    let measured = -world.bodies()[0].position().z - length;
    let what = format!("under {mass} kg, m");
    Ok(Comparison::new(what, expected, measured, 1e-4))
}

pub(super) const CATENARY: Case = Case {
    name: "catenary",
    formula: "L = 2 a sinh(D / 2a), sag a (cosh(D / 2a) - 1), H = mu g a",
    run: catenary,
};

/// A chain of 10 m between ends 8 m apart that starts as a V.
fn catenary() -> Outcome {
    let (length, distance) = (10.0, 8.0);
    let material = Material::steel(0.01).chain();
    let mut world = World::new(Settings::default())?;
    let route = vec![
        Stop::Pinned(at(-distance / 2.0, 0.0, 0.0)),
        Stop::Free(at(0.0, 0.0, -3.0)),
        Stop::Pinned(at(distance / 2.0, 0.0, 0.0)),
    ];
    world.add_wire(&WirePlan::new(material, length / 32.0, route))?;
    settle(&mut world, &|_| Vec::new(), 1e-9, 20_000)?;

    let mut bracket = [0.1, 100.0];
    for _ in 0..100 {
        let a = (bracket[0] + bracket[1]) / 2.0;
        // The length falls with a.
        let longer = 2.0 * a * libm::sinh(distance / (2.0 * a)) > length;
        bracket[usize::from(!longer)] = a;
    }
    let a = bracket[0];
    let wire = &world.wires()[0];
    let middle = wire.segments().len() / 2;
    let sag = -wire.nodes()[middle].position.z;
    let expected = a * (libm::cosh(distance / (2.0 * a)) - 1.0);
    let span = wire.span(middle - 1).normalize();
    let pull = wire.segments()[middle - 1].tension * span.x;
    let weight = material.mass_per_length() * -world.settings().gravity.z;
    Ok(vec![
        Comparison::new("sag, m", expected, sag, 0.01),
        Comparison::new("horizontal tension, N", weight * a, pull, 0.01),
    ])
}

pub(super) const CANTILEVER: Case = Case {
    name: "cantilever",
    formula: "P L^3 / 3 E I; q L^4 / 8 E I",
    run: cantilever,
};

fn cantilever() -> Outcome {
    let gravity = -Settings::default().gravity.z;
    let heavy = Material::steel(0.005);
    let load = heavy.mass_per_length() * gravity;
    let under_own_weight = load / (8.0 * heavy.bend_stiffness());

    let light = Material {
        density: 1.0,
        ..heavy
    };
    let mass = 0.1;
    let under_tip_load = mass * gravity / (3.0 * light.bend_stiffness());
    let what = ["end under its own weight, m", "end under a load at it, m"];
    Ok(vec![
        Comparison::new(what[0], under_own_weight, deflection(heavy, None)?, 0.02),
        Comparison::new(
            what[1],
            under_tip_load,
            deflection(light, Some(mass))?,
            0.02,
        ),
    ])
}

/// How far the end of a clamped beam of 1 m in 16 segments sinks, with a mass in kg at its end or
/// without.
fn deflection(material: Material, mass: Option<f64>) -> Result<f64, Box<dyn Error>> {
    let mut world = World::new(Settings::default())?;
    let end = match mass {
        Some(mass) => {
            let shape = Shape::Sphere { radius: 0.02 };
            let density = mass / shape.mass_properties(1.0)?.mass;
            let body = world.add_body(BodyPlan::dynamic(shape, density, at(1.0, 0.0, 0.0)))?;
            let local = Vector::zeros();
            Stop::Eye { body, local }
        }
        None => Stop::Free(at(1.0, 0.0, 0.0)),
    };
    // Two pinned points clamp the beam; the stub between them is short, so that at the wall only
    // half a segment bends.
    let wall = [at(-1e-4, 0.0, 0.0), at(0.0, 0.0, 0.0)].map(Stop::Pinned);
    let route = vec![wall[0], wall[1], end];
    world.add_wire(&WirePlan::new(material, 1.0 / 16.0, route))?;
    settle(&mut world, &|_| Vec::new(), 1e-12, 50_000)?;
    let nodes = world.wires()[0].nodes();
    Ok(-nodes[nodes.len() - 1].position.z)
}

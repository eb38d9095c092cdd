//! What is published of wires that bend or sag far: the elastica of a cantilever and of a column, the
//! tallest column, the elastic catenary.

use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};

use super::{Case, Comparison, at, settle};
use tunnelproof::wire::{BodyPlan, Material, Settings, Shape, Stop, Vector, Wire, WirePlan, World};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

/// A steel rod of 10 mm that weighs next to nothing.
fn light() -> Material {
    Material {
        density: 1.0,
        ..Material::steel(0.005)
    }
}

/// A rod of 1 m in equal segments, clamped at the origin along a direction, with a mass in kg at its
/// end, at rest.
fn loaded(clamp: Vector, end: Vector, mass: f64) -> Result<Wire, Box<dyn Error>> {
    let mut world = World::new(Settings::default())?;
    let shape = Shape::Sphere { radius: 0.02 };
    let density = mass / shape.mass_properties(1.0)?.mass;
    let body = world.add_body(BodyPlan::dynamic(shape, density, end.into()))?;
    let local = Vector::zeros();
    let route = clamped(clamp, Stop::Eye { body, local });
    world.add_wire(&WirePlan::new(light(), 1.0 / 32.0, route))?;
    settle(&mut world, &|_| Vec::new(), 1e-12, 50_000)?;
    Ok(world.wires()[0].clone())
}

/// A cantilever that starts level, under a weight given as `P L^2 / E I`.
pub(crate) fn cantilever(load: f64) -> Result<Wire, Box<dyn Error>> {
    let gravity = -Settings::default().gravity.z;
    let mass = load * light().bend_stiffness() / gravity;
    loaded(Vector::x(), Vector::x(), mass)
}

/// Two pinned points clamp a rod; the stub between them is short, so that at the wall only half a
/// segment bends.
fn clamped(direction: Vector, end: Stop) -> Vec<Stop> {
    let stub = Stop::Pinned((-1e-4 * direction).into());
    vec![stub, Stop::Pinned(at(0.0, 0.0, 0.0)), end]
}

fn end_of(wire: &Wire) -> Vector {
    wire.nodes()[wire.nodes().len() - 1].position.coords
}

pub(super) const BENT_CANTILEVER: Case = Case {
    name: "cantilever, bent far",
    formula: "elastica; Mattiasson 1981",
    run: bent_cantilever,
};

/// Where the end of a cantilever is under a weight `P`, in parts of its length: `P L^2 / E I`, how far
/// down, how far back (Mattiasson 1981, table 1).
pub(crate) const MATTIASSON: [(f64, f64, f64); 4] = [
    (1.0, 0.301_72, 0.056_43),
    (2.0, 0.493_46, 0.160_64),
    (5.0, 0.713_79, 0.387_63),
    (10.0, 0.810_61, 0.555_00),
];

fn bent_cantilever() -> Outcome {
    let mut rows = Vec::new();
    for (load, down, back) in MATTIASSON {
        let end = end_of(&cantilever(load)?);
        let what = |way| format!("P L^2/E I = {load}: {way}, m");
        rows.push(Comparison::new(what("down"), down, -end.z, 5e-3));
        rows.push(Comparison::new(what("back"), back, 1.0 - end.x, 5e-3));
    }
    Ok(rows)
}

pub(super) const COLUMN: Case = Case {
    name: "column, buckled",
    formula: "P/Pc = (2K/pi)^2, x/L = 2E/K - 1, y/L = 2k/K, k = sin(alpha/2); Timoshenko and Gere 1961",
    run: column,
};

/// The complete elliptic integrals `K` and `E` by the arithmetic-geometric mean.
fn elliptic(k: f64) -> (f64, f64) {
    let (mut a, mut b, mut power, mut sum) = (1.0, (1.0 - k * k).sqrt(), 0.5, k * k / 2.0);
    for _ in 0..8 {
        let c = (a - b) / 2.0;
        (a, b, power) = ((a + b) / 2.0, (a * b).sqrt(), 2.0 * power);
        sum += power * c * c;
    }
    let first = FRAC_PI_2 / a;
    (first, first * (1.0 - sum))
}

fn column() -> Outcome {
    let gravity = -Settings::default().gravity.z;
    let least = PI * PI / 4.0 * light().bend_stiffness();
    let mut rows = Vec::new();
    for alpha in [60.0_f64, 80.0, 100.0] {
        let k = libm::sin(alpha.to_radians() / 2.0);
        let (first, second) = elliptic(k);
        let load = least * (first / FRAC_PI_2).powi(2);
        let start = Vector::new(libm::sin(0.1), 0.0, libm::cos(0.1));
        let end = end_of(&loaded(Vector::z(), start, load / gravity)?);
        let what = |way| format!("P/Pc = {:.3}: end {way}, m", load / least);
        let [height, aside] = [2.0 * second / first - 1.0, 2.0 * k / first];
        rows.push(Comparison::new(what("above the foot"), height, end.z, 1e-2));
        rows.push(Comparison::new(what("aside"), aside, end.x, 1e-2));
    }
    Ok(rows)
}

pub(super) const TALLEST: Case = Case {
    name: "tallest column",
    formula: "q L^3 / E I = 7.8373; Greenhill 1881",
    run: tallest,
};

/// Whether a rod of 1 m that leans a little and is clamped upright bends over under its own weight, given
/// as `q L^3 / E I`, or stands up; `None` if it has done neither after many steps.
fn bends_over(weight: f64) -> Result<Option<bool>, Box<dyn Error>> {
    let settings = Settings::default();
    let steel = Material::steel(0.005);
    let pull = steel.mass_per_length() * -settings.gravity.z;
    // Of the same weight, as soft as asked.
    let material = Material {
        bend_modulus: steel.bend_modulus * pull / (weight * steel.bend_stiffness()),
        ..steel
    };
    let mut world = World::new(settings)?;
    let lean = 1e-3;
    let end = Stop::Free(at(libm::sin(lean), 0.0, libm::cos(lean)));
    let route = clamped(Vector::z(), end);
    world.add_wire(&WirePlan::new(material, 1.0 / 32.0, route))?;
    let mut last = 0.0;
    for _ in 0..20_000 {
        let kinetic = world.step(&[])?.energy.kinetic;
        let aside = end_of(&world.wires()[0]).x;
        if !(0.3 * lean..3.0 * lean).contains(&aside) {
            return Ok(Some(aside > lean));
        }
        if kinetic < last {
            world.halt();
        }
        last = if kinetic < last { 0.0 } else { kinetic };
    }
    Ok(None)
}

fn tallest() -> Outcome {
    let mut bracket = [7.0, 8.5];
    let mut middle = (bracket[0] + bracket[1]) / 2.0;
    // Where it does neither is the limit.
    while bracket[1] - bracket[0] > 5e-3
        && let Some(is_over) = bends_over(middle)?
    {
        bracket[usize::from(is_over)] = middle;
        middle = (bracket[0] + bracket[1]) / 2.0;
    }
    let what = "weight under which it bends over";
    Ok(vec![Comparison::new(what, 7.837_3, middle, 5e-3)])
}

pub(super) const ELASTIC_CATENARY: Case = Case {
    name: "elastic catenary",
    formula: "D = H L/EA + (2H/q) asinh(qL/2H); Irvine 1981",
    run: elastic_catenary,
};

/// A rope of 10 m between ends 10 m apart, which its weight stretches by percents.
fn elastic_catenary() -> Outcome {
    let (length, distance) = (10.0, 10.0);
    let material = Material {
        density: 1200.0,
        stretch_modulus: 1e6,
        ..Material::steel(0.01).chain()
    };
    let mut world = World::new(Settings::default())?;
    let ends = [at(0.0, 0.0, 0.0), at(distance, 0.0, 0.0)];
    let plan = WirePlan::new(material, length / 64.0, ends.map(Stop::Pinned).to_vec());
    world.add_wire(&plan)?;
    settle(&mut world, &|_| Vec::new(), 1e-9, 50_000)?;

    let weight = material.mass_per_length() * -world.settings().gravity.z * length;
    let stiffness = material.stretch_stiffness();
    let width = |pull: f64| {
        let slope = weight / (2.0 * pull);
        pull * length / stiffness + 2.0 * pull * length / weight * libm::asinh(slope)
    };
    let mut bracket = [1e-3, 1e3];
    for _ in 0..100 {
        let pull = (bracket[0] + bracket[1]) / 2.0;
        // The width grows with the pull.
        bracket[usize::from(width(pull) > distance)] = pull;
    }
    let pull = bracket[0];
    let slope = weight / (2.0 * pull);
    let stretch = weight * length / (8.0 * stiffness);
    let sag = stretch + pull * length / weight * ((1.0 + slope * slope).sqrt() - 1.0);
    let nodes = world.wires()[0].nodes();
    let measured = -nodes[nodes.len() / 2].position.z;
    let wire = &world.wires()[0];
    let middle = wire.segments().len() / 2;
    let span = wire.span(middle).normalize();
    let tension = wire.segments()[middle].tension * span.x;
    Ok(vec![
        Comparison::new("sag, m", sag, measured, 2e-3),
        Comparison::new("horizontal tension, N", pull, tension, 2e-3),
    ])
}

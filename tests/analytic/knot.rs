//! A loose overhand knot in an elastic rod, as it is pulled.

use std::error::Error;
use std::f64::consts::{PI, TAU};

use super::{Case, Comparison, at, weightless};
use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyPlan, Collisions, Drive, Material, Phase, RopePlan, Shape, Stop, Vector, WirePlan, World,
};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

/// `E I` of the rod in N m^2.
const BENDING: f64 = 0.01;
/// Radius of the loop at the start, in m.
const LOOP: f64 = 0.09;
/// How fast the ends are drawn apart, in m/s.
const SPEED: f64 = 0.02;
/// Of the two runs that give what friction does; small, as the theory is of first order in it.
const FRICTION: f64 = 0.02;
/// Radii of the rod in m.
const RADII: [f64; 2] = [0.0016, 0.0004];

pub(super) const OVERHAND: Case = Case {
    name: "overhand knot",
    formula: "F h^2/(E I) = e^4/2 + 0.492 f e^3 for small e = sqrt(h/R); Audoly 2007",
    run: overhand,
};

/// The theory is that of e to 0, so the numbers are those of a line through two radii.
fn overhand() -> Outcome {
    let (mut of_bending, mut of_friction) = (Vec::new(), Vec::new());
    for radius in RADII {
        let free = pull(radius, 0.0)?;
        let rubbing = pull(radius, FRICTION)?;
        // The loop has the length by which the ends are nearer than along the rod.
        let loops = free.lengths.map(|length| length / TAU);
        let [first, last] = loops;
        // Integrals of E I / (2 R^2) and of E I f h^(-1/2) R^(-3/2) over the distance of the ends.
        let bending = BENDING * PI * (1.0 / last - 1.0 / first);
        let rubbed = BENDING * FRICTION / radius.sqrt()
            * 2.0
            * TAU
            * (1.0 / last.sqrt() - 1.0 / first.sqrt());
        let small = (2.0 * radius / (first + last)).sqrt();
        of_bending.push((small, 0.5 * free.work / bending));
        of_friction.push((small, (rubbing.work - free.work) / rubbed));
    }
    Ok(vec![
        Comparison::new("1/2, for e = 0", 0.5, at_zero(&of_bending), 0.05),
        Comparison::new("0.492, for e = 0", 0.492, at_zero(&of_friction), 0.15),
    ])
}

/// What a polynomial through some points is at 0.
fn at_zero(points: &[(f64, f64)]) -> f64 {
    let part = |(k, &(x, y)): (usize, &(f64, f64))| {
        let others = points.iter().enumerate().filter(|(at, _)| *at != k);
        others.fold(y, |product, (_, &(other, _))| product * other / (other - x))
    };
    points.iter().enumerate().map(part).sum()
}

/// What came of a pull.
struct Pull {
    /// Of the ends, in J.
    work: f64,
    /// By how much the rod is longer than the distance of its ends, in m, before and after.
    lengths: [f64; 2],
}

/// Draws the ends of a knot apart.
fn pull(radius: f64, friction: f64) -> Result<Pull, Box<dyn Error>> {
    let material = Material::rope(RopePlan {
        radius,
        mass_per_length: 0.005,
        stretch_stiffness: 4e4,
        bend_stiffness: BENDING,
        twist_stiffness: 0.7 * BENDING,
    })?;
    let mut world = World::new(weightless(1.0 / 120.0))?;
    let points = knot(radius);
    let (start, end) = (points[0], points[points.len() - 1]);
    let puller = BodyPlan {
        drive: Drive::Kinematic(vec![Phase {
            from: 0.0,
            velocity: Vector::x() * SPEED,
            angular_velocity: Vector::zeros(),
        }]),
        ..BodyPlan::fixed(Shape::Sphere { radius: 0.001 }, end)
    };
    let body = world.add_body(puller)?;
    let mut route: Vec<_> = points.iter().copied().map(Stop::Free).collect();
    let last = route.len() - 1;
    route[0] = Stop::Pinned(start);
    route[last] = Stop::Eye {
        body,
        local: Vector::zeros(),
    };
    world.add_wire(&WirePlan::new(material, 1.0, route))?;
    let mut collisions = Collisions::default().with_friction(friction)?;
    let (mut work, mut lengths) = (0.0, [0.0; 2]);
    for step in 0..270 {
        let record = world.step_colliding(&mut collisions, &[])?;
        // It has come to rest by then, but for what is pulled.
        if step == 90 {
            lengths[0] = excess(&world);
            work = 0.0;
        }
        work += record.work;
    }
    lengths[1] = excess(&world);
    Ok(Pull { work, lengths })
}

/// By how much the rod is longer than the distance of its ends.
fn excess(world: &World) -> f64 {
    let wire = &world.wires()[0];
    let nodes = wire.nodes();
    wire.length() - (nodes[nodes.len() - 1].position - nodes[0].position).norm()
}

/// Points along an overhand knot: two strands wind about each other by three half turns along x, and a loop above joins one
/// of the left ends with one of the right.
fn knot(radius: f64) -> Vec<Point> {
    const PIECES: usize = 400;
    // Where the strands touch, the rod bends over lengths of this size.
    let size = (radius * LOOP).sqrt();
    let (reach, tail, spacing) = (4.2 * size, 0.1, size / 3.0);
    let from_axis = 1.06 * radius;
    let pieces = || (0..=PIECES).map(|k| k as f64 / PIECES as f64);
    let strand = |phase: f64| {
        pieces().map(move |t| {
            let angle = 3.0 * PI * t + phase;
            let x = reach * (2.0 * t - 1.0);
            at(
                x,
                from_axis * libm::sin(angle),
                from_axis * libm::cos(angle),
            )
        })
    };
    let half = |x: f64, from: f64| {
        pieces().map(move |t| {
            let angle = from + PI * t;
            let z = from_axis + LOOP * (1.0 + libm::sin(angle));
            at(x + LOOP * libm::cos(angle), 0.0, z)
        })
    };
    let mut fine = vec![at(-reach - tail, 0.0, -from_axis)];
    fine.extend(strand(PI));
    fine.extend(half(reach, -PI / 2.0));
    fine.extend(half(-reach, PI / 2.0));
    fine.extend(strand(0.0));
    fine.push(at(reach + tail, 0.0, -from_axis));
    evenly(&fine, spacing)
}

/// Points on a line of pieces, about as far apart along it as is said.
fn evenly(line: &[Point], spacing: f64) -> Vec<Point> {
    let lengths: Vec<_> = line.windows(2).map(|p| (p[1] - p[0]).norm()).collect();
    let total: f64 = lengths.iter().sum();
    let count = (total / spacing).round();
    let mut points = Vec::new();
    let (mut piece, mut before) = (0, 0.0);
    for k in 0..=count as usize {
        let arc = total * k as f64 / count;
        while piece + 1 < lengths.len() && before + lengths[piece] < arc {
            before += lengths[piece];
            piece += 1;
        }
        let part = ((arc - before) / lengths[piece]).min(1.0);
        points.push(line[piece] + (line[piece + 1] - line[piece]) * part);
    }
    points
}

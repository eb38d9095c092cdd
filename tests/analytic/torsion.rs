//! Wires that are twisted: the torsion pendulum, the torque of a turn, and the torques under which a
//! straight rod and a ring buckle.

use std::error::Error;
use std::f64::consts::TAU;

use super::{Case, Comparison, at, period, weightless};
use tunnelproof::wire::{
    BodyPlan, Drive, Material, Phase, Settings, Shape, Stop, Vector, WirePlan, World,
};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

/// Shear modulus of steel in Pa.
const SHEAR: f64 = 7.9e10;

/// A steel rod that resists twist.
fn rod(radius: f64) -> Material {
    Material {
        twist_modulus: SHEAR,
        ..Material::steel(radius)
    }
}

pub(super) const PENDULUM: Case = Case {
    name: "torsion pendulum",
    formula: "omega = sqrt(G J / (L I)); a step has (2/h) atan(omega h / 2)",
    run: pendulum,
};

/// A disc on a vertical wire of 2 m and 4 mm, twisted by three turns and let go.
fn pendulum() -> Outcome {
    let (length, start) = (2.0, 3.0 * TAU);
    let material = Material {
        twist_damping: 0.0,
        ..rod(0.002)
    };
    let mut rows = Vec::new();
    for step in [1.0 / 60.0, 1.0 / 240.0] {
        let mut world = World::new(Settings::default().with_step(step))?;
        let shape = Shape::Cylinder {
            radius: 0.2,
            half_height: 0.02,
        };
        let body = BodyPlan::dynamic(shape, 7850.0, at(0.0, 0.0, -length - 0.02));
        let body = world.add_body(body)?;
        let eye = |z: f64| Stop::Eye {
            body,
            local: Vector::z() * z,
        };
        let pin = |z: f64| Stop::Pinned(at(0.0, 0.0, z));
        let route = vec![pin(1e-3), pin(0.0), eye(0.02), eye(0.019)];
        let plan = WirePlan::new(material, 0.25, route).twisted(start);
        world.add_wire(&plan)?;
        let stiffness = material.twist_stiffness() / length;
        let own = (stiffness / world.bodies()[0].inertia()[(2, 2)]).sqrt();
        let due = 2.0 / step * libm::atan(own * step / 2.0);
        let mut samples = Vec::new();
        let mut largest: f64 = 0.0;
        for _ in 0..(60.0 / step) as usize {
            let twist = world.step(&[])?.wires[0].twist;
            samples.push(twist);
            if samples.len() as f64 * step > 50.0 {
                largest = largest.max(twist.abs());
            }
        }
        let what = |what| format!("h = 1/{:.0} s: {what}", 1.0 / step);
        let omega = TAU / period(&samples, step);
        rows.push(Comparison::new(
            what("omega of the wire, rad/s"),
            own,
            omega,
            1e-4,
        ));
        rows.push(Comparison::new(
            what("omega of its steps, rad/s"),
            due,
            omega,
            1e-8,
        ));
        rows.push(Comparison::new(
            what("largest twist after 50 s, rad"),
            start,
            largest,
            1e-4,
        ));
    }
    Ok(rows)
}

pub(super) const TORQUE: Case = Case {
    name: "prescribed turn",
    formula: "M = G J theta / L",
    run: torque,
};

/// One end of a wire is turned once about it in 4 s, then held. The other end is held by a body
/// that hangs on two more wires, so that the torque is that of a pair of forces.
fn torque() -> Outcome {
    let (length, turns) = (1.5, 1.0);
    let material = rod(0.003);
    let mut world = World::new(weightless(1.0 / 60.0))?;
    let phases = vec![
        Phase {
            from: 0.0,
            velocity: Vector::zeros(),
            angular_velocity: Vector::x() * (turns * TAU / 4.0),
        },
        Phase {
            from: 4.0,
            velocity: Vector::zeros(),
            angular_velocity: Vector::zeros(),
        },
    ];
    let chuck = BodyPlan::fixed(Shape::Sphere { radius: 0.05 }, at(length, 0.0, 0.0));
    let chuck = world.add_body(BodyPlan {
        drive: Drive::Kinematic(phases),
        ..chuck
    })?;
    let half = Vector::new(0.05, 0.3, 0.05);
    let bar = world.add_body(BodyPlan::dynamic(
        Shape::Box { half },
        1000.0,
        at(0.0, 0.0, 0.0),
    ))?;
    let eye = |body, x: f64, y: f64| Stop::Eye {
        body,
        local: Vector::new(x, y, 0.0),
    };
    let route = vec![
        eye(bar, -0.01, 0.0),
        eye(bar, 0.0, 0.0),
        eye(chuck, 0.0, 0.0),
        eye(chuck, 0.01, 0.0),
    ];
    world.add_wire(&WirePlan::new(material, 0.1, route))?;
    // What keeps the bar from turning, by its pull: a wire down from one end and one up from the other.
    let arm = 0.25;
    for side in [1.0, -1.0] {
        let hold = Stop::Pinned(at(0.0, side * arm, -side));
        let route = vec![eye(bar, 0.0, side * arm), hold];
        world.add_wire(&WirePlan::new(Material::steel(0.002), 1.0, route))?;
    }
    let mut torque = 0.0;
    for _ in 0..60 * 12 {
        torque = world.step(&[])?.wires[0].torque;
    }
    let due = material.twist_stiffness() * world.wires()[0].twist() / length;
    let of_turns = material.twist_stiffness() * turns * TAU / length;
    // The wires stand across the bar but for what they are stretched by.
    let pair: f64 = world.wires()[1..]
        .iter()
        .map(|wire| {
            let nodes = wire.nodes();
            let (from, to) = (nodes[0].position, nodes[1].position);
            let force = (to - from).normalize() * wire.segments()[0].tension;
            from.coords.cross(&force).x
        })
        .sum();
    Ok(vec![
        Comparison::new("torque for the twist, N m", due, torque, 1e-12),
        Comparison::new("torque for a turn, N m", of_turns, torque, 1e-4),
        Comparison::new(
            "moment of what holds the other end, N m",
            torque,
            pair.abs(),
            1e-9,
        ),
    ])
}

/// Whether what a world starts with grows to its tenfold, or goes down to a thirtieth; `None` if it has done
/// neither after many steps.
fn grows(world: &mut World, size: impl Fn(&World) -> f64) -> Result<Option<bool>, Box<dyn Error>> {
    let start = size(world);
    for _ in 0..20_000 {
        world.step(&[])?;
        let ratio = size(world) / start;
        if !(0.03..10.0).contains(&ratio) {
            return Ok(Some(ratio > 1.0));
        }
    }
    Ok(None)
}

/// The load between one that lets a disturbance die and one that lets it grow, within a part of it.
fn limit(
    mut bracket: [f64; 2],
    within: f64,
    grows: impl Fn(f64) -> Result<Option<bool>, Box<dyn Error>>,
) -> Result<f64, Box<dyn Error>> {
    let middle = |[low, high]: [f64; 2]| (low + high) / 2.0;
    while bracket[1] - bracket[0] > within * bracket[0] {
        let load = middle(bracket);
        match grows(load)? {
            Some(grows) => bracket[usize::from(grows)] = load,
            // Where it does neither is the limit.
            None => return Ok(load),
        }
    }
    Ok(middle(bracket))
}

pub(super) const GREENHILL: Case = Case {
    name: "twisted rod",
    formula: "2 q (cos p - cos q) + (p^2 - q^2) sin q = 0, p = M L / 2 E I, p^2 - q^2 = T L^2 / E I; Greenhill 1883",
    run: greenhill,
};

/// `M L / E I` at which a rod buckles that is clamped at both ends, under a tension given as `T L^2 / E
/// I`. Without tension `tan q = q`, and for long rods `M = 2 sqrt(E I T)`.
fn buckling(tension: f64) -> f64 {
    if tension == 0.0 {
        return 2.0 * 4.493_409_457_909_064;
    }
    let is_past = |q: f64| {
        let p = (q * q + tension).sqrt();
        2.0 * q * (libm::cos(p) - libm::cos(q)) + tension * libm::sin(q) < 0.0
    };
    // The first root.
    let mut q = 0.1;
    while !is_past(q) {
        q += 1e-3;
    }
    let mut bracket = [q - 1e-3, q];
    for _ in 0..60 {
        let middle = (bracket[0] + bracket[1]) / 2.0;
        bracket[usize::from(is_past(middle))] = middle;
    }
    2.0 * (bracket[0] * bracket[0] + tension).sqrt()
}

/// A rod of 1 m under tension and torque, given as `T L^2 / E I` and `M L / E I`, a little bent.
fn twisted_rod(
    segments: usize,
    step: f64,
    tension: f64,
    torque: f64,
) -> Result<World, Box<dyn Error>> {
    let radius = 0.005;
    let material = Material {
        bend_damping: 1.0 / 60.0,
        ..rod(radius)
    };
    let pull = tension * material.bend_stiffness();
    let strain = pull / material.stretch_stiffness();
    let mut world = World::new(weightless(step))?;
    let pin = |x: f64| Stop::Pinned(at(x, 0.0, 0.0));
    let bow = |k: usize| {
        let x = k as f64 / segments as f64;
        // Of two helices, one of which is like what grows.
        let helix = libm::cos(torque / 2.0 * (x - 0.5));
        let aside = 1e-4 * radius * helix * (1.0 - libm::cos(TAU * x));
        Stop::Free(at(x, aside, 0.0))
    };
    let mut route = vec![pin(-1e-4), pin(0.0)];
    route.extend((1..segments).map(bow));
    route.extend([pin(1.0), pin(1.0001)]);
    let length = 1.0 / (1.0 + strain);
    let twist = torque * material.bend_stiffness() * length / material.twist_stiffness();
    let mut plan = WirePlan::new(material, 10.0, route).twisted(twist);
    plan.length = Some(1.0002 / (1.0 + strain));
    world.add_wire(&plan)?;
    Ok(world)
}

/// How far the nodes of a wire are from the x axis, as a whole.
fn aside(world: &World) -> f64 {
    let nodes = world.wires()[0].nodes().iter();
    let squares = nodes.map(|node| node.position.coords.yz().norm_squared());
    squares.sum::<f64>().sqrt()
}

fn greenhill() -> Outcome {
    let mut rows = Vec::new();
    for (segments, step, tension, tolerance) in [
        (16, 1.0 / 60.0, 0.0, 3e-2),
        (32, 1.0 / 60.0, 0.0, 1e-2),
        (32, 1.0 / 240.0, 0.0, 1e-2),
        (64, 1.0 / 60.0, 0.0, 3e-3),
        (32, 1.0 / 60.0, 100.0, 3e-2),
        (64, 1.0 / 60.0, 100.0, 1e-2),
    ] {
        let due = buckling(tension);
        let grows = |torque| grows(&mut twisted_rod(segments, step, tension, torque)?, aside);
        let torque = limit([0.9 * due, 1.1 * due], 1e-3, grows)?;
        let what = format!(
            "M L/E I, T L^2/E I = {tension:.0}, {segments} segments, h = 1/{:.0} s",
            1.0 / step
        );
        rows.push(Comparison::new(what, due, torque, tolerance));
    }
    Ok(rows)
}

pub(super) const MICHELL: Case = Case {
    name: "twisted ring",
    formula: "Tw = 2 pi sqrt(3) E I / G J; Michell 1889",
    run: michell,
};

/// A ring of a rod that is straight by itself, twisted so far in rad for its whole length, a little out
/// of its plane. Both its ends are clamped at one place.
fn ring(segments: usize, twist: f64) -> Result<World, Box<dyn Error>> {
    let radius = 1.0 / TAU;
    let material = Material {
        bend_damping: 1.0 / 60.0,
        ..rod(0.005)
    };
    let mut world = World::new(weightless(1.0 / 60.0))?;
    let stop = |k: usize| {
        // The clamp is level, and symmetric to 0.
        let around = TAU * (k as f64 - 0.5) / segments as f64;
        let height = 1e-6 * (1.0 - libm::cos(2.0 * around));
        let at = at(
            radius * libm::cos(around),
            radius * libm::sin(around),
            height,
        );
        match k < 2 || k >= segments {
            true => Stop::Pinned(at),
            false => Stop::Free(at),
        }
    };
    let route = (0..segments + 2).map(stop).collect();
    let twist = twist * (segments - 1) as f64 / segments as f64;
    world.add_wire(&WirePlan::new(material, 10.0, route).twisted(twist))?;
    Ok(world)
}

fn michell() -> Outcome {
    let material = rod(0.005);
    let due = TAU * 3.0_f64.sqrt() * material.bend_stiffness() / material.twist_stiffness();
    let height = |world: &World| {
        let nodes = world.wires()[0].nodes().iter();
        let squares = nodes.map(|node| node.position.z * node.position.z);
        squares.sum::<f64>().sqrt()
    };
    let mut rows = Vec::new();
    for (segments, tolerance) in [(32, 1e-2), (64, 3e-3)] {
        let grows = |twist| grows(&mut ring(segments, twist)?, height);
        let twist = limit([0.9 * due, 1.1 * due], 1e-3, grows)?;
        let what = format!("twist under which it leaves its plane, {segments} segments, rad");
        rows.push(Comparison::new(what, due, twist, tolerance));
    }
    Ok(rows)
}

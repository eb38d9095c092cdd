//! What moves: fall, pendulum, string, twist, momentum, energy.

use std::error::Error;
use std::f64::consts::PI;

use super::{Case, Comparison, at, period, weightless};
use tunnelproof::wire::{
    BodyPlan, ContactConstraint, ContactSite, Drive, Material, Settings, Shape, Stop, Vector,
    WireId, WirePlan, World,
};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

pub(super) const FREE_FALL: Case = Case {
    name: "free fall",
    formula: "y = -g h^2 n (n + 1) / 2",
    run: free_fall,
};

fn free_fall() -> Outcome {
    let settings = Settings::default();
    let (gravity, step) = (settings.gravity.z, settings.step);
    let mut world = World::new(settings)?;
    let route = vec![Stop::Free(at(0.0, 0.0, 0.0)), Stop::Free(at(2.0, 0.0, 0.0))];
    world.add_wire(&WirePlan::new(Material::steel(0.02), 0.25, route))?;
    let half = Vector::new(0.1, 0.2, 0.3);
    world.add_body(BodyPlan::dynamic(
        Shape::Box { half },
        1000.0,
        at(0.0, 1.0, 0.0),
    ))?;
    let steps = 600.0;
    for _ in 0..600 {
        world.step(&[])?;
    }
    let expected = gravity * step * step * steps * (steps + 1.0) / 2.0;
    let wire = world.wires()[0].nodes()[4].position.z;
    let body = world.bodies()[0].position().z;
    Ok(vec![
        Comparison::new("wire after 600 steps, m", expected, wire, 1e-12),
        Comparison::new("body after 600 steps, m", expected, body, 1e-12),
    ])
}

pub(super) const PENDULUM: Case = Case {
    name: "pendulum",
    formula: "2 pi sqrt(L/g) (1 + theta^2/16)",
    run: pendulum,
};

fn pendulum() -> Outcome {
    let (length, theta) = (5.0, 0.2);
    let settings = Settings::default();
    let (gravity, step) = (-settings.gravity.z, settings.step);
    let mut world = World::new(settings)?;
    let start = at(length * libm::sin(theta), 0.0, -length * libm::cos(theta));
    let bob = Shape::Sphere { radius: 0.15 };
    let body = world.add_body(BodyPlan::dynamic(bob, 7850.0, start))?;
    let local = Vector::zeros();
    let route = vec![Stop::Pinned(at(0.0, 0.0, 0.0)), Stop::Eye { body, local }];
    world.add_wire(&WirePlan::new(Material::steel(0.005), length, route))?;
    let mut samples = Vec::new();
    for _ in 0..3000 {
        world.step(&[])?;
        samples.push(world.bodies()[0].position().x);
    }
    let expected = 2.0 * PI * (length / gravity).sqrt() * (1.0 + theta * theta / 16.0);
    let measured = period(&samples, step);
    Ok(vec![Comparison::new(
        "period, s",
        expected,
        measured,
        0.005,
    )])
}

pub(super) const STRING: Case = Case {
    name: "string modes",
    formula: "omega_k = (2 c / l) sin(k pi / 2 n)",
    run: string,
};

fn string() -> Outcome {
    (1..=4).map(string_mode).collect()
}

/// Mode `k` of a string of eight segments of 1 m on which waves run at 10 m/s.
fn string_mode(k: u32) -> Result<Comparison, Box<dyn Error>> {
    const SEGMENTS: u32 = 8;
    let (speed, step, amplitude) = (10.0, 1.0 / 600.0, 1e-5);
    let shape = |i: u32| libm::sin(f64::from(k * i) * PI / f64::from(SEGMENTS));
    let material = Material::steel(0.005).chain();
    let strain = material.density * speed * speed / material.stretch_modulus;
    let stop = |i: u32| {
        let point = at(f64::from(i), 0.0, amplitude * shape(i));
        if i.is_multiple_of(SEGMENTS) {
            Stop::Pinned(point)
        } else {
            Stop::Free(point)
        }
    };
    let mut plan = WirePlan::new(material, 2.0, (0..=SEGMENTS).map(stop).collect());
    plan.length = Some(f64::from(SEGMENTS) / (1.0 + strain));
    let mut world = World::new(weightless(step))?;
    world.add_wire(&plan)?;
    let mut samples = Vec::new();
    for _ in 0..4000 {
        world.step(&[])?;
        let nodes = (0..).zip(world.wires()[0].nodes());
        samples.push(nodes.map(|(i, node)| shape(i) * node.position.z).sum());
    }
    let expected = 2.0 * speed * libm::sin(f64::from(k) * PI / f64::from(2 * SEGMENTS));
    let measured = 2.0 * PI / period(&samples, step);
    let what = format!("mode {k}, rad/s");
    Ok(Comparison::new(what, expected, measured, 0.01))
}

pub(super) const TWIST: Case = Case {
    name: "four wires twisted",
    formula: "rise L - sqrt(L^2 - 4 R^2 sin^2(theta/2)); period 2 pi sqrt(I L / (m g R^2))",
    run: twist,
};

/// An 8 t cube that hangs on four light wires of 12 m and starts to turn; its inertia about the
/// vertical.
fn hanging_cube(spin: f64) -> Result<(World, f64), Box<dyn Error>> {
    let (length, half) = (12.0, Vector::repeat(1.0));
    let mut world = World::new(Settings::default())?;
    let plan = BodyPlan {
        drive: Drive::Dynamic {
            density: 1000.0,
            velocity: Vector::zeros(),
            angular_velocity: Vector::z() * spin,
        },
        ..BodyPlan::dynamic(Shape::Box { half }, 1000.0, at(0.0, 0.0, 0.0))
    };
    let body = world.add_body(plan)?;
    let material = Material {
        density: 78.5,
        ..Material::steel(0.02)
    };
    for local in [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]] {
        let local = Vector::new(local[0], local[1], 1.0);
        let top = at(local.x, local.y, local.z + length);
        let route = vec![Stop::Pinned(top), Stop::Eye { body, local }];
        // Pretensioned by a quarter of the weight, so that it starts where it rests.
        let weight = world.bodies()[0].mass() * -world.settings().gravity.z;
        let mut plan = WirePlan::new(material, length, route);
        plan.length = Some(length / (1.0 + weight / 4.0 / material.stretch_stiffness()));
        world.add_wire(&plan)?;
    }
    let inertia = world.bodies()[0].inertia()[(2, 2)];
    Ok((world, inertia))
}

fn twist() -> Outcome {
    let (length, radius) = (12.0, 1.0);
    let (mut world, inertia) = hanging_cube(0.02)?;
    let mass = world.bodies()[0].mass();
    let gravity = -world.settings().gravity.z;
    let mut samples = Vec::new();
    for _ in 0..3600 {
        world.step(&[])?;
        samples.push(world.bodies()[0].angular_velocity().z);
    }
    let stiffness = mass * gravity * radius * radius / length;
    let expected = 2.0 * PI * (inertia / stiffness).sqrt();
    let measured = period(&samples, world.settings().step);
    let mut comparisons = vec![Comparison::new("period, s", expected, measured, 0.01)];

    let (mut world, _) = hanging_cube(1.0)?;
    let (mut angle, mut rise) = (0.0, 0.0);
    while world.bodies()[0].angular_velocity().z > 0.0 && world.steps() < 1000 {
        world.step(&[])?;
        let body = &world.bodies()[0];
        let ahead = body.orientation() * Vector::x();
        (angle, rise) = (libm::atan2(ahead.y, ahead.x), body.position().z);
    }
    let chord = 2.0 * radius * libm::sin(angle / 2.0);
    let expected = length - (length * length - chord * chord).sqrt();
    let what = format!("rise at the largest twist, {angle:.3} rad, m");
    comparisons.push(Comparison::new(what, expected, rise, 0.01));
    Ok(comparisons)
}

pub(super) const MOMENTUM: Case = Case {
    name: "momentum",
    formula: "linear momentum of an isolated system stays",
    run: momentum,
};

fn momentum() -> Outcome {
    let mut world = World::new(weightless(1.0 / 60.0))?;
    let half = Vector::new(0.1, 0.2, 0.3);
    let plan = BodyPlan {
        drive: Drive::Dynamic {
            density: 1000.0,
            velocity: Vector::new(3.0, 1.0, -2.0),
            angular_velocity: Vector::new(5.0, 4.0, 3.0),
        },
        ..BodyPlan::dynamic(Shape::Box { half }, 1000.0, at(0.0, 0.0, 0.0))
    };
    let body = world.add_body(plan)?;
    let local = Vector::new(0.1, 0.1, 0.0);
    let end = at(5.0, 1.0, 0.0);
    let route = vec![Stop::Eye { body, local }, Stop::Free(end)];
    let mut plan = WirePlan::new(Material::steel(0.005), 0.2, route).adaptive();
    plan.velocity = Vector::new(-10.0, 0.0, 20.0);
    world.add_wire(&plan)?;
    let before = world.momentum();
    let mut changes = 0;
    for _ in 0..600 {
        changes += world.step(&[])?.remeshes.len();
    }
    let difference = (world.momentum() - before).norm() / before.norm();
    let what = format!("1 + change after 600 steps with {changes} changes of resolution");
    Ok(vec![Comparison::new(what, 1.0, 1.0 + difference, 1e-12)])
}

pub(super) const ANGULAR_MOMENTUM: Case = Case {
    name: "angular momentum",
    formula: "angular momentum of an isolated chain stays",
    run: angular_momentum,
};

/// A chain with a corner that flies and whirls. Its rows act along the line between two nodes, so
/// they have no torque, and nodes move along their velocities: nothing but rounding changes the
/// sum.
fn angular_momentum() -> Outcome {
    let mut world = World::new(weightless(1.0 / 60.0))?;
    let route = [[0.0, 0.0, 0.0], [3.0, 1.0, 0.0], [5.0, 0.0, 1.0]];
    let route = route.map(|[x, y, z]| Stop::Free(at(x, y, z))).to_vec();
    let chain = Material::steel(0.005).chain();
    let mut plan = WirePlan::new(chain, 0.2, route);
    plan.velocity = Vector::new(-10.0, 0.0, 20.0);
    world.add_wire(&plan)?;
    // A blow on the first node makes it whirl.
    let blow = ContactConstraint {
        key: 0,
        a: ContactSite::Wire {
            wire: WireId(0),
            arc: 0.0,
        },
        b: ContactSite::World,
        normal: Vector::z(),
        gap: -0.1,
        friction: 0.0,
    };
    world.step(&[blow])?;
    let before = world.angular_momentum();
    for _ in 0..120 {
        world.step(&[])?;
    }
    let difference = (world.angular_momentum() - before).norm() / before.norm();
    Ok(vec![Comparison::new(
        "1 + change after 120 steps",
        1.0,
        1.0 + difference,
        1e-12,
    )])
}

pub(super) const ENERGY: Case = Case {
    name: "energy",
    formula: "energy of the motion never rises; at the end of a step by (h/2) g . P",
    run: energy,
};

/// What energy did in some seconds, in J.
struct Rise {
    /// The most by which the energy at the end of a step was above its start.
    at_end: f64,
    /// The most by which the energy of a motion was above the first one's.
    of_motion: f64,
    /// The largest `-(h/2) g . P`.
    term: f64,
}

/// A free fall loses `m g^2 h^2 / 2` in a step, because the step moves with the velocity at its
/// end; the momentum `P` changes by `m g h`. So it keeps `E + (h/2) g . P` exactly, the energy
/// halfway through its motion, and what moves on wires has the same term: rising, it shows more
/// energy at the end than it has.
fn rise(world: &mut World, seconds: f64) -> Result<Rise, Box<dyn Error>> {
    let settings = world.settings().clone();
    let start = world.energy().total();
    let first = start + settings.step / 2.0 * settings.gravity.dot(&world.momentum());
    let mut rise = Rise {
        at_end: 0.0,
        of_motion: 0.0,
        term: 0.0,
    };
    while world.time() < seconds {
        let record = world.step(&[])?;
        let term = -settings.step / 2.0 * settings.gravity.dot(&world.momentum());
        rise.at_end = rise.at_end.max(record.energy_at_end.total() - start);
        rise.of_motion = rise.of_motion.max(record.energy.total() - first);
        rise.term = rise.term.max(term);
    }
    Ok(rise)
}

fn stepped(step: f64) -> Result<World, Box<dyn Error>> {
    Ok(World::new(Settings::default().with_step(step))?)
}

/// A bob of 33 kg on one segment of steel wire that starts 37 degrees from the vertical, 1 m above
/// its lowest place; and the energy of that.
fn swing(step: f64) -> Result<(Rise, f64), Box<dyn Error>> {
    let mut world = stepped(step)?;
    let bob = Shape::Sphere { radius: 0.1 };
    let body = world.add_body(BodyPlan::dynamic(bob, 7850.0, at(3.0, 0.0, -4.0)))?;
    let local = Vector::zeros();
    let route = vec![Stop::Pinned(at(0.0, 0.0, 0.0)), Stop::Eye { body, local }];
    world.add_wire(&WirePlan::new(Material::steel(0.005), 5.0, route))?;
    let weight = -world.bodies()[0].mass() * world.settings().gravity.z;
    Ok((rise(&mut world, 5.0)?, weight))
}

/// A steel wire between two pins that starts with a sharp bend in its middle; and the energy of
/// that.
fn spring(step: f64) -> Result<(Rise, f64), Box<dyn Error>> {
    let mut world = stepped(step)?;
    let route = vec![
        Stop::Pinned(at(-4.0, 0.0, 0.0)),
        Stop::Free(at(0.0, 0.0, 3.0)),
        Stop::Pinned(at(4.0, 0.0, 0.0)),
    ];
    world.add_wire(&WirePlan::new(Material::steel(0.01), 0.3125, route))?;
    let start = world.energy().total();
    Ok((rise(&mut world, 5.0)?, start))
}

/// A chain of 6 m whose ends are pinned 4 m apart, which starts upright and is caught by its ends;
/// and the energy that it loses by the fall, without what it has left of its motion.
fn caught(step: f64) -> Result<(Rise, f64), Box<dyn Error>> {
    let mut world = stepped(step)?;
    let route = vec![
        Stop::Pinned(at(-2.0, 0.0, 0.0)),
        Stop::Free(at(0.0, 0.0, 5.0f64.sqrt())),
        Stop::Pinned(at(2.0, 0.0, 0.0)),
    ];
    let chain = Material::steel(0.0025).chain();
    world.add_wire(&WirePlan::new(chain, 0.1, route))?;
    let start = world.energy().potential;
    let rise = rise(&mut world, 5.0)?;
    Ok((rise, start - world.energy().potential))
}

fn energy() -> Outcome {
    let (fine, swung) = swing(1.0 / 240.0)?;
    let (sprung, start) = spring(1.0 / 240.0)?;
    let sprung = 1.0 + sprung.of_motion / start;
    let (caught, fallen) = caught(1.0 / 60.0)?;
    let caught = 1.0 + caught.of_motion / fallen;
    Ok(vec![
        Comparison::new(
            "rise at the end for h = 1/240 s, J",
            fine.term,
            fine.at_end,
            0.1,
        ),
        Comparison::new(
            "1 + rise of the motion over the swing, h = 1/240 s",
            1.0,
            1.0 + fine.of_motion / swung,
            1e-4,
        ),
        Comparison::new("1 + rise of the motion, sharply bent", 1.0, sprung, 1e-6),
        Comparison::new(
            "1 + rise of the motion over the fall, chain caught",
            1.0,
            caught,
            1e-6,
        ),
    ])
}

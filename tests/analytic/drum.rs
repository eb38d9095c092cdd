//! Wire that slides over a drum: held by friction, drawn over it, and free to run.

use std::error::Error;
use std::f64::consts::PI;

use nalgebra::UnitQuaternion;

use super::{Case, Comparison, weightless};
use tunnelproof::query::Point;
use tunnelproof::wire::{
    Body, BodyId, BodyPlan, Collisions, Drive, Material, NodeKind, Phase, ReelPhase, RopePlan,
    Settings, Shape, Stop, Vector, Wire, WirePlan, World,
};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

const RADIUS: f64 = 0.5;
const FRICTION: f64 = 0.3;

/// From the axis of a drum to a place on it, by the angle from x to z.
fn direction(angle: f64) -> Vector {
    Vector::new(libm::cos(angle), 0.0, libm::sin(angle))
}

/// A fixed drum along y about the origin, and contact nodes on it at these angles.
fn drum(world: &mut World, friction: f64, angles: &[f64]) -> Result<Vec<Stop>, Box<dyn Error>> {
    let shape = Shape::Cylinder {
        radius: RADIUS,
        half_height: 1.0,
    };
    let axis = UnitQuaternion::rotation_between(&Vector::z(), &Vector::y());
    let mut plan = BodyPlan::fixed(shape, Point::origin());
    plan.orientation = axis.ok_or("z and y are not opposite")?;
    let body = world.add_body(plan)?;
    let drum = world.body(body)?;
    let node = |&angle: &f64| contact_node(body, drum, RADIUS, angle, friction);
    Ok(angles.iter().map(node).collect())
}

/// A contact node on a drum along y, so far from its axis.
fn contact_node(id: BodyId, drum: &Body, reach: f64, angle: f64, friction: f64) -> Stop {
    let normal = drum.orientation().inverse() * direction(angle);
    Stop::Contact {
        body: id,
        local: normal * reach,
        normal,
        friction,
    }
}

/// An eye on a small ball that is drawn at velocities, each from a time on.
fn drawn(
    world: &mut World,
    at: Point,
    velocities: &[(f64, Vector)],
) -> Result<Stop, Box<dyn Error>> {
    let phases = velocities.iter().map(|&(from, velocity)| Phase {
        from,
        velocity,
        angular_velocity: Vector::zeros(),
    });
    let body = world.add_body(BodyPlan {
        drive: Drive::Kinematic(phases.collect()),
        ..BodyPlan::fixed(Shape::Sphere { radius: 0.1 }, at)
    })?;
    let local = Vector::zeros();
    Ok(Stop::Eye { body, local })
}

/// `e^(f pi)`, of a wire that turns half around a drum.
fn bound() -> f64 {
    libm::exp(FRICTION * PI)
}

pub(super) const CAPSTAN: Case = Case {
    name: "capstan",
    formula: "T2/T1 = e^(f theta)",
    run: capstan,
};

/// A chain half around a drum, over 12 nodes that turn it by 15 degrees each, pulled until it
/// slides, and held then.
fn capstan() -> Outcome {
    const NODES: i32 = 12;
    let turn = PI / f64::from(NODES);
    let mut world = World::new(weightless(1.0 / 60.0))?;
    let angles: Vec<f64> = (0..NODES).map(|i| f64::from(i) * turn).collect();
    let nodes = drum(&mut world, FRICTION, &angles)?;
    // Each leg turns by a whole node against the chord next to it.
    let leg = |angle: f64, side: f64| {
        let along = direction(angle + side * turn / 2.0 + PI / 2.0) * side;
        (Point::from(direction(angle) * RADIUS + along * 2.0), along)
    };
    let ((start, _), (end, away)) = (leg(0.0, -1.0), leg(PI - turn, 1.0));
    let puller = drawn(
        &mut world,
        end,
        &[(0.0, away * 0.01), (2.0, Vector::zeros())],
    )?;
    let mut route = vec![Stop::Pinned(start)];
    route.extend(nodes);
    route.push(puller);
    world.add_wire(&WirePlan::new(Material::steel(0.02).chain(), 10.0, route))?;
    while world.time() < 4.0 {
        world.step(&[])?;
    }
    let segments = world.wires()[0].segments();
    let measured = segments[segments.len() - 1].tension / segments[0].tension;
    let what = "ratio of tensions";
    Ok(vec![Comparison::new(what, bound(), measured, 0.005)])
}

/// Nodes of the drum of a hoist.
const CORNERS: i32 = 6;
/// How far the ends hang below the axis at first, in m.
const DEPTH: f64 = 6.0;
const LOAD: f64 = 100.0;

/// An adaptive steel chain of radius 0.01 m from a load up, over six nodes, and straight down again
/// to what `other` puts there.
fn hoist(
    friction: f64,
    other: impl Fn(&mut World, Point) -> Result<Stop, Box<dyn Error>>,
) -> Result<World, Box<dyn Error>> {
    let mut world = World::new(Settings::default())?;
    let turn = PI / f64::from(CORNERS);
    let angles: Vec<f64> = (0..CORNERS)
        .map(|i| PI - (f64::from(i) + 0.5) * turn)
        .collect();
    let nodes = drum(&mut world, friction, &angles)?;
    let aside = RADIUS * libm::cos(turn / 2.0);
    let mut route = vec![load(&mut world, LOAD, Point::new(-aside, 0.0, -DEPTH))?];
    route.extend(nodes);
    route.push(other(&mut world, Point::new(aside, 0.0, -DEPTH))?);
    let material = Material::steel(0.01).chain();
    world.add_wire(&WirePlan::new(material, 0.5, route).adaptive())?;
    Ok(world)
}

/// An eye in a ball of a mass in kg.
fn load(world: &mut World, mass: f64, at: Point) -> Result<Stop, Box<dyn Error>> {
    let radius = 0.2;
    let density = mass / (4.0 / 3.0 * PI * radius * radius * radius);
    let body = world.add_body(BodyPlan::dynamic(Shape::Sphere { radius }, density, at))?;
    let local = Vector::zeros();
    Ok(Stop::Eye { body, local })
}

/// The first and the last segment that is not on the drum, seen from it.
fn beside_drum(wire: &Wire) -> Option<[usize; 2]> {
    let is_on = |node: &tunnelproof::wire::Node| matches!(node.kind, NodeKind::Contact { .. });
    let first = wire.nodes().iter().position(is_on)?;
    let last = wire.nodes().iter().rposition(is_on)?;
    Some([first - 1, last])
}

pub(super) const HOIST: Case = Case {
    name: "load drawn over a drum",
    formula: "T1 = (m + mu L1) g, T2 = e^(f pi) T1 + 2 mu g R f (1 + e^(f pi)) / (1 + f^2)",
    run: hoisting,
};

/// A load that is drawn up at 1 m/s.
fn hoisting() -> Outcome {
    let down = -Vector::z();
    let velocities = [(0.0, down * 0.1), (0.5, down)];
    let mut world = hoist(FRICTION, |world, end| drawn(world, end, &velocities))?;
    let (mut ratio, mut pull, mut expected, mut count) = (0.0, 0.0, 0.0, 0.0);
    let bound = bound();
    while world.time() < 3.0 {
        world.step(&[])?;
        if world.time() <= 1.0 {
            continue;
        }
        let wire = &world.wires()[0];
        let [first, last] = beside_drum(wire).ok_or("the wire has left the drum")?;
        let weight = wire.material().mass_per_length() * -world.settings().gravity.z;
        // A segment has the tension of its middle; at the drum there is half of its weight more.
        let tensions = [first, last].map(|segment| {
            wire.segments()[segment].tension + weight * wire.rest_length(segment) / 2.0
        });
        // The weight of the wire on the drum, of which friction carries a part on each side.
        let on_drum =
            2.0 * weight * RADIUS * FRICTION * (1.0 + bound) / (1.0 + FRICTION * FRICTION);
        ratio += (tensions[1] - on_drum) / tensions[0];
        pull += tensions[1];
        let hanging = weight * wire.nodes()[first + 1].arc;
        expected += (LOAD * -world.settings().gravity.z + hanging) * bound + on_drum;
        count += 1.0;
    }
    Ok(vec![
        Comparison::new("mean ratio of tensions", bound, ratio / count, 0.005),
        Comparison::new("mean pull, N", expected / count, pull / count, 0.005),
    ])
}

pub(super) const ATWOOD: Case = Case {
    name: "Atwood's machine",
    formula: "v = k d / (2 mu) sinh(k t), k^2 = 2 mu g / M with the difference d and the sum M of \
    the masses",
    run: atwood,
};

/// Two loads on one chain over a drum without friction.
fn atwood() -> Outcome {
    const OTHER: f64 = 150.0;
    let mut world = hoist(0.0, |world, end| load(world, OTHER, end))?;
    let wire = &world.wires()[0];
    let density = wire.material().mass_per_length();
    let length = wire.nodes()[wire.nodes().len() - 1].arc;
    let g = -world.settings().gravity.z;
    while world.time() < 1.0 {
        world.step(&[])?;
    }
    let mass = LOAD + OTHER + density * length;
    let k = (2.0 * density * g / mass).sqrt();
    let expected = (OTHER - LOAD) / (2.0 * density) * k * libm::sinh(k * world.time());
    let speeds = [1, 2].map(|body| world.bodies()[body].velocity().z);
    let what = [
        "load that rises after 1 s, m/s",
        "load that falls after 1 s, m/s",
    ];
    let pairs = what.into_iter().zip([expected, -expected]).zip(speeds);
    let rows = pairs.map(|((what, expected), speed)| Comparison::new(what, expected, speed, 0.005));
    Ok(rows.collect())
}

pub(super) const BLOCK: Case = Case {
    name: "block that turns",
    formula: "both legs carry m g / 2, whatever the friction; the reel does m g z",
    run: block,
};

/// A block of 20 kg with a load of 200 kg on its axis hangs in a rope over contact nodes, and rolls up it as one leg is hauled
/// in.
fn block() -> Outcome {
    const REACH: f64 = 0.108;
    let shape = Shape::Cylinder {
        radius: 0.1,
        half_height: 0.1,
    };
    let axis = UnitQuaternion::rotation_between(&Vector::z(), &Vector::y());
    let axis = axis.ok_or("z and y are not opposite")?;
    let rope = Material::rope(RopePlan {
        radius: 0.008,
        mass_per_length: 0.3,
        stretch_stiffness: 1e6,
        bend_stiffness: 0.0,
        twist_stiffness: 0.0,
    })?;
    let mut rows = Vec::new();
    for rate in [30.0, 60.0, 240.0] {
        let mut world = World::new(Settings::default().with_step(1.0 / rate))?;
        let mut plan = BodyPlan::dynamic(shape.clone(), 1000.0 / PI * 10.0, Point::origin());
        plan.orientation = axis;
        let body = world.add_body(plan)?;
        let half = Vector::from_element(0.2);
        let load = BodyPlan::dynamic(Shape::Box { half }, 3125.0, Point::new(0.0, 0.0, -1.2));
        let load = world.add_body(load)?;
        let on = world.body(body)?;
        let node = |k: u32| {
            let angle = PI * (1.0 + f64::from(k) / 6.0);
            contact_node(body, on, REACH, angle, FRICTION)
        };
        let top = |x: f64| Stop::Pinned(Point::new(x, 0.0, 10.0));
        let mut route = vec![top(-REACH)];
        route.extend((0..7).map(node));
        route.push(top(REACH));
        let speeds = [(0.5, -0.25), (1.0, -0.5), (3.0, -0.25), (3.5, 0.0)];
        let phases = speeds.map(|(from, speed)| ReelPhase { from, speed });
        world.add_wire(
            &WirePlan::new(rope, 0.25, route)
                .adaptive()
                .reeled(phases.to_vec()),
        )?;
        for side in [-1.0, 1.0] {
            let eye = |body, local| Stop::Eye { body, local };
            let route = vec![
                eye(body, Vector::z() * (0.12 * side)),
                eye(load, Vector::new(0.0, 0.12 * side, 0.2)),
            ];
            world.add_wire(&WirePlan::new(rope, 1.0, route))?;
        }
        let mut collisions = Collisions::default().with_friction(FRICTION)?;
        let (mut legs, mut work) = ([0.0; 2], 0.0);
        let start = world.energy().potential;
        while world.time() < 4.0 {
            let record = world.step_colliding(&mut collisions, &[])?;
            work += record.work;
            if world.time() > 1.5 && world.time() < 3.0 {
                let tensions = &record.wires[0].tensions;
                // Beside what holds each leg.
                legs[0] += tensions[0];
                legs[1] += tensions[tensions.len() - 1];
            }
        }
        let what = |what: &str| format!("h = 1/{rate:.0} s: {what}");
        let lifted = world.energy().potential - start;
        rows.push(Comparison::new(
            what("one leg over the other"),
            1.0,
            legs[0] / legs[1],
            0.01,
        ));
        rows.push(Comparison::new(
            what("work of the reel, J"),
            lifted,
            work,
            0.03,
        ));
    }
    Ok(rows)
}

//! What touches: incline, crossing wires.

use std::error::Error;

use nalgebra::UnitQuaternion;

use super::{Case, Comparison, at, settle};
use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyId, BodyPlan, ContactConstraint, ContactSite, Material, Settings, Shape, Stop, Vector,
    WireId, WirePlan, World,
};

type Outcome = Result<Vec<Comparison>, Box<dyn Error>>;

pub(super) const INCLINE: Case = Case {
    name: "incline",
    formula: "sticks if and only if tan(alpha) <= f",
    run: incline,
};

fn incline() -> Outcome {
    let friction = 0.5;
    let mut bracket = [0.9 * friction, 1.1 * friction];
    for _ in 0..9 {
        let slope = (bracket[0] + bracket[1]) / 2.0;
        let slides = slides_down(slope, friction)?;
        bracket[usize::from(slides)] = slope;
    }
    let limit = (bracket[0] + bracket[1]) / 2.0;
    let what = "steepest slope that holds";
    Ok(vec![Comparison::new(what, friction, limit, 0.01)])
}

/// Whether a box on an incline with this tangent is further than 1 mm after 1 s.
fn slides_down(slope: f64, friction: f64) -> Result<bool, Box<dyn Error>> {
    let normal = Vector::new(-slope, 0.0, 1.0).normalize();
    let half = Vector::new(0.5, 0.5, 0.25);
    let mut world = World::new(Settings::default())?;
    let mut plan = BodyPlan::dynamic(Shape::Box { half }, 1000.0, Point::from(normal * half.z));
    let upright = UnitQuaternion::rotation_between(&Vector::z(), &normal);
    plan.orientation = upright.ok_or("the incline is not upside down")?;
    let start = plan.position;
    let body = world.add_body(plan)?;
    while world.time() < 1.0 {
        let contacts = resting(&world, body, &half, &normal, friction);
        world.step(&contacts)?;
    }
    Ok((world.bodies()[0].position() - start).norm() > 1e-3)
}

/// The four lower corners of a box against a plane through the origin.
fn resting(
    world: &World,
    body: BodyId,
    half: &Vector,
    normal: &Vector,
    friction: f64,
) -> Vec<ContactConstraint> {
    let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    let contact = |(key, [x, y]): (u64, [f64; 2])| {
        let local = half.component_mul(&Vector::new(x, y, -1.0));
        ContactConstraint {
            key,
            a: ContactSite::Body { body, local },
            b: ContactSite::World,
            normal: *normal,
            gap: world.bodies()[body.0].point(&local).coords.dot(normal),
            friction,
        }
    };
    (0..).zip(corners).map(contact).collect()
}

pub(super) const CROSSING: Case = Case {
    name: "crossing wires at rest",
    formula: "sum of normals = m g; sag^3 = P L^3 / (8 E A)",
    run: crossing,
};

/// A steel wire of 2 m that lies across two light chains of 2 m.
fn crossing() -> Outcome {
    let mut world = World::new(Settings::default())?;
    let thin = Material {
        density: 78.5,
        ..Material::steel(0.005).chain()
    };
    let mut supports = Vec::new();
    for x in [-0.5, 0.5] {
        let ends = [at(x, -1.0, 0.0), at(x, 1.0, 0.0)];
        supports.push(world.add_wire(&WirePlan::new(
            thin,
            0.25,
            ends.map(Stop::Pinned).to_vec(),
        ))?);
    }
    let thick = Material::steel(0.02);
    let ends = [at(-1.0, 0.0, 0.0251), at(1.0, 0.0, 0.0251)];
    let plan = WirePlan::new(thick, 0.25, ends.map(Stop::Free).to_vec());
    let lying = world.add_wire(&plan)?;
    let contacts = |world: &World| {
        let pairs = supports.iter().zip([0.5, 1.5]);
        pairs
            .map(|(&support, arc)| crossing_contact(world, lying, arc, support, 0.025))
            .collect()
    };
    settle(&mut world, &contacts, 1e-7, 20_000)?;
    let list = contacts(&world);
    let record = world.step(&list)?;
    let normals: f64 = record.contacts.iter().map(|c| c.normal_force()).sum();
    let weight = thick.mass_per_length() * 2.0 * -world.settings().gravity.z;
    let sag = -world.wires()[supports[0].0].nodes()[4].position.z;
    let expected = weight / 2.0 * 8.0 / (8.0 * thin.stretch_stiffness());
    Ok(vec![
        Comparison::new("sum of normals, N", weight, normals, 0.01),
        Comparison::new("sag^3, m^3", expected, sag * sag * sag, 0.03),
    ])
}

/// The contact of two wires at two nodes, by the vector between them.
fn crossing_contact(
    world: &World,
    above: WireId,
    arc: f64,
    below: WireId,
    reach: f64,
) -> ContactConstraint {
    let node = |wire: WireId, arc: f64| {
        let wire = &world.wires()[wire.0];
        wire.nodes()[wire.at(arc).0].position
    };
    let between = node(above, arc) - node(below, 1.0);
    ContactConstraint {
        key: below.0 as u64,
        a: ContactSite::Wire { wire: above, arc },
        b: ContactSite::Wire {
            wire: below,
            arc: 1.0,
        },
        normal: between.normalize(),
        gap: between.norm() - reach,
        friction: 0.5,
    }
}

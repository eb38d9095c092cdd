use crate::query::Point;
use crate::wire::model::{BodyPlan, Material, Shape, Stop, WirePlan};
use crate::wire::settings::Settings;
use crate::wire::vector::Vector;
use crate::wire::world::World;

/// A load under a slack chain between a pin and the load, which falls until the chain catches it.
fn caught(mass: f64, rate: f64, adaptive: bool) -> World {
    const REACH: f64 = 0.6;
    let mut world = World::new(Settings::default().with_step(1.0 / rate)).unwrap();
    let shape = Shape::Sphere { radius: 0.1 };
    let density = mass / (4.0 / 3.0 * std::f64::consts::PI * 1e-3);
    let load = BodyPlan::dynamic(shape, density, Point::new(REACH, 0.0, 0.0));
    let body = world.add_body(load).unwrap();
    let area = std::f64::consts::PI * 1e-4;
    let material = Material {
        density: 0.4 / area,
        stretch_modulus: 1e6 / area,
        ..Material::steel(0.01).chain()
    };
    let between = (1..20).map(|node| {
        let part = f64::from(node) / 20.0;
        Stop::Free(Point::new(REACH * part, 0.0, -3.6 * part * (1.0 - part)))
    });
    let mut route = vec![Stop::Pinned(Point::origin())];
    route.extend(between);
    let local = Vector::zeros();
    route.push(Stop::Eye { body, local });
    let mut plan = WirePlan::new(material, 0.1, route);
    plan.resolution.adaptive = adaptive;
    world.add_wire(&plan).unwrap();
    world
}

#[test]
fn load_that_a_slack_chain_catches_is_thrown_no_higher_than_it_was() {
    for (mass, rate, adaptive) in [
        (33.0, 60.0, false),
        (33.0, 60.0, true),
        (33.0, 30.0, false),
        (33.0, 240.0, false),
        (330.0, 60.0, false),
        (4.2, 60.0, true),
    ] {
        let mut world = caught(mass, rate, adaptive);
        let start = world.kinetic_energy() + world.potential_energy();
        // What the load falls by.
        let fall = mass * 9.81 * 1.8;
        let mut pulled = 0.0f64;
        for _ in 0..(3.0 * rate) as usize {
            let record = world.step(&[]).unwrap();
            pulled = record.wires[0]
                .tensions
                .iter()
                .fold(pulled, |a, b| a.max(*b));
            // Changes of resolution cut corners, which moves them by a hair.
            let now = record.energy.kinetic + record.energy.potential;
            assert!(
                now < start + 1e-3 * fall,
                "{mass} kg, 1/{rate} s, {adaptive}: {now} J of {start} J"
            );
        }
        // It was caught, and hangs.
        let z = world.bodies()[0].position().z;
        assert!(
            pulled > 5.0 * mass * 9.81 && (-2.2..-1.4).contains(&z),
            "{pulled} N, {z} m"
        );
    }
}

//! Scenes with contacts that are hard to solve for.

use std::f64::consts::TAU;

use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyPlan, Drive, Material, ModelError, Phase, Settings, Shape, Stop, Vector, WirePlan, World,
};

/// A scene by name.
pub(crate) struct Scene {
    pub(crate) name: &'static str,
    pub(crate) make: fn() -> Result<World, ModelError>,
    pub(crate) steps: usize,
    /// The share of the thickness that is guarded.
    pub(crate) thickness: Option<f64>,
}

pub(crate) const SCENES: &[Scene] = &[
    Scene {
        name: "net",
        make: net,
        steps: 60,
        thickness: None,
    },
    Scene {
        name: "heap",
        make: heap,
        steps: 120,
        thickness: Some(0.5),
    },
    Scene {
        name: "mats",
        make: mats,
        steps: 60,
        thickness: None,
    },
    Scene {
        name: "many",
        make: many,
        steps: 60,
        thickness: None,
    },
    Scene {
        name: "press",
        make: press,
        steps: 60,
        thickness: None,
    },
];

/// A net of 12 by 12 ropes that are not tied catches 20 kg at 20 m/s.
fn net() -> Result<World, ModelError> {
    let mut world = World::new(Settings::default())?;
    let radius = 0.15_f64;
    let volume = TAU * 2.0 / 3.0 * radius.powi(3);
    world.add_body(BodyPlan {
        drive: Drive::Dynamic {
            density: 20.0 / volume,
            velocity: Vector::new(0.0, 0.0, -20.0),
            angular_velocity: Vector::zeros(),
        },
        ..BodyPlan::fixed(Shape::Sphere { radius }, Point::new(0.03, 0.02, 0.4))
    })?;
    let mut material = Material::steel(0.006).chain();
    material.density = 1200.0;
    material.stretch_modulus = 2e7;
    for k in 0..12 {
        let at = 0.1 * (k as f64 - 5.5);
        for (from, to) in [
            (Point::new(-0.7, at, 0.0), Point::new(0.7, at, 0.0)),
            (Point::new(at, -0.7, -0.013), Point::new(at, 0.7, -0.013)),
        ] {
            let route = vec![Stop::Pinned(from), Stop::Pinned(to)];
            world.add_wire(&WirePlan::new(material, 0.1, route))?;
        }
    }
    Ok(world)
}

/// 200 segments of chain in a coil, each shorter than the chain is thick, fall onto a floor.
fn heap() -> Result<World, ModelError> {
    let mut world = World::new(Settings::default())?;
    world.add_body(BodyPlan::fixed(Shape::Plane, Point::origin()))?;
    let route = (0..=200).map(|k| {
        let (sin, cos) = (0.26 * k as f64).sin_cos();
        Stop::Free(Point::new(
            0.03 * cos,
            0.03 * sin,
            0.02 + 0.00166 * k as f64,
        ))
    });
    let mut plan = WirePlan::new(Material::steel(0.005).chain(), 0.008, route.collect());
    plan.resolution.adaptive = false;
    world.add_wire(&plan)?;
    Ok(world)
}

/// 53 wires side by side on a floor, and 53 across them.
fn mats() -> Result<World, ModelError> {
    let mut world = World::new(Settings::default())?;
    world.add_body(BodyPlan::fixed(Shape::Plane, Point::origin()))?;
    let length = 53.0 * 0.05;
    for k in 0..53 {
        let at = 0.05 * (k as f64 + 0.5);
        for (from, to) in [
            (Point::new(0.0, at, 0.0051), Point::new(length, at, 0.0051)),
            (Point::new(at, 0.0, 0.0153), Point::new(at, length, 0.0153)),
        ] {
            let route = vec![Stop::Free(from), Stop::Free(to)];
            let mut plan = WirePlan::new(Material::steel(0.005), 0.05, route);
            plan.resolution.adaptive = false;
            world.add_wire(&plan)?;
        }
    }
    Ok(world)
}

/// 200 wires side by side on a floor, which do not touch each other.
fn many() -> Result<World, ModelError> {
    let mut world = World::new(Settings::default())?;
    world.add_body(BodyPlan::fixed(Shape::Plane, Point::origin()))?;
    for k in 0..200 {
        let at = |x: f64| Stop::Free(Point::new(x, 0.05 * f64::from(k), 0.006));
        let route = vec![at(0.0), at(2.5)];
        let mut plan = WirePlan::new(Material::steel(0.005), 0.05, route);
        plan.resolution.adaptive = false;
        world.add_wire(&plan)?;
    }
    Ok(world)
}

/// Two plates that close on a tangle of pinned chains.
fn press() -> Result<World, ModelError> {
    let mut world = World::new(Settings::default())?;
    for side in [-1.0, 1.0] {
        world.add_body(BodyPlan {
            drive: Drive::Kinematic(vec![Phase {
                from: 0.0,
                velocity: Vector::new(0.0, 0.0, -2.0 * side),
                angular_velocity: Vector::new(0.0, 0.0, 3.0 * side),
            }]),
            ..BodyPlan::fixed(
                Shape::Box {
                    half: Vector::new(0.5, 0.3, 0.01),
                },
                Point::new(0.0, 0.0, 0.5 * side),
            )
        })?;
    }
    for k in 0..6 {
        let (sin, cos) = (TAU * k as f64 / 6.0 + 0.1).sin_cos();
        let height = 0.05 * (k as f64 - 2.5);
        let route = vec![
            Stop::Pinned(Point::new(cos, sin, height)),
            Stop::Free(Point::new(-0.1 * sin, 0.1 * cos, 0.3 * height)),
            Stop::Pinned(Point::new(-cos, -sin, -height)),
        ];
        world.add_wire(&WirePlan::new(Material::steel(0.005).chain(), 0.1, route))?;
    }
    Ok(world)
}

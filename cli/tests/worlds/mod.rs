//! Worlds that take every part of a step.

use tunnelproof::query::Point;
use tunnelproof::wire::{
    BodyId, BodyPlan, ContactConstraint, ContactSite, Drive, Material, Mesh, Phase, Settings,
    Shape, Stop, Vector, WirePlan, World,
};

/// A tumbling box between an adaptive steel wire and a chain, which hits the ground.
pub(crate) fn tumbling_box() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let half = Vector::new(0.3, 0.4, 0.5);
    let plan = BodyPlan {
        drive: Drive::Dynamic {
            density: 2000.0,
            velocity: Vector::new(1.0, 2.0, 3.0),
            angular_velocity: Vector::new(4.0, 5.0, -6.0),
        },
        ..BodyPlan::dynamic(Shape::Box { half }, 2000.0, Point::new(0.0, 0.0, 0.7))
    };
    let body = world.add_body(plan).unwrap();
    let local = Vector::new(0.3, 0.4, 0.5);
    let top = Stop::Pinned(Point::new(0.0, 1.0, 5.0));
    let steel = Material::steel(0.01);
    let plan = WirePlan::new(steel, 0.25, vec![top, Stop::Eye { body, local }]);
    world.add_wire(&plan.adaptive()).unwrap();
    let local = -local;
    let side = Stop::Free(Point::new(4.0, 1.0, 3.0));
    let plan = WirePlan::new(steel.chain(), 0.25, vec![side, Stop::Eye { body, local }]);
    world.add_wire(&plan).unwrap();
    world
}

/// Every corner of the box against the ground.
pub(crate) fn contacts(world: &World) -> Vec<ContactConstraint> {
    let corner = |key: u64| {
        let sign = |bit: u64| if key >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let local = Vector::new(0.3 * sign(0), 0.4 * sign(1), 0.5 * sign(2));
        let body = BodyId(0);
        ContactConstraint {
            key,
            a: ContactSite::Body { body, local },
            b: ContactSite::World,
            normal: Vector::z(),
            gap: world.bodies()[0].point(&local).z,
            friction: 0.5,
        }
    };
    (0..8).map(corner).collect()
}

/// Bodies of every shape that fall on each other and on a plane, and a wire and a chain on top.
pub(crate) fn heap() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let (radius, half_height) = (0.2, 0.3);
    let half = Vector::new(0.3, 0.2, 0.25);
    let corners = [
        [0.0, 0.0, 0.0],
        [0.9, 0.0, 0.0],
        [0.0, 0.8, 0.0],
        [0.0, 0.0, 0.7],
    ];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mesh = Mesh::new(corners.map(Point::from).to_vec(), triangles).unwrap();
    let shapes = [
        Shape::Box { half },
        Shape::Cylinder {
            radius,
            half_height,
        },
        Shape::Sphere { radius },
        Shape::Capsule {
            radius,
            half_height,
        },
        Shape::Mesh(mesh),
    ];
    let ground = BodyPlan::fixed(Shape::Plane, Point::origin());
    world.add_body(ground).unwrap();
    for (k, shape) in shapes.into_iter().enumerate() {
        let k = k as f64;
        let drive = Drive::Dynamic {
            density: 500.0 + 100.0 * k,
            velocity: Vector::new(0.5 - 0.2 * k, 0.1 * k, -1.0),
            angular_velocity: Vector::new(1.0, k - 2.0, 0.5),
        };
        let position = Point::new(0.4 * k - 0.8, 0.0, 0.6 + 0.1 * k);
        let plan = BodyPlan::fixed(shape, position);
        world.add_body(BodyPlan { drive, ..plan }).unwrap();
    }
    for (y, material) in [
        (-0.1, Material::steel(0.01)),
        (0.1, Material::steel(0.01).chain()),
    ] {
        let route = [-1.5, 1.5].map(|x| Stop::Free(Point::new(x, y, 1.6)));
        let plan = WirePlan::new(material, 0.15, route.to_vec());
        world.add_wire(&plan.adaptive()).unwrap();
    }
    world
}

/// A chain over three nodes of a ball, between two loads of which one is heavier.
pub(crate) fn hoist() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let radius = 0.5;
    let ball = BodyPlan::fixed(Shape::Sphere { radius }, Point::origin());
    let ball = world.add_body(ball).unwrap();
    let mut load = |density, x| {
        let plan = BodyPlan::dynamic(
            Shape::Sphere { radius: 0.2 },
            density,
            Point::new(x, 0.0, -4.0),
        );
        let body = world.add_body(plan).unwrap();
        let local = Vector::zeros();
        Stop::Eye { body, local }
    };
    let ends = [load(1000.0, -0.5), load(6000.0, 0.5)];
    let normals = [[-1.0, 0.25], [0.0, 1.0], [1.0, 0.25]];
    let over = normals.map(|[x, z]| {
        let normal = Vector::new(x, 0.0, z);
        Stop::Contact {
            body: ball,
            local: normal.normalize() * radius,
            normal,
            friction: 0.2,
        }
    });
    let route = [&ends[..1], &over, &ends[1..]].concat();
    let plan = WirePlan::new(Material::steel(0.01).chain(), 0.25, route);
    world.add_wire(&plan.adaptive()).unwrap();
    world
}

/// A chain that slides off the edge of a cube, and one that is thrown over it.
pub(crate) fn edge() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let half = Vector::repeat(0.5);
    let cube = BodyPlan::fixed(Shape::Box { half }, Point::new(0.0, 0.0, -0.5));
    world.add_body(cube).unwrap();
    let chain = Material::steel(0.005).chain();
    let route = [[0.0, 0.0, 0.005], [0.505, 0.0, 0.005], [0.505, 0.0, -2.0]];
    let route = route.map(|point| Stop::Free(point.into()));
    let plan = WirePlan::new(chain, 0.25, route.to_vec());
    world.add_wire(&plan.adaptive()).unwrap();
    let route = [[-1.0, 0.2, 0.1], [1.0, 0.3, 0.1]].map(|point| Stop::Free(point.into()));
    let mut plan = WirePlan::new(chain, 0.25, route.to_vec());
    plan.velocity = Vector::new(0.5, 0.0, -3.0);
    world.add_wire(&plan.adaptive()).unwrap();
    world
}

/// A rod between a clamp and a box that falls, twisted by ten turns, and a turned shaft around a corner.
pub(crate) fn twisted() -> World {
    let mut world = World::new(Settings::default()).unwrap();
    let half = Vector::new(0.2, 0.1, 0.15);
    let load = BodyPlan::dynamic(Shape::Box { half }, 2000.0, Point::new(2.0, 0.0, 0.0));
    let load = world.add_body(load).unwrap();
    let drive = Drive::Kinematic(vec![Phase {
        from: 0.25,
        velocity: Vector::zeros(),
        angular_velocity: Vector::new(0.0, 12.0, 0.0),
    }]);
    let chuck = BodyPlan::fixed(Shape::Sphere { radius: 0.05 }, Point::new(1.0, 3.0, 0.0));
    let chuck = world.add_body(BodyPlan { drive, ..chuck }).unwrap();
    let eye = |body, local: [f64; 3]| Stop::Eye {
        body,
        local: local.into(),
    };
    let pinned = |at: [f64; 3]| Stop::Pinned(at.into());
    let free = |at: [f64; 3]| Stop::Free(at.into());
    let material = Material {
        twist_modulus: 7.9e10,
        ..Material::steel(0.004)
    };
    let rod = vec![
        pinned([-0.01, 0.0, 0.0]),
        pinned([0.0, 0.0, 0.0]),
        free([0.9, 0.02, 0.01]),
        eye(load, [-0.2, 0.0, 0.0]),
        eye(load, [-0.19, 0.0, 0.0]),
    ];
    let plan = WirePlan::new(material, 0.1, rod).adaptive();
    world.add_wire(&plan.twisted(62.8)).unwrap();
    let shaft = vec![
        pinned([-0.01, 2.0, 0.0]),
        pinned([0.0, 2.0, 0.0]),
        free([0.6, 2.1, 0.0]),
        free([0.9, 2.4, 0.0]),
        eye(chuck, [0.0, 0.0, 0.0]),
        eye(chuck, [0.0, 0.01, 0.0]),
    ];
    world
        .add_wire(&WirePlan::new(material, 0.1, shaft))
        .unwrap();
    world
}

use super::*;
use crate::query::Point;
use crate::wire::Vector;
use crate::wire::model::{Drive, Material, NodeKind, Phase, Shape, Stop};

fn world() -> World {
    World::new(Settings::default()).unwrap()
}

fn straight(length: f64) -> Vec<Stop> {
    let end = Point::new(length, 0.0, 0.0);
    vec![Stop::Pinned(Point::origin()), Stop::Free(end)]
}

fn plan() -> WirePlan {
    WirePlan::new(Material::steel(0.02), 0.5, straight(2.0))
}

/// What a plan is refused with.
fn refusal(change: impl FnOnce(&mut WirePlan)) -> String {
    let mut plan = plan();
    change(&mut plan);
    let mut world = world();
    let text = world.add_wire(&plan).unwrap_err().to_string();
    assert!(world.wires().is_empty());
    text
}

#[test]
fn settings_are_refused_one_by_one() {
    let refusal = |change: fn(&mut Settings)| {
        let mut settings = Settings::default();
        change(&mut settings);
        World::new(settings).unwrap_err().to_string()
    };
    let above = "must be finite and above 0";
    assert_eq!(
        refusal(|s| s.step = -1.0),
        format!("step is -1, it {above}")
    );
    assert_eq!(
        refusal(|s| s.gravity.z = f64::NAN),
        "gravity is NaN, it must be finite"
    );
    let texts = [
        refusal(|s| s.contact_compliance = 0.0),
        refusal(|s| s.contact_damping = -1.0),
        refusal(|s| s.impact_speed = -1.0),
        refusal(|s| s.contact_tolerance = 0.0),
        refusal(|s| s.stability_margin = 1.0),
        refusal(|s| s.split_ratio = 2.0),
    ];
    assert_eq!(
        texts,
        [
            "contact_compliance is 0, it must be finite and above 0",
            "contact_damping is -1, it must be finite and at least 0",
            "impact_speed is -1, it must be finite and at least 0",
            "contact_tolerance is 0, it must be finite and above 0",
            "stability_margin is 1, it must be below 1",
            "split_ratio is 2, it must be finite and above 2",
        ]
    );
}

#[test]
fn materials_are_refused_by_field() {
    let texts = [
        refusal(|p| p.material.density = -7850.0),
        refusal(|p| p.material.radius = 0.0),
        refusal(|p| p.material.stretch_modulus = 0.0),
        refusal(|p| p.material.bend_modulus = f64::NAN),
        refusal(|p| p.material.stretch_damping = -0.1),
        refusal(|p| p.material.bend_damping = f64::INFINITY),
    ];
    assert_eq!(
        texts,
        [
            "density is -7850, it must be finite and above 0",
            "radius is 0, it must be finite and above 0",
            "stretch_modulus is 0, it must be finite and above 0",
            "bend_modulus is NaN, it must be finite and at least 0",
            "stretch_damping is -0.1, it must be finite and at least 0",
            "bend_damping is inf, it must be finite and at least 0",
        ]
    );
}

#[test]
fn wires_are_refused_by_what_is_wrong_with_their_route() {
    let contact = |body| Stop::Contact {
        body: BodyId(body),
        local: Vector::zeros(),
        normal: Vector::z(),
        friction: 0.5,
    };
    let eye = |local| Stop::Eye {
        body: BodyId(3),
        local,
    };
    let texts = [
        refusal(|p| p.resolution.length = 0.0),
        refusal(|p| p.length = Some(-2.0)),
        refusal(|p| p.velocity.x = f64::NAN),
        refusal(|p| p.route.truncate(1)),
        refusal(|p| p.route = vec![p.route[0], p.route[0]]),
        refusal(|p| p.route[1] = Stop::Free(Point::new(f64::NAN, 0.0, 0.0))),
        refusal(|p| p.route[0] = Stop::Pinned(Point::new(0.0, f64::INFINITY, 0.0))),
        refusal(|p| p.route[1] = eye(Vector::zeros())),
        refusal(|p| p.route[1] = eye(Vector::repeat(f64::NAN))),
    ];
    assert_eq!(
        texts,
        [
            "resolution is 0, it must be finite and above 0",
            "length is -2, it must be finite and above 0",
            "velocity is NaN, it must be finite",
            "the route has 1 stop, it must have at least 2",
            "stops 0 and 1 of the route are at the same place, their distance must be above 0",
            "position is NaN, it must be finite",
            "position is inf, it must be finite",
            "there is no body 3: bodies are 0 to 0 (excluded)",
            "local is NaN, it must be finite",
        ]
    );
    let mut world = world();
    let sphere = Shape::Sphere { radius: 1.0 };
    let plan_body = BodyPlan::fixed(sphere, Point::new(1.0, 1.0, 1.0));
    world.add_body(plan_body).unwrap();
    let mut at_end = plan();
    at_end.route[1] = contact(0);
    let text = world.add_wire(&at_end).unwrap_err().to_string();
    assert!(text.starts_with("stop 1 is a contact node at an end of the route"));
    let mut sticky = plan();
    let stop = Stop::Contact {
        body: BodyId(0),
        local: Vector::zeros(),
        normal: Vector::zeros(),
        friction: -1.0,
    };
    sticky.route.insert(1, stop);
    let text = world.add_wire(&sticky).unwrap_err().to_string();
    assert_eq!(text, "friction is -1, it must be finite and at least 0");
    if let Stop::Contact { friction, .. } = &mut sticky.route[1] {
        *friction = 0.5;
    }
    let text = world.add_wire(&sticky).unwrap_err().to_string();
    assert_eq!(text, "normal is 0, it must be a vector longer than 0");
}

#[test]
fn bodies_are_refused_by_field() {
    let sphere = Shape::Sphere { radius: 1.0 };
    let mut world = world();
    let mut refusal = |plan: BodyPlan| {
        let text = world.add_body(plan).unwrap_err().to_string();
        assert!(world.bodies().is_empty());
        text
    };
    let phase = |from| Phase {
        from,
        velocity: Vector::x(),
        angular_velocity: Vector::zeros(),
    };
    let driven = |phases| BodyPlan {
        drive: Drive::Kinematic(phases),
        ..BodyPlan::fixed(sphere.clone(), Point::origin())
    };
    let texts = [
        refusal(BodyPlan::dynamic(sphere.clone(), -1.0, Point::origin())),
        refusal(BodyPlan::fixed(
            sphere.clone(),
            Point::new(0.0, f64::NAN, 0.0),
        )),
        refusal(BodyPlan::dynamic(Shape::Plane, 1.0, Point::origin())),
        refusal(driven(vec![phase(f64::NAN)])),
        refusal(driven(vec![phase(1.0), phase(1.0)])),
    ];
    assert_eq!(
        texts,
        [
            "density is -1, it must be finite and above 0",
            "position is NaN, it must be finite",
            "a plane has no mass, a body of this shape must be static or kinematic",
            "from is NaN, it must be finite",
            "phase 2 of the kinematic body starts at 1 s, it must start after phase 1, which starts at 1 s",
        ]
    );
}

#[test]
fn wire_is_resolved_along_its_route_with_the_mass_of_its_length() {
    let mut world = world();
    let mut long = plan();
    long.route.push(Stop::Free(Point::new(2.0, 1.2, 0.0)));
    long.length = Some(3.0);
    let id = world.add_wire(&long).unwrap();
    let wire = world.wire(id).unwrap();
    // 1.875 m and 1.125 m unstretched: three and two segments of at least 0.5 m.
    assert_eq!(wire.nodes().len(), 6);
    assert!((0..5).all(|i| wire.rest_length(i) >= 0.5));
    assert_eq!(wire.nodes()[3].position, Point::new(2.0, 0.0, 0.0));
    let kinds: Vec<bool> = wire
        .nodes()
        .iter()
        .map(|n| n.kind == NodeKind::Pinned)
        .collect();
    assert_eq!(kinds, [true, false, false, false, false, false]);
    let mass: f64 = (0..6).map(|i| wire.node_mass(i)).sum();
    assert!((mass - 3.0 * wire.material().mass_per_length()).abs() < 1e-12);
    assert_eq!(wire.at(-1.0), (0, 0.0));
    assert_eq!(wire.at(9.0), (4, 1.0));
    let (segment, place) = wire.at(1.875 + 0.9);
    assert!(segment == 4 && (place - 0.6).abs() < 1e-12);
}
